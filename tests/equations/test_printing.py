"""Expressions are printed as a person writes them, and mean what they meant."""

from __future__ import annotations

import random
import re

import pytest
from material import LETTERS, anything, cos, half, product, sin, square, sym, values

from freebody.equations import Fn, Num, Sym, equation_latex, equation_text, evaluate, latex, text
from freebody.symbolic.alphabet import columns
from freebody.symbolic.tree import ZERO, add, minus, mul, negative, number, over, power

TH1, TH2, THETA, X = sym("theta1"), sym("theta2"), sym("theta"), sym("x")
M1, M2, BIG, M, L, G, K, ALPHA = map(sym, ("m1", "m2", "M", "m", "l", "g", "k", "alpha"))
A1, A2, W1 = sym("theta1", 2), sym("theta2", 2), sym("theta1", 1)

WRITTEN = [
    (add(M2, product(-1, M1)), "m₂ − m₁", "m2 - m1", r"m_2 - m_1"),
    (negative(add(M1, M2)), "−m₁ − m₂", "-m1 - m2", r"-m_1 - m_2"),
    (product(-1, add(M1, M2), L), "−(m₁ + m₂) l", "-(m1 + m2) l", r"-(m_1 + m_2) l"),
    (mul(number("1/4"), M1), "¼ m₁", "m1/4", r"\tfrac{1}{4} m_1"),
    (half(M, square(L)), "½ m l²", "m l^2/2", r"\tfrac{1}{2} m l^2"),
    (mul(number("1/12"), M, square(L)), "¹⁄₁₂ m l²", "m l^2/12", r"\tfrac{1}{12} m l^2"),
    (mul(number("3/2"), M, sin(THETA)), "³⁄₂ m sin θ", "(3/2) m sin(theta)", r"\tfrac{3}{2} m \sin\theta"),
    (mul(number("9/20000"), M), "0.00045 m", "0.00045 m", "0.00045 m"),
    (mul(number("-3/7"), M), "−³⁄₇ m", "-3 m/7", r"-\tfrac{3}{7} m"),
    (mul(L, sin(THETA), G, M), "m g l sin θ", "m g l sin(theta)", r"m g l \sin\theta"),
    (mul(sin(THETA), square(sym("theta", 1)), L, M), "m l θ̇² sin θ", "m l (theta')^2 sin(theta)", r"m l \dot\theta^2 \sin\theta"),
    (mul(A2, cos(minus(TH1, TH2)), M2), "m₂ cos(θ₁ − θ₂) θ̈₂", "m2 cos(theta1 - theta2) theta2''",
     r"m_2 \cos(\theta_1 - \theta_2) \ddot\theta_2"),
    (mul(number(-1), over(G, L), sin(THETA)), "−(g/l) sin θ", "-(g/l) sin(theta)", r"-\frac{g}{l} \sin\theta"),
    (mul(number("3/2"), over(G, L)), "3 g/(2 l)", "3 g/(2 l)", r"\frac{3 g}{2 l}"),
    (over(sin(THETA), L), "(sin θ)/l", "sin(theta)/l", r"\frac{\sin\theta}{l}"),
    (over(mul(G, minus(M1, M2)), add(M1, M2)), "(m₁ − m₂) g/(m₁ + m₂)", "(m1 - m2) g/(m1 + m2)",
     r"\frac{(m_1 - m_2) g}{m_1 + m_2}"),
    (over(minus(M1, M2), add(M1, M2)), "(m₁ − m₂)/(m₁ + m₂)", "(m1 - m2)/(m1 + m2)", r"\frac{m_1 - m_2}{m_1 + m_2}"),
    (over(number(1), mul(M, L)), "1/(m l)", "1/(m l)", r"\frac{1}{m l}"),
    (add(mul(M, square(sin(THETA))), BIG), "M + m sin²θ", "M + m sin(theta)^2", r"M + m \sin^2\theta"),
    (sin(mul(number(2), THETA)), "sin 2θ", "sin(2 theta)", r"\sin 2\theta"),
    (power(product(2, G, L), "1/2"), "√(2 g l)", "sqrt(2 g l)", r"\sqrt{2 g l}"),
    (power(number(2), "1/2"), "√2", "sqrt(2)", r"\sqrt{2}"),
    (power(L, "3/2"), "l^(3/2)", "l^(3/2)", r"l^{3/2}"),
    (over(number(1), power(L, "1/2")), "1/√l", "1/sqrt(l)", r"\frac{1}{\sqrt{l}}"),
    (power(over(G, L), "1/2"), "√(g/l)", "sqrt(g/l)", r"\sqrt{\frac{g}{l}}"),
    (mul(K, minus(X, sym("l0"))), "k (x − l₀)", "k (x - l0)", r"k (x - l_0)"),
    (add(mul(number(-1), K, X), mul(M, sym("x", 2))), "m x\u0308 − k x", "m x'' - k x", r"m \ddot x - k x"),
    (minus(mul(G, sin(TH2)), mul(L, square(W1), sin(TH1))), "g sin θ₂ − l θ̇₁² sin θ₁", "g sin(theta2) - l (theta1')^2 sin(theta1)",
     r"g \sin\theta_2 - l \dot\theta_1^2 \sin\theta_1"),
    (minus(G, mul(L, A1)), "−l θ̈₁ + g", "-l theta1'' + g", r"-l \ddot\theta_1 + g"),
    (mul(sym("m_rod"), sym("arm.angle", 2)), "m_rod arm.angle′′", "m_rod arm.angle''",
     r"m_{\text{rod}} \, \ddot{\mathrm{angle}}_{\mathrm{arm}}"),
    (mul(sym("pivot.x"), L), "pivot.x l", "pivot.x l", r"\mathrm{pivot}_x \, l"),
    (mul(sym("mu_s"), sym("Omega")), "μ_s Ω", "mu_s Omega", r"\mu_s \Omega"),
    (Fn("abs", (sym("x", 1),)), "|x\u0307|", "abs(x')", r"\left|\dot x\right|"),
    (Fn("atan2", (X, L)), "atan2(x, l)", "atan2(x, l)", r"\operatorname{atan2}(x, l)"),
    (Fn("abs", (Fn("abs", (X,)),)), "abs(|x|)", "abs(abs(x))", r"\left|\left|x\right|\right|"),
    (mul(sym("x", 1), power(Num(0.5), 2), power(number(3), 3)), "0.5²·3³ x\u0307", "0.5^2*3^3 x'", r"0.5^2 \cdot 3^3 \dot x"),
    (Num(0.35), "0.35", "0.35", "0.35"),
    (mul(Num(-2.5e-7), M), "−2.5×10⁻⁷ m", "-2.5e-07 m", r"-2.5 \cdot 10^{-7} m"),
    (Num(float("inf")), "∞", "inf", r"\infty"),
    (ZERO, "0", "0", "0"),
]  # fmt: skip


