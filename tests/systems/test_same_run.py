"""No check is of the same run as its answer. Where every parameter of the models is a little off, a check that comes another way
disagrees; one that was computed from the run moves with it, and agrees still."""

import re

import numpy as np
import pytest
from store import every

from freebody import catalogue
from freebody.catalogue import Answer, Case, ask

NUMBER = re.compile(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)(\s*[^\d\s+\-*/(].*)?")
WITHIN = 1e-9
"""Figures that move by less did not move."""


class Shifted(Case):
    """The models of a system, each number among their parameters off by some parts in a thousand, but those that a question states and
    whole ones without a unit, which count spokes or name a side."""

    def mechanism(self, file="model.yaml", **parameters):
        known = list(self._mechanisms.values())
        made = super().mechanism(file, **parameters)
        for i, (name, value) in enumerate([] if made in known else sorted(made.parameters.items())):
            found = None if name in parameters else NUMBER.fullmatch(str(value))
            if found and (found[2] or not float(found[1]).is_integer()):
                off = float(found[1]) * (1 + 0.003 * (1 + i % 5))
                made.parameters[name] = f"{off!r}{found[2]}" if found[2] else off
        return made


def of_the_same_run(system, question):
    """Answers whose check moves with the model and agrees as before. A check by another model of the program's says so; what cannot be
    asked of the shifted model is not decided."""
    asked, shifted = (question.put_to(case(system.folder)).answers for case in (Case, Shifted))
    return [
        f"{question.label}: {one.label}: {one.against}"
        for one, other in zip(asked, shifted, strict=False)
        if not (one.own or one.against.startswith("other route")) and other.ok and moved(one.check, other.check)
    ]


def moved(check, other):
    check, other = np.asarray(check, float), np.asarray(other, float)
    return check.shape != other.shape or not np.allclose(check, other, rtol=WITHIN, atol=1e-14, equal_nan=True)


@pytest.mark.long
@every([system.id for system in catalogue.systems()], "identity")
def test_no_check_is_of_the_same_run(identity):
    system = catalogue.find(identity)
    assert not [told for question in system.questions() for told in of_the_same_run(system, question)]


@pytest.mark.parametrize(
    ("identity", "asked"),
    [("19.3.30", "(c) On a level floor"), ("GEN-METHOD", "4. What are they in numbers"), ("EX-ARM", "What are they at θ1 = 30°")],
)
def test_what_is_quick_to_ask_is_asked_of_the_shifted_model(identity, asked):
    """Also where parameters count bodies or points, and where a question goes to models of other systems."""
    system = catalogue.find(identity)
    (question,) = (each for each in system.questions() if each.label.startswith(asked))
    shifted = question.put_to(Shifted(system.folder))
    assert shifted.answers and not shifted.failure
    assert any(not answer.ok for answer in shifted.answers)
    assert not of_the_same_run(system, question)


def test_a_check_of_the_same_run_is_found():
    @ask("what is kept")
    def sham(case):
        run = case.run()
        energy = run.evaluate("energy()", [0.0, 1.0])
        yield Answer("energy", energy[1], "J", energy[0], "conservation of energy", 1e-9)
        yield Answer("mass", run.evaluate("m", 1.0), "kg", 70.0, "the model")

    assert of_the_same_run(catalogue.find("19.3.6"), sham) == ["what is kept: energy: conservation of energy"]
