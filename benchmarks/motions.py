"""A motion of 10 s beside the same by hand: a double pendulum and a four-bar in C++, with the same method and dense output.

    python benchmarks/motions.py

Each is followed at the loosest tolerance that leaves an error of 5e-9 rad at the end, by `taylor` 1e-12; then they take turns, and the ratio
is the median over the rounds. By hand it is the same DOP853 in all rows.
"""

import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median, quantiles
from time import process_time

import numpy as np
from rich.console import Console
from rich.table import Table

import freebody as fb

ROUNDS, REPEATS, END = 9, 20, 10.0
SOURCE, FLAGS = Path(__file__).with_name("motions.cpp"), ("-O3", "-march=native", "-ffp-contract=off", "-std=c++17")
TOLERANCES = 10.0 ** -np.arange(7, 13, 0.5)
TIGHT = 1e-13


def double_pendulum() -> fb.Mechanism:
    """Two uniform bars."""
    made = fb.Mechanism("pendulum", gravity="9.81 m/s^2")
    for name, pin in (("a", "ground.O"), ("b", "a.end")):
        made.body(name, shape="rod", mass="1 kg", length="1 m")
        made.hinge(pin, f"{name}.start", name=f"{name} hinge", coordinate=f"q{name}")
    made.initial(at_rest=True, qa=-0.57, qb=-0.5)
    return made


def four_bar() -> fb.Mechanism:
    """A crank that falls to and fro on a coupler and a rocker."""
    made = fb.Mechanism("four_bar", gravity="9.81 m/s^2")
    for name, mass, length in (("a", 1, 1), ("b", 2, 2.5), ("c", 1.5, 2)):
        made.body(name, shape="rod", mass=f"{mass} kg", length=f"{length} m")
    made.ground.point("D", [2, 0])
    for pins in (("ground.O", "a.start"), ("a.end", "b.start"), ("b.end", "c.end"), ("ground.D", "c.start")):
        made.hinge(*pins)
    made.initial(at_rest=True, points={"a.end": [0.6, 0.8]})
    return made


def ours(made: fb.Mechanism, method: str) -> tuple[np.ndarray, Callable[[float], tuple[float, np.ndarray]]]:
    """Angles and their rates at the start, and what follows the motion at a tolerance: seconds, and the angles at the end."""
    compiled, (start, _) = made.compile(), made.start()
    angles = [f"angle({body})" for body in made.model.bodies]

    def follow(rtol: float) -> tuple[float, np.ndarray]:
        began = process_time()
        for _ in range(REPEATS):
            run = compiled.simulate(start, END, rtol=rtol, method=method)
        return (process_time() - began) / REPEATS, np.array(compiled.evaluate(angles, run.end))

    return np.array(compiled.evaluate([*angles, *(f"rate({angle})" for angle in angles)], start)), follow


def by_hand(program: Path, name: str, y: np.ndarray) -> Callable[[float], tuple[float, np.ndarray]]:
    """The same of the compiled yardstick."""

    def follow(rtol: float) -> tuple[float, np.ndarray]:
        command = [program, name, repr(float(rtol)), str(REPEATS), *(repr(float(x)) for x in y)]
        seconds, _, *end = map(float, subprocess.run(command, check=True, capture_output=True, text=True).stdout.split())
        return seconds, np.array(end[: len(y) // 2])

    return follow


def main() -> None:
    table = Table(
        "motion", "method", "by hand [ms]", "freebody [ms]", "ratio", "quartiles", "errors [rad]", title=" ".join(["g++", *FLAGS])
    )
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "motions"
        subprocess.run(["g++", *FLAGS, "-o", program, SOURCE], check=True)
        for made, method, most in (
            (double_pendulum(), "dop853", 5e-9),
            (double_pendulum(), "taylor", 1e-12),
            (four_bar(), "dop853", 5e-9),
        ):
            y, mine = ours(made, method)
            both = [by_hand(program, made.model.name, y), mine]
            exact = mine(TIGHT)[1]
            errors = [{rtol: float(np.abs(follow(rtol)[1] - exact).max()) for rtol in TOLERANCES} for follow in both]
            chosen = [next(rtol for rtol, error in found.items() if error <= most) for found in errors]
            turns = [[follow(rtol)[0] for follow, rtol in zip(both, chosen, strict=True)] for _ in range(ROUNDS)]
            ratios = [b / a for a, b in turns]
            low, _, high = quantiles(ratios, n=4)
            times = (f"{1e3 * median(each):.2f}" for each in zip(*turns, strict=True))
            reached = ", ".join(f"{found[rtol]:.0e}" for found, rtol in zip(errors, chosen, strict=True))
            table.add_row(made.model.name, method, *times, f"{median(ratios):.1f}", f"{low:.1f} to {high:.1f}", reached)
    Console().print(table)


if __name__ == "__main__":
    main()
