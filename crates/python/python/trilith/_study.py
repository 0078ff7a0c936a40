"""Studies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._arrays import Columns, whole
from ._errors import ArgumentError, unknown

if TYPE_CHECKING:
    from os import PathLike

    import pandas
    import polars
    import pyarrow

    from ._law import CLaw, Law


class StudyResult(Mapping[str, Any]):
    """The table of a study: a row for each run. Numbers are read-only arrays (``nan`` where there is none), texts lists."""

    #: Its title.
    title: str
    #: The folder of its results.
    folder: Path
    #: Files that were written.
    files: list[Path]
    #: Units of the columns; empty for pure numbers and texts.
    units: dict[str, str]
    #: Runs that were on disk already, that were taken from the store, that failed, new runs that went several to a core.
    resumed: int
    reused: int
    failed: int
    beside: int
    #: Why none of them did, where the study does not fit.
    alone: str | None

    def __init__(self, folder: Path, facts: _native.StudyFacts) -> None:
        self.title, columns, files, self.resumed, self.reused, self.failed, self.beside, self.alone = facts
        self.folder = folder
        self.files = [Path(f) for f in files]
        self.units = {name: unit for name, unit, _, _ in columns}
        self._numbers = Columns("column", {c[0]: c[2] for c in columns if c[2] is not None})
        self._texts = {c[0]: c[3] for c in columns if c[3] is not None}

    def __getitem__(self, name: str) -> Any:
        if name in self._numbers:
            return self._numbers[name]
        if name in self._texts:
            return self._texts[name]
        raise unknown("column", name, list(self.units))

    def __iter__(self) -> Iterator[str]:
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    @property
    def runs(self) -> int:
        """Number of runs."""
        return len(self["run"])

    @property
    def page(self) -> Path:
        """The page with its figures."""
        return self.folder / "study.html"

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a data frame of pandas."""
        import pandas

        return pandas.DataFrame(dict(self))

    def to_polars(self) -> polars.DataFrame:
        """The table as a data frame of Polars."""
        import polars

        return polars.DataFrame(dict(self))

    def to_arrow(self) -> pyarrow.Table:
        """The table as an Arrow table of pyarrow."""
        import pyarrow

        return pyarrow.table(dict(self))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The Arrow PyCapsule interface, by way of pyarrow."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        return f"<StudyResult {self.title!r}: {self.runs} runs, {self.failed} failed, in {self.folder}>"

    def _repr_html_(self) -> str:
        from html import escape

        from ._html import table

        columns = [self[n] if n in self._texts else self[n].tolist() for n in self]
        shown = min(self.runs, 10)
        rows = [tuple("" if c[i] is None else c[i] for c in columns) for i in range(shown)]
        more = "<p>…</p>" if shown < self.runs else ""
        return f"<p>{escape(repr(self))}</p>" + table(list(self), rows) + more


class PartStatus(NamedTuple):
    """How far a part of a study is."""

    #: Which part of how many, from 1; ``None`` for what was run as a whole.
    shard: tuple[int, int] | None
    #: Runs that it has, of how many at most: a series may end before.
    done: int
    of: int
    #: Runs that failed.
    failed: int
    #: Series of runs that are not at their end.
    open: int


class StudyStatus(NamedTuple):
    """How far a study is."""

    #: The parts that have begun.
    parts: list[PartStatus]
    #: Series of runs of the whole study that are not at their end, whoever makes them.
    open: int


