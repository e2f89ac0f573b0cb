"""MathML says what LaTeX says."""

import random
import re

import pytest
from material import LETTERS, anything, half, product, square, sym

from freebody.symbolic.formula import Grid, bold, joined, typed, word
from freebody.symbolic.printers.latex import latex
from freebody.symbolic.printers.mathml import broken, mathml
from freebody.symbolic.printers.typeset import formula
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Fn, add, minus, mul, power

THETA, X, L = sym("theta1"), sym("x"), sym("l")


def said(shown):
    return re.sub(r"<[^>]*>", "", shown)


@pytest.mark.parametrize(
    ("shown", "inside"),
    [
        (formula(sym("theta1", 2), LETTERS), '<msub><mover accent="true"><mi>θ</mi><mo stretchy="false">¨</mo></mover><mn>1</mn></msub>'),
        (formula(half(L)), '<mfrac displaystyle="false"><mn>1</mn><mn>2</mn></mfrac><mi>l</mi>'),
        (formula(power(square(X), "1/2")), "<msqrt><msup><mi>x</mi><mn>2</mn></msup></msqrt>"),
        (formula(square(sym("x1", 1))), "<msubsup>"),
        (formula(square(Fn("sin", (THETA,)))), "<msup>"),
        (Name("x", (), "slot 1").formula(), '<mi mathvariant="normal">slot 1</mi>'),
        (word("a<b"), '<mi mathvariant="normal">a&lt;b</mi>'),
        (bold("λ"), "<mi>𝝀</mi>"),
        (formula(mul(product(-1), X)), '<mo form="prefix">−</mo><mi>x</mi>'),
        (formula(minus(L, X)), '<mo form="infix">−</mo><mi>x</mi>'),
        ((Grid(((typed("a"), typed("0")), (typed("b"), typed("1")))),), "<mtr><mtd><mi>a</mi></mtd><mtd><mn>0</mn></mtd></mtr>"),
    ],
    ids=range(11),
)  # fmt: skip
def test_signs(shown, inside):
    assert inside in mathml(shown)


def test_a_long_sum_can_be_broken_and_says_the_same():
    left = formula(mul(sym("m"), add(half(L), sym("r")), sym("s", 2)))
    right = formula(add(product(-1, "m", "g"), mul(product(-1, "k"), minus(sym("s"), sym("r")))))
    whole = joined((left, right), typed("="))
    assert said(broken(whole)) == said(mathml(whole))
    assert broken(whole).count("<math") == 5  # m (l/2 | + r) s'' | = −m g | − k (s | − r)


def test_both_say_the_same_signs():
    draw = random.Random(4)
    for tree in (anything(draw) for _ in range(100)):
        shown = formula(tree, LETTERS)
        plain = re.sub(r"\\(theta|lambda|alpha|mu|pi)", lambda found: Name(found[1]).unicode(), latex(shown)).replace(
            r"\cdot", "·"
        )
        plain = re.sub(r"\\(left|right|mathrm|text|operatorname|t?frac|sqrt|d?dot|,)(?![a-z])|[{}^_\s\\]", "", plain)
        assert sorted(plain.replace("-", "−")) == sorted(re.sub(r"[˙¨\s]", "", said(mathml(shown))))
