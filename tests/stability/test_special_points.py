"""Curves of equilibria with Hopf points, of loops, and cut short; what is not judged or is no input; the command."""

import json
from math import sin

import numpy as np
import PIL.Image
import pytest
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app
from freebody.stability import continuation
from freebody.stability.state_space import state_space
from freebody.views.modes import draw_modes

SHIMMY = """
freebody: 1
parameters: {m: 2 kg, k: 50 N/m, c: 3 N*s/m, w: 1 N*s/m, F: 0 N}
gravity: none
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
forces:
  spring: {type: law, along: x, value: -k*x}
  belt: {type: law, along: x, value: (w - c)*rate(x)}
  push: {type: force, at: cart.centre, x: F}
initial: {x: 0, rates: {x: 0}}
"""
STRUT = """
freebody: 1
parameters: {l: 0.5 m, c: 8 N*m, F: 1 N}
gravity: none
bodies: {lower: {shape: rod, length: l, mass: 1}, upper: {shape: rod, length: l, mass: 1}}
joints:
  foot: {type: hinge, of: [ground.O, lower.start], coordinate: {name: phi, zero: up}}
  knee: {type: hinge, of: [lower.end, upper.start], coordinate: knee}
  top: {type: slot, along: {through: ground.O, angle: 90 deg}, point: upper.end}
forces:
  spring: {type: law, along: phi, value: -c*phi}
  load: {type: force, at: upper.end, y: -F}
initial: {phi: 0, guess: {knee: 0}}
"""


def test_an_oscillation_begins_to_grow_at_a_hopf_point():
    """m ẍ + (c − w) ẋ + k x = 0: λ = ((w − c) ± …)/2m, and its real part is 0 at w = c."""
    (curve,) = fb.Mechanism.loads(SHIMMY).equilibria_along("w", ("1 N*s/m", "5 N*s/m"))
    (special,) = curve.special
    assert (special.kind, special.value) == ("Hopf point", pytest.approx(3, rel=1e-9))
    assert [rest.stability for rest in curve.equilibria] == ["stable" if w < 3 else "unstable" for w in curve.values]


def test_a_strut_of_a_loop_buckles_at_a_branch_point():
    """Two bars and a guide: cφ = 2Fl sin φ, so that F = c/2l at φ = 0."""
    strut = fb.Mechanism.loads(STRUT)
    straight, buckled = strut.equilibria_along("F", (1, 20))
    for curve in (straight, buckled):
        (special,) = curve.special
        assert (special.kind, special.value) == ("branch point", pytest.approx(8, rel=1e-8))
    for force, rest in zip(buckled.values, buckled.equilibria, strict=True):
        phi = rest.coordinates["phi"]
        assert 8 * phi == pytest.approx(2 * force * 0.5 * sin(phi), abs=1e-8)
        assert force < 8.001 or (rest.stability == "stable" and abs(phi) > 1e-3)


def test_curves_that_are_cut_short_say_so(monkeypatch):
    strut = fb.Mechanism.loads(STRUT)
    monkeypatch.setattr(continuation, "_CURVES", 1)
    assert "1 curves were followed; at 1 more branch points others may begin" in str(strut.equilibria_along("F", (1, 20)))
    monkeypatch.setattr(continuation, "STEPS", 3)
    found = fb.Mechanism.loads(SHIMMY).equilibria_along("w", (1, 5))
    assert "curve 1 goes on" in str(found) and found.to_json()[0]["is_cut"]


def test_a_mass_is_an_input_at_rest_and_none_along_a_motion():
    """ẍ = (F − kx)/m, held at x: ∂ẍ/∂m = (kx − F)/m²."""
    cart = fb.Mechanism.loads(SHIMMY)
    source, (state, _) = cart.source(), cart.start(F=6, x=0.2)
    space = state_space(source, state, ["m", "F"])
    np.testing.assert_allclose(space.b[1], [(50 * 0.2 - 6) / 4, 1 / 2], rtol=1e-13)
    moving, _ = cart.start(rates={"x": 1})
    with pytest.raises(ValueError, match="m is no input along a motion"):
        state_space(source, moving, ["m"])


@pytest.fixture
def asked(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cart.yaml").write_text(SHIMMY)
    return lambda *words: CliRunner().invoke(app, ["stability", "cart.yaml", *words])


def test_the_command_gives_modes_response_and_gains_and_draws(asked, tmp_path):
    """ω² = k/m − (c/2m)²; with c less by w = 1; gains g of F = g·(x, ẋ) for poles −1, −2: (k − 2m, c − 3m)."""
    response = ("--input", "F", "--output", "x", "--response", "0.1..1", "--plot", "response.png")
    done = asked("--json", *response, "--poles=-1,-2", "-o", "modes.png")
    (rest,) = json.loads(done.stdout)["equilibria"]
    assert rest["modes"][0]["eigenvalue"] == pytest.approx([-0.5, np.sqrt(25 - 0.5**2)], rel=1e-12)
    assert rest["gains"] == [pytest.approx([50 - 2 * 2, 2 - 3 * 2], rel=1e-9)]
    frequency, real, imaginary = rest["response"][0]["frequency"], *rest["response"][0]["values"][0][0]
    iw = 2j * np.pi * frequency
    assert complex(real, imaginary) == pytest.approx(1 / (2 * iw**2 + 2 * iw + 50), rel=1e-12)
    assert all((tmp_path / name).stat().st_size > 1000 for name in ("modes.png", "response.png"))
    along = asked("--along", "w=1..5")
    assert along.exit_code == 0 and "Hopf point" in along.output


def test_a_mode_becomes_a_film_in_which_it_moves(tmp_path):
    (rest,) = fb.Mechanism.loads(SHIMMY).stability(w=0)
    (mode,) = rest.modes
    film = PIL.Image.open(draw_modes(rest, tmp_path / "mode.gif"))
    assert film.n_frames == 48 and mode.frequency > 0
    first, half = (np.asarray(film.convert("L"), float) for k in (0, 24) if film.seek(k) is None)
    assert np.abs(first - half).max() > 100  # it moves


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--bounds", "x=1 m..-1 m"), "give the lower bound first"),
        (("--bounds", "x=1 kg..2"), "is a mass"),
        (("--bounds", "y=0..1"), "no coordinate is called 'y'; there are x"),
        (("--along", "w=5..1"), "give the lower bound first"),
        (("--along", "w=2..5"), "w is 1 at the start, outside 2 to 5"),
        (("--along", "w"), "between which values?"),
        (("--along", "w=1..5", "-o", "modes.png"), "gives nothing else"),
        (("--plot", "response.png"), "say --input, --output and --response"),
        (("-o", "modes.txt"), ".gif or .mp4, not '.txt'"),
        (("--at", "y=1"), "y"),
        (("--input", "G"), "no parameter is called 'G'"),
        (("--poles=-1", "--input", "F"), "1 poles for 2 states"),
        (("--poles=-1,x", "--input", "F"), "these are no numbers"),
        (("--response", "3..1"), "from which to which frequency?"),
        (("--set", "F=1 kg"), "is a mass"),
    ],
)
def test_wrong_words_are_answered_in_a_sentence(asked, words, said):
    done = asked(*words)
    assert done.exit_code == 2 and said in done.output and "Traceback" not in done.output
