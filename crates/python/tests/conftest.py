"""What the tests share. They run against the installed package, from the wheel: `crates/python/README.md` says how."""

from __future__ import annotations

from pathlib import Path

import pytest

import trilith as tl

ROOT = Path(__file__).resolve().parents[3]
MODELS = ROOT / "models"

#: A mass on a friction contact under a sine: quick, and it slides.
FOOT = """(
    title: "A foot",
    plane: XZ, gravity: "1 g", parameters: { "mu": 0.3, "a": "4 m/s^2" },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
        "upright": Spring(node: "cg", r3: "1 MN*m"),
        "foot": NLink(node: "cg", kn: "10 MN/m", ks: "10 MN/m", mu: "mu", damping: "10 kN*s/m"),
    },
    functions: { "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "1 s", dt: "5 ms",
            base: [(direction: X, function: "pulse")]),
    },
    outputs: {
        "slide": Displacement(node: "cg", dof: Ux),
        "lift": Displacement(node: "cg", dof: Uz),
    },
)
"""

#: The same for minutes: something to be interrupted.
LONG = FOOT.replace('cycles: 1', 'cycles: 100000').replace('duration: "1 s", dt: "5 ms"', 'duration: "20000 s", dt: "1 ms"')


@pytest.fixture(scope="session")
def foot() -> tl.Model:
    """The model of a foot."""
    return tl.loads(FOOT)


@pytest.fixture(scope="session")
def slid(foot: tl.Model) -> tl.Result:
    """Its run."""
    return foot.run()
