"""Types: the package and its tests are clean under mypy."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import trilith
import trilith as tl

HERE = Path(__file__).resolve().parent

USE = """
import numpy as np
import numpy.typing
import trilith as tl
from typing import Any, assert_type

m = tl.load("frame.ron", mu=0.1)
r = m.run(case="shake", solver="fna", dt=0.01)
assert_type(r.peaks["roof"].max, float)
d: np.typing.NDArray[np.float64] = r.links["a"].loop().d
assert_type(tl.sweep(m, {"mu": [0.1]}).shape, tuple[int, ...])
assert_type(tl.elements()["NLink"].summary, str)
beam = tl.Beam(nodes=("a", "b"), young="30 GPa")

class Spring(tl.Law):
    k: float = tl.parameter("N/m")
    history = {"most": "m"}

    def force(self, d: Any, v: Any, history: Any, step: tl.LawStep) -> tuple[float, tuple[float]]:
        return self.k * d[0], (max(history.most, d[0], step.d0[0]),)

assert_type(tl.conform(Spring, k="1 kN/m").tangents, int)
n = tl.load("frame.ron", laws=[Spring, *tl.c_laws("libmine.so")])
spring = Spring(node="a", k=1e3)
"""

WRONG = """
import trilith as tl
m = tl.load("frame.ron")
m.run(slver="fna")
tl.Beam(nods=("a", "b"))
m.run(dt="soon")
r: int = m.run()
"""


def mypy(*arguments: str) -> subprocess.CompletedProcess[str]:
    pytest.importorskip("mypy")
    # Pandas and pyarrow have no types of their own.
    config = str(HERE.parent / "pyproject.toml")
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", config, "--no-incremental", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=HERE)


def test_the_package_is_typed(tmp_path: Path) -> None:
    (tmp_path / "use.py").write_text(USE)
    done = mypy("-p", "trilith")
    assert done.returncode == 0, done.stdout
    done = mypy(str(tmp_path / "use.py"))
    assert done.returncode == 0, done.stdout


def test_wrong_use_is_seen_without_running_it(tmp_path: Path) -> None:
    (tmp_path / "wrong.py").write_text(WRONG)
    done = mypy(str(tmp_path / "wrong.py"))
    lines = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert [int(line.split(":")[1]) for line in lines] == [4, 5, 6, 7], done.stdout


def test_everything_public_is_documented() -> None:
    assert set(trilith._WHERE) < set(tl.__all__)
    for name in tl.__all__:
        thing = getattr(tl, name)
        if name.startswith("__") or name == "BUILD":
            continue
        assert thing.__doc__, name
        members = vars(thing).items() if isinstance(thing, type) else []
        for member, value in members:
            public = not member.startswith("_") and (callable(value) or isinstance(value, property))
            assert not public or value.__doc__, f"{name}.{member}"
