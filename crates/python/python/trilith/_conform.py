"""Whether a law keeps the contract of links."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from . import _native

if TYPE_CHECKING:
    from ._law import CLaw, Law


class Conformance(NamedTuple):
    """What the conformance kit looked at in a law that keeps the contract of links."""

    #: Tangent columns that were compared with difference quotients, and those that lie at kinks.
    tangents: int
    skipped: int
    #: Largest error of the balance of energies, as a share of the work; nothing where the law tells no energies.
    energy_error: float | None
    #: Its coordinates.
    coordinates: tuple[str, ...]


def conform(
    law: type[Law] | CLaw | str,
    /,
    *,
    amplitude: Mapping[str, float | str] | float | str | None = None,
    mean: Mapping[str, float | str] | None = None,
    frequency: float | None = None,
    rate_independent: bool = False,
    active: bool = False,
    energy_tolerance: float = 2e-3,
    paths: int = 8,
    seed: int = 1,
    parameters: Mapping[str, object] | None = None,
    **more: object,
) -> Conformance:
    """Leads a law along random paths, and asks whether it keeps the contract of links: the same answer to the same question,
    finite numbers, tangents that are the derivatives of the force, energies that add up to the work, no energy out of nothing::

        tl.conform(Hardening, k="30 kN/m", a=100, amplitude="5 cm")

    A law that passes is not right by that, but what runs rest on holds.

    :param law: a law, or the name of a built-in kind.
    :param amplitude: deformations that it is led through, by coordinate; one alone is that of the first. Without it those of the law.
    :param mean: what they are about, by coordinate.
    :param frequency: Hz.
    :param rate_independent: the law must not depend on rates, nor on the steps.
    :param active: the law may give energy.
    :param energy_tolerance: error of the balance of energies that is allowed with thousands of steps, as a share of the work.
    :param paths: how many paths.
    :param seed: of their random numbers.
    :param parameters: parameters of the law, also by keyword: numbers in SI or texts with units.
    :raises ConformanceError: with the first property that does not hold, and its numbers.
    :raises LawError: where the law raises an exception, which is its cause.
    :raises ModelError: for parameters that are refused.
    """
    from ._arrays import positive, whole
    from ._exercise import of_coordinates
    from ._law import kind_of
    from ._ron import ron

    kind, laws = kind_of(law)
    set_ = [(n, v if isinstance(v, str) else ron(v)) for n, v in {**(parameters or {}), **more}.items()]
    tangents, skipped, error, coordinates = _native.conform(
        kind,
        laws,
        set_,
        of_coordinates("amplitude", amplitude, kind, set_, laws),
        of_coordinates("mean", mean, kind, set_, laws),
        positive("frequency", frequency),
        (rate_independent, active),
        whole("paths", paths) or 1,
        seed,
        positive("energy_tolerance", energy_tolerance) or 2e-3,
    )
    accounts = all(native.accounts for native in laws)
    return Conformance(tangents, skipped, error if accounts else None, tuple(coordinates))
