"""A superelement in place of a part."""

from pathlib import Path

import numpy as np
import pytest

import trilith as tl

MAST = """(
    plane: XZ,
    nodes: { "m{i}": For(i: "0 to 20", of: (0, 0, "0.5 m*i")) },
    supports: { "m0": Fixed },
    elements: {
        "tube {i}": For(i: "1 to 20", of: Beam(nodes: ("m{i-1}", "m{i}"),
            young: "210 GPa", area: 0.01, i2: 1e-4, i3: 1e-4, density: 7850)),
        "stop": Gap(node: "m20", axis1: (1, 0, 0), opening: "1 mm", k: "1 MN/m"),
    },
    groups: { "mast": ["tube *"] },
    functions: { "pulse": HalfSine(amplitude: "0.3 g", duration: "0.1 s") },
    cases: { "shaken": Dynamic(duration: "0.3 s", dt: "5 ms", base: [(direction: X, function: "pulse")]) },
    outputs: { "top": Displacement(node: "m20", dof: Ux), "half": Displacement(node: "m10", dof: Ux) },
)"""


def test_a_mast_of_few_rows(tmp_path: Path) -> None:
    m = tl.loads(MAST)
    found = m.reduce("mast", up_to=100.0, keep=["m20"])
    assert (found.elements, found.equations, found.rows) == (20, 63, 6)
    assert found.kept == ["m0", "m20"] and found.recovered == ["m10"]
    assert found.frequency.size == len(found.effective_mass) < found.available
    assert np.all(np.diff(found.frequency) > 0) and found.frequency[-1] <= 100.0
    assert np.all(found.effective_mass.sum(axis=0) <= found.inner_mass * (1 + 1e-9))
    assert f"{found.rows + found.frequency.size} rows" in repr(found)
    whole = m.run()
    assert whole.peaks["top"].max > 1e-3
    for small in [found.model, m.reduce("mast", up_to=100.0, keep=["m20"], out=tmp_path / "small").model]:
        assert [e.kind for e in small.elements.values()].count("Superelement") == 1
        r = small.run()
        for name in ["top", "half"]:
            assert abs(r.peaks[name].max / whole.peaks[name].max - 1) < 0.01, name
    names = {p.name for p in (tmp_path / "small").iterdir() if not p.name.startswith(".")}
    assert names == {"model.ron", "stiffness.npz", "mass.npz", "rows.csv", "recovery.csv"}
    # Static shapes alone, and all modes.
    assert m.reduce(["tube *"], 0).frequency.size == 0
    every = m.reduce("mast")
    assert every.frequency.size == every.available
    exact = every.model.run()
    assert np.allclose(exact["top"], whole["top"], rtol=0, atol=1e-6 * whole.peaks["top"].max)


def test_what_is_refused(tmp_path: Path) -> None:
    m = tl.loads(MAST)
    with pytest.raises(tl.ArgumentError, match="did you mean `mast`"):
        m.reduce("mist")
    with pytest.raises(tl.ArgumentError, match='"stop" is a Gap, which is a link'):
        m.reduce(["mast", "stop"])
    with pytest.raises(tl.ArgumentError, match="one of them is wanted"):
        m.reduce("mast", 3, up_to=10.0)
    with pytest.raises(tl.ArgumentError, match="must be at least 0"):
        m.reduce("mast", -1)
    with pytest.raises(tl.ArgumentError, match="list of names"):
        m.reduce("mast", keep="m20")
    with pytest.raises(tl.ArgumentError, match="without out= none are written"):
        m.reduce("mast", form="mtx")
    with pytest.raises(tl.ArgumentError, match="no form of matrices"):
        m.reduce("mast", out=tmp_path / "x", form="xlsx")
    (tmp_path / "file").write_text("mine")
    with pytest.raises(tl.FileError, match="is a file, no folder"):
        m.reduce("mast", out=tmp_path / "file")
    assert (tmp_path / "file").read_text() == "mine"
