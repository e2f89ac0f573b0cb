"""A spring without rest length pulls with k r, which is nothing at its anchor: the bob goes on as a harmonic oscillator in the plane."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import freebody as fb
from freebody.core.errors import MotionError

BOB = """
freebody: 1
gravity: none
bodies: {{P: {{shape: particle, mass: 2 kg}}}}
joints: {{plane: {{type: free, of: [ground.O, P.centre], coordinates: [x, y]}}}}
forces: {{leash: {{type: spring, between: [ground.O, P.centre], stiffness: 8 N/m{more}}}}}
initial: {{x: 0, y: 0, rates: {{x: {vx}, y: {vy}}}}}
run: {{until: 3 s}}
"""


def bob(path: Path, vx: float, vy: float, more: str = "") -> fb.Mechanism:
    file = path / "bob.yaml"
    file.write_text(BOB.format(vx=vx, vy=vy, more=more))
    return fb.load(file)


@pytest.mark.parametrize("rates", [(1, 0), (-0.3, 2), (0, 0)])
def test_it_goes_on(tmp_path: Path, rates: tuple[float, float]) -> None:
    run = bob(tmp_path, *rates).simulate()
    assert_allclose(run.q, np.outer(np.sin(2 * run.t) / 2, rates), atol=1e-8)


@pytest.mark.parametrize("more", [", rest_length: 0.1 m", ", damping: 1 N*s/m"])
def test_what_has_no_direction_is_refused_by_name(tmp_path: Path, more: str) -> None:
    m = bob(tmp_path, 1, 0, more)
    with pytest.raises(MotionError, match="`leash` acts along a line of no length"):
        m.solve()
