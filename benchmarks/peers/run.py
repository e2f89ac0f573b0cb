"""freebody beside its peers, each at the loosest setting that reaches the same error; what is compared, and how, is on the page it writes.

    uv run --project benchmarks/peers python benchmarks/peers/run.py [--write] [ROW …]

The first time it builds freebody and brings the peers of pyproject.toml. ``--write`` writes docs/peers.md; without it the page is printed.
Another peer is a file with a function for each row that it can do, which yields entries, and its name in PEERS.
"""

import argparse
import importlib
import os
import platform
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from itertools import chain
from pathlib import Path
from statistics import median
from time import perf_counter, process_time
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs/peers.md"
PEERS = ("ours", "numba_peer", "sympy_peer", "pinocchio_peer", "mujoco_peer", "exudyn_peer", "jax_peer", "pymunk_peer")
PACKAGES = ("freebody", "numpy", "scipy", "sympy", "numba", "pin", "mujoco", "exudyn", "jax", "pymunk")
ROUNDS, SHORT, LONG = 5, 0.05, 25.0  # s: what a turn takes at least; a call that took longer is the last that is tried


@dataclass(frozen=True)
class Row:
    """What is asked; the answers are those of ``problems``, by their name."""

    key: str
    title: str
    reference: str
    wanted: float
    unit: str
    says: str
    arguments: tuple[int, ...] = ()
    threads: bool = False

    @property
    def offered(self) -> str:
        """The name of the peers' functions."""
        return self.key.split("-")[0]

    def error(self, found: np.ndarray) -> float:
        """The largest: of angles and places as they are, of the rest relative to the largest number, of Andrews' angles each to itself."""
        right = answer(self.reference, self.arguments).ravel()
        scale = {"": np.abs(right).max(), "each": np.abs(right)}.get(self.unit, 1.0)
        size = min(found.size, right.size)
        wrong = np.abs(found.ravel()[:size] - right[:size]) / (scale[:size] if np.ndim(scale) else scale)
        return float(wrong.max()) if np.isfinite(wrong).all() else np.inf


@cache
def answer(name: str, arguments: tuple[int, ...]) -> np.ndarray:
    import problems

    found = getattr(problems, name)
    return np.array([*found.values()]) if isinstance(found, dict) else np.asarray(found(*arguments))


BARS = "Accelerations, and the force at each hinge, of uniform bars that hang from one another, in a state; what a call of Python takes."
PENDULUM = "Two uniform bars of 1 m swing from rest for 10 s; the error is that of their angles at the end."
LINKAGE = "Crank 1 m, coupler 2.5 m and rocker 2 m on pivots 2 m apart fall from rest, for 10 s; the error is that of their angles at the end."
ROWS = (
    *(Row(f"chain-{n}", f"One instant of a chain of {n} bars", "chain", 1e-8, "", BARS, (n,)) for n in (2, 10, 100)),
    *(
        Row(f"{key}-{wanted:g}", f"{title}, 10 s to {wanted:g} rad", f"{key}_end", wanted, "rad", says)
        for key, title, says in (("double_pendulum", "Double pendulum", PENDULUM), ("four_bar", "Four-bar linkage", LINKAGE))
        for wanted in (1e-6, 5e-9)
    ),
    Row(
        "andrews",
        "Andrews' squeezing mechanism, 0.03 s to 1e-11",
        "ANDREWS",
        1e-11,
        "each",
        "Seven bodies, three loops (IVP test set, Bari); the error is the largest of the seven angles' relative ones at the end, beside digits "
        "of quadruple precision, β = 15.810771195153707 among them.",
    ),
    Row(
        "slider_cranks",
        "1000 slider-cranks for a turn, all reactions, to 1e-8",
        "slider_cranks_seen",
        1e-8,
        "",
        "Rods of 0.25 to 0.45 m, the crank of 0.1 m at 20 rad/s to begin with, and no drive. Asked for are the reactions of all joints at 101 "
        "times; the error is that of those of the first and last mechanism, relative to the largest.",
        threads=True,
    ),
    Row(
        "pendulums",
        "10 000 double pendulums for 1 s by RK4, steps of 1 ms",
        "pendulums",
        1e-7,
        "rad",
        "The same method and steps for all; the error is that of the angles of five of them at the end.",
        threads=True,
    ),
    Row(
        "block",
        "A block is pushed up a slope and sticks, to 1 mm",
        "block",
        1e-3,
        "m",
        "A box at 3 m/s on a slope of 0.2 rad with µ = 0.4; the error is that of where it is while it slides, after 0.25 s, and where it sticks, "
        "after 5 s, beside the closed form.",
    ),
)
LEFT_OUT = """\
- Exudyn at one instant: it has no call for that; the least is to start a solver.
- Exudyn and MuJoCo on Andrews' mechanism: with loops of second order, or soft ones, 1e-11 is out of reach. So are reactions to 1e-8 for MuJoCo on
  the slider-cranks: they are wrong by 1e-3 of the largest, whatever the step.
- Pinocchio on Andrews' mechanism and on the slider-cranks: it would be the same constraintDynamics with SciPy's DOP853 as on the four-bar.
- A pile of boxes, and a box that bounces: what happens depends on the law of impact, each program has its own, and for none but the simplest
  is the answer known.
"""


