"""Results: arrays, what is told, tables, pages, pickles."""

from __future__ import annotations

import copy
import gc
import json
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import FOOT, MODELS

import trilith as tl


def test_histories_are_read_only_arrays_that_are_not_copied(slid: tl.Result) -> None:
    assert list(slid) == ["slide", "lift"] and len(slid) == 2
    slide, t = slid["slide"], slid.t
    assert slide.dtype == np.float64 and slide.shape == t.shape == (201,)
    assert t[0] == 0.0 and t[-1] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        slide[0] = 1.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        slide.flags.writeable = True
    # Two views of the same numbers, in the memory of the library.
    assert not slide.flags.owndata
    other = slid._run.outputs()[0][1]  # type: ignore[union-attr]
    assert np.asarray(other).__array_interface__["data"] == slide.__array_interface__["data"]
    assert slid["slide"] is slide


def test_arrays_outlive_their_result() -> None:
    slide = tl.loads(FOOT).run()["slide"]
    kept = slide.copy()
    gc.collect()
    _ = [np.full(1000, 7.0) for _ in range(1000)]
    assert np.array_equal(slide, kept)


def test_what_is_told(slid: tl.Result) -> None:
    p = slid.peaks["slide"]
    assert p.unit == "m" and p.magnitude == max(abs(p.max), abs(p.min))
    assert p.max >= slid["slide"].max() and p.final == slid["slide"][-1]
    # Friction holds 0.3 g of 0.41 g.
    assert 1e-3 < p.magnitude < 0.1
    assert p.error == slid.errors["slide"] and 0.0 < p.error < 0.1 * p.magnitude
    assert slid.certificate["slide"].keys() == {"reduction", "step"}
    assert slid.status == "converged" and slid.good and slid.solver == "fna" and slid.case == "shake"
    assert slid.work["steps"] == 200 and slid.warnings == []
    assert slid.summary["model"]["title"] == "A foot"
    assert slid.units == {"slide": "m", "lift": "m"}
    assert "slide" in str(slid) and "energy" in str(slid)
    assert "converged" in repr(slid)


def test_energies_balance(slid: tl.Result) -> None:
    e = slid.energy
    assert len(e["input"]) == len(slid.t)
    assert e.error_relative < 1e-3 and e.totals["link_hysteretic"] > 0
    assert e["link_hysteretic"][-1] == pytest.approx(e.totals["link_hysteretic"])


def test_links_and_their_loops(slid: tl.Result) -> None:
    foot = slid.links["foot"]
    assert foot.kind == "NLink" and foot.coordinates[0] == "U1"
    d, f = foot.loop("U2")
    assert len(d) == len(f) == len(slid.t)
    # Friction works on the way of the foot: what the loop encloses is what was dissipated, but for the output steps.
    assert foot.work("U2") == pytest.approx(slid.energy.totals["link_hysteretic"], rel=0.05)
    assert np.array_equal(foot.loop().d, d)
    # The weight stands on it, and the cone is kept.
    assert foot.force["U1"][0] == pytest.approx(-9806.65, rel=1e-6)
    assert np.all(abs(f) <= 0.3 * abs(foot.force["U1"]) + 1.0)


def test_names_that_there_are_not(slid: tl.Result) -> None:
    with pytest.raises(KeyError, match='no output "slid": did you mean "slide"'):
        slid["slid"]
    with pytest.raises(KeyError, match="link"):
        slid.links["hand"]
    with pytest.raises(KeyError, match="coordinate"):
        slid.links["foot"].loop("U9")
    with pytest.raises(KeyError, match="did you mean"):
        slid.peaks["slid"]
    with pytest.raises(KeyError, match="energy"):
        slid.energy["heat"]


def test_tables_of_three_libraries(slid: tl.Result) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    pytest.importorskip("pandas")
    pytest.importorskip("polars")
    frame = slid.to_pandas()
    assert frame.index.name == "t" and list(frame) == ["slide", "lift"]
    assert np.array_equal(frame["slide"].to_numpy(), slid["slide"])
    polars = slid.to_polars(energy=True)
    assert polars.columns[:3] == ["t", "slide", "lift"] and "energy.input" in polars.columns
    table = slid.to_arrow()
    assert table.column_names == ["t", "slide", "lift"]
    assert table.schema.field("slide").metadata == {b"unit": b"m"}
    # Not copied: the buffer of the table is the memory of the library.
    address = table.column("slide").chunk(0).buffers()[1].address
    assert address == slid["slide"].__array_interface__["data"][0]
    assert pyarrow.table(slid.to_arrow()).equals(table)
    assert pyarrow.RecordBatchReader.from_stream(slid).read_all().equals(table)


def test_pages_and_files(slid: tl.Result, tmp_path: Path) -> None:
    page = slid.report(tmp_path / "x.html")
    text = page.read_text(encoding="utf-8")
    assert text.startswith("<!DOCTYPE html>") and "A foot" in text and "http://" not in text.replace("http://www.w3.org", "")
    assert "foot" in slid.html(loops=["foot"])
    with pytest.raises(tl.ArgumentError, match='there is no link "hand"'):
        slid.html(loops=["hand"])
    files = slid.write(tmp_path / "run")
    assert {"summary.json", "histories.npz", "report.html"} <= {f.name for f in files}
    summary = json.loads((tmp_path / "run/summary.json").read_text())
    assert summary["run_sha256"] == slid.summary["run_sha256"]
    with np.load(tmp_path / "run/histories.npz") as found:
        assert np.array_equal(found["slide"], slid["slide"])
    with pytest.raises(OSError):
        slid.report(tmp_path / "no/such/folder.html")
    (tmp_path / "file").write_text("")
    with pytest.raises(tl.FileError):
        slid.write(tmp_path / "file")


