"""A blow in a run, in letters: what touches, rates before and after, impulses in place of forces."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.balances.minimal import minimal_form
from freebody.equations.derivation.coordinates import stated
from freebody.equations.derivation.told import Balance, Subject
from freebody.equations.topics.common import NotHere, moving_names
from freebody.equations.tree import Sym, Tree, add, evaluate, mul, negative
from freebody.equations.tree import replace as put
from freebody.free_body import GROUND, FreeBodies, Load
from freebody.instant import State

if TYPE_CHECKING:
    from freebody.model.builder import Builder
    from freebody.switched import Change

_MOMENT = 1e-9
"""How long, in s, the motion is followed that tells what holds after the blow."""
_NOTHING = 1e-9
"""Lengths in m, rates in m/s and arms in m below which they are 0: what an event leaves of them."""
PRESSED = "pressed at"
"""How the names of forces begin that only make something count as touching."""
_LIMITS = ("contacts", "strings", "stops")


@dataclass(frozen=True)
class Struck(Subject):
    """A mechanism just after a blow without bounce, when all that was struck holds; rates of the state are those before."""

    motion: Any = None

    @cached_property
    def free(self) -> FreeBodies:
        """All loads, the forces of what was struck among them."""
        return FreeBodies.read(self.motion.free_bodies(self.state.t))

    def _told(self, questions: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        return json.loads(self.motion.letters(self.state.t, json.dumps({}), json.dumps(list(questions))))


@dataclass(frozen=True)
class Blow:
    """A blow: the ``change`` of the run, the mechanism in letters, and how much comes back (``restitution``) by name."""

    change: Change
    subject: Struck
    restitution: Mapping[str, float]

    @property
    def impulses(self) -> dict[Sym, Sym]:
        """The impulse for each unknown force."""
        return {Sym(load.symbol): Sym(impulse(load)) for load in self.forces}

    @property
    def forces(self) -> list[Load]:
        """Unknown loads, which may grow beyond all bounds."""
        return [load for load in self.subject.free.loads if load.unknown and not load.follows]

    @property
    def finite(self) -> list[Load]:
        """Known loads of the model, which give no impulse."""
        loads = self.subject.free.loads
        return [load for load in loads if not load.unknown and not load.follows and not load.name.startswith(PRESSED)]

    def after(self, tree: Tree) -> Tree:
        """An expression with the rates after the blow."""
        return put(tree, {Sym(name, 1): Sym(after(name), 1) for name in moving_names(self.subject)})

    def jump(self, balance: Balance) -> Tree:
        """Momentum after less momentum before."""
        return add(self.after(balance.momentum), negative(balance.momentum))

    def acting(self, balance: Balance) -> Tree:
        """What all impulses give to a balance."""
        forces, loads = self.impulses, self.subject.free.loads
        parts = [c.tree for c in balance.contributions if not c.absent and (loads[c.load].unknown or loads[c.load].follows)]
        return put(add(*parts), forces)

    def conditions(self) -> list[tuple[str, Tree, Tree]]:
        """Name, rate after and what it is, for all that holds after a blow without bounce."""
        made: list[tuple[str, Tree, Tree]] = []
        for row in self.subject.rows:
            first = row.name not in [name for name, _, _ in made]
            if row.rate is not None:
                back = bool(self.restitution.get(row.name)) and first  # the first row of a limit is its gap's
                made.append(
                    (row.name, self.after(row.rate), mul(negative(Sym(coefficient(row.name))), row.rate) if back else add())
                )
        return made

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
        names = moving_names(self.subject)
        found = [Sym(name) for name, x in zip(names, self.subject.state.q, strict=True) if abs(x) < _NOTHING]
        return dict.fromkeys([*found, *(Sym(name, 1) for name, x in self.change.before.u.items() if abs(x) < _NOTHING)], add())

    def of_coordinates(self) -> list[tuple[str, Balance]]:
        """The balances of the coordinates, with their titles."""
        return [(each.title, each.balance) for each in stated(self.subject)]


def blow(mechanism: Builder, number: int = 1) -> Blow:
    """The blow of a ``number``, counted from 1, in the run of a mechanism. Raises ``NotHere``."""
    run = mechanism.simulate()
    if not 1 <= number <= len(run.impacts):
        raise NotHere(f"the run has {len(run.impacts)} blows, none of number {number}; let it run longer, or start it otherwise")
    change, spec = run.impacts[number - 1], json.loads(run.source.spec)
    limits = [each for kind in _LIMITS for each in spec[kind]]
    p = mechanism.start()[0].p
    back = {each["name"]: _value(run.source.core, each["restitution"], p) for each in limits if each["name"] in change.of}
    before = change.before
    state = State(p, change.t, np.array(list(before.q.values())), np.array(list(before.u.values())))
    return Blow(change, Struck(mechanism.source(), state, motion=_without_bounce(mechanism, spec, state, change)), back)


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


def coefficient(name: str) -> str:
    """The letter of a coefficient of restitution."""
    return f"e_{name}" if name.isidentifier() else "e"


def _without_bounce(mechanism: Builder, spec: dict[str, Any], state: State, change: Change) -> Any:
    """The motion after the same blow without bounce. What would touch without a force then is pressed on, so that it counts."""
    limits = [each for kind in _LIMITS for each in spec[kind]]
    plain = {**spec, "events": []}
    for each in limits:
        each["restitution"] = 0.0
    motion = _moment(mechanism, plain, state)
    held = {load.name for load in FreeBodies.read(motion.free_bodies(state.t)).loads}
    pushes = _pushes(mechanism, change, [name for name in change.of if name not in held])
    return _moment(mechanism, {**plain, "forces": [*plain["forces"], *pushes]}, state) if pushes else motion


def _moment(mechanism: Builder, spec: Mapping[str, Any], state: State) -> Any:
    from freebody import _core
    from freebody.run import Settings, simulate

    text = json.dumps(spec)
    source = replace(mechanism.source(), core=_core.Mechanism(text), spec=text)
    return simulate(source, state, Settings(state.t + _MOMENT, step=_MOMENT, impacts="newton")).motion


def _pushes(mechanism: Builder, change: Change, names: Sequence[str]) -> list[dict[str, Any]]:
    """Forces against the impulses, of the size of these."""
    made = []
    for limit in mechanism.source().about["limits"]:
        if limit["name"] in names and (push := change.impulses.contacts.get(limit["name"])):
            body, sign = (limit["first"], -1.0) if limit["first"] != GROUND else (limit["second"], 1.0)
            words = {"at": f"{body}.G", "x": repr(sign * push[0]), "y": repr(sign * push[1])}
            made.append({"name": f"{PRESSED} {limit['name']}", "type": "force", "with": words, "engaged": True})
    return made


def _value(core: Any, number: Any, p: Any) -> float:
    if not isinstance(number, str):
        return float(number)
    names = [each["name"] for each in json.loads(core.describe())["parameters"]]
    from freebody.model.start import evaluate

    return evaluate(number, dict(zip(names, p.tolist(), strict=True)))
