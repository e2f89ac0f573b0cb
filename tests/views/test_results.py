"""Runs, reactions, reported quantities: what is handed out, and what is refused."""

import numpy as np
import pytest

from freebody.core import Indeterminate, ReportItem
from freebody.run.records import Window, integral, maximum, plain, quote, unit_of
from freebody.run.simulation import output_times
from freebody.solve.instant import Instant
from freebody.views.compare import compare

from .models import run_double_pendulum


def test_columns_are_complete_and_match_the_values(four_bar):
    values = np.hstack(list(four_bar.blocks.values()))
    names = [column.name for column in four_bar.columns]
    assert values.shape == (len(four_bar.t), len(names)) and len(set(names)) == len(names)
    assert {column.kind for column in four_bar.columns} == {"coordinate", "rate", "acceleration", "reaction", "energy", "pose"}
    assert all(column.unit and column.symbol for column in four_bar.columns)


def test_a_column_name_is_an_expression_with_the_same_values(four_bar):
    for column, values in zip(four_bar.columns, np.hstack(list(four_bar.blocks.values())).T, strict=True):
        if column.name != "balance":
            assert four_bar[column.name] == pytest.approx(values, abs=1e-12), column.name


def test_the_grid_holds_ends_steps_and_events(four_bar):
    assert {four_bar.edges[0], four_bar.edges[-1], *(event.t for event in four_bar.events)} <= set(four_bar.t)
    assert set(four_bar.motion.steps) <= set(four_bar.t)
    assert len(four_bar.t) >= 400 and (np.diff(four_bar.t) > 1e-9).all()


def test_every_and_t_eval_choose_the_grid(four_bar):
    assert output_times(four_bar.motion, every=0.7) == pytest.approx([0, 0.7, 1.4, 2.1, 2.8, 3.0])
    assert output_times(four_bar.motion, every=0.5) == pytest.approx(np.arange(7) / 2)
    assert output_times(four_bar.motion, t_eval=[2.0, 1.0, 9.0]).tolist() == [1.0, 2.0]


def test_points_follow_from_poses(four_bar):
    assert four_bar["coupler.P"][:, 0] == pytest.approx(four_bar["x(coupler.P)"])
    assert four_bar["crank.end"] == pytest.approx(four_bar["coupler.start"], abs=1e-9)
    assert (four_bar["ground.B"] == [0.9, 0.0]).all()


def test_a_single_time_gives_a_single_number(pendulum):
    assert isinstance(pendulum.evaluate("phi1", 0.3), float)
    assert pendulum.evaluate("phi1", [0.3, 0.4]).shape == (2,)


def test_reactions_carry_opposite_signs_on_the_two_bodies(four_bar):
    pin = four_bar.reactions["crank pin"]
    assert (pin.on("crank").Fx == -pin.on("coupler").Fx).all() and (pin.Fx == pin.on("coupler").Fx).all()
    assert pin.size == pytest.approx(np.hypot(pin.Fx, pin.Fy)) and pin.determinate
    with pytest.raises(KeyError, match="joins crank and coupler"):
        pin.on("rocker")
    with pytest.raises(KeyError, match="main bearing"):
        four_bar.reactions["pivot"]


def test_an_indeterminate_reaction_is_never_a_plain_number(indeterminate):
    knee = indeterminate.reactions["knee"]
    for read in (
        lambda: knee.Fx,
        lambda: knee.size,
        lambda: indeterminate["knee.Fx"],
        lambda: indeterminate.evaluate("2*knee.F", 0.1),
    ):
        with pytest.raises(Indeterminate, match="not determined"):
            read()
    assert not knee.determinate and np.isfinite(knee.Fy).all()
    assert np.isfinite(knee.least.Fx).all() and (knee.least.on("upper").Fx == -knee.least.Fx).all()
    assert (knee.on("upper").least.Fx == -knee.least.Fx).all()
    assert np.isnan(indeterminate.blocks["reaction"]).any()


