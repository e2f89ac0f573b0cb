"""An expression without a finite value says so, where it was asked for; nothing else is harmed."""

import json

import numpy as np
import pytest
from scipy.special import sici
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app

MODEL = """
freebody: 1
gravity: none
parameters: {speed: 1 m/s}
ground: {lines: {rail: {through: O, angle: 0}}}
bodies: {b: {shape: particle, mass: 1 kg}}
joints: {track: {type: slot, along: ground.rail, point: b.centre, coordinate: s}}
events: {half: {when: s - 0.5 m, direction: rising, then: record}}
initial: {s: 0, rates: {s: speed}}
run: {until: 1 s, every: 0.25 s}
"""
X = "(s/(1 m))"
EVERYWHERE = [f"sqrt(-1 - {X})", f"exp(1000 + {X})", f"acos(2 + {X})", f"exp(1000 + {X})/exp(900 + {X})"]
DIVERGING = [f"1/{X}", f"-1/{X}", *EVERYWHERE]
MEANS = {f"ln{X}": -1.0, f"{X}/{X}": 1.0, f"sin{X}/{X}": sici(1.0)[0]}
"""Without a value at the start; their means in 1 s by closed forms."""
AT_START = [*DIVERGING, *MEANS]
ONLY_WITHIN = [f"rms of exp(500 + {X})", f"integral of exp(709 + {X}/10)/(0.01 s)"]
POLES = [f"1/({X} - 0.37)", f"1/({X} - 0.61)^2", f"tan(pi*{X}*0.83)", f"tan(pi*{X}*0.8)", f"1/({X} - 0.5)"]
"""Infinite at a moment between all that are kept, at a halving of these, and where a step ends."""
ASKED = (
    [f"{text} @ start" for text in AT_START]
    + [f"{text} @ {moment}" for text in EVERYWHERE for moment in ("end", "half", "before half", "0.25 s")]
    + [f"{how} of {text}" for text in AT_START for how in ("max", "minima")]
    + [f"mean of {text}" for text in DIVERGING]
    + ONLY_WITHIN
    + [f"{how} of {text}" for text in POLES for how in ("mean", "integral", "rms")]
)
SOUND = {
    "where": ("s @ end", 1.0),
    "logarithm": (f"ln{X} @ half", np.log(0.5)),
    "root": (f"max of sqrt{X}", 1.0),
} | {f"mean {i}": (f"mean of {text}", value) for i, (text, value) in enumerate(MEANS.items())}
"""What has a value, of which some are without one elsewhere, by closed forms of s = t."""


def mechanism(asked):
    return fb.Mechanism.loads(MODEL + "report:\n" + "".join(f"  {label}: {text}\n" for label, text in asked.items()))


def numbered(texts):
    return {f"q{i}": text for i, text in enumerate(texts)}


@pytest.mark.filterwarnings("error")
def test_a_report_says_what_has_no_finite_value_and_gives_the_rest():
    run = mechanism(numbered(ASKED) | {label: text for label, (text, _) in SOUND.items()}).simulate()
    for report in (run.report, run.accuracy.report):
        for label, text in numbered(ASKED).items():
            assert report[label].value is None and "has no finite value" in str(report[label]), text
        for label, (_, value) in SOUND.items():
            assert report[label].value == pytest.approx(value, abs=1e-9), label
    assert run.accuracy.report["logarithm"].value.digits > 8


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("text", [text.replace("(s/(1 m))", "(s)") for text in AT_START])
def test_an_instant_and_a_run_refuse_it_with_the_moment(text):
    made = mechanism({"where": "s @ end"})
    now, run = made.solve(), made.simulate()
    at_start = (now.__getitem__, now.derivatives, run.__getitem__, run.digits, lambda text: run.before(text, 0.0))
    for read in at_start:
        with pytest.raises(fb.NotFinite, match="has no finite value at t = 0 s"):
            read(text)
    with pytest.raises(fb.NotFinite, match=r"at t = 0\.5 s"):
        run.evaluate("1/(t - 0.5)", [0.25, 0.5, 0.75])


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("command", ["run", "certify"])
@pytest.mark.parametrize("as_json", [False, True])
def test_commands_print_the_sentence_and_no_infinity(tmp_path, monkeypatch, command, as_json):
    monkeypatch.chdir(tmp_path)
    asked = "report:\n" + "".join(f"  {label}: {text}\n" for label, text in numbered(ASKED[:12]).items())
    (tmp_path / "m.yaml").write_text(MODEL + asked)
    done = CliRunner().invoke(app, [command, "m.yaml", *["--json"] * as_json])
    assert done.exit_code == 0, done.output
    assert not any(word in done.output.lower() for word in ("nan", "inf", "indeterminate", "warning", "traceback"))
    if command == "run":
        assert done.output.count("has no finite value" if as_json else "no finite") == 12
    if as_json:
        assert all(each["value"] is None for each in json.loads(done.stdout).get("report", {}).values())


def test_what_is_infinite_at_a_moment_can_have_a_mean():
    """∫ dx/√|x − a| from 0 to 1 is 2 (√a + √(1 − a))."""
    found = mechanism({"q": f"mean of 1/sqrt(abs({X} - 0.37))"}).simulate().report["q"].value
    assert found == pytest.approx(2 * (np.sqrt(0.37) + np.sqrt(0.63)), rel=1e-4)
