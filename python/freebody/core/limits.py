"""What contacts, strings and stops do at an instant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

_WORDS = {"string": {"open": "slack", "closed": "taut"}, "contact": {"closed": "touching"}, "stop": {"closed": "at its end"}}


@dataclass(frozen=True)
class Limit:
    """What a contact, string or stop does at an instant.

    ``state``: off, open, touching, stuck or sliding; taut or slack; at its end. ``gap``: how far it is from closing,
     m (rad for a stop of an angle). ``N``: the normal force, tension or force of the stop, ``T``: friction along the
    tangent, N (N·m at an angle); ``Fx``, ``Fy``: the force on the body ``first``, N; ``at``: where a contact's resultant acts, m.
    A force that the balances do not determine is NaN.
    """

    name: str
    kind: str
    first: str
    second: str
    dimension: str
    state: str
    gap: float
    N: float
    T: float
    Fx: float
    Fy: float
    at: tuple[float, float] | None = None

    @property
    def is_open(self) -> bool:
        """Whether it is in place and holds nothing."""
        return self.state in ("open", "slack")


def limits_of(stated: Sequence[Mapping[str, Any]], metadata: Mapping[str, Any]) -> dict[str, Limit]:
    """Contacts, strings and stops by name, as the core tells of an instant."""
    found = {}
    for who, now in zip(metadata["limits"], stated, strict=True):
        forces = zip(now["force"] + [now["normal"], now["friction"]], now["determinate"], strict=True)
        fx, fy, normal, friction = (force if known else np.nan for force, known in forces)
        found[who["name"]] = Limit(
            *(who[word] for word in ("name", "type", "first", "second", "dimension")),
            _WORDS[who["type"]].get(now["state"], now["state"]),
            np.nan if now["gap"] is None else now["gap"],
            normal,
            friction,
            fx,
            fy,
            now["at"] and tuple(now["at"]),
        )
    return found
