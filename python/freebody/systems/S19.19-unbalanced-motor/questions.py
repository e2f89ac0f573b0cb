"""Unbalanced motor on a spring.

The load is at (x + ε cos θ, ε sin θ). Moments of arm and load about the shaft, and motor with arm and load along x:

    m ε² θ̈ − m ε ẍ sin θ = T − m g ε cos θ,        (M + m) ẍ − m ε (θ̈ sin θ + θ̇² cos θ) = −k x.

The arm pushes the load with T/ε across itself (it has no mass) and with what the load's acceleration asks along
itself. On a motor bolted down the spin is T t/(m ε²); in a resonance it would stay near √(k/(M + m)).
"""

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.run.digits import expression
from freebody.solve.figures import Known, figure

M, LOAD, K, TORQUE = 1.0, 1.0, 1.0, 0.015
NATURAL = np.sqrt(K / (M + LOAD))
SCIPY = "other route: two balances, integrated by SciPy"


def accelerations(theta, spin, x, eps=1.0, gravity=0.0):
    """θ̈, ẍ."""
    c, s = np.cos(theta), np.sin(theta)
    matrix = [[LOAD * eps**2, -LOAD * eps * s], [-LOAD * eps * s, M + LOAD]]
    return np.linalg.solve(matrix, [TORQUE - LOAD * gravity * eps * c, LOAD * eps * spin**2 * c - K * x])


def rates(eps=1.0, gravity=0.0):
    """For (θ, x, θ̇, ẋ), the 2×2 solve written out."""

    def right(t, y):
        c, s = np.cos(y[0]), np.sin(y[0])
        turn = (TORQUE - LOAD * gravity * eps * c) / (LOAD * eps)
        push = LOAD * eps * y[2] ** 2 * c - K * y[1]
        slide = (push + LOAD * s * turn) / (M + LOAD * c * c)
        return y[2], y[3], (turn + slide * s) / eps, slide

    return right


@ask("1. What are the equations of motion?")
def symbolically(case):
    below = "(m*eps^2*(M + m*cos(theta)^2))"
    along = "(m*eps*rate(theta)^2*cos(theta) - k*x)"
    turning = "(T - m*g*eps*cos(theta))"
    closed = {
        "x": f"(m*eps^2*{along} + m*eps*sin(theta)*{turning})/{below}",
        "theta": f"((M + m)*{turning} + m*eps*sin(theta)*{along})/{below}",
    }
    yield from case.symbolically(closed, "closed form: two balances, solved by Cramer's rule")


@ask("What are the accelerations and the force of the arm at θ = 1, θ̇ = 0.7, x = 0.4, ẋ = −0.3?")
def instant(case):
    now = case.instant(theta=1, x=0.4, rates={"theta": 0.7, "x": -0.3})
    turn, slide = accelerations(1, 0.7, 0.4)
    yield Answer("θ̈", now["accel(theta)"], "rad/s²", turn, "closed form: two balances", 1e-12)
    yield Answer("ẍ", now["accel(x)"], "m/s²", slide, "closed form: two balances", 1e-12)
    force = [now["tip.Fx*cos(theta) + tip.Fy*sin(theta)"], now["tip.Fy*cos(theta) - tip.Fx*sin(theta)"]]
    check = [LOAD * (slide * np.cos(1) - 0.7**2), TORQUE]
    yield Answer("arm on load, along and across the arm", force, "N", check, "closed form: momentum of the load; T/ε", 1e-12)


