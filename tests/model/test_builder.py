"""The builder: handles, signatures, arithmetic, the start of a motion."""

from __future__ import annotations

import inspect
import subprocess
import sys
from typing import ClassVar

import numpy as np
import pytest

from freebody.core import ModelError, cards
from freebody.mechanism import Mechanism
from freebody.model.errors import ModelFileError


class Core:
    """A compiled mechanism that knows two parameters."""

    metadata: ClassVar = {"parameters": [{"name": "T", "unit": "N*m", "value": 1.0}, {"name": "l", "unit": "m", "value": 2.0}]}

    def bind(self, values):
        return np.array([values.get("T", 1.0), values.get("l", 2.0)])


@pytest.fixture
def pendulum(monkeypatch):
    m = Mechanism("double pendulum", gravity=9.81)
    m.parameter("T", "1 N*m")
    length = m.parameter("l", "2 m")
    upper = m.rod("upper", length=length, mass="2 kg")
    lower = m.rod("lower", length=length / 2, mass="2 kg")
    m.hinge(m.ground.O, upper.start, coordinate="phi1")
    m.hinge(upper.end, lower.start, coordinate="phi2")
    m.initial(phi1="0.25*l", phi2="90 deg", rates={"phi1": "60 rpm"})
    monkeypatch.setattr(m, "compile", Core)
    return m


def test_the_example_of_the_design(pendulum):
    model = pendulum.model
    assert model.joints["hinge2"].written() == {"type": "hinge", "of": ["upper.end", "lower.start"], "coordinate": "phi2"}
    assert model.bodies["lower"].length == "l / 2"
    pendulum.lowered()


def test_the_start_of_a_motion(pendulum):
    start = pendulum.initial_state()
    assert start["fixed"] == {"phi1": 0.5, "phi2": pytest.approx(np.pi / 2)}
    assert start["rates"] == {"phi1": pytest.approx(2 * np.pi)}
    other = pendulum.initial_state({"phi1": "20 deg", "l": "400 mm", "rates": {"phi2": 1}, "guess": {"phi2": 0.1}})
    assert list(other["p"]) == [1.0, 0.4]
    assert other["fixed"]["phi1"] == pytest.approx(np.radians(20))
    assert other["rates"]["phi2"] == 1.0
    assert pendulum.initial_state({"at_rest": True})["rates"] == {}


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        ({"phi3": 1}, "did you mean `phi1`"),
        ({"phi1": "3 kg"}, "`3 kg` is a mass"),
        ({"T": "1 m"}, "`T` is a torque"),
        ({"phi1": "2*q"}, "no parameter `q`"),
        ({"at_rest": True, "rates": {"phi1": 1}}, "contradict each other"),
    ],
)
def test_wrong_overrides(pendulum, overrides, words):
    with pytest.raises(ModelFileError, match=words) as caught:
        pendulum.initial_state(overrides)
    assert caught.value.problems[0].where.file == __file__


def test_handles_stand_for_names():
    m = Mechanism()
    wheel = m.disk("wheel", radius="200 mm", mass=1, points={"rim": [0.2, 0]})
    assert (wheel.centre, wheel.rim, wheel.origin, wheel.G) == ("wheel.centre", "wheel.rim", "wheel.origin", "wheel.G")
    assert wheel.point("top", (0, np.float64(0.2))) == wheel.top == "wheel.top"
    assert m.model.bodies["wheel"].points == {"rim": [0.2, 0], "top": [0, 0.2]}
    road = m.ground.line("road", m.ground.O, angle="-5 deg")
    assert road == m.ground.road == "ground.road"
    roll = m.rolling(on=m.ground.road, circle={"centre": wheel.centre, "radius": "200 mm"})
    motor = m.law(along=roll.coordinate, value=3 - roll.coordinate, name="motor")
    assert m.model.forces["motor"].value == "3 - rolling.s"
    assert motor["power"] == "motor.power"
    m.lowered()


def test_arithmetic_keeps_its_meaning():
    m = Mechanism()
    a, b = m.parameter("a", 2), m.parameter("my b", 3)
    assert (a + b) * 2 == "(a + 'my b') * 2" or (a + b) * 2 == "(a + ('my b')) * 2"
    assert -(a - 1) == "-(a - 1)"
    assert 2 / (a * a) == "2 / (a * a)"
    assert (-a) ** 2 == "(-a) ^ 2"


@pytest.mark.parametrize("card", [*cards.joints().values(), *cards.forces().values()], ids=lambda card: card.type)
def test_every_joint_and_force_is_a_method(card):
    method = getattr(Mechanism, card.type)
    words = [w.rstrip("_") for w in inspect.signature(method).parameters]
    assert [f.name for f in card.fields if f.name not in words] == []
    assert card.doc in method.__doc__


def test_what_is_wrong_is_said_at_the_call():
    m = Mechanism()
    m.rod("rod", length=1, mass=1)
    with pytest.raises(ModelFileError, match="used twice") as caught:
        m.rod("rod", length=1, mass=1)
    assert "m.rod(" in caught.value.problems[0].where.excerpt
    with pytest.raises(ModelFileError, match="did you mean `length`"):
        m.rod("other", lenght=1, mass=1)
    assert list(m.model.bodies) == ["rod"]


def test_parameters_can_be_overruled():
    m = Mechanism.loads("freebody: 1\nparameters: {l: 1 m, m: 2*k, k: 1}\nparts: {leg: {file: leg.yaml}}\n")
    m.parameters.update({"l": "2 ft", "leg.size": np.float64(3)})
    assert dict(m.parameters) == {"l": "2 ft", "m": "2*k", "k": 1}
    assert m.model.parts["leg"].written() == {"file": "leg.yaml", "parameters": {"size": 3.0}}
    with pytest.raises(ModelFileError, match="no parameter `q`"):
        m.parameters["q"] = 2


def test_the_spec_is_made_again_only_after_a_change():
    m = Mechanism()
    m.particle("a", mass=1)
    first = m.lowered()
    assert m.lowered() is first
    m.model.bodies["a"].mass = 2
    assert m.lowered().spec["bodies"][0]["pieces"][0]["mass"] == 2.0


BOX = """
freebody: 1
parameters: {e: 0.5, mu: 0.3, mu_rest: 0.4, mass: 2 kg}
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {box: {shape: rectangle, width: 1 m, height: 1 m, mass: mass}}
joints: {place: {type: free, of: [ground.O, box.centre], coordinates: [x, y, phi]}}
contacts: {touch: {of: [box, ground.floor], restitution: e, friction: mu, static_friction: mu_rest}}
initial: {x: 0, y: 2 m, phi: 0}
"""


@pytest.mark.parametrize("number", [{"e": 1.2}, {"e": -0.1}, {"mu": -0.2}, {"mu_rest": 0.1}, {"mass": -1.0}], ids=str)
def test_numbers_that_nothing_can_have_are_refused_at_any_call(number):
    m = Mechanism.loads(BOX)
    for call in (m.solve, m.simulate):
        with pytest.raises(ModelError, match=r"restitution|friction|mass"):
            call(**number, **({"until": 0.1} if call == m.simulate else {}))


def test_many_items_take_linear_time():
    m = Mechanism()
    for i in range(2000):
        m.particle(f"p{i}", mass=1)
    assert len(m.lowered().spec["bodies"]) == 2000


def test_units_wait_until_they_are_needed():
    code = "import sys, freebody.model.units as u; u.quantity('3 N*m'); assert 'pint' not in sys.modules; u.quantity('3 furlong'); assert 'pint' in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
