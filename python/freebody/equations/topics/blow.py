"""A blow in letters: what touches, rates before and after, impulses in place of forces."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from freebody.balances.minimal import minimal_form
from freebody.blow import Blow as Happened
from freebody.blow import NoBlow
from freebody.equations.derivation.balancing import Stated
from freebody.equations.derivation.coordinates import stated
from freebody.equations.derivation.told import Balance, Row, Subject
from freebody.equations.names import Name
from freebody.equations.topics.common import NotHere, moving_names
from freebody.equations.tree import Sym, Tree, add, evaluate, mul, negative
from freebody.equations.tree import replace as put
from freebody.free_body import GROUND, FreeBodies, Load
from freebody.naming import ImpulseNaming

if TYPE_CHECKING:
    from freebody.model.builder import Builder
    from freebody.switched import Change

_NOTHING = 1e-9
"""Lengths in m, rates in m/s and arms in m below which they are 0: what an event leaves of them."""


@dataclass(frozen=True)
class Struck(Subject):
    """A mechanism during a blow, while all that was struck holds; rates are those before."""

    happened: Happened | None = None

    @property
    def blow(self) -> Happened:
        """What happened."""
        assert self.happened is not None
        return self.happened

    @cached_property
    def free(self) -> FreeBodies:
        """All loads, those of what was struck among them."""
        return self.blow.free

    def _told(self, questions: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        motion = self.blow.run.motion
        return json.loads(motion.letters_of_blow(self.blow.place, json.dumps({}), json.dumps(list(questions))))


@dataclass(frozen=True)
class Blow:
    """A blow of a run and the mechanism in letters during it."""

    subject: Struck

    @property
    def change(self) -> Change:
        """What the run tells of it."""
        return self.subject.blow.change

    @property
    def restitution(self) -> Mapping[str, float]:
        """How much comes back of the approach, by name."""
        return {} if self.change.impulses is None else self.change.impulses.restitution

    @cached_property
    def coefficients(self) -> dict[str, Sym]:
        """The letter of how much comes back, by name: that of the model, if it has one."""
        spec = json.loads(self.subject.source.spec)
        given = {limit["name"]: limit["restitution"] for kind in ("contacts", "strings", "stops") for limit in spec[kind]}
        named = {name: x for name, x in given.items() if isinstance(x, str) and x.isidentifier()}
        return {
            name: Sym(named.get(name, re.sub(r"\W+", "_", f"e_{name}").strip("_"))) for name, e in self.restitution.items() if e
        }

    @property
    def impulses(self) -> dict[Sym, Sym]:
        """The impulse for each unknown force."""
        return {Sym(load.symbol): Sym(impulse(load)) for load in self.forces}

    @property
    def forces(self) -> list[Load]:
        """Unknown loads, which may grow beyond all bounds."""
        return [load for load in self.subject.blow.acting if not load.follows]

    @property
    def slides(self) -> list[Load]:
        """Friction of what slides throughout the blow."""
        return [load for load in self.subject.blow.acting if load.follows]

    def law(self, load: Load) -> Tree:
        """The impulse of friction that slides, by that of the normal force: what it gives along its own direction."""
        place, body = self.subject.free.loads.index(load), load.on[0].body
        group = body if body != GROUND else load.on[1].body
        [balance] = self.subject.balances([{"ask": "equation", "bodies": [group], "along": {"load": place}}])
        share = next(c.tree for c in balance.contributions if c.load == place)
        of, ratio = load.follows or (0, 0.0)
        unit = {Sym(self.subject.free.loads[of].symbol): 1.0}
        same = float(evaluate(share, self.subject.values | unit)) * ratio > 0
        return put(share if same else negative(share), self.impulses)

    def after(self, tree: Tree) -> Tree:
        """An expression with the rates after the blow."""
        return put(tree, {Sym(name, 1): Sym(after(name), 1) for name in moving_names(self.subject)})

    def jump(self, balance: Balance) -> Tree:
        """Momentum after less momentum before."""
        return add(self.after(balance.momentum), negative(balance.momentum))

    def acting(self, balance: Balance) -> Tree:
        """What all impulses give to a balance."""
        loads = self.subject.blow.free.loads
        parts = [c.tree for c in balance.contributions if not c.absent and (loads[c.load].unknown or loads[c.load].follows)]
        return put(add(*parts), self.impulses)

    def conditions(self) -> list[tuple[str, Tree, Tree]]:
        """Name, rate after and what it is: what comes back, or 0, of all that holds after a blow."""
        rows = [(row, row.rate) for row in self.subject.rows if row.rate is not None]
        return [(row.name, self.after(rate), self._back(row, rate)) for row, rate in rows]

    def _back(self, row: Row, rate: Tree) -> Tree:
        """What comes back of a rate: of a gap (a row with a value) that closes."""
        subject = self.subject
        if row.value is None or row.name not in self.coefficients:
            return add()
        closing = abs(float(evaluate(rate, subject.values, subject.tables))) > _NOTHING
        return mul(negative(self.coefficients[row.name]), rate) if closing else add()

    def conserved(self) -> list[tuple[str, Balance]]:
        """Balances without any impulse, with their titles, as many as stay after what holds; empty where there are none."""
        found = minimal_form([self.subject.free], self.subject.points).equations
        asked = [equation.question for equation in found]
        if not asked or None in asked:
            return []
        balances = self.subject.balances([question for question in asked if question])
        free = all(self._is_free(balance) for balance in balances)
        return [(e.title, b) for e, b in zip(found, balances, strict=True)] if free else []

    def _is_free(self, balance: Balance) -> bool:
        """Whether no impulse has a part in a balance where the blow is; in letters it may take what touches to see it."""
        subject = self.subject
        units = dict.fromkeys(self.impulses, 1.0)
        parts = [c.tree for c in balance.contributions if not c.internal and subject.free.loads[c.load].unknown]
        return all(abs(float(evaluate(part, subject.values | units, subject.tables))) < _NOTHING for part in parts)

    @property
    def zeros(self) -> dict[Sym, Tree]:
        """Coordinates, and rates before the blow, that are 0 there."""
        state, names = self.subject.state, moving_names(self.subject)
        found = [Sym(name) for name, x in zip(names, state.q, strict=True) if abs(x) < _NOTHING]
        found += [Sym(name, 1) for name, x in zip(names, state.u, strict=True) if abs(x) < _NOTHING]
        return dict.fromkeys(found, add())

    def of_coordinates(self) -> list[Stated]:
        """The balances of the coordinates."""
        return stated(self.subject)

    def of_bodies(self) -> list[Stated]:
        """The three balances of every body, two of a particle."""
        made: list[tuple[dict[str, Any], str, str]] = []
        for name, body in self.subject.free.bodies.items():
            plain = {"ask": "equation", "bodies": [name]}
            made += [(plain | {"along": "x"}, "x", "along"), (plain | {"along": "y"}, "y", "along")]
            made += [] if body.particle else [(plain | {"about": "centre"}, f"the mass centre of {name}", "about")]
        balances = self.subject.balances([question for question, _, _ in made])
        return [Stated(balance, where, word) for balance, (_, where, word) in zip(balances, made, strict=True)]

    def sizes(self) -> dict[Sym, float]:
        """The impulses in numbers; NaN of one that the momenta do not determine."""
        return {Sym(impulse(load)): load.value for load in self.subject.blow.impulses.loads}

    @cached_property
    def written(self) -> dict[str, Name]:
        """How the letters of the impulses are written, by the symbols of their forces."""
        return ImpulseNaming.of(self.subject.blow).loads


def blow(mechanism: Builder, number: int = 1, of: str | None = None, at: str | float | None = None) -> Blow:
    """The blow of a ``number``, counted from 1, in the run of a mechanism: of all, of those of one contact, string or stop, or of
    those from a time ``at`` on (s, or ``"200 ms"``). Raises ``NotHere``."""
    try:
        found = mechanism.blow(number, of=of, at=at)
    except NoBlow as error:
        raise NotHere(str(error)) from None
    return Blow(Struck(found.source, found.state, happened=found))


def impulse(load: Load) -> str:
    """The letter of an impulse: ``bump.J_N``, ``pivot.J_x``."""
    owner, _, part = load.symbol.rpartition(".")
    return f"{owner or load.name}.J_{part.removeprefix('F') or part}"


def after(name: str) -> str:
    """The letter of a coordinate whose rate is that after the blow."""
    return (
        f"{name}_after"
        if not name[-1:].isdigit()
        else f"{name.rstrip('0123456789')}_{name[len(name.rstrip('0123456789')) :]}_after"
    )
