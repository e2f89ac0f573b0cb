"""MathML says what LaTeX says."""

import re

import pytest

from freebody.symbolic.printers.mathml import broken, mathml


def said(shown):
    return re.sub(r"<[^>]*>", "", shown)


@pytest.mark.parametrize(
    ("latex", "inside"),
    [
        (r"\ddot\theta_1", '<msub><mover accent="true"><mi>θ</mi><mo stretchy="false">¨</mo></mover><mn>1</mn></msub>'),
        (r"\tfrac{1}{2} l", '<mfrac displaystyle="false"><mn>1</mn><mn>2</mn></mfrac><mi>l</mi>'),
        (r"\sqrt{x^2}", "<msqrt><msup><mi>x</mi><mn>2</mn></msup></msqrt>"),
        (r"\dot x_1^2", "<msubsup>"),
        (r"\sin^2\theta", "<msup>"),
        (r"\mathrm{slot\_1}_x", '<mi mathvariant="normal">slot_1</mi>'),
        (r"\mathbf{\lambda}", "<mi>𝝀</mi>"),
        (r"a = -b", '<mo form="prefix">−</mo><mi>b</mi>'),
        (r"a - b", '<mo form="infix">−</mo><mi>b</mi>'),
        (r"\begin{bmatrix} a & 0 \\ -b & 1 \end{bmatrix}", "<mtr><mtd><mi>a</mi></mtd><mtd><mn>0</mn></mtd></mtr>"),
    ],
)
def test_signs(latex, inside):
    assert inside in mathml(latex)


def test_a_long_sum_can_be_broken_and_says_the_same():
    latex = r"m \left(\tfrac{1}{2} l + r\right) \ddot s = -m g - k (s - r)"
    assert said(broken(latex)) == said(mathml(latex))
    assert broken(latex).count("<math") == 5  # m (l/2 | + r) s'' | = −m g | − k (s | − r)


@pytest.mark.parametrize("latex", [r"\unknown{x}", r"\frac{1}", r"\begin{bmatrix} 1", r"\begin{cases} 1 \end{cases}"])
def test_what_is_not_printed_here_is_refused(latex):
    with pytest.raises(ValueError, match=r"LaTeX|missing"):
        mathml(latex)
