"""What the names of a whole model mean, parts included, under their full names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from freebody.core import cards
from freebody.symbolic.dimensions import Dimension

from . import elements, guides, syntax
from .errors import ModelProblem, Path
from .names import TOKEN, fault, suggestion, unquote
from .schema import Body
from .scope import Scope, coordinate_names
from .units import unit

SHAPE_POINTS = dict.fromkeys(("particle", "disk", "ring", "rectangle"), ("centre",)) | {"rod": ("start", "centre", "end")}
EVERY_BODY = ("origin", "G")


@dataclass
class Meanings:
    """All names. ``values`` holds parameters, coordinates and gauges with their kind and dimension (None: not known).

    ``owners`` are joints, forces, motions, locks, contacts, strings and stops, whose ``readings`` are read as ``name.Fx``; ``several``
    holds those that are more than one item for the core. ``alias`` leads from points that only rename another to that one.
    """

    values: dict[str, tuple[str, Dimension | None]] = field(default_factory=dict)
    owners: dict[str, str] = field(default_factory=dict)
    readings: dict[str, Mapping[str, str | None]] = field(default_factory=dict)
    several: dict[str, list[str]] = field(default_factory=dict)
    bodies: set[str] = field(default_factory=lambda: {"ground"})
    points: set[str] = field(default_factory=lambda: {"ground.O", "ground.origin"})
    alias: dict[str, str] = field(default_factory=lambda: {"ground.origin": "ground.O"})
    lines: set[str] = field(default_factory=set)
    curves: set[str] = field(default_factory=set)
    tables: set[str] = field(default_factory=set)
    events: set[str] = field(default_factory=set)

    def called(self, kind: str) -> set[str]:
        """The full names of all points, lines, curves, bodies or strings."""
        if kind == "string":
            return {name for name, owner in self.owners.items() if owner == kind}
        return {"point": self.points, "line": self.lines, "curve": self.curves, "body": self.bodies}[kind]

    def dimension(self, name: str, scope: Scope) -> Dimension | None:
        """The dimension of a full name in an expression. Raises ``ModelProblem`` when it means nothing."""
        if name in self.values:
            return self.values[name][1]
        if name in syntax.CONSTANTS:
            return None  # laws like `2 + t` mean 2 + t/s
        owner = name.rpartition(".")[0]
        if owner in self.owners:
            found = self.readings[owner].get(name.rpartition(".")[2])
            return None if found is None else unit(found).dimension
        raise self.unknown(name, scope)

    def unknown(self, name: str, scope: Scope) -> ModelProblem:
        """The complaint about a name in an expression that means nothing."""
        short = name.removeprefix(scope.prefix)
        if name in self.points or name in self.bodies:
            kind = "point" if name in self.points else "body"
            readings = "`x`, `y`, `vx`, `distance`" if kind == "point" else "`angle`, `omega`"
            return ModelProblem(
                f"`{short}` is a {kind}, not a number",
                f"read it through a function such as {readings}: `{'x' if kind == 'point' else 'angle'}({short})`",
            )
        return ModelProblem(
            f"nothing is called `{short}`", suggestion(short, self.seen_from(scope, self.values), "parameters or coordinates")
        )

    def place(self, name: str, kind: str, known: Iterable[str], scope: Scope) -> ModelProblem:
        """The complaint about a point, line or curve that does not exist."""
        short = name.removeprefix(scope.prefix)
        body, _, last = name.rpartition(".")
        if name in self.bodies:
            points = sorted(k for k in known if k.rpartition(".")[0] == name)
            return ModelProblem(
                f"a {kind} is needed, and `{short}` is a body", f"write one of its {kind}s, e.g. `{points[-1]}`" if points else ""
            )
        if body in self.bodies:
            own = [k.rpartition(".")[2] for k in known if k.rpartition(".")[0] == body]
            return ModelProblem(
                f"`{body.removeprefix(scope.prefix)}` has no {kind} `{last}`", suggestion(last, own, f"{kind} of that body")
            )
        if body:
            return ModelProblem(
                f"there is no body `{body.removeprefix(scope.prefix)}`",
                suggestion(body.removeprefix(scope.prefix), self.seen_from(scope, self.bodies)),
            )
        return ModelProblem(f"`{short}` is no {kind}", f"a {kind} is written `body.name`, e.g. `ground.O`")

    def seen_from(self, scope: Scope, known: Iterable[str]) -> list[str]:
        """Full names as that file writes them."""
        return [k.removeprefix(scope.prefix) for k in known if k.startswith(scope.prefix) or k.startswith("ground")]


def meanings(root: Scope) -> Meanings:
    """The names of a model; those used twice or that cannot be names are complained about."""
    found = Meanings()
    for scope in root.all():
        _Declaring(found, scope).all()
    return found


class _Declaring:
    def __init__(self, found: Meanings, scope: Scope) -> None:
        self.found = found
        self.scope = scope
        self.model = scope.model

    def all(self) -> None:
        m, found, full = self.model, self.found, self.full
        for name in m.parameters:
            self.value(name, ("parameters", name), "parameter", self.scope.parameters.dimension(name))
        for name, body in m.bodies.items():
            self.body(name, body)
        self.marks("ground", m.ground, ("ground",))
        for name, joint in m.joints.items():
            self.owner(name, "joint", ("joints", name), cards.joints()[joint.type].readings)
            for coordinate, card in coordinate_names(name, joint):
                path: Path = ("joints", name, "coordinates" if "coordinates" in joint.model_fields_set else "coordinate")
                self.value(coordinate, path, "coordinate", unit(card.unit).dimension if card.unit else None)
            self.ends(name, joint)
        for name in m.gauges:
            self.value(name, ("gauges", name), "gauge", None)
        for name, force in m.forces.items():
            self.owner(name, "force", ("forces", name), cards.forces()[force.type].readings)
        for name in m.motions:
            self.owner(name, "motion", ("motions", name))
        for name in m.contacts:
            self.owner(name, "contact", ("contacts", name))
        for name in m.strings:
            self.owner(name, "string", ("strings", name))
        for name, stop in m.stops.items():
            self.owner(name, "stop", ("stops", name))
            if stop.least is not None and stop.most is not None:
                self.stops_of(name, "least", "most")
        for name in m.tables:
            self.check(name, ("tables", name))
            found.tables.add(full(name))
        for name, event in m.events.items():
            self.check(name, ("events", name))
            found.events.add(full(name))
            for weld, _, _ in event.welds(name):
                self.owner(weld, "joint", ("events", name), cards.joints()["weld"].readings)
            for text in event.locks():
                lock = f"lock {self.full(text)}"
                found.owners[lock], found.readings[lock] = "lock", cards.readings()["motion"]

    def ends(self, name: str, joint: elements.Element) -> None:
        """What the ends of a guide and the one side of a joint come to."""
        ends = elements.given(joint, "ends")
        if ends == "stop":
            self.stops_of(name, "start", "end")
            self.found.several[self.full(name)].insert(0, self.full(name))
        events = guides.leaving(name) if ends == "free" else []
        if elements.given(joint, "one_sided"):
            events += [event for event, _ in guides.lifting(name, joint)]
        for event in events:
            if event in self.model.events:
                self.scope.complain(
                    ("events", event), f"the joint `{name}` has an event `{event}`", "give yours another name", True
                )
            self.found.events.add(self.full(event))

    def stops_of(self, name: str, *sides: str) -> None:
        full = self.full(name)
        self.found.several[full] = [f"{full}.{side}" for side in sides]
        self.found.owners |= dict.fromkeys(self.found.several[full], "stop")
        self.found.readings |= dict.fromkeys(self.found.several[full], cards.readings()["stop"])

    def full(self, name: str) -> str:
        return self.scope.prefix + name

    def check(self, name: str, path: Path) -> None:
        usual = name.rpartition(".")[2] if path[-1] in ("coordinate", "coordinates") else name
        if what := fault(usual):
            self.scope.complain(path, what, "names hold letters, digits, spaces and `_`", True)

    def value(self, name: str, path: Path, kind: str, dimension: Dimension | None) -> None:
        self.check(name, path)
        known = self.found.values.get(self.full(name))
        if known is not None:
            self.scope.complain(
                path, f"the {kind} `{name}` has the name of a {known[0]}", "give one of them another name", kind != "coordinate"
            )
        elif name in syntax.CONSTANTS and kind != "parameter":
            self.scope.complain(
                path, f"`{name}` has a meaning of its own in expressions", f"give the {kind} another name", kind != "coordinate"
            )
        self.found.values.setdefault(self.full(name), (kind, dimension))

    def owner(self, name: str, kind: str, path: Path, readings: Mapping[str, str | None] | None = None) -> None:
        self.check(name, path)
        known = self.found.owners.get(self.full(name))
        if known is not None:
            self.scope.complain(path, f"the {kind} `{name}` has the name of a {known}", "give one of them another name", True)
        self.found.owners[self.full(name)] = kind
        self.found.readings[self.full(name)] = cards.readings()[kind] if readings is None else readings

    def body(self, name: str, body: Body) -> None:
        self.check(name, ("bodies", name))
        if name == "ground":
            self.scope.complain(
                ("bodies", name), "`ground` is always there", "give it points under `ground:`, outside `bodies:`", True
            )
            return
        full = self.full(name)
        self.found.bodies.add(full)
        for point in (*EVERY_BODY, *SHAPE_POINTS.get(body.shape, ())):
            self.found.points.add(f"{full}.{point}")
        self.marks(name, body, ("bodies", name))
        if name not in self.joined():
            for word, text in (("x", "m"), ("y", "m"), ("angle", "rad")):
                self.found.values.setdefault(f"{full}.{word}", ("coordinate", unit(text).dimension))

    def marks(self, body: str, marked: object, path: Path) -> None:
        owner = f"ground.{self.scope.prefix}" if body == "ground" else f"{self.full(body)}."
        for section, known in (("points", self.found.points), ("lines", self.found.lines), ("curves", self.found.curves)):
            for name in getattr(marked, section, {}):
                self.check(name, (*path, section, name))
                if section == "points" and f"{owner}{name}" in known:
                    self.scope.complain(
                        (*path, section, name), f"`{body}` has a point `{name}` already", "give yours another name", True
                    )
                known.add(f"{owner}{name}")

    def joined(self) -> set[str]:
        """The bodies that the joints of this file name which are there from the start; one along a curve leaves a body its own
        coordinates if it can be released."""
        if not hasattr(self, "_joined"):
            loose = {name for event in self.model.events.values() for name in event.released()}
            there = [j for name, j in self.model.joints.items() if j.engaged and not (name in loose and _on_curve(j))]
            texts = [text for joint in there for text in _texts(joint.written())]
            heads = (unquote(t[0]).rpartition(".")[0] for text in texts for t in TOKEN.finditer(text) if t.lastgroup == "name")
            self._joined = set(heads)
        return self._joined


def _on_curve(joint: elements.Element) -> bool:
    return any(field.kind == "curve" for field in cards.joints()[joint.type].fields)


def _texts(data: object) -> Iterable[str]:
    if isinstance(data, dict):
        for value in data.values():
            yield from _texts(value)
    elif isinstance(data, list):
        for item in data:
            yield from _texts(item)
    elif isinstance(data, str):
        yield data
