"""Derivatives of outputs by parameters, and values of parameters that make a goal smallest."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ._arrays import Columns, Named, array, names, positive, whole
from ._errors import ArgumentError, unknown
from ._model import written

if TYPE_CHECKING:
    from ._arrays import Array
    from ._model import Model


class Sensitive(NamedTuple):
    """A value of an output, with its derivatives by parameters; SI."""

    #: When, s.
    t: float
    #: The value.
    value: float
    #: Its derivatives, by the names of the parameters.
    by: dict[str, float]


class OutputGradient(NamedTuple):
    """An output with its derivatives."""

    #: Its name.
    name: str
    #: Its SI unit.
    unit: str
    #: Its history.
    history: Array
    #: Histories of the derivatives, by the names of the parameters.
    by: Mapping[str, Array]
    #: The largest value.
    max: Sensitive
    #: The smallest value.
    min: Sensitive
    #: The largest magnitude.
    peak: Sensitive
    #: The value at the end.
    final: Sensitive


class Bend(NamedTuple):
    """A link whose law bends where substeps ended: derivatives are those of one side there."""

    #: The link.
    link: str
    #: When first, s.
    t: float
    #: At the ends of how many substeps.
    substeps: int


class Gradient(Named[OutputGradient]):
    """What :meth:`Model.gradient` found, by the names of the outputs."""

    def __init__(
        self,
        text: str,
        t: Array,
        parameters: Sequence[tuple[str, float, str]],
        outputs: Mapping[str, OutputGradient],
        heat: Mapping[str, Sensitive],
        input: Sensitive | None,
        bends: Sequence[tuple[str, float, int]],
        substeps: int,
    ) -> None:
        super().__init__("output", outputs)
        self._text = text
        #: Output times, s.
        self.t = t
        #: The parameters with their values, SI.
        self.parameters: dict[str, float] = {name: x for name, x, _ in parameters}
        #: Their units.
        self.units: dict[str, str] = {name: unit for name, _, unit in parameters}
        #: What each link has turned into heat until the end, J.
        self.heat: dict[str, Sensitive] = dict(heat)
        #: What loads and moving supports have put in until the end, J, where ``of`` names ``"input"``.
        self.input = input
        #: Links whose laws bend where substeps ended.
        self.bends: list[Bend] = [Bend(*bend) for bend in bends]
        #: Substeps of the run.
        self.substeps = substeps

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Gradient of {', '.join(self)} by {', '.join(self.parameters)}>"


class LimitState(NamedTuple):
    """A limit with the best values."""

    #: As it was given.
    text: str
    #: Its left side and its bound, SI.
    value: float
    bound: float
    #: Unit of both.
    unit: str
    #: By how much it is broken, as share of the bound; below zero where it is not.
    beyond: float
    #: Whether it holds, within a thousandth of the bound.
    holds: bool
    #: By how many per cent of the first goal one per cent more of the bound changes the goal; 0 where it does not matter.
    multiplier: float


class Evaluation(NamedTuple):
    """A run of a search."""

    #: The goal, SI; of several the largest. Nothing where the run failed.
    goal: float | None
    #: Left sides of the limits, SI.
    limits: list[float]
    #: Values of the parameters, SI.
    parameters: dict[str, float]
    #: Why it failed.
    failed: str | None


class Optimum:
    """What :meth:`Model.optimize` found."""

    def __init__(self, text: str, facts: str) -> None:
        found = json.loads(facts)
        self._text = text
        #: The best values of the parameters, SI: ``m.with_parameters(o.parameters)`` is the best model.
        self.parameters: dict[str, float] = {p["name"]: p["value"] for p in found["parameters"]}
        #: Their units.
        self.units: dict[str, str] = {p["name"]: p["unit"] for p in found["parameters"]}
        #: All runs; the first one is that of the values that the model has.
        self.runs: list[Evaluation] = [
            Evaluation(r["goal"], r["limits"], dict(zip(self.parameters, r["values"])), r["failed"])
            for r in found["runs"]
        ]
        #: Index of the best run.
        self.best: int = found["best"] - 1
        #: The limits with the best values.
        self.limits: list[LimitState] = [
            LimitState(
                o["limit"], o["value"], o["bound"], o["unit"], o["beyond"], o["holds"], o["multiplier"]
            )
            for o in found["limits"]
        ]
        #: Why the search ended: ``"smallest"``, ``"kink"``, ``"limits"`` or ``"spent"``.
        self.stop: str = found["stop"]
        #: Unit of the goal.
        self.unit: str = found["unit"]
        #: Links whose laws bend at the end of substeps of the best run.
        self.bends: list[Bend] = [Bend(b["link"], b["t"], b["substeps"]) for b in found["bends"]]

    @property
    def goal(self) -> float:
        """The best goal, SI."""
        # The best run is none that failed.
        return self.runs[self.best].goal or 0.0

    @property
    def holds(self) -> bool:
        """Whether all limits hold."""
        return all(limit.holds for limit in self.limits)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Optimum: goal {self.goal:g} {self.unit} after {len(self.runs)} runs, {self.stop}>"


def gradient(
    model: Model,
    by: Sequence[str] = (),
    of: Sequence[str] = (),
    *,
    case: str | None = None,
    solver: str | None = None,
    dt: float | None = None,
) -> Gradient:
    """Exact derivatives of outputs by parameters, in one run: see :meth:`Model.gradient`."""
    found = model._native.gradient(
        case, solver, positive("dt", dt), names("by", by), names("of", of)
    )
    text, t, parameters, outputs, links, put_in, bends, substeps = found
    keys = [name for name, _, _ in parameters]
    made = {}
    for name, unit, history, columns, values in outputs:
        kinds = [Sensitive(at, x, dict(zip(keys, slopes))) for at, x, slopes in values]
        histories = Columns("parameter", dict(zip(keys, columns)))
        made[name] = OutputGradient(name, unit, array(history), histories, *kinds)
    times = array(t)
    end = float(times[-1])
    heat = {link: Sensitive(end, x, dict(zip(keys, slopes))) for link, x, slopes in links}
    source = put_in and Sensitive(end, put_in[0], dict(zip(keys, put_in[1])))
    return Gradient(text, times, parameters, made, heat, source, bends, substeps)


def optimize(
    model: Model,
    by: Mapping[str, Sequence[object]],
    minimise: str | Sequence[str],
    limits: Sequence[str] = (),
    *,
    log: Sequence[str] = (),
    max_runs: int = 50,
    case: str | None = None,
    solver: str | None = None,
    dt: float | None = None,
    progress: Callable[[float], object] | None = None,
) -> Optimum:
    """Values of parameters that make a goal smallest: see :meth:`Model.optimize`."""
    if not isinstance(by, Mapping):
        raise ArgumentError('parameters with their bounds are wanted, such as by={"mu": (0.02, 0.2)}')
    steps_are_shares = names("log", log)
    for name in steps_are_shares:
        if name not in by:
            raise unknown("parameter of `by`", name, list(by))
    variables = []
    for name, bounds in by.items():
        if isinstance(bounds, str) or not isinstance(bounds, Sequence) or len(bounds) != 2:
            raise ArgumentError(
                f"two bounds are wanted for {name!r}, such as (0.02, 0.2) or (\"10 kN\", \"1 MN\")"
            )
        low, high = (written(name, bound) for bound in bounds)
        variables.append((name, low, high, name in steps_are_shares))
    goals = [minimise] if isinstance(minimise, str) else list(minimise)
    if isinstance(limits, str):
        raise ArgumentError(f'a list of limits is wanted, such as ["{limits}"]')
    text, facts = model._native.optimize(
        case,
        solver,
        positive("dt", dt),
        variables,
        goals,
        list(limits),
        whole("max_runs", max_runs) or 1,
        progress,
    )
    return Optimum(text, facts)

