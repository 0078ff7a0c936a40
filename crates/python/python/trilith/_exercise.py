"""What a link does on its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from . import _native
from ._arrays import Columns, array, numbers, positive, whole
from ._errors import ArgumentError
from ._result import Loop

if TYPE_CHECKING:
    from ._arrays import Array, Numbers
    from ._law import CLaw, Law


class LastCycle(NamedTuple):
    """The last closed cycle of a coordinate."""

    #: ∮ f dd, J.
    area: float
    #: Force over deformation between the extreme deformations, N/m or N·m/rad.
    stiffness: float | None
    #: Equivalent damping ratio; nothing where the stiffness is nearly zero.
    damping: float | None


class Exercise:
    """Deformations, forces and energies of a link that was led along a path, at the times of :attr:`t`."""

    #: The kind.
    kind: str
    #: The link as a line of a model file.
    line: str
    #: What was assumed.
    notes: list[str]
    #: Times, s.
    t: Array
    #: Deformations (m, rad), rates and forces (N, N·m) by coordinate.
    deformation: Columns
    rate: Columns
    force: Columns
    #: Work done on the link, and stored, hysteretic and viscous energy since the start, J.
    energy: Columns
    #: History variables of the law, and their units.
    history: Columns
    units: dict[str, str]
    #: Which coordinates are rotations.
    rotations: dict[str, bool]
    #: The last closed cycle of the coordinates that move; none along a measured path.
    last_cycle: dict[str, LastCycle]
    #: What of the work the energies do not account for, over the work done and taken.
    energy_error: float

    def __init__(self, kind: str, facts: _native.ExerciseFacts) -> None:
        self.kind = kind
        self.line, self.notes, time, coordinates, energies, fields, self.energy_error, svgs = facts
        self.t = array(time)
        what = f"coordinate of {kind} named"
        self.rotations = {c[0]: c[1] for c in coordinates}
        self.deformation = Columns(what, {c[0]: c[2] for c in coordinates})
        self.rate = Columns(what, {c[0]: c[3] for c in coordinates})
        self.force = Columns(what, {c[0]: c[4] for c in coordinates})
        self.last_cycle = {c[0]: LastCycle(*c[5]) for c in coordinates if c[5] is not None}
        names = ("work", "stored", "hysteretic", "viscous")
        self.energy = Columns("energy", dict(zip(names, energies)))
        self.history = Columns("history variable", {name: column for name, _, column in fields})
        self.units = {name: unit for name, unit, _ in fields}
        self._svgs = svgs

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of its coordinates."""
        return tuple(self.rotations)

    def loop(self, coordinate: str | None = None) -> Loop:
        """Deformation and force of a coordinate; without a name, of the first that moves."""
        if coordinate is None:
            moves = (c for c in self.coordinates if self.deformation[c].any())
            coordinate = next(moves, self.coordinates[0])
        return Loop(self.deformation[coordinate], self.force[coordinate])

    def svg(self) -> list[str]:
        """Its loops as SVG."""
        return list(self._svgs)

    def __repr__(self) -> str:
        return f"<Exercise of {self.line}: {len(self.t)} times>"

    def _repr_html_(self) -> str:
        from html import escape

        from ._html import figures

        return f"<p><code>{escape(self.line)}</code></p>{figures(self._svgs)}"


def exercise(
    kind: str | type[Law] | CLaw,
    path: Numbers | Mapping[str, Numbers] | None = None,
    /,
    *,
    t: Numbers | None = None,
    dt: float = 0.01,
    amplitude: Mapping[str, float | str] | float | str | None = None,
    mean: Mapping[str, float | str] | None = None,
    frequency: float | None = None,
    cycles: int = 3,
    parameters: Mapping[str, object] | None = None,
    **more: object,
) -> Exercise:
    """Leads a link through growing cycles of deformation, or along a path.

        tl.exercise("Wen", amplitude="5 cm", k="2 MN/m").loop()
        tl.exercise("Gap", [0, 0.01, -0.02, 0.03], dt=0.1)

    :param kind: its kind, such as ``"Wen"``, or a law of one's own.
    :param path: deformations of its first coordinate (m or rad), or of several by their names.
    :param t: times of the path, s, rising; without them steps of ``dt``.
    :param dt: s.
    :param amplitude: of the largest cycle by coordinate; one alone is that of the first. Without a path and amplitudes, those
        of the card.
    :param mean: what the cycles are about, by coordinate.
    :param frequency: Hz.
    :param cycles: how many.
    :param parameters: parameters of the link where they are not those of the example on its card, also by keyword: numbers in
        SI or texts with units; ``"none"`` takes one away.
    :raises ModelError: for parameters that are refused, as in a model file.
    :raises ArgumentError: for a kind or coordinate that there is not, and a path that is none.
    """
    from ._law import kind_of
    from ._ron import ron

    kind, laws = kind_of(kind)
    set_ = [
        (name, value if isinstance(value, str) else ron(value))
        for name, value in {**(parameters or {}), **more}.items()
    ]
    history = None
    if path is not None:
        named = path if isinstance(path, Mapping) else {_first(kind, set_, laws): path}
        if not named:
            raise ArgumentError("the path moves no coordinate")
        columns = [(name, numbers(f"the path of {name}", v, least=2)) for name, v in named.items()]
        if t is None:
            step = positive("dt", dt) or 0.0
            times = [step * i for i in range(len(columns[0][1]))]
        else:
            times = numbers("t", t, least=2)
        history = (times, columns)
    facts = _native.exercise(
        kind,
        set_,
        of_coordinates("amplitude", amplitude, kind, set_, laws),
        of_coordinates("mean", mean, kind, set_, laws),
        positive("frequency", frequency),
        whole("cycles", cycles) or 1,
        history,
        laws,
    )
    return Exercise(kind, facts)


def _first(kind: str, set_: Sequence[tuple[str, str]], laws: list[_native.Law]) -> str:
    """The first coordinate of a link."""
    facts = _native.exercise(kind, list(set_), [], [], None, 1, None, laws)
    return facts[3][0][0]


def of_coordinates(
    what: str,
    values: Mapping[str, float | str] | float | str | None,
    kind: str,
    set_: Sequence[tuple[str, str]],
    laws: list[_native.Law],
) -> list[tuple[str, str]]:
    """Values by coordinate; one alone is that of the first."""
    from ._model import written

    if values is None:
        return []
    named = values if isinstance(values, Mapping) else {_first(kind, set_, laws): values}
    return [(name, written(f"{what} of {name}", value)) for name, value in named.items()]
