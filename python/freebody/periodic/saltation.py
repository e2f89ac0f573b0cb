"""How a perturbation passes a moment at which something switches: the saltation matrix.

Kong, Payne, Zhu & Johnson, *Saltation Matrices: The Essential Tool for Linearizing Hybrid Dynamical Systems* (Proc. IEEE 112,
2024): Ξ = D R + (F⁺ − D R F⁻) D g / (ġ), here with the clock and parameters among what is perturbed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from freebody.core import Array, Change, State, quote
from freebody.periodic.variation import NotDifferentiable, VectorField
from freebody.run.simulation import Run

_GRAZING = 1e-7
"""Rate of a guard over its largest on the way below which the motion grazes what switches it."""
_SAME = 1e-7
"""Part of the largest shift of the moment by which guards that switch together may differ."""
_CONTINUOUS = 1e-9
"""Part of the largest rate or acceleration by which these may differ on both sides of what is no jump."""
_READINGS = {"lift-off": "N", "slack": "tension", "stick": "slip", "reversal": "slip"}
_IMPACTS = ("impact", "taut", "contact")
_REFUSED = {"rest": "infinitely many bounces come to an end", "reset": "rates are given at once"}


@dataclass(frozen=True)
class Perturbation:
    """Changes (2n + nz, k) of coordinates, rates and own states at a fixed time, and those of the clock and parameters (1 + np, k)."""

    state: Array
    others: Array


@dataclass(frozen=True)
class Moment:
    """A moment of a run at which something happens."""

    run: Run
    field: VectorField
    t: float

    @cached_property
    def before(self) -> State:
        """The state just before."""
        return replace(self.run.motion.state(float(np.nextafter(self.t, -np.inf))), t=self.t)

    @cached_property
    def after(self) -> State:
        """The state after all that happens then."""
        return self.run.motion.state(self.t)

    @cached_property
    def changes(self) -> dict[int, Change]:
        """What switches then, by its place among the changes of the run."""
        return {i: change for i, change in enumerate(self.run.changes) if change.t == self.t}

    def guards(self) -> list[str]:
        """The expressions that fall to zero then, and so switch."""
        events = {event["name"]: event["when"] for event in self.run.source.spec["events"]}
        found = [events[event.name] for event in self.run.events if event.t == self.t and event.kind != "start"]
        engaged = {name for change in self.changes.values() if change.kind == "engaged" for name in change.of}
        limits = {limit["name"]: limit["type"] for limit in self.run.metadata["limits"]}
        for change in self.changes.values():
            if change.kind in _IMPACTS:
                names = [name for name in change.of if name in limits and name not in engaged]
                found += [f"{quote(name)}.{'slack' if limits[name] == 'string' else 'gap'}" for name in names]
        if not found:
            lost = [(name, change.kind) for change in self.changes.values() for name in change.of if name in limits]
            found = [f"{quote(name)}.{_READINGS[kind]}" for name, kind in lost if kind in _READINGS]
            found += [self._cone(name) for name, kind in lost if kind == "slip"]
            found += [
                self._sliding(name, change.kind) for change in self.changes.values() for name in change.of if name not in limits
            ]
        return list(filter(None, found))

    def _sliding(self, name: str, kind: str) -> str:
        """Of a joint with friction that begins to slide the friction that is left, N or N·m; of one that ceases to, or turns back,
        the rate of sliding."""
        joint = next((each for each in self.run.metadata["joints"] if each["name"] == name), None)
        stated = {each["name"]: each.get("friction") for each in self.run.source.spec["joints"]}
        friction = stated.get(name) or stated.get(name.rpartition(".")[0])  # of one pair on a shared pin
        if joint is None or not friction:
            return ""
        if kind == "slip":
            most = f"({friction.get('fixed', friction['kinetic'])})*({friction.get('radius', 1)})*{quote(name)}.F"
            return f"{most} - abs({quote(name)}.friction)"
        if joint["type"] == "hinge":
            return f"omega({quote(joint['second'])}) - omega({quote(joint['first'])})"
        return f"rate({quote(joint['coordinates'][0])})"

    def _cone(self, contact: str) -> str:
        """How far the friction of a contact that sticks is within Coulomb's cone, N."""
        contacts = {each["name"]: each for each in self.run.source.spec["contacts"]}
        each = contacts.get(contact) or contacts[contact.partition("[")[0]]
        most = each["friction"] if each["static_friction"] is None else each["static_friction"]
        return f"({most})*{quote(contact)}.N - abs({quote(contact)}.T)"

    @cached_property
    def assignments(self) -> dict[str, str]:
        """The parameters that events set then, with what they are set to."""
        happened = {event.name for event in self.run.events if event.t == self.t}
        events = [event for event in self.run.source.spec["events"] if event["name"] in happened]
        sets = [action["set"] for event in events for action in event["then"] if "set" in action]
        if len(sets) > 1:
            names = ", ".join(dict.fromkeys(name for each in sets for name in each))
            several = f"at t = {self.t:g} s {names} are set by several actions"
            raise NotDifferentiable(f"{several}, through which no perturbation is followed")
        return {name: text for each in sets for name, text in each.items()}

    def _fastest(self, guards: list[str]) -> Array:
        """The largest mean rates of expressions over the steps up to then."""
        steps = self.run.motion.steps
        times = np.append(steps[steps < self.t], np.nextafter(self.t, -np.inf))
        return np.nanmax(np.abs(np.diff(self.run.motion.evaluate(guards, times), axis=0) / np.diff(times)[:, None]), axis=0)

    def shift(self, perturbation: Perturbation) -> Array:
        """By how much the moment is later (k,). Raises ``NotDifferentiable`` for what grazes and for what only happens to switch
        at one time."""
        guards = self.guards()
        if not guards:
            what = (
                ", ".join(sorted({_REFUSED.get(change.kind, change.kind) for change in self.changes.values()})) or "a law jumps"
            )
            raise NotDifferentiable(f"at t = {self.t:g} s {what}, through which no perturbation is followed")
        slopes, others = self.field.split(self.run.source.derivatives(guards, self.before))
        speed = others[:, 0] + slopes @ self.field(self.before)
        if (grazing := np.flatnonzero(np.abs(speed) <= _GRAZING * self._fastest(guards))).size:
            name = guards[grazing[0]]
            raise NotDifferentiable(
                f"at t = {self.t:g} s `{name}` grazes zero: its rate there is 0, and what follows has no derivative"
            )
        shifts = -(slopes @ perturbation.state + others @ perturbation.others) / speed[:, None]
        if np.ptp(shifts, axis=0).max() > _SAME * np.abs(shifts).max():
            raise NotDifferentiable(f"at t = {self.t:g} s {', '.join(f'`{text}`' for text in guards)} fall to zero together, which a "
                                    "neighbouring motion need not do")  # fmt: skip
        return shifts[0]

    def through(self, perturbation: Perturbation) -> tuple[Perturbation, Array]:
        """The perturbation just after, at the shifted moment, and the shift: each motion is read when it is there."""
        if refused := [change for change in self.changes.values() if change.kind in ("reset", "rest")]:
            raise NotDifferentiable(f"at t = {self.t:g} s {_REFUSED[refused[0].kind]}, through which no perturbation is followed")
        shift, n = self.shift(perturbation), len(self.before.q)
        state = perturbation.state + np.outer(self.field(self.before), shift)
        others = perturbation.others.copy()
        others[0] += shift
        state, others = self._set(state, others)
        for i, change in self.changes.items():
            if change.impulses:
                by_state, by_others = self.field.split(self.run.motion.impact_derivatives(i))
                state = np.vstack([state[:n], by_state @ state + by_others @ others, state[2 * n :]])
        return Perturbation(state, others), shift

    def _set(self, state: Array, others: Array) -> tuple[Array, Array]:
        """The changes of y, of the clock and of parameters after events have set parameters or own states."""
        if not self.assignments:
            return state, others
        source, own = self.run.source, self.field.own
        places = {each["name"]: i for i, each in enumerate(source.metadata["parameters"])}
        by_state, by_others = self.field.split(source.derivatives(list(self.assignments.values()), self.before))
        changed, set_state, set_others = by_state @ state + by_others @ others, state.copy(), others.copy()
        for name, row in zip(self.assignments, changed, strict=True):
            if (place := places[name]) in own:
                set_state[2 * len(self.before.q) + own.index(place)] = row
            else:
                set_others[1 + place] = row
        return set_state, set_others

    def passed(self, perturbation: Perturbation) -> Perturbation:
        """The perturbation after the moment, at a fixed time."""
        if not (self.is_jump() or self.assignments):
            return perturbation
        there, shift = self.through(perturbation)
        others = there.others.copy()
        others[0] -= shift
        return Perturbation(there.state - np.outer(self.field(self.after), shift), others)

    def is_jump(self) -> bool:
        """Whether rates or accelerations jump."""
        before, after = self.field(self.before), self.field(self.after)
        return bool((np.abs(after - before) > _CONTINUOUS * max(np.abs(before).max(), np.abs(after).max())).any())
