"""Studies on a cluster of Dask.

A study is cut into parts, each a task. What a task needs goes with it: the files of the study, and the runs of its part
that are known. What comes back is the journal of the part, which is added to the folder of the study here, as if the part
had been run there. So workers need not see that folder, a part that is lost with its worker is made again by another one,
and the tables are made of the same lines as ever.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._errors import ArgumentError, WorkerError

if TYPE_CHECKING:
    from ._study import Study

#: Most parts of a study: each has a file.
MOST = 1000
#: Seconds that a task takes at least, where there are enough workers for shorter ones.
LEAST = 1.0
#: Tasks for each worker, where they are long enough: the last of few keep one busy while the others wait.
EACH = 8


class Job(NamedTuple):
    """What all tasks of a study share."""

    #: Tells it from others, for what a worker keeps of it.
    name: str
    #: Version and build of trilith, and what results hang on beside.
    version: tuple[str, str]
    machine: str
    #: The study file, and all files by their paths below a common folder.
    study: str
    files: dict[str, bytes]
    set: list[tuple[str, str]]
    identity: tuple[str, str, str, str, str, int]
    store: str | None
    threads: int
    retry_failed: bool
    #: For a study that keeps histories: its folder, which workers must see, and a file that is there.
    folder: str | None
    token: str


class Made(NamedTuple):
    """What a task comes back with."""

    #: Why the worker cannot take part, if so.
    refused: str | None
    #: The journal; nothing where that is in the folder already.
    journal: bytes
    #: How long it took.
    seconds: float


def _distributed() -> Any:
    """The package, parts of which have no types."""
    from importlib import import_module

    try:
        return import_module("distributed")
    except ImportError:
        raise ImportError("a cluster needs dask.distributed: pip install 'trilith[dask]'") from None


def _client(client: object) -> Any:
    """Checks a client."""
    distributed = _distributed()
    if not isinstance(client, distributed.Client):
        raise ArgumentError(f"a dask.distributed.Client is wanted, not {client!r}")
    if client.asynchronous:
        raise ArgumentError("the client is asynchronous: a study waits for its tasks")
    return client


def run(
    study: Study,
    client: object,
    threads: int | None,
    retry_failed: bool,
    seconds: float,
    shards: int | None,
    retries: int,
    progress: Callable[[float], object] | None,
) -> None:
    """Makes all runs of a study that are missing in its folder, on the workers of a client."""
    cluster = _client(client)
    if not seconds > 0.0:
        raise ArgumentError(f"seconds must be above 0, they are {seconds}")
    if shards is not None and shards > MOST:
        raise ArgumentError(f"shards must be {MOST} at most, they are {shards}")
    if retries < 0:
        raise ArgumentError(f"retries must be at least 0, they are {retries}")
    native, folder = study._native, study.folder
    folder.mkdir(parents=True, exist_ok=True)
    machine = _machine_of_workers(cluster)
    token = folder.resolve() / f".seen-{_unique()}"
    if native.keeps_histories:
        token.write_text(token.name, encoding="utf-8")
    try:
        job = _job(study, machine, threads or 1, retry_failed, token)
        tasks = _Tasks(study, cluster, job, retries, progress)
        count = shards
        if count is None:
            first = min(native.series, MOST)
            opened = native.open_parts(folder, first, retry_failed)
            if not opened:
                return
            slots = max(sum(cluster.nthreads().values()), 1)
            took = tasks.run(opened[:1], first, 0.0) * first
            count = min(max(round(took / seconds), min(EACH * slots, round(took / LEAST)), 1), first)
        opened = native.open_parts(folder, count, retry_failed)
        tasks.run(opened, count, 1.0)
    finally:
        token.unlink(missing_ok=True)


def _unique() -> str:
    import uuid

    return uuid.uuid4().hex


def _job(study: Study, machine: str | None, threads: int, retry_failed: bool, token: Path) -> Job:
    import os

    native = study._native
    paths = [Path(os.path.abspath(path)) for path in native.files]
    root = Path(os.path.commonpath([path.parent for path in paths]))
    return Job(
        name=_unique(),
        version=(_native.VERSION, _native.BUILD),
        machine=machine or "",
        study=paths[0].relative_to(root).as_posix(),
        files={path.relative_to(root).as_posix(): path.read_bytes() for path in paths},
        set=study._set,
        identity=native.identity,
        store=None if study.store is None else os.path.abspath(study.store),
        threads=threads,
        retry_failed=retry_failed,
        folder=str(token.parent) if native.keeps_histories else None,
        token=token.name,
    )


def _machine_of_workers(client: Any) -> str | None:
    """What results of all workers hang on that are there now, after a look at their versions.

    :raises WorkerError: where they differ from each other, or from what is here.
    """

    # Goes to workers as it stands: one that has another version, or none, can say so.
    def look() -> tuple[str, str, str] | None:
        try:
            import trilith
            from trilith import _native as native
        except ImportError:
            return None
        machine = getattr(native, "machine", None)
        return trilith.__version__, trilith.BUILD, machine() if machine else ""

    look.__module__ = "__main__"
    seen: dict[str, tuple[str, str, str] | None] = client.run(look, on_error="ignore")
    machines: dict[str, str] = {}
    for worker, found in seen.items():
        if found is None:
            raise WorkerError(f"worker {worker} has no trilith: install the version that is here, {_told(None)}")
        version, build, machine = found
        if (version, build) != (_native.VERSION, _native.BUILD):
            raise WorkerError(_other_version(worker, (version, build)))
        machines.setdefault(machine, worker)
    if len(machines) > 1:
        (one, first), (other, second) = list(machines.items())[:2]
        raise WorkerError(_other_machine(first, one, second, other))
    return next(iter(machines), None)


def _told(version: tuple[str, str] | None) -> str:
    number, build = version or (_native.VERSION, _native.BUILD)
    return f"{number} (build {build})"


def _other_version(worker: str, version: tuple[str, str]) -> str:
    return (
        f"worker {worker} has trilith {_told(version)}, here it is {_told(None)}: "
        "half of the table would come from other code; install the same on all machines"
    )


def _other_machine(first: str, one: str, second: str, other: str) -> str:
    return (
        f"workers would come to other bits ({first}: {one}; {second}: {other}): "
        "take machines of one kind, or narrower vectors by TRILITH_VECTORS=256 in the environment of all workers"
    )


class _Tasks:
    """Parts of a study on their way."""

    def __init__(
        self,
        study: Study,
        client: Any,
        job: Job,
        retries: int,
        progress: Callable[[float], object] | None,
    ) -> None:
        self.study = study
        self.client = client
        self.job = job
        self.retries = retries
        self.progress = progress

    def run(self, parts: list[tuple[int, bytes]], of: int, share: float) -> float:
        """Runs parts and takes in what they have made; returns the longest time that one took.

        :param share: what is finished with the last of them.
        """
        distributed = _distributed()
        futures = self._submit(parts, of)
        waiting = {f: (index, known, self.retries) for f, (index, known) in zip(futures, parts)}
        done, slowest = 0, 0.0
        try:
            ends = distributed.as_completed(futures)
            for future in ends:
                index, known, left = waiting.pop(future)
                try:
                    made: Made = future.result()
                except distributed.KilledWorker:
                    # Dask gives up a task with which several workers were lost, whatever they were lost by.
                    if not left:
                        raise
                    [again] = self._submit([(index, known)], of)
                    waiting[again] = (index, known, left - 1)
                    ends.add(again)
                    continue
                if made.refused is not None:
                    raise WorkerError(made.refused)
                if made.journal:
                    self.study._native.take_part(self.study.folder, (index, of), made.journal)
                future.release()
                slowest = max(slowest, made.seconds)
                done += 1
                if self.progress is not None and share:
                    self.progress(share * done / len(parts))
        finally:
            if waiting:
                self.client.cancel(list(waiting))
        return slowest

    def _submit(self, parts: list[tuple[int, bytes]], of: int) -> list[Any]:
        # In one call: what they share goes once.
        futures: list[Any] = self.client.map(
            part,
            [(index, of) for index, _ in parts],
            [known for _, known in parts],
            job=self.job,
            key=[f"trilith-part-{_unique()}" for _ in parts],
            retries=self.retries,
            pure=False,
        )
        return futures


#: Studies that a worker has read, with the folders of their files, by the names of their jobs.
_READ: dict[str, tuple[_native.Study, Any]] = {}
_LOCK = threading.Lock()


def part(shard: tuple[int, int], known: bytes, *, job: Job) -> Made:
    """A task: runs a part of a study on a worker."""
    from tempfile import TemporaryDirectory
    from time import perf_counter

    worker, scratch = _worker()
    if (_native.VERSION, _native.BUILD) != job.version:
        here = (_native.VERSION, _native.BUILD)
        text = f"worker {worker} has trilith {_told(here)}, the study comes from {_told(job.version)}"
        return Made(text + ": install the same on all machines", b"", 0.0)
    if job.machine and _native.machine() != job.machine:
        return Made(_other_machine("the others", job.machine, worker, _native.machine()), b"", 0.0)
    study, _files = _read(job, scratch)
    if study.identity != job.identity:
        text = f"worker {worker} reads another study: files that its model names by absolute paths are others there"
        return Made(text, b"", 0.0)
    store = None if job.store is None else Path(job.store)
    start = perf_counter()
    if job.folder is not None:
        folder = Path(job.folder)
        if not (folder / job.token).is_file():
            text = f"worker {worker} does not see the folder {folder}, where the study keeps histories"
            return Made(text + ": give one that all workers see, or leave out `histories`", b"", 0.0)
        study.run(folder, job.threads, shard, False, job.retry_failed, store, None)
        return Made(None, b"", perf_counter() - start)
    with TemporaryDirectory(prefix="trilith-", dir=scratch) as name:
        folder = Path(name)
        (folder / "runs.journal").write_bytes(known)
        study.run(folder, job.threads, shard, False, job.retry_failed, store, None)
        journal = (folder / "runs.{}-of-{}.journal".format(*shard)).read_bytes()
    return Made(None, journal, perf_counter() - start)


def _worker() -> tuple[str, str | None]:
    """The address of the worker that this runs on, and its folder for what is not kept."""
    try:
        worker = _distributed().get_worker()
    except ValueError:
        return "here", None
    return str(worker.address), str(worker.local_directory)


def _read(job: Job, scratch: str | None) -> tuple[_native.Study, Any]:
    """The study of a job, read once by each worker, and what keeps its files: runs may read from them."""
    from tempfile import TemporaryDirectory

    with _LOCK:
        found = _READ.get(job.name)
        if found is None:
            folder = TemporaryDirectory(prefix="trilith-", dir=scratch)
            root = Path(folder.name)
            for name, content in job.files.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content)
            # Tasks of a job before hold on to what is theirs.
            _READ.clear()
            found = _READ[job.name] = (_native.Study(root / job.study, job.set, []), folder)
        return found
