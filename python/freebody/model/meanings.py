"""What the names of a whole model mean, parts included, under their full names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import chain

from freebody.core import cards
from freebody.symbolic.dimensions import Dimension

from . import elements, guides, syntax, table_friction
from .errors import ModelProblem, Path
from .names import TOKEN, fault, suggestion, unquote
from .schema import Body
from .scope import ITEMS, Scope, coordinate_names
from .units import unit

SHAPE_POINTS = dict.fromkeys(("particle", "disk", "ring", "rectangle"), ("centre",)) | {"rod": ("start", "centre", "end")}
EVERY_BODY = ("origin", "G")


@dataclass
class Meanings:
    """All names. ``values`` holds parameters, coordinates, gauges and states with their kind and dimension (None: not known).

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
    is_driven: bool = False
    """Whether a motion is prescribed, in any part."""

    def called(self, kind: str) -> set[str]:
        """The full names of all points, lines, curves, bodies, or strings and the joints that have a tension as they do."""
        if kind == "string":
            joints = {name for name, owner in self.owners.items() if owner == "joint" and "tension" in self.readings[name]}
            return joints | {name for name, owner in self.owners.items() if owner == kind}
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
        if name in self.points:
            hint = f"read it through a function such as `x`, `y`, `vx`, `distance`: `x({short})`"
            return ModelProblem(f"`{short}` is a point, not a number", hint)
        if name in self.bodies:
            hint = f"read it through a function such as `angle`, `omega`: `angle({short})`"
            return ModelProblem(f"`{short}` is a body, not a number", hint)
        hint = suggestion(short, self.seen_from(scope, self.values), "parameters or coordinates")
        return ModelProblem(f"nothing is called `{short}`", hint)

    def place(self, name: str, kind: str, known: Iterable[str], scope: Scope) -> ModelProblem:
        """The complaint about a point, line or curve that does not exist."""
        short, (body, _, last) = name.removeprefix(scope.prefix), name.rpartition(".")
        owner = body.removeprefix(scope.prefix)
        of = lambda body: [k for k in known if k.rpartition(".")[0] == body]
        if name in self.bodies:
            what, points = f"a {kind} is needed, and `{short}` is a body", sorted(of(name))
            return ModelProblem(what, f"write one of its {kind}s, e.g. `{points[-1]}`" if points else "")
        if body in self.bodies:
            own = [k.rpartition(".")[2] for k in of(body)]
            return ModelProblem(f"`{owner}` has no {kind} `{last}`", suggestion(last, own, f"{kind} of that body"))
        if body:
            return ModelProblem(f"there is no body `{owner}`", suggestion(owner, self.seen_from(scope, self.bodies)))
        return ModelProblem(f"`{short}` is no {kind}", f"a {kind} is written `body.name`, e.g. `ground.O`")

    def seen_from(self, scope: Scope, known: Iterable[str]) -> list[str]:
        """Full names as that file writes them."""
        return [k.removeprefix(scope.prefix) for k in known if k.startswith(scope.prefix) or k.startswith("ground")]


def meanings(root: Scope) -> Meanings:
    """The names of a model; those used twice or that cannot be names are complained about."""
    found = Meanings(is_driven=any(scope.model.motions for scope in root.all()))
    for scope in root.all():
        _Declarations(found, scope).all()
    return found


_LIMITED = {"motions": "motion", "contacts": "contact", "strings": "string", "stops": "stop"}
_AGAIN, _NAMES = "give one of them another name", "names hold letters, digits, spaces and `_`"


