"""Every system of the catalogue: each question goes through, each answer agrees with its independent value."""

import math
import re
from dataclasses import replace

import pytest
from store import MODELS, every, mechanism

from freebody import catalogue
from freebody.catalogue import Answer, Asked, Question, ask
from freebody.catalogue.sentences import checks, folded, found, sentence
from freebody.catalogue.show import show_asked, show_summary
from freebody.solve.figures import Known


@every([system.id for system in catalogue.systems()], "identity")
def test_every_answer_agrees(identity):
    asked = list(catalogue.run(catalogue.find(identity)))
    wrong = [f"{q.label}: {q.failure}" for q in asked if q.failure]
    wrong += [
        f"{q.label}: {a.label}: {a.value} {a.unit} against {a.check}, {a.digits:.1f} digits"
        for q in asked
        for a in q.answers
        if not a.ok
    ]
    assert not wrong, "\n".join(wrong)
    assert all(q.answers for q in asked), "a question without an answer"


def test_every_system_has_a_main_model_unless_it_asks_about_others():
    for system in catalogue.systems():
        assert system.title
        assert system.models[0].name == "model.yaml" if system.models else system.id in ("GEN-FORMS", "GEN-METHOD")


def test_a_system_goes_by_its_id_and_its_folder_says_what_it_is():
    for system in catalogue.systems():
        assert re.fullmatch(r"(S?\d+(\.\d+)+|(EX|GEN)-[A-Z]+)", system.id)
        assert re.fullmatch(r"(-[a-z]+)+", system.folder.name.removeprefix(system.id))
        assert catalogue.find(system.id) == catalogue.find(system.folder.name.upper()) == system


@every(MODELS)
def test_every_model_says_how_long_it_runs(model):
    assert mechanism(model).run_plan(None, {}).until > 0


def test_digits():
    assert Answer("", 1.0, check=1.0).digits == 16
    assert Answer("", 1.001, check=1.0, tolerance=1e-2).ok
    assert not Answer("", math.nan, check=1.0, tolerance=1).ok
    assert Answer("", [0.0, 1e-3], check=0.0, tolerance=1e-3, scale=1.0).ok
    assert not Answer("", 1.0).ok, "an answer needs its check"


def test_a_failure_does_not_hide_what_came_before_it():
    @ask("half a question")
    def half(case):
        yield Answer("first", 1.0, check=1.0)
        raise ValueError("broken")

    assert isinstance(half, Question)
    asked = half.put_to(None)
    assert [a.label for a in asked.answers] == ["first"]
    assert asked.failure == "ValueError: broken"
    assert not asked.ok


def test_json_has_what_a_script_needs():
    rows = catalogue.rows({"X": [Asked("q", [Answer("a", [1.0, 2.0], "m", [1.0, 2.0], "closed form")], "stopped")]})
    assert rows[0] == {
        "system": "X", "question": "q", "sentence": "a = 1, 2 m", "label": "a", "variant": "", "value": [1.0, 2.0], "unit": "m", "check": [1.0, 2.0],
        "against": "closed form", "digits": 16.0, "tolerance": 1e-10, "ok": True, "independent": True,
    }  # fmt: skip
    assert rows[1] == {"system": "X", "question": "q", "failure": "stopped"}


def test_figures_are_printed_with_the_digits_that_agree_and_hold():
    assert found(Answer("", range(8), "m", check=range(8))) == "0, 1, 2, 3, 4, 5, … m (8 in all; --full)"
    assert found(Answer("", range(8), "m", check=range(8)), full=True) == "0, 1, 2, 3, 4, 5, 6, 7 m"
    assert found(Answer("", [1.0] * 3, "m", check=1.0)) == "1 m", "what stays the same is told once"
    assert found(Answer("", [1.23456789, 1e-17], check=[1.234568, 0.0])) == "1.234568, 0"
    assert found(Answer("", [Known(1.23456789, 3e-3, 1.0), 2.0], check=[1.23456789, 2.0])) == "1.23, 2"
    assert found(Answer("", Known(1.23456789, 3e-3, 1.0), check=1.23456789)) == "1.23"
    assert found(Answer("", [True, False], check=[True, False])) == "yes, no"


def test_an_answer_is_a_sentence():
    spin = Answer("θ̇", 2.5, "rad/s", check=2.5, against="closed form")
    assert sentence(spin) == "θ̇ = 2.5 rad/s"
    assert sentence(replace(spin, label="spin when flat")) == "spin when flat: 2.5 rad/s"
    assert sentence(replace(spin, said="√(3 g/l)")) == "θ̇ = √(3 g/l)"
    assert sentence(replace(spin, says="It falls flat at {}.")) == "It falls flat at 2.5 rad/s."
    both = replace(spin, value=[2.5, 3.0], check=[2.5, 3.0])
    assert sentence(replace(both, says="From {} to {}.")) == "From 2.5 rad/s to 3 rad/s."
    assert folded("g = 10", [spin]) == "g = 10: 2.5 rad/s"
    assert folded("g = 10", [spin, both]) == "g = 10: θ̇ = 2.5 rad/s; θ̇ = 2.5, 3 rad/s"


def test_the_small_print_says_what_agrees_and_what_does_not():
    right = Answer("a", 1.0, check=1.0, against="closed form")
    assert checks([right]) == "checked: closed form, 16 digits"
    assert checks([right, right]) == "checked: closed form, at least 16 digits"
    assert checks([replace(right, value=2.0)]) == "disagrees: a: closed form: 1, not 2"
    assert checks([replace(right, check=math.nan)]) == "not checked: a"


def test_variants_fold_to_a_line_each(capsys):
    asked = Asked(
        "How fast?", [Answer("v", x, "m/s", check=x, against="energy", variant=g) for g, x in (("", 1.0), ("g = 10", 2.0))]
    )
    show_asked(asked)
    assert capsys.readouterr().out.splitlines() == [
        "How fast?", "  v = 1 m/s", "    checked: energy, 16 digits", "  g = 10: 2 m/s", "    checked: energy, 16 digits", "",
    ]  # fmt: skip
    show_asked(asked, full=True)
    assert "  g = 10:\n  v = 2 m/s\n" in capsys.readouterr().out


def test_what_is_held_against_the_same_run_is_no_independent_answer(capsys):
    kept = Answer("energy", 1.0, check=1.0, against="energy put in", own=True)
    show_asked(Asked("q", [kept]))
    assert "of the same run, no check: energy put in" in capsys.readouterr().out
    show_summary({"X": [Asked("q", [kept, Answer("a", 1.0, check=1.0)])]})
    printed = capsys.readouterr().out
    assert re.search(r"X +1 +1 ", printed)
    assert "1 systems, 1 questions, 1 answers" in printed and "none disagrees" in printed.replace("\n", " ")


def test_the_summary_counts_what_does_not_agree(capsys):
    show_summary({"X": [Asked("q", [Answer("a", 2.0, check=1.0)], failure="stopped")]})
    printed = capsys.readouterr().out.replace("\n", " ")
    assert "FAILED" in printed and "2 do not agree" in printed


def test_several_processes_give_what_one_gives():
    asked = [catalogue.find(identity) for identity in ("19.3.16", "19.3.9")]
    shared = catalogue.rows({system.id: found for system, found in catalogue.run_all(asked)})
    assert shared == catalogue.rows({system.id: list(catalogue.run(system)) for system in asked})


def test_an_unknown_system_is_met_with_the_known_ones():
    with pytest.raises(KeyError, match=r"S19\.17"):
        catalogue.find("S19.99")
