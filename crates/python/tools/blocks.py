"""Writes `python/trilith/blocks.py`: a class for each kind of the catalogue and each block of model files.

    python tools/blocks.py          # with the package installed

The cards and the schema of the library are the only source; a test holds the file to them.
"""

from __future__ import annotations

import keyword
import sys
import textwrap
from pathlib import Path

import trilith as tl
from trilith import _native

HEAD = '''"""Kinds and blocks of model files, one class each.

Made by `tools/blocks.py` of the cards and the schema of the library; do not edit. What a class is given is written into the
text of a model, and the reader of model files checks it: quantities are numbers in SI (or in the `units` of the model) or
texts with units or expressions (``"30 kN/m"``, ``"mu * mass * g"``); names in a `Word` field may be texts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from ._ron import Block, Word

#: A number in SI, or a text with a unit or an expression.
Quantity: TypeAlias = "float | str"
#: A bare name.
Name: TypeAlias = "Word | str | type[Block]"
'''

NUMBER, LIST, ANY = "Quantity", "Sequence[Any]", "Any"
TYPES = {
    "number": NUMBER,
    "numbers": f"{NUMBER} | {LIST}",
    "choice": "Name",
    "choices": f"{LIST} | Name",
    "flag": "bool | str",
    "matrix": LIST,
    "points": LIST,
    "node": "str",
    "text": "str",
    "file": "Block | str",
    "labels": LIST,
    "count": "int | str",
    "name": "str",
    "one": "Name | Block | Mapping[str, Any]",
    "list": LIST,
    "map": "Mapping[str, Any]",
    "any": ANY,
}


class Field:
    """A keyword of a class."""

    def __init__(self, name: str, kind: str, text: str) -> None:
        self.name, self.kind, self.text = name, kind, text
        #: As a keyword of Python.
        self.word = f"{name}_" if keyword.iskeyword(name) else name


def of_schema(facts: _native.FieldFacts) -> Field:
    name, meaning, (kind, choices, _), default = facts
    more = f" One of {', '.join(choices)}." if choices else ""
    return Field(name, kind, f"{meaning}{more} Default: {default}." if default != "required" else f"{meaning}{more}")


def of_card(p: tl.CardParameter) -> Field:
    facts = [x for x in (p.unit, p.range, f"default {p.default}" if not p.required else "") if x and x != "1"]
    more = f" One of {', '.join(p.choices)}." if p.choices else ""
    return Field(p.name, p.form, f"{p.meaning.rstrip('.')}{' (' + ', '.join(facts) + ')' if facts else ''}.{more}")


def class_of(name: str, summary: str, fields: list[Field], *, more: bool = False) -> str:
    """The text of a class."""
    out = [f"\n\nclass {name}(Block):"]
    doc = textwrap.wrap(summary, 110)
    if fields:
        doc.append("")
    for f in fields:
        doc += textwrap.wrap(f":param {f.word}: {f.text}", 110, subsequent_indent="    ")
    text = "\n".join(f"    {line}".rstrip() for line in doc).replace("\\", "\\\\")
    out.append(f'    """{text.strip()}' + ("\n    " if len(doc) > 1 else "") + '"""\n')
    out.append(f'    _name = "{name}"')
    words = sorted(f.name for f in fields if f.kind in ("choice", "choices", "one"))
    if words:
        out.append(f"    _words = frozenset({{{', '.join(repr(w) for w in words)}}})".replace("'", '"'))
    if not fields:
        return "\n".join(out)
    out.append("\n    def __init__(\n        self,\n        *,")
    out += [f"        {f.word}: {TYPES[f.kind]} | None = None," for f in fields]
    if more:
        out.append("        **more: Any,")
    out.append("    ) -> None:\n        super().__init__(")
    plain = [f for f in fields if f.word == f.name]
    out += [f"            {f.name}={f.name}," for f in plain]
    out += [f'            **{{"{f.name}": {f.word}}},' for f in fields if f not in plain]
    if more:
        out.append("            **more,")
    out.append("        )")
    return "\n".join(out)


def merged(fields: list[Field]) -> list[Field]:
    """Each name once; what differs takes anything."""
    found: dict[str, Field] = {}
    for f in fields:
        if f.name in found and found[f.name].kind != f.kind:
            found[f.name].kind = "any"
        found.setdefault(f.name, f)
    return list(found.values())


def text() -> str:
    """The whole file."""
    groups = {name: blocks for name, _, blocks in _native.schema()}
    everywhere = {n: [of_schema(f) for _, _, _, fs in groups[n] for f in fs] for n in ("place", "element", "link")}
    classes: dict[str, tuple[str, list[Field]]] = {}
    words: set[str] = set()
    anonymous: dict[str, set[str]] = {}
    for card in tl.elements().values():
        fields = [*everywhere["place"], *map(of_card, card.parameters), *everywhere["element"]]
        if card.category == "link":
            fields += everywhere["link"]
        nodes = {(1, 1): "one node", (1, 2): "two nodes, or one and the ground"}
        least, most = card.nodes
        count = nodes.get((least, most or 0)) or (f"{least} nodes" if least == most else f"{least} nodes or more")
        classes[card.kind] = (f"{card.summary} On {count}.", merged(fields))
        words.update(w for p in card.parameters for w in p.choices)
    for name, blocks in groups.items():
        for block, meaning, _, fields in blocks:
            words.update(w for _, _, (_, choices, _), _ in fields for w in choices)
            if not block:
                for f in fields:
                    anonymous.setdefault(f[0], set()).add(f[2][0])
            elif not keyword.iskeyword(block) and name not in everywhere:
                summary, known = classes.get(block, (meaning, []))
                said = summary if summary == meaning or meaning in summary else f"{summary} {meaning}"
                classes[block] = (said, merged([*known, *map(of_schema, fields)]))
    words = {w for w in words if w.isidentifier() and w[0].isupper() and w not in classes and not keyword.iskeyword(w)}
    # Fields of blocks without a name that take bare names wherever they are.
    plain = sorted(n for n, kinds in anonymous.items() if kinds == {"choice"})
    out = [HEAD, "\n#: Fields of blocks without a name that take a bare name."]
    out.append(f"WORDS = frozenset({{{', '.join(repr(w) for w in plain)}}})".replace("'", '"'))
    out.append("")
    out += [f'{w} = Word("{w}")' for w in sorted(words)]
    out += [class_of(n, s, f, more=n == "For") for n, (s, f) in sorted(classes.items())]
    names = sorted([*words, *classes])
    out.append("\n\n__all__ = [\n" + "".join(f'    "{n}",\n' for n in names) + "]")
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    target = Path(__file__).resolve().parent.parent / "python/trilith/blocks.py"
    target.write_text(text(), encoding="utf-8")
    print(target, file=sys.stderr)
