"""Scripts of OpenSeesPy, recorded: `python -m trilith.opensees`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import trilith as tl
from trilith.opensees import Recorder, Unknown

COLUMN = """
import openseespy.opensees as ops

ops.wipe()
ops.model('basic', '-ndm', 2, '-ndf', 3)
ops.node(1, 0.0, 0.0)
ops.node(2, 0.0, 3.0)
ops.fix(1, 1, 1, 1)
ops.mass(2, 8000.0, 8000.0, 0.0)
ops.geomTransf('Linear', 1)
ops.element('elasticBeamColumn', 1, 1, 2, 0.01, 2.0e11, 2.0e-5, 1)
ops.timeSeries('Linear', 1)
ops.pattern('Plain', 1, 1)
ops.load(2, 0.0, -8000.0 * 9.81, 0.0)
ops.recorder('Node', '-file', 'top.out', '-time', '-node', 2, '-dof', 1, 'disp')
ops.integrator('LoadControl', 0.1)
ops.analysis('Static')
ops.analyze(10)
ops.loadConst('-time', 0.0)
w = ops.eigen(1)[0] ** 0.5
print('moved', ops.nodeDisp(2, 1))
ops.rayleigh(0.1 * w, 0.0, 0.0, 0.0)
with open('motion.txt', 'w') as file:
    file.write(' '.join(['0', '1.5', '-1.5', '0']))
ops.timeSeries('Path', 2, '-dt', 0.5, '-filePath', 'motion.txt')
ops.pattern('UniformExcitation', 2, 1, '-accel', 2)
ops.integrator('Newmark', 0.5, 0.25)
ops.analysis('Transient')
while ops.getTime() < 4.0 - 1e-9:
    if ops.analyze(1, 0.01) != 0:
        break
"""


def recorded(folder: Path, text: str, *options: str) -> subprocess.CompletedProcess[str]:
    (folder / "script.py").write_text(text)
    command = [sys.executable, "-m", "trilith.opensees", "script.py", "--out", "model.ron", *options]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_a_script_becomes_a_model_that_runs(tmp_path: Path) -> None:
    done = recorded(tmp_path, COLUMN)
    assert done.returncode == 0, done.stderr
    assert "moved <unknown nodeDisp>" in done.stdout
    # ω² = 3 E I/(h³ m), and the places of the report are those of the script.
    text = (tmp_path / "model.ron").read_text()
    ratio = 0.1 * (3 * 2e11 * 2e-5 / (27 * 8000)) ** 0.5
    written = float(text.split("Rayleigh(mass: ")[1].split(",")[0])
    assert written == pytest.approx(ratio, rel=1e-9)
    assert "script.py:20" in (tmp_path / "model.import.txt").read_text()
    result = tl.load(tmp_path / "model.ron").run()
    assert len(result.t) == 401 and result.peaks["2 Ux"].max > 0.01


def test_what_a_script_does_wrong_is_told_where_it_stands(tmp_path: Path) -> None:
    done = recorded(tmp_path, COLUMN.replace("ops.fix(1, 1, 1, 1)", "ops.fix(7, 1, 1, 1)"))
    assert done.returncode != 0 and "there is no node 7" in done.stderr and "script.py:8" in done.stderr
    done = recorded(tmp_path, COLUMN.replace("print('moved', ops.nodeDisp(2, 1))", "assert ops.nodeDisp(2, 1) < 1"))
    assert done.returncode != 0 and "nodeDisp: results are not there while a script is recorded" in done.stderr
    done = recorded(tmp_path, "import openseespy.opensees as ops\nops.load(1, 1.0)\n")
    assert done.returncode != 0 and "stands before every `pattern`" in done.stderr


def test_loads_go_into_the_pattern_before_them() -> None:
    recorder = Recorder()
    recorder.record("pattern", ["Plain", 1, 1])
    recorder.record("node", [1, 0.0, 0.0])
    recorder.record("load", [1, [1.0, 2.0]])
    lines = [line.split(" ;#")[0] for line in recorder.tcl().splitlines()]
    assert lines == ["pattern Plain 1 1 {", "    load 1 1.0 2.0", "}", "node 1 0.0 0.0"]
    with pytest.raises(ValueError, match="cannot be a word"):
        recorder.record("node", ["{"])
    assert repr(-Unknown("nodeDisp") * 2) == "<unknown nodeDisp>"
