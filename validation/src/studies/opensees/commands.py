"""Gives OpenSees the commands of a script, one after the other.

Reads from stdin a list of tasks as JSON, each with the commands, the outputs that are wanted of the last analysis, and how
many periods before it; prints for each the largest and smallest values and the periods, or what went wrong.
"""

import json
import math
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")
import openseespy.opensees as ops  # noqa: E402

DIRECTIONS = {1: ["Ux"], 2: ["Ux", "Uy", "Rz"], 3: ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"]}
# Tags for series that a pattern names by their kind.
SERIES = 900_000


def number(word):
    for kind in (int, float):
        try:
            return kind(word)
        except ValueError:
            pass
    return word


def words(command):
    """Words as Python has them; a word that is a list of Tcl becomes several."""
    return [number(part) for word in command for part in (word.split() if " " in word else [word])]


def give(command, given):
    name, *rest = words(command)
    if name == "pattern" and rest[0] == "Plain" and isinstance(rest[2], str):
        ops.timeSeries(rest[2], SERIES + given)
        rest[2] = SERIES + given
    getattr(ops, name)(*rest)


def value(output, ndm):
    node, direction, *what = output.split(" ")
    dof = DIRECTIONS[ndm].index(direction) + 1
    if what == ["reaction"]:
        ops.reactions()
        return ops.nodeReaction(int(node), dof)
    return (ops.nodeVel if what == ["velocity"] else ops.nodeDisp)(int(node), dof)


def run(task):
    ops.wipe()
    commands, outputs = task["commands"], task["outputs"]
    changes = [i for i, c in enumerate(commands) if c[0] in ("analysis", "loadConst")]
    last = next(i for i in range(changes[-1], len(commands)) if commands[i][0] == "analyze")
    is_dynamic = any(c[:2] == ["analysis", "Transient"] for c in commands)
    ndm, periods, peaks = 3, [], [[-math.inf, math.inf] for _ in outputs]

    def look():
        for peak, output in zip(peaks, outputs):
            x = value(output, ndm)
            peak[0], peak[1] = max(peak[0], x), min(peak[1], x)

    for i, command in enumerate(commands):
        name = command[0]
        if name == "model":
            ndm = int(command[command.index("-ndm") + 1])
        if i == last:
            if task["periods"]:
                found = ops.eigen("-fullGenLapack", task["periods"])
                periods = [2 * math.pi / math.sqrt(w) for w in found]
            if is_dynamic:
                look()
        if name == "analyze":
            count, *step = words(command)[1:]
            for _ in range(count):
                if ops.analyze(1, *step) != 0:
                    raise RuntimeError("a step does not converge")
                if i >= last:
                    look()
        elif name != "recorder":
            give(command, i)
    return {"peaks": peaks, "periods": periods}


def answer(task):
    try:
        return run(task)
    except Exception as problem:  # noqa: BLE001
        return {"problem": f"{type(problem).__name__}: {problem}"}


json.dump([answer(task) for task in json.load(sys.stdin)], sys.stdout)
