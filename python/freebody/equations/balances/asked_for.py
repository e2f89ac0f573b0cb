"""The set of balances about points and along directions that a person asks for: the bodies are chosen for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from freebody.equations.balances.candidates import Candidate, bits, of_group, plainest
from freebody.equations.balances.system import Problem, groups
from freebody.equations.balances.virtual_motions import SAME_PLACE, NamedPoints, VirtualMotion, named_motions, named_turns


def asked_for(problem: Problem, points: NamedPoints, wanted: int, about: Sequence[str]) -> list[Candidate]:
    """Balances about these points or along these directions, one for each, that hold the unknown ``wanted`` (its place) and no more
    unknowns than they are; of the bodies that do the fewest. Raises ``ValueError`` for a name of neither, or where no bodies do."""
    twists = [_named(problem, points, name) for name in about]
    every = bits(range(len(problem.unknowns)))
    found = [candidate for group in groups(problem)[0] for candidate in of_group(problem, group, twists, every)]
    ways = [[candidate for candidate in found if candidate.twist is twist] for twist in twists]
    closed = [each for each in _closed(ways, len(about)) if _holds(each, wanted) and len(plainest(each, 0)) == len(each)]
    if not closed:
        name = problem.unknowns[wanted].name
        raise ValueError(
            f"no bodies have balances about {', '.join(about)} that give {name} by themselves; leave the points to the search"
        )
    return min(closed, key=lambda each: (sum(len(c.group) for c in each), sum(c.twist.rank for c in each)))


def _named(problem: Problem, points: NamedPoints, name: str) -> VirtualMotion:
    """The motion that a point, ``B`` or ``rod.B``, or a direction, ``x`` or ``along track``, gives; of both the point."""
    shown, turns = named_motions(problem, points), named_turns(problem, points)
    shifts = [twist for twist in shown if twist.question and "along" in twist.question]
    exact = [twist for twist in turns if twist.name == name] or [t for t in shifts if t.name == name.removeprefix("along ")]
    found = exact or [twist for twist in turns if twist.name.rpartition(".")[2] == name]
    if not found or any(np.abs(twist.motion - found[0].motion).max() > SAME_PLACE for twist in found):
        known = dict.fromkeys([*(twist.name for twist in turns), *(f"along {twist.name}" for twist in shifts)])
        raise ValueError(
            f"{name!r} is {'more than one point' if found else 'no point or direction'}; there are {', '.join(known)}"
        )
    return next((twist for twist in shown if np.abs(twist.motion - found[0].motion).max() < SAME_PLACE), found[0])


def _closed(ways: Sequence[Sequence[Candidate]], most: int) -> Iterator[list[Candidate]]:
    """One of each, with at most so many unknowns together."""
    made: list[tuple[list[Candidate], int]] = [([], 0)]
    for way in ways:
        made = [([*each, c], held | c.support) for each, held in made for c in way if (held | c.support).bit_count() <= most]
    return (each for each, _ in made)


def _holds(equations: Sequence[Candidate], wanted: int) -> bool:
    return any(equation.support >> wanted & 1 for equation in equations)
