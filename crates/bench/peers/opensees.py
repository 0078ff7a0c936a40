"""OpenSees on a frame that `benchmark export` wrote.

    python opensees.py MODEL.json [--algorithm newton|tuned] [--system auto|BandSPD|Mumps|...] [--warm N] [--steps N]

Prints one line of JSON: CPU seconds of building, of the first step and of one step (median), iterations in a
step, and the probe (roof less base) after the last step, by which both programs can be seen to run the same
model. Newmark, constant average acceleration.

newton  tangent formed and factorised in every iteration: common practice
tuned   initial tangent, factorised once for the whole run
"""
import argparse
import json
import os
import statistics
import sys
import time

for _threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")
import openseespy.opensees as ops  # noqa: E402  (reads the variables above)

ALGORITHMS = {
    "newton": ("Newton",),
    # In this order: after -initial the other flag is not seen.
    "tuned": ("ModifiedNewton", "-FactorOnce", "-initial"),
}
# What was fastest of BandSPD, ProfileSPD, SparseSYM, UmfPack, SuperLU and Mumps.
SMALL = ("BandSPD", "RCM")
LARGE = ("Mumps", "AMD")
LIMIT = 2000


def build(model):
    """Nodes, elements, damping and motion; returns the largest node tag."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i, (x, y, z) in enumerate(model["nodes"]):
        ops.node(i + 1, x, y, z)
        ops.mass(i + 1, *model["mass"][6 * i : 6 * i + 6])
    transformations = {}
    tag = 0
    for beam in model["beams"]:
        axis = tuple(beam["axis3"])
        if axis not in transformations:
            transformations[axis] = len(transformations) + 1
            ops.geomTransf("Linear", transformations[axis], *axis)
        tag += 1
        i, j = (n + 1 for n in beam["nodes"])
        # Local y, z of OpenSees are 2, 3 here.
        section = (beam[k] for k in ("area", "young", "shear", "torsion", "i2", "i3"))
        ops.element("elasticBeamColumn", tag, i, j, *section, transformations[axis])
    ground = {}

    def grounded(node):
        """A fixed twin of a node."""
        if node not in ground:
            ground[node] = len(model["nodes"]) + 1 + len(ground)
            ops.node(ground[node], *model["nodes"][node])
            ops.fix(ground[node], 1, 1, 1, 1, 1, 1)
        return ground[node], node + 1

    material = 0
    for spring in model["springs"]:
        materials = []
        for k in spring["k"]:
            material += 1
            ops.uniaxialMaterial("Elastic", material, k)
            materials.append(material)
        tag += 1
        ops.element("zeroLength", tag, *grounded(spring["node"]), "-mat", *materials, "-dir", 1, 2, 3, "-doRayleigh", 1)
    for n, bearing in enumerate(model["bearings"]):
        # Coupled plasticity without hardening; section y and z lie along X and Y.
        ops.section("Bidirectional", n + 1, bearing["k"], bearing["fy"], 0.0, 0.0, "Vy", "Vz")
        tag += 1
        upright = ("-orient", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
        ops.element("zeroLengthSection", tag, *grounded(bearing["node"]), n + 1, *upright, "-doRayleigh", 0)
    for damper in model["dampers"]:
        material += 1
        tag += 1
        ops.uniaxialMaterial("Viscous", material, damper["c"], 1.0)
        ops.element("zeroLength", tag, *grounded(damper["node"]), "-mat", material, "-dir", damper["dof"] + 1)
    mass, stiffness = model["rayleigh"]
    ops.rayleigh(mass, stiffness, 0.0, 0.0)
    for n, motion in enumerate(model["motions"]):
        ops.timeSeries("Path", n + 1, "-dt", model["dt"], "-values", *motion["values"])
        ops.pattern("UniformExcitation", n + 1, motion["dof"] + 1, "-accel", n + 1)


def main():
    arguments = argparse.ArgumentParser(description="OpenSees on an exported frame")
    arguments.add_argument("model")
    arguments.add_argument("--algorithm", choices=ALGORITHMS, default="newton")
    arguments.add_argument("--system", default="auto")
    arguments.add_argument("--warm", type=int, default=100, help="steps before the measured ones")
    arguments.add_argument("--steps", type=int, default=20, help="measured steps")
    arguments.add_argument("--tolerance", type=float, default=1e-8, help="norm of the last increment")
    a = arguments.parse_args()
    with open(a.model, encoding="utf-8") as file:
        model = json.load(file)
    if a.warm + a.steps + 1 > model["steps"]:
        sys.exit("the model lasts %d steps" % model["steps"])

    cpu = time.process_time
    start = cpu()
    build(model)
    dof = 6 * len(model["nodes"])
    system, numberer = (SMALL if dof < LIMIT else LARGE) if a.system == "auto" else (a.system, "RCM")
    ops.constraints("Plain")
    ops.numberer(numberer)
    ops.system(system)
    ops.test("NormDispIncr", a.tolerance, 50)
    ops.algorithm(*ALGORITHMS["tuned"])
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    built = cpu()
    dt = model["dt"]
    failed = ops.analyze(1, dt)
    first = cpu()
    # To the strong motion by the faster way, then by the one that is asked for.
    failed = failed or ops.analyze(a.warm, dt)
    if a.algorithm != "tuned":
        ops.algorithm(*ALGORITHMS[a.algorithm])
        failed = failed or ops.analyze(1, dt)
    made = 1 + a.warm + (a.algorithm != "tuned")
    times, iterations = [], []
    while made < 1 + a.warm + a.steps and not failed:
        begin = cpu()
        failed = ops.analyze(1, dt)
        times.append(cpu() - begin)
        iterations.append(ops.testIter())
        made += 1
    if failed:
        sys.exit("no convergence")
    probe = sum(p["factor"] * ops.nodeDisp(p["node"] + 1, p["dof"] + 1) for p in model["probe"])
    print(json.dumps({
        "version": str(ops.version()),
        "system": system,
        "dof": dof,
        "build_s": built - start,
        "first_s": first - built,
        "step_s": statistics.median(times),
        "mean_step_s": statistics.mean(times),
        "iterations": statistics.mean(iterations),
        "steps": made,
        "probe": probe,
    }))


if __name__ == "__main__":
    main()
