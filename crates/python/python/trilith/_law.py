"""Laws of links of one's own, in Python and in shared libraries."""

from __future__ import annotations

import atexit
import inspect
import json
from collections import namedtuple
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from . import _native
from ._errors import ArgumentError, Refusal
from ._ron import Block

if TYPE_CHECKING:
    from os import PathLike
    from types import TracebackType

    from ._arrays import Array

# Threads that a run was left in upon Ctrl-C must not wait for an interpreter that is gone.
atexit.register(_native.end_of_laws)

#: Methods of a law, and what they are given beside the law itself.
METHODS = {
    "force": ("d", "v", "history", "step"),
    "tangent": ("d", "v", "history", "step"),
    "energy": ("d", "v", "history", "step"),
    "engaged": (),
    "at_rest": (),
    "check": (),
}
#: How many of these a method may leave out at the end.
OPTIONAL = {"force": 1, "tangent": 1, "energy": 1}
#: Names of a law that are no parameters.
OWN = {*METHODS, "axes", "history", "rates", "amplitude", "frequency", "compiled", "source"}
#: Shapes of one number.
ONE = {(1,), (1, 1)}
#: Laws that a class has with different parameters, kept ready.
READY = 1000


class Parameter(NamedTuple):
    """A parameter of a law, as :func:`parameter` declares it."""

    unit: str
    default: float | str | None
    range: str | tuple[float, float]
    meaning: str
    example: float | str | None


def parameter(
    unit: str = "1",
    *,
    default: float | str | None = None,
    range: str | tuple[float, float] = "any",
    meaning: str = "",
    example: float | str | None = None,
) -> Any:
    """Declares a parameter in the class of a :class:`Law`; inside the law it is a number in SI.

    :param unit: its SI unit, such as ``"N/m"``, ``"N*s/m"``, ``"m"`` or ``"1"``; values in a model are checked for it.
    :param default: what holds where a model says nothing, a number in SI or a text such as ``"5 mm"``; without it a model must say.
    :param range: ``"any"``, ``"> 0"``, ``">= 0"``, or two numbers that it lies between.
    :param meaning: one sentence.
    :param example: a value for the example on its card, where there is no default.
    """
    return Parameter(unit, default, range, meaning, example)


class LawStep(NamedTuple):
    """Where a step of a law begins, and how long it is."""

    #: Deformations and rates at its start, m and rad, one for each coordinate.
    d0: Array
    v0: Array
    #: Its length, s; 0 in static cases and where the law is only looked at.
    dt: float
    #: The history that was committed there.
    history0: Any


class Law(Block):
    """A law of links. A class of it is a kind of link: a model that is read with ``laws=[Hardening]`` may say ``Hardening(…)``::

        class Hardening(tl.Law):
            \"\"\"Spring that hardens with the cube of its deformation.\"\"\"

            k: float = tl.parameter("N/m", range="> 0", meaning="stiffness at rest")
            a: float = tl.parameter("1/m^2", default=0.0, meaning="how fast it hardens")
            axes = ("U1",)
            rates = False

            def force(self, d, v, history):
                return self.k * (d[0] + self.a * d[0] ** 3)

            def energy(self, d, v, history):
                return 0.5 * self.k * d[0] ** 2 * (1 + 0.5 * self.a * d[0] ** 2), 0.0, 0.0

    ``force(self, d, v, history)`` is a pure function: of deformations ``d`` (m, rad) and rates ``v``, arrays with an entry for each
    coordinate, and of the history that was committed where the step began, with a number for each of the names in
    :attr:`history`, such as ``history.slip``. It returns the forces (positive where they resist positive ``d``; a number will do for
    one) and, of a law that has a history, the history at the end of the step: ``return f, (slip,)``. Iterations ask again and
    again from the same start; what is kept between steps is the history of the one that was accepted, and nothing else.

    It may have, each with the same arguments:

    - ``tangent`` for ∂f/∂d and ∂f/∂v, two matrices n × n (numbers for n = 1), the first alone where :attr:`rates` is false. Without it
      central differences are taken, right to about 1e-9 of the force over the amplitude for a smooth law; they cost 2 n more
      calls of ``force``, or 4 n.
    - ``energy`` for what it stores at the end of the step, and what the step turned to heat without and with regard to rates:
      three numbers, J. Its ``history`` is that at the *end* of the step. Without it the work that is done on the link counts as heat,
      negative where it gives work back: the ledger of a run then says nothing of the law, and the run warns of it.

    All three may take a last argument ``step``, a :class:`LawStep`: where the step began, and its length. With no arguments but ``self``:

    - ``engaged`` for the stiffness where the law is engaged, n × n; without it, the diagonal of the tangent at rest,
    - ``at_rest`` for the history before anything has happened; without it, zeros,
    - ``check``, which raises ``ValueError`` where parameters do not go together.

    A law that holds no more raises :class:`Refusal`; any other exception ends the run as :class:`LawError`.

    Where numba is installed, ``force``, ``tangent`` and ``energy`` are compiled: they are called without the interpreter then, by many
    threads at once. They may use what numba knows (``np.dot`` and ``@`` of it want scipy); ``self`` has the parameters there and
    nothing else, and ``d`` and ``v`` are to be read only. Where numba cannot compile a law it stays plain Python, with a warning.
    """

    #: Local axes of its coordinates, such as ``("U2", "U3")``.
    axes: ClassVar[Sequence[str]] = ("U1",)
    #: Names of its history variables with their SI units, such as ``{"slip": "m"}``.
    history: ClassVar[Mapping[str, str]] = {}
    #: Whether it looks at rates. Without that ``v`` is not a number, and runs are quicker.
    rates: ClassVar[bool] = True
    #: Deformations at which it does what it is for, m or rad: one for all coordinates, or one for each. Differences and the
    #: conformance kit are measured by it.
    amplitude: ClassVar[float | Sequence[float]] = 0.01
    #: Cycles of such deformations in a second, Hz.
    frequency: ClassVar[float] = 1.0
    #: ``None``: compiled by numba where that can be; ``True``: an error where it cannot; ``False``: plain Python.
    compiled: ClassVar[bool | None] = None
    #: Where the law comes from.
    source: ClassVar[str] = ""

    def __init_subclass__(cls, **more: Any) -> None:
        super().__init_subclass__(**more)
        cls._name = cls.__name__


