"""19.3.21: two blocks and a cable that can only pull.

Over a pulley, slopes α₁ and α₂ falling away from it on the left and on the right, a the acceleration of m₂ down its slope:
    a = g(m₂ sin α₂ − m₁ sin α₁)/(m₁ + m₂),   T = m₁m₂g(sin α₁ + sin α₂)/(m₁ + m₂) > 0, then and at 5 s
(10 and 5 kg on 30° and 90° hold each other: nothing moves).
On one slope, one behind the other, both would go with g sin α anyhow: T = 0, and the cable stays just as long as it is.
On a track that falls at α before and at β after a break (guided, the blocks keep their speed there, and their lengths do not
matter), while the trailing one is before it and the leading one past it: T = m₁m₂g(sin β − sin α)/(m₁ + m₂) if that is positive;
else the cable is slack at once, and the trailing block, faster, runs into the leading one. Past the break both have T = 0.
Where the hanging block is not guided and swings, at r from the edge and φ from the vertical:
    (m₁ + m₂) r̈ = m₂(rφ̇² + g cos φ),   rφ̈ = −g sin φ − 2ṙφ̇,   T = m₁ r̈ > 0 as long as |φ| < 90°.
"""

from math import cos, pi, sin, sqrt

from freebody.catalogue import Answer, ask, reference

G = 9.81
CASES = (
    (10, 10, 0, 90), (5, 3, 0, 90), (4, 6, 90, 90), (10, 5, 30, 90), (4, 7, 30, 60),
)  # fmt: skip
BALANCE = "closed form: momentum of each block"
FLATTER = {"before": pi / 3, "after": pi / 6}
LONG, PAST = 2.0, 0.5


def happened(run):
    """Mode changes: kind and time of each change after the start."""
    return [(change.kind, change.of, change.t) for change in run.changes if change.t > 0]


def on(degrees):
    return G * sin(degrees * pi / 180)


@ask("Over a pulley: what are the acceleration of the first block and the tension, in symbols?")
def symbolically(case):
    closed = {
        "x1": "g*(m1*sin(alpha1) - m2*sin(alpha2))/(m1 + m2)",
        "cable.tension": "m1*m2*g*(sin(alpha1) + sin(alpha2))/(m1 + m2)",
    }
    yield from case.symbolically(closed, "closed form: one balance a block")


@ask("What is the tension (a) immediately after release, (b) at 5 s, m₁ on a table, m₂ hanging, 10 kg each?")
def pulley(case):
    for m1, m2, left, right in CASES:
        run = case.run(parameters={"m1": m1, "m2": m2, "alpha1": left * pi / 180, "alpha2": right * pi / 180})
        a = (m2 * on(right) - m1 * on(left)) / (m1 + m2)
        T = m1 * m2 * (on(left) + on(right)) / (m1 + m2)
        of = "" if (m1, m2, left) == (10, 10, 0) else f"{m1:g}, {m2:g} kg; {left}°, {right}°"
        yield Answer("tension at 0, 5 s", run.evaluate("cable.tension", [0.0, 5.0]), "N", [T, T], BALANCE, 1e-11, variant=of)
        yield Answer("acceleration of m₂", run.evaluate("accel(x2)", 0.0), "m/s²", a, BALANCE, 1e-12, G, variant=of)
        yield Answer("way of m₂ after 5 s", run.evaluate("x2", 5.0) - 1, "m", 12.5 * a, BALANCE, 1e-11, 1.0, variant=of)
        yield undisturbed(run, "closed form: T > 0", of)


def undisturbed(run, against, of=""):
    """No change on the way."""
    changes = len(happened(run))
    says = f"{changes} changes happen on the way." if changes else "Nothing changes on the way."
    return Answer("changes on the way", changes, "", 0, against, 0, 1.0, says=says, variant=of)


@ask("And both on one slope of 30°, in series?")
def one_slope(case):
    run = case.run("series.yaml")
    pulls = run.evaluate("cable.tension", [0.0, 2.5, 5.0])
    yield Answer("tension at 0, 2.5, 5 s", pulls, "N", [0.0] * 3, "closed form: both go with g sin α", 1e-12, 5 * G)
    speeds = [run.evaluate(f"vx({block}.centre)", 5.0) / cos(pi / 6) for block in ("trailing", "leading")]
    yield Answer("speeds at 5 s", speeds, "m/s", [5 * on(30)] * 2, "closed form: g sin α t", 1e-12)
    yield Answer("distance at 5 s", run.evaluate("x2 - x1", 5.0), "m", 2.0, "closed form: as at the start", 1e-12)
    yield undisturbed(run, "closed form: as at the start")


