"""Starts of mechanisms with many loops: rates that all loops keep, found by sparse equations."""

import numpy as np
import pytest

import freebody as fb

N = 25  # four-bars in a row: 51 coordinates, more than are solved densely


def ladder(where: str = "", shift: int = 0) -> tuple[list[str], list[str], str]:
    """Bodies, joints and feet of a row of windows with posts ``p`` and couplers ``c``; its first foot is ``shift`` metres along."""
    posts, windows = range(N + 1), range(1, N + 1)
    bodies = [f"  {where}p{i}: {{shape: rod, length: 1, mass: {1 + i % 3}}}" for i in posts]
    bodies += [f"  {where}c{i}: {{shape: rod, length: 1, mass: 1}}" for i in windows]
    joints = [
        f"  {where}f{i}: {{type: hinge, of: [ground.{where}A{i}, {where}p{i}.start], coordinate: {where}t{i}}}" for i in posts
    ]
    level = "coordinate: {{name: {}, absolute: true}}"
    joints += [
        f"  {where}l{i}: {{type: hinge, of: [{where}p{i - 1}.end, {where}c{i}.start], {level.format(f'{where}s{i}')}}}"
        for i in windows
    ]
    joints += [f"  {where}r{i}: {{type: hinge, of: [{where}c{i}.end, {where}p{i}.end]}}" for i in windows]
    feet = "".join(f"    {where}A{i}: [{i + shift}, 0]\n" for i in posts)
    return bodies, joints, feet


def model(*ladders: tuple[list[str], list[str], str]) -> fb.Mechanism:
    """Ladders beside each other, upright."""
    bodies, joints, feet = zip(*ladders, strict=True)
    listed = lambda parts: "\n".join(line for part in parts for line in part)
    text = f"freebody: 1\nground:\n  points:\n{''.join(feet)}bodies:\n{listed(bodies)}\njoints:\n{listed(joints)}\n"
    guess = {c: "90 deg" for c in fb.Mechanism.loads(text).compile().coordinate_names if "t" in c}
    made = fb.Mechanism.loads(text)
    made.initial(guess=guess)
    return made


def test_all_posts_of_a_ladder_turn_as_the_one_that_is_asked_to():
    made = model(ladder())
    state, _ = made.start(rates={"t7": -2.0})
    turning = ["t" in name for name in made.compile().coordinate_names]
    assert np.allclose(state.u[turning], -2.0, atol=1e-12)
    assert np.allclose(state.u[~np.array(turning)], 0.0, atol=1e-12)
    assert made.compile().evaluate(["omega(p3)", "vy(c9.centre)"], state) == pytest.approx([-2.0, 0.0], abs=1e-12)


def test_what_is_not_asked_for_stays_at_rest():
    made = model(ladder("a"), ladder("b", 2 * N))
    state, _ = made.start(rates={"at3": 1.5})
    rates = dict(zip(made.compile().coordinate_names, state.u, strict=True))
    assert all(abs(rate - 1.5 * name.startswith("at")) < 1e-12 for name, rate in rates.items())


def test_rates_that_agree_may_be_asked_for_twice_and_others_not():
    made = model(ladder())
    state, _ = made.start(rates={"t0": 1.0, "t20": 1.0})
    assert np.abs(state.u).max() == pytest.approx(1.0, abs=1e-9)
    with pytest.raises(fb.MotionError) as caught:
        made.start(rates={"t0": 1.0, "t20": 1.1})
    assert caught.value.kind == "inconsistent_velocities"
