"""Tables: splines against SciPy, periodic ones, points in CSV files; and `mod`."""

import json

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import freebody as fb
from freebody.model.errors import ModelFileError

PARTICLE = """
freebody: 1
gravity: none
bodies: {b: {shape: particle, mass: 2}}
joints: {B: {type: free, of: [ground.O, b.centre], coordinates: [z, k]}}
initial: {z: 0, k: 0, at_rest: true}
"""
CAM = """
freebody: 1
gravity: none
parameters: {w: 2 rad/s}
tables: {lift: {file: cam.csv, x: {column: angle, unit: deg}, y: {column: lift, unit: mm}, interpolation: spline, periodic: true}}
bodies: {follower: {shape: particle, mass: 2}}
joints: {guide: {type: slot, along: {through: ground.O, angle: 90 deg}, point: follower.centre, coordinate: y}}
motions: {cam: {of: y, is: lift(w*t)}}
run: {until: 7 s}
"""
ANGLES = [0, 40, 95, 150, 230, 300, 360]
LIFTS = [0, 2.5, 9, 12, 7.25, 1, 0]
CSV = "angle, lift,note\n" + "".join(f"{a},{y},\n" for a, y in zip(ANGLES, LIFTS, strict=True))


def points(count, periodic, seed=3):
    """Increasing arguments, not evenly spaced, and values; of a periodic table the same at both ends."""
    drawn = np.random.default_rng(seed)
    x, y = np.cumsum(drawn.uniform(0.1, 1, count)), drawn.normal(size=count)
    return x, np.append(y[:-1], y[0]) if periodic else y


def jet(mechanism, at):
    """f(z) with f′ and f″: its rate at ż = 1, its acceleration at z̈ = 0."""
    state, _ = mechanism.start({"z": float(at), "k": 0, "rates": {"z": 1.0, "k": 0.0}})
    return mechanism.compile().evaluate(["f(z)", "rate(f(z))", "accel(f(z))"], state)


@pytest.mark.parametrize("count", [2, 3, 4, 9])
@pytest.mark.parametrize("periodic", [False, True])
def test_a_spline_has_the_value_slope_and_curvature_of_scipys(count, periodic):
    """Natural and periodic cubic splines, between the points, at them, and periods away."""
    x, y = points(count, periodic)
    exact = CubicSpline(x, y, bc_type="periodic" if periodic else "natural")
    mechanism = fb.Mechanism.loads(PARTICLE)
    mechanism.table("f", x, y, "spline", periodic)
    inside = np.append(np.linspace(x[0], x[-1], 23)[1:-1], x[1:-1])
    away = np.append(inside + 3 * (x[-1] - x[0]), inside - 2 * (x[-1] - x[0])) if periodic else []
    for at in np.append(inside, away):
        expected = [exact(at, n) for n in range(3)]
        np.testing.assert_allclose(jet(mechanism, at), expected, rtol=1e-10, atol=1e-10 * abs(y).max() / np.diff(x).min() ** 2)


def test_a_periodic_linear_table_bends_at_every_repetition_of_its_points():
    """A force along a triangular wave of time, of period 2 s: z is integrated in closed form, piece by piece."""
    text = "tables: {f: {x: [0 s, 1 s, 2 s], y: [0 N, 1 N, 0 N], periodic: true}}\nforces: {F: {type: force, at: b.centre, x: f(t)}}\n"
    run = fb.Mechanism.loads(PARTICLE + text).simulate(until=9.0, rtol=1e-11)
    assert run.outcome.ok and "left" not in run.outcome.sentence
    for periods in range(1, 5):  # 2 v̇ = f: each period gives v ½ m/s
        assert run.evaluate("rate(z)", [2.0 * periods])[0] == pytest.approx(periods / 2, abs=1e-11)
    assert {float(n) for n in range(1, 9)} <= {round(float(t), 9) for t in run.edges}


def test_a_sawtooth_of_mod_is_integrated_tooth_by_tooth():
    """Force mod(t, 0.7 s): the impulse of each tooth is ½ 0.7²; what is left of the last is ½ mod²."""
    text = "forces: {F: {type: force, at: b.centre, x: 'mod(t, 0.7)'}}\n"
    run = fb.Mechanism.loads(PARTICLE + text).simulate(until=5.0, rtol=1e-11)
    for t in (0.5, 0.69, 0.71, 2.0, 3.3, 4.95):
        whole, rest = divmod(t, 0.7)
        assert run.evaluate("2*rate(z)", [t])[0] == pytest.approx(whole * 0.5 * 0.7**2 + 0.5 * rest**2, abs=1e-11)


