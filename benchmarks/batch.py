"""Many motions at once: 10 000 double pendulums for a second by RK4 with steps of 1 ms, beside the same written by hand for Numba.

Needs Numba (`pip install numba`). Both run on as many threads as there are cores, take turns, and must agree at the end.
"""

import os
from math import pi
from statistics import median
from time import perf_counter

import numba
import numpy as np
from numba import njit, prange
from rich.console import Console
from rich.table import Table

import freebody as fb

MEMBERS, STEPS, STEP, G = 10_000, 1000, 1e-3, 9.81
ROUNDS = 7
THREADS = len(os.sched_getaffinity(0))


@njit(inline="always", error_model="numpy")
def accelerations(a: float, b: float, va: float, vb: float) -> tuple[float, float]:
    """Of two uniform bars, 1 m and 1 kg each, at angles from hanging straight down: Lagrange's equations, solved by Cramer's rule."""
    sine, cosine = np.sin(a - b), np.cos(a - b)
    mixed = 0.5 * cosine
    first = -0.5 * sine * vb * vb - 1.5 * G * np.sin(a)
    second = 0.5 * sine * va * va - 0.5 * G * np.sin(b)
    scale = 1.0 / (4.0 / 9.0 - mixed * mixed)
    return (first / 3.0 - mixed * second) * scale, (second * 4.0 / 3.0 - mixed * first) * scale


@njit(parallel=True, error_model="numpy")
def by_hand(angles: np.ndarray) -> np.ndarray:
    """Angles and rates at the end, from rest."""
    end = np.empty((len(angles), 4))
    h, half, sixth = STEP, STEP / 2, STEP / 6
    for i in prange(len(angles)):
        a, b, va, vb = angles[i, 0], angles[i, 1], 0.0, 0.0
        for _ in range(STEPS):
            a1, b1 = accelerations(a, b, va, vb)
            va2, vb2 = va + half * a1, vb + half * b1
            a2, b2 = accelerations(a + half * va, b + half * vb, va2, vb2)
            va3, vb3 = va + half * a2, vb + half * b2
            a3, b3 = accelerations(a + half * va2, b + half * vb2, va3, vb3)
            va4, vb4 = va + h * a3, vb + h * b3
            a4, b4 = accelerations(a + h * va3, b + h * vb3, va4, vb4)
            a += sixth * (va + 2 * va2 + 2 * va3 + va4)
            b += sixth * (vb + 2 * vb2 + 2 * vb3 + vb4)
            va += sixth * (a1 + 2 * a2 + 2 * a3 + a4)
            vb += sixth * (b1 + 2 * b2 + 2 * b3 + b4)
        end[i] = a, b, va, vb
    return end


def mechanism() -> fb.Mechanism:
    """The same two bars, their angles from the horizontal."""
    m = fb.Mechanism("double pendulum", gravity=G)
    upper, lower = m.rod("upper", length=1, mass=1), m.rod("lower", length=1, mass=1)
    m.hinge(m.ground.O, upper.start, coordinate={"name": "a", "absolute": True})
    m.hinge(upper.end, lower.start, coordinate={"name": "b", "absolute": True})
    m.initial(a=0, b=0)
    return m


def main() -> None:
    numba.set_num_threads(THREADS)
    m = mechanism()
    angles = np.random.default_rng(1).uniform(-2, 2, (MEMBERS, 2))
    span = {"until": STEPS * STEP, "method": "rk4", "step": STEP, "t_eval": [STEPS * STEP]}

    def ours() -> np.ndarray:
        made = m.batch(angles - pi / 2, threads=THREADS, **span)
        return np.hstack([made.q.values[:, -1] + pi / 2, made.u.values[:, -1]])

    def timed(call) -> float:
        began = perf_counter()
        call()
        return perf_counter() - began

    apart = abs(ours() - by_hand(angles)).max()
    turns = np.array([(timed(lambda: by_hand(angles)), timed(ours)) for _ in range(ROUNDS)])
    ratios = turns[:, 0] / turns[:, 1]
    table = Table("", "time, s", "evaluation, ns", title=f"{MEMBERS} double pendulums, {STEPS} steps of RK4, {THREADS} threads")
    for name, seconds in zip(("Numba, by hand", "freebody"), turns.T, strict=True):
        table.add_row(name, f"{median(seconds):.2f}", f"{median(seconds) / (4 * STEPS * MEMBERS) * THREADS * 1e9:.1f}")
    Console().print(table)
    print(f"freebody's rate over Numba's: {median(ratios):.2f} ({ratios.min():.2f} to {ratios.max():.2f}); apart by {apart:.0e}")


if __name__ == "__main__":
    main()
