"""How close freebody comes to answers known from elsewhere: prints figure reached beside figure wanted.

Usage: accuracy.py [--json]   exit code 1 where a figure is missed.

References: closed forms, and digits on which quadruple-precision extrapolation (Gragg, Bulirsch, Stoer) of the index-1
equations at two tolerances agrees.
"""

from __future__ import annotations

import json
import math
import re
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import numpy as np
from mpmath import mp
from rich.console import Console
from rich.markup import escape
from rich.table import Table

import freebody
from freebody.core import Change

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ROUTES = ROOT / "crates" / "freebody" / "tests" / "laws" / "random_mechanisms.rs"
G = 9.81

# Angles from the vertical and their rates at t = 10 s.
DOUBLE_PENDULUM = {
    "theta1": -0.5684746640159501887761,
    "theta2": -0.5263937279324046983296,
    "rate(theta1)": 6.078384885761964854825,
    "rate(theta2)": -9.681360681708878758077,
}

# At t = 0.03 s. The digits that the IVP test set prints for this problem hold to 3e-10 in the angles and to 1e-6 in the
# multipliers only; these agree with them to that, and with each other at two tolerances to all digits.
ANDREWS = {
    "beta": 15.81077119515370709712,
    "theta": -15.75637105841183946973,
    "gamma": 0.04082224011964580485828,
    "phi": -0.5347301163420795937702,
    "delta": 0.5244099658799540693717,
    "Omega": 0.5347301163420795937702,
    "epsilon": 1.048080741041937873069,
}

# There the loops read E of K2 − E of another body = 0 in M q̈ + Gᵀ λ = f, so that λ is the force of K2 on that body: the
# reaction that freebody reports of a pin that names K2 first.
ANDREWS_AT_E = {
    "E.K3.Fx": 199.1753481045386281862,
    "E.K3.Fy": -29.75530997497176332442,
    "E.K4.Fx": 23.06654361162215112862,
    "E.K4.Fy": 31.45272527577113707538,
    "E.K6.Fx": 22.64249478639437857771,
    "E.K6.Fy": 11.6173923526112559068,
}


@dataclass(frozen=True)
class Row:
    """One figure: an error or a gap, which should not be more than wanted."""

    what: str
    reached: float
    wanted: float

    @property
    def ok(self) -> bool:
        return self.reached <= self.wanted


def simulate(file: str, parameters: Mapping[str, float] | None = None, **settings: float) -> freebody.Run:
    """The run of a model file beside this one, to its end."""
    mechanism = freebody.load(HERE / file)
    mechanism.parameters.update(parameters or {})
    run = mechanism.simulate(**settings)
    if not run.outcome.ok:
        raise RuntimeError(f"{file}: {run.outcome.sentence}")
    return run