@dataclass
class Tuned:
    """An entry at the first setting that is near enough, or at the best one."""

    entry: Any
    setting: float
    error: float = np.inf
    reached: bool = False
    whole: bool = False
    """Whether it answers all that is asked."""


def tuned(entry, row: Row) -> Tuned:
    best = Tuned(entry, entry.settings[0])
    for setting in entry.settings:
        began = process_time()
        found = np.asarray(entry.read(entry.solve(setting)))
        if (error := row.error(found)) < best.error:
            whole = found.size >= answer(row.reference, row.arguments).size or entry.share < 1
            best = Tuned(entry, setting, error, error <= row.wanted, whole)
        if best.reached or process_time() - began > LONG:
            break
    return best


def seconds(entry, setting: float, clock: Callable[[], float]) -> float:
    """Of one call, over so many that they take a while; as much as the whole row would take."""
    count, began = 0, clock()
    while (passed := clock() - began) < SHORT or not count:
        entry.solve(setting)
        count += 1
    return passed / count / entry.share


def measured(row: Row, peers) -> tuple[list[str], dict[str, float]]:
    """The table of a row, and the ratios of those that answer all of it."""
    from entry import TOLERANCES

    offered = chain.from_iterable(getattr(peer, row.offered)(*row.arguments) for peer in peers if hasattr(peer, row.offered))
    found = [tuned(entry, row) for entry in offered]
    clock = perf_counter if row.threads else process_time
    turns = np.array([[seconds(each.entry, each.setting, clock) for each in found] for _ in range(ROUNDS)])
    lines, whole = ["| program | error | time | time / freebody's | what it does |", "|---|---|---|---|---|"], {}
    for i, each in enumerate(found):
        entry, ratios = each.entry, turns[:, i] / turns[:, 0]
        ratio = f"{figure(median(ratios))} ({figure(ratios.min())} … {figure(ratios.max())})" if i else "1"
        kind = "tolerance" if entry.settings is TOLERANCES else "step"
        at = f"; {kind} {each.setting:.2g}" if len(entry.settings) > 1 else ""
        missed = "" if each.reached else "**not reached**; "
        lines.append(f"| {entry.name} | {each.error:.1e} | {spelled(median(turns[:, i]))} | {ratio} | {missed}{entry.says}{at} |")
        if each.reached and each.whole:
            whole[entry.name.split(",")[0]] = median(ratios)
    return lines, whole


