"""Lagrange's equations with multipliers, derived and spelled as Python by SymPy: run as it is, and compiled by Numba."""

import math

import numba_peer
import numpy as np
import problems
import sympy as sp
from entry import TOLERANCES, Entry
from numba import njit, prange
from numba.extending import register_jitable


def derived(q, bodies, loops=(), force=(), gravity=problems.G, p=()):
    """``solved(y, p)``: accelerations, and multipliers of the loops. Bodies are mass, inertia, angle and mass centre."""
    u = sp.symbols(f"u:{len(q)}")

    def rate(x):
        return sum(sp.diff(x, a) * b for a, b in zip(q, u, strict=True))

    energy = sum(m * (rate(x) ** 2 + rate(y) ** 2) / 2 + inertia * rate(angle) ** 2 / 2 for m, inertia, angle, x, y in bodies)
    fall = gravity * sum(m * y for m, _, _, _, y in bodies)
    matrix = sp.hessian(energy, u).applyfunc(sp.trigsimp)
    right = sp.Matrix([sp.diff(energy - fall, a) - rate(sp.diff(energy, b)) for a, b in zip(q, u, strict=True)])
    right = right.applyfunc(sp.trigsimp) + sp.Matrix(force or [0] * len(q))
    if loops:
        g = sp.Matrix(loops).jacobian(q)
        matrix = sp.Matrix(sp.BlockMatrix([[matrix, g.T], [g, sp.zeros(len(loops))]]))
        right = sp.Matrix([*right, *(-rate(rate(each)) for each in loops)])
    return written(q, u, p, matrix, right)


def written(q, u, p, matrix, right):
    """Code of a solution: two unknowns by Cramer's rule, more by LAPACK."""
    size, spell = len(right), sp.pycode
    few = size == 2
    shared, exprs = sp.cse([*(matrix.adjugate() * right / matrix.det() if few else [*matrix, *right])])
    lines = [f"{name} = y[{i}]" for i, name in enumerate([*q, *u])] + [f"{name} = p[{i}]" for i, name in enumerate(p)]
    lines += [f"{name} = {spell(value)}" for name, value in shared]
    if few:
        lines.append(f"return {spell(exprs[0])}, {spell(exprs[1])}")
    else:
        places = [f"a[{i}, {j}]" for i in range(size) for j in range(size)] + [f"b[{i}]" for i in range(size)]
        lines.append(f"a, b = np.zeros(({size}, {size})), np.zeros({size})")
        lines += [f"{place} = {spell(value)}" for place, value in zip(places, exprs, strict=True) if value != 0]
        lines.append("return np.linalg.solve(a, b)")
    exec("def solved(y, p):\n    " + "\n    ".join(lines), made := {"math": math, "np": np})
    return register_jitable(made["solved"])


def rates(solved, n):
    def run(y, dy, p):
        found = solved(y, p)
        for i in range(n):
            dy[i], dy[n + i] = y[n + i], found[i]

    return run


