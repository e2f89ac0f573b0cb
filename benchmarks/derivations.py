"""Time and length of derivations of chains of bars, open and closed.

    python benchmarks/derivations.py [SIZE …]

Each is derived warm, from the loaded model to its text, as ``freebody equations`` does: a chain that hangs from a pin, and one whose end is
pinned, too. The best of three is printed, and the lines of the text for each bar.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from rich.console import Console
from rich.table import Table

import freebody as fb

SIZES = (3, 6, 10, 20)
ROUNDS = 3
ALLOWED = {3: 0.2, 10: 2.0, 20: 5.0}  # s

CHAIN = """
freebody: 1
name: {form} chain of {number} bars
parameters: {{N: {number}, l: 1 m, m: 1 kg}}
ground: {{points: {{D: [{x} m, {y} m]}}}}
bodies:
  bar[i = 1 .. N]: {{shape: rod, length: l, mass: m}}
joints:
  pin[1]: {{type: hinge, of: [ground.O, 'bar[1].start'], coordinate: 'phi[1]'}}
  pin[i = 2 .. N]: {{type: hinge, of: ['bar[i-1].end', 'bar[i].start'], coordinate: {{name: 'phi[i]', absolute: true}}}}
"""


def chain(number: int, *, closed: bool) -> fb.Mechanism:
    """So many equal bars from a pin, in an arc; the end of the last is pinned where it is, if ``closed``."""
    angles = np.linspace(1.2, -1.0, number)
    text = CHAIN.format(form="closed" if closed else "open", number=number, x=np.cos(angles).sum(), y=np.sin(angles).sum())
    text += "  last: {type: hinge, of: [ground.D, 'bar[N].end']}\n" if closed else ""
    start = ", ".join(f"'phi[{i}]': {angle} rad" for i, angle in enumerate(angles, 1))
    return fb.Mechanism.loads(text + f"initial: {{guess: {{{start}}}}}\n" if closed else text + f"initial: {{{start}}}\n")


def derivation(mechanism: fb.Mechanism) -> tuple[float, int]:
    """Processor seconds of the best of some rounds, and lines of the text."""
    taken = []
    for _ in range(ROUNDS):
        began = time.process_time()
        text = mechanism.equations().text()
        taken.append(time.process_time() - began)
    return min(taken), len(text.splitlines())


def main() -> None:
    """Print the table."""
    derivation(chain(2, closed=False))
    table = Table("bars", "chain", "time, s", "allowed, s", "lines", "lines/bar")
    for number in map(int, sys.argv[1:] or SIZES):
        for closed in (False, True):
            seconds, lines = derivation(chain(number, closed=closed))
            allowed = str(ALLOWED.get(number, ""))
            kind = "closed" if closed else "open"
            table.add_row(str(number), kind, f"{seconds:.2f}", allowed, str(lines), f"{lines / number:.0f}")
    Console().print(table)


if __name__ == "__main__":
    main()
