"""Models written in Python, as the text of a model file.

A text stays a text (``"mu"``, ``"30 kN/m"``), a number a number, a tuple ``(…)``, a list or an array ``[…]``. A class of
:mod:`trilith.blocks` and a :class:`Word` are bare names, an object of such a class is ``Name(field: value, …)``, and a
``dict`` inside a section is ``(field: value, …)``. Where a field takes one of a few bare names, such as ``dof``, and in
``supports``, a text is one. What has the value ``None`` is left out.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar


class Word(str):
    """A bare name of a model file, such as ``Ux``."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Word({str.__repr__(self)})"


class Block:
    """``Name(field: value, …)`` of a model file. The classes for all kinds are in :mod:`trilith.blocks`."""

    #: The name in a file.
    _name: ClassVar[str] = ""
    #: Fields that take one of a few bare names, which may be given as texts.
    _words: ClassVar[frozenset[str]] = frozenset()
    _fields: dict[str, Any]

    def __init__(self, **fields: Any) -> None:
        self._fields = {name: value for name, value in fields.items() if value is not None}

    def __repr__(self) -> str:
        return ron(self)

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self._fields == getattr(other, "_fields", None)

    __hash__ = None  # type: ignore[assignment]


def _text(value: str) -> str:
    out = ['"']
    for c in value:
        if c in '"\\':
            out.append("\\" + c)
        elif c == "\n":
            out.append("\\n")
        elif c == "\t":
            out.append("\\t")
        elif ord(c) < 0x20 or 0x7F <= ord(c) < 0xA0:
            out.append(f"\\u{{{ord(c):x}}}")
        else:
            out.append(c)
    out.append('"')
    return "".join(out)


def _number(value: float) -> str:
    if value != value:
        return "NaN"
    if value in (float("inf"), float("-inf")):
        return "inf" if value > 0 else "-inf"
    return repr(float(value))


def _words(value: Any) -> Any:
    """Texts of a field that takes bare names."""
    if isinstance(value, str):
        return Word(value)
    if isinstance(value, (list, tuple)):
        return [_words(v) for v in value]
    return value


def ron(value: Any, depth: int = 0) -> str:
    """A value as it stands in a model file.

    :raises TypeError: for a value that a model file has no form for.
    """
    if isinstance(value, Word):
        return str.__str__(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, type) and issubclass(value, Block):
        return value._name
    if isinstance(value, Block):
        fields = value._fields
        words = value._words
        pairs = {n: _words(v) if n in words else v for n, v in fields.items()}
        return value._name + _struct(pairs, depth)
    if isinstance(value, Mapping):
        from .blocks import WORDS

        return _struct({n: _words(v) if n in WORDS else v for n, v in value.items()}, depth)
    if isinstance(value, tuple):
        inside = ", ".join(ron(v, depth + 1) for v in value)
        return f"({inside},)" if len(value) == 1 else f"({inside})"
    if hasattr(value, "__fspath__"):
        return _text(str(value.__fspath__()))
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        return ron(value.tolist(), depth)
    if isinstance(value, (list, set, frozenset)) or hasattr(value, "__iter__"):
        return "[" + ", ".join(ron(v, depth + 1) for v in value) + "]"
    raise TypeError(f"a model has no form for {value!r} of type {type(value).__name__}")


def _struct(fields: Mapping[Any, Any], depth: int) -> str:
    pairs = [(n, v) for n, v in fields.items() if v is not None]
    if any(isinstance(n, str) and not n.isidentifier() for n, _ in pairs):
        # Names of a model, such as cases of a combination: a map.
        return "{" + ", ".join(f"{_text(str(n))}: {ron(v, depth + 1)}" for n, v in pairs) + "}"
    inside = ", ".join(f"{_key(n)}: {ron(v, depth + 1)}" for n, v in pairs)
    return f"({inside})"


def _key(name: object) -> str:
    if not isinstance(name, str) or not name.isidentifier():
        raise TypeError(f"{name!r} is no name of a field")
    return name


def section(entries: Mapping[Any, Any]) -> str:
    """A section: names, each with what it stands for, a line each."""
    lines = []
    for name, value in entries.items():
        if not isinstance(name, str):
            raise TypeError(f"names in a model are texts, not {name!r}")
        if value is not None:
            lines.append(f"        {_text(name)}: {ron(value, 2)},\n")
    return "{\n" + "".join(lines) + "    }"


def model(sections: Mapping[str, Any]) -> str:
    """The text of a model file with these sections; what is ``None`` is left out."""
    lines = []
    for name, value in sections.items():
        if value is None:
            continue
        if name == "plane":
            value = _words(value)
        if name == "supports" and isinstance(value, Mapping):
            value = {node: _words(directions) for node, directions in value.items()}
        whole = isinstance(value, Mapping) and name not in FIELDS
        lines.append(f"    {_key(name)}: {section(value) if whole else ron(value, 1)},\n")
    return "(\n" + "".join(lines) + ")\n"


#: Sections that hold fields in parentheses and no names in quotes.
FIELDS = frozenset({"units"})