@ask("2. How do x and θ move for 100 s, and what work does T?")
def hundred_seconds(case):
    run, times = case.run(), np.linspace(10, 100, 10)
    check = motion(rates(), [0, 0, 0, 0], times)
    yield Answer("x at 10 … 100 s", run.evaluate("x", times), "m", check[:, 1], SCIPY, 1e-8)
    yield Answer("θ at 10 … 100 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-9)
    put_in = TORQUE * check[:, 0]
    yield Answer("energy gained", run.evaluate("energy()", times), "J", put_in, "conservation: T θ", 1e-8)
    yield Answer("work of the torque", run.evaluate("drive.work", times), "J", put_in, "closed form: T θ", 1e-8)


@ask("Is the spin captured by the resonance, up to 400 s?")
def capture(case):
    """Captured, the mean spin of a window stays near √(k/(M + m)); free, it would grow as T t/(m ε²).

    The capture ends near 250 s, and from there errors grow by a factor e in some 6 s: SciPy's own figures at two
    tolerances part before 350 s. What is sure in any window is the energy that the torque has put in, T times the
    angle turned.
    """
    run, edges = case.run(until=400, rtol=1e-13), np.arange(0.0, 401, 50)
    times = np.arange(0.25, 250.1, 0.25)
    check = motion(rates(), [0, 0, 0, 0], times)
    true = np.diff(np.append(0.0, check[199::200, 0])) / 50
    mean = np.diff(run.evaluate("theta", edges)) / 50
    says = "Yes, until near 250 s: over 0–50, … 200–250 s the mean θ̇ is {}."
    yield Answer("mean θ̇ over 0–50, … 200–250 s", mean[:5], "rad/s", true, SCIPY, 1e-7, says=says)
    says = "Of √(k/(M + m)) that is {}."
    yield Answer("the same over √(k/(M+m))", mean[:5] / NATURAL, "", true / NATURAL, SCIPY, 1e-7, says=says)
    bolted = TORQUE / LOAD * (edges[:5] + 25)
    says = "Of the spin of a motor bolted down it is {}."
    yield Answer("the same over the spin of a bolted motor", mean[:5] / bolted, "", true / bolted, SCIPY, 1e-7, says=says)
    places = run.evaluate("x", times)
    value, other = ([np.abs(x[i : i + 200]).max() for i in range(0, 1000, 200)] for x in (places, check[:, 1]))
    yield Answer("greatest |x| at quarters of a second over 0–50, … 200–250 s", value, "m", other, SCIPY, 1e-7)
    gained = np.diff(run.evaluate("energy()", edges)) / TORQUE / 50
    error = run.accuracy.at(expression("theta"), edges).error[1:, 0] / 50
    late = [Known(*each) for each in zip(mean[5:], error[5:], abs(mean[5:]), strict=True)]
    says = "Later it is free: over 250–300, 300–350, 350–400 s the mean θ̇ is {}."
    against = "energy gained over T"
    yield Answer("mean θ̇ over 250–300, 300–350, 350–400 s", late, "rad/s", gained[5:], against, 1e-7, own=True, says=says)


@ask("Is the spin captured by the resonance over 50–100 s, with arms of 1, 0.5 and 0.1 m?")
def captured(case):
    """Captured: nearer to √(k/(M + m)) than to the spin T t/(m ε²) of a bolted motor, in ratio."""
    for eps in (1.0, 0.5, 0.1):
        run = case.run(parameters={"eps": eps}, until=100)
        turned = [Known(run.evaluate("theta", t), *_held(run, t)) for t in (50.0, 100.0)]
        mean = Known((turned[1] - turned[0]) / 50, (turned[0].error + turned[1].error) / 50, abs(turned[1]) / 50)
        bolted = TORQUE * 75 / (LOAD * eps**2)
        is_captured = abs(np.log(mean / NATURAL)) < abs(np.log(mean / bolted))
        of = "captured by the resonance" if is_captured else "not captured"
        ratios = f"{figure(mean / NATURAL, 3)} of √(k/(M+m)), {figure(mean / bolted, 3)} of a bolted motor's"
        says = f"With ε = {eps:g} m it is {of}: the mean θ̇ is {{}}, {ratios}."
        check = motion(rates(eps), [0, 0, 0, 0], [50.0, 100.0])[:, 0]
        yield Answer(f"mean θ̇ over 50–100 s, ε = {eps:g}", [mean], "rad/s", (check[1] - check[0]) / 50, SCIPY, 1e-7, says=says)


def _held(run, t):
    """Error and size of θ at a time."""
    known = run.accuracy.at(expression("theta"), np.array([t]))
    return known.error[0, 0], known.size[0, 0]


@ask("How do x and θ move with shorter arms?")
def shorter(case):
    times = np.array([5.0, 10.0, 20.0])
    for eps in (0.5, 0.1):
        run = case.run(parameters={"eps": eps}, until=20)
        check = motion(rates(eps), [0, 0, 0, 0], times)
        yield Answer("x at 5, 10, 20 s", run.evaluate("x", times), "m", check[:, 1], SCIPY, 1e-7, variant=f"ε = {eps} m")
        yield Answer("θ at 5, 10, 20 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-8, variant=f"ε = {eps} m")


@ask("How do they move with gravity in the plane, −g j?")
def heavy(case):
    run, times = case.run(parameters={"g": 9.81}, until=10), np.array([1.0, 2.0, 5.0, 10.0])
    check = motion(rates(gravity=9.81), [0, 0, 0, 0], times)
    yield Answer("x at 1, 2, 5, 10 s", run.evaluate("x", times), "m", check[:, 1], SCIPY, 1e-8)
    yield Answer("θ at 1, 2, 5, 10 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-8)
