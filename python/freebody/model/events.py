"""Events and what they do, in the core's terms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from freebody.core import Spec, cards
from freebody.symbolic.dimensions import TIME

from . import syntax
from .arithmetic import text
from .errors import ModelProblem, Path
from .names import suggestion
from .scope import Folder
from .switches import Deeds, Event, listed
from .writer import Writer

_DIRECTIONS = {"rising": 1, "falling": -1, "any": 0}
_PARTS = ("joints", "forces", "motions", "contacts", "strings", "stops")


class EventWriter:
    """Writes the events of one scope, when all that they can name has been written.

    ``hand_over`` learns which event goes on as which file; ``folder`` is that of the model, None for a part; ``others`` are files that
    need not be there.
    """

    def __init__(self, write: Writer, hand_over: dict[str, str], folder: Folder | None, others: Iterable[str] = ()) -> None:
        self.write, self.spec, self.scope, self.prefix = write, write.spec, write.scope, write.prefix
        self.hand_over, self.folder, self.others = hand_over, folder, others

    def welds(self) -> None:
        """The joints that events put in place."""
        for name, event in self.scope.model.events.items():
            for weld, *bodies in event.welds(name):
                path: Path = ("events", name, "then")
                of = [self.write.point(path, f"{body}.origin") for body in bodies]
                made = {"name": self.prefix + weld, "type": "weld", "with": {"of": of}, "coordinates": [], "engaged": False}
                self.spec["joints"].append(made)
                self.write.items[f"joints.{made['name']}"] = (self.scope, path)

    def all(self) -> None:
        """The events."""
        self.spec["events"] += [self._event(name, event) for name, event in self.scope.model.events.items()]

    def _event(self, name: str, event: Event) -> Spec:
        path: Path = ("events", name)
        opening, when = event.at == "start", "1"
        if event.at is None:
            when = self.write.expression((*path, "when"), event.when)
        elif not opening:
            time = self.write.number((*path, "at"), event.at, "s")
            when = f"t - {text(time)}"
            if time == 0.0:
                self.scope.complain((*path, "at"), "an event at time 0 cannot be met by the motion", "write `at: start`")
        return {
            "name": self.prefix + name,
            "when": when,
            "direction": 0 if opening else 1 if event.at is not None else _DIRECTIONS[event.direction],
            "condition": None if event.condition is None else self.write.expression((*path, "if"), event.condition),
            "opening": opening,
            "guard": False,
            "then": self._then((*path, "then"), name, event),
        }

    def _then(self, path: Path, name: str, event: Event) -> list[str | Spec]:
        welds = [self.prefix + weld for weld, _, _ in event.welds(name)]
        found: list[str | Spec] = []
        for i, action in enumerate(event.actions()):
            here = (*path, i) if isinstance(event.then, list) else path
            if isinstance(action, Deeds):
                made = max(len(listed(action.weld)) - 1, 0)
                found += self._deeds(here, name, action, welds[:made])
                del welds[:made]
            elif action != "record":
                found.append(action)
        return found

    def _deeds(self, path: Path, name: str, deeds: Deeds, welds: list[str]) -> list[str | Spec]:
        gone = self._parts(path, "release", deeds.release) + self._parts(path, "cut", deeds.cut, "string")
        gone += self._removed(path, deeds.remove)
        actions: dict[str, Any] = {
            "release": list(dict.fromkeys(gone)),
            "unlock": self._gauges(path, "unlock", deeds.unlock),
            "engage": self._parts(path, "engage", deeds.engage) + welds,
            "lock": self._gauges(path, "lock", deeds.lock),
            "reset": self._rates((*path, "reset"), deeds.reset or {}),
            "set": dict(self._set((*path, "set", name), name, value) for name, value in (deeds.set or {}).items()),
        }
        found: list[str | Spec] = [{word: value} for word, value in actions.items() if value]
        if deeds.hand_over is not None:
            self._handed_over((*path, "hand_over"), name, deeds.hand_over)
            found.append("stop")
        return found

    # -- parts

    def _parts(self, path: Path, word: str, names: str | list[str] | None, kind: str = "") -> list[str]:
        """The items of the core behind names of joints, forces and so on."""
        owners, found = self.write.meanings.owners, []
        for i, name in enumerate(listed(names)):
            here = (*path, word) if isinstance(names, str) else (*path, word, i)
            full = self.write.full(name)
            if full not in owners:
                known = self.write.meanings.seen_from(self.scope, (k for k, v in owners.items() if kind in ("", v)))
                kinds = f"{kind}s" if kind else "joints, forces, contacts or the like"
                self.scope.complain(here, f"nothing is called `{name}` that can be {_DONE[word]}", suggestion(name, known, kinds))
            elif kind and owners[full] != kind:
                self.scope.complain(here, f"only strings are cut; `{name}` is a {owners[full]}", f"write `release: {name}`")
            else:
                found += self.write.meanings.several.get(full, [full])
        return found

    def _removed(self, path: Path, names: str | list[str] | None) -> list[str]:
        found: list[str] = []
        for i, name in enumerate(listed(names)):
            body = self.write.place((*path, "remove") if isinstance(names, str) else (*path, "remove", i), name, "body")
            if body == "ground":
                self.scope.complain((*path, "remove"), "the ground cannot be removed", "name a body")
            else:
                found += self._touching(body)
        return found

    def _touching(self, body: str) -> list[str]:
        """All that joins, touches or loads a body."""
        values = self.write.meanings.values
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

        for joint in self.spec["joints"]:
            if named(joint["with"]):
                marks |= {coordinate["name"] for coordinate in joint["coordinates"]}
        for _ in self.spec["gauges"]:
            fresh = {gauge["name"] for gauge in self.spec["gauges"] if named(gauge["value"])} - marks
            if not fresh:
                break
            marks |= fresh
        items = [(section, item) for section in _PARTS for item in self.spec[section]]
        stated = ("name", "type", "coordinates", "level")
        return [
            item["name"]
            for section, item in items
            if section != "joints" or item["type"] == "coupling" or cards.joints()[item["type"]].rows
            if named({word: value for word, value in item.items() if word not in stated})
        ]

    # -- numbers

    def _gauges(self, path: Path, word: str, texts: str | list[str] | None) -> list[str]:
        alone = isinstance(texts, str)
        return [
            self.write.expression((*path, word) if alone else (*path, word, i), gauge) for i, gauge in enumerate(listed(texts))
        ]

    def _rates(self, path: Path, given: Mapping[str, Any]) -> dict[str, str]:
        found: dict[str, str] = {}
        for gauge, rate in given.items():
            dimension = self.write.dimension(gauge)
            full = self.write.expression((*path, gauge), gauge)
            found[full] = self.write.expression((*path, gauge), rate, dimension and dimension.times(TIME, -1))
        return found

    def _set(self, path: Path, name: str, value: Any) -> tuple[str, str]:
        known: Mapping[str, tuple[str, Any]] = self.write.meanings.values
        full = self.write.full(name)
        kind, dimension = known.get(full, ("", None))
        if kind != "parameter":
            parameters = self.write.meanings.seen_from(self.scope, [k for k, (kind, _) in known.items() if kind == "parameter"])
            self.scope.complain(path, f"there is no parameter `{name}` to set", suggestion(name, parameters, "parameters"), True)
        return full, self.write.expression(path, value, dimension)

    # -- another model

    def _handed_over(self, path: Path, name: str, file: str) -> None:
        self.hand_over[self.prefix + name] = file
        if self.folder is None:
            self.scope.complain(path, "a part cannot hand the whole over to another model", "move the event to the whole model")
            return
        if file in self.others:
            return
        try:
            if not self.folder.beside(file).exists():
                raise ModelProblem(f"there is no file `{file}`", "the file of the other model is looked for beside this one")
        except ModelProblem as complaint:
            self.scope.complain(path, complaint.what, complaint.hint)


_DONE = {"release": "released", "engage": "engaged", "cut": "cut"}


def _names(value: str) -> list[str]:
    """The names in a text, which is one or an expression of some."""
    try:
        return [value, *syntax.names(syntax.parse(value).tree)]
    except ModelProblem:
        return [value]
