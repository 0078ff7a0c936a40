"""The code of the guide's page runs, and says what the page says; so does the notebook."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

PAGE = ROOT / "crates/guide/src/python.md"
LAWS = ROOT / "crates/guide/src/foreign_laws.md"
REDUCTION = ROOT / "crates/guide/src/reduction.md"
NOTEBOOK = Path(__file__).resolve().parents[1] / "notebooks/friction.ipynb"


def blocks(page: Path) -> list[str]:
    """Blocks of Python in a page."""
    return re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)


def compiled(page: Path, folder: Path) -> bool:
    """Makes the library of the C source in a page by the command that it shows; false without a compiler."""
    [source] = re.findall(r"^```c,from=.*?\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)
    [command] = re.findall(r"^\$ (cc .*)$", page.read_text(encoding="utf-8"), re.M)
    (folder / "yielding.c").write_text(source, encoding="utf-8")
    (folder / "crates").symlink_to(ROOT / "crates")
    if shutil.which("cc") is None:
        return False
    subprocess.run(command.split(), cwd=folder, check=True)
    return True


@pytest.mark.parametrize("page", [PAGE, LAWS, REDUCTION, ROOT / "README.md"], ids=["guide", "laws", "reduction", "readme"])
def test_the_code_of_the_pages_runs(page: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    # Pages run from the root of the repository; what they write goes elsewhere.
    (tmp_path / "models").symlink_to(ROOT / "models")
    monkeypatch.chdir(tmp_path)
    found = blocks(page)
    assert found
    if page == LAWS and not compiled(page, tmp_path):
        print("there is no C compiler here: the block with the library is left out")
        found = [block for block in found if "c_laws" not in block]
    names: dict[str, Any] = {}
    for block in found:
        exec(compile(block, str(page), "exec"), names)


def test_the_notebook_runs() -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(NOTEBOOK.parent)}})
    client.execute()
    shown = [o for c in notebook.cells if c.cell_type == "code" for o in c.outputs]
    assert not any(o.output_type == "error" for o in shown)
    data = [o.data for o in shown if "data" in o]
    assert any("<svg" in d.get("text/html", "") for d in data), "the result is shown"
    assert sum("image/png" in d for d in data) >= 3, "loop, sweep and fragility are drawn"


def test_the_committed_notebook_holds_no_outputs() -> None:
    import json

    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    code = [c for c in notebook["cells"] if c["cell_type"] == "code"]
    assert code and all(c["outputs"] == [] and c["execution_count"] is None for c in code)
