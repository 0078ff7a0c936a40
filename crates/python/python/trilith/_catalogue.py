"""The kinds of elements, constraints and links."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from . import _native
from ._errors import unknown

if TYPE_CHECKING:
    from ._law import CLaw, Law


class CardParameter(NamedTuple):
    """A parameter of a kind."""

    name: str
    #: Symbol in the law.
    symbol: str
    #: SI unit, or what it takes.
    unit: str
    #: Admissible values.
    range: str
    #: What holds where a model says nothing.
    default: str
    #: One sentence.
    meaning: str
    #: ``"number"``, ``"numbers"``, ``"choice"``, ``"choices"``, ``"flag"``, ``"matrix"``, ``"points"`` or ``"node"``.
    form: str
    #: The names that it may have.
    choices: tuple[str, ...]
    #: True where a model must give it.
    required: bool


class Card(NamedTuple):
    """What a kind is and takes."""

    kind: str
    #: ``"linear"``, ``"constraint"`` or ``"link"``.
    category: str
    #: One sentence.
    summary: str
    #: Least and most nodes; nothing for any number.
    nodes: tuple[int, int | None]
    parameters: tuple[CardParameter, ...]
    #: The law, several lines, and where it comes from.
    law: str
    source: str
    #: A line of a model file.
    example: str
    #: Coordinates and history variables of a link.
    coordinates: str
    history: str

    def _repr_html_(self) -> str:
        from html import escape

        from ._html import table

        rows = [p[:6] for p in self.parameters]
        head = ["name", "symbol", "unit", "range", "default", "meaning"]
        law = f"<pre>{escape(self.law)}</pre>" if self.law else ""
        return f"<p><b>{escape(self.kind)}</b>: {escape(self.summary)}</p>{table(head, rows)}{law}"


class _Cards(dict[str, Card]):
    def __missing__(self, kind: str) -> Card:
        raise unknown("kind", kind, self)


def elements(laws: Sequence[type[Law] | CLaw] = ()) -> dict[str, Card]:
    """All kinds, with their parameters, units, ranges, defaults, laws and sources: ``tl.elements()["NLink"]``.

    :param laws: laws of one's own, which come behind the built-in kinds.
    """
    from ._law import natives

    found = _Cards()
    for kind, category, summary, nodes, parameters, (law, source, example), facts in _native.elements(natives(laws)):
        own = tuple(
            CardParameter(*texts, form, tuple(choices), required)
            for texts, form, choices, required in parameters
        )
        coordinates, history = facts or ("", "")
        found[kind] = Card(
            kind, category, summary, nodes, own, law, source, example, coordinates, history
        )
    return found
