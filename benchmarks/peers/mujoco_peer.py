"""MuJoCo: the coordinates of the joints; loops and contacts are soft, as hard as steps allow."""

import mujoco
import numpy as np
import problems
from entry import Entry, steps

RK4 = 'integrator="RK4" tolerance="1e-15" iterations="100"'


def model(bodies, gravity=(0, -problems.G), more="", option=RK4):
    text = f'<option gravity="{gravity[0]} {gravity[1]} 0" {option}/><worldbody>{bodies}</worldbody>{more}'
    made = mujoco.MjModel.from_xml_string(f"<mujoco>{text}</mujoco>")
    return made, mujoco.MjData(made)


def bar(mass, length, at, inner=""):
    inertia = mass * length**2 / 12
    return f"""<body pos="{at} 0 0"><joint type="hinge" axis="0 0 1"/>
        <inertial pos="{length / 2} 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>{inner}</body>"""


def chain(n):
    bodies = ""
    for i in reversed(range(n)):
        bodies = bar(1, 1, min(i, 1), bodies)
    made, data = model(bodies)
    data.qpos, data.qvel = problems.chain_state(n)

    def solve(_):
        mujoco.mj_forward(made, data)
        mujoco.mj_rnePostConstraint(made, data)
        return data

    def read(data):
        return np.append(data.qacc, data.cfrc_int[1:, 3:5])

    yield Entry("MuJoCo, mj_forward", solve, says="accelerations; all reactions by mj_rnePostConstraint", read=read)


def stepped(made, data, start, end):
    """From a start at rest to an end by steps of h."""

    def solve(h):
        mujoco.mj_resetData(made, data)
        count = round(end / h)
        data.qpos, made.opt.timestep = start, end / count
        mujoco.mj_step(made, data, count)
        return data.qpos

    return solve


def double_pendulum():
    a, b = problems.PENDULUM[:2]
    solve = stepped(*model(bar(1, 1, 0, bar(1, 1, 1))), [a, b - a], problems.END)
    yield Entry("MuJoCo, RK4", solve, steps(problems.END, 300, 24), "fixed steps, looped in C", np.cumsum)


def four_bar():
    a, b, c = problems.angles(problems.FOUR_BAR[0])
    coupler, rocker = (f'<site name="{name}" pos="{x} 0 0"/>' for name, x in (("coupler", 2.5), ("rocker", 2)))
    bodies = bar(1, 1, 0, bar(2, 2.5, 1, coupler)) + bar(1.5, 2, 2, rocker)
    loop = '<equality><connect site1="coupler" site2="rocker" solref="1e-4 1" solimp="0.9999 0.9999 1"/></equality>'
    solve = stepped(*model(bodies, more=loop), [a, b - a, c], problems.END)

    says = "the loop a soft equality, as stiff as its steps allow"
    yield Entry("MuJoCo, RK4", solve, steps(problems.END, 1200, 17), says, lambda q: np.array([q[0], q[0] + q[1], q[2]]))


def block():
    bodies = """<geom type="plane" size="10 10 1" zaxis="0 1 0"/><body pos="0 0.1 0"><joint type="slide" axis="1 0 0"/>
        <joint type="slide" axis="0 1 0"/><joint type="hinge" axis="0 0 1"/><geom type="box" size="0.2 0.1 0.1" mass="1"/></body>"""
    soft = f'<default><geom friction="{problems.FRICTION} 0 0" solimp="0.99 0.9999 0.001"/></default>'
    made, data = model(bodies, problems.PULL, soft, "")

    def solve(h):
        mujoco.mj_resetData(made, data)
        data.qvel[0], made.opt.timestep, places = problems.SPEED, h, []
        for until in problems.PLACES:
            mujoco.mj_step(made, data, round((until - data.time) / h))
            places.append(data.qpos[0])
        return np.array(places)

    yield Entry("MuJoCo, Euler", solve, steps(problems.PLACES[0], 25, 17), "soft contacts; fixed steps, looped in C")
