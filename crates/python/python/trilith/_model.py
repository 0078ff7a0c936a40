"""Models."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from . import _native
from ._arrays import positive, whole
from ._errors import ArgumentError, Diagnostic

if TYPE_CHECKING:
    from os import PathLike

    from ._combine import Combinations
    from ._compare import Comparison
    from ._law import CLaw, Law
    from ._modes import Modes
    from ._native import State
    from ._optimize import Gradient, Optimum
    from ._reduce import Reduction
    from ._result import Result
    from ._stepper import Stepper

    Laws: TypeAlias = Sequence[type[Law] | CLaw]

#: Name of a model that was given as a text.
NAME = "model.ron"


class Case(NamedTuple):
    """An analysis case."""

    #: Its name.
    name: str
    #: ``"static"`` or ``"dynamic"``.
    kind: str
    #: The case that it continues.
    after: str | None
    #: Length and output step of a dynamic case, s.
    duration: float | None
    dt: float | None
    #: Its own solver.
    solver: str | None


class Element(NamedTuple):
    """An element, a constraint or a link of a model."""

    #: Its name.
    name: str
    #: Its kind, such as ``"Beam"``.
    kind: str
    #: ``"linear"``, ``"constraint"`` or ``"link"``.
    category: str
    #: Names of its nodes.
    nodes: tuple[str, ...]


def written(name: str, value: object) -> str:
    """The value of a parameter as text: a number in SI with all its digits, or a text as it is."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "1" if value else "0"
    if hasattr(value, "__fspath__"):
        return str(value.__fspath__())
    # Numbers of NumPy as well, but no arrays.
    if getattr(value, "ndim", 0) == 0:
        if hasattr(value, "__index__"):
            return str(value.__index__())
        if hasattr(value, "__float__"):
            return repr(float(value))
    raise ArgumentError(
        f"the value of parameter {name!r} must be a number or a text, such as \"5 mm\": it is a {type(value).__name__}"
    )


def settings(parameters: Mapping[str, object]) -> list[tuple[str, str]]:
    """Values of parameters, as the reader takes them."""
    return [(name, written(name, value)) for name, value in parameters.items()]


def folder_of(folder: str | PathLike[str] | None) -> Path:
    """The folder that files of a model text are looked for in."""
    return Path(folder) if folder is not None else Path()


