"""One instant, solved: accelerations and every reaction, each with its sign and its right to be believed."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from freebody.core import Array, CompiledModel, FreeBodies, Indeterminate, NotFinite, State, quote
from freebody.solve import rich_tables
from freebody.solve.figures import figure
from freebody.solve.rich_tables import PlainText, table

if TYPE_CHECKING:
    from rich.table import Table


STILL = 1e-4
"""Relative to the largest acceleration among the terms that balance: below it is the rounding of what a person types, above
it a load that nothing carries."""
NOTHING = 1e-30
"""N and m/s²: what is less is no force and no acceleration."""
_LOADS = "N|T|F|Fx|Fy|Fs|Fn|M|tension|friction|force|power"
"""Readings that the balances may leave undetermined."""


@dataclass(frozen=True)
class Reaction:
    """The reaction of a joint on the body ``body``, at an instant or over time.

    ``values`` (…, 3): force components Fx, Fy in N in the fixed axes and the couple M in N·m, counter-clockwise,
    about the joint's point; ``determined`` (…, 3) says which of them the balance equations determine.
    ``has_couple`` is False for a joint that passes none: its M is 0; ``carries`` is False for one that passes no load at all.
    A component that they do not determine is never given as a number; ``least`` is the way to opt in.
    """

    name: str
    first: str
    second: str
    body: str
    values: Array = field(repr=False)
    determined: NDArray[np.bool_] = field(repr=False)
    smallest: Callable[[], Array] = field(repr=False)
    local: Callable[[], Array] = field(repr=False)
    has_couple: bool = True
    carries: bool = True

    @classmethod
    def of(
        cls,
        joint: Mapping[str, Any],
        values: Array,
        determined: NDArray[np.bool_],
        smallest: Callable[[], Array],
        evaluate: Callable[[list[str]], Array],
    ) -> Reaction:
        """That of a joint as the core describes it, on its second body; ``evaluate`` gives expressions (…, k)."""
        name, first, second = joint["name"], joint["first"], joint["second"]
        local = [f"{quote(name)}.Fs", f"{quote(name)}.Fn"]
        carries = bool(joint["reaction"])
        return cls(name, first, second, second, values, determined, smallest, lambda: evaluate(local), joint["couple"], carries)

    @property
    def Fx(self) -> Any:
        """Force along the fixed x axis, N."""
        return self._part(0)

    @property
    def Fy(self) -> Any:
        """Force along the fixed y axis, N."""
        return self._part(1)

    @property
    def M(self) -> Any:
        """Couple about the joint's point, N·m, counter-clockwise."""
        return self._part(2)

    @property
    def size(self) -> Any:
        """Size of the force, N."""
        return np.hypot(self.Fx, self.Fy)

    @property
    def Fs(self) -> Any:
        """Force along the first body's line of the joint, or its curve at the contact, N."""
        return self._along(0)

    @property
    def Fn(self) -> Any:
        """Force across the first body's line of the joint (a quarter turn to its left), N."""
        return self._along(1)

    @property
    def determinate(self) -> bool:
        """Whether the balance equations determine every component at all times."""
        return bool(self.determined.all())

    @property
    def least(self) -> Reaction:
        """The reactions of least norm, one choice of infinitely many where they are indeterminate."""
        sign = 1.0 if self.body == self.second else -1.0
        return replace(self, values=sign * self.smallest(), determined=np.ones_like(self.determined))

    def on(self, body: str) -> Reaction:
        """The same reaction as it acts on one of the joint's two bodies."""
        if body not in (self.first, self.second):
            raise KeyError(f"{self.name} joins {self.first} and {self.second}; it does not act on {body}")
        return self if body == self.body else replace(self, body=body, values=-self.values)

    def _part(self, i: int) -> Any:
        if not self.determined[..., i].all():
            raise self._indeterminate(("Fx", "Fy", "M")[i])
        return self.values[..., i]

    def _along(self, i: int) -> Any:
        values = self.local()[..., i]
        if np.isnan(values).any():
            raise self._indeterminate(("Fs", "Fn")[i])
        return values if self.body == self.second else -values

    def _indeterminate(self, part: str) -> Indeterminate:
        return Indeterminate(
            f"{self.name}.{part} is not determined: the joints hold the mechanism in more ways than it needs, "
            f"so its parts can be pre-stressed. .least.{part} is the member of least norm, if one is wanted."
        )


