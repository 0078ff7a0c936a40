"""Combinations of cases."""

import math

import pytest

import trilith as tl

COLUMN = """(
    title: "Column",
    plane: XZ,
    nodes: { "base": (0, 0, 0), "top": (0, 0, 4) },
    supports: { "base": Fixed },
    elements: {
        "column": Beam(nodes: ("base", "top"), young: "200 GPa", area: "0.02 m^2", i3: "8e-5 m^4"),
        "mass": Mass(node: "top", mass: "2 t"),
    },
    loads: { "wind": [(node: "top", dof: Ux, force: "3 kN")] },
    cases: {
        "wind": Static(loads: ["wind"]),
        "swing": Dynamic(duration: "1 s", dt: "5 ms", initial: [(node: "top", dof: Ux, displacement: "-2 cm")]),
    },
    combinations: {
        "twice": LinearAdd(cases: { "wind": 2 }),
        "most": Envelope(cases: ["twice", "swing"]),
    },
    outputs: { "sway": Displacement(node: "top", dof: Ux) },
)"""


def test_sums_and_envelopes() -> None:
    m = tl.loads(COLUMN)
    told: list[float] = []
    found = m.combine(progress=told.append)
    assert list(found) == ["twice", "most"] and list(found.cases) == ["wind", "swing"]
    wind = 3e3 * 4**3 / (3 * 200e9 * 8e-5)
    twice, most = found["twice"], found["most"]["sway"]
    assert twice.how == "LinearAdd" and twice.terms == {"wind": 2.0}
    assert math.isclose(twice["sway"].max, 2 * wind, rel_tol=1e-9) and twice["sway"].max_from is None
    assert math.isclose(most.max, 0.02, rel_tol=1e-4) and most.max_from == "swing" == most.min_from
    assert most.unit == "m" and found.cases["swing"]["sway"].min == most.min
    assert "most: Envelope of" in str(found) and "twice, most" in repr(found)
    assert list(m.combine(["twice"]).cases) == ["wind"]
    assert all(0 <= share <= 1 for share in told)


def test_what_is_refused() -> None:
    m = tl.loads(COLUMN)
    with pytest.raises(tl.ArgumentError, match="did you mean `most`"):
        m.combine(["mots"])
    with pytest.raises(tl.ArgumentError, match="list of names"):
        m.combine("most")
    with pytest.raises(KeyError, match="there is no output"):
        m.combine()["most"]["drift"]
    start, end = COLUMN.index("    combinations"), COLUMN.index("    outputs")
    with pytest.raises(tl.ArgumentError, match="no combination"):
        tl.loads(COLUMN[:start] + COLUMN[end:]).combine()


def test_a_model_made_of_objects() -> None:
    push = [{"node": "top", "dof": tl.Word("Ux"), "force": "3 kN"}]
    m = tl.Model(
        plane="XZ",
        nodes={"base": (0, 0, 0), "top": (0, 0, 4)},
        supports={"base": "Fixed"},
        elements={
            "column": tl.Beam(nodes=("base", "top"), young="200 GPa", area="0.02 m^2", i3="8e-5 m^4"),
            "mass": tl.Mass(node="top", mass="2 t"),
        },
        loads={"wind": push},
        cases={"wind 1": tl.Static(loads=["wind"]), "dead": tl.Static(loads=[tl.Gravity])},
        combinations={"sum": tl.LinearAdd(cases={"wind 1": 1.5, "dead": 1.35})},
        outputs={"sway": tl.Displacement(node="top", dof="Ux")},
    )
    assert m.combine()["sum"].terms == {"wind 1": 1.5, "dead": 1.35}
