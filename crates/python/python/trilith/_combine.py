"""Combinations of cases: sums and envelopes of their extremes."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ._arrays import names
from ._errors import unknown

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


class Combination(Mapping[str, Extremes]):
    """A combination: the extremes of its outputs, by their names."""

    def __init__(
        self, name: str, how: str, terms: Mapping[str, float], outputs: Mapping[str, Extremes]
    ) -> None:
        #: Its name.
        self.name = name
        #: How its terms are put together: ``"LinearAdd"``, ``"AbsoluteAdd"``, ``"Srss"`` or ``"Envelope"``.
        self.how = how
        #: Its terms with their factors.
        self.terms = dict(terms)
        self._outputs = dict(outputs)

    def __getitem__(self, name: str) -> Extremes:
        try:
            return self._outputs[name]
        except (KeyError, TypeError):
            raise unknown("output", name, self._outputs) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    def __repr__(self) -> str:
        return f"<{self.how} {self.name!r} of {', '.join(self.terms)}>"


class Combinations(Mapping[str, Combination]):
    """What :meth:`Model.combine` found, by the names of the combinations."""

    def __init__(self, text: str, facts: str) -> None:
        found = json.loads(facts)
        self._text = text
        self._all = {
            one["name"]: Combination(
                one["name"], one["how"], dict(one["terms"]), _outputs(one["outputs"])
            )
            for one in found["combinations"]
        }
        #: The extremes of the cases that were run, by their names.
        self.cases: dict[str, dict[str, Extremes]] = {
            case["name"]: _outputs(case["outputs"]) for case in found["cases"]
        }

    def __getitem__(self, name: str) -> Combination:
        try:
            return self._all[name]
        except (KeyError, TypeError):
            raise unknown("combination", name, self._all) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Combinations {', '.join(self._all)}>"


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
