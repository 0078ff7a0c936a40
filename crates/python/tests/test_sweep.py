"""Sweeps, studies, comparisons, exercises, records."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import FOOT, MODELS

import trilith as tl


def test_a_grid_in_lanes_has_the_numbers_of_single_runs(foot: tl.Model) -> None:
    mus, amplitudes = [0.2, 0.25, 0.3], np.linspace(2.0, 5.0, 4)
    s = tl.sweep(foot, {"mu": mus, "a": amplitudes})
    assert s.shape == (3, 4) and s.runs == 12 and s.good.all() and set(s.engine) == {"lanes"}
    assert s.parameters["mu"][:5] == [0.2, 0.2, 0.2, 0.2, 0.25]
    slide = s.grid("slide")
    assert slide.shape == (3, 4) and np.all(np.diff(slide[:, -1]) < 0)
    for i, j in ((0, 3), (2, 0)):
        one = foot.with_parameters(mu=mus[i], a=float(amplitudes[j])).run(errors=False)
        assert slide[i, j] == pytest.approx(one.peaks["slide"].magnitude, rel=2e-3, abs=1e-6)
    assert s.numbers["energy.error_relative"].max() < 1e-3 and s.numbers["steps"].min() >= 200
    frame = s.to_pandas()
    assert frame.shape[0] == 12 and {"mu", "a", "slide.max", "status"} <= set(frame)
    assert s.to_polars().height == 12 and s.to_arrow().num_rows == 12
    again = pickle.loads(pickle.dumps(s))
    assert np.array_equal(again["slide"], s["slide"]) and not again.peaks["slide"].max.flags.writeable
    assert "12 runs" in repr(s) and "<table>" in s._repr_html_()
    with pytest.raises(KeyError, match="did you mean"):
        s["slid"]


def test_lists_threads_and_fixed_steps(foot: tl.Model) -> None:
    values = {"mu": [0.2, 0.3], "a": ["4 m/s^2", "0.5 g"]}
    one = tl.sweep(foot, values, how="list", threads=1, fixed_steps=2)
    two = tl.sweep(foot, values, how="list", threads=2, fixed_steps=2)
    assert one.runs == 2 and one.shape == (2,) and np.array_equal(one["slide"], two["slide"])
    assert one.parameters["a"] == ["4 m/s^2", "0.5 g"]


def test_values_that_the_model_was_read_with_hold_in_a_sweep(foot: tl.Model) -> None:
    weak = foot.with_parameters(a=2.0)
    s = tl.sweep(weak, {"mu": [0.1, 0.15]})
    assert s["slide"][0] == pytest.approx(foot.with_parameters(mu=0.1, a=2.0).run().peaks["slide"].magnitude, rel=2e-3)


def test_a_row_says_what_went_wrong_with_it(foot: tl.Model) -> None:
    s = tl.sweep(foot, {"mu": [0.3, -1.0]})
    assert s.good.tolist() == [True, False] and s.status[1] == "model error"
    assert "^" in s.messages[1] and np.isnan(s["slide"][1])


def test_sweeps_that_are_none(foot: tl.Model) -> None:
    for values, told in [
        ({}, "nothing to sweep"),
        ({"mu": []}, "no values"),
        ({"mu": 0.3}, "must be a list"),
        ({"mu": "0.3"}, "must be a list"),
        ({"mu": np.zeros((2, 2))}, "one dimension"),
        ({"mu": [0.1, float("nan")]}, "value 1 of 'mu' is no finite number"),
        ({"mu": [0.1, None]}, "must be a number or a text"),
        ({"nu": [0.1]}, "did you mean `mu`"),
    ]:
        with pytest.raises(tl.ArgumentError, match=told):
            tl.sweep(foot, values)  # type: ignore[arg-type]
    with pytest.raises(tl.ArgumentError, match="one length"):
        tl.sweep(foot, {"mu": [0.1, 0.2], "a": [1.0]}, how="list")
    with pytest.raises(tl.ArgumentError, match='"grid" or "list"'):
        tl.sweep(foot, {"mu": [0.1]}, how="both")  # type: ignore[arg-type]
    with pytest.raises(tl.ArgumentError, match="no case"):
        tl.sweep(foot, {"mu": [0.1]}, case="quake")
    with pytest.raises(tl.ArgumentError, match="threads"):
        tl.sweep(foot, {"mu": [0.1]}, threads=0)


def test_a_study_into_a_folder(tmp_path: Path) -> None:
    study = tmp_path / "small.ron"
    (tmp_path / "foot.ron").write_text(FOOT, encoding="utf-8")
    study.write_text(
        '(title: "Small", model: "foot.ron", axes: { "mu": [0.2, 0.3], "a": [2, 4, 6] }, columns: { "slide": Peak("slide") })',
        encoding="utf-8",
    )
    shares: list[float] = []
    found = tl.study(study, out=tmp_path / "out", progress=shares.append)
    assert found.title == "Small" and found.runs == 6 and found.failed == 0 and found.beside == 6
    assert found["mu"].tolist() == [0.2, 0.2, 0.2, 0.3, 0.3, 0.3]
    assert found["slide"].max() > 1e-3 and found.units["slide"] == "m"
    assert found["status"] == ["converged"] * 6
    assert found.to_pandas().shape[0] == 6 and found.page.is_file()
    again = tl.study(study, out=tmp_path / "out")
    assert again.resumed == 6 and np.array_equal(again["slide"], found["slide"])
    assert pickle.loads(pickle.dumps(found))["slide"].tolist() == found["slide"].tolist()
    with pytest.raises(tl.FileError, match="another study"):
        tl.study(study, out=tmp_path / "out", mu=0.1, a="1 m/s^2")
    study.write_text('(title: "Small", modl: "foot.ron")', encoding="utf-8")
    with pytest.raises(tl.ModelError, match="did you mean `model`"):
        tl.study(study, out=tmp_path / "other")
    with pytest.raises(KeyError, match="column"):
        found["nothing"]


def test_ways_to_solve_a_case_are_compared(foot: tl.Model) -> None:
    c = foot.compare(["hht", "fna"])
    assert [v.label for v in c] == ["hht", "fna"] and len(c) == 2
    assert c[0].differences == {} and c["fna"].differences["slide"].peak < 0.05
    assert c["fna"].cause is not None and c["fna"].finding
    assert c["fna"].result.solver == "fna" and len(c["fna"].result["slide"]) == 201
    assert "peaks; differences relative to hht" in str(c)
    assert "<table>" in c._repr_html_()
    assert tl.compare(foot, dts=[0.005, 0.01], cause=False)[1].cause is None
    with pytest.raises(tl.ArgumentError, match="two solvers"):
        foot.compare(["fna"])
    with pytest.raises(tl.ArgumentError, match="a list of solvers"):
        foot.compare("fna")
    with pytest.raises(tl.ArgumentError, match="static"):
        foot.compare(case="gravity")
    with pytest.raises(tl.ArgumentError, match="dts"):
        foot.compare(dts=[0.01, -1.0])
    with pytest.raises(KeyError, match="did you mean"):
        c["fnaa"]
    with pytest.raises(tl.TrilithError):
        c[0].result.html()


def test_a_link_on_its_own() -> None:
    e = tl.exercise("Wen", amplitude={"U2": "5 cm"}, cycles=2)
    d, f = e.loop()
    assert len(d) == len(f) == len(e.t) and abs(d).max() == pytest.approx(0.05, rel=1e-3)
    assert e.last_cycle["U2"].area > 0 and 0 < (e.last_cycle["U2"].damping or 0) < 2 / np.pi
    assert e.energy_error < 1e-3 and e.energy["work"][-1] > 0
    assert e.svg()[0].startswith("<svg") and "Wen" in e.line and "<svg" in e._repr_html_()
    stiff = tl.exercise("Gap", k="2 MN/m")
    closed = abs(stiff.force["U1"]) > 0
    soft = tl.exercise("Gap", k="1 MN/m")
    assert closed.any() and np.allclose(stiff.force["U1"], 2 * soft.force["U1"], rtol=1e-9)


def test_a_link_along_a_path() -> None:
    path = 0.05 * np.sin(np.linspace(0.0, 4 * np.pi, 200))
    e = tl.exercise("Wen", path, dt=0.01)
    assert e.t[-1] == pytest.approx(1.99)
    # The samples are met where they stand.
    at = np.searchsorted(e.t, np.arange(200) * 0.01 - 1e-9)
    assert np.allclose(e.deformation["U2"][at], path, atol=1e-12)
    named = tl.exercise("Wen", {"U2": path}, t=np.arange(200) * 0.01)
    assert np.array_equal(named.force["U2"], e.force["U2"])
    assert e.last_cycle == {}


def test_exercises_that_are_none() -> None:
    path = [0.0, 0.1, 0.0]
    for call, told in [
        (lambda: tl.exercise("Wan"), "did you mean `Wen`"),
        (lambda: tl.exercise("Beam"), "only links can be exercised"),
        (lambda: tl.exercise("Wen", {"U9": path}), "no coordinate"),
        (lambda: tl.exercise("Wen", {}), "moves no coordinate"),
        (lambda: tl.exercise("Wen", [0.0, float("nan"), 1.0]), "no finite number at index 1"),
        (lambda: tl.exercise("Wen", np.zeros((3, 2))), "one dimension"),
        (lambda: tl.exercise("Wen", ["a", "b"]), "dtype"),
        (lambda: tl.exercise("Wen", np.array([True, False])), "dtype is bool"),
        (lambda: tl.exercise("Wen", [0.1]), "at least 2"),
        (lambda: tl.exercise("Wen", path, t=[0.0, 0.1]), "3 values for 2 times"),
        (lambda: tl.exercise("Wen", path, t=[0.0, 0.2, 0.1]), "time must rise"),
        (lambda: tl.exercise("Wen", path, dt=0.0), "dt must be"),
        (lambda: tl.exercise("Wen", cycles=0), "cycles"),
        (lambda: tl.exercise("Wen", amplitude={"U2": "5 kg"}), "amplitude"),
    ]:
        with pytest.raises(tl.ArgumentError, match=told):
            call()
    with pytest.raises(tl.ModelError, match="did you mean"):
        tl.exercise("Wen", exponnt=2)
    with pytest.raises(tl.ModelError):
        tl.exercise("Wen", k=-1.0)


def test_records(tmp_path: Path) -> None:
    file = MODELS / "records/synthetic_1.csv"
    [r, *more] = tl.records(file, unit="g")
    assert len(r) == len(r.t) == len(r.acceleration) and r.t[1] == r.dt
    assert r.measures["pga"] == pytest.approx(abs(r.acceleration).max())
    assert r.measures["pgv"] == pytest.approx(abs(r.velocity).max())
    assert r.measures["pgd"] == pytest.approx(abs(r.displacement).max())
    s = r.spectrum([0.1, 1.0], damping=0.02)
    assert s.psa.shape == (2,) and np.allclose(s.psa, s.sd * (2 * np.pi / s.period) ** 2)
    assert r.spectrum().period.shape == (150,)
    if more:
        with pytest.raises(tl.ArgumentError, match="components"):
            tl.record(file, unit="g")
    one = tl.record(file, component=1, unit="g")
    assert np.array_equal(one.acceleration, r.acceleration)
    assert np.array_equal(pickle.loads(pickle.dumps(one)).acceleration, r.acceleration)
    saved = tl.record(one.save(tmp_path / "saved.csv"))
    assert np.allclose(saved.acceleration, r.acceleration, rtol=1e-12)
    made = tl.GroundMotion(9.81 * np.sin(np.arange(100) * 0.1), 0.01, component="X")
    assert made.dt == 0.01 and made.component == "X" and "100 samples" in repr(made)
    seeded = tl.synthetic(7, peak=3.0, duration=5.0)
    assert np.array_equal(seeded.acceleration, tl.synthetic(7, peak=3.0, duration=5.0).acceleration)
    assert seeded.measures["pga"] == pytest.approx(3.0)


def test_records_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(tl.FileError, match="cannot be read"):
        tl.records("no/such/file.at2")
    file = tmp_path / "a.csv"
    file.write_text("t,a\n0,0\n0.1,1\n0.2,0\n")
    with pytest.raises(tl.ArgumentError, match="unit"):
        tl.record(file)
    assert tl.record(file, unit="g").measures["pga"] == pytest.approx(9.80665)
    with pytest.raises(tl.ArgumentError, match="no unit of acceleration"):
        tl.record(file, unit="apples")
    with pytest.raises(tl.ArgumentError, match="component"):
        tl.record(file, unit="g", component="Z")
    for bad, told in [([1.0], "at least 2"), ([0.0, float("nan")], "finite"), (np.zeros((2, 2)), "dimension")]:
        with pytest.raises(tl.ArgumentError, match=told):
            tl.GroundMotion(bad, 0.01)  # type: ignore[arg-type]
    with pytest.raises(tl.ArgumentError, match="dt"):
        tl.GroundMotion([0.0, 1.0], -0.01)
    made = tl.GroundMotion([0.0, 1.0], 0.01)
    with pytest.raises(tl.ArgumentError, match="no period"):
        made.spectrum([0.0])
    with pytest.raises(tl.ArgumentError, match="damping"):
        made.spectrum([1.0], damping=2.0)
