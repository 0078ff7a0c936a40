"""Models: reading, building, facts, checks, modes."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import FOOT, MODELS

import trilith as tl


def test_a_file_is_read_with_other_values_of_its_parameters() -> None:
    m = tl.load(MODELS / "rigid_block.ron", mu=0.2, height="5 m", pull=np.int64(0), ah=np.float32(1.5))
    assert m.title == "Rigid block under sine pulses"
    assert m.parameters["mu"] == 0.2 and m.parameters["height"] == 5.0 and m.parameters["pull"] == 0.0
    assert m.parameter_units["kn"] == "N/m" and m.parameter_units["mu"] == "1"
    assert m.nodes["cg"] == (0.0, 0.0, 2.5)
    assert m.elements["foot left"] == tl.Element("foot left", "NLink", "link", ("left",))
    assert m.links == ["foot left", "foot right"]
    assert m.cases["gravity"].kind == "static" and m.cases["gravity"].dt is None
    assert m.cases["pulse"] == tl.Case("pulse", "dynamic", "gravity", 4.0, 1e-3, "fna")
    assert m.outputs["rotation"] == "rad"
    assert "mu: 0.2" in m.resolved() or "0.2" in m.resolved()
    assert "7 elements" not in repr(m) and "2 of them links" in repr(m)


def test_parameters_are_changed_in_another_model(foot: tl.Model) -> None:
    other = foot.with_parameters(mu=0.1).with_parameters({"a": "2 m/s^2"})
    assert (other.parameters["mu"], other.parameters["a"]) == (0.1, 2.0)
    assert foot.parameters["mu"] == 0.3
    assert other.with_parameters(mu=0.5).parameters == {"mu": 0.5, "a": 2.0}


def test_models_pickle_and_copy(foot: tl.Model) -> None:
    m = foot.with_parameters(mu=0.1)
    again = pickle.loads(pickle.dumps(m))
    assert again == m and again != foot and hash(again) == hash(m)
    assert again.parameters == m.parameters
    assert copy.copy(m) is m and copy.deepcopy(m) is m


def test_a_pickled_model_finds_its_files() -> None:
    m = tl.load(MODELS / "rigid_block_record.ron")
    assert pickle.loads(pickle.dumps(m)).sha256 == m.sha256


def test_files_of_a_text_are_looked_for_in_its_folder() -> None:
    text = (MODELS / "rigid_block_record.ron").read_text(encoding="utf-8")
    assert tl.loads(text, folder=MODELS).sha256 == tl.load(MODELS / "rigid_block_record.ron").sha256
    with pytest.raises(tl.ModelError, match="cannot be read"):
        tl.loads(text, folder=MODELS / "studies")


def test_a_model_built_of_objects_is_the_model_of_the_file(foot: tl.Model) -> None:
    built = tl.Model(
        title="A foot",
        plane="XZ",
        gravity="1 g",
        parameters={"mu": 0.3, "a": "4 m/s^2"},
        nodes={"cg": (0, 0, 0)},
        elements={
            "mass": tl.Mass(node="cg", mass="1 t", inertia=(0, 1, 0)),
            "upright": tl.Spring(node="cg", r3="1 MN*m"),
            "foot": tl.NLink(node="cg", kn="10 MN/m", ks=1e7, mu="mu", damping="10 kN*s/m"),
        },
        functions={"pulse": tl.Sine(amplitude="a", frequency="2 Hz", cycles=1)},
        cases={
            "gravity": tl.Static(loads=[tl.Gravity]),
            "shake": tl.Dynamic(
                after="gravity",
                duration="1 s",
                dt="5 ms",
                base=[{"direction": "X", "function": "pulse"}],
            ),
        },
        outputs={
            "slide": tl.Displacement(node="cg", dof="Ux"),
            "lift": tl.Displacement(node="cg", dof=tl.Uz),
        },
    )
    assert built.resolved() == foot.resolved()
    assert pickle.loads(pickle.dumps(built)).resolved() == foot.resolved()


def test_dicts_and_words_and_arrays_are_written_as_a_file_has_them() -> None:
    m = tl.Model(
        plane="XZ",
        units={"length": "in", "force": "kip"},
        nodes={"a": np.zeros(3), "b": [0, 0, 10.0], 'q"uote\n': (1, 0, 0)},
        supports={"a": "Fixed", 'q"uote\n': ["Ux", tl.Uz, "Ry"]},
        elements={
            "c": tl.Spring(nodes=("a", "b"), k1=10, k2=1, r2=1, r3=1),
            "m": tl.Mass(node="b", mass=np.float64(0.01)),
        },
        loads={"push": [{"node": "b", "dof": "Ux", "force": 2.5}]},
        damping=tl.Modal(ratio=0.02),
        cases={
            "push": tl.Static(loads=[{"load": "push", "factor": 2}]),
            "swing": tl.Dynamic(
                duration=1, dt=0.01, after="push", step=tl.Fixed(substeps=2), solver="Hht", alpha=None
            ),
        },
        outputs={"x": tl.Displacement(node="b", dof="Ux", factor=-1)},
    )
    assert m.nodes["b"] == (0.0, 0.0, pytest.approx(0.254))
    assert m.cases["swing"].solver == "hht"
    r = m.run()
    # 5 kip on 1 kip/in, with the sign turned.
    assert r["x"][0] == pytest.approx(-5 * 0.0254, rel=1e-9)


def test_errors_of_built_models_are_those_of_the_reader() -> None:
    with pytest.raises(tl.ModelError) as e:
        tl.Model(
            nodes={"a": (0, 0, float("nan"))},
            elements={"m": tl.Mass(node="b", mass="-1 kg")},
            cases={"g": tl.Static(loads=[tl.Gravity])},
            suports={"a": tl.Fixed},
        )
    text = str(e.value)
    assert "did you mean `supports`" in text and "^" in text and "model.ron:" in text
    assert len(e.value.diagnostics) >= 3
    assert all(d.level == "error" and d.line > 0 for d in e.value.diagnostics)
    with pytest.raises(TypeError, match="unexpected keyword argument 'mas'"):
        tl.Mass(node="a", mas=1)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="no form for"):
        tl.Model(nodes={"a": object()})
    with pytest.raises(TypeError, match="names in a model are texts"):
        tl.Model(nodes={1: (0, 0, 0)})  # type: ignore[dict-item]


def test_checks_tell_warnings_and_the_errors_of_an_assembly() -> None:
    assert tl.load(MODELS / "rigid_block.ron").check() == []
    loose = tl.loads(FOOT.replace('"upright": Spring(node: "cg", r3: "1 MN*m"),', ""))
    [found] = loose.check()
    assert found.level == "error" and "cg" in found.message and found.line > 0
    assert found.file == "model.ron"
    doubtful = tl.load(MODELS / "rocking_body.ron").check()
    assert all(d.level == "warning" for d in doubtful)


def test_modes() -> None:
    m = tl.load(MODELS / "isolated_frame.ron")
    modes = m.modes()
    assert len(modes) == len(modes.frequency) == len(modes.mass_participation) > 10
    assert np.all(np.diff(modes.frequency) >= 0)
    assert 0.99 < modes.mass_participation[:, 0].sum() < 1.0001
    assert min(modes.adequacy.values()) > 0.9
    assert modes.shapes[min(modes.shapes)].shape == (len(m.nodes), 6)
    assert not modes.omega.flags.writeable
    assert "period [s]" in str(modes) and "<table>" in modes._repr_html_()
    again = pickle.loads(pickle.dumps(modes))
    assert np.array_equal(again.omega, modes.omega)


def test_modes_with_links() -> None:
    text = """(
        plane: XZ,
        nodes: { "m": (0, 0, 0) },
        supports: { "m": (Uz, Ry) },
        elements: {
            "mass": Mass(node: "m", mass: "100 kg"),
            "bearing": Wen(node: "m", axis1: (1, 0, 0), k: "4 kN/m", fy: "200 N", ratio: 0.1),
        },
        cases: { "shake": Dynamic(duration: "1 s", dt: "10 ms", base: [(direction: X, function: "wave")]) },
        functions: { "wave": Sine(amplitude: "1 m/s^2", frequency: "1 Hz") },
        outputs: { "x": Displacement(node: "m", dof: Ux) },
    )"""
    m = tl.loads(text)
    engaged = m.modes(links="engaged")
    assert len(engaged) == 1 and engaged.damping.size == 0
    assert engaged.omega[0] == pytest.approx((4000 / 100) ** 0.5)
    assert engaged.mass_participation[0, 0] == pytest.approx(1.0)
    assert engaged.shapes[0].shape == (1, 6) and "period [s]" in str(engaged)
    assert m.modes(links="open").omega[0] == 0.0
    again = pickle.loads(pickle.dumps(engaged))
    assert np.array_equal(again.omega, engaged.omega)
    for wrong in (
        lambda: m.modes(links="stiff"),
        lambda: m.modes(links="secant"),
        lambda: m.modes(links="secant", amplitude=-1.0),
        lambda: m.modes(links="engaged", amplitude=0.1),
        lambda: m.modes(links="secant", amplitude=0.1, of="nothing"),
        lambda: m.modes(amplitude=0.1),
        lambda: m.modes("shake", links="engaged"),
        lambda: m.modes(links="tangent", after="nowhere"),
    ):
        with pytest.raises(tl.ArgumentError):
            wrong()
    isolated = tl.load(MODELS / "isolated_frame.ron")
    secant = isolated.modes(links="secant", amplitude=0.2, count=4)
    assert len(secant.damping) == len(secant) == 4 and secant.damping[0] > 0.05
    assert secant.period[0] > isolated.modes(links="engaged", count=4).period[0]


def test_the_catalogue() -> None:
    cards = tl.elements()
    card = cards["NLink"]
    assert card.category == "link" and card.parameters[0].unit == "N/m"
    assert {c.category for c in cards.values()} == {"linear", "constraint", "link"}
    assert all(issubclass(getattr(tl, kind), tl.Block) for kind in cards)
    assert "kn" in (getattr(tl, "NLink").__doc__ or "")
    with pytest.raises(KeyError, match='did you mean "NLink"'):
        cards["Nlink"]


def test_the_classes_are_those_of_the_cards_and_the_schema() -> None:
    """`python tools/blocks.py` makes the file again."""
    import importlib.util

    import trilith.blocks

    tool = Path(__file__).resolve().parents[1] / "tools/blocks.py"
    spec = importlib.util.spec_from_file_location("blocks_tool", tool)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    committed = tool.parents[1] / "python/trilith/blocks.py"
    assert module.text() == committed.read_text(encoding="utf-8")
    # No name hides another.
    assert not set(trilith.blocks.__all__) & set(tl.__all__)
    assert set(trilith.blocks.__all__) <= set(dir(tl))


def test_the_sections_of_a_built_model_are_those_of_the_schema() -> None:
    """Others go to the reader as they are."""
    import inspect

    from trilith import _native

    [(_, _, _, fields)] = next(blocks for name, _, blocks in _native.schema() if name == "model")
    known = set(inspect.signature(tl.Model).parameters) - {"folder", "laws", "more"}
    assert known <= {f[0] for f in fields}