def test_mod_takes_what_has_one_unit_and_gives_it():
    mechanism = fb.Mechanism.loads(PARTICLE + "parameters: {a: 7 m, b: 2 m, c: 'mod(a, b)', d: 'mod(-a, b)', e: 2 s}\n")
    compiled, (state, _) = mechanism.compile(), mechanism.start()
    assert list(compiled.evaluate(["c", "d", "mod(a + z, b)"], state)) == [1.0, 1.0, 1.0]
    assert {p["name"]: p["unit"] for p in compiled.spec["parameters"]}["c"] == "m"
    with pytest.raises(ModelFileError, match="cannot be added or compared"):
        fb.Mechanism.loads(PARTICLE + "parameters: {a: 7 m, e: 2 s, c: 'mod(a, e)'}\n").compile()


@pytest.fixture
def cam(tmp_path):
    (tmp_path / "cam.csv").write_text(CSV, encoding="utf-8")
    (tmp_path / "cam.yaml").write_text(CAM, encoding="utf-8")
    return tmp_path / "cam.yaml"


def test_a_follower_has_the_acceleration_of_the_lift_in_a_file_continuous_across_turns(cam):
    """y = lift(ω t): ÿ = ω² lift″, and the cam pushes with m ÿ; the same just before and behind each point and each turn."""
    exact = CubicSpline(np.deg2rad(ANGLES), np.array(LIFTS) / 1000, bc_type="periodic")
    run = fb.load(cam).simulate()
    assert run.outcome.ok and "left" not in run.outcome.sentence
    turns = np.deg2rad([a + 360 * n for n in range(2) for a in ANGLES[1:]]) / 2
    for t in (*turns - 1e-9, *turns + 1e-9, 0.3, 4.4):
        found = [float(run.evaluate(text, [t])[0]) for text in ("y", "rate(y)", "rate(rate(y))", "cam.force")]
        y, v, a = (exact(2 * t, n) * 2**n for n in range(3))
        np.testing.assert_allclose(found, [y, v, a, 2 * a], rtol=1e-9, atol=1e-12)


def test_a_saved_model_keeps_the_name_of_the_file(cam):
    for name in ("again.yaml", "again.json"):
        fb.load(cam).save(cam.parent / name)
        assert fb.load(cam.parent / name) == fb.load(cam) and "cam.csv" in (cam.parent / name).read_text(encoding="utf-8")
    assert json.loads((cam.parent / "again.json").read_text())["tables"]["lift"]["x"] == {"column": "angle", "unit": "deg"}


@pytest.mark.parametrize(
    ("old", "new", "place", "words"),
    [
        ("230,7.25", "230,7;25", "cam.csv:6", ["`7;25` is no number", "decimal point"]),
        ("230,7.25", "230,nan", "cam.csv:6", ["`nan` is no number"]),
        ("230,7.25,", "230", "cam.csv:6", ["no number in the column"]),
        ("230,", "130,", "cam.csv:6", ["must grow", "in order"]),
        ("360,0", "360,0.5", "cam.csv:8", ["ends with the value that it begins with", "0.0005 is not 0", "periodic"]),
        ("angle,", "angel,", "cam.yaml:5", ["no column `angle`", "did you mean `angel`?"]),
        (CSV, "", "cam.yaml:5", ["no column `angle`"]),
        ("angle,", "\xff,", "cam.yaml:5", ["no text in UTF-8"]),
    ],
)
def test_what_is_wrong_in_a_file_is_said_with_its_line(cam, old, new, place, words):
    assert old in CSV
    (cam.parent / "cam.csv").write_text(CSV.replace(old, new), encoding="latin-1")
    with pytest.raises(ModelFileError) as error:
        fb.load(cam).lowered()
    said = str(error.value)
    assert place in said and all(word in said for word in words), said


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("file: cam.csv, ", "", ["add `file:`"]),
        ("x: {column: angle, unit: deg}", "x: [0, 1]", ["stand in a file", "column"]),
        ("cam.csv", "../cam.csv", ["outside the folder of the model"]),
        ("cam.csv", "came.csv", ["there is no file `came.csv`", "beside the model"]),
        ("unit: mm", "unit: mn", ["there is no unit `mn`"]),
        ("unit: deg", "unit: dge", ["there is no unit `dge`"]),
        ("periodic: true", "period: true", ["unknown key `period`", "`periodic`"]),
        ("spline", "splin", ["did you mean `spline`?"]),
    ],
)
def test_what_is_wrong_about_a_file_is_said_in_the_model(cam, old, new, words):
    cam.write_text(CAM.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(ModelFileError) as error:
        fb.load(cam).lowered()
    assert "cam.yaml:5" in str(error.value) and all(word in str(error.value) for word in words), str(error.value)


def test_generated_code_says_that_it_has_no_tables(cam):
    with pytest.raises(ValueError, match="is given by the table 'lift'"):
        fb.load(cam).code("python")
    sawtooth = fb.Mechanism.loads(PARTICLE + "forces: {F: {type: force, at: b.centre, x: 'mod(t, 0.7)'}}\n")
    with pytest.raises(ValueError, match="switches between formulas"):
        sawtooth.code("python")
