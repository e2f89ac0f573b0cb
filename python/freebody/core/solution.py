"""What the core answers about an instant, in numbers and symbolically: what contacts, strings and stops do, rank, all loads."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .state import Array

_WORDS = {"string": {"open": "slack", "closed": "taut"}, "contact": {"closed": "touching"}, "stop": {"closed": "at its end"}}


@dataclass(frozen=True)
class RowDerivatives:
    """How what a loop, a motion or a contact holds at 0 changes by time, coordinates, rates and parameters, (1 + 2 n + np,): its
    ``value`` where that is prescribed, and its ``rate``. What ``sticks`` prescribes a rate, and stays where it is."""

    name: str
    sticks: bool
    value: Array | None
    rate: Array | None


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


@dataclass(frozen=True)
class Rank:
    """Degrees of freedom at a state (``freedom``) and by Grübler's ``count``; ``rows`` of all joints and couplings, of which
    ``redundant`` say nothing new there and ``always_redundant`` nothing new nearby either; ``driven``: prescribed motions;
    ``uncertain``: too close to call. ``explanation`` and ``self_stress`` (each way in which parts could be pre-stressed) in words."""

    freedom: int
    count: int
    rows: int
    redundant: int
    always_redundant: int
    driven: int
    uncertain: bool
    explanation: str
    self_stress: list[str]


@dataclass(frozen=True)
class Balances:
    """How well a solved instant balances, and what its rank is."""

    body_residuals: Array
    """(nb, 3) what is left of the momentum balance: N, N, N·m."""
    residual: float
    """Largest momentum-balance residual of a body, relative to the largest term."""
    sizes: tuple[float, float]
    """Largest force (N) and acceleration (m/s²) among the terms that balance."""
    rank: Rank

    @classmethod
    def read(cls, data: dict[str, Any]) -> Balances:
        """As the core gives it."""
        return cls(**data | {"rank": Rank(**data["rank"])})


@dataclass(frozen=True)
class Solution:
    """An instant, solved, as arrays: for n coordinates, nb bodies and nj joints in the order of the model."""

    accelerations: Array
    """(n,) of the coordinates."""
    body_accelerations: Array
    """(nb, 3) ax, ay of the mass centre, α."""
    reactions: Array
    """(nj, 3) Fx, Fy on the second body at the joint's point, couple M; NaN where indeterminate."""
    least_reactions: Array
    """(nj, 3) the member of least norm, where reactions are indeterminate."""
    determinate: NDArray[np.bool_]
    """(nj, 3)"""
    released: list[str]
    """Names of the joints that are not in place."""
    motions: dict[str, float]
    """Force or torque of each prescribed motion by name; NaN where indeterminate."""
    couplings: dict[str, float]
    """The same of each coupling."""
    locks: dict[str, float]
    """The same of each lock in place."""
    limits: dict[str, Limit]
    """What every contact, string and stop does, by name."""
    judged: Callable[[], dict[str, Any]] = field(repr=False)
    """What the core says of how well it balances."""

    @classmethod
    def read(cls, data: dict[str, Any], metadata: Mapping[str, Any], judged: Callable[[], dict[str, Any]]) -> Solution:
        """As the core gives it; ``judged`` asks it for more, which takes longer than the solution."""
        return cls(**data | {"limits": limits_of(data["limits"], metadata)}, judged=judged)

    @cached_property
    def balances(self) -> Balances:
        """How well it balances, found when first asked for."""
        return Balances.read(self.judged())

    residual = property(lambda self: self.balances.residual)
    sizes = property(lambda self: self.balances.sizes)
    rank = property(lambda self: self.balances.rank)


@dataclass(frozen=True)
class SymbolicAnswers:
    """What the core answers symbolically: one answer for each question, trees as nested lists; ``symbols``: kind, value and unit of
    every symbol by name; ``laws``: of loads that follow from others by a law that is not linear."""

    answers: list[Any]
    symbols: Mapping[str, dict[str, Any]]
    laws: Sequence[Mapping[str, Any]]

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> SymbolicAnswers:
        """As the core gives them."""
        return cls(data["answers"], data["symbols"], data["laws"])
