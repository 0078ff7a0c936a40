"""Leads materials and elements of OpenSees along given motions.

Reads from stdin a list of tasks as JSON and prints for each the forces, or what went wrong.

forces        the second of two nodes is led along `d`, with the rates `v`, and the forces on it are printed
displacement  a mass on that element under the force `p` moves by itself, and its displacement is printed
"""

import json
import math
import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")
import openseespy.opensees as ops  # noqa: E402

GROUND, MOVED, BESIDE = 1, 2, 3
ELEMENT = 1
DIRECTIONS = 6


def call(command):
    """One command as a list: its name and what it takes."""
    getattr(ops, command[0])(*command[1:])


def start(task):
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", DIRECTIONS)
    for node in (GROUND, MOVED, BESIDE):
        ops.node(node, 0.0, 0.0, 0.0)
    ops.fix(GROUND, *[1] * DIRECTIONS)
    # An analysis wants a free direction: an oscillator of no account, which nothing moves.
    ops.fix(BESIDE, 0, *[1] * (DIRECTIONS - 1))
    ops.mass(BESIDE, *[1.0] * DIRECTIONS)
    ops.uniaxialMaterial("Elastic", 1000, 1.0)
    ops.element("zeroLength", 1000, GROUND, BESIDE, "-mat", 1000, "-dir", 1)
    for command in task["commands"]:
        call(command)


def analysis(algorithm):
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-12, 50, 0)
    ops.algorithm(algorithm)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def series(tag, values, dt):
    ops.timeSeries("Path", tag, "-dt", dt, "-values", *values, "-useLast")


def forces(task):
    """Forces on the moved node in the led directions, a list for each of the times that are kept."""
    start(task)
    dt, led = task["dt"], task["directions"]
    held = [0 if i + 1 in led else 1 for i in range(DIRECTIONS)]
    ops.fix(MOVED, *held)
    ops.pattern("MultipleSupport", 1)
    for i, (d, v) in enumerate(zip(task["d"], task["v"])):
        series(2 * i + 1, d, dt)
        series(2 * i + 2, v, dt)
        ops.groundMotion(i + 1, "Plain", "-disp", 2 * i + 1, "-vel", 2 * i + 2)
        ops.imposedMotion(MOVED, led[i], i + 1)
    analysis("Linear")
    kept = []
    for step in range(1, len(task["d"][0])):
        if ops.analyze(1, dt) != 0:
            raise RuntimeError(f"step {step} does not converge")
        if step % task["every"] == 0:
            f = ops.eleForce(ELEMENT)
            kept.append([f[DIRECTIONS + i - 1] for i in led])
    return kept


def displacement(task):
    """Displacement of the moved node along the first direction, a list for each time that is kept."""
    start(task)
    ops.fix(MOVED, 0, *[1] * (DIRECTIONS - 1))
    ops.mass(MOVED, *[task["mass"]] * DIRECTIONS)
    series(1, task["p"], task["dt"])
    ops.pattern("Plain", 1, 1)
    ops.load(MOVED, 1.0, *[0.0] * (DIRECTIONS - 1))
    analysis("Newton")
    kept = []
    for step in range(1, len(task["p"])):
        if ops.analyze(1, task["dt"]) != 0:
            raise RuntimeError(f"step {step} does not converge")
        if step % task["every"] == 0:
            kept.append([ops.nodeDisp(MOVED, 1)])
    return kept


def answer(task):
    try:
        values = {"forces": forces, "displacement": displacement}[task["what"]](task)
    except Exception as problem:  # noqa: BLE001: one task that fails is an answer, not the end of the others
        return {"problem": f"{type(problem).__name__}: {problem}"}
    if all(math.isfinite(x) for row in values for x in row):
        return {"values": values}
    return {"problem": "a value is not a number"}


if __name__ == "__main__":
    # What elements say of themselves must not get between the answers.
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    json.dump([answer(task) for task in json.load(sys.stdin)], out)
    out.flush()