class Reactions(PlainText, dict[str, Reaction]):
    """The reactions of all joints by name, at one instant or over the times of a run."""

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        if any(each.values.ndim > 1 for each in self.values()):
            sizes = ((each, np.hypot(*each.values[..., :2].T)) for each in self.values() if each.carries)
            rows = [(each.name, each.second, float(np.nanmax(size, initial=0.0))) for each, size in sizes]
            yield table("reactions", ["joint", "on", "largest force [N]"], rows)
        else:
            largest = max((float(np.nanmax(np.abs(each.values), initial=0.0)) for each in self.values()), default=0.0)
            yield rich_tables.of_reactions(self.values(), largest)

    def __missing__(self, name: str) -> Reaction:
        raise KeyError(f"no joint is called {name!r}; there are {', '.join(self)}")


class Instant(PlainText):
    """Accelerations and all reactions at a state."""

    def __init__(self, core: CompiledModel, state: State, route: str = "minimal") -> None:
        self.state = state
        self.route = route
        self.core = core
        self._metadata = core.metadata
        self._solved = solved = core.instant(state, route)
        self.limits = solved.limits
        """What every contact, string and stop does, by name."""
        self.motions = solved.motions
        """Force (N) or torque (N·m) that each prescribed motion takes."""
        self.couplings = solved.couplings
        """Force (N) or torque (N·m) that each coupling passes, along what it holds at 0."""
        self.locks = solved.locks
        """Force (N) or torque (N·m) along what each lock in place holds, named ``lock theta``."""

    @cached_property
    def absent(self) -> set[str]:
        """Names of the joints that are not in place, and of their coordinates."""
        released = self._solved.released
        return {*released, *(c["name"] for c in _named(self.core) if c["joint"] in released)}

    @property
    def residual(self) -> float:
        """Largest momentum-balance residual of a body, relative to its largest term."""
        return float(self._solved.residual)

    @property
    def sizes(self) -> tuple[float, float]:
        """Largest force (N) and acceleration (m/s²) among the terms that balance: what round-off is relative to."""
        return self._solved.sizes

    @property
    def freedom(self) -> int:
        """Degrees of freedom, by rank."""
        return self._solved.rank.freedom

    @property
    def explanation(self) -> str:
        """How the degrees of freedom come about, and what is redundant, in words."""
        return self._solved.rank.explanation

    @property
    def self_stress(self) -> list[str]:
        """In words, each way in which the parts could be pre-stressed."""
        return self._solved.rank.self_stress

    @cached_property
    def accelerations(self) -> dict[str, float]:
        """Second time derivatives of the coordinates by name, m/s² or rad/s²."""
        return dict(zip(self.core.coordinate_names, self._solved.accelerations.tolist(), strict=True))

    @property
    def dependent(self) -> dict[str, tuple[float, float]]:
        """Value and second time derivative of the ``dependent_coordinates`` of the model by name, m or rad."""
        names = [c["name"] for c in self.core.dependent_coordinates]
        values = self._values([text for name in names for text in (quote(name), f"accel({quote(name)})")])
        return {name: tuple(pair) for name, pair in zip(names, values.reshape(-1, 2).tolist(), strict=True)}

    @cached_property
    def bodies(self) -> dict[str, tuple[float, float, float]]:
        """Acceleration ax, ay of the mass centre (m/s²) and angular acceleration (rad/s²) by body."""
        names = (b["name"] for b in self._metadata["bodies"])
        return {name: tuple(row) for name, row in zip(names, self._solved.body_accelerations.tolist(), strict=True)}

    @cached_property
    def reactions(self) -> Reactions:
        """Reaction of every joint, on its second body unless ``.on(body)`` says otherwise."""
        solved = self._solved
        rows = zip(self._metadata["joints"], solved.reactions, solved.determinate, strict=True)
        made = (
            Reaction.of(joint, values, known, lambda i=i: solved.least_reactions[i], self._values)
            for i, (joint, values, known) in enumerate(rows)
        )
        return Reactions({reaction.name: reaction for reaction in made})

    def apart(self, other: Instant) -> tuple[float, float]:
        """Largest differences of accelerations and of reactions that both determine, relative to the largest, or to the terms that
        cancel in it."""
        force, acceleration = self.sizes
        accelerations = [np.array(list(instant.accelerations.values())) for instant in (self, other)]
        pairs = [(one, other.reactions[name]) for name, one in self.reactions.items()]
        known = [(one.values[both], its.values[both]) for one, its in pairs for both in [one.determined & its.determined]]
        reactions = [np.concatenate([*side, []]) for side in zip(*known, strict=True)] or [np.empty(0)] * 2
        return _gap(*accelerations, acceleration), _gap(*reactions, force)

    def nonequilibrium(self) -> dict[str, str]:
        """What moves or accelerates, in words, by coordinate; nothing in an equilibrium."""
        found: dict[str, str] = {}
        for coordinate, rate, acceleration in zip(
            self._metadata["coordinates"], self.state.u, self._solved.accelerations, strict=True
        ):
            name, unit = coordinate["name"], coordinate["dimension"]
            if rate != 0:
                found[name] = f"moves with {figure(rate)} {unit}/s"
            elif abs(acceleration) > STILL * self.sizes[1]:
                found[name] = f"accelerates with {figure(acceleration)} {unit}/s²"
        return found

    @property
    def residuals(self) -> dict[str, tuple[float, float, float]]:
        """The residual of each body's momentum balance: N, N, N·m."""
        names = (b["name"] for b in self._metadata["bodies"])
        return {name: tuple(row) for name, row in zip(names, self._solved.balances.body_residuals.tolist(), strict=True)}

    def free_bodies(self) -> FreeBodies:
        """Every load on every body, and what it gives their mass centres."""
        return self.core.free_bodies(self.state)

    def __getitem__(self, text: str) -> float:
        """The value of any expression at this instant. Raises ``Indeterminate`` where it reads a reaction that is not determined,
        ``NotFinite`` where it has no finite value."""
        value = float(self._values([text])[0])
        if not np.isfinite(value):
            refuse(text, self.state.t, self._metadata, self._values)
        return value

    def derivatives(self, text: str) -> dict[str, float]:
        """The exact partial derivatives of any expression at this instant: by ``t``, by each coordinate and its ``rate(…)``, all others
        kept, and by each parameter, with the parameters that follow from it. What sticks, slides or is open stays so.

        Where loops close, coordinates and rates do not change alone: only sums of derivatives that belong to a motion of the
        mechanism say how the value changes in it. Where the expression has no value it raises, as that does; where derivatives are
        not finite ``NotFinite``, with their names.
        """
        names = self.core.coordinate_names
        by = ["t", *names, *(f"rate({name})" for name in names), *(p["name"] for p in self._metadata["parameters"])]
        found = self.core.derivatives([text], self.state)[0]
        partial = dict(zip(by, found.tolist(), strict=True))
        infinite = [name for name, value in partial.items() if np.isinf(value)]
        # Where one is infinite others are only undecided, as 0 times it.
        if infinite := infinite or [name for name, value in partial.items() if np.isnan(value)]:
            _ = self[text]  # which raises where it has no value
            raise NotFinite(f"{text!r} has no finite derivative by {', '.join(infinite)} at t = {self.state.t:.6g} s")
        return partial

    def _values(self, texts: list[str]) -> Array:
        return self.core.evaluate(texts, self.state)

    def tables(self) -> list[Table]:
        """Accelerations, reactions on both bodies, what contacts, strings, stops, motions, couplings and locks do, and residuals, for
        rich."""
        found = self.accelerations | {name: acceleration for name, (_, acceleration) in self.dependent.items()}
        named = [c for c in _named(self.core) if c["name"] not in self.absent]
        coordinates = [(c["name"], rich_tables.beside(found[c["name"]], self.sizes[1]), f"{c['dimension']}/s²") for c in named]
        locks = {name.removeprefix("lock "): value for name, value in self.locks.items()}
        units = {m["name"]: m["readings"]["force"] for m in self.core.metadata["motions"]}
        units |= {x["name"].removeprefix("lock "): "N*m" if x["turns"] else "N" for x in self.core.metadata["locks"]}
        drives = (
            ("prescribed motions", "motion", self.motions),
            ("couplings", "coupling", self.couplings),
            ("locks", "lock", locks),
        )
        left = [(body, *(f"{value:.1e}" for value in row)) for body, row in self.residuals.items()]
        return [
            table("accelerations", ["coordinate", "value", "unit"], coordinates),
            rich_tables.of_reactions((r for name, r in self.reactions.items() if name not in self.absent), self.sizes[0]),
            rich_tables.of_limits(self.limits.values()),
            rich_tables.of_forces(self.limits.values()),
            *(
                table(
                    title,
                    [kind, "force or torque", "unit"],
                    [(name, force, units.get(name, "")) for name, force in forces.items()],
                )
                for title, kind, forces in drives
            ),
            table("what is left of the momentum balances", ["body", "x [N]", "y [N]", "about G [N·m]"], left),
        ]

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        from rich.text import Text

        yield from (table for table in self.tables() if table.row_count)
        yield Text("\n".join([f"largest relative residual {self.residual:.1e}", self.explanation, *self.self_stress]))

    def __repr__(self) -> str:
        return f"<instant of {self._metadata['name']!r} at t = {self.state.t:g} s: {len(self.accelerations)} coordinates>"

    def _ipython_key_completions_(self) -> list[str]:
        """What is offered for ``instant[…]``, of all that may stand there: the coordinates and the loads of joints."""
        names = map(quote, self.accelerations)
        moving = [text.format(name) for name in names for text in ("{}", "rate({})", "accel({})")]
        return moving + [
            f"{quote(joint['name'])}.{reading}" for joint in self._metadata["joints"] for reading in joint["readings"]
        ]


