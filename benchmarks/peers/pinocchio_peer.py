"""Pinocchio: its algorithms for one instant, and SciPy's DOP853 for motions."""

import numpy as np
import pinocchio as pin
import problems
from entry import TOLERANCES, Entry
from scipy.integrate import DOP853, solve_ivp


def chained(*links):
    """Bars, each (mass, length, on which joint, how far along that bar), that turn about z."""
    model = pin.Model()
    model.gravity.linear = np.array([0, -problems.G, 0])
    for mass, length, on, along in links:
        joint = model.addJoint(on, pin.JointModelRZ(), pin.SE3(np.eye(3), np.array([along, 0, 0.0])), "")
        inertia = pin.Inertia(mass, np.array([length / 2, 0, 0]), np.eye(3) * mass * length**2 / 12)
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    return model, model.createData()


def chain(n):
    model, data = chained(*((1, 1, i, min(i, 1)) for i in range(n)))
    q, u = problems.chain_state(n)
    none = np.zeros(n)

    def both(_):
        pin.rnea(model, data, q, u, pin.aba(model, data, q, u, none))

    def read(_):
        turns, a = np.exp(1j * np.cumsum(q)), pin.aba(model, data, q, u, none)
        pin.rnea(model, data, q, u, a)
        forces = turns * [f.linear[0] + 1j * f.linear[1] for f in list(data.f)[1:]]
        return np.append(a, np.column_stack([forces.real, forces.imag]))

    says = "accelerations, all reactions in the frames of their bars"
    yield Entry("Pinocchio, aba + rnea", both, says=says, read=read)
    yield Entry("Pinocchio, aba", lambda _: pin.aba(model, data, q, u, none), says="accelerations; no reactions")


def motion(accelerations, start, read, says):
    n = len(start)

    def derivative(t, y):
        return np.append(y[n:], accelerations(y[:n], y[n:]))

    def solve(rtol):
        found = solve_ivp(derivative, (0, problems.END), [*start, *[0] * n], DOP853, rtol=max(rtol, 3e-14), atol=rtol / 100)
        return found.y[:n, -1]

    yield Entry(f"Pinocchio, {says}", solve, TOLERANCES, "integrated by SciPy", read)


def double_pendulum():
    model, data = chained((1, 1, 0, 0), (1, 1, 1, 1))
    none, (a, b) = np.zeros(2), problems.PENDULUM[:2]
    yield from motion(lambda q, u: pin.aba(model, data, q, u, none), [a, b - a], np.cumsum, "aba + DOP853")


def four_bar():
    model, data = chained((1, 1, 0, 0), (2, 2.5, 1, 1), (1.5, 2, 0, 2))
    ends = [pin.SE3(np.eye(3), np.array([length, 0, 0])) for length in (2.5, 2)]
    loop = pin.StdVec_RigidConstraintModel()
    loop.append(pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, model, 2, ends[0], 3, ends[1], pin.LOCAL))
    found = pin.StdVec_RigidConstraintData()
    found.append(loop[0].createData())
    pin.initConstraintDynamics(model, data, loop, found)
    none, (a, b, c) = np.zeros(3), problems.angles(problems.FOUR_BAR[0])
    proximal = pin.ProximalSettings(1e-14, 1e-10, 20)

    def accelerations(q, u):
        return pin.constraintDynamics(model, data, q, u, none, loop, found, proximal)

    def read(q):
        return np.array([q[0], q[0] + q[1], q[2]])

    yield from motion(accelerations, [a, b - a, c], read, "constraintDynamics + DOP853")
