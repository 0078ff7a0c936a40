"""Derivatives by parameters, and parameters that make a goal smallest."""

from __future__ import annotations

import numpy as np
import pytest

import trilith as tl

#: A mass that strikes an isolator. Its largest acceleration is smallest with c/(2√(km)) = 0.265, which c = 530 N·s/m is.
ISOLATOR = """(
    parameters: { "c": "300 N*s/m", "k": "10 kN/m", "unused": 1 },
    plane: XZ,
    nodes: { "m": (0, 0, 0) },
    supports: { "m": (Uz, Ry) },
    elements: {
        "mass": Mass(node: "m", mass: "100 kg"),
        "spring": Spring(node: "m", k2: "k"),
        "damper": Dashpot(node: "m", axis: U2, c: "c"),
    },
    cases: {
        "rest": Static(loads: [Gravity]),
        "strike": Dynamic(
            duration: "0.3 s", dt: "2 ms", solver: Hht,
            initial: [(node: "m", dof: Ux, velocity: "1 m/s")],
        ),
    },
    outputs: { "x": Displacement(node: "m", dof: Ux), "acceleration": Acceleration(node: "m", dof: Ux) },
)"""


@pytest.fixture(scope="module")
def isolator() -> tl.Model:
    return tl.loads(ISOLATOR)


def test_derivatives_are_those_of_runs_beside(isolator: tl.Model) -> None:
    assert isolator.gradient(by=["c"], of=["x"]).input is None
    g = isolator.gradient(by=["c", "k"], of=["x", "input"])
    assert list(g) == ["x"] and g.parameters == {"c": 300.0, "k": 10000.0} and g.units["c"] == "N·s/m"
    x = g["x"]
    assert x.unit == "m" and x.history.shape == g.t.shape == x.by["k"].shape
    assert not x.by["c"].flags.writeable
    assert x.peak.value == x.max.value > 0 >= x.min.value
    assert x.final.value == x.history[-1] and x.final.by["c"] == x.by["c"][-1]
    for name, value in g.parameters.items():
        h = 1e-2 * value
        low, high = (isolator.with_parameters({name: value + s * h}).run()["x"] for s in (-1, 1))
        apart = np.abs(x.by[name] - (high - low) / (2 * h)).max()
        assert apart < 2e-2 * np.abs(x.by[name]).max()
    assert g.input is not None and g.input.value == 0.0 == g.input.by["c"]  # it sets out with a velocity: no load puts anything in
    assert list(g.heat) == ["damper"] and 20 < g.heat["damper"].value < 50 and g.heat["damper"].by["c"] > 0
    assert "x" in str(g) and "by c, k" in repr(g)
    assert g.bends == [] and g.substeps >= 150


def test_a_dashpot_is_found(isolator: tl.Model) -> None:
    told: list[float] = []
    o = isolator.optimize({"c": ("50 N*s/m", 2000)}, "acceleration", progress=told.append)
    assert o.stop in ("smallest", "kink") and len(o.runs) <= 20
    assert abs(o.parameters["c"] / 2000 - 0.265) < 0.01 and o.units == {"c": "N·s/m"}
    # To rounding: bounds are kept by a change of variables.
    assert abs(o.runs[0].parameters["c"] - 300.0) < 1e-9 and o.goal < (o.runs[0].goal or 0)
    best = isolator.with_parameters(o.parameters).run(solver="hht").peaks["acceleration"].magnitude
    # Peaks of a run are looked for between its substeps as well.
    assert abs(best / o.goal - 1) < 1e-4
    assert o.holds and o.limits == [] and "best: run" in str(o) and "Optimum" in repr(o)


def test_limits_hold(isolator: tl.Model) -> None:
    by = {"c": (50, 2000), "k": ("1 kN/m", "100 kN/m")}
    o = isolator.optimize(by, "x", ["acceleration <= 6 m/s^2"], log=["k"])
    [limit] = o.limits
    assert limit.holds and o.holds and limit.bound == 6.0 and limit.multiplier > 0
    # x a / v² = 0.5206 at best, whatever the limit.
    assert abs(o.goal * 6.0 - 0.5206) < 0.005


def test_what_is_refused(isolator: tl.Model, foot: tl.Model) -> None:
    with pytest.raises(tl.ArgumentError, match="did you mean"):
        isolator.gradient(by=["cc"])
    with pytest.raises(tl.ArgumentError, match="no output"):
        isolator.gradient(of=["y"])
    with pytest.raises(tl.ArgumentError, match="list of names"):
        isolator.gradient(by="c")
    with pytest.raises(tl.ArgumentError, match="no case"):
        isolator.gradient(case="struck")
    with pytest.raises(tl.RunError, match="static"):
        isolator.gradient(case="rest")
    with pytest.raises(tl.ArgumentError, match="bounds"):
        isolator.optimize({"c": (2, 1)}, "x")
    with pytest.raises(tl.ArgumentError, match="two bounds"):
        isolator.optimize({"c": "1..2"}, "x")
    with pytest.raises(tl.ArgumentError, match="no parameter"):
        isolator.optimize({"c": (50, 2000)}, "xx")
    with pytest.raises(tl.ArgumentError, match="<="):
        isolator.optimize({"c": (50, 2000)}, "x", ["acceleration"])
    with pytest.raises(tl.ArgumentError, match="list of limits"):
        isolator.optimize({"c": (50, 2000)}, "x", "acceleration <= 6")
    with pytest.raises(tl.ArgumentError, match="unused"):
        isolator.optimize({"unused": (0.5, 2)}, "x")
    with pytest.raises(tl.ArgumentError, match="max_runs"):
        isolator.optimize({"c": (50, 2000)}, "x", max_runs=0)
    assert foot.optimize({"mu": (0.1, 0.5)}, "slide", max_runs=3).stop in ("spent", "kink", "smallest")


def test_a_structure_that_moves_has_its_modes_move_with_it() -> None:
    # The mass and its damper hang on one parameter: under FNA the basis moves with it.
    structure = tl.loads(ISOLATOR.replace('mass: "100 kg"', 'mass: "c*1 s"'))
    fna, hht = (structure.gradient(by=["c"], solver=solver)["x"] for solver in ("fna", "hht"))
    assert abs(fna.peak.by["c"] / hht.peak.by["c"] - 1) < 1e-3
    found = structure.optimize({"c": (50, 2000)}, "x", solver="fna", max_runs=5)
    assert found.goal < found.runs[0].goal
