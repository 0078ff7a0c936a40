"""Exudyn on a rigid block of three degrees of freedom that slides and rocks on two corners.

    python exudyn_block.py [--newton full|modified] [--mu MU] [--amplitude G] [--dt S] [--time S]

Prints one line of JSON: CPU seconds of a step and 20-s analyses in a CPU second.

The block has coordinates x, z and a rotation; contact is a limit stop on the displacement of a corner, friction a
constant force regularised in speed (it does not follow the normal force). The ground moves by a symbolic
function, so that no Python runs in a step.
"""
import argparse
import json
import math
import os
import sys
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
import numpy as np  # noqa: E402
import exudyn as exu  # noqa: E402
import exudyn.itemInterface as item  # noqa: E402
from exudyn.utilities import CreateSymbolicUserFunction  # noqa: E402

GRAVITY = 9.81
MASS, HALF_WIDTH, HALF_HEIGHT = 4000.0, 0.5, 1.0  # 1 m x 2 m
CONTACT = 1e8  # N/m
BOUNCE, TURN = 2e4, 2e3  # dashpots: N s/m at each corner, N m s at the centre
CREEP = 1e-3  # speed below which friction is proportional to it, m/s
FREQUENCY, SHAKEN = 5.0, 10.0  # sine of the ground, Hz, and how long, s
X, Z, TURNING = range(3)


def build(system, mu, amplitude):
    inertia = MASS * (HALF_WIDTH**2 + HALF_HEIGHT**2) / 3.0
    # It starts where its weight has pressed it into the stops.
    rest = [0.0, -MASS * GRAVITY / 2.0 / CONTACT, 0.0]
    body = system.AddNode(item.NodeGenericODE2(
        referenceCoordinates=[0.0] * 3, initialCoordinates=rest, initialCoordinates_t=[0.0] * 3,
        numberOfODE2Coordinates=3,
    ))
    system.AddObject(item.ObjectGenericODE2(
        nodeNumbers=[body], massMatrix=np.diag([MASS, MASS, inertia]), stiffnessMatrix=np.zeros((3, 3)),
        dampingMatrix=np.diag([0.0, 0.0, TURN]), forceVector=[0.0, -MASS * GRAVITY, 0.0],
    ))
    mark = [system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=body, coordinate=c)) for c in range(3)]
    for side in (-1.0, 1.0):
        # What the stops and the friction remember of the last step.
        data = [system.AddNode(item.NodeGenericData(initialCoordinates=[0.0] * 3, numberOfDataCoordinates=3)) for _ in range(2)]
        # factor1 * rotation - factor0 * translation: displacement of the corner
        system.AddObject(item.CoordinateSpringDamperExt(
            markerNumbers=[mark[Z], mark[TURNING]], nodeNumber=data[0], factor0=-1.0, factor1=side * HALF_WIDTH,
            useLimitStops=True, limitStopsLower=0.0, limitStopsUpper=1e3,
            limitStopsStiffness=CONTACT, damping=BOUNCE,
        ))
        system.AddObject(item.CoordinateSpringDamperExt(
            markerNumbers=[mark[X], mark[TURNING]], nodeNumber=data[1], factor0=-1.0, factor1=HALF_HEIGHT,
            fDynamicFriction=None, dynamicFrictionForce=mu * MASS * GRAVITY / 2.0, frictionProportionalZone=CREEP,
        ))
    push = system.AddLoad(item.LoadCoordinate(markerNumber=mark[X], load=-MASS * amplitude * GRAVITY))

    def shake(mbs, t, load):
        return load * exu.symbolic.sin(2.0 * math.pi * FREQUENCY * t)

    system.Assemble()
    function = CreateSymbolicUserFunction(system, shake, "loadUserFunction", push)
    system.SetLoadParameter(push, "loadUserFunction", function)
    return body


def main():
    arguments = argparse.ArgumentParser(description="Exudyn on a sliding and rocking block")
    arguments.add_argument("--newton", choices=("full", "modified"), default="full")
    arguments.add_argument("--mu", type=float, default=0.4)
    arguments.add_argument("--amplitude", type=float, default=0.8, help="of the ground, in g")
    arguments.add_argument("--dt", type=float, default=1e-3)
    arguments.add_argument("--time", type=float, default=SHAKEN, help="s of motion that are measured")
    a = arguments.parse_args()
    container = exu.SystemContainer()
    system = container.AddSystem()
    body = build(system, a.mu, a.amplitude)
    steps = round(a.time / a.dt)
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = steps
    settings.timeIntegration.endTime = a.time
    settings.timeIntegration.newton.useModifiedNewton = a.newton == "modified"
    settings.timeIntegration.generalizedAlpha.spectralRadius = 1.0
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.parallel.numberOfThreads = 1
    begin = time.process_time()
    good = system.SolveDynamic(settings, solverType=exu.DynamicSolverType.GeneralizedAlpha)
    step = (time.process_time() - begin) / steps
    if not good:
        sys.exit("no convergence")
    print(json.dumps({
        "version": exu.__version__,
        "newton": a.newton,
        "step_s": step,
        "analyses_per_s": a.dt / (20.0 * step),
        "x": float(system.GetNodeOutput(body, exu.OutputVariableType.Coordinates)[X]),
    }))


if __name__ == "__main__":
    main()
