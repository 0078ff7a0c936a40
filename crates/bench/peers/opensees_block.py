"""OpenSees on a rigid block of three degrees of freedom that slides and rocks on two corners.

    python opensees_block.py [--links coupled|uncoupled] [--mu MU] [--amplitude G] [--dt S] [--time S]

Prints one line of JSON: CPU microseconds in a step and 20-s analyses in a CPU second.

coupled    flatSliderBearing: friction follows the normal force, the corner lifts off
uncoupled  compression-only spring beside an elastic-perfectly plastic one of constant strength
"""
import argparse
import json
import math
import os
import sys
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
import openseespy.opensees as ops  # noqa: E402

GRAVITY = 9.81
MASS, HALF_WIDTH, HALF_HEIGHT = 4000.0, 0.5, 1.0  # 1 m x 2 m
CONTACT, SHEAR = 1e8, 1e8  # N/m, normal and before slip
BOUNCE, TURN = 2e4, 2e3  # dashpots: N s/m at each corner, N m s at the centre
FREQUENCY, SHAKEN = 5.0, 10.0  # sine of the ground, Hz, and how long, s


def build(links, mu):
    inertia = MASS * (HALF_WIDTH**2 + HALF_HEIGHT**2) / 3.0
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    centre, post = 1, 2
    for node in (centre, post):
        ops.node(node, 0.0, HALF_HEIGHT)
    ops.mass(centre, MASS, MASS, inertia)
    ops.fix(post, 1, 1, 1)
    contact, soft, bounce, turn, shear = 1, 2, 3, 4, 5
    ops.uniaxialMaterial("ENT", contact, CONTACT)
    ops.uniaxialMaterial("Elastic", soft, 1e-3)
    ops.uniaxialMaterial("Viscous", bounce, BOUNCE, 1.0)
    ops.uniaxialMaterial("Viscous", turn, TURN, 1.0)
    ops.uniaxialMaterial("ElasticPP", shear, SHEAR, mu * MASS * GRAVITY / 2.0 / SHEAR)
    ops.frictionModel("Coulomb", 1, mu)
    ops.element("zeroLength", 1, post, centre, "-mat", turn, "-dir", 3)
    for side in (-1, 1):
        below, corner = 11 + side, 21 + side
        ops.node(below, side * HALF_WIDTH, 0.0)
        ops.fix(below, 1, 1, 1)
        ops.node(corner, side * HALF_WIDTH, 0.0)
        ops.rigidLink("beam", centre, corner)
        ops.element("zeroLength", 40 + side, below, corner, "-mat", bounce, "-dir", 2)
        if links == "coupled":
            upright = ("-orient", 0.0, 1.0, 0.0, -1.0, 0.0, 0.0)
            stiff = ("-P", contact, "-Mz", soft)
            ops.element("flatSliderBearing", 30 + side, below, corner, 1, SHEAR, *stiff, *upright, "-iter", 25, 1e-10)
        else:
            ops.element("zeroLength", 30 + side, below, corner, "-mat", shear, contact, "-dir", 1, 2)


def settle(system, test):
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system(system)
    ops.test(*test)
    ops.algorithm("Newton")


def main():
    arguments = argparse.ArgumentParser(description="OpenSees on a sliding and rocking block")
    arguments.add_argument("--links", choices=("coupled", "uncoupled"), default="coupled")
    arguments.add_argument("--mu", type=float, default=0.4)
    arguments.add_argument("--amplitude", type=float, default=0.8, help="of the ground, in g")
    arguments.add_argument("--dt", type=float, default=1e-3)
    arguments.add_argument("--time", type=float, default=4.0, help="s of motion that are measured")
    a = arguments.parse_args()
    build(a.links, a.mu)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(1, 0.0, -MASS * GRAVITY, 0.0)
    settle("FullGeneral", ("NormUnbalance", 1e-6, 20))
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    failed = ops.analyze(1)
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()

    steps = round(a.time / a.dt)
    wave = 2.0 * math.pi * FREQUENCY * a.dt
    shaken = round(SHAKEN / a.dt)
    peak = a.amplitude * GRAVITY
    motion = [peak * math.sin(wave * i) if i < shaken else 0.0 for i in range(steps + 2)]
    ops.timeSeries("Path", 2, "-dt", a.dt, "-values", *motion)
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    settle("FullGeneral", ("NormDispIncr", 1e-11, 30))
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    begin = time.process_time()
    failed = failed or ops.analyze(steps, a.dt)
    step = (time.process_time() - begin) / steps
    if failed:
        sys.exit("no convergence")
    print(json.dumps({
        "version": str(ops.version()),
        "links": a.links,
        "step_s": step,
        "analyses_per_s": a.dt / (20.0 * step),
        "x": ops.nodeDisp(1, 1),
    }))


if __name__ == "__main__":
    main()
