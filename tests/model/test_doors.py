"""What comes in through a door is read as it is meant, or refused with its place: names, numbers, files, budgets."""

import math
import os
import random
import tracemalloc
from itertools import product

import pytest

from freebody.core import cards
from freebody.mechanism import Mechanism
from freebody.model import expand, names, units
from freebody.model.errors import ModelFileError, ModelProblem

PENDULUM = """freebody: 1
parameters: {al: 10 deg, m1: 1 kg}
gravity: none
bodies: {b: {shape: rod, length: 1 m, mass: m1}}
joints: {p: {type: hinge, of: [ground.O, b.start], coordinate: theta}}
"""
SLIDER = """freebody: 1
parameters: {k: 2 N/m}
gravity: none
bodies: {b: {shape: particle, mass: 1 kg}}
joints: {g: {type: slot, along: {through: ground.O, angle: 0}, point: b.centre, coordinate: COORDINATE}}
"""


def refused(text):
    """The one complaint about a text."""
    with pytest.raises(ModelFileError) as caught:
        Mechanism.loads(text).compile()
    (problem,) = caught.value.problems
    assert problem.where.line > 0 and problem.where.column > 0, problem
    return problem


# -- numbers -------------------------------------------------------------------------------------

UNITS = [*units._EVERYDAY, "ft", "lb"]


def compound(rng):
    """A random unit like ``kg*m^2/s``."""
    words = rng.sample(UNITS, rng.randint(1, 3))
    powers = [rng.choice(["", "", "^2", "²", "^-1", "^3"]) for _ in words]
    return "".join(
        f"{rng.choice('*/') if i else ''}{word}{power}" for i, (word, power) in enumerate(zip(words, powers, strict=True))
    )


@pytest.mark.parametrize("seed", range(100))
def test_a_number_with_a_unit_is_the_same_alone_and_within_an_expression(seed):
    rng = random.Random(seed)
    written = f"{rng.uniform(0.1, 9):.3f} {compound(rng)}"
    alone, within = units.quantity(written), units.rewrite(f"x + {written}")
    assert within.text == f"x + {alone.value!r}" and within.numbers == [alone.dimension]


@pytest.mark.parametrize("word", [word for word in units._EVERYDAY if word.isalpha()])
@pytest.mark.parametrize("written", ["2 m/{}", "2 m*{}", "2 m^2/kg/{}", "3 1/{}"])
def test_a_unit_that_is_a_name_of_the_model_is_refused_within_an_expression(word, written):
    text = SLIDER.replace("COORDINATE", word) + f"gauges: {{e: '1*({written.format(word)})'}}\n"
    problem = refused(text)
    assert f"`{word}` is a unit and a name of the model" in problem.what and problem.where.path == "gauges.e"


def test_a_speed_beside_a_coordinate_of_another_name_is_a_speed():
    m = Mechanism.loads(SLIDER.replace("COORDINATE", "r") + "motions: {push: {of: r, is: 1 m + (2 m/s)*t}}\n")
    end = m.simulate(1.0, initial={"guess": {"r": 1.0}}).instant(1.0)
    assert end["r"] == pytest.approx(3, rel=1e-12) and end["rate(r)"] == pytest.approx(2, rel=1e-12)


@pytest.mark.parametrize("written", ["1e400 kg", "1e308 t", "2*1e400 kg", "1e400", "9" * 310, "9" * 400, "-.inf", ".nan"])
def test_a_number_beyond_all_floating_point_numbers_is_refused(written):
    refused(PENDULUM.replace("mass: m1", f"mass: {written}"))


@pytest.mark.parametrize("call", ["if(1)", "if(1, 2, 3, 4)", "step()", "min()", "clamp(1)", "atan2(1)", "rate(1)"])
def test_a_call_that_cannot_be_is_refused_in_a_number(call):
    assert f"`{call.partition('(')[0]}" in refused(PENDULUM.replace("mass: m1", f"mass: '{call}'")).what


@pytest.mark.parametrize("written", ["10/s", "10 1/s", "10 Hz", "0.01/ms", "600/min"])
def test_a_rate_as_people_write_it(written):
    m = Mechanism.loads(PENDULUM.replace("al: 10 deg", f"w: {written}"))
    assert m.compile().bind()[0] == pytest.approx(10, rel=1e-15)


@pytest.mark.parametrize("written", ["2024-01-01", "'2024-01-01'", "2024-01-01 10:00:00"])
def test_a_date_is_no_mass(written):
    assert "is a date" in refused(PENDULUM.replace("mass: m1", f"mass: {written}")).what


