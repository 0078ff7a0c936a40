"""Scripts of OpenSeesPy as models: their commands are recorded, and the program makes a model file of them.

    python -m trilith.opensees script.py --out model.ron

runs a script in this Python with this module in place of ``openseespy.opensees``: nothing is analysed, every command is
noted with its line, and the program's importer of OpenSees reads them as it reads Tcl. A script may also import it itself:

    import trilith.opensees as ops      # instead of openseespy.opensees
    …
    ops.save_model("model.ron")

Eigenvalues are answered by the program; other results are not there while a script is recorded: they may be printed and
calculated with, and a script that decides by one ends with an error. After ``wipe`` the next model is recorded: the last one counts.
It needs nothing but the standard library and the program: the one of this package, or another by ``--program``.
"""

from __future__ import annotations

import argparse
import numbers
import os
import re
import runpy
import subprocess
import sys
import tempfile
import types
from typing import Any, Callable, NoReturn, Sequence

#: Commands that belong to the pattern before them.
_OF_PATTERNS = ("load", "eleLoad", "sp", "groundMotion", "imposedMotion", "imposedSupportMotion")
#: Commands that ask for results.
_QUESTIONS = (
    "nodeDisp nodeVel nodeAccel nodeReaction nodeEigenvector nodeResponse nodeUnbalance eleForce eleResponse basicForce "
    "basicDeformation localForce eleDynamicalForce testNorm testIter testNorms modalProperties getLoadFactor numIter systemSize "
    "sectionForce sectionDeformation recorderValue nodePressure nodeMass printA printB"
).split()
#: Commands that neither make nor run anything.
_QUIET = ("printModel", "logFile", "version", "setMaxOpenFiles", "defaultUnits", "start", "stop", "getPID", "getNP", "barrier")


class Unknown:
    """A result that is not there yet."""

    def __init__(self, of: str) -> None:
        self._of = of

    def __repr__(self) -> str:
        return f"<unknown {self._of}>"

    def _again(self, *_: Any) -> Unknown:
        return self

    __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = _again
    __pow__ = __rpow__ = __neg__ = __pos__ = __abs__ = __getitem__ = _again

    def _refused(self, *_: Any) -> NoReturn:
        raise RuntimeError(
            f"{self._of}: results are not there while a script is recorded, and this line needs one"
        )

    __lt__ = __le__ = __gt__ = __ge__ = __bool__ = __float__ = __int__ = __iter__ = __len__ = _refused

    def __eq__(self, _: object) -> bool:
        self._refused()

    __hash__ = None  # type: ignore[assignment]


class _Command:
    def __init__(self, words: Sequence[str], place: str) -> None:
        self.words, self.place = words, place
        self.inside: list[_Command] | None = None

    def lines(self, indent: str = "") -> list[tuple[str, str]]:
        """Lines of Tcl, each with its place in the script."""
        line = indent + " ".join(self.words)
        if self.inside is None:
            return [(f"{line} ;# {self.place}", self.place)]
        inner = [text for c in self.inside for text in c.lines("    ")]
        return [(line + " {", self.place), *inner, ("}", self.place)]


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, Unknown):
        value._refused()
    text = os.fspath(value) if isinstance(value, os.PathLike) else str(value)
    plain = re.fullmatch(r"[\w./+:-]+", text) is not None
    if not plain and re.search(r"[{}\\]", text):
        raise ValueError(f"{text!r} cannot be a word of a command")
    return text if plain else "{" + text + "}"


def _flat(values: Sequence[Any]) -> list[Any]:
    out: list[Any] = []
    for value in values:
        if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and bool(getattr(value, "ndim", 0)):
            out.extend(_flat(list(value)))
        else:
            out.append(value)
    return out


