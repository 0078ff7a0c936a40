"""Runs a study on a cluster of this machine whose workers are killed now and then, and holds it to one thread.

    python tools/cluster.py out/cluster --side 100 --every 10

A grid of side × side runs of a sliding mass: by one thread, by Dask with nobody killed, and by Dask with one of its four
processes killed every so many seconds. Tells the time of each, and fails where tables or page differ by a bit, or where a
finished run was made twice (its key stands in the store twice).
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import threading
import time
from pathlib import Path
from typing import Any

import trilith as tl

MODEL = """(
    title: "Sliding mass",
    plane: XZ, gravity: "1 g", parameters: { "mu": 0.3, "a": "4 m/s^2" },
    nodes: { "cg": (0, 0, 0) },
    elements: {
        "mass": Mass(node: "cg", mass: "1 t", inertia: (0, 1, 0)),
        "upright": Spring(node: "cg", r3: "1 MN*m"),
        "foot": NLink(node: "cg", kn: "10 MN/m", ks: "10 MN/m", mu: "mu", damping: "10 kN*s/m"),
    },
    functions: { "pulse": Sine(amplitude: "a", frequency: "2 Hz", cycles: 1) },
    cases: {
        "gravity": Static(loads: [Gravity]),
        "shake": Dynamic(after: "gravity", duration: "%s", dt: "10 ms", base: [(direction: X, function: "pulse")],
            energy_limit: 0.5),
    },
    outputs: { "slide": Displacement(node: "cg", dof: Ux) },
)"""
STUDY = """(
    title: "A grid", model: "mass.ron",
    axes: {
        "a": Range(from: "1 m/s^2", to: "8 m/s^2", count: %d),
        "mu": Range(from: 0.05, to: 0.95, count: %d),
    },
    columns: { "slide": Peak("slide"), "heat": Energy("link_hysteretic") },
)"""

#: What Dask does beside tasks, less often: as it comes, six processes at rest take a fifth of a core.
HOUSEKEEPING = {
    "distributed.worker.profile.enabled": False,
    "distributed.admin.tick.interval": "1s",
    "distributed.admin.system-monitor.interval": "5s",
    "distributed.worker.memory.monitor-interval": "1s",
}


def kept(store: Path) -> list[str]:
    """The keys of all runs in a store, as often as they were kept."""
    lines = [line for path in store.glob("*.segment") for line in path.read_text(encoding="utf-8").splitlines()]
    return [line.split('"key":"')[1][:64] for line in lines if '"key":"' in line]


class Killer(threading.Thread):
    """Kills one of the workers every so many seconds."""

    def __init__(self, cluster: Any, every: float) -> None:
        super().__init__(daemon=True)
        self.cluster, self.every = cluster, every
        self.killed = 0
        self.over = threading.Event()

    def run(self) -> None:
        """Until it is over."""
        while not self.over.wait(self.every):
            nannies = [n.process for n in list(self.cluster.workers.values()) if n.process is not None]
            pids = [n.process.pid for n in nannies if n.process is not None and n.process.pid]
            if pids:
                try:
                    os.kill(random.choice(pids), signal.SIGKILL)
                    self.killed += 1
                except ProcessLookupError:
                    pass


def main() -> None:
    """All of it."""
    from importlib import import_module

    distributed: Any = import_module("distributed")
    dask: Any = import_module("dask")
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("folder", type=Path)
    asked.add_argument("--side", type=int, default=100)
    asked.add_argument("--every", type=float, default=10.0)
    asked.add_argument("--duration", default="0.6 s")
    asked.add_argument("--seconds", type=float, default=20.0)
    asked.add_argument("--as-it-comes", action="store_true", help="Dask with the settings that it comes with")
    a = asked.parse_args()
    a.folder.mkdir(parents=True)
    (a.folder / "mass.ron").write_text(MODEL % a.duration, encoding="utf-8")
    study = a.folder / "study.ron"
    study.write_text(STUDY % (a.side, a.side), encoding="utf-8")

    def timed(name: str, run: Any) -> None:
        start = time.perf_counter()
        run()
        print(f"{name}: {time.perf_counter() - start:.1f} s", flush=True)

    if not a.as_it_comes:
        dask.config.set(HOUSEKEEPING)
    timed("one thread", lambda: tl.study(study, out=a.folder / "one", threads=1))
    timed("all cores", lambda: tl.study(study, out=a.folder / "all"))
    with (
        distributed.LocalCluster(n_workers=4, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        # One that is lost while it starts is not begun again otherwise.
        cluster.adapt(minimum=4, maximum=4)
        calm = tl.Study(study, out=a.folder / "calm")
        timed("four processes of Dask", lambda: calm.run(client, seconds=a.seconds))
        killed = tl.Study(study, out=a.folder / "killed", store=a.folder / "store")
        killer = Killer(cluster, a.every)
        killer.start()
        timed("the same, killed", lambda: killed.run(client, seconds=a.seconds, retries=100))
        killer.over.set()
        killer.join()
    keys = kept(a.folder / "store")
    files = len(list((a.folder / "store").iterdir()))
    print(f"{killer.killed} workers killed, {len(keys)} runs kept in {files} files, {len(set(keys))} of them distinct")
    assert len(keys) == len(set(keys)) == a.side**2, "a finished run was made twice"
    for name in ("table.parquet", "table.csv", "study.html"):
        one = (a.folder / "one" / name).read_bytes()
        for other in ("all", "calm", "killed"):
            assert (a.folder / other / name).read_bytes() == one, f"{name} of {other} differs"
    print("the same tables to the bit")


if __name__ == "__main__":
    main()
