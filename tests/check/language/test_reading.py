"""What people write is read, and spelled back as the same."""

from __future__ import annotations

import pytest
from statements import STATEMENTS
from statements import letters as known
from typeset import latex

from freebody.check.language.parser import parse, parse_expression
from freebody.check.language.spelling import spell
from freebody.check.language.statements import inlined, symbols_in, terms
from freebody.symbolic.tree import Add, Mul, Negative, Num, Sym, addends, exchange, walk

KNOWN = known("eps m l g theta phi alpha x y t m1 m2 R I1 I2 T omega F i j k a_G r_G1/O pivot.Fx link[2].angle")


@pytest.mark.parametrize(("names", "text", "reading"), STATEMENTS)
def test_statements(names, text, reading):
    program = parse(text, names)
    assert spell(program) == reading
    assert parse(spell(program), names) == program
    named = [*names, *(line.name.name for line in program.assignments)]
    for line in program.equations:
        assert spell(parse(latex(line), named)) == spell(line)


ONE_READING = {
    "m*l*thetaddot = -m*g*sin(theta)": [
        "m*l*thetaddot = -m*g*sin(theta)",
        "m l θ̈ = −m g sin θ",
        "mlθ̈ = −mgsinθ",
        "m l theta_ddot = -m*g*sin theta",
        r"m l \ddot\theta = -m g \sin\theta",
        r"$$ m\,l\,\ddot{\theta} = -m g\,\sin\!\left(\theta\right) $$",
        r"\[\resizebox{\ifdim\width>\linewidth\linewidth\else\width\fi}{!}{$\displaystyle m l \ddot\theta = -m g \sin\theta$} \tag{3}\]",
        "m l theta'' = -m g sin(theta)",
        "m l diff(theta, t, 2) = -m g sin(theta)",
        "m l d²θ/dt² = -m g sin(theta)",
        r"m l \frac{d^2\theta}{dt^2} = -m g \sin\theta",
        "AMB about O: m l thetaddot = -m g sin(theta)   # about the hinge",
        "m l thetaddot\n  = -m g sin(theta)",
    ],
    "eps*x = l": ["eps x = l", "ε x = l", r"\varepsilon x = l", r"\epsilon x = l", "epsilon x = l"],
    "m1*x = m2*y": [
        "m_1 x = m_2 y",
        "m₁x = m₂y",
        "m1x = m2y",
        "m_{1} x = m_{2} y",
        r"m_1\,x = m_{2}\cdot y".replace(r"\cdot", "*"),
    ],
    "thetadot = omega": [
        "θ̇ = ω",
        "dθ/dt = ω",
        "d theta/dt = omega",
        r"\dot\theta = \omega",
        r"\frac{d\theta}{dt} = \omega",
        "theta' = omega",
        "θ̇(t) = ω(t)",
    ],
    "sin(theta)^2 = tan(alpha)^2": [
        "sin²θ = tan²α",
        "sin^2 theta = tan^2 alpha",
        r"\sin^2\theta = \tan^{2}{\alpha}",
        "(sinθ)² = (tanα)²",
    ],
    "theta = asin(x/l)": ["θ = sin⁻¹(x/l)", r"\theta = \sin^{-1}\frac{x}{l}", "θ = arcsin(x/l)"],
    "omega*t = acosh(x/l)": ["ωt = arcosh(x/l)", r"\omega t = \operatorname{arcosh}\frac{x}{l}", "ωt = cosh⁻¹(x/l)"],
    "g/l*sin(theta) = 0": ["g/l sinθ = 0", "(g/l) sin θ = 0", r"\frac{g}{l}\sin\theta = 0", r"\frac gl \sin\theta = 0"],
    "1/2*m*xdot^2 = m*g*l": ["½ m ẋ² = m g l", r"\frac12 m \dot{x}^2 = mgl", "1/2 m xdot**2 = m g l"],
    "[m, 0; 0, m1]*(x, y) = (1, 2)": [
        "[m, 0; 0, m1] (x, y) = (1, 2)",
        "[[m, 0], [0, m1]] [x; y] = [1; 2]",
        r"\begin{pmatrix} m & 0 \\ 0 & m_1 \end{pmatrix} \begin{bmatrix} x \\ y \end{bmatrix} = \begin{bmatrix} 1 \\ 2 \end{bmatrix}",
        "[m, 0; 0, m1] [x, y]ᵀ = [1, 2]^T",
    ],
    "r_G1/O × F*i = 0": [
        "r_G1/O × F i = 0",
        "r_{G_1/O} × F i = 0",
        "cross(r_G1/O, F i) = 0",
        r"\vec{r}_{G1/O} \times F\hat{\imath} = 0",
    ],
    "F · i = m*x": ["F·i = m x", "dot(F, i) = m x", r"\mathbf{F}\cdot\mathbf{i} = m x", "F . i = m x"],
    "pivot.Fx = link[2].angle": ["pivot.Fx = link[2].angle"],
    "sin(omega*t) = cos(2*theta)": ["sin ωt = cos 2θ", "sin(ω t) = cos(2θ)"],
    "x*(-y) = 3": ["x*-y = 3", "x (−y) = 3"],
    "x = 30 deg": ["x = 30 deg"],
    "F = 2 kN": ["F = 2 kN"],
    "T = 3 N·m": ["T = 3 N·m"],
    "xdot = 2 m/s": ["ẋ = 2 m/s"],
    "F = 3 N*m": ["F = 3 N m"],
    "x = 30 °*l": ["x = 30° l", r"x = 30^\circ l", r"x = 30^{\circ}\,l"],
    "2*m*g = F": ["2 m g = F"],
    "m · x = m2 · y": ["m·x = m2·y", r"m \cdot x = m_2 \cdot y"],
    "F = (3*i - j) N": ["F = (3 i − j) N", r"F = (3\,i - j)\,\mathrm{N}"],
    "sqrt(2)*x = abs(y)": ["√2 x = |y|", r"\sqrt{2} x = |y|"],
    "m*g*l = m2*R": ["mgl = m2R"],
}