class CLaw:
    """A law of a shared library, from :func:`c_laws`. Called with the fields of a link it is an element of a :class:`Model`, as the
    class of a kind is: ``Yielding(node="a", k="1 kN/m")``."""

    __slots__ = ("_native", "_path", "_block")

    def __init__(self, native: _native.Law, path: Path) -> None:
        self._native = native
        self._path = path
        self._block = type(native.kind, (Block,), {"_name": native.kind})

    @property
    def kind(self) -> str:
        """Its name in model files."""
        return self._native.kind

    def __call__(self, **fields: Any) -> Block:
        block: Block = self._block(**fields)
        return block

    def __repr__(self) -> str:
        return f"<law {self.kind} of {self._path}>"

    def __reduce__(self) -> tuple[Callable[[str, str], CLaw], tuple[str, str]]:
        return _one_of, (str(self._path), self.kind)


def c_laws(path: str | PathLike[str], /) -> list[CLaw]:
    """The laws of a shared library in C, or in any language that keeps to ``trilith_link.h``
    (:func:`c_header`)::

        m = tl.load("m.ron", laws=tl.c_laws("./libyielding.so"))

    Opening a library runs its code: open none that you would not run.

    :param path: the library, a file.
    :raises FileError: where it cannot be opened, or has no laws.
    """
    path = Path(path)
    return [CLaw(native, path) for native in _native.Law.library(path)]


def c_header() -> str:
    """The text of ``trilith_link.h``, which says what a library of laws exports."""
    return _native.HEADER


def _one_of(path: str, kind: str) -> CLaw:
    """A law out of a pickle."""
    for law in c_laws(path):
        if law.kind == kind:
            return law
    raise ArgumentError(f"the library {path} has no law {kind} any more")


def natives(laws: Sequence[type[Law] | CLaw]) -> list[_native.Law]:
    """What the library knows of these laws.

    :raises ArgumentError: for what is no law.
    """
    if isinstance(laws, (type, CLaw, str)) or not hasattr(laws, "__iter__"):
        raise ArgumentError(f"laws is a list, such as laws=[{getattr(laws, '__name__', 'MyLaw')}]")
    return [native_of(law) for law in laws]


def native_of(law: object) -> _native.Law:
    """What the library knows of a law; a class is looked at once.

    :raises ArgumentError: for what is no law, or a law that cannot be.
    """
    if isinstance(law, CLaw):
        return law._native
    if not (isinstance(law, type) and issubclass(law, Law) and law is not Law):
        raise ArgumentError(f"{law!r} is no law: a law is a class made of trilith.Law, or comes from trilith.c_laws")
    known = law.__dict__.get("_native_law")
    if known is None or known[0] != law.compiled:
        known = (law.compiled, _made(law))
        law._native_law = known  # type: ignore[attr-defined]
    found: _native.Law = known[1]
    return found


def kind_of(kind: str | type[Law] | CLaw) -> tuple[str, list[_native.Law]]:
    """The name of a kind, and its law where it is no built-in one."""
    if isinstance(kind, str):
        return kind, []
    native = native_of(kind)
    return native.kind, [native]


