"""Open chains up to 100 links.

With absolute angles the centre of link i is at Σ_{j<i} l e_j + l/2 e_i, and Lagrange's equations of the chain are

    Σ_j M_ij [cos(φi − φj) φ̈j + sin(φi − φj) φ̇j²] = −m g l (N − i + 1/2) cos φi,
    M_ij = m l² (N − max(i, j) + 1/2) for i ≠ j,    M_ii = m l² (N − i + 1/3).

At release all angles are 0, and each hinge carries what the links beyond it need. The row of N = 100 is solved in
40 digits.
"""

from fractions import Fraction
from math import inf, log10, sqrt
from time import perf_counter

import mpmath as mp
import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import many_digits, motion
from freebody.solve.figures import Known

G = 9.81
SCIPY = "other route: Lagrange's equations, integrated by SciPy"


def masses(n, l=1.0):
    i = np.arange(1, n + 1)
    matrix = l * l * (n - np.maximum.outer(i, i) + 0.5)
    np.fill_diagonal(matrix, l * l * (n - i + 1 / 3))
    return matrix, G * l * (n - i + 0.5)


def rates(n, l=1.0):
    matrix, weights = masses(n, l)

    def right(t, y):
        q, u = y[:n], y[n:]
        apart = np.subtract.outer(q, q)
        pull = -(matrix * np.sin(apart)) @ u**2 - weights * np.cos(q)
        return np.concatenate([u, np.linalg.solve(matrix * np.cos(apart), pull)])

    return right


def released(n):
    """Angular accelerations, vertical forces at the hinges, acceleration of the tip; m = l = 1."""
    with mp.workdps(40):
        g = mp.mpf("9.81")
        matrix = mp.matrix(n, n)
        for i in range(n):
            for j in range(n):
                matrix[i, j] = n - max(i, j) - mp.mpf(1) / 2 if i != j else n - i - mp.mpf(2) / 3
        turn = list(mp.lu_solve(matrix, mp.matrix([-g * (n - i - mp.mpf(1) / 2) for i in range(n)])))
        centres = [sum(turn[:i]) + turn[i] / 2 for i in range(n)]
        forces = [sum(a + g for a in centres[i:]) for i in range(n)]
        return [float(a) for a in turn], [float(f) for f in forces], float(sum(turn))


@ask("What are the angular accelerations and vertical forces of three links at release, symbolically?")
def symbolically(case):
    """M φ̈ = b in parts of mℓ² and mgℓ, exactly; hinge i carries what the links from i on weigh, less m times their fall."""
    places = range(3)
    matrix = [[3 - max(i, j) - (Fraction(2, 3) if i == j else Fraction(1, 2)) for j in places] for i in places]
    turned = solved(matrix, [-(Fraction(5, 2) - i) for i in places])
    falls = [sum(turned[:i], turned[i] / 2) for i in places]
    closed = {f"phi[{i + 1}]": f"{turned[i]}*g/l" for i in places}
    closed |= {f"pin[{i + 1}].Fy": f"{3 - i + sum(falls[i:])}*m*g" for i in places}
    straight = {f"phi[{i + 1}]": 0 for i in places}
    yield from case.symbolically(closed, "other route: exact elimination", at_rest=True, set=straight)


def determinant(rows):
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def solved(matrix, right):
    """x of A x = b for three unknowns, by Cramer's rule."""
    swapped = [
        [[b if k == col else x for k, x in enumerate(row)] for row, b in zip(matrix, right, strict=True)] for col in range(3)
    ]
    return [determinant(rows) / determinant(matrix) for rows in swapped]


@ask("What are they, and the acceleration of the tip, for N = 1, and for 2, 3, 10, 100?")
def release(case):
    for n in (1, 2, 3, 10, 100):
        now, links = case.instant(parameters={"N": n}), range(1, n + 1)
        turn, forces, tip = released(n)
        against = "closed form: Lagrange's equations at rest, in 40 digits"
        of, bends = f"N = {n}" if n > 1 else "", [now[f"accel(phi[{i}])"] for i in links]
        yield Answer("φ̈ of each link", bends, "rad/s²", turn, against, 1e-11, variant=of)
        found = [now[f"pin[{i}].Fy"] for i in links]
        yield Answer("vertical force at each hinge", found, "N", forces, against, 1e-11, variant=of)
        yield Answer("acceleration of the tip", now[f"ay(link[{n}].end)"], "m/s²", tip, against, 1e-11, variant=of)


