"""Equations by hand, compiled by Numba: integrated by SciPy's DOP853, and by the same method compiled too."""

import batch
import numpy as np
import problems
from entry import TOLERANCES, Entry
from numba import njit, prange
from problems import G
from scipy.integrate import DOP853, solve_ivp
from scipy.integrate._ivp import dop853_coefficients as table

A, D, E3, E5, LAST = table.A, table.D, table.E3, table.E5, table.N_STAGES
compiled = njit(error_model="numpy")
pendulum_rates, four_bar_rates, slider_crank_rates = map(
    compiled, (problems.double_pendulum, problems.four_bar, problems.slider_crank)
)


@compiled
def stage(rates, y, h, k, s, at, p):
    """The rates ``k[s]``, at a state that the stages before give."""
    for i in range(len(y)):
        total = 0.0
        for j in range(s):
            total += A[s, j] * k[j, i]
        at[i] = y[i] + h * total
    rates(at, k[s], p)


@compiled
def dop853(rates, start, times, rtol, p):
    """States at the times, from the first on: Dormand and Prince's method of order 8, with SciPy's control of errors and dense output."""
    n, now, end = len(start), times[0], times[-1]
    y, new, k, between = start.copy(), np.empty(n), np.empty((16, n)), np.empty(7)
    seen, shown, h = np.empty((len(times), n)), 1, (end - now) / 1000
    seen[0] = y
    rates(y, k[0], p)
    while now < end:
        h = min(h, end - now)
        for s in range(1, LAST + 1):
            stage(rates, y, h, k, s, new, p)
        five = three = 0.0
        for i in range(n):
            a = b = 0.0
            for s in range(LAST + 1):
                a += E5[s] * k[s, i]
                b += E3[s] * k[s, i]
            scale = rtol * (1e-2 + max(abs(y[i]), abs(new[i])))
            five, three = five + (a / scale) ** 2, three + (b / scale) ** 2
        error = h * five / np.sqrt((five + 0.01 * three) * n) if five > 0 else 0.0
        if error < 1:
            if shown < len(times) - 1 and times[shown] <= now + h:
                for s in range(LAST + 1, 16):
                    stage(rates, y, h, k, s, seen[-1], p)
                for i in range(n):
                    between[0] = new[i] - y[i]
                    between[1] = h * k[0, i] - between[0]
                    between[2] = between[0] - between[1] - h * k[LAST, i]
                    for j in range(4):
                        total = 0.0
                        for s in range(16):
                            total += D[j, s] * k[s, i]
                        between[3 + j] = h * total
                    j = shown
                    while j < len(times) and times[j] <= now + h:
                        x, total = (times[j] - now) / h, 0.0
                        for m in range(6, -1, -1):
                            total = (total + between[m]) * (x if m % 2 == 0 else 1 - x)
                        seen[j, i] = y[i] + total
                        j += 1
                shown = j
            y[:], k[0], now = new, k[LAST], now + h
        h *= min(10.0, max(0.2, 0.9 * error**-0.125)) if error > 0 else 10.0
    seen[-1] = y
    return seen


def motion(rates, start, end, read, name, says):
    """The end of a motion by both integrators."""

    def derivative(t, y):
        dy = np.empty(len(y))
        rates(y, dy, ())
        return dy

    def by_scipy(rtol):
        return solve_ivp(derivative, (0, end), start, DOP853, rtol=max(rtol, 3e-14), atol=rtol / 100).y[:, -1]

    yield Entry(f"{name} + SciPy, DOP853", by_scipy, TOLERANCES, says, read)
    if hasattr(rates, "py_func"):
        ends = np.array([0.0, end])
        yield Entry(f"{name}, DOP853 compiled too", lambda rtol: dop853(rates, start, ends, rtol, ())[-1], TOLERANCES, says, read)


def double_pendulum():
    says = "equations by hand, 2 × 2"
    yield from motion(pendulum_rates, problems.PENDULUM, problems.END, lambda y: y[:2], "Numba", says)


def four_bar():
    says = "equations by hand, reduced to the crank's angle"
    yield from motion(four_bar_rates, problems.FOUR_BAR, problems.END, lambda y: problems.angles(y[0]), "Numba", says)


@njit(parallel=True, error_model="numpy")
def turns(rods, rtol):
    forces = np.empty((len(rods), len(problems.SEEN), 7))
    for i in prange(len(rods)):
        rod = (rods[i],)
        states = dop853(slider_crank_rates, problems.TURNING, problems.SEEN, rtol, rod)
        for j in range(len(states)):
            found = problems.slider_crank_parts(states[j, 0], states[j, 1], rod)
            for k in range(7):
                forces[i, j, k] = found[1 + k]
    return forces


def slider_cranks():
    says = "by hand, reduced to the crank's angle, forces too; DOP853 compiled, on all cores"
    yield Entry("Numba", lambda rtol: turns(problems.RODS, rtol), TOLERANCES, says, lambda found: found[[0, -1]])


def pendulums():
    fan = problems.fan()
    says = "equations and RK4 by hand (benchmarks/batch.py), on all cores"
    yield Entry("Numba", lambda _: batch.by_hand(fan), says=says, read=lambda end: end[:, :2])


@compiled
def chain_sweep(q, u, out):
    """The force on a bar at its inner end is linear in the acceleration of that end: swept from the tip, then back."""
    n = len(q)
    angle, rate, held = np.cumsum(q), np.cumsum(u), np.empty((n, 11))
    xx = xy = yy = fx = fy = 0.0
    for i in range(n - 1, -1, -1):
        c, s, w = np.cos(angle[i]), np.sin(angle[i]), rate[i] * rate[i]
        # At the outer end: force (fx, fy) + [xx xy; xy yy] a, with a = (ax, ay) + α (−s, c) − w (c, s).
        kx, ky = -s * xx + c * xy, -s * xy + c * yy
        bx, by = fx - w * (c * xx + s * xy), fy - w * (c * xy + s * yy)
        inertia = 1 / 3 - s * kx + c * ky
        free, px, py = (-c * G / 2 + s * bx - c * by) / inertia, (s / 2 - kx) / inertia, (-c / 2 - ky) / inertia
        fx, fy = bx + kx * free - s / 2 * free - w * c / 2, by + ky * free + c / 2 * free - w * s / 2 + G
        hx, hy = kx - s / 2, ky + c / 2
        xx, xy, yy = xx + 1 + hx * px, xy + hx * py, yy + 1 + hy * py
        held[i, 0], held[i, 1], held[i, 2], held[i, 3], held[i, 4], held[i, 5] = c, s, w, free, px, py
        held[i, 6], held[i, 7], held[i, 8], held[i, 9], held[i, 10] = fx, fy, xx, xy, yy
    ax = ay = turned = 0.0
    for i in range(n):
        alpha = held[i, 3] + held[i, 4] * ax + held[i, 5] * ay
        out[i], turned = alpha - turned, alpha
        out[n + 2 * i] = held[i, 6] + held[i, 8] * ax + held[i, 9] * ay
        out[n + 2 * i + 1] = held[i, 7] + held[i, 9] * ax + held[i, 10] * ay
        ax, ay = ax - held[i, 1] * alpha - held[i, 0] * held[i, 2], ay + held[i, 0] * alpha - held[i, 1] * held[i, 2]


def chain(n):
    q, u = problems.chain_state(n)

    def solve(_):
        out = np.empty(3 * n)
        chain_sweep(q, u, out)
        return out

    yield Entry("Numba", solve, says="accelerations, all reactions: a sweep by hand")
