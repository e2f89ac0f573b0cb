"""How many equations are independent is counted in the plane: two for the forces on a body, one for the moments, whatever else is stated."""

from __future__ import annotations

import random
import re

import pytest
from generated import chain

from freebody.check import Checker, Verdict
from freebody.mechanism import Mechanism

SIZES = (1, 2, 3)


def chained(links: int) -> Checker:
    """A chain of rods, with the forces at their upper ends, accelerations and arms."""
    numbers = range(1, links + 1)
    letters = {f"F{i}": f"force of p{i} on link{i}" for i in numbers} | {f"F{links + 1}": "[0, 0]"}
    letters |= {f"a{i}": f"acceleration of link{i}.G" for i in numbers}
    letters |= {f"r{i}": f"position of link{i}.end from link{i}.G" for i in numbers}
    return Checker(Mechanism.loads(chain(links, "rod")), letters)


def balances(links: int) -> list[str]:
    """Of forces, as vectors, and of moments about the mass centre, of each rod."""
    numbers = range(1, links + 1)
    forces = [f"F{i} - F{i + 1} - m{i} g j = m{i} a{i}" for i in numbers]
    return forces + [f"-r{i} × F{i} - r{i} × F{i + 1} = m{i} l{i}^2/12 theta{i}'' k" for i in numbers]


def counted(verdict: Verdict) -> tuple[int, int]:
    """Equations, and how many of them are independent."""
    assert verdict.ok, str(verdict)
    if found := re.match(r"all (\d+) true, and independent", verdict.reason):
        return int(found[1]), int(found[1])
    total, independent = map(int, re.match(r"all true; (\d+) equations, but only (\d+) of them", verdict.reason).groups())
    return total, independent


@pytest.mark.parametrize("links", SIZES)
def test_three_for_each_body(links: int) -> None:
    assert counted(chained(links).check("\n".join(balances(links)))) == (3 * links, 3 * links)


@pytest.mark.parametrize("links", SIZES)
def test_what_follows_from_others_is_not_counted_again(links: int) -> None:
    lines, rng = balances(links), random.Random(links)
    left, right = ([line.split(" = ")[side] for line in lines[:links]] for side in (0, 1))
    total = f"{' + '.join(left)} = {' + '.join(right)}"  # of the whole chain
    doubled = rng.choice(lines).replace(" = ", ") = 2 (").join(["2 (", ")"])
    found = counted(chained(links).check("\n".join([*lines, total, doubled])))
    assert found[1] == 3 * links
    assert found[0] > 3 * links


@pytest.mark.parametrize("links", SIZES)
def test_true_equations_with_an_unknown_are_never_none(links: int) -> None:
    checker, lines = chained(links), balances(links)
    for seed in range(6):
        some = random.Random(seed).sample(lines, min(len(lines), 2))
        number = sum(1 if "×" in line else 2 for line in some)
        assert counted(checker.check("\n".join([*some, "theta1'' = theta1''"])))[1] == number
