"""Modes of a structure, and how well a basis holds what links need."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ._arrays import array, frozen

if TYPE_CHECKING:
    from ._arrays import Array


class Modes:
    """Modes of a structure: without links, in the basis that a case uses, or with links that count as linear."""

    #: Circular frequencies, rad/s, rising; 0 for modes that nothing holds, not a number for what falls.
    omega: Array
    #: Share of the mass along X, Y and Z that each mode carries, a row for each.
    mass_participation: Array
    #: Damping ratios that cycles of links give; empty where no link is led through any.
    damping: Array
    #: Share of the static response to each load direction that the basis holds.
    static_participation: dict[str, float]
    #: Share of the flexibility at each link coordinate that the basis holds, the worst first.
    adequacy: dict[str, float]
    #: Static shapes of places without mass, beside the modes.
    static_shapes: int
    #: Displacements of the nodes in the lowest modes that deform the structure, or in all with links, of any size: arrays of
    #: a row of six (translations, rotations) for each node, by the index of the mode.
    shapes: dict[int, Array]

    def __init__(self, json_text: str, text: str, shapes: list[tuple[int, list[float]]]) -> None:
        import json

        import numpy as np

        facts: dict[str, Any] = json.loads(json_text)
        self._state = (json_text, text, shapes)
        self._text = text
        self.omega = frozen(np.array(facts["omega"], dtype=float))
        shares = np.array(facts["mass_participation"], dtype=float).reshape(-1, 3)
        self.mass_participation = frozen(shares)
        self.damping = frozen(np.array(facts.get("damping", []), dtype=float))
        self.static_participation = dict(facts["static_participation"])
        self.adequacy = {a["coordinate"]: a["share"] for a in facts["adequacy"]}
        self.static_shapes = facts["static_shapes"]
        self.shapes = {m: frozen(np.array(u, dtype=float).reshape(-1, 6)) for m, u in shapes}

    @property
    def frequency(self) -> Array:
        """Frequencies, Hz."""
        return array(self.omega / (2.0 * math.pi))

    @property
    def period(self) -> Array:
        """Periods, s; infinite for modes that nothing holds."""
        import numpy as np

        with np.errstate(divide="ignore"):
            return array(2.0 * math.pi / self.omega)

    def __len__(self) -> int:
        return len(self.omega)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        first = ", ".join(f"{f:.4g}" for f in self.frequency[:3])
        return f"<{len(self)} modes: {first}{', …' if len(self) > 3 else ''} Hz>"

    def _repr_html_(self) -> str:
        from ._html import table

        sums = self.mass_participation.cumsum(axis=0)
        rows = zip(self.period.tolist(), self.frequency.tolist(), sums.tolist())
        head = ["mode", "period [s]", "frequency [Hz]", "X", "Y", "Z (mass, cumulative)"]
        return table(head, ((str(i + 1), t, f, *m) for i, (t, f, m) in enumerate(rows)))

    def __reduce__(self) -> tuple[type[Modes], tuple[str, str, list[tuple[int, list[float]]]]]:
        return Modes, self._state
