"""The part of generated Python that solves: names and numbers, accelerations, reactions, first-order form."""

from __future__ import annotations

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


def solvers(systems: Systems) -> str:
    """Source that comes after the functions of ``systems``."""
    parts = [_names(systems), _CLOSED if systems.rows else _FREE, *([_LOADS] if systems.loads else []), _RATE]
    return "\n\n\n".join(parts) + "\n"


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
    letter = systems.letters[name]
    words = " ".join(word for word in (f"[{letter.unit}]" if letter.unit else "", letter.doc) if word)
    return f"  # {words}" if words else ""
