"""A lock holds as a motion does that keeps the rate of its coordinate at 0: the same accelerations and loads, or both are refused."""

import pytest
from random_models import locked
from store import every

import freebody as fb

AGREE = 1e-10
"""Of the largest acceleration or load."""
MOMENT = 1e-6  # s


def opening(mechanism: fb.Mechanism) -> fb.Instant | None:
    """The start of a motion, after the events there; None where there is none."""
    try:
        run = mechanism.simulate(MOMENT)
    except fb.MotionError:
        return None
    return run.instant(0.0) if run.outcome.ok else None


@every(map(str, range(300)), "seed")
def test_a_lock_is_a_motion_of_no_rate(seed, record_property):
    held, driven, coordinate = locked(int(seed))
    try:
        held.solve()
    except fb.MotionError as error:
        record_property("not held", error.kind.value)
        pytest.skip(error.kind.value)
    now, then = opening(held), opening(driven)
    assert (now is None) == (then is None)
    if now is None or then is None:
        return
    a, b = now.free_bodies(), then.free_bodies()
    most = max([1.0, *map(abs, b.accelerations.values())])
    assert a.accelerations == pytest.approx(b.accelerations, abs=AGREE * most)
    named = {f"'lock {coordinate}'.force": "hold.force"}
    found, known = ({named.get(each.symbol, each.symbol): each for each in free.loads} for free in (a, b))
    assert found.keys() == known.keys()
    most = max([1.0, *(abs(each.value) for each in known.values() if each.determinate)])
    for name, load in known.items():
        assert found[name].determinate == load.determinate, name
        assert not load.determinate or found[name].value == pytest.approx(load.value, abs=AGREE * most), name
