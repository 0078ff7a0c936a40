"""What an answer of a law in plain Python costs, against the same compiled by numba.

    python tools/speed_of_laws.py        # with the package and numba installed

A mass on a spring that slips is run both ways; the answers are counted, and what plain Python takes longer is divided by their
number.
"""

from __future__ import annotations

import time
from typing import Any

import trilith as tl


class Slider(tl.Law):
    """Spring that slips."""

    k: float = tl.parameter("N/m")
    fy: float = tl.parameter("N")
    history = {"slip": "m"}
    rates = False
    compiled = True

    def force(self, d: Any, v: Any, history: Any) -> Any:
        q = min(max(self.k * (d[0] - history.slip), -self.fy), self.fy)
        return q, (d[0] - q / self.k,)

    def tangent(self, d: Any, v: Any, history: Any) -> Any:
        return self.k if abs(self.k * (d[0] - history.slip)) < self.fy else 0.0

    def energy(self, d: Any, v: Any, history: Any, step: Any) -> Any:
        q = self.k * (d[0] - history.slip)
        return 0.5 * q * q / self.k, q * (history.slip - step.history0.slip), 0.0


class Counted(Slider):
    """The same in plain Python."""

    compiled = False
    calls = 0

    def force(self, d: Any, v: Any, history: Any) -> Any:
        Counted.calls += 1
        return Slider.force(self, d, v, history)


#: Runs, of which the shortest counts.
RUNS = 20


def model(law: type[tl.Law]) -> tl.Model:
    """A mass that shakes on a link of the law."""
    return tl.Model(
        plane="XZ",
        nodes={"m": (0, 0, 0)},
        supports={"m": ("Uz", "Ry")},
        elements={"mass": tl.Mass(node="m", mass="1 t"), "l": law(node="m", k="100 kN/m", fy="2 kN", axis1=(1, 0, 0))},
        functions={"shake": tl.Sine(amplitude="0.3 g", frequency="2 Hz", cycles=20)},
        cases={"shake": tl.Dynamic(duration="1 s", dt="2 ms", base=[{"direction": "X", "function": "shake"}])},
        outputs={"x": tl.Displacement(node="m", dof="Ux")},
        laws=[law],
    )


def least(m: tl.Model) -> float:
    """The shortest of some runs, s."""

    def once() -> float:
        start = time.perf_counter()
        m.run(errors=False)
        return time.perf_counter() - start

    return min(once() for _ in range(RUNS))


if __name__ == "__main__":
    compiled, plain = least(model(Slider)), least(model(Counted))
    calls = Counted.calls / RUNS
    print(f"{calls:.0f} answers: {compiled:.3f} s compiled, {plain:.3f} s in plain Python")
    print(f"plain Python takes {1e6 * (plain - compiled) / calls:.1f} µs longer for an answer")
