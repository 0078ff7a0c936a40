"""The native half of the package; see `crates/python/src`."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeAlias

from ._errors import LawError

VERSION: str
#: The text of `trilith_link.h`.
HEADER: str
#: Sixteen hexadecimal digits: a digest of the sources that the library is made from.
BUILD: str

Told: TypeAlias = tuple[str, str, str, str, str | None, str, int, int]
CycleFacts: TypeAlias = tuple[float, float | None, float | None]
ExerciseFacts: TypeAlias = tuple[
    str,
    list[str],
    "Column",
    list[tuple[str, bool, "Column", "Column", "Column", CycleFacts | None]],
    list["Column"],
    list[tuple[str, str, "Column"]],
    float,
    list[str],
]
CompareFacts: TypeAlias = tuple[
    str,
    str,
    str,
    bool,
    "Column",
    list[tuple[str, "Column"]],
    list[tuple[str, float, float, float, float]],
    tuple[str, str] | None,
]
ValueFacts: TypeAlias = tuple[float, float, list[float]]
GradientFacts: TypeAlias = tuple[
    str,
    "Column",
    list[tuple[str, float, str]],
    list[tuple[str, str, "Column", list["Column"], list[ValueFacts]]],
    list[tuple[str, float, list[float]]],
    tuple[float, list[float]] | None,
    list[tuple[str, float, int]],
    int,
]
SweepFacts: TypeAlias = tuple[
    list[str],
    list[bool],
    list[str],
    list[str],
    list[tuple[str, str] | None],
    list[tuple[str, list["Column"]]],
    list[tuple[str, "Column"]],
]
StudyFacts: TypeAlias = tuple[
    str,
    list[tuple[str, str, "Column | None", list[str | None] | None]],
    list[Path],
    int,
    int,
    int,
    int,
    str | None,
]
CardFacts: TypeAlias = tuple[
    str,
    str,
    str,
    tuple[int, int | None],
    list[tuple[tuple[str, str, str, str, str, str], str, list[str], bool]],
    tuple[str, str, str],
    tuple[str, str] | None,
]
FieldFacts: TypeAlias = tuple[str, str, tuple[str, list[str], str | None], str]

class Column:
    def __len__(self) -> int: ...
    @property
    def __array_interface__(self) -> dict[str, object]: ...

class State:
    """The state at the end of a run, from which another goes on. It pickles; numbers come back to the bit."""

    @staticmethod
    def from_bytes(bytes: bytes, /) -> State:
        """From what `to_bytes` gave."""
    def to_bytes(self) -> bytes:
        """All of it."""
    @property
    def time(self) -> float:
        """Time in the case, s."""
    @property
    def case(self) -> str:
        """Name of the case."""
    @property
    def solver(self) -> str:
        """Name of the solver."""

class Law:
    @staticmethod
    def plain(text: str, function: object, digest: str, /) -> Law: ...
    @staticmethod
    def compiled(
        text: str, function: object, address: int, keep: object, digest: str, /
    ) -> Law: ...
    @staticmethod
    def library(path: Path, /) -> list[Law]: ...
    @property
    def kind(self) -> str: ...
    @property
    def accounts(self) -> bool: ...

class Run:
    def law_error(self) -> LawError | None: ...
    @property
    def good(self) -> bool: ...
    def summary(self) -> str: ...
    def text(self) -> str: ...
    def time(self) -> Column: ...
    def outputs(self) -> list[tuple[str, Column]]: ...
    def energies(self) -> list[tuple[str, Column]]: ...
    def links(self) -> list[tuple[str, str, list[tuple[str, bool, Column, Column]]]]: ...
    def end(self) -> State: ...
    def data(self, loops: list[str], /) -> str: ...
    def write(self, folder: Path, report: bool, /) -> list[Path]: ...
    def write_checkpoint(self, path: Path, /) -> None: ...

class Model:
    @staticmethod
    def load(path: Path, set: list[tuple[str, str]], laws: list[Law], /) -> Model: ...
    @staticmethod
    def read(
        text: str, path: Path, set: list[tuple[str, str]], laws: list[Law], /
    ) -> Model: ...
    @property
    def title(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def path(self) -> Path: ...
    @property
    def set(self) -> list[tuple[str, str]]: ...
    @property
    def sha256(self) -> str: ...
    def parameters(self) -> list[tuple[str, float | None, str | None, str]]: ...
    def nodes(self) -> list[tuple[str, tuple[float, float, float]]]: ...
    def elements(self) -> list[tuple[str, str, str, list[str]]]: ...
    def cases(self) -> list[tuple[str, str, str | None, tuple[float, float, str] | None]]: ...
    def outputs(self) -> list[tuple[str, str]]: ...
    def resolved(self) -> str: ...
    def check(self) -> list[tuple[Told, str]]: ...
    def modes(self, case: str | None, /) -> tuple[str, str, list[tuple[int, list[float]]]]: ...
    def linked_modes(
        self,
        links: str,
        after: str | None,
        amplitude: float | None,
        of: list[str] | None,
        count: int,
        /,
    ) -> tuple[str, str, list[tuple[int, list[float]]]]: ...
    def run(
        self,
        case: str | None,
        solver: str | None,
        dt: float | None,
        until: float | None,
        vectors: int | None,
        errors: bool,
        histories: bool,
        frames: int,
        start: State | None,
        progress: Callable[[float], object] | None,
        /,
    ) -> Run: ...
    def compare(
        self,
        case: str | None,
        solvers: list[str],
        dts: list[float],
        vectors: list[int],
        dummies: list[float],
        alphas: list[float],
        cause: bool,
        /,
    ) -> tuple[str, list[CompareFacts]]: ...
    def combine(
        self, of: list[str], progress: Callable[[float], object] | None, /
    ) -> tuple[str, str]: ...
    def reduce(
        self,
        part: list[str],
        modes: int | None,
        up_to: float | None,
        keep: list[str] | None,
        recover: list[str],
        recover_all: bool,
        out: tuple[Path, str] | None,
        /,
    ) -> tuple[str | None, Path | None, str]: ...
    def gradient(
        self,
        case: str | None,
        solver: str | None,
        dt: float | None,
        by: list[str],
        of: list[str],
        /,
    ) -> GradientFacts: ...
    def optimize(
        self,
        case: str | None,
        solver: str | None,
        dt: float | None,
        by: list[tuple[str, str, str, bool]],
        minimise: list[str],
        limits: list[str],
        max_runs: int,
        progress: Callable[[float], object] | None,
        /,
    ) -> tuple[str, str]: ...

class Record:
    @staticmethod
    def of(
        acceleration: list[float], dt: float, texts: tuple[str, str, str], notes: list[str], /
    ) -> Record: ...
    def acceleration(self) -> Column: ...
    def velocity(self) -> Column: ...
    def displacement(self) -> Column: ...
    def time(self) -> Column: ...
    @property
    def dt(self) -> float: ...
    @property
    def component(self) -> str: ...
    @property
    def station(self) -> str: ...
    @property
    def event(self) -> str: ...
    @property
    def format(self) -> str | None: ...
    @property
    def notes(self) -> list[str]: ...
    def measures(self) -> list[float]: ...
    def spectrum(self, periods: list[float], damping: float, /) -> list[Column]: ...
    def csv(self) -> str: ...

def elements(laws: list[Law], /) -> list[CardFacts]: ...
def end_of_laws() -> None: ...
def conform(
    kind: str,
    laws: list[Law],
    set: list[tuple[str, str]],
    amplitude: list[tuple[str, str]],
    mean: list[tuple[str, str]],
    frequency: float | None,
    flags: tuple[bool, bool],
    paths: int,
    seed: int,
    tolerance: float,
    /,
) -> tuple[int, int, float, list[str]]: ...
def schema() -> list[tuple[str, str, list[tuple[str, str, str, list[FieldFacts]]]]]: ...
def page(summary: str, data: str, /) -> str: ...
def pictures(data: str, names: list[str], /) -> list[tuple[str, str]]: ...
def record(
    path: Path, unit: str | None, dt: float | None, component: str | None, /
) -> list[Record]: ...
def synthetic(
    seed: int,
    peak: float | None,
    duration: float | None,
    dt: float | None,
    frequency: float | None,
    damping: float | None,
    /,
) -> Record: ...
def exercise(
    kind: str,
    set: list[tuple[str, str]],
    amplitude: list[tuple[str, str]],
    mean: list[tuple[str, str]],
    frequency: float | None,
    cycles: int,
    history: tuple[list[float], list[tuple[str, list[float]]]] | None,
    laws: list[Law],
    /,
) -> ExerciseFacts: ...
def sweep(
    model: Model,
    case: str | None,
    combinations: list[list[tuple[str, str]]],
    fixed_steps: int | None,
    threads: int | None,
    /,
) -> SweepFacts: ...
class Study:
    def __new__(cls, path: Path, set: list[tuple[str, str]], laws: list[Law], /) -> Study: ...
    @property
    def title(self) -> str: ...
    @property
    def identity(self) -> tuple[str, str, str, str, str, int]: ...
    @property
    def series(self) -> int: ...
    @property
    def keeps_histories(self) -> bool: ...
    @property
    def files(self) -> list[Path]: ...
    def run(
        self,
        folder: Path,
        threads: int | None,
        shard: tuple[int, int] | None,
        gather: bool,
        retry_failed: bool,
        store: Path | None,
        progress: Callable[[float], object] | None,
        /,
    ) -> StudyFacts: ...
    def status(
        self, folder: Path, /
    ) -> tuple[list[tuple[int, int, int, int, int, int]], int]: ...
    def open_parts(
        self, folder: Path, of: int, retry_failed: bool, /
    ) -> list[tuple[int, bytes]]: ...
    def take_part(self, folder: Path, shard: tuple[int, int], journal: bytes, /) -> int: ...

def machine() -> str: ...
def program(arguments: Sequence[str], /) -> None: ...
def panic_for_a_test() -> None: ...