@ask("And in series on a track that falls at 30°, then at 60°?")
def steeper(case):
    run = case.run("broken.yaml")
    a, T = (10 * on(30) + 5 * on(60)) / 15, 50 * (on(60) - on(30)) / 15
    passing = sqrt(2 * (LONG - PAST) / a)
    event = run.events[-1]
    yield Answer("acceleration after release", run.evaluate("accel(s1)", 0.0), "m/s²", a, BALANCE, 1e-12)
    pulls = run.evaluate("cable.N", [0.0, 0.99 * passing])
    yield Answer("tension after release, and until the second one is past the break", pulls, "N", [T, T], BALANCE, 1e-11)
    yield Answer("time when it passes", event.t, "s", passing, BALANCE, 1e-10)
    pulls = run.evaluate("cable.N", [1.01 * passing, 5.0])
    yield Answer("tension from then on, at 5 s", pulls, "N", [0.0, 0.0], "closed form: both go with g sin 60°", 1e-11, T)
    way = LONG + a * passing * (5 - passing) + on(60) * (5 - passing) ** 2 / 2
    yield Answer("way of the trailing block at 5 s", run.evaluate("s1", 5.0), "m", way, BALANCE, 1e-10)
    yield Answer("the other one ahead by", run.evaluate("s2 - s1", 5.0), "m", LONG, "closed form: as at the start", 1e-11)


@ask("And on a track that falls at 60°, then at 30°: the cable goes slack, and what follows, the bump plastic?")
def flatter(case):
    """Each block for itself: s₁ = PAST + g sin 60° t²/2 up to the break, then with g sin 30°; s₂ with g sin 30° all the time."""
    passing = sqrt(2 * (LONG - PAST) / on(60))
    faster = (on(60) - on(30)) * passing
    apart = LONG - (on(60) - on(30)) * passing**2 / 2
    meet = passing + apart / faster
    against, free = "closed form: each block for itself", "closed form: slack"
    for bounce, of in ((0.0, ""), (1.0, "an elastic bump")):
        run = case.run("broken.yaml", {**FLATTER, "bounce": bounce})
        pulls = run.evaluate("cable.N", [0.0, 1.0, 5.0])
        yield Answer("tension at 0, 1, 5 s", pulls, "N", [0.0] * 3, free, 1e-12, 5 * G, variant=of)
        yield Answer("time when the trailing block passes the break", run.events[0].t, "s", passing, against, 1e-10, variant=of)
        first, *later = happened(run)
        yield Answer("time when it runs into the other", first[2], "s", meet, against, 1e-10, variant=of)
        common = 5 * on(30) + 10 * faster / 15
        for _, _, taut in later[:1]:
            yield Answer(
                "time when the cable goes taut, with a jerk", taut, "s", meet + LONG / faster, against, 1e-10, variant=of
            )
        speeds = [run.evaluate(f"rate({s})", 5.0) for s in ("s1", "s2")]
        yield Answer("speeds at 5 s", speeds, "m/s", [common] * 2, "conservation: momentum", 1e-10, variant=of)
        ahead = run.evaluate("s2 - s1", 5.0)
        yield Answer("distance at 5 s", ahead, "m", LONG * bounce, "closed form: together, or taut", 1e-10, LONG, variant=of)


@ask("And where the hanging block starts 0.5 rad off plumb?")
def off_plumb(case):
    m1, m2, r0, tilt = 10.0, 1.0, 1.0, 0.5

    def swinging(t, y):
        r, phi, speed, turning = y
        pull = m2 * (r * turning**2 + G * cos(phi)) / (m1 + m2)
        return [speed, turning, pull, (-G * sin(phi) - 2 * speed * turning) / r]

    run, times = case.run("plumb.yaml"), [0.0, 0.5, 2.0, 5.0]
    states = [[r0, tilt, 0, 0], *reference.motion(swinging, [r0, tilt, 0, 0], times[1:])]
    against = "other route: the two equations integrated by SciPy"
    T = [m1 * swinging(0, y)[2] for y in states]
    yield Answer("tension at 0, 0.5, 2, 5 s", run.evaluate("cable.tension", times), "N", T, against, 1e-10)
    x, y = (run.evaluate(f"{axis}(block2.centre)", times) for axis in "xy")
    yield Answer("hanging block, x", x, "m", [r * sin(p) for r, p, _, _ in states], against, 1e-10)
    yield Answer("hanging block, y", y, "m", [-r * cos(p) for r, p, _, _ in states], against, 1e-10)
    yield Answer("block on the table", run.evaluate("x1", times), "m", [100 + r0 - r for r, *_ in states], against, 1e-10)
    yield undisturbed(run, "closed form: |φ| < 90°")
