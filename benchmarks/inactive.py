"""What the parts of a mechanism cost that do nothing: a motion with them, over the same motion without.

    python benchmarks/inactive.py

Chains of bars swing for a while with a floor below that they never reach, with friction; the double pendulum also with stops and an
event that stay away. With and without take turns, and the ratio is the median over the rounds.
"""

from collections.abc import Callable
from statistics import median, quantiles
from time import process_time

from rich.console import Console
from rich.table import Table

import freebody as fb
from freebody.core import OutcomeKind

ROUNDS = 9


def chain(n: int) -> fb.Mechanism:
    """``n`` uniform bars in series, the first on the ground, let go with a bend at each hinge."""
    made = fb.Mechanism(f"chain of {n}", gravity="9.81 m/s^2")
    for i in range(n):
        made.body(f"b{i}", shape="rod", mass="1 kg", length="1 m")
        made.hinge(f"b{i - 1}.end" if i else "ground.O", f"b{i}.start", name=f"h{i}", coordinate=f"th{i}")
    made.initial(at_rest=True, **{f"th{i}": -0.57 if i == 0 else 0.3 / n for i in range(n)})
    return made


def with_floor(n: int) -> fb.Mechanism:
    """The chain over a floor three bars below its reach."""
    made = chain(n)
    made.ground.point("F", [0, -(n + 3)])
    made.ground.line("floor", made.ground.F)
    made.contact("floor", f"b{n - 1}.end", "ground.floor", friction=0.3)
    return made


def with_stops(n: int) -> fb.Mechanism:
    """The chain with stops of its first hinge far from where it swings."""
    made = chain(n)
    made.stop("far", "th0", least=-60, most=60)
    return made


def with_event(n: int) -> fb.Mechanism:
    """The chain with an event that never comes."""
    made = chain(n)
    made.event("never", when="th0 - 60", then="stop")
    return made


def motion(made: fb.Mechanism, until: float) -> Callable[[], float]:
    """What carries it to ``until``, and tells the seconds that this took."""
    compiled, (start, _) = made.compile(), made.start()

    def timed() -> float:
        began = process_time()
        run = compiled.simulate(start, until, rtol=1e-9)
        taken = process_time() - began
        assert run.outcome.name is OutcomeKind.COMPLETED and not run.changes
        return taken

    return timed


def main() -> None:
    table = Table("motion", "without [ms]", "with [ms]", "ratio", "quartiles")
    parts = [("floor", with_floor, 2, 10.0), ("floor", with_floor, 10, 2.0), ("floor", with_floor, 60, 0.5),
             ("stops", with_stops, 2, 10.0), ("event", with_event, 2, 10.0)]  # fmt: skip
    for name, added, n, until in parts:
        plain, loaded = motion(chain(n), until), motion(added(n), until)
        turns = [(plain(), loaded()) for _ in range(ROUNDS)]
        ratios = [b / a for a, b in turns]
        low, _, high = quantiles(ratios, n=4)
        times = (f"{1e3 * median(each):.2f}" for each in zip(*turns, strict=True))
        table.add_row(f"{n} bars, {name}", *times, f"{median(ratios):.2f}", f"{low:.2f} to {high:.2f}")
    Console().print(table)


if __name__ == "__main__":
    main()
