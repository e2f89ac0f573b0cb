"""How small the sets of balance equations are that are chosen, and how many of their points and directions have names.

    python benchmarks/sets.py [WORD …]

The targets and the brute force over sets of bodies, points, directions and unknowns are in tests/balances/by_brute_force.py; words choose
among the targets.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / "tests" / folder) for folder in ("balances", ".")]

from by_brute_force import TARGETS, asked, fewest
from rich.console import Console
from rich.table import Table

from freebody.equations.balances.smallest import smallest_set
from freebody.equations.balances.system import problem


def main() -> None:
    """Print every target with its set, and the shares."""
    table, beaten, equations = Table("target", "chosen", "fewest", "balances"), 0, []
    for target in (each for each in TARGETS if not sys.argv[1:] or any(word in each for word in sys.argv[1:])):
        given, points, wanted = asked(target)
        found = smallest_set(wanted, given, points).equations
        own = problem(given, wanted)
        least = fewest(own, own.place(wanted), len(found), points)
        beaten += least != len(found)
        equations.append(found)
        table.add_row(target, str(len(found)), str(least), "\n".join(each.title for each in found))
    Console().print(table)
    every = [each for found in equations for each in found]
    named = sum(not each.constructed for each in every)
    whole = sum(not any(each.constructed for each in found) for found in equations)
    print(
        f"{len(equations)} targets, {beaten} beaten; {named} of {len(every)} points and directions have names, {whole} sets nothing else"
    )


if __name__ == "__main__":
    main()
