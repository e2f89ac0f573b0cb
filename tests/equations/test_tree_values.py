"""A tree, SymPy, generated NumPy and generated C have the same values."""

from __future__ import annotations

import ctypes
import json
import random
import subprocess

import numpy as np
import pytest
from material import LETTERS, anything, half, square, sym, values

from freebody.equations import Add, Fn, Num, Sym, evaluate, from_sympy, generate, read, to_sympy, write
from freebody.symbolic.differentiate import _SLOPES, partial
from freebody.symbolic.tree import mul, number, power

ARRAYS = {
    "q": [Sym(n) for n in LETTERS.of_kind("coordinate")],
    "u": [Sym(n, 1) for n in LETTERS.of_kind("coordinate")],
    "p": [Sym(n) for n in LETTERS.of_kind("parameter", "constant")],
    "a": [Sym(n, 2) for n in LETTERS.of_kind("coordinate")],
    "r": [Sym(n) for n in LETTERS.of_kind("unknown")],
}


@pytest.fixture(scope="module")
def trees():
    draw = random.Random(1)
    return [anything(draw, 5) for _ in range(60)] + [mul(sym("x", 2), sym("pivot.x"))]


def arguments(at):
    return {name: np.array([at[s] for s in letters]) for name, letters in ARRAYS.items()}


def test_json_goes_round(trees):
    for tree in trees:
        assert read(json.loads(json.dumps(write(tree)))) == tree


def test_what_is_no_expression_is_refused():
    with pytest.raises(ValueError, match="expected one of num, sym"):
        read({"plus": []})
    with pytest.raises(KeyError, match="no value for 'm' differentiated 0"):
        evaluate(sym("m"), {})
    with pytest.raises(KeyError, match="'bump'"):
        evaluate(Fn("bump", (sym("m"),)), {sym("m"): 1.0})


def test_tables_and_arrays_are_evaluated():
    bump = Fn("bump", (sym("x"),))
    x = np.linspace(0, 1, 5)
    assert evaluate(mul(number(2), bump), {sym("x"): x}, {"bump": np.square}) == pytest.approx(2 * x**2)


@pytest.mark.parametrize("name", _SLOPES)
def test_slopes_of_functions_are_their_differences(name):
    at, step = 1.3 if name == "acosh" else 0.4, 1e-6
    read = lambda x: evaluate(Fn(name, (sym("x"),)), {sym("x"): x})
    difference = (read(at + step) - read(at - step)) / (2 * step)
    assert evaluate(partial(Fn(name, (sym("x"),)), sym("x")), {sym("x"): at}) == pytest.approx(difference, rel=1e-8)


def test_sympy_has_the_same_values_and_goes_round(trees):
    import sympy

    at = values(random.Random(2))
    letters = {sympy.Symbol(s.name + "'" * s.dots): value for s, value in at.items()}
    for tree in trees:
        expected = evaluate(tree, at)
        made = to_sympy(tree, LETTERS)
        assert float(made.subs(letters)) == pytest.approx(expected, rel=1e-9)
        assert evaluate(from_sympy(made), at) == pytest.approx(expected, rel=1e-9)
        assert evaluate(from_sympy(to_sympy(tree, LETTERS, time=True)), at) == pytest.approx(expected, rel=1e-9)


def test_sympy_differentiates_coordinates_in_time():
    """d/dt of ½ m ẋ² is m ẋ ẍ, with the symbols that dynamicsymbols has."""
    from sympy.physics.mechanics import dynamicsymbols

    x = dynamicsymbols("x")
    energy = to_sympy(half(sym("m"), square(sym("x", 1))), LETTERS, time=True)
    assert energy.has(x.diff())
    assert from_sympy(energy.diff("t")) == from_sympy(to_sympy(mul(sym("m"), sym("x", 1), sym("x", 2)), LETTERS, time=True))


def test_generated_numpy_has_the_same_values(trees):
    source = generate({"vector": trees, "matrix": [trees[:2], trees[2:4]], "one": trees[-1]}, LETTERS)
    module = {}
    exec(source, module)
    draw = random.Random(4)
    states = [values(draw) for _ in range(3)]
    for at in states:
        x = arguments(at)
        args = (x["q"], x["u"], x["p"], at[sym("t")], x["a"], x["r"])
        expected = np.array([evaluate(tree, at) for tree in trees])
        assert module["vector"](*args) == pytest.approx(expected, rel=1e-13, abs=1e-13)
        assert module["matrix"](*args) == pytest.approx(expected[:4].reshape(2, 2), rel=1e-13, abs=1e-13)
        assert module["one"](*args) == pytest.approx(expected[-1], rel=1e-13)
    many = {name: np.transpose([arguments(at)[name] for at in states]) for name in ARRAYS}
    t = np.array([at[sym("t")] for at in states])
    assert module["matrix"](many["q"], many["u"], many["p"], t, many["a"], many["r"]).shape == (2, 2, 3)


def test_generated_c_compiles_cleanly_and_has_the_same_values(trees, tmp_path):
    (tmp_path / "made.c").write_text(generate({"vector": trees, "one": trees[-1]}, LETTERS, "c"))
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O1", "-shared", "-fPIC", "-ffp-contract=off"]
    subprocess.run(["cc", *flags, "made.c", "-o", "made.so", "-lm"], cwd=tmp_path, check=True)
    library = ctypes.CDLL(str(tmp_path / "made.so"))
    library.one.restype = ctypes.c_double
    draw = random.Random(6)
    for _ in range(3):
        at = values(draw)
        given = {name: (ctypes.c_double * len(x))(*x) for name, x in arguments(at).items()}
        args = (given["q"], given["u"], given["p"], ctypes.c_double(at[sym("t")]), given["a"], given["r"])
        out = (ctypes.c_double * len(trees))()
        library.vector(*args, out)
        assert list(out) == pytest.approx([evaluate(tree, at) for tree in trees], rel=1e-13, abs=1e-13)
        assert library.one(*args) == pytest.approx(evaluate(trees[-1], at), rel=1e-13)


def test_what_is_used_twice_is_computed_once():
    angle = Fn("sin", (mul(number(2), sym("theta")),))
    big = power(mul(sym("m"), angle), "1/2")
    source = generate({"f": [big, mul(number(3), big), angle]}, LETTERS)
    assert source.count("np.sin(") == 1 and source.count("np.sqrt(") == 1
    assert generate({"f": [mul(sym("m"), sym("x"))]}, LETTERS).count("def f(q, u, p, t):") == 1


def test_shared_parts_cost_nothing():
    """A tree that is doubled forty times has 10¹² leaves, and forty steps of code."""
    tree = sym("x")
    for _ in range(40):
        tree = Fn("sin", (Add((tree, mul(number(2), tree))),))
    assert generate({"f": tree}, LETTERS).count("\n") < 150


def test_what_cannot_be_generated_is_said():
    with pytest.raises(ValueError, match="python, c"):
        generate({"f": sym("x")}, LETTERS, "fortran")
    with pytest.raises(ValueError, match="'w' differentiated 0 times is no argument"):
        generate({"f": sym("w")}, LETTERS)
    with pytest.raises(ValueError, match="table of the model"):
        generate({"f": Fn("bump", (sym("x"),))}, LETTERS)
    with pytest.raises(ValueError, match="cannot be the name"):
        generate({"lambda": Num(1.0)}, LETTERS)
