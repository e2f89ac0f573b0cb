"""What the commands open and write: models with changes, runs, NAME=VALUE as words; the names of files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from freebody.cli.user_errors import UserError

if TYPE_CHECKING:
    from freebody.mechanism import Mechanism
    from freebody.run.digits import Accuracy
    from freebody.run.simulation import Run

_AT_START = "look for laws without a value at the start, like 1/x at x = 0"


def opened(path: Path, changes: list[str] | None = None) -> Any:
    """The mechanism of a model file, with some parameters changed."""
    from freebody.mechanism import Mechanism
    from freebody.model import user_units

    mechanism = Mechanism.load(path)
    user_units.prefer(mechanism.model.units or "")
    mechanism.parameters.update(pairs(changes))
    return mechanism


def simulated(path: Path, changes: list[str] | None = None, **settings: Any) -> Run:
    """The run of a model file; settings that are None stay as the file has them."""
    from freebody.cli.progress import watched
    from freebody.model.errors import ModelFileError, Problem

    given = {name: value for name, value in settings.items() if value is not None}
    mechanism = opened(path, changes)
    end = mechanism.run_plan(given.pop("until", None), given).until
    with watched(end) as progress:
        done = mechanism.simulate(end, progress=progress, **given)
    if not done.outcome.ok and done.outcome.t == done.start.t:
        # Nothing moved, so there is nothing to show.
        sentence, _, hint = done.outcome.sentence.partition("; ")
        *more, hint = hint.split("; ")
        what = "\n  ".join([f"the run ends where it begins, t = {done.outcome.t:g} s: {sentence}", *more])
        if done.outcome.path:
            raise ModelFileError([Problem(mechanism.lowered().where(done.outcome.path), what, hint)])
        raise UserError(what, hint or _AT_START)
    return done


def obtained(path: Path) -> Run:
    """A saved run, or the run of a model."""
    from freebody.run.simulation import Run
    from freebody.run.storage import FORMATS

    return Run.load(path) if path.suffix in FORMATS else simulated(path)


_FURTHER = 1e-3  # of the time: instants that lie further apart hold to no more than three digits
_RANGE = re.compile(r"\s*(.+?)\s*=\s*(.+?)\s*\.\.\s*(.+?)\s*")


def ranges(texts: list[str] | None, option: str) -> dict[str, tuple[str, str]]:
    """Bounds by name, from ``NAME=A..B``. Raises ``UserError``."""
    found = {}
    for text in texts or ():
        if not (stated := _RANGE.fullmatch(text)):
            raise UserError(f"{option} {text}: between which values?", f"write it like {option} 'theta=-90 deg..90 deg'")
        found[stated[1]] = (stated[2], stated[3])
    return found


def pairs(texts: list[str] | None) -> dict[str, str]:
    """``["theta=30 deg"]`` → ``{"theta": "30 deg"}``."""
    split = [text.partition("=") for text in texts or []]
    for name, equals, value in split:
        if not (name.strip() and equals and value.strip()):
            raise UserError(f"{name!r} is not NAME=VALUE", "write it like 'theta=30 deg'")
    return {name.strip(): value.strip() for name, _, value in split}


def moment(at: list[str] | None, before: str | None = None, after: str | None = None) -> dict[str, str]:
    """What ``Mechanism.moment`` takes: ``["theta=30 deg"]`` are coordinates, ``["200 ms"]`` is a time."""
    times = [text for text in at or [] if "=" not in text]
    if times and len(at or []) > 1:
        raise UserError("--at takes one time, or coordinates", "write it like --at '200 ms', or --at 'theta=30 deg'")
    if sum(map(bool, (times, before, after))) > 1:
        raise UserError("--at TIME, --before and --after are one moment", "give one of them")
    named = {"at": times[0] if times else None, "before": before, "after": after}
    return {name: text for name, text in named.items() if text} | ({} if times else pairs(at))


def time_of(mechanism: Mechanism, asked: Mapping[str, str]) -> float:
    """When a moment is, s; 0 where it is a start."""
    return mechanism.moment(**asked)[0].t if {"at", "before", "after"} & asked.keys() else 0.0


def leading_to(mechanism: Mechanism, t: float) -> Accuracy | None:
    """How far the motion is known that leads to a time, s; None at a start. It is followed a little further, so that what happens just
    then happens at the other tolerance, too."""
    return mechanism.simulate(t * (1 + _FURTHER)).accuracy if t > 0 else None


def how_far(known: Accuracy | None) -> str:
    """The sentence of it; none where there is nothing to say."""
    return f"The motion until then {known.sentence}." if known else ""


def figures_of(known: Accuracy) -> int:
    """How many digits of all coordinates and rates hold at the time that the motion leads to."""
    return int(known.held[-1])


def written(*files: Path) -> None:
    """Says which files were made."""
    for path in files:
        print(f"wrote {path}")