@pytest.mark.parametrize("reading", ONE_READING)
def test_spellings_of_one_equation(reading):
    for text in ONE_READING[reading]:
        assert spell(parse(text, KNOWN)) == reading, text


def test_a_quotient_takes_the_next_factor_only():
    assert parse("a/b c = 0") == parse("(a/b) c = 0") != parse("a/(b c) = 0")
    assert parse("2 a b/(c + d) e = 0") == parse("((2 a b)/(c + d)) e = 0")


def test_cross_binds_tighter_than_dot_and_looser_than_times():
    assert parse_expression("k · r × m a", ["k", "r", "m", "a"]) == parse_expression("k · (r × (m*a))", ["k", "r", "m", "a"])


def test_x_is_a_cross_only_where_no_letter_is_called_so():
    assert spell(parse("r x F = 0", ["r", "F"])) == "r × F = 0"
    assert spell(parse("r x F = 0", ["r", "F", "x"])) == "r*x*F = 0"


def test_primes_belong_to_names_where_one_is_declared():
    assert symbols_in(parse("theta' = 0", ["theta"])) == [Sym("theta", 1)]
    assert symbols_in(parse("ÿ' = i'", ["y'", "i'"])) == [Sym("y'", 2), Sym("i'")]


@pytest.mark.parametrize("text", ["½ m l² a = 0", "(1/2) m l² a = 0", "½ m l^2 a = 0"])
def test_a_known_symbol_squared_behind_a_number_is_no_unit(text):
    assert spell(parse(text, ["m", "l", "a"])) == "1/2*m*l^2*a = 0"


@pytest.mark.parametrize("text", ["cart.x'' = 0", "cart.ẍ = 0"])
def test_a_name_with_an_owner_takes_dots_and_primes(text):
    (equation,) = parse(text, ("cart.x", "m")).equations
    assert equation.left == Sym("cart.x", 2)
    assert spell(equation) == "cart.ẍ = 0"