@pytest.mark.parametrize("value", [30, -90, 360])
def test_an_angle_of_many_turns_is_asked_about(value):
    meant = f"for degrees write `{value} deg`"
    assert any(meant in note for note in Mechanism.loads(f"{PENDULUM}initial: {{theta: {value}}}\n").start()[1])
    m = Mechanism.loads(PENDULUM)
    assert any(meant in note for note in m.start(theta=value)[1])
    assert not m.start(theta=f"{value} deg")[1] and not m.start(theta=1)[1] and not m.start(rates={"theta": value})[1]


@pytest.mark.parametrize("direction", [("sin(al)", "-cos(al)"), ("cos(al)", "sin(al)"), ("tanh(al)", "cos(2*al)")])
def test_a_direction_is_no_gravity_but_with_a_size(direction):
    gravity = lambda size: PENDULUM.replace("gravity: none", f"gravity: [{', '.join(f'{size}({part})' for part in direction)}]")
    assert "is a direction" in refused(gravity("")).what
    Mechanism.loads(gravity("9.81 m/s^2*")).compile()


@pytest.mark.parametrize("seed", range(20))
def test_a_potential_is_that_of_its_force_or_refused(seed):
    rng = random.Random(seed)
    terms = [(rng.choice([-1, 1]) * rng.uniform(0.5, 2), rng.randint(1, 4)) for _ in range(3)]
    force = " ".join(f"- ({a * n:.17g} N)*(r/(1 m))^{n - 1}" for a, n in terms)
    potential = " + ".join(f"({a:.17g} J)*(r/(1 m))^{n}" for a, n in terms)
    law = f"forces:\n  f: {{type: law, along: r, value: '{force}', potential: 'FACTOR*({potential})'}}\n"
    text = SLIDER.replace("COORDINATE", "r") + law
    Mechanism.loads(text.replace("FACTOR", "1")).compile()
    for factor in ("-1", "2", "0.999"):
        problem = refused(text.replace("FACTOR", factor))
        assert problem.where.path == "forces.f.potential"


@pytest.mark.parametrize("function", ["atan", "sin", "exp", "tanh"])
def test_a_rate_is_no_argument_and_the_hint_makes_it_one(function):
    problem = refused(f"{PENDULUM}events: {{e: {{when: {function}(rate(theta)) - 0.3}}}}\n")
    mended = problem.hint.split("`")[1]
    Mechanism.loads(f"{PENDULUM}events: {{e: {{when: {function}({mended}) - 0.3}}}}\n").compile()


# -- names ---------------------------------------------------------------------------------------

PLACES = {
    "parameters": "parameters: {NAME: 1 kg}",
    "tables": "tables: {NAME: {x: [0, 1], y: [0, 1]}}",
    "gauges": "gauges: {NAME: theta}",
    "forces": "forces: {NAME: {type: force, at: b.end, x: 1 N}}",
    "motions": "motions: {NAME: {of: theta, is: 0*t}}",
    "stops": "stops: {NAME: {of: theta, least: 0}}",
    "events": "events: {NAME: {when: theta}}",
    "points": "ground: {points: {NAME: [0, 0]}}",
}


@pytest.mark.parametrize("sign", ["`", "&", "#", "\\\\", "\\u0001", "\\e", "\\x7f", "\\x85", "\\ud800", "|", "@"])
@pytest.mark.parametrize("section", PLACES)
def test_a_sign_that_no_output_can_carry_is_refused_in_every_name(section, sign):
    text = PENDULUM.replace("parameters: {al: 10 deg, m1: 1 kg}\n", "").replace("m1", "1 kg")
    problem = refused(text + PLACES[section].replace("NAME", f'"a{sign}b"') + "\n")
    assert "a name cannot hold" in problem.what


@pytest.mark.parametrize("name", ["sin", "atan2", "if", "rate", "distance", "t", "pi"])
def test_a_table_takes_no_name_that_has_a_meaning(name):
    assert "meaning of its own" in refused(f"{PENDULUM}tables: {{{name}: {{x: [0, 1], y: [0, 1]}}}}\n").what


@pytest.mark.parametrize("word", names._SYNONYMS)
def test_words_of_other_books_are_answered_with_ours(word):
    kinds = {*cards.joints(), *cards.forces(), "rod", "disk", "ring", "rectangle", "particle"}
    assert set(names._SYNONYMS[word]) <= kinds
    shape = names._SYNONYMS[word][0] not in {*cards.joints(), *cards.forces()}
    text = PENDULUM.replace("shape: rod", f"shape: {word}") if shape else PENDULUM.replace("type: hinge", f"type: {word}")
    if names._SYNONYMS[word][0] in cards.joints() or shape:
        assert refused(text).hint == f"did you mean {' or '.join(f'`{w}`' for w in sorted(names._SYNONYMS[word]))}?"


