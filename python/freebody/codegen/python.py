"""Functions in Python with NumPy, and the part of generated Python that solves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from freebody.codegen.source import Language, Step

if TYPE_CHECKING:
    from freebody.codegen.systems import Systems

_FREE = '''def accelerations(q, u, p=DEFAULTS, t=0.0):
    """Second derivatives of the coordinates (n,): the solution of mass_matrix q'' = right_hand_side."""
    return np.linalg.solve(mass_matrix(q, u, p, t), right_hand_side(q, u, p, t))'''
_CLOSED = '''def _accelerations_and_multipliers(q, u, p, t):
    rows = constraint_jacobian(q, u, p, t)
    top = np.hstack([mass_matrix(q, u, p, t), -multiplier_matrix(q, u, p, t)])
    matrix = np.vstack([top, np.hstack([rows, np.zeros((len(rows), len(rows)))])])
    return np.linalg.solve(matrix, np.concatenate([right_hand_side(q, u, p, t), -constraint_bias(q, u, p, t)]))


def accelerations(q, u, p=DEFAULTS, t=0.0):
    """Second derivatives of the coordinates (n,): with the multipliers they solve

    mass_matrix q'' = right_hand_side + multiplier_matrix multipliers,  constraint_jacobian q'' + constraint_bias = 0.
    """
    return _accelerations_and_multipliers(q, u, p, t)[:len(COORDINATES)]


def multipliers(q, u, p=DEFAULTS, t=0.0):
    """The loads of MULTIPLIERS, which hold the constraints."""
    return _accelerations_and_multipliers(q, u, p, t)[len(COORDINATES):]'''
_LOADS = '''def reactions(q, u, p=DEFAULTS, t=0.0):
    """All unknown loads, in the order of LOADS: the balances of all bodies, balance_matrix x = balance_right_hand_side, solved."""
    x = np.linalg.solve(balance_matrix(q, u, p, t), balance_right_hand_side(q, u, p, t))
    return x[len(COORDINATES):]'''
_RATE = '''def derivative(t, y, p=DEFAULTS):
    """Rate of the state y = (q, u), for integrators such as scipy.integrate.solve_ivp."""
    q, u = np.split(np.asarray(y, dtype=float), 2)
    return np.concatenate([u, accelerations(q, u, p, t)])'''


class NumPy(Language):
    """Python with NumPy."""

    word, ending, doc = "python", "py", "Python that needs NumPy only"
    functions: ClassVar[Mapping[str, str]] = {
        "sin": "np.sin({})", "cos": "np.cos({})", "tan": "np.tan({})", "exp": "np.exp({})", "ln": "np.log({})",
        "atan2": "np.arctan2({}, {})", "abs": "np.abs({})", "sign": "np.sign({})",
        "sqrt": "np.sqrt({})", "power": "np.power({}, {})",
    }  # fmt: skip

    def function(
        self, name: str, arrays: Sequence[str], steps: Sequence[Step], results: Sequence[str], shape: tuple[int, ...]
    ) -> str:
        lines = [f"def {name}({', '.join(arrays)}):", *(f"    {step} = {value}" for step, value in steps)]
        if shape == ():
            return "\n".join([*lines, f"    return {results[0]}"])
        entries = [f"        {result}," for result in results]
        return "\n".join([*lines, "    return _array([", *entries, f"    ], {shape!r})"])

    def file(self, header: Sequence[str], functions: Sequence[str]) -> str:
        safe = [line.replace("\\", "\\\\").replace('"', "'") for line in header]
        top = ['"""Generated from the equations of a freebody model, in SI units and radians.', "", *safe, '"""']
        top += ["", "import numpy as np", "", "", "def _array(entries, shape):"]
        top += ["    entries = np.broadcast_arrays(*entries)"]
        top += ["    return np.stack(entries).reshape(shape + entries[0].shape)"]
        return "\n\n\n".join(["\n".join(top), *functions]) + "\n"

    def solvers(self, systems: Systems) -> str:
        parts = [_names(systems), _CLOSED if systems.rows else _FREE, *([_LOADS] if systems.loads else []), _RATE]
        return "\n\n" + "\n\n\n".join(parts) + "\n"


def _names(systems: Systems) -> str:
    lines = [_tuple("COORDINATES", systems, systems.coordinates), _tuple("LOADS", systems, systems.loads)]
    if systems.rows:
        lines.append(_tuple("MULTIPLIERS", systems, systems.multipliers))
    values = [f"    {name!r}: {float(value)!r},{_comment(systems, name)}" for name, value in systems.values.items()]
    lines += ["PARAMETERS = {\n" + "".join(f"{line}\n" for line in values) + "}"]
    return "\n".join([*lines, "DEFAULTS = np.array(list(PARAMETERS.values()), dtype=float)"])


def _tuple(word: str, systems: Systems, names: tuple[str, ...]) -> str:
    entries = "".join(f"    {name!r},{_comment(systems, name)}\n" for name in names)
    return f"{word} = (\n{entries})" if names else f"{word} = ()"


def _comment(systems: Systems, name: str) -> str:
    symbol = systems.nomenclature[name]
    words = " ".join(word for word in (f"[{symbol.unit}]" if symbol.unit else "", symbol.doc) if word)
    return f"  # {words}" if words else ""
