"""All places where a quantity is what it is asked to be."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import groupby, pairwise
from math import isfinite
from typing import Any, ClassVar

from freebody.find.curve import Break, Curve
from freebody.find.response import Response, Sample
from freebody.model.user_units import shown
from freebody.solve.figures import Known
from freebody.solve.rich_tables import PlainText, figure_in, table

_TOUCHES = 3.0
"""Errors of the quantity within which its extreme is the target."""
_APART = 1e-3
"""Part of an interval over which a slope is a difference."""


@dataclass(frozen=True)
class Root:
    """A value of what is varied with which the quantity is the target: ``where`` in SI, with its error; ``found`` is the quantity there,
    by a run of its own. ``touching``: the quantity only touches the target there."""

    where: Known
    found: Known
    touching: bool = False


@dataclass(frozen=True)
class Found(PlainText):
    """All values of what is ``varied`` between two places for which the quantity ``of`` is the ``target``, in SI.

    ``breaks`` are the places where it jumps over the target, or begins or ceases to have a value. ``throughout`` are intervals on
    which it is the target everywhere."""

    of: str
    target: float
    varied: str
    units: tuple[str, str]
    curve: Curve = field(repr=False)
    roots: list[Root]
    throughout: list[tuple[float, float]]
    width: ClassVar[int] = 130

    @property
    def values(self) -> list[float]:
        """Where the roots are."""
        return [float(root.where) for root in self.roots]

    @property
    def breaks(self) -> list[Break]:
        """Where the quantity jumps over the target, or begins or ceases to have a value."""
        return [
            each
            for each in self.curve.breaks
            if not each.below.is_known or not each.above.is_known
            or min(each.below.y, each.above.y) < self.target < max(each.below.y, each.above.y)
        ]  # fmt: skip

    @property
    def sentence(self) -> str:
        """The answer, with its unit."""
        at, value = partial(figure_in, self.units[0]), partial(self.curve.printed, self.units[1])
        unit, of_value = (f" {shown(each).unit}".rstrip() for each in self.units)
        asked = f"{self.of} is {figure_in(self.units[1], self.target, 10)}{of_value}"
        between = f"between {at(self.curve.start)} and {at(self.curve.end)}{unit}"
        told = [f"= {at(root.where, 12)}{unit}" + " (touches)" * root.touching for root in self.roots]
        told += [f"from {at(a, 8)} to {at(b, 8)}{unit}" for a, b in self.throughout]
        if not told:
            seen = [sample.y for sample in self.curve.samples if sample.is_known]
            least_most = f"it is from {value(min(seen))} to {value(max(seen))}{of_value}"
            return f"{asked} for no {self.varied} {between}: {least_most}."
        return f"{asked} for {self.varied} {', '.join(told)}, and for no other {between}."

    def to_json(self) -> dict[str, Any]:
        """As plain data, in SI."""
        roots = [
            {"where": float(r.where), "where_error": r.where.error, "found": float(r.found), "found_error": r.found.error,
             "touching": r.touching}
            for r in self.roots
        ]  # fmt: skip
        breaks = [{"where": each.x, "below": each.below.y, "above": each.above.y, "reason": each.reason} for each in self.breaks]
        asked = {"of": self.of, "is": self.target, "vary": self.varied, "within": [self.curve.start, self.curve.end]}
        told = {"sentence": self.sentence, "looked_at": self.curve.sentence(self.units[0]), "resolution": self.curve.resolution}
        return (
            asked | told | {"roots": roots, "throughout": self.throughout, "breaks": breaks, "unresolved": self.curve.unresolved}
        )

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        yield self.sentence
        at, value = (partial(figure_in, each) for each in self.units)
        unit, of_value = (f" [{shown(each).unit}]" if each else "" for each in self.units)
        if self.roots:
            heads = [f"{self.varied}{unit}", "error", f"found{of_value}", ""]
            rows = [
                (at(r.where, 12), f"{r.where.error / shown(self.units[0]).size:.0e}", value(r.found, 10), "touches" * r.touching)
                for r in self.roots
            ]
            yield table("", heads, rows, heads[:3], edge=True)
        yield from (f"At {self.varied} = {at(each.x, 10)} it {_broken(each, self.units[1])}." for each in self.breaks)
        yield f"Looked at {self.curve.sentence(self.units[0])}."


def _broken(each: Break, unit: str) -> str:
    jumps = each.below.is_known and each.above.is_known
    what = f"jumps from {figure_in(unit, each.below.y)} to {figure_in(unit, each.above.y)}" if jumps else "begins or ends"
    return f"{what}: {each.reason}"


def find(respond: Response, target: Any, within: tuple[Any, Any], points: int = 33) -> Found:
    """All values of what is varied ``within`` two for which a quantity is the ``target``; numbers are SI or quantities (``"30 deg"``).
    ``points`` is the first grid. Raises ``ValueError`` where there is no motion at all to ask."""
    goal, curve = respond.target(target), followed(respond, within, points)
    level = max(curve.level, 1e-9 * abs(goal))
    throughout = list(_throughout(curve, goal, level))
    inside = lambda x: any(a <= x <= b for a, b in throughout)
    found = [root for root in roots(respond, curve, goal) if not inside(float(root.where))]
    return Found(respond.of, goal, respond.varied, (respond.unit, respond.quantity_unit), curve, found, throughout)


def followed(respond: Response, within: tuple[Any, Any], points: int) -> Curve:
    """The quantity between two places. Raises ``ValueError`` where they are none, or where nothing has a value for one reason."""
    start, end = map(respond.place, within)
    if not start < end or points < 4:
        raise ValueError(
            f"{respond.varied} is looked at from {start:g} to {end:g}, at {points} places: give the lower bound first, and 4 places or more"
        )
    curve = Curve(respond, start, end, points)
    reasons = {sample.why for sample in curve.samples}
    if len(reasons) == 1 and "" not in reasons:
        raise ValueError(f"{respond.of} has no value for any {respond.varied} from {start:g} to {end:g}: {reasons.pop()}")
    return curve


def _throughout(curve: Curve, goal: float, level: float) -> Iterator[tuple[float, float]]:
    """The intervals, of at least four samples, on which the quantity is the target to its error; their ends to the last digits."""

    def edge(inside: float, outside: float) -> float:
        while abs(outside - inside) > 1e-12 * (curve.end - curve.start):
            amid = (inside + outside) / 2
            inside, outside = (amid, outside) if abs(curve.respond(amid).y - goal) <= level else (inside, amid)
        return inside

    for piece in curve.pieces:
        met = [abs(sample.y - goal) <= level for sample in piece]
        for is_met, group in groupby(range(len(piece)), key=met.__getitem__):
            places = list(group)
            first, last = places[0], places[-1]
            if not is_met or last - first < 3:
                continue
            start = edge(piece[first].x, piece[first - 1].x) if first else piece[first].x
            yield start, edge(piece[last].x, piece[last + 1].x) if last + 1 < len(piece) else piece[last].x


def roots(respond: Response, curve: Curve, goal: float) -> Iterator[Root]:
    """Where a quantity that was followed is the ``goal``, in order: at changes of sign, and where it touches it."""
    found = list[Root]()
    for piece in curve.pieces:
        for low, high in pairwise(piece):
            if (low.y - goal) * (high.y - goal) <= 0:
                found.append(_crossing(respond, low, high, goal))
        for before, amid, after in zip(piece, piece[1:], piece[2:], strict=False):
            signs = {each.y > goal for each in (before, amid, after)}
            if len(signs) == 1 and _may_reach(before, amid, after, goal):
                found += _at_extreme(respond, before, amid, after, goal)
    last = None
    for root in sorted(found, key=lambda root: root.where):
        # Where two runs part, a place has an infinite error; that makes it no other's double.
        apart = 2 * root.where.error if isfinite(root.where.error) else 0.0
        if last is None or float(root.where) - last > apart + 1e-12 * (curve.end - curve.start):
            yield root
        last = float(root.where)


def _crossing(respond: Response, low: Sample, high: Sample, goal: float) -> Root:
    from scipy.optimize import brentq

    x = low.x if low.y == goal else high.x if high.y == goal else None
    x = brentq(lambda x: respond(x).y - goal, low.x, high.x, xtol=1e-300, rtol=1e-15) if x is None else x
    found, h = respond.known(x), _APART * (high.x - low.x)
    beside = [respond(place) for place in (max(x - h, low.x), min(x + h, high.x))]
    slope = abs(beside[1].y - beside[0].y) / (beside[1].x - beside[0].x)
    error = (found.error + abs(found - goal)) / slope if slope else high.x - low.x
    return Root(Known(x, error, max(abs(low.x), abs(high.x))), found)


def _may_reach(before: Sample, amid: Sample, after: Sample, goal: float) -> bool:
    """Whether the quantity comes nearest to the target beside ``amid``, and may reach it there."""
    gaps = [abs(each.y - goal) for each in (before, amid, after)]
    return gaps[1] <= min(gaps[0], gaps[2]) and gaps[1] <= max(gaps) - gaps[1]


def _at_extreme(respond: Response, before: Sample, amid: Sample, after: Sample, goal: float) -> Iterator[Root]:
    """The roots beside an extreme that lies beyond the target, or on it."""
    sign = 1.0 if amid.y > goal else -1.0
    x, y, bend = lowest(lambda x: sign * (respond(x).y - goal), before.x, amid.x, after.x)
    if y < 0:
        yield from (_crossing(respond, *sorted((end, respond(x)), key=lambda each: each.x), goal) for end in (before, after))
        return
    found = respond.known(x)
    if abs(found - goal) <= _TOUCHES * found.error:
        error = ((found.error + abs(found - goal)) / bend) ** 0.5 if bend else after.x - before.x
        yield Root(Known(x, error, max(abs(before.x), abs(after.x))), found, True)


def lowest(value: Any, low: float, amid: float, high: float) -> tuple[float, float, float]:
    """Place and value of a minimum between three places, and half the second derivative there (Brent)."""
    from scipy.optimize import minimize_scalar

    if value(amid) < min(value(low), value(high)):
        best = minimize_scalar(value, bracket=(low, amid, high), method="brent", options={"xtol": 1e-9})
    else:
        best = minimize_scalar(value, bounds=(low, high), method="bounded", options={"xatol": 1e-9 * (high - low)})
    x, h = float(best.x), 0.25 * min(amid - low, high - amid)
    bend = (value(min(x + h, high)) + value(max(x - h, low)) - 2 * float(best.fun)) / (2 * h**2)
    return x, float(best.fun), max(bend, 0.0)
