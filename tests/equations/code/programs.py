"""Generated programs of models, run: Python as a module, C as a compiled library; and random states to run them at."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

import freebody as fb
from freebody.core import FreeBodies, MotionError
from freebody.core import State as Place

ROOT = Path(__file__).parents[3]
FLAGS = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC")
FUNCTIONS = {
    "mass_matrix": "nn", "right_hand_side": "n", "multiplier_matrix": "nm", "constraint_jacobian": "mn", "constraint_bias": "m",
    "balance_matrix": "aa", "balance_right_hand_side": "a", "accelerations": "n", "multipliers": "m", "reactions": "l",
}  # fmt: skip
"""Of generated code, with the sizes of what they give: coordinates n, multipliers m, loads l, all unknowns a."""


@cache
def model(path: str) -> fb.Mechanism:
    return fb.load(ROOT / path)


@cache
def in_python(path: str) -> SimpleNamespace:
    return run(model(path).code())


def run(text: str) -> SimpleNamespace:
    found: dict[str, Any] = {}
    exec(compile(text, "generated.py", "exec"), found)
    return SimpleNamespace(**found)


def in_c(mechanism: fb.Mechanism, python: SimpleNamespace, folder: Path) -> SimpleNamespace:
    """The functions of the compiled C, called as those of the Python are."""
    source, library = folder / "model.c", folder / "model.so"
    source.write_text(mechanism.code(language="c"), encoding="utf-8")
    subprocess.run(["cc", *FLAGS, str(source), "-o", str(library), "-lm"], check=True, capture_output=True)
    loaded = ctypes.CDLL(str(library))
    n, l, m = (len(getattr(python, word, ())) for word in ("COORDINATES", "LOADS", "MULTIPLIERS"))
    sizes = {"n": n, "l": l, "m": m, "a": n + l}
    found = {
        name: _called(getattr(loaded, name), tuple(sizes[s] for s in shape))
        for name, shape in FUNCTIONS.items()
        if hasattr(python, name)
    }
    defaults = np.array((ctypes.c_double * len(python.DEFAULTS)).in_dll(loaded, "DEFAULTS"))
    return SimpleNamespace(**found, DEFAULTS=defaults, derivative=_rate(loaded.derivative, 2 * n))


def _pointer(values: np.ndarray) -> Any:
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def _called(function: Any, shape: tuple[int, ...]) -> Any:
    def call(q: Any, u: Any, p: Any, t: float) -> np.ndarray:
        out, given = np.full(shape, np.nan), [np.ascontiguousarray(x, dtype=float) for x in (q, u, p)]
        function(*map(_pointer, given), ctypes.c_double(t), _pointer(out))
        return out

    return call


def _rate(function: Any, size: int) -> Any:
    def call(t: float, y: Any, p: Any) -> np.ndarray:
        out, given = np.full(size, np.nan), [np.ascontiguousarray(x, dtype=float) for x in (y, p)]
        assert function(ctypes.c_double(t), *map(_pointer, given), _pointer(out)) == 0
        return out

    return call


class State(SimpleNamespace):
    """q, u, t, ``p`` of the core, ``all`` parameters of the generated functions; what the core says there."""


def states(path: str, count: int, seed: int = 1) -> Iterator[State]:
    """Random admissible states with random parameters: loops closed, motions obeyed."""
    mechanism, rng = model(path), np.random.default_rng(seed)
    core, start = mechanism.source().as_it_holds(mechanism.start()[0])
    source = core
    given = {item["name"]: item["value"] for item in source.spec["parameters"]}
    names = [c["name"] for c in source.metadata["coordinates"]]
    nominal = dict(zip((each["name"] for each in source.metadata["parameters"]), start.p, strict=True))
    unnamed = in_python(path).DEFAULTS[len(start.p) :]
    loose = _loose(source, core.free_bodies(start))
    found = tries = 0
    while found < count:
        tries += 1
        assert tries < 40 * count, f"{path}: {found} states in {tries - 1} tries"
        spread = 0.3 if loose is None else 0.1
        zeros = 0.1 * (found % 2)  # what is 0 in the model is so at every other state
        changed = {
            n: (nominal[n] or zeros) * rng.uniform(1 - spread, 1 + spread)
            for n, value in given.items()
            if not isinstance(value, str)
        }
        t = start.t + rng.uniform(0, 0.5)
        q, u = start.q + rng.uniform(-0.5, 0.5, len(names)), rng.uniform(-3, 3, len(names))
        try:
            p = core.bind(changed)
            if loose is not None:
                rates = {name: rate for name, rate in zip(names, u, strict=True) if name in loose}
                place, _ = core.assemble(p, t, guess=dict(zip(names, q, strict=True)), rates=rates)
                q, u = place.q, place.u
            place = Place(p, t, q, u)
            free = core.free_bodies(place)
            yield State(q=q, u=u, t=t, p=p, all=np.concatenate([p, unnamed]), now=core.instant(place), free=free)
            found += 1
        except MotionError:
            continue


def _loose(source: Any, free: FreeBodies) -> list[str] | None:
    """Coordinates whose rates can be chosen freely, where loops or motions hold others; None where all can."""
    motions = source.spec["motions"]
    if not free.rows:
        return None
    names, held = [c["name"] for c in source.metadata["coordinates"]], [m["of"] for m in motions if m["level"] != "acceleration"]
    matrix = np.array([[row.coefficients.get(name, 0.0) for name in names] for row in free.rows])
    rank = np.linalg.matrix_rank(matrix) - (len(motions) - len(held))
    return [name for name in names if name not in held][: len(names) - rank]
