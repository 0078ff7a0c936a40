"""Studies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._arrays import Columns, whole
from ._errors import unknown

if TYPE_CHECKING:
    from os import PathLike

    import pandas
    import polars
    import pyarrow


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
    #: Runs that were on disk already, runs that failed, new runs that went several to a core.
    resumed: int
    failed: int
    beside: int
    #: Why none of them did, where the study does not fit.
    alone: str | None

    def __init__(self, folder: Path, facts: _native.StudyFacts) -> None:
        self.title, columns, files, self.resumed, self.failed, self.beside, self.alone = facts
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


def study(
    path: str | PathLike[str],
    /,
    *,
    out: str | PathLike[str] | None = None,
    threads: int | None = None,
    progress: Callable[[float], object] | None = None,
    parameters: Mapping[str, object] | None = None,
    **more: object,
) -> StudyResult:
    """Runs a study, or goes on with it: finished runs that lie in its folder are not made again.

    :param path: the study file.
    :param out: the folder of the results; without it ``out/NAME`` of a file ``NAME.ron``, as the program has it.
    :param threads: without it, as many as the machine runs at once.
    :param progress: called with the finished share, 0 … 1, now and then.
    :param parameters: values of parameters of the model, also by keyword.
    :raises ModelError: with all that is wrong with the study or its model.
    :raises FileError: where the folder cannot be written, or belongs to another study.
    :raises KeyboardInterrupt: upon Ctrl-C; finished runs stay, and the same call goes on.
    """
    from ._model import settings

    path = Path(path)
    folder = Path("out") / path.stem if out is None else Path(out)
    set_ = settings({**(parameters or {}), **more})
    return StudyResult(folder, _native.study(path, set_, folder, whole("threads", threads), progress))
