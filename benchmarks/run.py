"""Cost of one acceleration solve with all reactions, beside a plain sweep in C on the same machine in the same run.

Both solve a hanging chain of N hinged uniform bars. They take turns, so that what else the machine does hits both;
the ratio is the median over the rounds.
"""

import subprocess
import tempfile
from pathlib import Path
from statistics import linear_regression, median

import numpy as np
from rich.console import Console
from rich.table import Table

from freebody import _core

SIZES = (10, 100, 1000, 10000)
ROUNDS = 11
LINKS_PER_TURN = 1_000_000
SOURCE, FLAGS = Path(__file__).with_name("sweep.c"), ("-O3", "-march=native", "-ffp-contract=off")


def compile_yardstick(folder: Path) -> Path:
    """The compiled C program."""
    program = folder / "sweep"
    subprocess.run(["cc", *FLAGS, "-o", program, SOURCE, "-lm"], check=True)
    return program


def time_yardstick(program: Path, n: int, repeats: int) -> float:
    """Seconds per solve of the C sweep, which fails where its own Newton–Euler check does."""
    printed = subprocess.run([program, str(n), str(repeats)], check=True, capture_output=True, text=True).stdout
    return float(printed.split()[1])


def time_both(program: Path, n: int) -> tuple[list[float], list[float]]:
    """Seconds per solve of the C sweep and of freebody, taking turns."""
    repeats = max(1, LINKS_PER_TURN // n)
    turns = [(time_yardstick(program, n, repeats), _core.time_chain(n, repeats)) for _ in range(ROUNDS)]
    plain, ours = zip(*turns, strict=True)
    return list(plain), list(ours)


def growth(seconds: list[float]) -> float:
    """The exponent k of the best fit seconds ~ N^k."""
    return linear_regression(np.log(SIZES).tolist(), np.log(seconds).tolist()).slope


def main() -> None:
    table = Table("N", "C sweep, ns a link", "freebody, ns a link", "freebody / C", title=" ".join(["cc", *FLAGS]))
    plain_medians, our_medians = [], []
    with tempfile.TemporaryDirectory() as folder:
        program = compile_yardstick(Path(folder))
        for n in SIZES:
            plain, ours = time_both(program, n)
            plain_medians.append(median(plain))
            our_medians.append(median(ours))
            ratio = median(b / a for a, b in zip(plain, ours, strict=True))
            table.add_row(str(n), *(f"{m[-1] / n * 1e9:.1f}" for m in (plain_medians, our_medians)), f"{ratio:.2f}")
    table.add_section()
    table.add_row("growth", *(f"N^{growth(seconds):.3f}" for seconds in (plain_medians, our_medians)), "")
    Console().print(table)


if __name__ == "__main__":
    main()
