"""Trilith: small finite-element models with nonlinear links, under ground motion and force histories.

    import trilith as tl

    m = tl.load("models/rigid_block.ron", mu=0.2)   # or tl.loads(text), or tl.Model(nodes=…, elements=…, cases=…)
    r = m.run()                                     # or m.run(case="pulse", solver="hht", dt=0.005)
    r["slide"], r.t                                 # read-only NumPy arrays, not copied
    r.peaks["slide"].max, r.energy, r.links["foot left"].loop()
    r.report("block.html")

Models and results are plain objects: nothing is global, several models run in as many threads as you like, and Ctrl-C
ends a run. All numbers are in SI. Errors of a model are :class:`ModelError`, with file, line, column and a caret.

Elements, cases, functions and outputs of model files have classes of the same names (``tl.Beam``, ``tl.Dynamic``, …), made
from the cards that the program prints by ``trilith elements``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._errors import (
    ArgumentError,
    ConformanceError,
    Diagnostic,
    FileError,
    InternalError,
    LawError,
    ModelError,
    Refusal,
    RunError,
    TrilithError,
    WorkerError,
)
from ._native import BUILD, VERSION as __version__, State

if TYPE_CHECKING:
    from ._catalogue import Card, CardParameter, elements
    from ._combine import Combination, Combinations, Extremes
    from ._compare import Comparison, Difference, Variant, compare
    from ._conform import Conformance, conform
    from ._exercise import Exercise, LastCycle, exercise
    from ._law import CLaw, Law, LawStep, c_header, c_laws, parameter
    from ._model import Case, Element, Model, load, loads
    from ._modes import Modes
    from ._optimize import (
        Bend,
        Evaluation,
        Gradient,
        LimitState,
        Optimum,
        OutputGradient,
        Sensitive,
    )
    from ._record import GroundMotion, ResponseSpectrum, record, records, synthetic
    from ._reduce import Reduction
    from ._result import Link, Loop, Peak, Result
    from ._ron import Block, Word
    from ._stepper import Stepper
    from ._study import PartStatus, Study, StudyResult, StudyStatus, study
    from ._sweep import SweepPeaks, SweepResult, sweep
    from .blocks import *

#: Where each name is, looked up when it is first used: importing the package is quick.
_PLACES = {
    "_catalogue": ("Card", "CardParameter", "elements"),
    "_combine": ("Combination", "Combinations", "Extremes"),
    "_compare": ("Comparison", "Difference", "Variant", "compare"),
    "_conform": ("Conformance", "conform"),
    "_exercise": ("Exercise", "LastCycle", "exercise"),
    "_law": ("CLaw", "Law", "LawStep", "c_header", "c_laws", "parameter"),
    "_model": ("Case", "Element", "Model", "load", "loads"),
    "_modes": ("Modes",),
    "_optimize": (
        "Bend",
        "Evaluation",
        "Gradient",
        "LimitState",
        "Optimum",
        "OutputGradient",
        "Sensitive",
    ),
    "_record": ("GroundMotion", "ResponseSpectrum", "record", "records", "synthetic"),
    "_reduce": ("Reduction",),
    "_result": ("Link", "Loop", "Peak", "Result"),
    "_ron": ("Block", "Word"),
    "_stepper": ("Stepper",),
    "_study": ("PartStatus", "Study", "StudyResult", "StudyStatus", "study"),
    "_sweep": ("SweepPeaks", "SweepResult", "sweep"),
}
_WHERE = {name: module for module, names in _PLACES.items() for name in names}

__all__ = [
    "ArgumentError",
    "BUILD",
    "Bend",
    "Block",
    "CLaw",
    "Card",
    "CardParameter",
    "Case",
    "Combination",
    "Combinations",
    "Comparison",
    "Conformance",
    "ConformanceError",
    "Diagnostic",
    "Difference",
    "Element",
    "Evaluation",
    "Exercise",
    "Extremes",
    "FileError",
    "Gradient",
    "GroundMotion",
    "InternalError",
    "LastCycle",
    "Law",
    "LawError",
    "LawStep",
    "LimitState",
    "Link",
    "Loop",
    "Model",
    "ModelError",
    "Modes",
    "Optimum",
    "OutputGradient",
    "PartStatus",
    "Peak",
    "Reduction",
    "Refusal",
    "ResponseSpectrum",
    "Result",
    "RunError",
    "Sensitive",
    "State",
    "Stepper",
    "Study",
    "StudyResult",
    "StudyStatus",
    "SweepPeaks",
    "SweepResult",
    "TrilithError",
    "Variant",
    "Word",
    "WorkerError",
    "__version__",
    "c_header",
    "c_laws",
    "compare",
    "conform",
    "elements",
    "exercise",
    "load",
    "loads",
    "parameter",
    "record",
    "records",
    "study",
    "sweep",
    "synthetic",
]


def __getattr__(name: str) -> object:
    from importlib import import_module

    if not name.startswith("_"):
        module = import_module("." + _WHERE.get(name, "blocks"), __name__)
        if hasattr(module, name):
            value: object = getattr(module, name)
            globals()[name] = value
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    from . import blocks

    return sorted({*__all__, *blocks.__all__})