class Model:
    """A model. It never changes: it may be run from several threads at once, and :meth:`with_parameters` makes another.

    Read one by :func:`load` or :func:`loads`, or build it of sections as a model file has them::

        m = tl.Model(
            plane="XZ",
            nodes={"top": (0, 0, 1), "base": (0, 0, 0)},
            supports={"base": "Fixed"},
            elements={
                "mass": tl.Mass(node="top", mass="1 t"),
                "column": tl.Spring(nodes=("base", "top"), k1="1 MN/m", k2="40 kN/m", r2=1, r3=1),
            },
            cases={"swing": tl.Dynamic(duration="2 s", dt="5 ms",
                                       initial=[dict(node="top", dof="Ux", displacement="2 cm")])},
            outputs={"sway": tl.Displacement(node="top", dof="Ux")},
        )

    What is built goes through the reader of model files: :attr:`text` is the file, and errors point into it.

    :param folder: where files that the model names are looked for; without it, the current folder.
    :param laws: laws that it may name beside the built-in kinds: classes made of :class:`Law`, and what :func:`c_laws` found.
    :raises ModelError: with all that is wrong.
    """

    __slots__ = ("_native", "_laws")

    _native: _native.Model
    _laws: Laws

    def __init__(
        self,
        *,
        nodes: Mapping[str, object] | None = None,
        elements: Mapping[str, object] | None = None,
        cases: Mapping[str, object] | None = None,
        title: str | None = None,
        include: Sequence[str] | None = None,
        units: Mapping[str, str] | None = None,
        plane: str | None = None,
        gravity: float | str | None = None,
        parameters: Mapping[str, object] | None = None,
        supports: Mapping[str, object] | None = None,
        properties: Mapping[str, object] | None = None,
        groups: Mapping[str, object] | None = None,
        damping: object | None = None,
        p_delta: str | None = None,
        functions: Mapping[str, object] | None = None,
        loads: Mapping[str, object] | None = None,
        combinations: Mapping[str, object] | None = None,
        outputs: Mapping[str, object] | None = None,
        spectra: Mapping[str, object] | None = None,
        envelopes: Mapping[str, object] | None = None,
        folder: str | PathLike[str] | None = None,
        laws: Laws = (),
        **more: object,
    ) -> None:
        from ._law import natives
        from ._ron import model

        text = model(
            {
                "title": title,
                "include": include,
                "units": units,
                "plane": plane,
                "gravity": gravity,
                "parameters": parameters,
                "nodes": nodes,
                "supports": supports,
                "properties": properties,
                "elements": elements,
                "groups": groups,
                "damping": damping,
                "p_delta": p_delta,
                "functions": functions,
                "loads": loads,
                "cases": cases,
                "combinations": combinations,
                "outputs": outputs,
                "spectra": spectra,
                "envelopes": envelopes,
                # The reader says what is wrong with it.
                **more,
            }
        )
        self._native = _native.Model.read(text, folder_of(folder) / NAME, [], natives(laws))
        self._laws = tuple(laws)

    # -- what it is

    @property
    def title(self) -> str:
        """Its title."""
        return self._native.title

    @property
    def text(self) -> str:
        """The text that it was read from."""
        return self._native.text

    @property
    def path(self) -> Path:
        """The file that it was read from, or what errors call it."""
        return Path(self._native.path)

    @property
    def sha256(self) -> str:
        """SHA-256 of its text, as ``summary.json`` has it."""
        return self._native.sha256

    @property
    def parameters(self) -> dict[str, float | str]:
        """Its parameters with their values: numbers in SI, and texts."""
        found: dict[str, float | str] = {}
        for name, x, text, _ in self._native.parameters():
            found[name] = x if x is not None else text or ""
        return found

    @property
    def parameter_units(self) -> dict[str, str]:
        """SI units of the parameters that are numbers; ``"1"`` for a pure number."""
        return {name: unit for name, x, _, unit in self._native.parameters() if x is not None}

    @property
    def nodes(self) -> dict[str, tuple[float, float, float]]:
        """Positions of the nodes, m."""
        return {name: (x, y, z) for name, (x, y, z) in self._native.nodes()}

    @property
    def elements(self) -> dict[str, Element]:
        """Its elements, constraints and links."""
        all_of = self._native.elements()
        return {n: Element(n, kind, category, tuple(nodes)) for n, kind, category, nodes in all_of}

    @property
    def links(self) -> list[str]:
        """Names of its links."""
        return [e.name for e in self.elements.values() if e.category == "link"]

    @property
    def laws(self) -> Laws:
        """The laws that it may name beside the built-in kinds."""
        return self._laws

    @property
    def cases(self) -> dict[str, Case]:
        """Its analysis cases."""
        found = {}
        for name, kind, after, dynamic in self._native.cases():
            duration, dt, solver = dynamic or (None, None, None)
            found[name] = Case(name, kind, after, duration, dt, solver)
        return found

    @property
    def outputs(self) -> dict[str, str]:
        """Its outputs, with their SI units."""
        return dict(self._native.outputs())

    def resolved(self) -> str:
        """The model with every default filled in, every expression evaluated, in SI."""
        return self._native.resolved()

    def with_parameters(self, parameters: Mapping[str, object] | None = None, /, **more: object) -> Model:
        """Another model, with these values of its parameters: numbers in SI, or texts such as ``"5 mm"``.

        Files are read again.

        :raises ModelError: for names that are no parameters, and values that do not fit.
        """
        changed = {**dict(self._native.set), **dict(settings({**(parameters or {}), **more}))}
        return again(self.text, str(self.path), list(changed.items()), self._laws)

    # -- what it does

    def check(self) -> list[Diagnostic]:
        """What there is to say of it before it runs: the first error of the assembly, or warnings; empty where nothing is."""
        return [Diagnostic(*one) for one, _ in self._native.check()]

    def modes(
        self,
        case: str | None = None,
        *,
        links: str | None = None,
        after: str | None = None,
        amplitude: float | None = None,
        of: str | Sequence[str] | None = None,
        count: int = 12,
    ) -> Modes:
        """Modes of the structure without links, and how well the basis of a case (the last dynamic one) holds its links;
        or, where it is said how links count, the lowest modes with them.

        Example::

            m.modes(links="engaged").period[:3]
            m.modes(links="secant", amplitude=0.2).damping

        :param case: whose basis; without ``links`` alone.
        :param links: ``"engaged"``: as stiff as they are when closed, sticking and elastic; ``"tangent"``: by the tangents of
            their laws; ``"secant"``: by secants of cycles, with their damping; ``"open"``: not at all.
        :param after: state in which laws are asked: the end of this case, or ``"rest"``; without it as the last dynamic
            case begins.
        :param amplitude: of the cycles of ``"secant"``, m.
        :param of: names of the links that are led through cycles, ``*`` stands for anything; without them all with shear axes.
        :param count: how many modes with links.
        :raises ModelError: where the structure is none.
        :raises ArgumentError: for a case, a link or a way that there is not, and for what goes with another way.
        """
        from ._modes import Modes

        if links is None:
            given = {"after": after, "amplitude": amplitude, "of": of}
            alone = [name for name, value in given.items() if value is not None]
            if alone:
                raise ArgumentError(f"{alone[0]} says how links count, which they do not without links=\"engaged\" or another")
            return Modes(*self._native.modes(case))
        if case is not None:
            raise ArgumentError("modes with links do not go by the basis of a case: after= says in which state links are")
        if links != "secant" and (amplitude is not None or of is not None):
            raise ArgumentError(f"cycles are those of links=\"secant\", and links is \"{links}\"")
        names = [of] if isinstance(of, str) else None if of is None else list(of)
        a, n = positive("amplitude", amplitude), whole("count", count)
        return Modes(*self._native.linked_modes(links, after, a, names, n or 1))

    def run(
        self,
        case: str | None = None,
        *,
        solver: str | None = None,
        dt: float | None = None,
        until: float | None = None,
        vectors: int | None = None,
        errors: bool = True,
        histories: bool = True,
        frames: int = 200,
        start: State | None = None,
        progress: Callable[[float], object] | None = None,
    ) -> Result:
        """Runs a case and those that it continues.

        A run that stops on its way is no error: :attr:`Result.status` says so, and its histories go as far as it came.

        :param case: its name; without it the last case of the model.
        :param solver: ``"fna"``, ``"hht"``, ``"ritz-hht"`` or ``"full-newton"``; without it that of the case.
        :param dt: output step, s.
        :param until: stop at the first output time not before this, s.
        :param vectors: vectors of the basis.
        :param errors: find out what the steps make of the errors of the outputs, by a second run beside.
        :param histories: keep histories, loops and shapes; without them a run needs constant memory, and has peaks only.
        :param frames: deformed shapes to keep, for the page.
        :param start: go on from the end of an earlier run of the same case, :attr:`Result.state`.
        :param progress: called with the finished share, 0 … 1, now and then.
        :raises ModelError: where the structure is none.
        :raises RunError: where the run cannot be made.
        :raises LawError: where a law of :attr:`laws` is wrong, with what it raised as its cause.
        :raises ArgumentError: for a case or solver that there is not.
        :raises KeyboardInterrupt: upon Ctrl-C, within a tenth of a second.
        """
        from ._result import Result

        if frames < 0:
            raise ArgumentError(f"frames must not be below 0, it is {frames}")
        run = self._native.run(
            case,
            solver,
            positive("dt", dt),
            positive("until", until),
            whole("vectors", vectors),
            errors,
            histories,
            frames,
            start,
            progress,
        )
        wrong = run.law_error()
        if wrong is not None:
            wrong.result = Result(run)
            raise wrong
        return Result(run)

    def stepper(
        self, case: str | None = None, *, solver: str | None = None, dt: float | None = None
    ) -> Stepper:
        """A dynamic case to be led from output step to output step, with its state to be taken and put back.

        The parameters are those of :meth:`run`.
        """
        from ._stepper import Stepper

        return Stepper(self, case, solver, dt)

    def compare(self, solvers: Sequence[str] = (), **settings: Any) -> Comparison:
        """Solves a case in several ways, and finds why the results differ: see :func:`trilith.compare`."""
        from ._compare import compare

        return compare(self, solvers, **settings)

    def gradient(
        self,
        by: Sequence[str] = (),
        of: Sequence[str] = (),
        *,
        case: str | None = None,
        solver: str | None = None,
        dt: float | None = None,
    ) -> Gradient:
        """Runs a dynamic case, and finds exact derivatives of outputs by parameters.

        :param by: names of parameters; without them all that are numbers other than zero and leave the times of the case alone.
        :param of: names of outputs; without them all. ``"input"`` is the energy that loads and moving supports put in.
        :param case: its name; without it the last case of the model.
        :param solver: ``"fna"``, ``"hht"`` or ``"ritz-hht"``; without it that of the case.
        :param dt: output step, s.
        :raises RunError: where a parameter moves what must stay as it is, such as the output step.
        :raises ArgumentError: for names that there are not.
        """
        from ._optimize import gradient

        return gradient(self, by, of, case=case, solver=solver, dt=dt)

    def combine(
        self, of: Sequence[str] = (), *, progress: Callable[[float], object] | None = None
    ) -> Combinations:
        """Runs the cases that ``combinations`` of the model need, and makes sums and envelopes of their extremes.

        :param of: names of combinations; without them all.
        :param progress: called with the finished share, 0 … 1.
        :raises RunError: where a case comes to no good end.
        :raises ArgumentError: for names that there are not, and a model without combinations.
        :raises KeyboardInterrupt: upon Ctrl-C.
        """
        from ._combine import combine

        return combine(self, of, progress=progress)

    def reduce(
        self,
        part: str | Sequence[str],
        modes: int | None = None,
        *,
        up_to: float | None = None,
        keep: Sequence[str] | None = None,
        recover: Sequence[str] = (),
        recover_all: bool = False,
        out: str | PathLike[str] | None = None,
        form: str | None = None,
    ) -> Reduction:
        """A superelement of few rows in place of a linear part (Craig–Bampton): of nodes that the rest of the model touches,
        and of modes with these held.

        Example::

            small = m.reduce("wall", 12).model
            small.run()["drift"]

        :param part: names of elements or of groups of them, ``*`` stands for anything.
        :param modes: how many of the lowest; without it and ``up_to`` all, which is exact.
        :param up_to: all modes up to this frequency, Hz.
        :param keep: nodes that are kept beside those that the rest touches; without it those that loads and outputs name.
        :param recover: nodes that follow the rows, for outputs and loads.
        :param recover_all: all nodes of the part that are not kept follow.
        :param out: a folder that the model and its matrices are written to.
        :param form: of the matrices there: ``"npz"``, ``"mtx"``, ``"dmig"`` or ``"op4"``; without it ``"npz"``.
        :raises ModelError: where the structure is none.
        :raises ArgumentError: for names that there are not, and a part that is not linear or not held by what is kept.
        :raises RunError: where its modes cannot be found.
        :raises FileError: where the files cannot be written.
        """
        from ._reduce import reduce

        return reduce(self, part, modes, up_to, keep, recover, recover_all, out, form)

    def optimize(
        self,
        by: Mapping[str, Sequence[object]],
        minimise: str | Sequence[str],
        limits: Sequence[str] = (),
        *,
        log: Sequence[str] = (),
        max_runs: int = 50,
        case: str | None = None,
        solver: str | None = None,
        dt: float | None = None,
        progress: Callable[[float], object] | None = None,
    ) -> Optimum:
        """Searches for the values of parameters that make a goal smallest, beginning with those that the model has.

        :param by: parameters with their bounds, numbers in SI or texts: ``{"mu": (0.02, 0.2), "c": ("10 kN*s/m", "1 MN*s/m")}``; the
            name ``"c*"`` stands for all whose names begin so.
        :param minimise: an output, which stands for its largest magnitude, or an expression such as ``"roof + 0.1*base"``; of several
            the largest. ``"drift*"`` stands for all outputs whose names begin so, ``"final(slide)"`` for a value at the end.
        :param limits: such as ``["base_x <= 20 cm", "c1 + c2 <= 3 MN*s/m"]``.
        :param log: parameters of ``by`` whose steps are shares of the value, for bounds that are powers of ten apart.
        :param max_runs: runs at most.
        :param case: its name; without it the last case of the model.
        :param solver: as for :meth:`gradient`.
        :param dt: output step, s.
        :param progress: called with the share of the runs that are made, 0 … 1.
        :raises RunError: where there are no derivatives by a parameter.
        :raises ArgumentError: for a goal, a limit or bounds that are none.
        :raises KeyboardInterrupt: upon Ctrl-C.
        """
        from ._optimize import optimize

        return optimize(
            self,
            by,
            minimise,
            limits,
            log=log,
            max_runs=max_runs,
            case=case,
            solver=solver,
            dt=dt,
            progress=progress,
        )

    # -- pickles and copies

    def __repr__(self) -> str:
        elements = self._native.elements()
        links = sum(1 for e in elements if e[2] == "link")
        title = self.title or self.path.name
        return f"<Model {title!r}: {len(self._native.nodes())} nodes, {len(elements)} elements, {links} of them links>"

    def __reduce__(self) -> tuple[Callable[..., Model], tuple[str, str, list[tuple[str, str]], Laws]]:
        return again, (self.text, str(self.path), self._native.set, self._laws)

    def __copy__(self) -> Model:
        return self

    def __deepcopy__(self, memo: object) -> Model:
        return self

    def _key(self) -> tuple[object, ...]:
        return self.text, str(self.path), tuple(self._native.set), tuple(self._laws)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())


