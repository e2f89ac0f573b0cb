"""Sets of balance equations as text."""

from __future__ import annotations

import math
from collections.abc import Mapping

from freebody.balances.equation import BalanceEquation
from freebody.balances.minimal import MinimalForm
from freebody.balances.smallest import SmallestSet, VirtualPower
from freebody.tables import figure

ROUND_OFF = 1e-14
"""Part of the largest coefficient of an equation below which one is 0 at this state."""
COUNT = ("no", "one", "two", "three", "four", "five")


def show(found: SmallestSet | MinimalForm) -> str:
    """A set as text: each equation with its bodies, its point or direction, what drops out and why; then the numbers."""
    return _smallest(found) if isinstance(found, SmallestSet) else _minimal(found)


def _smallest(found: SmallestSet) -> str:
    names = ", ".join(found.values)
    if found.virtual:
        lines = [
            f"{found.wanted} takes more than four balance equations; one of virtual power gives it:",
            "",
            *_virtual(found.virtual),
        ]
    else:
        number = len(found.equations)
        plural = "balance equation gives" if number == 1 else f"balance equations in {names} give"
        lines = [f"{COUNT[number].capitalize()} {plural} {found.wanted}:"]
        for i, equation in enumerate(found.equations, 1):
            lines += ["", *_equation(i, equation)]
    lines += ["", *(f"{name} = {figure(value)}" for name, value in found.values.items())]
    lines.append(f"differs from the full solve by {found.check:.1e}")
    if found.known_motion:
        lines.append("the accelerations are taken as known")
    if not found.exact:
        lines.append("not every set of bodies was tried: there are too many")
    if not found.structural:
        lines.append("seen at this state only: something may drop out here that does not in general")
    return "\n".join(lines)


def _minimal(found: MinimalForm) -> str:
    names = ", ".join([*found.coordinates, *found.forces, *found.rubbing])
    if not names:
        return "Motions and loops prescribe every acceleration: there is no equation of motion."
    others = "other reactions" if found.rubbing else "reactions"
    lines = [f"Minimal form in {names}, without {others}:"]
    if found.stays or not found.equations:
        stay = f"here {', '.join(found.stays)}" if found.stays else "and more are not worth it"
        lines = [f"No set in {names} alone: {fewest_words(found)}, {stay}."]
    for i, equation in enumerate(found.equations, 1):
        lines += ["", *_equation(i, equation)]
    return "\n".join(lines)


def fewest_words(found: MinimalForm) -> str:
    """How many reactions stay in every set of balances, and of which sets of bodies that was shown."""
    some = f"{found.groups} connected sets of bodies"
    tried = f"all {some} were tried" if found.exact else f"{some} were tried, there are too many to try all: this is no proof"
    stay = "reaction stays" if found.least == 1 else "reactions stay"
    return f"at least {COUNT[found.least]} {stay} in every set of balances ({tried}, with every point and direction)"


def _equation(number: int, equation: BalanceEquation) -> list[str]:
    where = "at" if equation.kind == "AMB" else "direction"
    x, y = equation.at
    title = f"{number}. {equation.title}"
    if equation.constructed:
        title += f" ({where} {figure(x)}, {figure(y)})"
    unit = "N·m" if equation.kind == "AMB" else "N"
    lines = [title, f"   {_sides(equation.coefficients, equation.right)} {unit}"]
    return lines + [f"   {', '.join(item.unknowns)}: {item.why}" for item in equation.dropped]


def _sides(coefficients: Mapping[str, float], right: float) -> str:
    sign = -1 if all(value < 0 for value in coefficients.values()) else 1
    least = ROUND_OFF * max(map(abs, coefficients.values()), default=0.0)
    terms = [_term(sign * value if abs(value) > least else 0.0, name) for name, value in coefficients.items()]
    return f"{' '.join(terms).removeprefix('+ ')} = {figure(sign * right + 0.0)}"


def _term(value: float, name: str) -> str:
    size = "" if math.isclose(abs(value), 1.0, rel_tol=1e-12) else f"{figure(abs(value))} "
    return f"{'-' if value < 0 else '+'} {size}{name}"


def _virtual(found: VirtualPower) -> list[str]:
    lines = [found.title]
    for body, (vx, vy, turn) in found.motion.items():
        lines.append(f"   {body}: G moves with ({figure(vx)}, {figure(vy)}), turns with {figure(turn)}")
    return [*lines, f"   {found.unknown} = {figure(found.right)}"]
