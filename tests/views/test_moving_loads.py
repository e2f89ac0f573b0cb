"""The arrows of a report: what it tells the browser of loads is what the instant has, at every time, and adds up to m a and I α."""

import base64
from pathlib import Path

import numpy as np
import pytest

from freebody import Instant, Mechanism, Run
from freebody.views.report.data import frames
from freebody.views.report.instants import farthest
from freebody.views.report.loads import loads
from freebody.views.scene import of_run

EXAMPLES = Path(__file__).parents[2] / "examples"
SLIDING_BLOCK = """
freebody: 1
name: a block that slides up a slope and comes to rest
ground: {lines: {slope: {through: O, angle: 20 deg}}}
bodies: {block: {shape: rectangle, width: 0.3, height: 0.2, mass: 2}}
contacts: {slope: {of: [block, ground.slope], friction: 0.5}}
initial:
  block.angle: pi/9
  block.x: 0.5*cos(pi/9) - 0.1*sin(pi/9)
  block.y: 0.5*sin(pi/9) + 0.1*cos(pi/9)
  rates: {block.x: 1.5*cos(pi/9), block.y: 1.5*sin(pi/9), block.angle: 0}
run: {until: 0.8 s}
"""
MODELS = {name: (EXAMPLES / f"{name}.yaml").read_text() for name in ("four_bar", "new_gun", "tossed_box")}
COMPONENTS = ("x", "y", "fx", "fy", "m")
SHARE = 2e-6
"""Of the largest: the numbers travel as Float32."""


def column(stated, k):
    """The k-th number of a column."""
    return stated if isinstance(stated, float) else float(np.frombuffer(base64.b64decode(stated), "<f4")[k])


@pytest.fixture(scope="module", params=[*MODELS, "block"])
def told(request):
    """A run, the bodies, what the browser is told of its loads, and the instants at a sample of its times, by their places."""
    run = Mechanism.loads(MODELS.get(request.param, SLIDING_BLOCK)).simulate(until=0.9)
    sketch = of_run(run, frames(run)[:2])
    data = loads(run, sketch)
    places = np.unique(np.linspace(0, len(data["t"]) - 1, 12).astype(int)).tolist()
    return sketch.names, data, {k: Instant(run.source, run.motion.state(data["t"][k])) for k in places}


def close(one, other, largest):
    assert np.abs(np.subtract(one, other)).max() <= SHARE * largest


def test_every_reaction_is_that_of_the_instant(told):
    names, data, instants = told
    for k, instant in instants.items():
        for reaction in instant.reactions.values():
            for body in {reaction.first, reaction.second} - {"ground"}:
                own = [x for x in data["tracks"] if x["name"] == reaction.name and names[x["figure"]] == body]
                told_of = [sum(column(x[part], k) for x in own) for part in ("fx", "fy")]
                side = reaction.on(body)
                close(told_of, (side.Fx, side.Fy), max(reaction.size, instant.sizes[0]))


def test_contacts_push_and_rub_as_in_the_instant(told):
    names, data, instants = told
    for k, instant in instants.items():
        for limit in instant.limits.values():
            body, sense = (limit.first, 1) if limit.first != "ground" else (limit.second, -1)
            own = [x for x in data["tracks"] if x["name"] == limit.name and names[x["figure"]] == body]
            told_of = np.nansum([[column(x[part], k) for part in ("fx", "fy")] for x in own] or np.zeros((1, 2)), axis=0)
            close(told_of, (sense * limit.Fx, sense * limit.Fy), instant.sizes[0])


def test_what_acts_adds_up_to_the_other_side(told):
    """Σ F = m a, and Σ M = I α about the mass centre, with places in the frame of the body and forces along the fixed axes."""
    names, data, instants = told
    for body in data["bodies"]:
        for k, instant in instants.items():
            stated = instant.free_bodies().bodies[names[body["figure"]]]
            turn, total, sizes = np.exp(1j * stated.angle), np.zeros(3), [instant.sizes[0]]
            for track in (x for x in data["tracks"] if x["figure"] == body["figure"]):
                x, y, fx, fy, m = (column(track[part], k) for part in COMPONENTS)
                if not np.isnan(fx):
                    arm = turn * complex(x - body["G"][0], y - body["G"][1])
                    total += (fx, fy, m + arm.real * fy - arm.imag * fx)
                    sizes.append(np.hypot(fx, fy))
            effective = [column(body[part], k) for part in ("fx", "fy", "m")]
            close(effective, (*np.multiply(stated.mass, stated.a), stated.inertia * stated.alpha), max(sizes))
            close(total, effective, 5 * max(sizes))


def test_impulses_are_those_of_the_impacts():
    run = Mechanism.loads(MODELS["tossed_box"]).simulate(until=0.9)
    sketch = of_run(run, frames(run)[:2])
    told_of = loads(run, sketch)["impulses"]
    impacts = [change for change in run.changes if change.impulses]
    assert impacts
    for change in impacts:
        for name, force in change.impulses.contacts.items():
            own = [each["wrench"][:2] for each in told_of if each["t"] == change.t and each["name"] == name]
            sense = -1 if name == "leash" else 1  # which has the ground first
            assert np.sum(own, axis=0) == pytest.approx(sense * np.array(force), abs=1e-9)


def test_balances_have_a_term_for_every_load(told):
    """Of each mode, at its first instant: what acts along an axis on a body stands in that balance."""
    _, data, _ = told
    for mode, balances in enumerate(data["balances"]):
        k = data["mode"].index(mode)
        for balance in (each for each in balances if each["about"] != "G"):
            acting = {
                x["symbol"]
                for x in data["tracks"]
                if x["figure"] == balance["figure"] and abs(column(x[f"f{balance['about']}"], k)) > 1e-6
            }
            assert acting <= {term["symbol"] for term in balance["terms"]}


def test_a_run_from_a_file_knows_no_loads(tmp_path):
    run = Mechanism.loads(MODELS["new_gun"]).simulate(until=0.2)
    back = Run.load(run.save(tmp_path / "run.csv"))
    assert loads(back, of_run(back, frames(back))) is None


def test_the_largest_reactions_are_among_what_is_told():
    run = Mechanism.loads(MODELS["four_bar"]).simulate(until=0.9)
    sketch = of_run(run, frames(run)[:2])
    data = loads(run, sketch)
    for peak in run.peaks:
        own = [x for x in data["tracks"] if x["name"] == peak.joint and sketch.names[x["figure"]] == peak.body]
        k = data["t"].index(peak.t)
        assert np.hypot(*(sum(column(x[part], k) for x in own) for part in ("fx", "fy"))) == pytest.approx(peak.size, rel=SHARE)


def test_lines_follow_a_peak_between_two_even_instants():
    t, kept = np.linspace(0.0, 1.0, 4001), np.linspace(0.0, 1.0, 20)
    y = np.exp(-(((t - 0.61) / 0.004) ** 2))[:, None]

    def miss(times):
        return np.abs(np.interp(t, times, np.interp(times, t, y[:, 0])) - y[:, 0]).max()

    found = farthest(t, y, kept, 30)
    assert len(found) <= 30 and miss(np.union1d(kept, found)) < 0.02 < 0.5 < miss(np.linspace(0.0, 1.0, 50))