@ask("How do they fall for 2 s (N = 3) and 1 s (N = 10), with links of 1 m and in all 1 m long?")
def fall(case):
    for n, until in ((3, 2.0), (10, 1.0)):
        for l in (1.0, 1 / n):
            run, times = case.run(parameters={"N": n, "l": l}, until=until), np.array([until / 2, until])
            check = motion(rates(n, l), np.zeros(2 * n), times)
            values = [run.evaluate(f"phi[{i}]", until) for i in range(1, n + 1)]
            of = f"N = {n}, l = {l:.3g} m" if n > 3 or l < 1 else ""
            yield Answer(f"angles after {until:g} s", values, "rad", check[-1, :n], SCIPY, 1e-9, variant=of)
            tip = l * np.sin(check[:, :n]).sum(axis=1)
            value, label = run.evaluate(f"y(link[{n}].end)", times), f"height of the tip after {until / 2:g} and {until:g} s"
            yield Answer(label, value, "m", tip, SCIPY, 1e-9, variant=of)


@ask("How far does the energy drift for N = 100 in 10 s?")
def hundred(case):
    run, times = case.run(parameters={"N": 100}, until=10, rtol=1e-9), np.array([2.0, 4.0, 6.0, 8.0, 10.0])
    size = run.evaluate("kinetic()", times).max()
    value, says = run.evaluate("energy()", times), "At 2 … 10 s the energy is {}, as at the start."
    against = "conservation: all at the height of the pivot at the start"
    yield Answer("energy", value, "J", 0 * times, against, 1e-9, scale=size, says=says)


@ask("How does the cost of a step grow with N, to N = 1000?")
def cost(case):
    """The shortest of some runs of a few steps."""
    costs = {}
    for n in (10, 100, 1000):
        mechanism = case.mechanism(N=n)
        core, (state, _) = mechanism.compile(), mechanism.start()
        for _ in range(5):
            begin = perf_counter()
            steps = core.simulate(state, until=0.3 / sqrt(n), rtol=1e-6).stats["accepted"]
            costs[n] = min(costs.get(n, inf), (perf_counter() - begin) / steps)
    told = ", ".join(f"{1e6 * cost:.0f} µs with {n} links" for n, cost in costs.items())
    power, says = log10(costs[1000] / costs[100]), f"A step takes {told}: it grows as N to the power of {{}}, not as N²."
    yield Answer("power", Known(power, 0.05, power), "", 1.0, "count: one pass to the ground and one back", 0.6, says=says)


def two_bars():
    """φ̈ of unequal bars from the downward vertical, for mpmath's numbers."""
    g, m2, l2 = mp.mpf("9.81"), mp.mpf(1) / 2, mp.mpf(3) / 5  # and m1 = l1 = 1
    one, two, mixed = mp.mpf(1) / 3 + m2, m2 * l2**2 / 3, m2 * l2 / 2
    upper, lower = (mp.mpf(1) / 2 + m2) * g, m2 * g * l2 / 2

    def rates(t, y):
        a, b, u, v = y
        (ca, sa), (cb, sb) = mp.cos_sin(a), mp.cos_sin(b)
        c, s = mixed * (ca * cb + sa * sb), mixed * (sa * cb - ca * sb)
        f, h, size = -s * v * v - upper * sa, s * u * u - lower * sb, one * two - c * c
        return [u, v, (two * f - c * h) / size, (one * h - c * f) / size]

    return rates


@ask("How do two unequal bars move for 10 s, and how long can the digits be believed?")
def unequal(case):
    """The error of a run, estimated from a tighter one, against that found with 20 digits."""
    times = np.arange(1.0, 10.5)
    with mp.workdps(25):
        exact = np.array(many_digits(two_bars(), [2, "2.5", "0.5", -1], times, digits=20, step=0.025, order=16), float)[:, :2]

    def angles(rtol):
        run = case.run("two_bars.yaml", rtol=rtol)
        return np.column_stack([run.evaluate(name, times) for name in ("phi1", "phi2")])

    usual, tight = angles(1e-10), angles(1e-13)
    digits = "other route: Lagrange's equations in 20 digits"
    for i in (0, 1):
        yield Answer(f"φ{i + 1} at 1 … 10 s", tight[:, i], "rad", exact[:, i], digits, 1e-6)
    own, true = (-np.log10(np.abs(usual - other).max(axis=1) + 1e-17) for other in (tight, exact))
    yield Answer("decimals that hold at 1 … 10 s at rtol 1e-10, by a tighter run", own, "", true, digits, 0.05)
    run = case.run("two_bars.yaml", rtol=1e-10)
    error, size = (np.maximum.accumulate(np.abs(each), axis=0) for each in (usual - exact, exact))
    claimed = np.column_stack([run.digits(name, times) for name in ("phi1", "phi2")])
    holds = bool((claimed <= -np.log10(error / size) + 0.25).all())
    says = f"At rtol 1e-10 the motion {run.accuracy.sentence}."
    yield Answer("digits that are claimed are there", holds, check=True, against=digits, tolerance=0.0, says=says)
