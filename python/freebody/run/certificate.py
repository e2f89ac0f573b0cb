"""The agreement certificate of a run: what it says of the motion, found again by routes that share little with it, and how many
digits of each agree.

Most routes look at short stretches, each within a step, at seven evenly spaced times; derivatives there are central differences of
order 6 and integrals the closed formula of Newton and Cotes (Abramowitz & Stegun 25.3 and 25.4.18).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, Indeterminate, cards, quote
from freebody.impact.impacts import impacts
from freebody.run.digits import TIGHTEST, Accuracy
from freebody.solve.figures import digits_of
from freebody.solve.instant import Instant

if TYPE_CHECKING:
    from freebody.run.simulation import Run

STRETCHES = 8
SHARE = 0.25  # of a step is a stretch: over more of it differences are coarse, over less they are round-off
FIRST = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60
SECOND = np.array([2, -27, 270, -490, 270, -27, 2]) / 180
AREA = np.array([41, 216, 27, 272, 27, 216, 41]) / 140
AT_REST = 1e-9  # of how far the bodies are: what goes less in all the time is at rest
NOTHING = 1e-30  # SI: what is less is no motion and no load
UNDETERMINED = "loads undetermined"


@dataclass(frozen=True)
class Route:
    """A way to the same figures, how many digits agree (NaN: it does not apply), what is compared, and what is lacking where it
    does not apply."""

    name: str
    digits: float
    what: str
    lacking: str = "nothing to compare"

    @property
    def stated(self) -> str:
        """The digits, or why there are none, in words."""
        return self.lacking if math.isnan(self.digits) else f"{self.digits + 0.0:.1f}"


class Stretch:
    """Seven times ``t``, ``h`` s apart, around the middle of a step: of every body mass and inertia (nb, 3), place, velocity and
    acceleration of the mass centre and the angle (7, nb, 3); and the instants."""

    def __init__(self, run: Run, start: float, end: float) -> None:
        self.h = SHARE * (end - start) / 6
        self.t: Array = (start + end) / 2 + self.h * np.arange(-3, 4)
        self.instants = [run.instant(float(t)) for t in self.t]
        self.free = [instant.free_bodies() for instant in self.instants]
        bodies = [list(free.bodies.values()) for free in self.free]
        self.mass = np.array([[body.mass, body.mass, body.inertia] for body in bodies[3]])
        self.place = np.array([[[*body.G, body.angle] for body in row] for row in bodies])
        self.velocity = np.array([[[*body.v, body.omega] for body in row] for row in bodies])
        self.acceleration = np.array([[[*body.a, body.alpha] for body in row] for row in bodies])
        self.force_size, self.acceleration_size = self.instants[3].sizes

    def slope(self, values: Array) -> Array:
        """The rate at the middle of values (7, …)."""
        return np.tensordot(FIRST, values, 1) / self.h

    def integral(self, values: Array) -> Array:
        """The time integral of values (7, …)."""
        return np.tensordot(AREA, values, 1) * self.h


@dataclass(frozen=True, eq=False)
class Certificate:
    """That of a run."""

    run: Run

    @cached_property
    def routes(self) -> list[Route]:
        """All routes."""
        return [*self.own_routes, *self._integrated_again()]

    @cached_property
    def own_routes(self) -> list[Route]:
        """Those for which the motion is not integrated once more."""
        tighter = Route("tighter tolerance", _held(self.run.accuracy), "the motion, and a start that differs by round-off")
        return [*self._at_instants(), *self._over_time(), *self._over_impacts(), tighter]

    @property
    def weakest(self) -> Route:
        """The route on which fewest digits agree."""
        return weakest(self.routes)

    @property
    def _parts(self) -> list[dict[str, Any]]:
        """The joints and limits of the model."""
        return [*self.run.metadata["joints"], *self.run.metadata["limits"]]

    @cached_property
    def _stretches(self) -> list[Stretch]:
        edges = self.run.edges
        long = np.flatnonzero(np.diff(edges) >= np.median(np.diff(edges)))
        chosen = np.unique(long[np.linspace(0, len(long) - 1, STRETCHES).astype(int)])
        return [Stretch(self.run, float(edges[i]), float(edges[i + 1])) for i in chosen]

    @cached_property
    def _reach(self) -> Array:
        """What makes lengths of angles, and forces of couples, so that both are compared: how far the bodies are."""
        far = max((float(np.abs(s.place[..., :2]).max(initial=0.0)) for s in self._stretches), default=0.0) or 1.0
        return np.array([1.0, 1.0, far])

    @cached_property
    def _is_at_rest(self) -> bool:
        """Whether nothing goes, or would by the loads that balance, farther in all the time than places are known: all is round-off."""
        duration = float(self.run.edges[-1] - self.run.edges[0])
        speeds = (max(float(np.abs(s.velocity * self._reach).max()), s.acceleration_size * duration) for s in self._stretches)
        return max(speeds, default=0.0) * duration < AT_REST * float(self._reach[2])

    def _at_instants(self) -> Iterator[Route]:
        forms, rates, balances = [], [], []
        for s in self._stretches:
            state = s.instants[3].state
            others = [Instant(self.run.source, state, route) for route in ("newton_euler", "constraints")]
            forms += [part for other in others for part in s.instants[3].apart(other)]
            if self._is_at_rest:
                continue
            # Where velocities are constant they say, over a step, what an acceleration is beside; at rest accelerations say it.
            step = s.h * 6 / SHARE
            fast = max(float(np.abs(s.velocity[3] * self._reach).max(initial=0.0)), s.acceleration_size * step)
            rates.append(apart(s.velocity[3] * self._reach, s.slope(s.place) * self._reach, fast))
            rates.append(apart(s.acceleration[3] * self._reach, s.slope(s.velocity) * self._reach, fast / step))
            balances.append(self._inverse(s, max(s.force_size, float(s.mass.max(initial=0.0)) * fast / step)))
        yield Route("three forms", agreement(forms), "accelerations and reactions: minimal, Newton–Euler, constraints")
        yield Route("finite differences", agreement(rates), "velocities and accelerations, and how the bodies move")
        yield Route(
            "inverse dynamics", agreement(balances), "m a and I α as the bodies move, and the loads on each", UNDETERMINED
        )

    def _inverse(self, s: Stretch, largest: float) -> float:
        """What is left, beside the largest force, of the balances of bodies for accelerations that are second differences."""
        moved, free = np.tensordot(SECOND, s.place, 1) / s.h**2, s.free[3]
        try:
            acting = [free.acting(name, about=body.G) for name, body in free.bodies.items()]
        except Indeterminate:
            return math.nan
        return apart(s.mass * moved / self._reach, np.array(acting) / self._reach, largest)

    def _over_time(self) -> Iterator[Route]:
        momenta, works = [], []
        for s in () if self._is_at_rest else self._stretches:
            linear = s.mass * s.velocity
            x, y = s.place[..., 0], s.place[..., 1]
            angular = linear[..., 2] + x * linear[..., 1] - y * linear[..., 0]
            whole = np.dstack([linear[..., 0].sum(1), linear[..., 1].sum(1), angular.sum(1)])[0] / self._reach
            try:
                acting = np.array([free.acting(*free.bodies) for free in s.free]) / self._reach
            except Indeterminate:
                acting = np.full((7, 3), math.nan)
            momenta.append(apart(whole[6] - whole[0], s.integral(acting), max(np.abs(whole).max(), s.force_size * 6 * s.h)))
            works += self._works(s)
        what = "momenta of the whole, and the impulses of what acts on it"
        yield Route("impulse and momentum", agreement(momenta), what, UNDETERMINED)
        what = "works of forces and motions, and the time integrals of their powers"
        yield Route("work", agreement(works), what, "no forces, no motions")
        ledger = self.run.energy
        largest = max((np.abs(ledger[name]).max(initial=0.0) for name in ledger.names if name != "balance"), default=0.0)
        left = [] if self._is_at_rest else [apart(ledger.balance, np.zeros_like(ledger.balance), largest)]
        yield Route("energy", agreement(left), "energy stored, and all works")

    def _over_impacts(self) -> Iterator[Route]:
        """The balance of momentum of each body over every impact, the impulses of joints and contacts, and what is lost."""
        balances, losses = [], []
        for impact in impacts(self.run):
            free, stated, change = impact.impulses, impact.change.impulses, impact.change
            mass = np.array([[body.mass, body.mass, body.inertia] for body in free.bodies.values()])
            before, after = (impact.velocities(each.u) for each in (change.before, change.after) if each)
            jump, largest = mass * (after - before) / self._reach, float(np.abs(mass * [before, after] / self._reach).max())
            kinetic = max(float((mass * v**2).sum()) / 2 for v in (before, after))
            gain = float((mass * (after - before) * (after + before)).sum()) / 2
            losses.append(apart(np.array((change.work or 0.0) - gain), np.array(change.lost), kinetic))
            known = [("second", stated.joints), ("first", stated.contacts)] if stated else []
            parts = [(part, side, of[part["name"]]) for side, of in known for part in self._parts if part["name"] in of]
            try:
                acting = np.array([free.acting(name, about=body.G) for name, body in free.bodies.items()]) / self._reach
            except Indeterminate:
                continue
            balances.append(apart(jump, acting, largest))
            for part, side, impulse in parts:
                loads = [load for load in free.loads if load.name == part["name"]]
                point = next((each.point for load in loads for each in load.on if each.body == part[side]), (0.0, 0.0))
                on_body = sum((load.acting([part[side]], point) for load in loads), np.zeros(3))
                known = len(impulse)  # of contacts no couple is stated
                balances.append(apart((on_body / self._reach)[:known], (np.array(impulse) / self._reach[:known]), largest))
        if losses:
            what = "jumps of the momentum of each body, and the impulses on it"
            yield Route("impulses of impacts", agreement(balances), what, "impulses undetermined")
            yield Route("energy of impacts", agreement(losses), "kinetic energy lost, the work of motions, and what is booked")

    def _works(self, s: Stretch) -> Iterator[float]:
        """How far works over a stretch are from the integrals of powers, beside the largest of them."""
        names = [quote(part["name"]) for section in ("forces", "motions") for part in self.run.metadata[section]]
        if names:
            texts = [f"{name}.{word}" for word in ("work", "power") for name in names]
            work, power = np.hsplit(self.run.motion.evaluate(texts, s.t), 2)
            yield apart(work[6] - work[0], s.integral(power), max(np.abs(work).max(), np.abs(power).max() * 6 * s.h))

    def _integrated_again(self) -> Iterator[Route]:
        from freebody.run.simulation import simulate

        settings = self.run.settings
        adaptive = [name for name, method in cards.methods().items() if not method.fixed_step and name != settings.method]
        half = {"step": settings.step and settings.step / 2}
        if not cards.methods()[settings.method].fixed_step:
            half["rtol"] = settings.rtol / 2 if settings.rtol >= 2 * TIGHTEST else 2 * settings.rtol
        other = simulate(self.run.source, self.run.start, replace(settings, method=adaptive[0], step=None))
        finer = simulate(self.run.source, self.run.start, replace(settings, **half))
        yield Route("second integrator", _held(Accuracy(self.run, other)), f"the motion by {adaptive[0]}")
        yield Route("tolerance halved", _held(Accuracy(self.run, finer)), "the motion at half the tolerance or step")


def weakest(routes: Sequence[Route]) -> Route:
    """The route on which fewest digits agree."""
    return min((route for route in routes if not math.isnan(route.digits)), key=lambda route: route.digits)


def _held(accuracy: Accuracy) -> float:
    return float(accuracy.held[-1]) if accuracy.parting == math.inf else 0.0


def apart(one: Array, other: Array, least: float) -> float:
    """Largest difference relative to the largest entry, or to ``least`` where that is larger."""
    size = max(float(np.abs([one, other]).max(initial=0.0)), float(least), NOTHING)
    return float(np.abs(one - other).max(initial=0.0)) / size


def agreement(gaps: list[float]) -> float:
    """How many digits agree where what is compared is so far apart; NaN where there is nothing to compare."""
    known = [gap for gap in gaps if not math.isnan(gap)]
    return float(digits_of(max(known), 1.0)) if known else math.nan