def _with_files(words: list[Any]) -> list[Any]:
    """Files of series are read here, where the script would read them."""
    out: list[Any] = []
    rest = iter(words)
    for word in rest:
        if word in ("-filePath", "-fileTime"):
            with open(next(rest), encoding="utf-8") as file:
                cells = re.split(r"[\s,]+", file.read().strip())
            out.append("-values" if word == "-filePath" else "-time")
            out.extend(float(cell) for cell in cells)
        else:
            out.append(word)
    return out


class Recorder:
    """The commands of a model, in their order."""

    def __init__(self) -> None:
        self.program: list[str] = [sys.executable, "-m", "trilith"]
        self.units: str | None = None
        self.clear()

    def clear(self) -> None:
        """Forgets all commands."""
        self.commands: list[_Command] = []
        self.nodes: dict[int, list[float]] = {}
        self.elements: list[int] = []
        self.time, self.step, self.dynamic = 0.0, 0.0, False
        self.pattern: _Command | None = None

    def record(self, name: str, values: Sequence[Any]) -> Any:
        """Notes a command; what OpenSees would give back, as far as it is known."""
        words = _flat(values)
        if name == "wipe":
            return self.clear()
        if name in _QUIET:
            return None
        if name in _QUESTIONS:
            return Unknown(name)
        if name == "getTime":
            return self.time
        if name == "getNodeTags":
            return list(self.nodes)
        if name == "getEleTags":
            return list(self.elements)
        if name == "nodeCoord":
            at = self.nodes[int(words[0])]
            return at[int(words[1]) - 1] if len(words) > 1 else list(at)
        if name == "eigen":
            return self.eigen(words)
        command = _Command([name, *map(_word, _with_files(words))], _place())
        if name in _OF_PATTERNS:
            if self.pattern is None or self.pattern.inside is None:
                raise RuntimeError(f"`{name}` stands before every `pattern`, or behind an analysis of the one before")
            self.pattern.inside.append(command)
            return None
        self.commands.append(command)
        return self._followed(name, words, command)

    def _followed(self, name: str, words: list[Any], command: _Command) -> Any:
        if name == "pattern" and words[0] in ("Plain", "MultipleSupport"):
            command.inside, self.pattern = [], command
        elif name == "node":
            own = [w for w in words[1:4] if not isinstance(w, str)]
            self.nodes[int(words[0])] = [float(x) for x in own]
        elif name == "element":
            self.elements.append(int(words[1]))
        elif name == "analysis":
            self.dynamic = words[0] != "Static"
        elif name == "integrator" and words[0] == "LoadControl":
            self.step = float(words[1])
        elif name == "analyze":
            self.time += int(words[0]) * (float(words[1]) if self.dynamic else self.step)
            self.pattern = None
            return 0
        elif name == "setTime":
            self.time = float(words[0])
        elif name == "loadConst" and "-time" in words:
            self.time = float(words[words.index("-time") + 1])
        return None

    def tcl(self) -> str:
        """The commands as the program reads them, each with its place in the script."""
        return "".join(f"{line}\n" for line, _ in self._lines())

    def _lines(self) -> list[tuple[str, str]]:
        return [line for c in self.commands for line in c.lines()]

    def eigen(self, words: list[Any]) -> list[float]:
        """Squares of the lowest circular frequencies, found by the program with links by their tangents."""
        command = _Command(["eigen", *map(_word, words)], _place())
        # What it answers is written where the model file shows it with all digits.
        ask = f"set answer 0\nforeach w [{' '.join(command.words)}] {{\n    incr answer\n    node [expr {{-$answer}}] $w\n}}\n"
        dimensions = len(next(iter(self.nodes.values()), [0.0]))
        ask = ask.replace("$w\n", "$w" + " 0.0" * (dimensions - 1) + "\n")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "script.tcl")
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.tcl() + ask)
            ran = subprocess.run([*self.program, "import", path], capture_output=True, text=True, encoding="utf-8")
        found = re.findall(r'^ *"-\d+": \(([-+.\deE]+), ', ran.stdout, re.MULTILINE)
        if not found:
            raise RuntimeError(f"the program finds no modes of what is recorded so far:\n{ran.stderr.strip()}")
        self.commands.append(command)
        return [float(x) for x in found]

    def save_model(self, out: str, *options: str) -> int:
        """Writes the model file and the report of its losses beside it; the exit status of the program."""
        with tempfile.TemporaryDirectory() as folder:
            stem = os.path.splitext(os.path.basename(out))[0]
            path = os.path.join(folder, f"{stem}.tcl")
            with open(path, "w", encoding="utf-8") as file:
                file.write(self.tcl())
            ran = subprocess.run(
                [*self.program, "import", path, "--out", out, *options], capture_output=True, text=True, encoding="utf-8"
            )
        sys.stdout.write(self._placed(ran.stdout))
        sys.stderr.write(self._placed(ran.stderr))
        report = os.path.join(os.path.dirname(out), f"{stem}.import.txt")
        if ran.returncode in (0, 1) and os.path.exists(report):
            with open(report, encoding="utf-8") as file:
                text = self._placed(file.read())
            with open(report, "w", encoding="utf-8") as file:
                file.write(text)
        return ran.returncode

    def _placed(self, text: str) -> str:
        """Lines of what the program has read as places in the script."""
        places = [place for _, place in self._lines()]

        def place(found: re.Match[str]) -> str:
            line = int(found[1]) - 1
            return places[line] if line < len(places) else found[0]

        return re.sub(r"\bline (\d+)\b", place, text)


