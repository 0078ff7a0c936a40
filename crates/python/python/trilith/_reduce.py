"""A part of a model by the matrices of few rows."""

from __future__ import annotations

import json
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._arrays import frozen, names, positive, whole
from ._errors import ArgumentError

if TYPE_CHECKING:
    from ._arrays import Array
    from ._model import Model


class Reduction:
    """What :meth:`Model.reduce` made."""

    #: The model with the superelement in it.
    model: Model
    #: Name of the superelement.
    name: str
    #: How many elements it stands for.
    elements: int
    #: How many directions these have.
    equations: int
    #: Nodes that are kept.
    kept: list[str]
    #: Nodes that follow the rows.
    recovered: list[str]
    #: Rows of nodes that are kept; behind them stand those of modes.
    rows: int
    #: Frequencies of the modes with the kept nodes held, Hz.
    frequency: Array
    #: How many of these there are in all.
    available: int
    #: Their effective masses along X, Y and Z, kg, a row for each.
    effective_mass: Array
    #: What all there are would have together, kg.
    inner_mass: Array

    def __init__(self, model: Model, facts: str) -> None:
        import numpy as np

        found: dict[str, Any] = json.loads(facts)
        self.model = model
        self.name = found["name"]
        self.elements, self.equations = found["elements"], found["equations"]
        self.kept, self.recovered = found["kept"], found["recovered"]
        self.rows, self.available = found["rows"], found["available"]
        self.frequency = frozen(np.array(found["frequency"], dtype=float))
        self.effective_mass = frozen(np.array(found["effective_mass"], dtype=float).reshape(-1, 3))
        self.inner_mass = frozen(np.array(found["inner_mass"], dtype=float))

    def __repr__(self) -> str:
        rows = self.rows + self.frequency.size
        return f"<Reduction {self.name!r} of {self.equations} directions to {rows} rows>"


def reduce(
    model: Model,
    part: str | Sequence[str],
    modes: int | None,
    up_to: float | None,
    keep: Sequence[str] | None,
    recover: Sequence[str],
    recover_all: bool,
    out: str | PathLike[str] | None,
    form: str | None,
) -> Reduction:
    """Reduces a part: see :meth:`Model.reduce`."""
    from ._model import load, loads

    if modes is not None and up_to is not None:
        raise ArgumentError("modes= says how many there are, and up_to= as well: one of them is wanted")
    if out is None and form is not None:
        raise ArgumentError("form= is that of files, and without out= none are written")
    parts = [part] if isinstance(part, str) else list(part)
    kept = None if keep is None else names("keep", keep)
    followed = names("recover", recover)
    up_to = positive("up_to", up_to)
    folder = None if out is None else (Path(out), form or "npz")
    text, path, facts = model._native.reduce(
        parts, whole("modes", modes, least=0), up_to, kept, followed, bool(recover_all), folder
    )
    # Of what was written, that is what is read.
    small = load(path, laws=model.laws) if path is not None else loads(text or "", laws=model.laws)
    return Reduction(small, facts)