def test_notebooks_show_a_result(slid: tl.Result) -> None:
    html = slid._repr_html_()
    assert html.count("<svg") >= 3 and "slide" in html and "converged" in html
    assert slid.svg("energy")[0].startswith("<svg") and slid.svg("foot")
    with pytest.raises(tl.ArgumentError, match="no figure"):
        slid.svg("nothing")
    assert "<iframe" in slid.show()._repr_html_()


def test_results_pickle_and_copy(slid: tl.Result) -> None:
    again = pickle.loads(pickle.dumps(slid))
    assert again == slid and again is not slid
    assert np.array_equal(again["slide"], slid["slide"]) and not again["slide"].flags.writeable
    assert np.array_equal(again.links["foot"].loop("U2").f, slid.links["foot"].loop("U2").f)
    assert np.array_equal(again.energy["input"], slid.energy["input"])
    assert again.peaks == slid.peaks and str(again) == str(slid)
    assert again.html() == slid.html() and again.state == slid.state
    assert copy.deepcopy(slid) is slid
    with pytest.raises(tl.TrilithError, match="pickled"):
        again.write("anywhere")


def test_static_cases_and_runs_without_histories(foot: tl.Model) -> None:
    gravity = foot.run("gravity")
    assert gravity.solver == "static" and gravity.status == "converged"
    assert gravity.peaks["lift"].final == pytest.approx(-9806.65 / 10e6, rel=1e-6)
    lean = foot.run(histories=False)
    assert len(lean.t) == 0 and len(lean.links) == 0
    assert lean.peaks == foot.run().peaks
    assert "<table>" in lean._repr_html_() and "<table>" in gravity._repr_html_()
    assert len(pickle.loads(pickle.dumps(lean)).t) == 0


def test_options_of_a_run(foot: tl.Model) -> None:
    other = foot.run(solver="hht", dt=0.01, until=0.5, errors=False)
    assert other.solver == "hht" and len(other.t) == 51
    assert other.peaks["slide"].magnitude > 0
    shares: list[float] = []
    m = tl.load(MODELS / "isolated_frame.ron")
    m.run(until=1.0, errors=False, progress=shares.append)
    assert shares == sorted(shares) and all(0.0 <= s <= 1.0 for s in shares)


def test_the_numbers_are_those_of_the_program(tmp_path: Path) -> None:
    """`python -m trilith` is the program."""
    import subprocess
    import sys

    command = [sys.executable, "-m", "trilith", "run", str(MODELS / "rigid_block.ron"), "--out", str(tmp_path / "out")]
    told = subprocess.run([*command, "--set", "duration=0.5"], capture_output=True, text=True, check=True).stdout
    r = tl.load(MODELS / "rigid_block.ron", duration=0.5).run()
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    assert summary["run_sha256"] == r.summary["run_sha256"]
    with np.load(tmp_path / "out/histories.npz") as found:
        assert np.array_equal(found["slide"], r["slide"])
    assert str(r).split("\nwork:")[0] in told
    wrong = subprocess.run([*command[:3], "runn"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and "run" in wrong.stderr


def test_a_run_goes_on_to_the_bit(foot: tl.Model) -> None:
    whole = foot.run(errors=False)
    half = foot.run(until=0.35, errors=False)
    state = pickle.loads(pickle.dumps(half.state))
    rest = foot.run(start=state, errors=False)
    assert rest.t[0] == half.t[-1] == pytest.approx(0.35)
    both = np.concatenate([half["slide"], rest["slide"][1:]])
    assert np.array_equal(both, whole["slide"])
    assert rest.peaks["slide"].max == whole.peaks["slide"].max
    with pytest.raises(tl.TrilithError):
        foot.with_parameters(mu=0.1).run(start=state)
    with pytest.raises(tl.ArgumentError, match="no state of a run"):
        tl.State.from_bytes(b"{}")


def test_steps_come_out_as_a_run_in_one_piece(foot: tl.Model) -> None:
    whole = foot.run(errors=False)
    s = foot.stepper()
    assert s.t == 0.0 and not s.done and s["slide"] == whole["slide"][0]
    found = [s["slide"]]
    for _ in range(40):
        s.step()
        found.append(s["slide"])
    assert np.array_equal(found, whole["slide"][:41])
    before = pickle.loads(pickle.dumps(s.state))
    s.advance(0.6)
    there = s.values
    s.state = before
    assert s.t == pytest.approx(0.2) and s["slide"] == whole["slide"][40]
    s.step(80)
    assert s.values == there and s["slide"] == whole["slide"][120]
    s.advance(5.0)
    assert s.done and s["slide"] == whole["slide"][-1]
    with pytest.raises(tl.ArgumentError, match="at its end"):
        s.step()
    with pytest.raises(tl.ArgumentError, match="static"):
        foot.stepper("gravity")
    with pytest.raises(tl.ArgumentError, match="no case"):
        foot.stepper("quake")
