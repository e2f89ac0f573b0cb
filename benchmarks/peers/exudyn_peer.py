"""Exudyn: a tree by its joint coordinates and explicit steps; loops by the coordinates of bodies, implicitly, with multipliers."""

import sys

sys.exudynFast = True  # without range checks
import exudyn as exu
import exudyn.utilities as eu
import numpy as np
import problems
from batch import THREADS
from entry import Entry, steps


def stepped(mbs, end, method, sample=1e3):
    """A motion from the start by steps of h."""
    settings = exu.SimulationSettings()
    time = settings.timeIntegration
    time.endTime, time.newton.useModifiedNewton = end, True
    time.newton.relativeTolerance = time.newton.absoluteTolerance = 1e-10
    settings.solutionSettings.writeSolutionToFile = False
    settings.solutionSettings.sensorsWritePeriod = sample

    def solve(h):
        time.numberOfSteps = round(end / h)
        mbs.SolveDynamic(settings, solverType=method)
        return mbs.systemData.GetODE2Coordinates()

    return solve


def double_pendulum():
    a, b = problems.PENDULUM[:2]
    mbs = exu.SystemContainer().AddSystem()
    turns = {"numberOfODE2Coordinates": 2, "referenceCoordinates": [0, 0], "initialCoordinates": [a, b - a]}
    tree = eu.ObjectKinematicTree(
        nodeNumber=mbs.AddNode(eu.NodeGenericODE2(**turns, initialCoordinates_t=[0, 0])),
        gravity=[0, -problems.G, 0],
        jointTypes=[exu.JointType.RevoluteZ] * 2,
        linkParents=[-1, 0],
        jointTransformations=exu.Matrix3DList([np.eye(3)] * 2),
        jointOffsets=exu.Vector3DList([[0, 0, 0], [1, 0, 0]]),
        linkInertiasCOM=exu.Matrix3DList([np.eye(3) / 12] * 2),
        linkCOMs=exu.Vector3DList([[0.5, 0, 0]] * 2),
        linkMasses=[1, 1],
    )
    mbs.AddObject(tree)
    mbs.Assemble()
    solve = stepped(mbs, problems.END, exu.DynamicSolverType.RK67)
    yield Entry("Exudyn, RK67", solve, steps(problems.END, 160, 16), "a kinematic tree; fixed steps", np.cumsum)


def body(mbs, mass, inertia, place, rates=(0, 0, 0)):
    """In the plane, with its weight."""
    node = mbs.AddNode(eu.NodeRigidBody2D(initialCoordinates=place, initialVelocities=rates))
    made = mbs.AddObject(eu.ObjectRigidBody2D(nodeNumber=node, physicsMass=mass, physicsInertia=inertia))
    at = mbs.AddMarker(eu.MarkerBodyPosition(bodyNumber=made))
    mbs.AddLoad(eu.LoadForceVector(markerNumber=at, loadVector=[0, -mass * problems.G, 0]))
    return made


def hinge(mbs, *sites):
    markers = [mbs.AddMarker(eu.MarkerBodyPosition(bodyNumber=each, localPosition=[x, 0, 0])) for each, x in sites]
    return mbs.AddObject(eu.RevoluteJoint2D(markerNumbers=markers))


def four_bar():
    mbs = exu.SystemContainer().AddSystem()
    ground, starts = mbs.AddObject(eu.ObjectGround()), ((0, 0), (0.6, 0.8), (2, 0))
    bars = []
    for (x, y), turn, mass, length in zip(starts, problems.angles(problems.FOUR_BAR[0]), (1, 2, 1.5), (1, 2.5, 2), strict=True):
        place = [x + length / 2 * np.cos(turn), y + length / 2 * np.sin(turn), turn]
        bars.append(body(mbs, mass, mass * length**2 / 12, place))
    a, b, c = bars
    for sites in (((ground, 0), (a, -0.5)), ((a, 0.5), (b, -1.25)), ((b, 1.25), (c, 1)), ((c, -1), (ground, 2))):
        hinge(mbs, *sites)
    mbs.Assemble()
    solve = stepped(mbs, problems.END, exu.DynamicSolverType.TrapezoidalIndex2)
    says = "bodies and multipliers, which are the reactions; trapezoidal rule of index 2, fixed steps"
    yield Entry("Exudyn", solve, steps(problems.END, 20_000, 15), says, lambda q: q[2::3])


def slider_cranks():
    """The first of them."""
    r, l = 0.1, problems.RODS[0]
    mbs = exu.SystemContainer().AddSystem()
    ground, w = mbs.AddObject(eu.ObjectGround()), problems.TURNING[1]
    crank = body(mbs, 1, r**2 / 12, [r / 2, 0, 0], [0, w * r / 2, w])
    rod = body(mbs, 2, l**2 / 6, [r + l / 2, 0, 0], [0, w * r / 2, -w * r / l])
    slider = body(mbs, 1.5, 0.01, [r + l, 0, 0])
    hinge(mbs, (ground, 0), (crank, -r / 2))
    hinge(mbs, (crank, r / 2), (rod, -l / 2))
    hinge(mbs, (rod, l / 2), (slider, 0))
    node, zero = mbs.GetObject(slider)["nodeNumber"], mbs.AddNode(eu.NodePointGround())
    for coordinate in (1, 2):
        places = ((zero, 0), (node, coordinate))
        markers = [mbs.AddMarker(eu.MarkerNodeCoordinate(nodeNumber=at, coordinate=each)) for at, each in places]
        mbs.AddObject(eu.CoordinateConstraint(markerNumbers=markers))

    def multipliers(mbs, *_):
        return list(mbs.systemData.GetAECoordinates())

    sensor = mbs.AddSensor(eu.SensorUserFunction(sensorUserFunction=multipliers, storeInternal=True))
    mbs.Assemble()
    solve = stepped(mbs, problems.SEEN[-1], exu.DynamicSolverType.TrapezoidalIndex2, problems.SEEN[1])
    says = "one of them, on one core; counted as 1000 on all. Multipliers, which are the reactions; trapezoidal rule of index 2"
    share = THREADS / len(problems.RODS)
    yield Entry("Exudyn", solve, steps(problems.SEEN[1], 32, 16), says, lambda _: -mbs.GetSensorStoredData(sensor)[:, 1:8], share)