def motion(solved, start, end, read, says):
    """Run by Python, and compiled."""
    plain = rates(solved, len(start) // 2)
    yield from numba_peer.motion(plain, start, end, read, "SymPy", f"{says}, run by Python")
    yield from numba_peer.motion(numba_peer.compiled(plain), start, end, read, "SymPy + Numba", f"{says}, compiled")


def turned(angle, x, y):
    return sp.Matrix([sp.cos(angle) * x - sp.sin(angle) * y, sp.sin(angle) * x + sp.cos(angle) * y])


def bar(mass, length, angle, start=(0, 0)):
    """A bar, and its end."""
    middle, end = (sp.Matrix(start) + turned(angle, part * length, 0) for part in (sp.Rational(1, 2), 1))
    return (mass, mass * length**2 / sp.Integer(12), angle, *middle), end


def double_pendulum():
    a, b = q = sp.symbols("a b")
    first, end = bar(1, 1, a)
    second, _ = bar(1, 1, b, end)
    yield from motion(derived(q, [first, second]), problems.PENDULUM, problems.END, lambda y: y[:2], "Lagrange, 2 × 2")


def four_bar():
    a, b, c = q = sp.symbols("a b c")
    crank, pin = bar(1, 1, a)
    coupler, end = bar(2, sp.Rational(5, 2), b, pin)
    rocker, other = bar(sp.Rational(3, 2), 2, c, (2, 0))
    solved = derived(q, [crank, coupler, rocker], [*(end - other)])
    start = np.append(problems.angles(problems.FOUR_BAR[0]), np.zeros(3))
    yield from motion(solved, start, problems.END, lambda y: y[:3], "three angles and two multipliers")


def andrews():
    """The seven angles of the IVP test set; lengths, masses and inertias in its order."""
    b, t, g, f, d, w, e = q = sp.symbols("b t g f d w e")
    at = {"A": (-0.06934, -0.00227), "B": (-0.03635, 0.03273), "C": (0.014, 0.072)}
    a, pivot = sp.Matrix(at["A"]), sp.Matrix(at["B"])
    crank, p, h = turned(b, 0.007, 0), a + turned(d, 0.04, 0), a + turned(e, 0, -0.04)
    centres = [turned(b, 0.00092, 0), crank + turned(b + t, -0.0115, 0), pivot + turned(g, 0.01043, -0.01874)]
    centres += [p + turned(f + d, 0, -0.00579), a + turned(d, 0.02308, 0.00916), h + turned(w + e, 0.00579, 0)]
    centres += [a + turned(e, -0.00449, -0.01228)]
    masses = 0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498
    inertias = 2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
    turns = b, b + t, g, f + d, d, w + e, e
    pin = crank + turned(b + t, -0.028, 0)
    loops = [*(pin - pivot - turned(g, 0, -0.035)), *(pin - p - turned(f + d, 0, -0.02)), *(pin - h - turned(w + e, 0.02, 0))]
    stretched = sp.sqrt(sum(x**2 for x in pivot + turned(g, 0.02, -0.018) - sp.Matrix(at["C"])))
    force = [-sp.diff(4530 * (stretched - 0.07785) ** 2 / 2, each) for each in q]
    force[0] += 0.033
    bodies = [(m, i, turn, *c) for m, i, turn, c in zip(masses, inertias, turns, centres, strict=True)]
    start = [-0.0617138900142764496, 0, 0.4552798191630703803, 0.2226683901658858847]
    start += [0.4873649795438425502, -0.2226683901658858847, 1.2305474445498211925, *[0] * 7]
    solved = derived(q, bodies, loops, force, gravity=0)
    yield from motion(solved, np.array(start, float), 0.03, lambda y: y[:7], "seven angles and six multipliers")


def slider_cranks():
    """Three coordinates of each body, so that the eight multipliers are the reactions."""
    x1, y1, a, x2, y2, b, x3, y3, c, length = sp.symbols("x1 y1 a x2 y2 b x3 y3 c l")
    bodies = [(1, 0.01 / 12, a, x1, y1), (2, length**2 / 6, b, x2, y2), (1.5, 0.01, c, x3, y3)]
    half, arm, slider = turned(a, 0.05, 0), turned(b, length / 2, 0), sp.Matrix([x3, y3])
    crank, rod = sp.Matrix([x1, y1]), sp.Matrix([x2, y2])
    loops = [*(half - crank), *(crank + half - rod + arm), *(rod + arm - slider), -y3, c]
    q = x1, y1, a, x2, y2, b, x3, y3, c
    solved = derived(q, bodies, loops, p=(length,))
    run = numba_peer.compiled(rates(solved, 9))

    @njit(parallel=True, error_model="numpy")
    def turns(rods, rtol):
        forces = np.empty((len(rods), len(problems.SEEN), 7))
        for i in prange(len(rods)):
            rod = rods[i : i + 1]
            start = np.array([0.05, 0, 0, 0.1 + rod[0] / 2, 0, 0, 0.1 + rod[0], 0, 0, 0, 1, 20, 0, 1, -2 / rod[0], 0, 0, 0])
            states = dop853(run, start, problems.SEEN, rtol, rod)
            for j in range(len(states)):
                forces[i, j] = solved(states[j], rod)[9:16]
        return forces

    dop853 = numba_peer.dop853
    says = "nine coordinates, eight multipliers, which are the reactions; DOP853 compiled, on all cores"
    yield Entry("SymPy + Numba", lambda rtol: turns(problems.RODS, rtol), TOLERANCES, says, lambda found: found[[0, -1]])
