"""What is not in place is as if it were not in the model: equations, energies, the ledger of a run; and what dissipates."""

import sys
from pathlib import Path

import pytest
from numpy.testing import assert_allclose
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app

MODEL = """
freebody: 1
name: two bars and a bead
parameters: {{M: 1 kg, k: 20 N/m, c: 3 N*s/m, L: 1 m}}
ground: {{points: {{E: [1 m, 0.5 m]}}}}
bodies:
  a: {{shape: rod, points: {{A: start, B: end}}, length: L, mass: M}}
  b: {{shape: rod, points: {{B: start, C: end}}, length: L, mass: M}}
joints:
  p: {{type: hinge, of: [ground.O, a.A], coordinate: th1}}
  q: {{type: hinge, of: [a.B, b.B], coordinate: th2}}
{joints}
forces:
  s: {{type: spring, between: [a.B, ground.E], stiffness: k}}
{forces}
{motions}
initial: {{th1: 30 deg, th2: 10 deg, at_rest: true}}
run: {{until: 1 s}}
"""
PARTS = {
    "joints": ["r: {type: hinge, of: [b.C, ground.E], engaged: false}", "w: {type: link, of: [a.B, ground.E], length: 2 m, engaged: false}"],
    "forces": [
        "d: {type: damper, along: th2, damping: 3 N*m*s, engaged: false}",
        "e: {type: spring, between: [b.C, ground.O], stiffness: 3*k, damping: c, engaged: false}",
        'f: {type: torque, on: b, value: "max(3, 2*sin(t))", engaged: false}',
        "h: {type: force, at: b.C, x: 5 N, engaged: false}",
    ],
    "motions": ["v: {of: th1, is: 30 deg + 0.1*sin(t), engaged: false}"],
}  # fmt: skip
DISSIPATES = [
    "d: {type: damper, along: th2, damping: 3 N*m*s}",
    "e: {type: spring, between: [b.C, ground.O], stiffness: k, damping: c}",
]


def model(path: Path, name: str, **parts: list[str]) -> fb.Mechanism:
    """The bars with further joints, forces and motions."""
    written = {kind: "".join(f"\n  {part}" for part in parts.get(kind, [])) for kind in PARTS}
    written["motions"] = f"motions:{written['motions']}" if written["motions"] else ""
    file = path / f"{name}.yaml"
    file.write_text(MODEL.format(**written))
    return fb.load(file)


@pytest.fixture
def bars(tmp_path: Path) -> fb.Mechanism:
    return model(tmp_path, "bars")


@pytest.fixture
def waiting(tmp_path: Path) -> fb.Mechanism:
    return model(tmp_path, "waiting", **PARTS)


@pytest.mark.parametrize("form", ["minimal", "brute", "constraints", "lagrange", "linear"])
def test_no_form_tells_of_what_is_not_in_place(tmp_path: Path, form: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.modules["freebody.equations.stability"], "PATIENCE", 0.0)  # what is printed need not be short
    stated = []
    for name, parts in (("bars", {}), ("waiting", PARTS)):
        model(tmp_path, name, **parts)
        done = CliRunner().invoke(app, ["equations", str(tmp_path / f"{name}.yaml"), "--form", form])
        assert done.exit_code == 0, done.output
        stated.append(done.output)
    assert stated[0] == stated[1]


def test_what_is_not_in_place_does_no_work(bars: fb.Mechanism, waiting: fb.Mechanism) -> None:
    with_parts, without = waiting.simulate(), bars.simulate()
    ledger = with_parts.energy
    assert abs(ledger.balance).max() < 1e-7
    idle = ledger.entries.keys() - without.energy.entries.keys()
    assert len(idle) == 5
    assert not any(ledger.entries[name].any() for name in idle)
    assert_allclose(with_parts.end.q, without.end.q, rtol=1e-7)
    assert all(waiting.solve()[f"{name}.value"] == 0 for name in "defh")


@pytest.mark.parametrize("force", DISSIPATES)
def test_energy_is_not_said_to_be_conserved_where_a_damper_takes_it(tmp_path: Path, force: str) -> None:
    text = str(model(tmp_path, "damped", forces=[force]).equations(long=True))
    assert f"not conserved: {force[0]} does work that has no potential" in text
