"""A run that is led from output step to output step."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._arrays import positive, whole
from ._errors import ArgumentError, unknown

if TYPE_CHECKING:
    from ._model import Model
    from ._native import State
    from ._result import Result


class Stepper:
    """A dynamic case that goes on when it is told to, and whose state can be taken and put back::

        s = m.stepper(case="pulse")
        while not s.done:
            s.step()
            if s["slide"] > 0.01:
                ...
        before = s.state        # to be kept, pickled, sent elsewhere
        s.advance(2.0)
        s.state = before        # and from there again, to the bit

    However the case is divided, its states are those of a run in one piece, to the bit. Between two calls lies a checkpoint:
    each makes the equations anew, so that one call over many steps is cheaper than many calls. Nothing acts from outside: the
    loads are those of the case.

    The steppers of one model may be used in as many threads; one of them only in one at a time.
    """

    def __init__(
        self, model: Model, case: str | None = None, solver: str | None = None, dt: float | None = None
    ) -> None:
        cases = model.cases
        if case is None:
            if not cases:
                raise ArgumentError("the model has no case")
            case = list(cases)[-1]
        if case not in cases:
            raise ArgumentError(str(unknown("case", case, cases)))
        own = cases[case]
        if own.duration is None or own.dt is None:
            raise ArgumentError(f'the case "{case}" is static: it has no steps')
        self._model = model
        self._case = case
        self._solver = solver
        self._dt = positive("dt", dt) or own.dt
        self._end = own.duration
        self._busy = False
        self._state: State | None = None
        # What stands before the first step; whatever is wrong is told here.
        self._last = self._run(None, self._dt * 1e-9)
        self._state = self._last.state

    def _run(self, start: State | None, until: float) -> Result:
        return self._model.run(
            self._case,
            solver=self._solver,
            dt=self._dt,
            until=until,
            errors=False,
            frames=0,
            start=start,
        )

    @property
    def dt(self) -> float:
        """Output step, s."""
        return self._dt

    @property
    def t(self) -> float:
        """Where it is, s."""
        return float(self._last.t[-1])

    @property
    def done(self) -> bool:
        """True at the end of the case, and where it stopped on the way: :attr:`last` says why."""
        return self.t >= self._end - 1e-9 * self._dt or not self._good()

    def _good(self) -> bool:
        return self._last.status in ("converged", "energy error", "inadequate")

    @property
    def last(self) -> Result:
        """The part of the run that was made last."""
        return self._last

    def __getitem__(self, output: str) -> float:
        """The value of an output where it is."""
        return float(self._last[output][-1])

    @property
    def values(self) -> dict[str, float]:
        """The values of all outputs where it is."""
        return {name: float(values[-1]) for name, values in self._last.items()}

    def step(self, steps: int = 1) -> float:
        """Goes on for so many output steps, or to the end of the case; the time where it is then, s.

        :raises ArgumentError: at the end.
        """
        count = whole("steps", steps) or 1
        return self._to((round(self.t / self._dt) + count) * self._dt)

    def advance(self, t: float) -> float:
        """Goes on to the first output time not before ``t`` (s); the time where it is then."""
        until = positive("t", t) or 0.0
        if until <= self.t:
            raise ArgumentError(f"t must be above {self.t:g} s, where it is: it is {until:g}")
        return self._to(until)

    def _to(self, until: float) -> float:
        if self.done:
            raise ArgumentError(f"the case is at its end, t = {self.t:g} s ({self._last.status})")
        if self._busy:
            raise ArgumentError("this stepper is at work in another thread: make one for each")
        self._busy = True
        try:
            self._last = self._run(self._state, until)
            self._state = self._last.state
        finally:
            self._busy = False
        return self.t

    @property
    def state(self) -> State:
        """The state where it is: all of it, so that what follows does not hang on how one came here."""
        return self._last.state

    @state.setter
    def state(self, state: State) -> None:
        if self._busy:
            raise ArgumentError("this stepper is at work in another thread: make one for each")
        # A step of no length: what stands there is shown, and a state of another run is refused.
        self._last = self._run(state, max(state.time, self._dt * 1e-9))
        self._state = state

    def __repr__(self) -> str:
        return f"<Stepper of case {self._case!r} at {self.t:g} of {self._end:g} s>"
