"""What a run left."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ._arrays import Columns, Named, array, frozen
from ._errors import ArgumentError, TrilithError, unknown

if TYPE_CHECKING:
    from os import PathLike

    import pandas
    import polars
    import pyarrow

    from ._arrays import Array
    from ._native import Column, Run, State


class Peak(NamedTuple):
    """Extremes of an output over all substeps, in SI."""

    #: Largest value, and when it was reached first, s.
    max: float
    t_max: float
    #: Smallest value, and when it was reached first, s.
    min: float
    t_min: float
    #: Value at the end.
    final: float
    #: SI unit.
    unit: str
    #: How far values may be off, in that unit; ``nan`` where it is not known.
    error: float

    @property
    def magnitude(self) -> float:
        """The larger of \\|max\\| and \\|min\\|."""
        return max(abs(self.max), abs(self.min))


class Loop(NamedTuple):
    """Deformation and force of a link coordinate at the output times."""

    #: Deformation, m or rad.
    d: Array
    #: Force, N or N·m.
    f: Array


class Link:
    """Deformations and forces of a link at the output times."""

    __slots__ = ("name", "kind", "rotations", "deformation", "force")

    #: Its name in the model.
    name: str
    #: Its kind, such as ``"NLink"``.
    kind: str
    #: Its coordinates, and which of them are rotations (rad and N·m instead of m and N).
    rotations: dict[str, bool]
    #: Deformations by coordinate.
    deformation: Columns
    #: Forces by coordinate.
    force: Columns

    def __init__(
        self, name: str, kind: str, coordinates: Sequence[tuple[str, bool, Column, Column]]
    ) -> None:
        self.name = name
        self.kind = kind
        self.rotations = {c[0]: c[1] for c in coordinates}
        what = f'coordinate of "{name}" named'
        self.deformation = Columns(what, {c[0]: c[2] for c in coordinates})
        self.force = Columns(what, {c[0]: c[3] for c in coordinates})

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of its coordinates, such as ``("U1", "U2", "U3")``."""
        return tuple(self.rotations)

    def work(self, coordinate: str) -> float:
        """Work done on a coordinate, ∫ f dd, J."""
        d, f = self.deformation[coordinate], self.force[coordinate]
        return float((0.5 * (f[1:] + f[:-1]) * (d[1:] - d[:-1])).sum()) if len(d) > 1 else 0.0

    def loop(self, coordinate: str | None = None) -> Loop:
        """The hysteresis loop of a coordinate; without one, of that on which most work is done.

        :raises KeyError: for a coordinate that there is not.
        """
        if coordinate is None:
            coordinate = max(self.coordinates, key=lambda c: abs(self.work(c)))
        return Loop(self.deformation[coordinate], self.force[coordinate])

    def __repr__(self) -> str:
        return f"<{self.kind} {self.name!r}: {', '.join(self.coordinates)}>"

    def __getstate__(self) -> tuple[str, str, dict[str, bool], Columns, Columns]:
        return self.name, self.kind, self.rotations, self.deformation, self.force

    def __setstate__(self, state: tuple[str, str, dict[str, bool], Columns, Columns]) -> None:
        self.name, self.kind, self.rotations, self.deformation, self.force = state


class Energy(Columns):
    """Energies, J: by name at the output times, and at the end."""

    __slots__ = ("totals",)

    #: At the end, J: those of ``energy`` in ``summary.json``, with ``error_relative``, the share that is unaccounted for.
    totals: dict[str, float]

    def __init__(self, columns: Mapping[str, Column | Array], totals: dict[str, Any]) -> None:
        super().__init__("energy", columns)
        self.totals = {name: number(x) for name, x in totals.items() if not isinstance(x, dict)}

    @property
    def error_relative(self) -> float:
        """Share of the energy that is unaccounted for."""
        return self.totals["error_relative"]

    def __repr__(self) -> str:
        return "<energy [J]: " + ", ".join(f"{n} {x:.5g}" for n, x in self.totals.items()) + ">"

    def __getstate__(self) -> Any:
        return super().__getstate__(), self.totals

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self.totals = state[1]


def number(x: float | None) -> float:
    """A number of a summary, where one that is not finite is ``null``."""
    return float("nan") if x is None else float(x)


#: Of the extremes of an output in a summary.
KEYS = ("max", "t_max", "min", "t_min", "final")