class Study:
    """A study, read and checked: to be run as a whole, in parts on many machines, or on a cluster of Dask.

        s = tl.Study("slide.ron", out="out/slide", store="out/store")
        s.run()                         # here, on all cores
        s.run(shard=(3, 20))            # a part, in a folder that all machines see; then
        s.gather()                      # the tables of what the parts have made
        s.run(client)                   # on the workers of a dask.distributed.Client

    The files are those of ``trilith sweep``, and the tables are the same to the bit, whichever way they came about, on
    machines with vectors of the same width.
    """

    #: The study file, the folder of its results, and that of a store, if any.
    path: Path
    folder: Path
    store: Path | None

    def __init__(
        self,
        path: str | PathLike[str],
        /,
        *,
        out: str | PathLike[str] | None = None,
        store: str | PathLike[str] | None = None,
        laws: Sequence[type[Law] | CLaw] = (),
        parameters: Mapping[str, object] | None = None,
        **more: object,
    ) -> None:
        """Reads a study.

        :param path: the study file.
        :param out: the folder of the results; without it ``out/NAME`` of a file ``NAME.ron``, as the program has it.
        :param store: a folder of finished runs that any study takes from and adds to.
        :param laws: laws that the model may name beside the built-in kinds; runs with other laws are those of another study.
        :param parameters: values of parameters of the model, also by keyword.
        :raises ModelError: with all that is wrong with the study or its model.
        """
        from ._law import natives
        from ._model import settings

        self.path = Path(path)
        self.folder = Path("out") / self.path.stem if out is None else Path(out)
        self.store = None if store is None else Path(store)
        self._set = settings({**(parameters or {}), **more})
        self._laws = tuple(laws)
        self._native = _native.Study(self.path, self._set, natives(self._laws))

    @property
    def title(self) -> str:
        """Its title."""
        return self._native.title

    @property
    def runs(self) -> int:
        """Number of its runs, those included that a series may leave out."""
        return self._native.identity[5]

    def run(
        self,
        client: object = None,
        /,
        *,
        shard: tuple[int, int] | None = None,
        threads: int | None = None,
        retry_failed: bool = False,
        seconds: float = 20.0,
        shards: int | None = None,
        retries: int = 5,
        progress: Callable[[float], object] | None = None,
    ) -> StudyResult:
        """Runs it, a part of it, or all of it on a cluster, or goes on with it: finished runs that lie in its folder or in
        its store are not made again.

        :param client: a ``dask.distributed.Client``: the study is cut into parts, each a task of its workers, and what they
            have made lies in the folder here as soon as each is done. Workers need not see that folder, unless the study
            keeps histories; the folder of the store is that of the machine that a worker is on.
        :param shard: which part of how many, from 1, such as ``(3, 20)``; no tables are written.
        :param threads: without it, as many as the machine runs at once; of a task of a cluster, one.
        :param retry_failed: runs that have failed are made once more.
        :param seconds: how long a task of a cluster is to take, as measured by the first one.
        :param shards: how many tasks there are, 1000 at most, whatever they take.
        :param retries: how often a task is given to another worker that failed, or whose worker was lost.
        :param progress: called with the finished share, 0 … 1, now and then.
        :raises FileError: where the folder cannot be written, or belongs to another study; where a store is damaged.
        :raises WorkerError: where a worker has another version of trilith, or would come to other bits.
        :raises KeyboardInterrupt: upon Ctrl-C; finished runs stay, and the same call goes on.
        """
        threads = whole("threads", threads)
        if client is not None:
            if shard is not None:
                raise ArgumentError("a part or a cluster is wanted, not both: leave out `shard`")
            if self._laws:
                raise ArgumentError("`laws` do not go to the workers of a cluster: run it here, or in parts by `shard`")
            from ._dask import run

            run(self, client, threads, retry_failed, seconds, whole("shards", shards), retries, progress)
            return self.gather()
        return self._run(threads, shard, False, retry_failed, progress)

    def gather(self) -> StudyResult:
        """The tables of what parts have made in its folder; runs nothing.

        :raises FileError: where runs are missing.
        """
        return self._run(1, None, True, False, None)

    def status(self) -> StudyStatus:
        """How far the parts in its folder are."""
        if not self.folder.exists():
            return StudyStatus([], self._native.series)
        parts, to_go = self._native.status(self.folder)
        listed = [PartStatus((index, of) if of else None, *rest) for index, of, *rest in parts]
        return StudyStatus(listed, to_go)

    def _run(
        self,
        threads: int | None,
        shard: tuple[int, int] | None,
        gather: bool,
        retry_failed: bool,
        progress: Callable[[float], object] | None,
    ) -> StudyResult:
        if shard is not None:
            shard = _part(shard)
        facts = self._native.run(self.folder, threads, shard, gather, retry_failed, self.store, progress)
        return StudyResult(self.folder, facts)

    def __repr__(self) -> str:
        return f"<Study {self.title!r}: {self.runs} runs, in {self.folder}>"


def _part(shard: object) -> tuple[int, int]:
    """Which part of how many."""
    import operator

    wrong = ArgumentError(f"shard must be a part of several such as (3, 20), it is {shard!r}")
    if not isinstance(shard, (tuple, list)) or len(shard) != 2:
        raise wrong
    try:
        return operator.index(shard[0]), operator.index(shard[1])
    except TypeError:
        raise wrong from None


def study(
    path: str | PathLike[str],
    /,
    *,
    out: str | PathLike[str] | None = None,
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
    laws: Sequence[type[Law] | CLaw] = (),
    parameters: Mapping[str, object] | None = None,
    store: str | PathLike[str] | None = None,
    **more: object,
) -> StudyResult:
    """Runs a study, or goes on with it: :class:`Study` and its :meth:`~Study.run` in one call.

    :param path: the study file.
    :param out: the folder of the results; without it ``out/NAME`` of a file ``NAME.ron``, as the program has it.
    :param threads: without it, as many as the machine runs at once.
    :param progress: called with the finished share, 0 … 1, now and then.
    :param laws: laws that the model may name beside the built-in kinds; runs with other laws are those of another study.
    :param parameters: values of parameters of the model, also by keyword.
    :param store: a folder of finished runs that any study takes from and adds to.
    :raises ModelError: with all that is wrong with the study or its model.
    :raises FileError: where the folder cannot be written, or belongs to another study.
    :raises KeyboardInterrupt: upon Ctrl-C; finished runs stay, and the same call goes on.
    """
    threads = whole("threads", threads)
    read = Study(path, out=out, store=store, laws=laws, parameters=parameters, **more)
    return read.run(threads=threads, progress=progress)