# -- elements that cannot be -------------------------------------------------------------------


@pytest.mark.parametrize("words", ["value: 3 N", "value: 3 N, frame: body", ""])
def test_a_force_has_a_direction(words):
    force = ", ".join(filter(None, ["type: force", "at: b.end", words]))
    assert "has no direction" in refused(f"{PENDULUM}forces: {{f: {{{force}}}}}\n").what


def test_a_link_has_no_negative_length():
    text = PENDULUM.replace("hinge, of: [ground.O, b.start], coordinate: theta", "link, of: [ground.O, b.start], length: -1")
    assert "cannot be negative" in refused(text).what


# -- budgets -------------------------------------------------------------------------------------


@pytest.mark.parametrize(("word", "value"), [*product(["until", "rtol", "every", "step", "max_step"], [-1, math.inf, math.nan]),
                                             *product(["rtol", "every", "step", "max_step"], [0])])  # fmt: skip
def test_a_run_has_settings_that_can_be(word, value):
    with pytest.raises((ModelFileError, ModelProblem), match=r"above 0|finite"):
        Mechanism.loads(PENDULUM).simulate(**{"until": 1.0} | {word: value})
    if math.isfinite(value):
        assert refused(f"{PENDULUM}run: {{{word}: {value}}}\n").where.path == f"run.{word}"


@pytest.mark.parametrize(("word", "value"), [("rtol", 1.0), ("rtol", 30), ("every", 1e-12), ("step", 1e-9)])
def test_what_a_run_keeps_has_a_limit(word, value):
    refused(f"{PENDULUM}run: {{until: 10 s, {word}: {value}}}\n")
    with pytest.raises(ModelFileError, match=word):
        Mechanism.loads(PENDULUM).simulate(10, **{word: value})


@pytest.mark.parametrize("method", [word for word, method in cards.methods().items() if method.fixed_step])
def test_a_method_of_fixed_steps_needs_one(method):
    with pytest.raises(ModelFileError, match="needs a fixed step"):
        Mechanism.loads(PENDULUM).simulate(1.0, method=method)


REPEATED = {
    "a product": ("bodies: {'a[i = 1 .. 999][j = 1 .. 999]': BALL}", {}),
    "items of items": ("bodies: {'a[i = 1 .. 999]': {mass: 1, points: {'p[j = 1 .. 99]': [0, i]}}}", {}),
    "within parts": ("parts: {'p[k = 1 .. 90]': {file: p.yaml}}", {"p": "bodies: {'a[i = 1 .. 999]': BALL}"}),
    "parts of parts": (
        "parts: {'p[k = 1 .. 30]': {file: p.yaml}}",
        {"p": "parts: {'q[k = 1 .. 30]': {file: q.yaml}}", "q": "bodies: {'a[i = 1 .. 900]': BALL}"},
    ),
    "large items": ("bodies: {'a[i = 1 .. 999]': {mass: 1, outline: [" + "O, " * 999 + "O]}}", {}),
}


@pytest.mark.parametrize("kind", REPEATED)
def test_what_repetitions_make_has_a_limit_before_memory_is_taken(kind, tmp_path, monkeypatch):
    monkeypatch.setattr(expand, "MAX_ITEMS", 1000)
    monkeypatch.setattr(expand, "MAX_NODES", 40_000)
    whole, parts = REPEATED[kind]
    for name, text in {"m": whole, **parts}.items():
        (tmp_path / f"{name}.yaml").write_text(f"freebody: 1\n{text.replace('BALL', '{shape: particle, mass: 1}')}\n")
    tracemalloc.start()
    with pytest.raises(ModelFileError) as caught:
        Mechanism.load(tmp_path / "m.yaml").compile()
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    (problem,) = caught.value.problems
    assert "the model has more than" in problem.what and problem.where.line == 2 and peak < 30e6


@pytest.mark.parametrize("ask", [{"every": 1e-5}, {"t_eval": range(20_000_000)}])
def test_rows_and_columns_of_a_run_have_a_limit(ask):
    chain = "".join(f"  b{i}: {{shape: particle, mass: 1}}\n" for i in range(20))
    with pytest.raises(ValueError, match=r"1e\+08 figures are kept"):
        Mechanism.loads(f"freebody: 1\nbodies:\n{chain}").simulate(9.0, **ask)


