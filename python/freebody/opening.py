"""The instant just after the events at the start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from freebody import tables
from freebody.instant import Reaction, Reactions, State
from freebody.run import Settings, Source, simulate
from freebody.switched import Change, Limit, limits_at, there

if TYPE_CHECKING:
    from rich.table import Table

_MOMENT = 1e-6
"""s: a motion of that length is made, and read at its start."""


def opens(spec: Mapping[str, Any]) -> bool:
    """Whether a model has events at the start."""
    return any(event.get("opening") for event in spec.get("events", []))


def _first(reaction: Reaction) -> Reaction:
    """A reaction over time, at its first time."""
    values, determined = reaction.values[0], reaction.determined[0]
    return replace(
        reaction, values=values, determined=determined, smallest=lambda: reaction.smallest()[0], local=lambda: reaction.local()[0]
    )


@dataclass(frozen=True)
class Opening:
    """What has switched at the start, then accelerations (m/s² or rad/s²), reactions, and contacts, strings and stops that are
    in place."""

    changes: list[Change]
    accelerations: dict[str, float]
    reactions: Reactions
    limits: dict[str, Limit]
    coordinates: list[Mapping[str, Any]]

    @classmethod
    def of(cls, source: Source, start: State, settings: Settings) -> Opening:
        """The opening of a model from a state. Raises ``ValueError`` where no motion follows."""
        moment = replace(settings, until=start.t + _MOMENT, step=settings.step and min(settings.step, _MOMENT))
        run = simulate(source, start, moment)
        if not run.outcome.ok or run.outcome.t == start.t:
            raise ValueError(f"after the events at the start: {run.outcome.name}: {run.outcome.sentence}")
        run = run.at([start.t])
        changes = [change for change in run.changes if change.t == start.t]
        place = [limit for limit in source.about["limits"] if there(changes, limit["name"], limit["engaged"], run.t)[0]]
        limits = limits_at(lambda texts: run.motion.evaluate(texts, run.t)[0], place)
        return cls(
            changes,
            dict(zip(run.coordinates, run.accelerations[0].tolist(), strict=True)),
            Reactions({name: _first(reaction) for name, reaction in run.reactions.items()}),
            limits,
            source.about["coordinates"],
        )

    def tables(self) -> list[Table]:
        """Accelerations, reactions, and what contacts, strings and stops do, for rich."""
        return [
            tables.of_accelerations(self.coordinates, self.accelerations),
            tables.of_reactions(self.reactions.values()),
            tables.of_limits(self.limits.values()),
            tables.of_forces(self.limits.values()),
        ]
