"""Cost of one instant as Python asks for it, beside the core's own: accelerations and all reactions of a chain of hinged bars.

    python benchmarks/calls.py

``at(q, u)`` is what ``Mechanism.evaluator`` gives, ``m.solve()`` the public call with its objects. They take turns. Below it a short run of
a pendulum, ``m.simulate(0.1)``, beside the core's own.
"""

import time
from collections.abc import Callable
from statistics import median

import numpy as np
from rich.console import Console
from rich.table import Table

import freebody as fb
from freebody import _core

ROUNDS = 7


def chain(n: int) -> fb.Mechanism:
    """A chain of uniform bars, the first on the ground."""
    made = fb.Mechanism("chain", gravity="9.81 m/s^2")
    for i in range(n):
        made.body(f"b{i}", shape="rod", mass="1 kg", length="1 m")
        made.hinge(f"b{i - 1}.end" if i else "ground.O", f"b{i}.start", name=f"h{i}", coordinate=f"th{i}")
    return made


def seconds(call: Callable[[], object], least: float = 0.05) -> float:
    """Of one call, over so many that they take ``least``."""
    count, began = 0, time.process_time()
    while (passed := time.process_time() - began) < least:
        call()
        count += 1
    return passed / count


def main() -> None:
    table = Table("bars", "core", "at(q, u)", "beyond the core", "m.solve()")
    for n in (2, 10, 100, 1000):
        made = chain(n)
        at, (state, _) = made.evaluator(), made.start()
        q, u = state.q + 0.1 * np.sin(np.arange(n)), 0.2 * np.cos(np.arange(n))
        calls = [lambda n=n: _core.time_chain(n, 100), lambda at=at, q=q, u=u: at(q, u), made.solve]
        turns = [(calls[0](), seconds(calls[1]), seconds(calls[2])) for _ in range(ROUNDS)]
        core, called, solved = (1e6 * median(each) for each in zip(*turns, strict=True))
        table.add_row(str(n), f"{core:.2f} µs", f"{called:.2f} µs", f"{called - core:.2f} µs", f"{solved:.0f} µs")
    Console().print(table)
    Console().print(short_run())


def short_run() -> Table:
    """A motion of 0.1 s."""
    made = chain(1)
    core, (state, _) = made.compile(), made.start(th0=1.0)
    calls = [lambda: core.mechanism.simulate(state.arrays, 0.1), lambda: made.simulate(0.1, th0=1.0)]
    turns = [[seconds(call) for call in calls] for _ in range(ROUNDS)]
    within, whole = (1e6 * median(each) for each in zip(*turns, strict=True))
    table = Table("core", "m.simulate(0.1)", "of which Python")
    table.add_row(f"{within:.1f} µs", f"{whole:.1f} µs", f"{100 * (1 - within / whole):.0f} %")
    return table


if __name__ == "__main__":
    main()
