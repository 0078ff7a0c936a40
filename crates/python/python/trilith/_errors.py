"""What can go wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ._result import Result


class Diagnostic(NamedTuple):
    """One thing that is said of a model, and where."""

    #: ``"error"`` or ``"warning"``.
    level: str
    #: A stable code such as ``"E0103"``; empty for what is found when the structure is assembled.
    code: str
    #: What is wrong.
    message: str
    #: A few words that stand at the place.
    label: str
    #: What would be right.
    help: str | None
    #: The file, or ``--set NAME=VALUE`` for a value that was given for a parameter.
    file: str
    #: Line and column (in characters) from 1; 0 where there is no place.
    line: int
    column: int

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}: " if self.line else ""
        code = f"[{self.code}]" if self.code else ""
        text = f"{place}{self.level}{code}: {self.message}"
        return f"{text}\n  help: {self.help}" if self.help else text


class TrilithError(Exception):
    """Any error of Trilith."""


class ModelError(TrilithError, ValueError):
    """A model that is wrong. The text is that of the program: file, line, the line itself with a caret, and what would
    be right, for all errors of the file."""

    #: The errors one by one.
    diagnostics: list[Diagnostic]

    def __init__(self, text: str, diagnostics: object = ()) -> None:
        super().__init__(text)
        all_of = diagnostics if isinstance(diagnostics, (list, tuple)) else ()
        self.diagnostics = [Diagnostic(*one) for one in all_of]

    def __reduce__(self) -> tuple[type[ModelError], tuple[str, list[Diagnostic]]]:
        return type(self), (str(self), self.diagnostics)

    def __str__(self) -> str:
        # Below the name of the class, where the carets stand right.
        text = str(self.args[0])
        return text if text.startswith("\n") else "\n" + text


class RunError(TrilithError, RuntimeError):
    """A run that cannot be made although nothing is wrong with the model file: no static equilibrium, a case that is
    continued and did not come to its end."""


class ArgumentError(TrilithError, ValueError):
    """An argument that is wrong: a case, solver, link or parameter that there is not, a number out of range."""


class LawError(RunError):
    """A law of one's own that is wrong: it raised an exception, which is the cause of this one, or its answers are no numbers, no
    account of its work, or others each time. The text names the law, the link and the time."""

    #: What the run found until there, where it had begun.
    result: Result | None = None


class ConformanceError(TrilithError, AssertionError):
    """A law that does not keep the contract of links; the text says which property does not hold, with its numbers."""


class Refusal(Exception):
    """Raised by a law that holds no more: ``raise tl.Refusal("torn at 12 mm")``. Shorter steps are tried, as an iteration may ask
    about deformations that the motion never comes to; where none helps, the run ends with the status ``refused`` and these
    words."""


class FileError(TrilithError, OSError):
    """A file that cannot be read or written."""


class WorkerError(TrilithError, RuntimeError):
    """A worker of a cluster that cannot take part in a study: another version of trilith, other vectors, files that it does
    not see."""


class InternalError(TrilithError, RuntimeError):
    """A defect of Trilith: please report it with the model."""


class UnknownName(TrilithError, KeyError):
    """A name that a mapping does not have."""

    def __str__(self) -> str:
        return str(self.args[0])


def unknown(what: str, name: object, names: object) -> UnknownName:
    """The error for a name that there is not, with the one that may be meant or all that there are."""
    from difflib import get_close_matches

    known = [str(n) for n in names] if isinstance(names, (list, tuple, dict)) else []
    near = get_close_matches(str(name), known, n=1)
    if near:
        help_ = f'did you mean "{near[0]}"?'
    elif known:
        more = ", …" if len(known) > 12 else ""
        help_ = "there are " + ", ".join(f'"{n}"' for n in known[:12]) + more
    else:
        help_ = "there are none"
    return UnknownName(f'there is no {what} "{name}": {help_}')