@pytest.mark.parametrize(("option", "value"), [*product(["until"], ["inf", "nan", "3 kg", "3x", "1e400", "soon"]),
                                               *product(["rtol"], [math.inf, math.nan, -1.0, 0.0])])  # fmt: skip
def test_an_option_that_cannot_be_is_answered_with_its_name_its_value_and_an_example(option, value):
    with pytest.raises((ModelFileError, ModelProblem)) as caught:
        Mechanism.loads(PENDULUM).simulate(**{"until": 1.0} | {option: value})
    stated = str(caught.value)
    what, hint = (
        (caught.value.problems[0].what, caught.value.problems[0].hint) if hasattr(caught.value, "problems") else caught.value.args
    )
    assert f"`{option}` is" in what and str(value).split(".")[0] in what and hint, stated


def test_what_is_said_of_many_places_is_one_complaint():
    forces = "".join(f"  f{i}: {{type: force, at: b.end, x: {i}*push}}\n" for i in range(10))
    hinges = "".join(f"  h{i}: {{type: hinge, of: [ground.O, rod.start]}}\n" for i in range(5))
    with pytest.raises(ModelFileError) as caught:
        Mechanism.loads(
            PENDULUM.replace("joints: {p: ", "joints:\n  p: ").replace("theta}}", "theta}") + hinges + "forces:\n" + forces
        ).compile()
    hinge, push = caught.value.problems
    assert hinge.what == "there is no body `rod`" and [place.path for place in hinge.also] == [
        f"joints.h{i}.of[1]" for i in range(1, 5)
    ]
    assert push.what == "nothing is called `push`" and len(push.also) == 9 and "and 5 more" in str(push)


def test_parts_of_parts_have_a_limit(tmp_path):
    part = "freebody: 1\nparts: {{a: {{file: {0}.yaml}}, b: {{file: {0}.yaml}}, c: {{file: {0}.yaml}}}}\n"
    for depth in range(15):
        (tmp_path / f"{depth}.yaml").write_text(part.format(depth + 1))
    (tmp_path / "15.yaml").write_text("freebody: 1\n")
    with pytest.raises(ModelFileError, match="at most 1000 parts"):
        Mechanism.load(tmp_path / "0.yaml").compile()


def test_changes_of_a_motion_are_those_of_an_instant():
    m = Mechanism.loads(PENDULUM.replace("none", "9.81"))
    run = m.simulate(0.1, m1=3, theta="20 deg", rates={"theta": 2})
    start, solved = run.instant(0.0), m.solve(m1=3, theta="20 deg", rates={"theta": 2})
    assert start["theta"] == solved["theta"] and start["p.Fy"] == pytest.approx(solved["p.Fy"], rel=1e-12)
    with pytest.raises(ModelFileError, match="no coordinate or parameter `b`"):
        m.simulate(0.1, b=0.11)


# -- files ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("tag", ["int", "float"])
@pytest.mark.parametrize("text", ["abc", "1.2.3", "''", "0x", "[]"])
def test_a_tag_that_lies(tag, text):
    with pytest.raises(ModelFileError):
        Mechanism.loads(PENDULUM.replace("mass: m1", f"mass: !!{tag} {text}"))


@pytest.mark.parametrize("call", ["atan2(theta, 2)", "min(theta, 1)", "if(theta > 0, 1, 2)", "clamp(theta, 0, 1)"])
def test_a_comma_of_a_function_in_braces(call):
    assert "quotes" in refused(f"{PENDULUM}gauges: {{g: {call}}}\n").hint
    Mechanism.loads(f"{PENDULUM}gauges: {{g: '{call}'}}\n").compile()


def test_only_regular_files_are_read(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    for path in (tmp_path, tmp_path / "pipe.yaml", tmp_path / "a\0b.yaml", tmp_path / ("x" * 5000)):
        with pytest.raises(ModelFileError):
            Mechanism.load(path)


@pytest.mark.parametrize("name", ["m.yaml", "m.json"])
def test_a_save_that_fails_midway_leaves_the_old_file(tmp_path, monkeypatch, name):
    path, m = tmp_path / name, Mechanism.loads(PENDULUM)
    m.save(path)
    before = path.read_bytes()

    def full(self, data):
        with open(self, "wb") as out:
            out.write(data[: len(data) // 2])
        raise OSError(28, "No space left on device", str(self))

    monkeypatch.setattr(type(path), "write_bytes", full)
    m.parameters["m1"] = "2 kg"
    with pytest.raises(OSError, match="No space"):
        m.save(path)
    assert path.read_bytes() == before and [file.name for file in tmp_path.iterdir()] == [name]
