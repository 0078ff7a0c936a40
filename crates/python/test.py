"""Builds the wheel, installs it into a fresh environment, and tests it there; arguments go to pytest.

The folder `target/python` (or the one that CARGO_TARGET_DIR names, with `python` behind it) holds the environment and the
wheel. Options of maturin such as `--profile dist`, or of cargo such as `--config FILE`, go into the environment variable
TRILITH_MATURIN. With `--update` the classes in `python/trilith/blocks.py` are made again first, of the cards and the schema
of the library.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", HERE.parents[1] / "target")) / "python"


def run(*command: str | Path) -> None:
    """Runs a command; ends with its status where that is not 0."""
    print("$", *command, flush=True)
    status = subprocess.run([str(c) for c in command], cwd=HERE, check=False).returncode
    if status:
        sys.exit(status)


def main() -> None:
    """All of it."""
    if sys.version_info < (3, 11):
        sys.exit(f"Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    shutil.rmtree(TARGET, ignore_errors=True)
    environment, wheels = TARGET / "environment", TARGET / "wheels"
    venv.create(environment, with_pip=True)
    python = environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    run(python, "-m", "pip", "install", "--quiet", "maturin>=1.9,<2")
    maturin = [python, "-m", "maturin", "build", "--locked", "--out", wheels]
    maturin += shlex.split(os.environ.get("TRILITH_MATURIN", ""))
    run(*maturin)
    [wheel] = wheels.glob("*.whl")
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB", flush=True)
    run(python, "-m", "pip", "install", "--quiet", f"{wheel}[test]")
    arguments = sys.argv[1:]
    if "--update" in arguments:
        arguments.remove("--update")
        run(python, "tools/blocks.py")
        run(*maturin)
        run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--force-reinstall", wheel)
    run(python, "-m", "pytest", "--quiet", "tests", *arguments)


if __name__ == "__main__":
    main()
