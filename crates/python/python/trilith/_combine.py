"""Combinations of cases: sums and envelopes of their extremes."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ._arrays import Named, names

if TYPE_CHECKING:
    from ._model import Model


class Extremes(NamedTuple):
    """The extremes of an output."""

    #: Its SI unit.
    unit: str
    #: The largest value.
    max: float
    #: The smallest value.
    min: float
    #: The term of an envelope that the largest value comes from.
    max_from: str | None
    #: The term of an envelope that the smallest value comes from.
    min_from: str | None


class Combination(Named[Extremes]):
    """A combination: the extremes of its outputs, by their names."""

    def __init__(
        self, name: str, how: str, terms: Mapping[str, float], outputs: Mapping[str, Extremes]
    ) -> None:
        super().__init__("output", outputs)
        #: Its name.
        self.name = name
        #: How its terms are put together: ``"LinearAdd"``, ``"AbsoluteAdd"``, ``"Srss"`` or ``"Envelope"``.
        self.how = how
        #: Its terms with their factors.
        self.terms = dict(terms)

    def __repr__(self) -> str:
        return f"<{self.how} {self.name!r} of {', '.join(self.terms)}>"


class Combinations(Named[Combination]):
    """What :meth:`Model.combine` found, by the names of the combinations."""

    def __init__(self, text: str, facts: str) -> None:
        found = json.loads(facts)
        made = {
            one["name"]: Combination(
                one["name"], one["how"], dict(one["terms"]), _outputs(one["outputs"])
            )
            for one in found["combinations"]
        }
        super().__init__("combination", made)
        self._text = text
        #: The extremes of the cases that were run, by their names.
        self.cases: dict[str, dict[str, Extremes]] = {
            case["name"]: _outputs(case["outputs"]) for case in found["cases"]
        }

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Combinations {', '.join(self)}>"


def _outputs(all: Sequence[dict[str, object]]) -> dict[str, Extremes]:
    made = {}
    for one in all:
        unit, most, least = one["unit"], one["max"], one["min"]
        origin = [one.get("max_from"), one.get("min_from")]
        made[str(one["output"])] = Extremes(unit, most, least, *origin)  # type: ignore[arg-type]
    return made


def combine(
    model: Model, of: Sequence[str] = (), *, progress: Callable[[float], object] | None = None
) -> Combinations:
    """Runs the cases of combinations and combines them: see :meth:`Model.combine`."""
    return Combinations(*model._native.combine(names("of", of), progress))