def _made(law: type[Law]) -> _native.Law:
    plain = Plain(law)
    text = json.dumps(plain.declaration())
    digest = sha256("\n".join([text, *(_source(getattr(law, name)) for name in plain.stepped)]).encode()).hexdigest()
    if law.compiled is not False:
        from ._compiled import address_of

        found = address_of(plain, must=law.compiled is True)
        if found is not None:
            return _native.Law.compiled(text, plain, *found, digest)
    return _native.Law.plain(text, plain, digest)


def _source(method: Any) -> str:
    """The text of a method, or its code where there is no text."""
    try:
        return inspect.getsource(method)
    except (OSError, TypeError):
        code = getattr(method, "__code__", None)
        return repr((code.co_code, code.co_names)) if code else repr(method)


class Plain:
    """A law for the library, which calls the methods of the law itself, and those of this one for what is not done for each answer
    and for answers that are no plain numbers."""

    def __init__(self, law: type[Law]) -> None:
        import numpy as np

        self.law = law
        self.kind = law.__name__
        wrong = f"{self.kind}: "
        if not callable(getattr(law, "force", None)):
            raise ArgumentError(wrong + "a law has a method force(self, d, v, history)")
        #: Whether a method takes the step.
        self.stepped = {name: self._looked_at(name) for name in METHODS if hasattr(law, name)}
        self.parameters: dict[str, Parameter] = {}
        for base in reversed(law.__mro__):
            for name, value in vars(base).items():
                if isinstance(value, Parameter):
                    if name in OWN or name.startswith("_"):
                        raise ArgumentError(wrong + f"a parameter must not be called {name!r}")
                    self.parameters[name] = value
        if not isinstance(law.history, Mapping):
            raise ArgumentError(wrong + 'history is a dict of names and units, such as {"slip": "m"}')
        self.axes = [law.axes] if isinstance(law.axes, str) else [str(a) for a in law.axes]
        self.n, self.h = len(self.axes), len(law.history)
        for name in law.history:
            if not str(name).isidentifier() or str(name).startswith("_"):
                raise ArgumentError(wrong + f"{name!r} is no name of a history variable")
        tuple_of: Any = namedtuple
        self.values = tuple_of(self.kind, list(self.parameters))
        self.memory = tuple_of("History", list(law.history))
        self._asarray = np.asarray
        self._ready: dict[tuple[float, ...], Law] = {}

    def _looked_at(self, name: str) -> bool:
        """Whether a method takes the step."""
        wanted = ("self", *METHODS[name])
        method = getattr(self.law, name)
        try:
            given = list(inspect.signature(method).parameters.values())
        except (TypeError, ValueError):
            given = []
        plain = all(p.kind in (p.POSITIONAL_OR_KEYWORD, p.POSITIONAL_ONLY) for p in given)
        if plain and len(wanted) - OPTIONAL.get(name, 0) <= len(given) <= len(wanted):
            return len(given) == len(wanted) and name in OPTIONAL
        last = f"[, {wanted[-1]}]" if name in OPTIONAL else ""
        plain_ones = ", ".join(wanted[: len(wanted) - OPTIONAL.get(name, 0)])
        raise ArgumentError(f"{self.kind}: {name} takes ({plain_ones}{last})")

    def declaration(self) -> dict[str, object]:
        """What the card of the kind is made of."""
        law = self.law
        summary, _, text = (inspect.cleandoc(law.__doc__ or "")).partition("\n\n")
        amplitude = law.amplitude
        sizes = [float(amplitude)] * self.n if isinstance(amplitude, (int, float)) else [float(a) for a in amplitude]
        return {
            "kind": self.kind,
            "summary": " ".join(summary.split()),
            "law": text,
            "source": law.source,
            "axes": self.axes,
            "parameters": [self._declared(name, p) for name, p in self.parameters.items()],
            "history": [{"name": str(n), "unit": str(u)} for n, u in law.history.items()],
            "rates": bool(law.rates),
            "tangent": "tangent" in self.stepped,
            "energy": "energy" in self.stepped,
            "amplitude": sizes,
            "frequency": float(law.frequency),
        }

    def _declared(self, name: str, p: Parameter) -> dict[str, object]:
        words = {"any": "Any", "> 0": "Positive", ">= 0": "NonNegative", "≥ 0": "NonNegative"}
        if isinstance(p.range, str):
            if p.range not in words:
                raise ArgumentError(
                    f"{self.kind}: the range of {name} is {p.range!r}: it must be 'any', '> 0', '>= 0', or two numbers (low, high)"
                )
            allowed: object = words[p.range]
        else:
            allowed = {"Within": [float(x) for x in p.range]}
        values = {
            key: value if value is None or isinstance(value, str) else float(value)
            for key, value in (("default", p.default), ("example", p.example))
        }
        return {"name": name, "unit": p.unit, "meaning": p.meaning, "range": allowed, **values}

    # -- what the library calls

    def at(self, p: tuple[float, ...]) -> Any:
        """The law with these parameters."""
        it = self._ready.get(p)
        if it is None:
            it = self.law.__new__(self.law)
            it.__dict__.update(zip(self.parameters, p))
            if len(self._ready) >= READY:
                self._ready.clear()
            self._ready[p] = it
        return it

    def forces(self, given: Any) -> tuple[list[float], list[float]]:
        """Forces and the history at the end of the step, of what ``force`` has returned."""
        if self.h == 0:
            return self._numbers("force", "a force", given, (self.n,)), []
        if not (isinstance(given, tuple) and len(given) == 2):
            raise TypeError(
                f"{self.kind}.force must return the forces and the history, `return f, ({', '.join(self.memory._fields)},)`: "
                f"it returned {_shown(given)}"
            )
        f, new = given
        return self._numbers("force", "a force", f, (self.n,)), self._numbers("force", "a history", new, (self.h,))

    def tangents(self, given: Any) -> tuple[list[float], list[float]]:
        """The tangents by deformations and by rates, of what ``tangent`` has returned."""
        if not self.law.rates:
            return self._numbers("tangent", "∂f/∂d", given, (self.n, self.n)), []
        if not (isinstance(given, tuple) and len(given) == 2):
            raise TypeError(
                f"{self.kind}.tangent must return two matrices, ∂f/∂d and ∂f/∂v: it returned {_shown(given)}"
            )
        k = self._numbers("tangent", "∂f/∂d", given[0], (self.n, self.n))
        return k, self._numbers("tangent", "∂f/∂v", given[1], (self.n, self.n))

    def energies(self, given: Any) -> list[float]:
        """Stored energy and heat, of what ``energy`` has returned."""
        return self._numbers("energy", "stored energy and heat", given, (3,))

    def check(self, p: tuple[float, ...]) -> None:
        """Raises where parameters do not go together."""
        if "check" in self.stepped:
            self.at(p).check()

    def engaged(self, p: tuple[float, ...]) -> list[float] | None:
        """The engaged stiffness, where it says."""
        if "engaged" not in self.stepped:
            return None
        return self._numbers("engaged", "a stiffness", self.at(p).engaged(), (self.n, self.n))

    def at_rest(self, p: tuple[float, ...]) -> list[float] | None:
        """The history before anything has happened, where it says."""
        if "at_rest" not in self.stepped:
            return None
        return self._numbers("at_rest", "a history", self.at(p).at_rest(), (self.h,))

    def _numbers(self, method: str, what: str, value: Any, shape: tuple[int, ...]) -> list[float]:
        """Numbers of a shape, row by row; one will do for one."""
        try:
            it = self._asarray(value, dtype=float)
        except (TypeError, ValueError) as e:
            raise TypeError(f"{self.kind}.{method} must return {_wanted(what, shape)}: it returned {_shown(value)}") from e
        if it.shape != shape and not (it.shape == () and shape in ONE):
            raise TypeError(
                f"{self.kind}.{method} must return {_wanted(what, shape)}: it returned {_shown(value)}, of the shape {it.shape}"
            )
        found: list[float] = it.ravel().tolist()
        return found

    def words(self, e: BaseException, trace: TracebackType | None) -> tuple[bool, str]:
        """Whether an exception says that the law holds no more; and what it says."""
        e.__traceback__ = trace
        if isinstance(e, Refusal):
            return True, str(e)
        own = isinstance(e, TypeError) and str(e).startswith(f"{self.kind}.")
        if own:
            return False, str(e)
        place = _place(e, self.law)
        return False, f"{self.kind}{place} raised {type(e).__name__}: {e}" if str(e) else f"{self.kind}{place} raised {type(e).__name__}"


def _place(e: BaseException, law: type) -> str:
    """The method of the law that an exception comes from, with its line."""
    codes = {m.__code__: name for name in METHODS if (m := getattr(law, name, None)) and hasattr(m, "__code__")}
    trace = e.__traceback__
    while trace is not None:
        name = codes.get(trace.tb_frame.f_code)
        if name is not None:
            return f".{name} (line {trace.tb_lineno} of {Path(trace.tb_frame.f_code.co_filename).name})"
        trace = trace.tb_next
    return ""


def _wanted(what: str, shape: tuple[int, ...]) -> str:
    count = " × ".join(str(size) for size in shape)
    return f"{what} of {count} numbers" if max(shape, default=1) > 1 or len(shape) > 1 else f"{what}, a number"


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "…"
