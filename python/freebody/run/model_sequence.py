"""A motion that goes on as another model: one run after the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from freebody.core import CompiledModel, MotionError, OutcomeKind, Settings, State, quote
from freebody.run.progress import Progress
from freebody.run.sampling import Times
from freebody.run.simulation import Run, simulate

if TYPE_CHECKING:
    from freebody.model.builder import Builder


@dataclass(frozen=True)
class Stage:
    """A model with what its run is asked to be; ``overrules`` are settings that hold for every model."""

    mechanism: Builder
    settings: Settings
    overrules: Mapping[str, Any]
    t_eval: Times | None = None
    progress: Progress | bool | None = None

    def run(self, state: State, notes: Sequence[str]) -> Run:
        """The motion from a state."""
        return simulate(self.mechanism.source(notes), state, self.settings, self.t_eval, self.progress)

    def after(self, run: Run) -> Stage | None:
        """The model to which a run of this one handed over; None when it ended in another way."""
        handing = self.mechanism.lowered().hand_over
        file = next((handing[event.name] for event in reversed(run.events) if event.name in handing), None)
        if file is None or run.outcome.name is not OutcomeKind.STOPPED_BY_EVENT or run.end.t >= self.settings.until:
            return None
        other = self.mechanism.handed(file)
        own = other.run_numbers().until
        until = self.settings.until if own is None else max(own, self.settings.until)
        return Stage(other, other.run_plan(until, self.overrules), self.overrules, self.t_eval, self.progress)


def follow(stage: Stage, first: Run) -> Run:
    """The run, with those of the models to which it hands over as ``next`` of one another.

    Raises ``ModelFileError``, and ``MotionError`` when models continue with one another at one instant.
    """
    run = first
    while (later := stage.after(run)) is not None:
        at_once = run.end.t == run.start.t
        resume = partial(resumed, stage, later)
        run.next = resume(run, later.settings)
        run.next.previous, run.next.resume = run, resume
        stage, run = later, run.next
        if at_once and run.end.t == run.start.t:
            what = f"the models continue with one another at t = {run.end.t:g} s without any motion between"
            raise MotionError(OutcomeKind.HANDS_OVER_AT_ONCE, "", what, "let each begin on the far side of its event")
    return first


def resumed(stage: Stage, later: Stage, run: Run, settings: Settings) -> Run:
    """The motion after a run of a stage, as the model of a later one."""
    state, notes = later.mechanism.start(None, run.end.t, **carried(stage.mechanism, run, later.mechanism))
    return replace(later, settings=settings).run(state, notes)


def carried(before: Builder, run: Run, after: Builder) -> dict[str, Any]:
    """What a model takes over from the end of a run: parameters, and coordinates with their rates.

    They are those of the same name; for a coordinate also a gauge of that name.
    """
    from freebody.model.start import parameter_values

    end, core = run.end, run.source
    gauges = [gauge["name"] for gauge in before.lowered().spec["gauges"]]
    known = {*coordinates(core), *gauges}
    names = [name for name in coordinates(after.compile()) if name in known]
    texts = [quote(name) for name in names] + [f"rate({quote(name)})" for name in names]
    values = core.evaluate(texts, end).tolist() if texts else []
    taken = after.lowered().start.parameters
    parameters = {name: value for name, value in parameter_values(core, end.p).items() if name in taken}
    rates = {"rates": dict(zip(names, values[len(names) :], strict=True))} if names else {}
    return parameters | dict(zip(names, values, strict=False)) | rates


def coordinates(core: CompiledModel) -> list[str]:
    """The names of all coordinates, also of those that only close loops."""
    metadata = core.metadata
    return [coordinate["name"] for coordinate in metadata["coordinates"] + metadata["closure_coordinates"]]
