"""Events and what they do, in the core's terms."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from freebody.core import Spec, cards
from freebody.symbolic.dimensions import TIME

from . import syntax
from .arithmetic import text
from .errors import ModelProblem, Path
from .names import suggestion
from .switches import Event, EventActions, listed
from .writer import Writer

_DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}
_DONE = {"release": "released", "engage": "engaged", "cut": "cut"}
_COMPARED = re.compile(r"(?P<left>[^<>=!]+)(==?|[<>]=?)(?P<right>[^<>=!]+)")
"""A condition where what passes a level is asked for; within parentheses, as in `if(x > 0, a, b)`, it is part of a number."""
_SET = ("parameter", "state")
_KEPT_APART = ("weld", "hinge")
"""Joints that hold two points as far apart as they are where they are engaged, in axes of the first body."""
_PARTS = ("joints", "forces", "motions", "contacts", "strings", "stops")


def welds(write: Writer) -> None:
    """The joints that events put in place."""
    particles = {body["name"] for body in write.spec["bodies"] if body["particle"]}
    for name, event in write.scope.model.events.items():
        for weld, *bodies in event.welds(name):
            path: Path = ("events", name, "then")
            # The axes of the first say where the two were joined, so that a particle, which has none that turn, comes second.
            of = sorted(
                (write.point(path, f"{body}.origin") for body in bodies), key=lambda at: at.rpartition(".")[0] in particles
            )
            made = {"name": write.prefix + weld, "type": "weld", "with": {"of": of}, "coordinates": [], "engaged": False}
            write.spec["joints"].append(made)
            write.items[f"joints.{made['name']}"] = (write.scope, path)


def held_by_a_particle(write: Writer, name: str, joint: Spec) -> None:
    """Complains of a joint that is engaged later in the axes of a particle, which has none that turn, though the other body has."""
    turns = {body["name"]: not body["particle"] for body in write.spec["bodies"]}
    bodies = [point.rpartition(".")[0] for point in joint["with"].get("of", ())] if joint["type"] in _KEPT_APART else []
    if not joint["engaged"] and [turns.get(body) for body in bodies] == [False, True]:
        first, second = joint["with"]["of"]
        what = f"where the two are joined is kept in the axes of the first, but the particle `{bodies[0]}` has none that turn"
        write.scope.complain(("joints", name, "of"), what, f"name the particle second: `of: [{second}, {first}]`")


def events(write: Writer) -> None:
    """The events."""
    write.spec["events"] += [_event(write, name, event) for name, event in write.scope.model.events.items()]


def _event(write: Writer, name: str, event: Event) -> Spec:
    path: Path = ("events", name)
    opening, when = event.at == "start", "1"
    if event.at is None:
        when = _level(write, (*path, "when"), event.when)
    elif not opening:
        time = write.number((*path, "at"), event.at, "s")
        when = f"t - {text(time)}"
        if time == 0.0:
            write.scope.complain((*path, "at"), "an event at time 0 cannot be met by the motion", "write `at: start`")
    return {
        "name": write.prefix + name,
        "when": when,
        "direction": 0 if opening else 1 if event.at is not None else _DIRECTIONS[event.direction],
        "condition": None if event.condition is None else write.expression((*path, "if"), event.condition),
        "opening": opening,
        "guard": False,
        "then": _then(write, (*path, "then"), name, event),
    }


def _level(write: Writer, path: Path, stated: Any) -> str:
    """The expression that passes zero at an event; a comparison is answered with how to write it."""
    compared = _COMPARED.fullmatch(str(stated))
    if not compared or any(side.count("(") != side.count(")") for side in compared.group("left", "right")):
        return write.expression(path, stated)
    left, sign, right = (part.strip() for part in compared.groups())
    taken = f"({right})" if re.search(r"[-+]", right) else right
    level = left if re.fullmatch(r"0(\.0*)?", right) else f"{left} - {taken}"
    way = ", direction: rising" if ">" in sign else ", direction: falling" if "<" in sign else ""
    write.scope.complain(path, f"`when` is what passes zero, and `{stated}` is a comparison", f"write `when: {level}{way}`")
    return "0"


def _then(write: Writer, path: Path, name: str, event: Event) -> list[str | Spec]:
    welds = [write.prefix + weld for weld, _, _ in event.welds(name)]
    found: list[str | Spec] = []
    for i, action in enumerate(event.actions()):
        here = (*path, i) if isinstance(event.then, list) else path
        if isinstance(action, EventActions):
            made = max(len(listed(action.weld)) - 1, 0)
            found += _actions(write, here, name, action, welds[:made])
            del welds[:made]
        elif action != "record":
            found.append(action)
    return found


def _actions(write: Writer, path: Path, name: str, given: EventActions, welds: list[str]) -> list[str | Spec]:
    gone = _parts(write, path, "release", given.release) + _parts(write, path, "cut", given.cut, "string")
    gone += _removed(write, path, given.remove)
    actions: dict[str, Any] = {
        "release": list(dict.fromkeys(gone)),
        "unlock": [write.expression(here, gauge) for here, gauge in _each(path, "unlock", given.unlock)],
        "engage": _parts(write, path, "engage", given.engage) + welds,
        "lock": [write.expression(here, gauge) for here, gauge in _each(path, "lock", given.lock)],
        "reset": _rates(write, (*path, "reset"), given.reset or {}),
        "set": dict(_set(write, (*path, "set", name), name, value) for name, value in (given.set or {}).items()),
    }
    found: list[str | Spec] = [{word: value} for word, value in actions.items() if value]
    if given.hand_over is not None:
        write.hand_over[write.prefix + name] = (write.scope, (*path, "hand_over"), given.hand_over)
        found.append("stop")
    return found


def _each(path: Path, word: str, names: str | list[str] | None) -> list[tuple[Path, str]]:
    """What stands after a word, a name or several, each with its path."""
    return [((*path, word) if isinstance(names, str) else (*path, word, i), name) for i, name in enumerate(listed(names))]


# -- parts


def _parts(write: Writer, path: Path, word: str, names: str | list[str] | None, kind: str = "") -> list[str]:
    """The items of the core behind names of joints, forces and so on."""
    owners, found = write.meanings.owners, []
    for here, name in _each(path, word, names):
        full = write.full(name)
        if full not in owners:
            known = write.meanings.seen_from(write.scope, (k for k, v in owners.items() if kind in ("", v)))
            kinds = f"{kind}s" if kind else "joints, forces, contacts or the like"
            write.scope.complain(here, f"nothing is called `{name}` that can be {_DONE[word]}", suggestion(name, known, kinds))
        elif kind and owners[full] != kind:
            write.scope.complain(here, f"only strings are cut; `{name}` is a {owners[full]}", f"write `release: {name}`")
        else:
            found += write.meanings.several.get(full, [full])
    return found


def _removed(write: Writer, path: Path, names: str | list[str] | None) -> list[str]:
    found: list[str] = []
    for here, name in _each(path, "remove", names):
        body = write.place(here, name, "body")
        if body == "ground":
            write.scope.complain((*path, "remove"), "the ground cannot be removed", "name a body")
        else:
            found += _touching(write, body)
    return found


def _touching(write: Writer, body: str) -> list[str]:
    """All that joins, touches or loads a body."""
    values = write.meanings.values
    marks = {body}

    def named(value: Any) -> bool:
        if isinstance(value, dict):
            return any(named(inner) for inner in value.values())
        if isinstance(value, list):
            return any(named(inner) for inner in value)
        return isinstance(value, str) and any(
            name in marks or (name.rpartition(".")[0] == body and values.get(name, ("",))[0] != "parameter")
            for name in _names(value)
        )

    for joint in write.spec["joints"]:
        if named(joint["with"]):
            marks |= {coordinate["name"] for coordinate in joint["coordinates"]}
    for _ in write.spec["gauges"]:
        fresh = {gauge["name"] for gauge in write.spec["gauges"] if named(gauge["value"])} - marks
        if not fresh:
            break
        marks |= fresh
    items = [(section, item) for section in _PARTS for item in write.spec[section]]
    stated = ("name", "type", "coordinates", "level")
    return [
        item["name"]
        for section, item in items
        if section != "joints" or item["type"] == "coupling" or cards.joints()[item["type"]].rows
        if named({word: value for word, value in item.items() if word not in stated})
    ]


# -- numbers


def _rates(write: Writer, path: Path, given: Mapping[str, Any]) -> dict[str, str]:
    found: dict[str, str] = {}
    for gauge, rate in given.items():
        dimension = write.dimension(gauge)
        full = write.expression((*path, gauge), gauge)
        found[full] = write.expression((*path, gauge), rate, dimension and dimension.times(TIME, -1))
    return found


def _set(write: Writer, path: Path, name: str, value: Any) -> tuple[str, str]:
    known: Mapping[str, tuple[str, Any]] = write.meanings.values
    full = write.full(name)
    kind, dimension = known.get(full, ("", None))
    if kind not in _SET:
        parameters = write.meanings.seen_from(write.scope, [k for k, (kind, _) in known.items() if kind in _SET])
        write.scope.complain(path, f"there is no parameter `{name}` to set", suggestion(name, parameters, "parameters"), True)
    return full, write.expression(path, value, dimension)


def _names(value: str) -> list[str]:
    """The names in a text, which is one or an expression of some."""
    try:
        return [value, *syntax.names(syntax.parse(value).tree)]
    except ModelProblem:
        return [value]