_recorder = Recorder()


def _place() -> str:
    """File and line of the script that calls a command."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename == __file__:
        frame = frame.f_back
    return f"{os.path.basename(frame.f_code.co_filename)}:{frame.f_lineno}"


def save_model(out: str, *options: str) -> int:
    """Writes what was recorded as a model file; options are those of ``trilith import``.

    :returns: the exit status of the program: 0, or 1 where something that changes results was lost.
    """
    return _recorder.save_model(os.fspath(out), *options)


def __getattr__(name: str) -> Callable[..., Any]:
    if name.startswith("_"):
        raise AttributeError(name)

    def command(*values: Any) -> Any:
        return _recorder.record(name, values)

    command.__name__ = name
    return command


def _stand_in() -> None:
    """Puts this module where scripts look for OpenSeesPy."""
    own = sys.modules[__name__]
    package = types.ModuleType("openseespy")
    package.opensees = own  # type: ignore[attr-defined]
    package.__path__ = []
    sys.modules.update({"openseespy": package, "openseespy.opensees": own, "opensees": own})


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a script and writes its model."""
    parser = argparse.ArgumentParser(prog="python -m trilith.opensees", description="A model file of a script of OpenSeesPy.")
    parser.add_argument("script", help="script in Python; it is run by this interpreter")
    parser.add_argument("--out", metavar="FILE", required=True, help="model file to write; the report of losses goes beside it")
    parser.add_argument("--units", metavar="LENGTH,FORCE", help="units of the script, such as in,kip [default: m,N]")
    parser.add_argument("--case", help="write one case with those that it continues")
    parser.add_argument("--program", metavar="FILE", help="program to use [default: that of this package]")
    parser.add_argument("arguments", nargs="*", help="arguments of the script")
    args = parser.parse_intermixed_args(arguments)
    if args.program:
        _recorder.program = [args.program]
    _stand_in()
    out = os.path.abspath(args.out)
    before = sys.argv
    sys.argv = [args.script, *args.arguments]
    sys.path.insert(0, os.path.dirname(os.path.abspath(args.script)))
    try:
        runpy.run_path(args.script, run_name="__main__")
    except SystemExit as end:
        if end.code not in (None, 0):
            raise
    finally:
        sys.argv = before
    options = [o for name in ("units", "case") for o in ([f"--{name}", getattr(args, name)] if getattr(args, name) else [])]
    return _recorder.save_model(out, *options)


if __name__ == "__main__":
    # The same module under both names: what the script imports is what records.
    sys.modules["trilith.opensees"] = sys.modules[__name__]
    sys.exit(main())
