"""What all solve: the numbers, the equations by hand, and the answers by which they are measured, none of which comes from freebody.

The equations by hand are in scalars and write the rates of ``y`` to ``dy``: Numba compiles them as they stand, and the references are
these, integrated by extrapolation in long doubles. Bars are uniform, angles from the x axis, which is level.
"""

from functools import cache
from pathlib import Path
from runpy import run_path

import numpy as np
from numba.extending import register_jitable

G, END = 9.81, 10.0
ANDREWS = run_path(str(Path(__file__).parents[1] / "accuracy/accuracy.py"))["ANDREWS"]  # digits of quadruple precision at 0.03 s


def extrapolated(rates, y, times, p=()):
    """States at the times, by Gragg's midpoint rule, extrapolated to order 20 between them: Hairer, Nørsett & Wanner I, II.9."""
    y, states = np.array(y, np.longdouble), [np.array(y, float)]

    def f(y):
        dy = np.empty_like(y)
        rates(y, dy, p)
        return dy

    for span in np.diff(np.array(times, np.longdouble)):
        table = []
        for k in range(1, 11):
            h, before, now = span / (2 * k), y, y + span / (2 * k) * f(y)
            for _ in range(2 * k - 1):
                before, now = now, before + 2 * h * f(now)
            row = [now]
            for j, above in enumerate(table[-1] if table else (), 1):
                row.append(row[-1] + (row[-1] - above) / ((k / np.longdouble(k - j)) ** 2 - 1))
            table.append(row)
        y = table[-1][-1]
        states.append(np.array(y, float))
    return np.array(states)


# A chain of bars of 1 kg and 1 m, hung from the origin.


def chain_state(n):
    """Angles of each bar on the one before, and their rates."""
    return 0.1 * np.sin(np.arange(n)), 0.2 * np.cos(np.arange(n))


def chain(n):
    """Accelerations of these angles, then Fx and Fy of each hinge on its outer bar: Lagrange's equations, to 30 digits."""
    from mpmath import cos, lu_solve, matrix, mp, mpf, sin

    mp.dps = 30
    q, u = ([sum(map(mpf, each[: i + 1])) for i in range(n)] for each in chain_state(n))
    mass, force = matrix(n), matrix(n, 1)
    for i in range(n):
        force[i] = -(n - i - mpf(1) / 2) * mpf(G) * cos(q[i])
        for j in range(n):
            coupled = n - max(i, j) - (mpf(1) / 2 if i != j else mpf(2) / 3)
            mass[i, j] = coupled * cos(q[i] - q[j])
            force[i] -= coupled * sin(q[i] - q[j]) * u[j] ** 2
    a = list(lu_solve(mass, force))
    ends = [np.array([-a[i] * sin(q[i]) - u[i] ** 2 * cos(q[i]), a[i] * cos(q[i]) - u[i] ** 2 * sin(q[i])]) for i in range(n)]
    pulls = [sum(ends[:i], ends[i] / 2) + [0, mpf(G)] for i in range(n)]  # m (a − g) of each bar
    forces = np.cumsum(pulls[::-1], axis=0)[::-1]
    return np.array([*np.diff([mpf(0), *a]), *forces.ravel()], float)


# Two bars of 1 kg and 1 m, from rest.

PENDULUM = np.array([-0.57, -1.07, 0, 0])


def double_pendulum(y, dy, p):
    a, b, va, vb = y[0], y[1], y[2], y[3]
    s, c = np.sin(a - b) / 2, np.cos(a - b) / 2
    first, second = -s * vb * vb - 1.5 * G * np.cos(a), s * va * va - 0.5 * G * np.cos(b)
    det = 4 / 9 - c * c
    dy[0], dy[1] = va, vb
    dy[2], dy[3] = (first / 3 - c * second) / det, (second * 4 / 3 - c * first) / det


@cache
def double_pendulum_end():
    return extrapolated(double_pendulum, PENDULUM, np.linspace(0, END, 201))[-1, :2]


# A four-bar that falls from rest: crank 1 kg and 1 m, coupler 2 kg and 2.5 m, rocker 1.5 kg and 2 m about (2, 0).

FOUR_BAR = np.array([np.arctan2(0.8, 0.6), 0])


@register_jitable
def bars(a):
    """Crank, coupler and rocker as vectors."""
    ax, ay = np.cos(a), np.sin(a)
    dx, dy = 2 - ax, -ay
    square = dx * dx + dy * dy
    along = (square + 2.25) / (2 * square)
    across = np.sqrt(6.25 / square - along * along)
    bx, by = along * dx - across * dy, along * dy + across * dx
    return ax, ay, bx, by, ax + bx - 2, ay + by


def angles(a):
    """Of the three."""
    ax, ay, bx, by, cx, cy = (float(each) for each in bars(a))
    return np.array([np.arctan2(ay, ax), np.arctan2(by, bx), np.arctan2(cy, cx)])