class _Declarations:
    """The names that one scope declares."""

    def __init__(self, found: Meanings, scope: Scope) -> None:
        self.found, self.scope, self.model, self.prefix = found, scope, scope.model, scope.prefix

    def all(self) -> None:
        m, found, prefix = self.model, self.found, self.prefix
        for section in ITEMS:
            for name in getattr(m, section):
                self.spelled(name, (section, name))
        for name in m.parameters:
            self.value(name, ("parameters", name), "parameter", self.scope.parameters.dimension(name))
        for name, body in m.bodies.items():
            self.body(name, body)
        self.marks("ground", m.ground, ("ground",))
        for name, joint in m.joints.items():
            self.owner(name, "joint", ("joints", name), cards.joints()[joint.type].readings)
            path: Path = ("joints", name, "coordinates" if "coordinates" in joint.model_fields_set else "coordinate")
            for coordinate, card in coordinate_names(name, joint):
                self.spelled(coordinate.rpartition(".")[2], path)
                self.value(coordinate, path, "coordinate", unit(card.unit).dimension if card.unit else None)
            self.ends(name, joint)
        for name in m.gauges:
            self.value(name, ("gauges", name), "gauge", None)
        for name in m.states:
            self.value(name, ("states", name), "state", None)
        for name, force in m.forces.items():
            self.owner(name, "force", ("forces", name), cards.forces()[force.type].readings)
            if force.type in table_friction.WORDS:
                for event in (table_friction.resting(name), *table_friction.holding(name, force, found.is_driven)):
                    self.event(event, f"the force `{name}`")
        for section, kind in _LIMITED.items():
            for name in getattr(m, section):
                self.owner(name, kind, (section, name), cards.readings()[kind])
        for name, stop in m.stops.items():
            if stop.least is not None and stop.most is not None:
                self.stops_of(name, "least", "most")
        for name in m.tables:
            if name in syntax.FUNCTIONS | syntax.CONSTANTS:
                what = f"`{name}` has a meaning of its own in expressions"
                self.scope.complain(("tables", name), what, "give the table another name", True)
            found.tables.add(prefix + name)
        for name, event in m.events.items():
            found.events.add(prefix + name)
            for weld, _, _ in event.welds(name):
                self.owner(weld, "joint", ("events", name), cards.joints()["weld"].readings)
            for text in chain.from_iterable(event.all("lock")):
                lock = f"lock {prefix}{text}"
                found.owners[lock], found.readings[lock] = "lock", cards.readings()["motion"]

    def ends(self, name: str, joint: elements.Element) -> None:
        """What the ends of a guide and the one side of a joint come to."""
        ends = elements.given(joint, "ends")
        if ends == "stop":
            self.stops_of(name, "start", "end")
            self.found.several[self.prefix + name].insert(0, self.prefix + name)
        if cards.joints()[joint.type].gap is not None:
            self.stops_of(name, "contact")
        events = guides.leaving(name) if ends == "free" else []
        events += [event for event, _ in guides.endings(name, joint)]
        if elements.given(joint, "one_sided"):
            events += [event for event, _ in guides.lifting(name, joint)]
        for event in events:
            self.event(event, f"the joint `{name}`")

    def event(self, event: str, of: str) -> None:
        """An event that an item comes to."""
        if event in self.model.events:
            self.scope.complain(("events", event), f"{of} has an event `{event}`", "give yours another name", True)
        self.found.events.add(self.prefix + event)

    def stops_of(self, name: str, *sides: str) -> None:
        full = self.prefix + name
        self.found.several[full] = [f"{full}.{side}" for side in sides]
        self.found.owners |= dict.fromkeys(self.found.several[full], "stop")
        self.found.readings |= dict.fromkeys(self.found.several[full], cards.readings()["stop"])

    def spelled(self, name: str, path: Path) -> None:
        if what := fault(name):
            self.scope.complain(path, what, _NAMES, True)

    def value(self, name: str, path: Path, kind: str, dimension: Dimension | None) -> None:
        at_key = kind != "coordinate"
        if known := self.found.values.get(self.prefix + name):
            self.scope.complain(path, f"the {kind} `{name}` has the name of a {known[0]}", _AGAIN, at_key)
        elif name in syntax.CONSTANTS:
            what = f"`{name}` has a meaning of its own in expressions"
            self.scope.complain(path, what, f"give the {kind} another name", at_key)
        self.found.values.setdefault(self.prefix + name, (kind, dimension))

    def owner(self, name: str, kind: str, path: Path, readings: Mapping[str, str | None]) -> None:
        full = self.prefix + name
        if known := self.found.owners.get(full):
            self.scope.complain(path, f"the {kind} `{name}` has the name of a {known}", _AGAIN, True)
        self.found.owners[full], self.found.readings[full] = kind, readings

    def body(self, name: str, body: Body) -> None:
        if name == "ground":
            hint = "give it points under `ground:`, outside `bodies:`"
            self.scope.complain(("bodies", name), "`ground` is always there", hint, True)
            return
        full = self.prefix + name
        self.found.bodies.add(full)
        self.found.points |= {f"{full}.{point}" for point in (*EVERY_BODY, *SHAPE_POINTS.get(body.shape, ()))}
        self.marks(name, body, ("bodies", name))
        if name not in self.joined:
            for word, text in (("x", "m"), ("y", "m"), ("angle", "rad")):
                self.found.values.setdefault(f"{full}.{word}", ("coordinate", unit(text).dimension))

    def marks(self, body: str, marked: object, path: Path) -> None:
        owner = f"ground.{self.prefix}" if body == "ground" else f"{self.prefix}{body}."
        for section in ("points", "lines", "curves"):
            known: set[str] = getattr(self.found, section)
            for name in getattr(marked, section, {}):
                here = (*path, section, name)
                self.spelled(name, here)
                if section == "points" and f"{owner}{name}" in known:
                    self.scope.complain(here, f"`{body}` has a point `{name}` already", "give yours another name", True)
                known.add(f"{owner}{name}")

    @cached_property
    def joined(self) -> set[str]:
        """The bodies that the joints of this file name which are there from the start; one along a curve leaves a body its own
        coordinates if it can be released."""
        loose = {name for event in self.model.events.values() for names in event.all("release") for name in names}
        on_curve = lambda joint: any(field.kind == "curve" for field in cards.joints()[joint.type].fields)
        there = [j for name, j in self.model.joints.items() if j.engaged and not (name in loose and on_curve(j))]
        texts = [text for joint in there for text in _texts(joint.written())]
        return {unquote(t[0]).rpartition(".")[0] for text in texts for t in TOKEN.finditer(text) if t.lastgroup == "name"}


def _texts(data: object) -> Iterable[str]:
    if isinstance(data, (dict, list)):
        for value in data.values() if isinstance(data, dict) else data:
            yield from _texts(value)
    elif isinstance(data, str):
        yield data
