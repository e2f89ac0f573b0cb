"""Symbols and expressions that the tests of equations share."""

from __future__ import annotations

import random

from freebody.equations import Add, Fn, Mul, Nomenclature, Num, Pow, Sym, Tree
from freebody.symbolic.tree import add, mul, number, power

LETTERS = Nomenclature.read(
    {
        "theta1": {"kind": "coordinate", "unit": "rad", "doc": "angle of the upper rod"},
        "theta2": {"kind": "coordinate", "unit": "rad"},
        "theta": {"kind": "coordinate", "unit": "rad"},
        "x": {"kind": "coordinate", "unit": "m"},
        "arm.angle": {"kind": "coordinate", "unit": "rad"},
        "m1": {"unit": "kg"},
        "m2": {"unit": "kg"},
        "m_rod": {"unit": "kg"},
        "M": {"unit": "kg"},
        "m": {"unit": "kg"},
        "k": {"unit": "N/m"},
        "l": {"unit": "m"},
        "lambda": {"unit": "m"},
        "alpha": {"unit": "rad"},
        "mu": {"unit": ""},
        "g": {"kind": "constant", "unit": "m/s^2"},
        "t": {"kind": "time", "unit": "s"},
        "pivot.x": {"kind": "unknown", "unit": "N"},
        "T": {"kind": "unknown", "unit": "N*m"},
    }
)


def sym(name: str, dots: int = 0) -> Sym:
    return Sym(name, dots)


def sin(of: Tree) -> Tree:
    return Fn("sin", (of,))


def cos(of: Tree) -> Tree:
    return Fn("cos", (of,))


def square(of: Tree) -> Tree:
    return power(of, 2)


def half(*of: Tree) -> Tree:
    return mul(number("1/2"), *of)


def product(*factors: Tree | int | str) -> Tree:
    """A product of trees, of whole numbers, and of symbols by name."""
    return mul(*(number(f) if isinstance(f, int) else sym(f) if isinstance(f, str) else f for f in factors))


def anything(draw: random.Random, depth: int = 4) -> Tree:
    """A random expression that has a real value where all symbols are positive."""
    if depth == 0 or draw.random() < 0.15:
        letters = [s for name in ("theta1", "x", "arm.angle") for s in (Sym(name), Sym(name, 1), Sym(name, 2))]
        letters += [Sym(name) for name in ("m1", "m2", "m_rod", "l", "lambda", "g", "t", "pivot.x", "pi")]
        numbers = [number(text) for text in ("2", "1/2", "-3", "-1/12", "5/7", "0.35")] + [Num(0.125)]
        return draw.choice(letters + numbers)
    parts = tuple(anything(draw, depth - 1) for _ in range(draw.randint(2, 3)))
    match draw.randrange(6):
        case 0 | 1:
            return add(*parts)
        case 2 | 3:
            return mul(*parts)
        case 4:
            safe = Add((number(1), Pow(parts[0], number(2).value)))
            return Pow(safe, number(draw.choice(["-1", "1/2", "-1/2", "3", "3/2", "-2"])).value)
        case _:
            name = draw.choice(["sin", "cos", "abs", "sign", "atan2", "exp"])
            if name == "exp":
                return Fn(name, (Mul((number(-1), Fn("abs", (parts[0],)))),))
            return Fn(name, parts[: 2 if name == "atan2" else 1])


def values(draw: random.Random, letters: Nomenclature = LETTERS) -> dict[Sym, float]:
    """Random positive values of all symbols, their rates and accelerations."""
    found = {Sym(name): draw.uniform(0.4, 1.9) for name in letters}
    found |= {Sym(name, dots): draw.uniform(0.4, 1.9) for name in letters.of_kind("coordinate") for dots in (1, 2)}
    return found