def made(native: _native.Model, laws: Laws) -> Model:
    """A model of what was read."""
    it = Model.__new__(Model)
    it._native = native
    it._laws = tuple(laws)
    return it


def again(text: str, path: str, set_: list[tuple[str, str]], laws: Laws = ()) -> Model:
    """A model out of a pickle."""
    from ._law import natives

    return made(_native.Model.read(text, Path(path), set_, natives(laws)), laws)


def load(
    path: str | PathLike[str],
    /,
    parameters: Mapping[str, object] | None = None,
    *,
    laws: Laws = (),
    **more: object,
) -> Model:
    """Reads a model file.

    :param path: the file.
    :param parameters: values of parameters that replace those of the file, also by keyword: numbers in SI, or texts such as
        ``"5 mm"``.
    :param laws: laws that it may name beside the built-in kinds: classes made of :class:`Law`, and what :func:`c_laws` found.
    :raises ModelError: with all that is wrong, with file, line, column and what would be right.
    """
    from ._law import natives

    set_ = settings({**(parameters or {}), **more})
    return made(_native.Model.load(Path(path), set_, natives(laws)), laws)


def loads(
    text: str,
    /,
    *,
    folder: str | PathLike[str] | None = None,
    laws: Laws = (),
    parameters: Mapping[str, object] | None = None,
    **more: object,
) -> Model:
    """Reads a model from a text.

    :param text: the text, as a model file has it.
    :param folder: where files that it names are looked for; without it, the current folder.
    :param laws: as in :func:`load`.
    :param parameters: as in :func:`load`.
    :raises ModelError: with all that is wrong.
    """
    from ._law import natives

    set_ = settings({**(parameters or {}), **more})
    return made(_native.Model.read(text, folder_of(folder) / NAME, set_, natives(laws)), laws)