def test_names_with_blanks_stand_in_quotes_and_do_not_take_primes_away():
    program = parse("'crank drive'.Fx = m x''", ["'crank drive'.Fx", "m", "x"])
    assert symbols_in(program) == [Sym("'crank drive'.Fx"), Sym("m"), Sym("x", 2)]


@pytest.mark.parametrize("text", ["dθ/dt = 0", "d θ/dt = 0", r"\frac{d\theta}{dt} = 0"])
def test_a_parameter_d_does_not_hide_derivatives(text):
    assert symbols_in(parse(text, ["d", "t", "theta"])) == [Sym("theta", 1)]


def test_a_declared_name_goes_before_its_reading_as_a_rate():
    assert symbols_in(parse("thetadot = 0", ["theta", "thetadot"])) == [Sym("thetadot")]


def test_assignments_are_written_out():
    program = parse("I2 = m2*R^2\nL = I1 + I2\nL*omega = T", ["m2", "R", "I1", "omega", "T"])
    assert [a.name.name for a in program.assignments] == ["I2", "L"]
    assert [spell(e) for e in inlined(program)] == ["(I1 + m2*R^2)*omega = T"]


def test_a_known_symbol_on_the_left_is_stated_not_assigned():
    program = parse("a = 2\nF = m a", ["a", "m", "F"])
    assert not program.assignments


def test_chains_are_two_equations():
    assert [spell(e) for e in parse("a = b = c").equations] == ["a = b", "b = c"]


def test_terms_keep_their_signs():
    equation = parse("a − (b − c) = −d + 2*(e + f)").equations[0]
    assert [(sign, spell(term)) for sign, term in addends(equation.left)] == [(1, "a"), (-1, "b"), (1, "c")]
    assert [(sign, spell(term)) for sign, term in addends(equation.right)] == [(-1, "d"), (1, "2*(e + f)")]
    assert [spell(term) for term in terms(equation)] == ["a", "b", "c", "d", "2*(e + f)"]
    expanded = addends(parse("0 = −2*(e − f)/m").equations[0].right, expand=True)
    assert [(sign, spell(term)) for sign, term in expanded] == [(-1, "2*e/m"), (1, "2*f/m")]


def test_replacing_one_of_two_that_read_alike():
    equation = parse("a*b = b").equations[0]
    second = [n for n in walk(equation) if n == Sym("b")][1]
    assert spell(exchange(equation, second, Sym("c"))) == "a*b = c"


def test_spans_point_at_the_characters():
    text = "m l θ̈ = −(g/l) sin θ"
    program = parse(text, KNOWN)
    shown = {text[slice(*n.span)] for n in walk(program)}
    assert {"θ̈", "sin θ", "g/l", "−(g/l) sin θ", "m l θ̈"} <= shown


@pytest.mark.parametrize(
    "tree",
    [
        Add((Negative(Sym("a")), Negative(Negative(Sym("b"))))),
        Mul((Sym("a"), Mul((Sym("b"), Sym("c"))))),
        Mul((Mul((Sym("a"), Sym("b"))), Add((Sym("c"), Num(1.0))))),
        Negative(Mul((Negative(Sym("a")), Sym("b", 2)))),
    ],
)
def test_spelling_reads_back_as_the_same_tree(tree):
    assert parse_expression(spell(tree)) == tree
    assert parse_expression(latex(tree)) == tree


def test_letters_of_the_model_are_a_product_before_they_are_an_index():
    """M g of the model's own is no couple M_g of a guide; a parameter m_b of its own goes before m b."""
    own = ("M", "g", "m", "b", "m_b")
    assert spell(parse("Mg + M_g = 0", (*own, "M_g"), own)) == "M*g + M_g = 0"
    assert spell(parse("mb = 0", (*own, "M_g"), own)) == "m_b = 0"