class Result(Mapping[str, "Array"]):
    """What a run left: histories of its outputs by name, in SI, and all that is told of it.

    ``r["roof"]`` is a read-only array that is not copied; :attr:`t` has the times. Results pickle, with everything but
    :meth:`write`.
    """

    _run: Run | None
    _summary_text: str
    _data: dict[tuple[str, ...], str]

    def __init__(self, run: Run) -> None:
        self._run = run
        self._summary_text = run.summary()
        self._text = run.text()
        self._state: State | None = run.end()
        self._data = {}
        self._set(
            run.good,
            Columns("output", dict(run.outputs())),
            {"t": run.time()},
            dict(run.energies()),
            {name: Link(name, kind, rest) for name, kind, rest in run.links()},
        )

    def _set(
        self,
        good: bool,
        outputs: Columns,
        time: Mapping[str, Column | Array],
        energies: Mapping[str, Column | Array],
        links: Mapping[str, Link],
    ) -> None:
        import json

        self.summary = json.loads(self._summary_text)
        self.good = good
        self._outputs = outputs
        self._time = Columns("time", time)
        self.energy = Energy(energies, self.summary["energy"])
        self.links = Named("link", links)

    #: All of ``summary.json``.
    summary: dict[str, Any]
    #: True for a result to be trusted: to the end, or to the end of a body that overturned.
    good: bool
    #: Energies.
    energy: Energy
    #: Deformations and forces of the links, by name.
    links: Named[Link]

    # -- histories

    def __getitem__(self, output: str) -> Array:
        return self._outputs[output]

    def __iter__(self) -> Iterator[str]:
        return iter(self._outputs)

    def __len__(self) -> int:
        return len(self._outputs)

    @property
    def t(self) -> Array:
        """The output times, s."""
        return self._time["t"]

    @property
    def units(self) -> dict[str, str]:
        """SI units of the outputs."""
        return {name: o["unit"] for name, o in self.summary["outputs"].items()}

    # -- what is told

    @property
    def peaks(self) -> Mapping[str, Peak]:
        """Extremes of the outputs over all substeps; none for outputs that were not recorded."""
        errors = self.errors
        found = _Peaks()
        for name, o in self.summary["outputs"].items():
            if "max" in o:
                high, t_high, low, t_low, last = (number(o[k]) for k in KEYS)
                error = errors.get(name, float("nan"))
                found[name] = Peak(high, t_high, low, t_low, last, o["unit"], error)
        return found

    @property
    def certificate(self) -> dict[str, dict[str, float]]:
        """How far each output may be off, in its unit, and where that comes from; empty where nobody asked."""
        outputs = self.summary["outputs"].items()
        return {
            name: {part: number(x) for part, x in o["error"].items()}
            for name, o in outputs
            if o.get("error")
        }

    @property
    def errors(self) -> dict[str, float]:
        """How far each output may be off, in its unit: the sum of the parts of :attr:`certificate` (± in what the program
        prints)."""
        return {name: sum(parts.values()) for name, parts in self.certificate.items()}

    @property
    def status(self) -> str:
        """``"converged"``, or what happened: ``"overturned"``, ``"energy error"``, ``"not converged"``, ``"inadequate"``,
        ``"wrong law"``, or ``"refused"`` by a law that has no answer."""
        return str(self.summary["status"])

    @property
    def message(self) -> str:
        """The status in a sentence."""
        return str(self.summary["message"])

    @property
    def case(self) -> str:
        """Name of the case."""
        return str(self.summary["case"])

    @property
    def solver(self) -> str:
        """Name of the solver, or ``"static"``."""
        return str(self.summary["solver"])

    @property
    def work(self) -> dict[str, float]:
        """Steps, substeps, iterations, times."""
        return dict(self.summary["work"])

    @property
    def warnings(self) -> list[str]:
        """What one should know of it."""
        return list(self.summary["warnings"])

    @property
    def contact(self) -> dict[str, Any] | None:
        """How the bodies that stand on contacts behaved; nothing for a model without such a body."""
        found: dict[str, Any] | None = self.summary["contact"]
        return found

    @property
    def state(self) -> State:
        """The state at the end, from which ``m.run(start=r.state)`` goes on with the bits of an unbroken run."""
        if self._state is None:
            raise TrilithError("the runs of a comparison keep no state")
        return self._state

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Result of case {self.case!r} by {self.solver}: {self.status}, {len(self.t)} times, {len(self)} outputs>"

    # -- tables

    def _table(self, energy: bool) -> dict[str, Array]:
        table = {"t": self.t, **self}
        if energy:
            table.update({f"energy.{name}": values for name, values in self.energy.items()})
        return table

    def to_pandas(self, *, energy: bool = False) -> pandas.DataFrame:
        """The histories as a data frame of pandas, over time; with ``energy`` also those of the energies."""
        import pandas

        table = self._table(energy)
        index = pandas.Index(table.pop("t"), name="t")
        return pandas.DataFrame(table, index=index, copy=False)

    def to_polars(self, *, energy: bool = False) -> polars.DataFrame:
        """The histories as a data frame of Polars, time first; with ``energy`` also those of the energies."""
        import polars

        return polars.DataFrame(self._table(energy))

    def to_arrow(self, *, energy: bool = False) -> pyarrow.Table:
        """The histories as an Arrow table of pyarrow, not copied, with units in the metadata of the fields."""
        import pyarrow

        table = self._table(energy)
        units = {"t": "s", **self.units}
        fields = [
            pyarrow.field(name, pyarrow.float64(), metadata={"unit": units.get(name, "J")})
            for name in table
        ]
        arrays = [pyarrow.array(values, type=pyarrow.float64()) for values in table.values()]
        return pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The Arrow PyCapsule interface, by way of pyarrow: what knows it takes a result as it is."""
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    # -- pages and files

    def _of(self, loops: Sequence[str]) -> str:
        key = tuple([loops] if isinstance(loops, str) else loops)
        if key not in self._data:
            if self._run is None:
                what = "unless it was made with the same `loops` before" if self._data else ""
                raise TrilithError(f"this result has no page {what}".rstrip())
            self._data[key] = self._run.data(list(key))
        return self._data[key]

    def html(self, loops: Sequence[str] = ()) -> str:
        """The page of the run: one file without network, with the motion to play and histories to zoom.

        :param loops: names of the links whose hysteresis loops are shown; without any, of those that dissipate most.
        """
        from ._native import page

        return page(self._summary_text, self._of(loops))

    def report(self, path: str | PathLike[str], loops: Sequence[str] = ()) -> Path:
        """Writes the page of the run; returns its path.

        :param loops: as in :meth:`html`.
        :raises OSError: where the file cannot be written.
        """
        path = Path(path)
        path.write_text(self.html(loops), encoding="utf-8")
        return path

    def write(self, folder: str | PathLike[str], *, report: bool = True) -> list[Path]:
        """Writes what ``trilith run --out`` writes: summary, peaks, histories, resolved model, deformed shapes, page.

        :raises FileError: where the folder cannot be written.
        """
        if self._run is None:
            raise TrilithError("a result that was pickled has no model to write: run it again, or pickle the model beside it")
        return [Path(p) for p in self._run.write(Path(folder), report)]

    def write_checkpoint(self, path: str | PathLike[str]) -> Path:
        """Writes the state at the end as a checkpoint for ``trilith run --restart``."""
        if self._run is None:
            raise TrilithError("a result that was pickled writes no checkpoint: pickle its `state`")
        self._run.write_checkpoint(Path(path))
        return Path(path)

    def svg(self, name: str) -> list[str]:
        """Figures as SVG: of an output, of a link (a loop for each coordinate that moves), ``"energy"``, ``"ground"``,
        ``"spectra"``, ``"model"`` (where it has moved most).

        :raises ArgumentError: where there is nothing to draw of that name.
        """
        from ._native import pictures

        data = self._of([name] if name in self.links else ())
        found = [svg for _, svg in pictures(data, [name])]
        if not found:
            raise ArgumentError(f'there is no figure of "{name}": it is no output and no link, or does not move')
        return found

    def show(self, *, height: int = 800, loops: Sequence[str] = ()) -> Page:
        """The page of the run, to be shown in a notebook."""
        return Page(self.html(loops), height)

    def _repr_html_(self) -> str:
        from ._html import result

        return result(self)

    # -- pickles and copies

    def __getstate__(self) -> dict[str, Any]:
        if self._run is not None and not self._data and len(self.t):
            self._of(())
        return {
            "summary": self._summary_text,
            "text": self._text,
            "good": self.good,
            "state": self._state,
            "data": self._data,
            "t": self.t,
            "outputs": self._outputs,
            "energies": dict(self.energy),
            "links": dict(self.links),
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._run = None
        self._summary_text = state["summary"]
        self._text = state["text"]
        self._state = state["state"]
        self._data = state["data"]
        energies = {name: frozen(values) for name, values in state["energies"].items()}
        time = {"t": frozen(state["t"])}
        self._set(state["good"], state["outputs"], time, energies, state["links"])

    def __copy__(self) -> Result:
        return self

    def __deepcopy__(self, memo: object) -> Result:
        return self

    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        """Whether the runs are the same, to the bit."""
        if not isinstance(other, Result):
            return NotImplemented
        return bool(self.summary["run_sha256"] == other.summary["run_sha256"])


class _Peaks(dict[str, Peak]):
    def __missing__(self, name: str) -> Peak:
        raise unknown("recorded output", name, self)


class Page:
    """A page to be shown in a notebook."""

    def __init__(self, html: str, height: int) -> None:
        self.html = html
        self.height = height

    def _repr_html_(self) -> str:
        from html import escape

        return (
            f'<iframe srcdoc="{escape(self.html)}" style="width:100%;height:{self.height}px;border:0" '
            'title="report of a run"></iframe>'
        )


def of_parts(
    summary: str, text: str, good: bool, time: Column, outputs: Mapping[str, Column]
) -> Result:
    """A result without energies over time, links and page, as a comparison has them."""
    it = Result.__new__(Result)
    it._run = None
    it._summary_text = summary
    it._text = text
    it._state = None
    it._data = {}
    it._set(good, Columns("output", outputs), {"t": time}, {}, {})
    return it
