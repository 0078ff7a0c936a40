"""Ground motion records."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._arrays import array, numbers, positive
from ._errors import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    from ._arrays import Array, Numbers


class ResponseSpectrum(NamedTuple):
    """Responses of oscillators of one damping ratio."""

    #: Periods, s.
    period: Array
    #: Largest displacement relative to the ground, m.
    sd: Array
    #: Pseudo-velocity, m/s.
    psv: Array
    #: Pseudo-acceleration, m/s².
    psa: Array
    #: Largest absolute acceleration, m/s².
    sa: Array


class GroundMotion:
    """One component of a ground motion, at even steps, straight between them.

    :param acceleration: m/s², at 0, ``dt``, 2 ``dt`` …
    :param dt: time step, s.
    """

    __slots__ = ("_native",)

    _native: _native.Record

    def __init__(
        self,
        acceleration: Numbers,
        dt: float,
        *,
        component: str = "",
        station: str = "",
        event: str = "",
        notes: list[str] | None = None,
    ) -> None:
        values = numbers("acceleration", acceleration, least=2)
        step = positive("dt", dt)
        if step is None:
            raise ArgumentError("dt is missing")
        self._native = _native.Record.of(values, step, (component, station, event), notes or [])

    @property
    def acceleration(self) -> Array:
        """Acceleration, m/s²."""
        return array(self._native.acceleration())

    @property
    def velocity(self) -> Array:
        """Velocity, m/s."""
        return array(self._native.velocity())

    @property
    def displacement(self) -> Array:
        """Displacement, m."""
        return array(self._native.displacement())

    @property
    def t(self) -> Array:
        """Times, s."""
        return array(self._native.time())

    @property
    def dt(self) -> float:
        """Time step, s."""
        return self._native.dt

    @property
    def component(self) -> str:
        """Name of the component."""
        return self._native.component

    @property
    def station(self) -> str:
        """The station."""
        return self._native.station

    @property
    def event(self) -> str:
        """The event."""
        return self._native.event

    @property
    def format(self) -> str | None:
        """Format that it was read from."""
        return self._native.format

    @property
    def notes(self) -> list[str]:
        """What was noticed when it was read."""
        return self._native.notes

    @property
    def measures(self) -> dict[str, float]:
        """Peak acceleration ``pga`` (m/s²), velocity ``pgv`` and displacement ``pgd``, Arias intensity ``arias`` (m/s),
        significant durations ``d5_75`` and ``d5_95`` (s), cumulative absolute velocity ``cav`` (m/s)."""
        names = ("pga", "pgv", "pgd", "arias", "d5_75", "d5_95", "cav")
        return dict(zip(names, self._native.measures()))

    def spectrum(self, periods: Numbers | None = None, damping: float = 0.05) -> ResponseSpectrum:
        """Its response spectrum.

        :param periods: s; without them 150 from 0.02 s to 10 s.
        :param damping: ratio to critical.
        """
        import numpy as np

        values = np.geomspace(0.02, 10.0, 150).tolist() if periods is None else numbers("periods", periods)
        found = self._native.spectrum(values, float(damping))
        return ResponseSpectrum(np.array(values), *(array(c) for c in found))

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes it as a file that models take."""
        path = Path(path)
        path.write_text(self._native.csv(), encoding="utf-8")
        return path

    def __len__(self) -> int:
        return len(self._native.acceleration())

    def __repr__(self) -> str:
        name = " ".join(p for p in (self.station, self.component) if p) or "GroundMotion"
        pga = self.measures["pga"]
        return f"<{name}: {len(self)} samples of {self.dt:g} s, peak {pga:.4g} m/s²>"

    def __reduce__(self) -> tuple[Callable[..., GroundMotion], tuple[Any, ...]]:
        texts = (self.component, self.station, self.event)
        return _again, (self.acceleration.tolist(), self.dt, texts, self.notes)


def _made(native: _native.Record) -> GroundMotion:
    it = GroundMotion.__new__(GroundMotion)
    it._native = native
    return it


def _again(
    acceleration: list[float], dt: float, texts: tuple[str, str, str], notes: list[str]
) -> GroundMotion:
    return _made(_native.Record.of(acceleration, dt, texts, notes))


def records(
    path: str | PathLike[str], /, *, unit: str | None = None, dt: float | None = None
) -> list[GroundMotion]:
    """All components of a file: PEER AT2, COSMOS, CSMIP, K-NET, ESM, or columns.

    :param unit: unit of the values where the file does not state it, such as ``"g"``.
    :param dt: time step where the file does not state it, s.
    :raises ArgumentError: with the line, for a file that is none of these or is damaged.
    :raises FileError: for a file that cannot be read.
    """
    return [_made(r) for r in _native.record(Path(path), unit, positive("dt", dt), None)]


def record(
    path: str | PathLike[str],
    /,
    *,
    component: str | int | None = None,
    unit: str | None = None,
    dt: float | None = None,
) -> GroundMotion:
    """One component of a file.

    :param component: its number from 1, its name or a part of it; needed where the file has several.
    :param unit: as in :func:`records`.
    :param dt: as in :func:`records`.
    :raises ArgumentError: also where the file has several and none is named.
    """
    name = None if component is None else str(component)
    found = [_made(r) for r in _native.record(Path(path), unit, positive("dt", dt), name)]
    if len(found) > 1:
        names = ", ".join(f'"{r.component}"' for r in found)
        raise ArgumentError(f"{path} has {len(found)} components: {names}; name one, or use records()")
    return found[0]


def synthetic(
    seed: int,
    *,
    peak: float | None = None,
    duration: float | None = None,
    dt: float | None = None,
    frequency: float | None = None,
    damping: float | None = None,
) -> GroundMotion:
    """A motion of filtered white noise (Kanai and Tajimi), the same for the same seed everywhere.

    :param peak: m/s².
    :param duration: s.
    :param dt: s.
    :param frequency: of the ground, Hz.
    :param damping: of the ground, as share of critical.
    """
    made = _native.synthetic(
        seed,
        positive("peak", peak),
        positive("duration", duration),
        positive("dt", dt),
        positive("frequency", frequency),
        positive("damping", damping),
    )
    return _made(made)