def four_bar(y, dy, p):
    """Reduced to the crank's angle: k are rates over its rate, w accelerations where it has none."""
    va = y[1]
    ax, ay, bx, by, cx, cy = bars(y[0])
    det = bx * cy - by * cx
    kb, kc = (ay * cx - ax * cy) / det, (ay * bx - ax * by) / det
    vb, vc = kb * va, kc * va
    rx, ry = va * va * ax + vb * vb * bx - vc * vc * cx, va * va * ay + vb * vb * by - vc * vc * cy
    wb, wc = (rx * cx + ry * cy) / det, (rx * bx + ry * by) / det
    cosine, sine = ax * bx + ay * by, ax * by - ay * bx
    inertia = 7 / 3 + 2 * cosine * kb + 12.5 / 3 * kb * kb + 2 * kc * kc
    push = sine * vb * vb - 2.5 * G * ax - cosine * wb
    push += kb * (-sine * va * va - G * bx - 12.5 / 3 * wb) + kc * (-0.75 * G * cx - 2 * wc)
    dy[0], dy[1] = va, push / inertia


@cache
def four_bar_end():
    return angles(extrapolated(four_bar, FOUR_BAR, np.linspace(0, END, 401))[-1, 0])


# Slider-cranks, each with a rod of its own: crank 1 kg and 0.1 m, rod 2 kg, slider 1.5 kg on the x axis; a turn at 20 rad/s and what gravity
# and inertia make of it, seen 101 times.

RODS, TURNING = np.linspace(0.25, 0.45, 1000), np.array([0.0, 20.0])
SEEN = np.linspace(0, 2 * np.pi / 20, 101)


@register_jitable
def slider_crank_parts(a, va, p):
    """The crank's acceleration; then Fx and Fy of O on the crank, of B on the rod and of C on the slider, and the guide's force on it."""
    r, l, ma, mb, ms = 0.1, p[0], 1.0, 2.0, 1.5
    ax, ay = r * np.cos(a), r * np.sin(a)
    bx, by = np.sqrt(l * l - ay * ay), -ay
    kb = -ax / bx
    vb, kx = kb * va, -ay - kb * by
    wb = (va * va * ay + vb * vb * by) / bx
    wx = -va * va * ax - vb * vb * bx - wb * by
    half, turn, inertia = mb / 2 * (ax * bx + ay * by), mb / 2 * (ax * by - ay * bx), mb * l * l / 3
    whole = (ma / 3 + mb) * r * r + 2 * half * kb + inertia * kb * kb + ms * kx * kx
    push = turn * vb * vb - (ma / 2 + mb) * G * ax - half * wb
    push += kb * (-turn * va * va - mb / 2 * G * bx - inertia * wb) - kx * ms * wx
    alpha = push / whole
    beta = kb * alpha + wb
    ex, ey = -alpha * ay - va * va * ax, alpha * ax - va * va * ay  # of the crank's end
    mx, my = ex - (beta * by + vb * vb * bx) / 2, ey + (beta * bx - vb * vb * by) / 2  # of the rod's middle
    cx = ms * (kx * alpha + wx)
    cy = (by * cx - mb / 2 * (bx * (my + G) - by * mx) - mb * l * l / 12 * beta) / bx
    px, py = cx + mb * mx, cy + mb * (my + G)
    return alpha, px + ma / 2 * ex, py + ma * (ey / 2 + G), px, py, cx, cy, ms * G - cy


def slider_crank(y, dy, p):
    dy[0], dy[1] = y[1], slider_crank_parts(y[0], y[1], p)[0]


@cache
def slider_cranks_seen():
    """Of the first and the last: the forces at every time."""
    runs = [(extrapolated(slider_crank, TURNING, SEEN, (rod,)), rod) for rod in RODS[[0, -1]]]
    return np.array([[slider_crank_parts(*y, (rod,))[1:] for y in run] for run, rod in runs])


def fan():
    """Angles of the pendulums of benchmarks/batch.py."""
    return np.random.default_rng(1).uniform(-2, 2, (10_000, 2))


# A block of 0.4 by 0.2 m that is pushed up a slope, comes to rest on it by Coulomb's friction, and stays there.

SPEED, FRICTION, SLOPE = 3.0, 0.4, 0.2
PULL = (-G * np.sin(SLOPE), -G * np.cos(SLOPE))  # of gravity, along the slope and across
PLACES = (0.25, 5.0)


def block():
    """How far it is up the slope while it slides, and long after."""
    slows = FRICTION * -PULL[1] - PULL[0]
    return np.array([SPEED * PLACES[0] - slows * PLACES[0] ** 2 / 2, SPEED**2 / (2 * slows)])


def pendulums():
    """Angles of the first five from hanging straight down, after a second: equations by hand, by extrapolation."""
    starts = [[a - np.pi / 2, b - np.pi / 2, 0, 0] for a, b in fan()[:5]]
    return np.array([extrapolated(double_pendulum, start, np.linspace(0, 1, 21))[-1, :2] for start in starts]) + np.pi / 2
