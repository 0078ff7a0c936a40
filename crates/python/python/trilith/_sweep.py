"""One model with many values of its parameters."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _native
from ._arrays import Columns, array, frozen, whole
from ._errors import ArgumentError, unknown
from ._model import written

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt
    import pandas
    import polars
    import pyarrow

    from ._arrays import Array
    from ._model import Model
    from ._native import Column


class SweepPeaks(NamedTuple):
    """Extremes of an output in all runs, SI; ``nan`` where a run came to none."""

    max: Array
    t_max: Array
    min: Array
    t_min: Array
    final: Array

    @property
    def magnitude(self) -> Array:
        """The larger of \\|max\\| and \\|min\\|."""
        import numpy as np

        return array(np.maximum(abs(self.max), abs(self.min)))


class SweepResult(Mapping[str, "Array"]):
    """What a sweep left: a row for each combination, in their order.

    ``s["roof"]`` is the largest magnitude of an output in each run; :attr:`peaks` has its extremes, :meth:`grid` puts them
    into the shape of the grid.
    """

    #: Values of the parameters: lists of one length.
    parameters: dict[str, list[float | str]]
    #: Lengths of the axes of the grid; one for a list of combinations.
    shape: tuple[int, ...]
    #: Extremes by output.
    peaks: dict[str, SweepPeaks]
    #: How each run ended, and what there is to say of it.
    status: list[str]
    messages: list[str]
    #: Whether each run is to be trusted.
    good: npt.NDArray[np.bool_]
    #: How each was computed: ``"lanes"`` (several to a core), ``"ordinary"``, ``"rerun"`` or ``"none"``.
    engine: list[str]
    #: Energies at the end (``energy.input`` …, J), steps, iterations, uplift and slip of contacts.
    numbers: Columns
    #: Mode in which the body left rest, and mode of the whole run, for models with such a body.
    initial_mode: list[str | None]
    mode: list[str | None]

    def __init__(
        self,
        parameters: dict[str, list[float | str]],
        shape: tuple[int, ...],
        units: dict[str, str],
        table: _native.SweepFacts,
    ) -> None:
        import numpy as np

        status, good, messages, engine, modes, peaks, numbers = table
        self.parameters = parameters
        self.shape = shape
        #: SI units of the outputs.
        self.units = units
        self.status = status
        self.good = np.array(good, dtype=bool)
        self.good.flags.writeable = False
        self.messages = messages
        self.engine = engine
        self.initial_mode = [m[0] if m else None for m in modes]
        self.mode = [m[1] if m else None for m in modes]
        self.peaks = _Peaks({name: SweepPeaks(*map(array, five)) for name, five in peaks})
        self.numbers = Columns("number", dict(numbers))

    def __getitem__(self, output: str) -> Array:
        return self.peaks[output].magnitude

    def __iter__(self) -> Iterator[str]:
        return iter(self.peaks)

    def __len__(self) -> int:
        return len(self.peaks)

    @property
    def runs(self) -> int:
        """Number of runs."""
        return len(self.status)

    def grid(self, values: str | Iterable[Any]) -> npt.NDArray[Any]:
        """Values of all runs in the shape of the grid, an axis for each parameter in their order.

        :param values: the name of an output (for its largest magnitude), or a list of a value for each run.
        """
        import numpy as np

        listed = self[values] if isinstance(values, str) else np.asarray(values)
        return listed.reshape(self.shape)

    def table(self) -> dict[str, Any]:
        """All of it as columns by name: parameters, ``output.max`` and so on, numbers, modes, status."""
        columns: dict[str, Any] = dict(self.parameters)
        for name, five in self.peaks.items():
            columns.update({f"{name}.{part}": values for part, values in five._asdict().items()})
        columns.update(self.numbers)
        if any(self.mode):
            columns.update(initial_mode=self.initial_mode, mode=self.mode)
        columns.update(status=self.status, good=self.good, engine=self.engine, message=self.messages)
        return columns

    def to_pandas(self) -> pandas.DataFrame:
        """:meth:`table` as a data frame of pandas."""
        import pandas

        return pandas.DataFrame(self.table())

    def to_polars(self) -> polars.DataFrame:
        """:meth:`table` as a data frame of Polars."""
        import polars

        return polars.DataFrame(self.table())

    def to_arrow(self) -> pyarrow.Table:
        """:meth:`table` as an Arrow table of pyarrow."""
        import pyarrow

        return pyarrow.table(self.table())

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The Arrow PyCapsule interface, by way of pyarrow."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        lanes = sum(e == "lanes" for e in self.engine)
        failed = self.runs - int(self.good.sum())
        return f"<SweepResult of {self.runs} runs over {', '.join(self.parameters)}: {lanes} in lanes, {failed} failed>"

    def _repr_html_(self) -> str:
        from html import escape

        from ._html import table

        shown = min(self.runs, 10)
        head = [*self.parameters, *(f"|{n}| [{self.units[n]}]" for n in self), "status"]
        columns = [*self.parameters.values(), *(self[n].tolist() for n in self), self.status]
        rows = [tuple(c[i] for c in columns) for i in range(shown)]
        more = f"<p>{escape(repr(self))}</p>"
        return more + table(head, rows) + ("<p>…</p>" if shown < self.runs else "")

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.good.flags.writeable = False
        for five in self.peaks.values():
            for values in five:
                frozen(values)


class _Peaks(dict[str, SweepPeaks]):
    def __missing__(self, name: str) -> SweepPeaks:
        raise unknown("output", name, self)


def sweep(
    model: Model,
    values: Mapping[str, Iterable[float | str]],
    /,
    *,
    how: Literal["grid", "list"] = "grid",
    case: str | None = None,
    fixed_steps: int | None = None,
    threads: int | None = None,
) -> SweepResult:
    """Runs a model with many values of its parameters, on all cores, several runs to a core where the model fits.

        s = tl.sweep(m, {"mu": [0.2, 0.4, 0.6], "ah": np.linspace(0.5, 2.0, 16)})
        s.grid("slide")                     # 3 × 16

    :param values: values by parameter: numbers in SI, or texts such as ``"5 mm"``.
    :param how: ``"grid"`` for all combinations, ``"list"`` for the first values of all, the second values, and so on.
    :param case: its name; without it the last of the model.
    :param fixed_steps: so many equal steps to an output step, whatever the model says.
    :param threads: without it, as many as the machine runs at once. The numbers are the same to the bit.
    :raises ArgumentError: for parameters that there are not, and lists that do not fit. A run that fails is no error: its row
        says so.
    """
    if how not in ("grid", "list"):
        raise ArgumentError(f'how must be "grid" or "list", it is {how!r}')
    axes = {name: _axis(name, given) for name, given in values.items()}
    if not axes:
        raise ArgumentError("no parameter is given: there is nothing to sweep")
    if how == "grid":
        shape = tuple(len(axis) for axis in axes.values())
        rows = list(product(*axes.values()))
    else:
        lengths = {name: len(axis) for name, axis in axes.items()}
        if len(set(lengths.values())) > 1:
            raise ArgumentError(f"lists of one length are wanted, these are of {lengths}")
        rows = list(zip(*axes.values()))
        shape = (len(rows),)
    names = list(axes)
    combinations = [[(name, text) for name, (_, text) in zip(names, row)] for row in rows]
    parameters: dict[str, list[float | str]] = {
        name: [row[i][0] for row in rows] for i, name in enumerate(names)
    }
    table = _native.sweep(
        model._native,
        case,
        combinations,
        whole("fixed_steps", fixed_steps),
        whole("threads", threads),
    )
    return SweepResult(parameters, shape, model.outputs, table)


def _axis(name: str, values: Iterable[float | str]) -> list[tuple[float | str, str]]:
    """Values of a parameter, and how the reader takes each."""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        raise ArgumentError(f"the values of {name!r} must be a list, not {values!r}")
    ndim = getattr(values, "ndim", 1)
    if ndim != 1:
        raise ArgumentError(f"the values of {name!r} must have one dimension, they have {ndim}")
    listed = values.tolist() if hasattr(values, "tolist") else list(values)
    if not listed:
        raise ArgumentError(f"there are no values of {name!r}")
    found: list[tuple[float | str, str]] = []
    for i, value in enumerate(listed):
        text = written(name, value)
        if not isinstance(value, str):
            value = float(value)
            if value - value != 0.0:
                raise ArgumentError(f"value {i} of {name!r} is no finite number: {value}")
        found.append((value, text))
    return found
