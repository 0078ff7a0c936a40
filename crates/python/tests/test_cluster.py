"""Studies in parts, from a store, and on a cluster of Dask."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import FOOT

import trilith as tl
from trilith import _native

#: A motion in a file beside the model, so that workers need more than two texts.
SHAKEN = FOOT.replace('duration: "1 s"', 'duration: "0.3 s"').replace(
    'Sine(amplitude: "a", frequency: "2 Hz", cycles: 1)',
    'Table(file: "motion/sine.csv", after_end: Zero, scale: "a")',
)
STUDY = """(title: "Small", model: "../foot.ron", axes: { "mu": Range(from: 0.2, to: 0.5, count: 4), "a": [2, 4, 6] },
    columns: { "slide": Peak("slide") }%s)"""


@pytest.fixture
def small(tmp_path: Path) -> Path:
    """A study of 12 runs."""
    times = np.arange(101) * 0.01
    text = "".join(f"{t},{a}\n" for t, a in zip(times, np.sin(4 * np.pi * times)))
    for name, content in [("foot.ron", SHAKEN), ("motion/sine.csv", text), ("studies/small.ron", STUDY % "")]:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(content, encoding="utf-8")
    return tmp_path / "studies/small.ron"


def same_files(one: Path, other: Path) -> None:
    """Both folders have the same tables and page, to the bit."""
    for name in ("table.parquet", "table.csv", "study.html"):
        assert (one / name).read_bytes() == (other / name).read_bytes(), name


def keys(store: Path) -> list[str]:
    """The keys of all runs in a store, as often as they were kept."""
    lines = [line for path in store.glob("*.segment") for line in path.read_text(encoding="utf-8").splitlines()]
    return [line.split('"key":"')[1][:64] for line in lines if '"key":"' in line]


def test_parts_are_gathered_to_the_same_files(small: Path, tmp_path: Path) -> None:
    whole = tl.study(small, out=tmp_path / "whole")
    s = tl.Study(small, out=tmp_path / "parts")
    assert s.title == "Small" and s.runs == 12 and "12 runs" in repr(s)
    assert s.status() == ([], 12)
    second = s.run(shard=(2, 3))
    assert second.runs == 4 and second.files == [] and (s.folder / "runs.2-of-3.journal").is_file()
    assert s.status().open == 8 and s.status().parts == [tl.PartStatus((2, 3), 4, 4, 0, 0)]
    with pytest.raises(tl.FileError, match="8 runs are missing"):
        s.gather()
    for i in (3, 1):
        s.run(shard=(i, 3))
    gathered = s.gather()
    assert gathered.resumed == 12 and np.array_equal(gathered["slide"], whole["slide"])
    same_files(whole.folder, s.folder)
    for shard, told in [((4, 3), "no part 4 of 3"), (3, "such as"), ((1.5, 3), "such as")]:
        with pytest.raises(tl.ArgumentError, match=told):
            s.run(shard=shard)  # type: ignore[arg-type, unused-ignore]


def test_a_store_is_shared_by_studies(small: Path, tmp_path: Path) -> None:
    store = tmp_path / "store"
    first = tl.study(small, out=tmp_path / "first", store=store, a="4 m/s^2")
    assert first.reused == 0 and len(keys(store)) == 4
    second = tl.study(small, out=tmp_path / "second", store=store)
    assert second.reused == 4 and len(keys(store)) == 12
    tl.study(small, out=tmp_path / "without")
    same_files(second.folder, tmp_path / "without")


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """A cluster of two processes on this machine."""
    distributed: Any = pytest.importorskip("distributed", reason="dask.distributed is not installed")
    if sys.platform == "win32":
        pytest.skip("processes are killed by signals here")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        # One that is lost while it starts is not begun again otherwise.
        cluster.adapt(minimum=2, maximum=2)
        yield client


def test_a_cluster_makes_the_same_files(client: Any, small: Path, tmp_path: Path) -> None:
    tl.study(small, out=tmp_path / "here")
    s = tl.Study(small, out=tmp_path / "there")
    shares: list[float] = []
    found = s.run(client, progress=shares.append)
    assert found.runs == 12 and found.failed == 0 and shares and shares[-1] == 1.0 and sorted(shares) == shares
    same_files(tmp_path / "here", s.folder)
    # What is there is not made again; what another call left open is.
    times = {path: path.stat().st_mtime_ns for path in s.folder.glob("*.journal")}
    assert s.run(client).runs == 12 and times == {path: path.stat().st_mtime_ns for path in times}
    begun = tl.Study(small, out=tmp_path / "begun", store=tmp_path / "store")
    tl.Study(small, out=begun.folder).run(shard=(1, 2))
    assert begun.run(client, shards=4).runs == 12 and len(keys(tmp_path / "store")) == 6
    same_files(tmp_path / "here", begun.folder)


@pytest.mark.parametrize("more", ["", ', histories: Above("slide", "100 m")'], ids=["sent", "in place"])
def test_a_killed_worker_costs_what_was_in_flight(client: Any, small: Path, tmp_path: Path, more: str) -> None:
    small.write_text(STUDY % more, encoding="utf-8")
    tl.study(small, out=tmp_path / "here")
    s = tl.Study(small, out=tmp_path / "there", store=tmp_path / "store")
    killed: list[int] = []

    def kill(share: float) -> None:
        if not killed and share < 1.0:
            [pid, *_] = client.run(os.getpid).values()
            os.kill(pid, signal.SIGKILL)
            killed.append(pid)

    s.run(client, shards=6, progress=kill)
    assert killed
    same_files(tmp_path / "here", s.folder)
    assert len(set(keys(tmp_path / "store"))) == len(keys(tmp_path / "store")) == 12
    client.wait_for_workers(2)


def test_histories_lie_in_the_folder(client: Any, small: Path, tmp_path: Path) -> None:
    small.write_text(STUDY % ', histories: Above("slide", "30 mm")', encoding="utf-8")
    s = tl.Study(small, out=tmp_path / "there")
    found = s.run(client, shards=2)
    kept = {int(path.name) for path in (s.folder / "runs").iterdir()}
    assert kept == {i + 1 for i, slide in enumerate(found["slide"]) if slide > 0.03} and 0 < len(kept) < 12
    assert not list(s.folder.glob(".seen*"))


def test_workers_that_cannot_take_part_are_named(
    client: Any, small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    s = tl.Study(small, out=tmp_path / "out")
    with monkeypatch.context() as m:
        m.setattr(_native, "BUILD", "0123456789abcdef")
        with pytest.raises(tl.WorkerError, match=r"worker tcp://.* has trilith .* here it is .*0123456789abcdef"):
            s.run(client)
    # One that comes after the look at those that are there.
    from trilith import _dask

    with monkeypatch.context() as m:
        m.setattr(_dask, "_machine_of_workers", lambda client: "an abacus")
        with pytest.raises(tl.WorkerError, match=r"other bits \(the others: an abacus; tcp://.*TRILITH_VECTORS"):
            s.run(client)
    assert s.status().open == 12 and s.run(client).runs == 12


def test_clusters_that_are_none(client: Any, small: Path, tmp_path: Path) -> None:
    s = tl.Study(small, out=tmp_path / "out")
    calls: list[tuple[Callable[[], object], str]] = [
        (lambda: s.run(3), "a dask.distributed.Client is wanted"),
        (lambda: s.run(client, shard=(1, 2)), "not both"),
        (lambda: s.run(client, seconds=0.0), "above 0"),
        (lambda: s.run(client, shards=1001), "1000 at most"),
        (lambda: s.run(client, shards=0), "at least 1"),
        (lambda: s.run(client, retries=-1), "at least 0"),
    ]
    for call, told in calls:
        with pytest.raises(tl.ArgumentError, match=told):
            call()


def test_without_dask_the_extra_is_named(small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ImportError, match=r"trilith\[dask\]"):
        tl.Study(small, out=tmp_path / "out").run(object())
