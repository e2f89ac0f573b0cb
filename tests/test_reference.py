"""Motions to 25 digits beside closed forms and another solution of many digits, by mpmath."""

from functools import cache

import mpmath
import pytest

import freebody as fb
from freebody.core import MotionError


@pytest.fixture(autouse=True)
def many_digits():
    with mpmath.workdps(50):
        yield


def close(found, expected, digits):
    return abs(mpmath.mpf(str(found)) - expected) < mpmath.mpf(10) ** -digits * max(1, abs(expected))


def double_pendulum():
    made = fb.Mechanism("pendulum", gravity="9.81 m/s^2")
    for name, pin in (("a", "ground.O"), ("b", "a.end")):
        made.body(name, shape="rod", mass="1 kg", length="1 m")
        made.hinge(pin, f"{name}.start", name=f"{name} hinge", coordinate=f"q{name}")
    made.initial(at_rest=True, qa=-0.57, qb=-0.5)
    return made


@cache
def by_hand(until):
    """Angles and rates of the double pendulum at the end: Lagrange's equations and their Taylor series by hand."""
    mpf, order = mpmath.mpf, 40
    g, third = mpf(9.81), mpf(1) / 3
    qa, qb = mpf(-0.57), mpf(-0.5)
    y, t = [qa, qa + qb, mpf(0), mpf(0)], mpf(0)

    def product(a, b, k):
        return mpmath.fdot(zip(a[: k + 1], b[k::-1], strict=True))

    while t < until:
        a, b, u, v = ([x] for x in y)
        lists = [[] for _ in range(15)]
        d, s, c, sa, ca, sb, cb, uu, vv, f, h, cc, det, up, vp = lists
        for k in range(order):
            d.append(a[k] - b[k])
            for sine, cosine, angle in ((s, c, d), (sa, ca, a), (sb, cb, b)):
                slope = [j * angle[j] for j in range(1, k + 1)]
                sine.append(product(slope, cosine, k - 1) / k if k else mpmath.sin(angle[0]))
                cosine.append(-product(slope, sine[:k], k - 1) / k if k else mpmath.cos(angle[0]))
            uu.append(product(u, u, k))
            vv.append(product(v, v, k))
            f.append(-product(s, vv, k) / 2 - 3 * g / 2 * ca[k])
            h.append(product(s, uu, k) / 2 - g / 2 * cb[k])
            cc.append(product(c, c, k))
            det.append((4 * third * third if k == 0 else 0) - cc[k] / 4)
            for rates, above in ((up, f[k] * third - product(h, c, k) / 2), (vp, 4 * third * h[k] - product(f, c, k) / 2)):
                rates.append((above - (product(det[1:], rates, k - 1) if k else 0)) / det[0])
            for of, rates in ((a, u), (b, v), (u, up), (v, vp)):
                of.append(rates[k] / (k + 1))
        far = max(abs(of[order]) for of in (a, b, u, v))
        step = min(until - t, (mpf(10) ** -36 / far) ** (mpf(1) / order))
        y, t = [mpmath.polyval(of[::-1], step) for of in (a, b, u, v)], t + step
    return y


@pytest.mark.parametrize(("until", "digits"), [(0.25, 28), pytest.param(10, 25, marks=pytest.mark.long)])
def test_double_pendulum(until, digits):
    found = double_pendulum().reference(until, t_eval=[until])
    assert found.digits >= digits
    a, b, u, v = by_hand(until)
    for name, expected in (("qa", a), ("qb", b - a), ("rate(qa)", u), ("rate(qb)", v - u)):
        assert close(found[name][-1], expected, digits), name


def test_pendulum_by_elliptic_functions():
    made = fb.Mechanism("pendulum", gravity="9.81 m/s^2")
    made.body("bob", shape="particle", mass="1 kg")
    made.link("ground.O", "bob.centre", length="1 m", coordinate="theta")
    made.initial(at_rest=True, theta=0.5 - 1.5707963267948966)
    times = [0.1, 0.7, 2, 5]
    found = made.reference(t_eval=times)
    # From the downward vertical, released at a: sin(θ/2) = k cd(ω t), k = sin(a/2); π/2 is what the double beside it is not.
    start = mpmath.mpf(0.5 - 1.5707963267948966) + mpmath.pi / 2
    k, rate = mpmath.sin(start / 2), mpmath.sqrt(mpmath.mpf(9.81))
    for t, theta in zip(times, found["theta"], strict=True):
        swung = 2 * mpmath.asin(k * mpmath.ellipfun("cd", rate * mpmath.mpf(t), m=k * k)) - mpmath.pi / 2
        assert close(theta, swung, 27), t


def test_an_orbit_about_a_spring_without_length():
    made = fb.Mechanism("orbit", gravity=0)
    made.body("ball", shape="disk", mass="1 kg", radius="0.1 m")
    made.free("ground.O", "ball.centre", coordinates=["x", "y", "turn"])
    made.spring(between=["ground.O", "ball.centre"], stiffness="3 N/m")
    made.initial(x=1, y=0.25, rates={"x": 0, "y": 1.5})
    found = made.reference("20 s")
    assert (len(found.t), found.t[0], found.t[-1]) == (101, 0, 20)
    rate = mpmath.sqrt(3)
    for i in (0, 37, 100):
        t = mpmath.mpf(found.t[i])
        assert close(found["x"][i], mpmath.cos(rate * t), 28)
        assert close(found["y"][i], mpmath.cos(rate * t) / 4 + mpmath.sin(rate * t) * 3 / 2 / rate, 28)


def test_no_more_digits_are_given_than_hold():
    found = double_pendulum().reference(3, t_eval=[0, 0.25, 3])
    a, b, *_ = by_hand(0.25)
    last_place = mpmath.mpf(10) ** found["qb"][1].as_tuple().exponent
    assert abs(mpmath.mpf(str(found["qb"][1])) - (b - a)) < last_place < mpmath.mpf(10) ** -25
    with pytest.raises(ValueError, match=r"\d+ digits hold at t = 10 s, fewer than 31: .* ask for `digits=\d+`"):
        double_pendulum().reference(t_eval=[10], digits=31)


def test_what_has_no_series_is_refused():
    made = double_pendulum()
    made.torque(on="a", value="sign(qa) * 1 N*m")
    with pytest.raises(MotionError, match="because a law switches"):
        made.reference(1)
    with pytest.raises(ValueError, match="times follow each other"):
        double_pendulum().reference(t_eval=[2, 1])