def errors(run: freebody.Run, known: Mapping[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """Sizes of the errors of expressions at the end of a run: as they are, and relative."""
    value = np.array([run.evaluate(text, run.outcome.t) for text in known])
    right = np.array(list(known.values()))
    error = np.abs(value - right)
    return error, error / np.abs(right)


def double_pendulum() -> Iterator[Row]:
    """Two unit point masses on unit links, both level at first: chaotic, so that errors grow."""
    for settings, name, wanted in (({}, "default tolerance", 3e-7), ({"rtol": 1e-12}, "rtol 1e-12", 5e-10)):
        error, _ = errors(simulate("double_pendulum.yaml", **settings), DOUBLE_PENDULUM)
        yield Row(f"double pendulum, 10 s, {name}: angles and rates [rad, rad/s]", error.max(), wanted)


def andrews() -> Iterator[Row]:
    """Seven bodies and three loops, driven for 15.9 rad of the crank."""
    run = simulate("andrews.yaml")
    _, angles = errors(run, ANDREWS)
    _, forces = errors(run, ANDREWS_AT_E)
    yield Row("Andrews, 0.03 s: every angle, relative", angles.max(), 1e-11)
    yield Row("Andrews, 0.03 s: every pin force at E, relative", forces.max(), 1e-9)
    push = 4530 * (0.07785 - andrews_spring(ANDREWS["gamma"]))
    yield Row("Andrews, 0.03 s: force of the spring, relative", abs(run.evaluate("spring.value", 0.03) / push - 1), 1e-11)
    # A constant torque does the work torque · angle.
    kept = run["energy()"] - 0.033 * run["beta"]
    yield Row("Andrews: power balance over greatest kinetic energy", np.ptp(kept) / run["kinetic()"].max(), 1e-12)


def andrews_spring(gamma: float) -> float:
    """Length of the spring between D of the triangle, which turns about B, and C of the frame."""
    d = complex(-0.03635, 0.03273) + complex(0.02, -0.018) * complex(math.cos(gamma), math.sin(gamma))
    return abs(d - complex(0.014, 0.072))


def pendulum() -> Iterator[Row]:
    """A01: a point mass on a unit bar, let go from the level on the left; its energy is 0."""
    run = simulate("pendulum.yaml")
    known = level_pendulum(run.outcome.t)
    yield Row("A01 pendulum, 10 s: energy [J]", np.abs(run["energy()"]).max(), 1e-9)
    yield Row("A01 pendulum, 10 s: position [m]", distance(run, "bar.end", known), 1e-9)


def level_pendulum(t: float) -> float:
    """The angle from the x axis: 270° − φ, sin(φ/2) = k cd(√g t, k), k = sin 45°."""
    swing = 2 * mp.asin(mp.ellipfun("cd", mp.sqrt(G) * t, m=0.5) / mp.sqrt(2))
    return float(3 * mp.pi / 2 - swing)


def ladder(n: int) -> Iterator[Row]:
    """A02: n four-bars in a row move as one body; flat, their loops are not independent."""
    run = simulate("ladder.yaml", {"N": n})
    inertia, lift = (n + 1) / 3 + n, (n + 1) / 2 + n  # in kg·m² and kg·m: posts and couplers
    known = upright_turn(run.outcome.t, lift * G / inertia)
    error = np.abs(run["energy()"] - (lift * G + inertia / 2)).max()
    yield Row(f"A02 ladder of {n}, 10 s: energy [J]", error, 1e-6)
    yield Row(f"A02 ladder of {n}, 10 s: position of B0 [m]", distance(run, "post[0].end", known), 1e-8)


def upright_turn(t: float, k: float) -> float:
    """The angle 90° − 2χ of what turns clockwise from upright at 1 rad/s with ψ̈ = k sin ψ, ψ = 2χ.

    By energy χ̇² = (1 + 4k sin² χ)/4, which gives t = 2 F(χ | −4k), Legendre's integral of the first kind.
    """
    quarter = 2 * mp.ellipk(-4 * k)
    chi = mp.findroot(lambda x: 2 * mp.ellipf(x, -4 * k) - t, float(t / quarter) * math.pi / 2)
    return float(mp.pi / 2 - 2 * chi)


def distance(run: freebody.Run, point: str, angle: float) -> float:
    """How far a point is at the end from where a unit bar about the origin has its tip at an angle."""
    x, y = run.point(point)[-1]
    return math.hypot(x - math.cos(angle), y - math.sin(angle))


def four_bar() -> Iterator[Row]:
    """A four-bar that falls from rest: its last pin stays closed."""
    run = simulate("four_bar.yaml")
    gap = np.hypot(*(run.point("coupler.end") - run.point("rocker.end")).T)
    yield Row("four-bar, 10 s: gap of the loop at every output [m]", gap.max(), 1e-12)


def switched(run: freebody.Run, *kinds: str) -> list[Change]:
    """Mode changes during a run, of these kinds."""
    return [change for change in run.changes if change.kind in kinds]


def open_ledger(run: freebody.Run) -> float:
    """How far the energy ledger is open at most, over the largest kinetic energy."""
    return np.abs(run.energy.balance).max() / run.energy.kinetic.max()


def bouncing_ball() -> Iterator[Row]:
    """Bounces without end, at √(2h/g) (1 + 2 Σ eʲ), have an end."""
    run, e, fall = simulate("bouncing_ball.yaml"), 0.7, math.sqrt(2 / G)
    (rest,) = switched(run, "rest")
    yield Row("bouncing ball: the end of all bounces [s]", abs(rest.t - fall * (1 + e) / (1 - e)), 1e-9)
    yield Row("bouncing ball: changes until it rests", len(run.changes), 200)
    yield Row("bouncing ball: energy ledger over kinetic energy", open_ledger(run), 1e-9)


def billiard() -> Iterator[Row]:
    """Chords that meet the wall at β from its normal: each impact is π − 2β further on."""
    run, beta = simulate("billiard.yaml"), 0.37
    impacts = switched(run, "impact")
    (x, y), (vx, vy) = (np.array([list(getattr(impact.after, part).values()) for impact in impacts]).T for part in ("q", "u"))
    turned = np.arctan2(y, x) - (math.pi / 2 - beta) - np.arange(len(impacts)) * (math.pi - 2 * beta)
    yield Row("ball in a circle: impacts less than 10 000", max(0, 10_000 - len(impacts)), 0)
    yield Row("ball in a circle, 10 000 impacts: angle [rad]", np.abs(np.angle(np.exp(1j * turned))).max(), 1e-8)
    yield Row("ball in a circle, 10 000 impacts: speed, relative", np.abs(np.hypot(vx, vy) - 1).max(), 1e-10)


def belt() -> Iterator[Row]:
    """It slips at kx = μₛmg and swings about μmg/k until it has the belt's speed again, (μₛ − μ)mg/k on the other side."""
    run = simulate("belt.yaml")
    omega, a, v = 10.0, 0.2 * G / 100, 0.1
    slip, stick = 2 * (math.pi - math.atan(a * omega / v)) / omega, 2 * a / v
    periods = np.arange(13) * (slip + stick)
    for kind, first in (("slip", 0.4 * G / 100 / v), ("stick", 0.4 * G / 100 / v + slip)):
        times = [change.t for change in switched(run, kind)]
        known = first + periods[: len(times)]
        late = np.abs(times - known).max() if len(times) >= 11 else math.inf
        yield Row(f"belt, {len(times)} periods: instants of {kind} [s]", late, 1e-9)
    yield Row("belt: energy ledger over kinetic energy", open_ledger(run), 1e-9)


def leaning() -> Iterator[Row]:
    """A ladder between smooth wall and floor: l θ̇² = 3g (sin θ₀ − sin θ), and it leaves the wall at ⅔ of its height."""
    run = simulate("leaning.yaml")
    (leaves,) = switched(run, "lift-off")
    start = mp.radians(70)
    end = mp.asin(2 * mp.sin(start) / 3)
    pace = lambda z: 2 * z / mp.sqrt(3 * G * mp.cos(start - z * z / 2) * mp.sin(z * z / 2))  # θ = θ₀ − z²
    late = abs(leaves.t - mp.quad(pace, [0, mp.sqrt(start - end)]))
    yield Row("leaning ladder: instant at which it leaves the wall [s]", float(late), 1e-9)
    angle = math.asin(run.evaluate("y(ladder.end)", leaves.t) / 2)
    yield Row("leaning ladder: angle at which it leaves the wall [rad]", abs(angle - float(end)), 1e-9)


def rocking() -> Iterator[Row]:
    """Housner 1963: an impact leaves 1 − ³⁄₂ sin² α of the speed; θ̇² = 3g/(2R) (cos(α − θ₀) − cos(α − θ))."""
    run, alpha, start = simulate("rocking.yaml"), mp.atan(0.25), mp.mpf(0.12)
    impacts = switched(run, "impact")
    spins = [[list(snapshot.u.values())[2] for snapshot in (impact.before, impact.after)] for impact in impacts]
    kept = np.array([after / before for before, after in spins])
    yield Row("rocking block: speed kept at an impact", np.abs(kept - float(1 - 1.5 * mp.sin(alpha) ** 2)).max(), 1e-12)
    pace = lambda z: 2 * z / mp.sqrt(3 * G / mp.sqrt(4.25) * mp.sin(alpha - start + z * z / 2) * mp.sin(z * z / 2))
    quarter = mp.quad(pace, [0, mp.sqrt(start)])
    yield Row("rocking block: first quarter of its period [s]", abs(float(impacts[0].t - quarter)), 1e-9)
    yield Row("rocking block: speed at the end", np.abs(run.u[-1]).max(), 0)
    yield Row("rocking block: energy ledger over kinetic energy", open_ledger(run), 1e-9)


def leash() -> Iterator[Row]:
    """Taut at |(0.5 + 2t, −0.3t)| = 1 m, with a common speed along it: ½ μ v² is lost, μ the reduced mass."""
    run = simulate("leash.yaml")
    (taut,) = switched(run, "taut")
    t = (-1 + math.sqrt(1 + 0.75 * 4.09)) / 4.09
    jump = 2 * (0.5 + 2 * t) + 0.3 * 0.3 * t
    yield Row("leash: instant at which it goes taut [s]", abs(taut.t - t), 1e-12)
    yield Row("leash: energy lost then [J]", abs(taut.lost - 0.75 / 2 * jump**2), 1e-12)
    momentum = np.array([run["momentum_x()"] - 6, run["momentum_y()"] - 0.3])
    yield Row("leash: momentum [kg m/s]", np.abs(momentum).max(), 1e-9)


def routes() -> Iterator[Row]:
    """The three ways to an instant's solution agree at random states of random mechanisms: the Rust tests say."""
    command = ["cargo", "test", "--release", "-p", "freebody", "--test", "laws", ROUTES.stem]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    found = re.search(r"[1-9]\d* passed; (\d+) failed", done.stdout)
    yield Row("three routes on random mechanisms: failed tests", int(found[1]) if found else math.inf, 0)


Check = Callable[[], Iterable[Row]]
QUICK: list[Check] = [double_pendulum, andrews, pendulum, partial(ladder, 2), four_bar]
QUICK += [bouncing_ball, billiard, belt, leaning, rocking, leash]
SLOW: list[Check] = [partial(ladder, 100), *([routes] if ROUTES.exists() else [])]


def print_table(rows: Iterable[Row]) -> None:
    table = Table("what", "reached", "wanted", "ok")
    for row in rows:
        table.add_row(escape(row.what), f"{row.reached:.1e}", f"{row.wanted:.0e}", "yes" if row.ok else "[bold red]no[/]")
    Console().print(table)


def main() -> None:
    rows = [row for check in QUICK + SLOW for row in check()]
    if "--json" in sys.argv[1:]:
        print(json.dumps([{**asdict(row), "ok": bool(row.ok)} for row in rows], indent=1))
    else:
        print_table(rows)
    sys.exit(not all(row.ok for row in rows))


if __name__ == "__main__":
    main()
