"""Leads materials and elements of OpenSees along given motions.

Reads from stdin a list of tasks as JSON and prints for each the forces, or what went wrong.

forces        the second of two nodes is led along `d`, with the rates `v`, and the forces on it are printed
displacement  a mass on that element under the force `p` moves by itself, and its displacement is printed
structure     a structure that commands build moves, from rest or from under a weight, and the displacements of
              the nodes that are watched are printed
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


def start(task, directions=DIRECTIONS):
    ops.wipe()
    space = min(directions, 3)
    ops.model("basic", "-ndm", space, "-ndf", directions)
    for node in (GROUND, MOVED, BESIDE):
        ops.node(node, *[0.0] * space)
    ops.fix(GROUND, *[1] * directions)
    # An analysis wants a free direction: an oscillator of no account, which nothing moves.
    ops.fix(BESIDE, 0, *[1] * (directions - 1))
    ops.mass(BESIDE, *[1.0] * directions)
    ops.uniaxialMaterial("Elastic", 1000, 1.0)
    ops.element("zeroLength", 1000, GROUND, BESIDE, "-mat", 1000, "-dir", 1)
    for command in task["commands"]:
        call(command)


def analysis(algorithm, rule=("Newmark", 0.5, 0.25)):
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-12, 50, 0)
    ops.algorithm(algorithm)
    ops.integrator(*rule)
    ops.analysis("Transient")


def series(tag, values, dt):
    ops.timeSeries("Path", tag, "-dt", dt, "-values", *values, "-useLast")


def forces(task):
    """Forces on the moved node in the led directions, a list for each of the times that are kept."""
    directions, dt, led = task["freedoms"], task["dt"], task["directions"]
    start(task, directions)
    held = [0 if i + 1 in led else 1 for i in range(directions)]
    ops.fix(MOVED, *held)
    ops.pattern("MultipleSupport", 1)
    for i, (d, v) in enumerate(zip(task["d"], task["v"])):
        series(2 * i + 1, d, dt)
        series(2 * i + 2, v, dt)
        ops.groundMotion(i + 1, "Plain", "-disp", 2 * i + 1, "-vel", 2 * i + 2)
        ops.imposedMotion(MOVED, led[i], i + 1)
    analysis("Linear")
    first = directions * ops.eleNodes(ELEMENT).index(MOVED)
    kept = []
    for step in range(1, len(task["d"][0])):
        if ops.analyze(1, dt) != 0:
            raise RuntimeError(f"step {step} does not converge")
        if step % task["every"] == 0:
            f = ops.eleForce(ELEMENT)
            kept.append([f[first + i - 1] for i in led])
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


def weighed(commands):
    """The loads of these commands come to act, and stay."""
    ops.timeSeries("Linear", 1000)
    ops.pattern("Plain", 1000, 1000)
    for command in commands:
        call(command)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-14, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    if ops.analyze(10) != 0:
        raise RuntimeError("the weight does not come to rest")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()


def structure(task):
    """Displacements of the nodes that are watched, a list for each time that is kept."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", DIRECTIONS)
    for command in task["commands"]:
        call(command)
    if task["weight"]:
        weighed(task["weight"])
    for i, values in enumerate(task["waves"]):
        series(i + 1, values, task["dt"])
    for command in task["motion"]:
        call(command)
    analysis("Newton", task["rule"])
    kept = []
    for step in range(1, task["steps"] + 1):
        if ops.analyze(1, task["dt"]) != 0:
            raise RuntimeError(f"step {step} does not converge")
        if step % task["every"] == 0:
            kept.append([ops.nodeDisp(node, direction) for node, direction in task["watched"]])
    return kept


def answer(task):
    try:
        work = {"forces": forces, "displacement": displacement, "structure": structure}
        values = work[task["what"]](task)
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
