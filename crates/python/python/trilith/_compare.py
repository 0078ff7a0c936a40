"""One case in several ways, and why the results differ."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ._arrays import numbers, whole
from ._errors import ArgumentError, unknown
from ._result import Result, of_parts

if TYPE_CHECKING:
    from ._model import Model


class Difference(NamedTuple):
    """How far an output of a way is from that of the first."""

    #: Difference of the largest magnitude, as share of the first's.
    peak: float
    #: Root mean square of the difference over time, as share of the first's.
    rms: float
    #: How much later it comes, s.
    lag: float
    #: Difference of the last value, as share of the largest magnitude of the first.
    final: float


class Variant(NamedTuple):
    """A way, and what it left."""

    #: Such as ``"fna, 20 vectors"``.
    label: str
    #: Histories, peaks, energies at the end; no loops and no page.
    result: Result
    #: Differences from the first way by output; none for the first itself.
    differences: dict[str, Difference]
    #: The likely cause of the differences, found by taking it away; nothing where nobody looked.
    cause: str | None
    #: What shows it.
    finding: str | None


class Comparison(Sequence[Variant]):
    """What the ways of :func:`compare` left, the first being that which the others are compared with."""

    def __init__(self, text: str, variants: Sequence[Variant]) -> None:
        self._text = text
        self._variants = list(variants)

    def __getitem__(self, which: int | slice | str) -> Variant:  # type: ignore[override]
        """By its place, or by its label."""
        if isinstance(which, str):
            for variant in self._variants:
                if variant.label == which:
                    return variant
            raise unknown("way", which, [v.label for v in self._variants])
        if isinstance(which, slice):
            raise TypeError("a way by its place or its label is wanted, not a slice")
        return self._variants[which]

    def __len__(self) -> int:
        return len(self._variants)

    def __iter__(self) -> Iterator[Variant]:
        return iter(self._variants)

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return f"<Comparison of {', '.join(repr(v.label) for v in self)}>"

    def _repr_html_(self) -> str:
        from html import escape

        from ._html import table

        parts = []
        names = list(self[0].result.peaks)
        head = ["largest magnitude", "unit", *(v.label for v in self)]
        peaks = [v.result.peaks for v in self]
        parts.append(
            table(
                head,
                ((n, peaks[0][n].unit, *(p[n].magnitude for p in peaks if n in p)) for n in names),
            )
        )
        for variant in self._variants[1:]:
            if variant.cause is not None:
                said = f"{variant.label}: {variant.cause}: {variant.finding}"
                parts.append(f"<p>{escape(said)}</p>")
        return "".join(parts)


def compare(
    model: Model,
    solvers: Sequence[str] = (),
    *,
    case: str | None = None,
    dts: Sequence[float] = (),
    vectors: Sequence[int] = (),
    dummies: Sequence[float] = (),
    alphas: Sequence[float] = (),
    cause: bool = True,
) -> Comparison:
    """Solves a dynamic case in several ways: each combination of what is listed, the first of each list before the others.

    :param solvers: such as ``["hht", "fna"]``; with nothing else listed, these two.
    :param case: its name; without it the last case of the model.
    :param dts: output steps, s.
    :param vectors: sizes of the basis, for solvers that have one.
    :param dummies: effective stiffnesses of all links, as multiples of that of the engaged link, for the same.
    :param alphas: HHT's α, for solvers that have one.
    :param cause: look for the causes of the differences by further runs.
    :raises ArgumentError: for fewer than two ways, and names that there are not.
    :raises RunError: where a way cannot be run.
    """
    if isinstance(solvers, str):
        raise ArgumentError(f'a list of solvers is wanted, such as ["hht", "{solvers}"]')
    if not (solvers or dts or vectors or dummies or alphas):
        solvers = ["hht", "fna"]
    text, facts = model._native.compare(
        case,
        list(solvers),
        _list("dts", dts, above=0.0),
        [whole("vectors", n) or 0 for n in vectors],
        _list("dummies", dummies, above=0.0),
        _list("alphas", alphas, above=-1.0),
        cause,
    )
    variants = []
    for label, _, summary, good, time, outputs, differences, found in facts:
        result = of_parts(summary, label, good, time, dict(outputs))
        apart = {name: Difference(*values) for name, *values in differences}
        variants.append(Variant(label, result, apart, *(found or (None, None))))
    if not variants:
        raise ArgumentError("no way came to its end")
    return Comparison(text, variants)


def _list(what: str, values: Sequence[float], *, above: float) -> list[float]:
    found = numbers(what, values, least=0) if len(values) else []
    for x in found:
        if x <= above:
            raise ArgumentError(f"{what} must be above {above:g}: there is {x:g}")
    return found