def test_an_instant_tells_signs_ranks_and_refuses_the_indeterminate(indeterminate):
    now = Instant(indeterminate.source, indeterminate.start)
    assert now.reactions["pivot"].on("ground").Fy == -now.reactions["pivot"].Fy
    with pytest.raises(Indeterminate):
        _ = now["knee.Fx"]
    with pytest.raises(Indeterminate):
        _ = now.reactions["knee"].Fx
    assert float(now.reactions["knee"].least.Fx) == pytest.approx(indeterminate.reactions["knee"].least.Fx[0])
    stated = str(now)
    assert all(
        word in stated for word in ("phi1", "knee", "ground", "indeterminate", "1 degree of freedom", "statically indeterminate")
    )
    assert now["accel(phi1)"] == pytest.approx(now.accelerations["phi1"])


def test_extremes_are_refined_between_the_samples():
    window = Window(np.array([0.0, 2.0, 4.0]))
    t, value = maximum(lambda t: np.cos(t - 1.2345678), window)
    assert t == pytest.approx(1.2345678, abs=5e-12) and value == pytest.approx(1.0, abs=1e-15)
    t, value = maximum(lambda t: -np.abs(t - 1.7654321), window)
    assert t == pytest.approx(1.7654321, abs=1e-8)
    assert maximum(lambda t: t, window) == (4.0, 4.0)


@pytest.mark.parametrize(
    ("f", "exact"), [(np.sin, 1 - np.cos(4)), (np.sqrt, 16 / 3), (lambda t: np.abs(t - 1.1), (1.1**2 + 2.9**2) / 2)]
)
def test_integrals_are_exact(f, exact):
    assert integral(f, Window(np.array([0.0, 1.5, 4.0]))) == pytest.approx(exact, rel=1e-9)


def test_reported_quantities(pendulum):
    report = pendulum.report
    assert report["tip speed at the end"].value == pendulum.evaluate("speed(lower.end)", 2.0)
    assert report["largest pull"].value >= pendulum.reactions["pivot"].size.max()
    assert report["largest pull"].unit == "N" and report["angle when plumb"].unit == "deg"
    assert report["never"].value is None and "did not happen" in str(report["never"])
    window = pendulum.reported(ReportItem("turn", "rate(phi1)", "integral", over=(0.5, 1.5)))["turn"]
    assert window.value == pytest.approx(pendulum.evaluate("phi1", 1.5) - pendulum.evaluate("phi1", 0.5), abs=1e-8)
    assert window.unit == "rad"
    with pytest.raises(ValueError, match="outside the run"):
        pendulum.reported(ReportItem("", "phi1", "mean", over=(1.0, 5.0)))


def test_a_run_goes_on_from_its_end(pendulum):
    whole, on = run_double_pendulum(until=2.5), pendulum.continue_(2.5)
    assert on.t[0] == 2.0 and on.t[-1] == 2.5
    assert on.q[-1] == pytest.approx(whole.q[-1], abs=1e-8)


def test_energy_closes_and_names_works(four_bar):
    assert np.abs(four_bar.energy.balance).max() < 1e-8
    assert set(four_bar.energy.works) == {"motor", "parameter changes", "impacts"}
    assert four_bar.energy["motor"][-1] == pytest.approx(four_bar.report["work of the motor"].value, rel=1e-12)


def test_two_runs_compared(pendulum):
    stated = compare(pendulum, run_double_pendulum(until=1.5))
    assert stated.t[-1] == 1.5 and stated.largest.relative < 1e-8 and not stated.only
    assert "phi1" in str(stated) and stated["phi1"].unit == "rad"


def test_words_and_symbols():
    assert [quote(name) for name in ("link[1].end", "crank drive.pin", "two words[3]")] == [
        "link[1].end",
        "'crank drive'.pin",
        "'two words'[3]",
    ]
    assert plain("arm.theta2") == "arm.θ2"
    units = ["speed(rod.B)", "t", "2*theta", "kinetic()"]
    metadata = dict.fromkeys(("parameters", "joints", "forces", "motions", "locks", "limits"), ())
    assert [unit_of(text, (), metadata) for text in units] == ["m/s", "s", "", "J"]
