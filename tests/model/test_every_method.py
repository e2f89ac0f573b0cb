"""Every integrator of the core is a word of the model file, and carries a pendulum without losing energy."""

import pytest

import freebody as fb
from freebody.core import cards

PENDULUM = """
freebody: 1
bodies: {{bob: {{shape: particle, mass: 1}}}}
joints: {{pin: {{type: link, of: [ground.O, bob.centre], length: 1, coordinate: theta}}}}
initial: {{theta: 0.4, at_rest: true}}
run: {{until: 1, method: {}}}
"""


@pytest.mark.parametrize("method", cards.methods().values(), ids=lambda method: method.name)
def test_a_file_chooses_it_and_energy_stays(method):
    text = PENDULUM.format(method.name)
    if method.fixed_step:
        with pytest.raises(fb.ModelFileError, match=f"`{method.name}` needs a fixed step"):
            fb.Mechanism.loads(text).compile()
        text = text.replace("until: 1", "until: 1, step: 1 ms")
    run = fb.Mechanism.loads(text).simulate()
    assert run.outcome.ok
    assert run["energy()"] == pytest.approx(run["energy()"][0], rel=1e-8)


def test_names_of_the_package_are_there():
    assert all(getattr(fb, name) for name in fb.__all__)
