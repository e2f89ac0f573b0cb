"""Which bodies can be cut free together: the connected sets."""

from __future__ import annotations

from freebody.equations.balances.system import Problem

Group = tuple[int, ...]
MOST = 255
"""Sets beyond which only small ones, and those that one cut leaves, are looked at: all that eight bodies can have."""


def groups(problem: Problem, known: bool = False) -> tuple[list[Group], bool]:
    """Connected sets of bodies, by their places, small ones first; and whether these are all. ``known``: known loads, as those
    of springs, connect as well."""
    near: dict[int, set[int]] = {i: set() for i in range(len(problem.bodies))}
    for load in problem.free.loads:
        touched = {problem.bodies.index(part.body) for part in load.on if part.body in problem.bodies}
        for body in touched if load.unknown or known else ():
            near[body] |= touched - {body}
    found = {frozenset([i]) for i in near}
    layer, every = set(found), True
    while layer and every:
        layer = {group | {other} for group in layer for body in group for other in near[body] - group} - found
        every = len(found) + len(layer) <= MOST
        found |= layer if every else _sides(near)
    return sorted((tuple(sorted(group)) for group in found), key=lambda group: (len(group), group)), every


def _sides(near: dict[int, set[int]]) -> set[frozenset[int]]:
    """What is left together when one joint between two bodies is cut, or nothing is."""
    sides = set()
    for cut in [set(), *({a, b} for a in near for b in near[a] if a < b)]:
        for start in near:
            found, edge = {start}, [start]
            while edge:
                body = edge.pop()
                new = {other for other in near[body] - found if {body, other} != cut}
                found |= new
                edge += new
            sides.add(frozenset(found))
    return sides