@pytest.mark.parametrize(("tree", "plain", "ascii", "tex"), WRITTEN, ids=[row[2] for row in WRITTEN])
def test_is_written_as_a_person_does(tree, plain, ascii, tex):
    assert (text(tree, LETTERS), text(tree, LETTERS, ascii=True), latex(tree, LETTERS)) == (plain, ascii, tex)


def test_an_equation_of_a_double_pendulum():
    left = add(
        half(A2, cos(minus(TH1, TH2)), M2, square(L)),
        mul(add(M2, mul(number("1/4"), M1)), A1, square(L)),
    )
    right = product(-1, M2, L, sin(TH1), G)
    assert equation_text(left, right, LETTERS) == "(¼ m₁ + m₂) l² θ̈₁ + ½ m₂ l² cos(θ₁ − θ₂) θ̈₂ = −m₂ g l sin θ₁"
    assert equation_latex(left, right, LETTERS).endswith(r"= -m_2 g l \sin\theta_1")


def test_long_equations_are_broken_at_their_terms():
    terms = [mul(sym(f"k{n}"), W1, add(X, sym(f"l{n}")), sin(TH1)) for n in range(12)]
    for width in (60, 80, 100):
        for left, right in ((add(*terms), ZERO), (A1, add(*terms)), (add(*terms), add(*terms))):
            printed = equation_text(left, right, LETTERS, width=width)
            lines = printed.split("\n")
            assert len(lines) > 1 and max(map(columns, lines)) <= width
            whole = equation_text(left, right, LETTERS, width=10_000)
            assert re.sub(r"\s+", " ", printed) == whole
            assert not any(line.endswith(("+", "−")) for line in lines)
    one_bracket = equation_text(A1, mul(G, add(*terms)), LETTERS, width=60)
    assert max(map(columns, one_bracket.split("\n"))) <= 60
    broken = equation_latex(A1, add(*terms), LETTERS)
    assert broken.startswith("\\begin{aligned}\n\\ddot\\theta_1 &= ") and broken.count(r"&\quad +") >= 2


def test_printed_text_read_back_has_the_same_value():
    """SymPy's parser, which knows implicit multiplication, reads the ASCII form; so no bracket is missing."""
    from sympy.parsing.sympy_parser import convert_xor, implicit_multiplication, parse_expr, standard_transformations

    draw = random.Random(3)
    how = (*standard_transformations, convert_xor, implicit_multiplication)
    for _ in range(60):
        tree = anything(draw)
        at = values(draw)
        written = {s: f"{s.name.replace('.', '_')}{'_d' * s.dots}".replace("lambda", "lambda_") for s in at}
        printed = re.sub(r"([\w.]+)('+)", lambda found: found[1] + "_d" * len(found[2]), text(tree, LETTERS, ascii=True))
        printed = re.sub(r"([A-Za-z_]\w*)\.(\w+)", r"\1_\2", printed).replace("lambda", "lambda_")
        names = {name: at[s] for s, name in written.items()}
        read = parse_expr(printed.replace("abs(", "Abs("), transformations=how, local_dict=_symbols(names))
        assert float(read.subs(names)) == pytest.approx(evaluate(tree, at), rel=1e-9), printed


def test_latex_is_accepted_by_a_parser_of_formulas():
    from matplotlib.mathtext import MathTextParser

    parser = MathTextParser("path")
    draw = random.Random(5)
    for tree in [anything(draw) for _ in range(25)] + [row[0] for row in WRITTEN]:
        printed = latex(tree, LETTERS)
        assert printed.count("{") == printed.count("}") and printed.count(r"\left") == printed.count(r"\right")
        parser.parse(f"${printed.replace('tfrac', 'frac')}$")


def test_signs_never_meet():
    draw = random.Random(11)
    for _ in range(200):
        printed = text(anything(draw), LETTERS)
        assert not re.search(r"[+−] [+−]|^1 \w|[^\d.]1 [a-zθ]|\(\(([^()]*)\)\)", printed), printed


def _symbols(names):
    import sympy

    return {name: sympy.Symbol(name) for name in names} | {"pi": sympy.pi}


def test_letters_of_a_name_without_a_table_are_printed_all_the_same():
    assert text(mul(Sym("b2"), Sym("theta", 2))) == "b₂ θ̈"
