"""How a run ends and why a state has no answer: one closed list of names."""

import re
from pathlib import Path

import pytest

import freebody as fb
from freebody.core import MotionError, OutcomeKind

CORE = Path(__file__).parents[2] / "crates/freebody/src"
OF_PYTHON = {OutcomeKind.HANDS_OVER_AT_ONCE}


def test_the_list_is_that_of_the_core():
    source = (CORE / "error.rs").read_text() + (CORE / "motion/outcome.rs").read_text()
    names = re.findall(r'"(\w+)"', re.sub("//.*", "", source))
    assert set(OutcomeKind) - OF_PYTHON == set(map(OutcomeKind, names))


def test_an_outcome_is_its_text():
    outcome = fb.load("examples/four_bar.yaml").simulate(until=0.01).outcome
    assert outcome.name is OutcomeKind.COMPLETED and outcome.name == "Completed" and f"{outcome.name}" == "Completed"


def test_a_name_that_no_outcome_has_is_refused():
    with pytest.raises(ValueError, match="finished"):
        OutcomeKind("finished")


def test_what_moves_without_inertia_is_named():
    m = fb.Mechanism("massless", gravity=9.81)
    rod = m.rod("rod", length=1, mass=0)
    m.hinge(m.ground.O, rod.start, name="pivot")
    with pytest.raises(MotionError, match="no inertia to resist it") as refused:
        m.solve()
    assert (refused.value.kind, refused.value.path) == (OutcomeKind.SINGULAR_MASS, "bodies.rod")
