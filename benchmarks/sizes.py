"""From a file to the first solution, by the size of the model: where the time goes, and what printing takes for each body.

    python benchmarks/sizes.py [SIZE …]

Chains of hinged bars, written by a repetition and written out, and ladders of windows (four-bars in a row, A02 of the IFToMM benchmarks), which
then move for 20 s at a relative tolerance of 1e-6. Processor time, the best of as many turns as fit into a few seconds.
"""

import sys
import tempfile
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

from rich.console import Console
from rich.table import Table

import freebody as fb
from freebody.model import reading, source

BARS = (10, 100, 1000, 10_000)
WINDOWS = (10, 40, 100, 1000)
SOLVED = 100
"""Windows up to which a ladder is solved here, too: what its loops determine of the reactions takes dense ranks."""
STEPS = ("read, s", "understood, s", "compiled, s", "assembled, s", "solved, s")
MOTION = 20.0  # s
PATIENCE = 5.0  # s, of turns
TURNS = 5


def repeated(n: int) -> str:
    """A chain of ``n`` bars, the first at 30°."""
    return f"""freebody: 1
parameters: {{N: {n}}}
bodies:
  link[i = 1 .. N]: {{shape: rod, length: 1 m, mass: 1 kg}}
joints:
  pin[1]: {{type: hinge, of: [ground.O, "link[1].start"], coordinate: "th[1]"}}
  pin[i = 2 .. N]: {{type: hinge, of: ["link[i-1].end", "link[i].start"], coordinate: "th[i]"}}
initial: {{"th[1]": 30 deg}}
"""


def written_out(n: int) -> str:
    """The same chain, without a repetition."""
    links = [f"  link{i}: {{shape: rod, length: 1 m, mass: 1 kg}}" for i in range(1, n + 1)]
    pins = [f"  pin{i}: {{type: hinge, of: [link{i - 1}.end, link{i}.start], coordinate: th{i}}}" for i in range(2, n + 1)]
    first = "  pin1: {type: hinge, of: [ground.O, link1.start], coordinate: th1}"
    return "\n".join(["freebody: 1", "bodies:", *links, "joints:", first, *pins, "initial: {th1: 30 deg}", ""])


def ladder(n: int) -> str:
    """A ladder of ``n`` windows, its first post with a rate."""
    text = (Path(__file__).parent / "accuracy" / "ladder.yaml").read_text()
    return text.replace("parameters: {N: 2", f"parameters: {{N: {n}")


def steps(path: Path, solves: bool) -> Iterator[None]:
    """What is done when somebody opens the file, solves and prints, step by step."""
    origin = source.open_file(path)
    yield
    made = fb.Mechanism.of(*reading.model_of(origin), str(path))
    made.lowered()
    yield
    _ = made.compile().metadata
    yield
    made.start()
    yield
    if solves:
        solved = made.solve()
        yield
        str(solved)
        yield


def seconds(text: str, solves: bool = True) -> list[float]:
    """The least of each step."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.yaml"
        path.write_text(text)
        turns, began = [], time.process_time()
        while len(turns) < TURNS and (not turns or time.process_time() - began < PATIENCE):
            marks = [time.process_time(), *(time.process_time() for _ in steps(path, solves))]
            turns.append([after - before for before, after in pairwise(marks)])
    return [min(each) for each in zip(*turns, strict=True)]


def moved(text: str) -> float:
    """Seconds that a motion takes."""
    made = fb.Mechanism.loads(text)
    compiled, (start, _) = made.compile(), made.start()
    turns, began = [], time.process_time()
    while len(turns) < TURNS and (not turns or time.process_time() - began < PATIENCE):
        before = time.process_time()
        compiled.simulate(start, MOTION, rtol=1e-6)
        turns.append(time.process_time() - before)
    return min(turns)


def main() -> None:
    sizes = [int(size) for size in sys.argv[1:]]
    table = Table("model", "size", *STEPS, "in all, s", "printed, a body, µs", "moved, s")
    seconds(repeated(2))  # what is imported on the way
    cases = [("chain, repeated", n, n, repeated(n), True) for n in sizes or BARS]
    cases += [("chain, written out", n, n, written_out(n), True) for n in sizes or BARS]
    cases += [("ladder", n, 2 * n + 1, ladder(n), n <= SOLVED) for n in sizes or WINDOWS]
    for name, size, bodies, text, solves in cases:
        spent = seconds(text, solves)
        until = [f"{each:.3f}" for each in spent[: len(STEPS)]]
        printed = f"{1e6 * spent[-1] / bodies:.0f}" if solves else ""
        motion = f"{moved(text):.3f}" if name == "ladder" else ""
        table.add_row(
            name, str(size), *until, *[""] * (len(STEPS) - len(until)), f"{sum(spent[: len(STEPS)]):.3f}", printed, motion
        )
    Console(width=160).print(table)


if __name__ == "__main__":
    main()