def _named(core: CompiledModel) -> list[dict[str, Any]]:
    """The coordinates of the tree, and those that the model names beside them."""
    return [*core.metadata["coordinates"], *core.dependent_coordinates]


def _gap(one: Array, other: Array, size: float) -> float:
    return float(np.abs(one - other).max(initial=0.0) / max(np.abs([one, other]).max(initial=0.0), size, NOTHING))


def refuse(text: str, t: float, metadata: Mapping[str, Any], evaluate: Callable[[list[str]], Array]) -> NoReturn:
    """Raise for an expression without a finite value at a time: ``Indeterminate`` where it reads a load that the balances do not
    determine, which ``evaluate`` gives as NaN; else ``NotFinite``."""
    for kind in ("joints", "limits", "motions", "locks"):
        for name in (part["name"] for part in metadata[kind]):
            readings = re.findall(rf"(?<![\w.]){re.escape(quote(name))}\.(?:{_LOADS})\b", text)
            if not readings or not np.isnan(evaluate(readings)).any():
                continue
            if kind == "joints":
                raise Indeterminate(
                    f"{text!r} reads a reaction of {name}, which is not determined; see reactions[{name!r}].least"
                )
            raise Indeterminate(f"{text!r} reads a force of {name}, which the balances do not determine")
    raise NotFinite(f"{text!r} has no finite value at t = {t:.6g} s")
