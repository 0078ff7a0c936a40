"""Numbers from the library as NumPy arrays, and the other way round. NumPy is not imported before it is needed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from ._errors import ArgumentError, unknown

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import numpy.typing as npt

    from ._native import Column

    Array: TypeAlias = npt.NDArray[np.float64]
    Numbers: TypeAlias = Array | Sequence[float]


def array(column: Column | Array) -> Array:
    """A read-only array of numbers that stay where they are."""
    import numpy as np

    return np.asarray(column)


def frozen(values: Array) -> Array:
    """The same array, read-only."""
    values.flags.writeable = False
    return values


def numbers(what: str, values: object, *, least: int = 1) -> list[float]:
    """A list of finite numbers of one dimension.

    :raises ArgumentError: for anything else.
    """
    import numpy as np

    try:
        it = np.asarray(values)
    except Exception as e:  # whatever a foreign object raises
        raise ArgumentError(f"{what} is no list of numbers: {e}") from e
    if it.dtype.kind not in "fiu":
        raise ArgumentError(f"{what} is no list of numbers: its dtype is {it.dtype}")
    if it.ndim != 1:
        raise ArgumentError(f"{what} must have one dimension, it has the shape {it.shape}")
    if it.size < least:
        raise ArgumentError(f"{what} needs at least {least} numbers, it has {it.size}")
    bad = np.flatnonzero(~np.isfinite(it))
    if bad.size:
        raise ArgumentError(f"{what} has no finite number at index {bad[0]}: {it[bad[0]]}")
    found: list[float] = it.astype(np.float64).tolist()
    return found


def positive(what: str, value: float | None) -> float | None:
    """A finite number above 0, or nothing.

    :raises ArgumentError: for anything else.
    """
    if value is None:
        return None
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ArgumentError(f"{what} is no number: {value!r}") from None
    if not 0.0 < number < float("inf"):
        raise ArgumentError(f"{what} must be a finite number above 0, it is {value!r}")
    return number


def names(what: str, values: Sequence[str]) -> list[str]:
    """A list of names."""
    if isinstance(values, str):
        raise ArgumentError(f'{what} is a list of names, such as ["{values}"]')
    return list(values)


def whole(what: str, value: int | None, *, least: int = 1) -> int | None:
    """A whole number that is not too small, or nothing.

    :raises ArgumentError: for anything else.
    """
    if value is None:
        return None
    import operator

    try:
        number = operator.index(value)
    except TypeError:
        raise ArgumentError(f"{what} must be a whole number, it is {value!r}") from None
    if number < least:
        raise ArgumentError(f"{what} must be at least {least}, it is {number}")
    return number


T = TypeVar("T")


class Named(Mapping[str, T]):
    """Values by their names; a name that there is not is told with those that there are."""

    __slots__ = ("_all", "_what")

    def __init__(self, what: str, values: Mapping[str, T]) -> None:
        self._what = what
        self._all = dict(values)

    def __getitem__(self, name: str) -> T:
        try:
            return self._all[name]
        except (KeyError, TypeError):
            raise unknown(self._what, name, self._all) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        return f"<{len(self)} {self._what}s: {', '.join(self)}>"


class Columns(Mapping[str, "Array"]):
    """Read-only arrays by name, each made when it is first looked at."""

    __slots__ = ("_columns", "_what")

    def __init__(self, what: str, columns: Mapping[str, Column | Array]) -> None:
        self._what = what
        self._columns: dict[str, Any] = dict(columns)

    def __getitem__(self, name: str) -> Array:
        try:
            column = self._columns[name]
        except (KeyError, TypeError):
            raise unknown(self._what, name, self._columns) from None
        made = array(column)
        self._columns[name] = made
        return made

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return f"<{len(self)} columns: {', '.join(self)}>"

    def __getstate__(self) -> tuple[str, dict[str, Array]]:
        return self._what, {name: self[name] for name in self}

    def __setstate__(self, state: tuple[str, dict[str, Array]]) -> None:
        self._what = state[0]
        self._columns = {name: frozen(values) for name, values in state[1].items()}