def in_short(rows: dict[str, dict[str, float]]) -> list[str]:
    """Of each row, the ratios of all programs."""
    programs = [name for name in dict.fromkeys(chain.from_iterable(rows.values())) if name != "freebody"]
    lines = [f"| | {' | '.join(programs)} |", "|---" * (len(programs) + 1) + "|"]
    for title, found in rows.items():
        cells = [figure(found[each]) if each in found else "" for each in programs]
        cells = [f"**{cell}**" if cell and found[each] < 1 else cell for each, cell in zip(programs, cells, strict=True)]
        lines.append(f"| {title} | {' | '.join(cells)} |")
    return lines


def figure(x: float) -> str:
    """With two digits."""
    return f"{x:.2g}" if x < 100 else f"{float(f'{x:.2g}'):.0f}"


def spelled(t: float) -> str:
    size, unit = next((size, unit) for size, unit in ((1, "s"), (1e-3, "ms"), (1e-6, "µs")) if t >= size or size == 1e-6)
    return f"{t / size:.3g} {unit}" if t / size < 1000 else f"{t / size:.0f} {unit}"


def machine() -> str:
    """Its processor as far as it matters for speed."""
    text = Path("/proc/cpuinfo").read_text() if Path("/proc/cpuinfo").exists() else ""
    about = dict(line.split("\t: ", 1) for line in text.replace("\t\t", "\t").split("\n\n")[0].splitlines() if "\t: " in line)
    kept = [flag for flag in ("avx", "avx2", "fma", "avx512f") if flag in about.get("flags", "").split()]
    return f"{about.get('model name', platform.processor())}, {os.cpu_count()} cores, {' '.join(kept)}; Python {platform.python_version()}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="*", metavar="ROW", help=", ".join(row.key for row in ROWS))
    parser.add_argument("--write", action="store_true", help="write docs/peers.md")
    asked = parser.parse_args()
    sys.path[:0] = [str(HERE), str(HERE.parent)]
    peers = [importlib.import_module(name) for name in PEERS]
    tables, ratios = [], {}
    for row in ROWS:
        if not asked.rows or row.key in asked.rows:
            print(row.key, file=sys.stderr, flush=True)
            table, ratios[row.title] = measured(row, peers)
            tables += [f"## {row.title}\n", f"{row.says}\n", *table, ""]
    versions = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    head = [INTRODUCTION, f"{machine()}.\n\n{versions}.\n", "## In short\n", SHORTLY, *in_short(ratios), ""]
    text = "\n".join([*head, *tables, "## What is left out\n", LEFT_OUT])
    PAGE.write_text(text, encoding="utf-8") if asked.write else print(text)


SHORTLY = """\
Times over freebody's, where a program answers all that is asked as exactly as it is asked; **bold** where freebody is slower. The first of freebody's
ways in each table is the one that stands for it.
"""
INTRODUCTION = f"""\
# Beside its peers

`uv run --project benchmarks/peers python benchmarks/peers/run.py --write` wrote this page; its environment has the peers at fixed versions.

- Equal accuracy first: each program takes the loosest tolerance or step at which its error is below the row's. Errors are beside a solution by
  equations written by hand (extrapolated in numbers of 80 bits, or to 30 digits) or a closed form, which share nothing with freebody.
- Then time: the programs take turns, {ROUNDS} rounds; the ratio is the median of the rounds, with the least and the greatest. Above 1
  freebody is faster. It is a processor's time, in rows on many threads that of a clock; in a shared machine times are noisy, ratios less so.
- What is made once is not counted: reading models, deriving and compiling equations, and the first call.
- Ratios are of one run; rows may be renewed at different times, so times of different rows are not to be compared.
- What is "by hand" or derived by SymPy is a program for the one mechanism alone; freebody, Pinocchio, MuJoCo and Exudyn take any.
- The rows of one instant and of the slider-cranks ask for reactions; the other motions do not, where freebody solves them afterwards.
"""


if __name__ == "__main__":
    main()
