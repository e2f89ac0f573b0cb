"""Whatever arrays the core is given, it answers or refuses by name; it never panics."""

import contextlib
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import freebody as fb
from freebody.core import ExpressionError, ModelError, MotionError, State

MODELS = ["examples/four_bar.yaml", "systems/19.3.30-rimless-wheel/model.yaml", "systems/S19.22-four-bar-torque/model.yaml"]
REFUSALS = (MotionError, ModelError, ExpressionError, OverflowError, TypeError, ValueError)
"""What a caller may meet, those of Python for an argument that is no number among them; a panic is none of them."""
numbers = st.one_of(st.floats(-10, 10), st.sampled_from([0.0, np.nan, np.inf, -np.inf, 1e308, 5e-324]))


@pytest.fixture(scope="module", params=MODELS)
def started(request):
    mechanism = fb.load(request.param)
    return mechanism.compile(), mechanism.start()[0]


def bent(draw, values):
    """An array that is left as it is, or of another size, or with other numbers in it."""
    how = draw(st.sampled_from(["same", "size", "number"]))
    if how == "size":
        return np.array(draw(st.lists(numbers, max_size=len(values) + 2)), float)
    changed = np.array(values, float)
    if how == "number" and len(changed):
        changed[draw(st.integers(0, len(changed) - 1))] = draw(numbers)
    return changed


def is_state(core, state):
    sizes = len(state.p) == len(core.metadata["parameters"]) and len(state.q) == len(state.u) == len(core.metadata["coordinates"])
    return sizes and all(np.isfinite(part).all() for part in state.arrays[:4])


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_states_that_are_none_are_refused_by_name(started, data):
    core, start = started
    p, q, u = (bent(data.draw, part) for part in (start.p, start.q, start.u))
    state = State(p, data.draw(st.one_of(st.just(0.0), numbers)), q, u)
    calls = [
        lambda: core.instant(state, data.draw(st.sampled_from(["minimal", "newton_euler", "constraints"]))),
        lambda: core.free_bodies(state),
        lambda: core.evaluate(["kinetic()"], state),
        lambda: core.symbolic_answers(state, [{"ask": "rows"}]),
        lambda: core.simulate(state, state.t + 1e-3, max_steps=50),
    ]
    call = data.draw(st.sampled_from(calls))
    if is_state(core, state):
        with contextlib.suppress(*REFUSALS):
            call()
    else:
        with pytest.raises(MotionError) as refused:
            call()
        assert refused.value.kind in ("wrong_size", "not_finite") and refused.value.what


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_settings_are_taken_or_refused(started, data):
    core, start = started
    words = {"method": "dop853", "route": "auto", "impacts": "stop", "painleve": "stop"}
    changed = {word: data.draw(st.one_of(st.just(value), st.text(max_size=6))) for word, value in words.items()}
    numbers_of = {word: data.draw(numbers) for word in data.draw(st.sets(st.sampled_from(["rtol", "step", "max_step"])))}
    with contextlib.suppress(*REFUSALS):
        core.simulate(start, data.draw(numbers), max_steps=20, **changed, **numbers_of)


@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_starts_are_found_or_refused(started, data):
    core, start = started
    names = st.sampled_from([*(c["name"] for c in core.metadata["coordinates"]), *core.points(start.p), "nobody", "'", ""])
    some = st.dictionaries(names, numbers, max_size=2)
    with contextlib.suppress(*REFUSALS):
        core.assemble(
            bent(data.draw, start.p),
            data.draw(numbers),
            fixed=data.draw(some),
            guess=data.draw(some),
            rates=data.draw(some),
            points=data.draw(st.dictionaries(names, st.lists(numbers, max_size=3), max_size=1)),
            branch=data.draw(st.dictionaries(names, st.integers(-2, 2), max_size=1)),
        )


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_a_motion_is_read_at_times_or_refuses(started, data):
    core, start = started
    motion = core.simulate(start, start.t + 0.01)
    times = np.array(data.draw(st.lists(st.one_of(st.floats(0, 0.01), numbers), max_size=3)), float)
    calls = [motion.sample, motion.poses, motion.reactions, motion.ledger, lambda t: motion.evaluate(["kinetic()"], t)]
    calls += [lambda t: core.instant(motion.state(float(t[0]))) if len(t) else None, lambda t: motion.state_of_impact(len(t))]
    with contextlib.suppress(*REFUSALS):
        data.draw(st.sampled_from(calls))(times)


def test_the_history_of_another_mechanism_is_refused(started):
    core, start = started
    foreign = fb.load("examples/tossed_box.yaml").simulate(until=0.1).end
    for answer in (core.instant, core.free_bodies, lambda state: core.simulate(state, 1.0)):
        with pytest.raises(MotionError, match="motion of another mechanism"):
            answer(replace(start, history=foreign.history))


@pytest.mark.parametrize(
    ("given", "kind", "what"),
    [
        ({"q": np.zeros(1)}, "wrong_size", r"coordinates are needed, and 1 were given"),
        ({"u": np.full(3, np.nan)}, "not_finite", r"rate of .* = NaN is no finite number"),
        ({"t": np.inf}, "not_finite", r"t = inf is no finite number"),
    ],
)
def test_the_refusal_says_what_and_how(given, kind, what):
    from dataclasses import replace

    mechanism = fb.load("examples/four_bar.yaml")
    start = mechanism.start()[0]
    with pytest.raises(MotionError, match=what) as refused:
        mechanism.compile().instant(replace(start, **given))
    assert refused.value.kind == kind
