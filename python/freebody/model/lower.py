"""From a model to the spec of the core: everything explicit, in SI, under full names."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path as FilePath
from typing import Any

import numpy as np

from freebody.core import CompiledModel, ModelError, MotionError, PlotItem, ReportItem, Spec, State, cards
from freebody.symbolic.dimensions import TIME

from . import answers, bodies, elements, events, guides, limits, looks, meanings, scope, start, table_friction, tables, units
from .errors import ModelFileError, ModelProblem, Path, Problem, Where
from .outlines import Outlines
from .schema import Model, StateVariable
from .scope import ITEMS, Folder, Places, Scope
from .start import Start
from .writer import Writer

_MARKS = ("points", "lines", "curves")
_ZEROS = {"right": "0", "up": "pi/2", "left": "pi", "down": "-pi/2"}
_DRAWN, _AGREED = 5, 1e-6  # states at which a potential is held against its force; relative, far above round-off
_SIZES = ("length", "rest_length", "radius", "coefficient", "friction", "load", "rest_speed")
_PLACES = {"point": Writer.point, "line": Writer.line, "circle": Writer.circle}
_MEASURED = {"number": Writer.number, "numbers": Writer.numbers, "law": Writer.expression, "gauge": Writer.expression}
_STEP = re.compile(r"\.?([^.\[\]]+)|\[(\d+)\]")


@dataclass
class Lowered:
    """A model as the core takes it, and what the core does not need: start, run, report, plots, looks.

    ``hand_over`` holds the events that go on as another model, with its file. ``items`` leads from an item of the spec
    (``joints.pivot``) to where it was written.
    """

    spec: Spec
    start: Start
    run: dict[str, Any]
    report: list[ReportItem]
    plots: list[PlotItem]
    root: Scope
    hand_over: dict[str, str] = field(default_factory=dict)
    items: dict[str, tuple[Scope, Path]] = field(default_factory=dict)
    looks: dict[str, dict[str, Any]] = field(default_factory=dict)
    source: CompiledModel | None = None
    """The compiled model with what views want to know of it, once that was asked for."""

    def where(self, core_path: str) -> Where:
        """The place of what the core calls ``joints.pivot.of[1]``."""
        known = core_path
        while known not in self.items and known:
            known = known[: max(known.rfind("."), known.rfind("["), 0)]
        if not known:
            return self.root.where(_steps(core_path))
        found, path = self.items[known]
        return found.where((*path, *_steps(core_path[len(known) :])))

    @cached_property
    def compiled(self) -> CompiledModel:
        """The model compiled. Raises ``ModelFileError`` with the place of what it complains about."""
        try:
            made = CompiledModel.of(self.spec)
        except ModelError as error:
            raise ModelFileError([Problem(self.where(error.path), error.what, error.hint)]) from None
        wrong = [name for name, (power, rate) in _with_potential(self.spec).items() if not _agrees(made, power, rate)]
        if wrong:
            what = "the potential is not that of the force"
            hint = "the force along the gauge is −dV/d(gauge): check its sign and factors"
            raise ModelFileError([Problem(self.where(f"forces.{name}.potential"), what, hint) for name in wrong])
        return made


def _with_potential(spec: Spec) -> dict[str, tuple[str, str]]:
    """The power of each force that has a potential, and the rate of that, as expressions."""
    stated = {force["name"]: force["with"] for force in spec["forces"] if "potential" in force["with"]}
    return {n: (f"({w['value']})*rate({w['along']})", f"rate({w['potential']})") for n, w in stated.items()}


def _agrees(model: CompiledModel, power: str, rate: str) -> bool:
    """Whether what a force does is taken from its potential, at a few states drawn at random."""
    drawn, p = np.random.default_rng(0), model.bind()
    for _ in range(_DRAWN):
        state = State(p, 0.0, *drawn.uniform(-1.0, 1.0, (2, len(model.metadata["coordinates"]))))
        try:
            done, given = model.evaluate([power, rate], state)
        except MotionError:
            continue
        if abs(done + given) > _AGREED * max(abs(done), abs(given)):
            return False
    return True


def _steps(text: str) -> Path:
    return tuple(int(index) if index else word for word, index in _STEP.findall(text) if word != "with")


def lower(model: Model, places: Places, file: str | FilePath | None = None, others: Iterable[str] = ()) -> Lowered:
    """The model in the core's terms; parts, and models that it continues with, are looked for beside ``file``.

    ``others`` need not be there as files. Raises ``ModelFileError`` with all that is wrong.
    """
    problems: list[Problem] = []
    folder = Folder.of(file)
    root = scope.open_scope(model, places, folder, problems)
    spec: Spec = {"name": root.model.name, "gravity": None} | {section: [] for section in (*ITEMS, *_MARKS)}
    whole = Writer(root, meanings.meanings(root), spec)
    writers = [replace(whole, scope=each) for each in root.all()]
    outlines = Outlines(writers)
    # Each step names what those before it have written; welds come before events, which may name anything.
    steps = (
        bodies.points,
        bodies.lines,
        looks.looks,
        _values,
        partial(_elements, outlines),
        partial(limits.limits, outlines),
        events.welds,
        events.events,
    )
    for step in steps:
        for write in writers:
            step(write)
    spec["gravity"] = _gravity(whole)
    begins = Start()
    for write in reversed(writers):  # what the whole says of a part's coordinates overrules what the part says
        start.write(write, begins)
    for inside, path, other in whole.hand_over.values():
        with inside.noting(path):
            if inside is not root:
                raise ModelProblem("a part cannot hand the whole over to another model", "move the event to the whole model")
            if other not in others and not folder.beside(other).exists():
                raise ModelProblem(f"there is no file `{other}`", "the file of the other model is looked for beside this one")
    hand_over = {event: other for event, (_, _, other) in whole.hand_over.items()}
    lowered = Lowered(
        spec,
        begins,
        answers.run(whole),
        answers.report(whole),
        answers.plots(whole),
        root,
        hand_over,
        whole.items | _items(root),
        whole.looks,
    )
    if problems:
        raise ModelFileError(problems)
    bare = {each["name"]: each["value"] for each in spec["parameters"] if not each["unit"]}
    for name in list(whole.angles):  # a parameter may be another
        while (name := str(bare.get(name, "")).lstrip("-")) in bare:
            whole.angles.add(name)
    begins.angles, begins.turns = whole.angles & bare.keys(), whole.turns
    for name in sorted(begins.angles):
        begins.turns |= units.many_turns(name, bare[name])
    return lowered


def _gravity(write: Writer) -> list[Any] | None:
    value, path = write.scope.model.gravity, ("gravity",)
    if value == "none":
        return None
    if isinstance(value, list) and all((d := write.dimension(v)) is not None and d.is_number for v in value):
        what = f"`gravity` is an acceleration (m/s^2); `[{', '.join(map(str, value))}]` is a direction"
        write.scope.complain(path, what, "multiply it by a size, `9.81 m/s^2*sin(al)`")
        return None
    if isinstance(value, list):
        return write.numbers(path, value, "m/s^2")
    size = write.number(path, value, "m/s^2")
    return [0.0, -size if isinstance(size, float) else f"-({size})"]


def _items(root: Scope) -> dict[str, tuple[Scope, Path]]:
    """Where each item of the spec was written."""
    found = {}
    for s in root.all():
        for section in ITEMS:
            found |= {f"{section}.{s.prefix}{name}": (s, (section, name)) for name in getattr(s.model, section)}
        marked = [("bodies", name, f"{s.prefix}{name}.", body) for name, body in s.model.bodies.items()]
        if s.model.ground:
            marked.append(("ground", "", f"ground.{s.prefix}", s.model.ground))
        for first, name, owner, body in marked:
            path: Path = (first, name) if name else (first,)
            for section in _MARKS:
                found[f"{section}.{owner}".rstrip(".")] = (s, path)
                found |= {f"{section}.{owner}{mark}": (s, (*path, section, mark)) for mark in getattr(body, section)}
    return found


# -- parameters, tables, gauges


def _values(write: Writer) -> None:
    model, parameters, spec = write.scope.model, write.scope.parameters, write.spec
    for name, value in model.parameters.items():
        written: Spec = {"name": write.prefix + name, "value": 0.0}
        if name not in parameters.faults:
            given = parameters.overruled.get(name)
            written["value"] = given[0] if given else write.number(("parameters", name), value)
            dimension = parameters.dimension(name)
            written["unit"] = dimension.unit() if dimension else ""
        spec["parameters"].append(written)
    for name, table in model.tables.items():
        spec["tables"].append(tables.written(write, name, table))
    for name, text in model.gauges.items():
        spec["gauges"].append({"name": write.prefix + name, "value": write.expression(("gauges", name), text)})
        write.meanings.values[write.prefix + name] = ("gauge", write.dimension(text))
    for name, state in model.states.items():
        spec["states"].append(_state(write, name, state))


def _state(write: Writer, name: str, state: StateVariable) -> Spec:
    """A state with a rate of its own; its unit is that of its start, or of its rate times a second."""
    path: Path = ("states", name)
    start, dimension = write.number((*path, "start"), state.start), write.dimension(state.start)
    rate = write.expression((*path, "rate"), state.rate, dimension and dimension.times(TIME, -1))
    if dimension is None and (of_rate := write.dimension(state.rate)):
        dimension = of_rate.times(TIME, 1)
    write.meanings.values[write.prefix + name] = ("state", dimension)
    return {"name": write.prefix + name, "start": start, "rate": rate, "unit": dimension.unit() if dimension else ""}


# -- joints, forces, motions


def _elements(outlines: Outlines, write: Writer) -> None:
    model, spec = write.scope.model, write.spec
    for name, joint in model.joints.items():
        written = _element(write, ("joints", name), joint, cards.joints()[joint.type]) | _friction(write, name, joint)
        written |= {"coordinates": _coordinates(write, name, joint)}
        spec["joints"].append(written)
        events.held_by_a_particle(write, name, written)
        guides.ends_and_side(write, name, joint, written)
    for name, force in model.forces.items():
        written = _element(write, ("forces", name), force, cards.forces()[force.type])
        spec["forces"].append(written)
        if force.type == table_friction.OF_PLATE:
            table_friction.lies(write, outlines, name, force, written)
        if force.type in table_friction.WORDS:
            table_friction.rest(write, name, force, written)
    for name, motion in model.motions.items():
        path: Path = ("motions", name)
        of, dimension = write.expression((*path, "of"), motion.of), write.dimension(motion.of)
        power = ("position", "velocity", "acceleration").index(motion.level)
        law = write.expression((*path, "is"), motion.law, dimension and dimension.times(TIME, -power))
        by = write.expression((*path, "by"), motion.by) if motion.by is not None else None
        stated = {"of": of, "is": law, "level": motion.level, "by": by, "engaged": motion.engaged}
        spec["motions"].append({"name": write.prefix + name} | stated)


def _element(write: Writer, path: Path, element: elements.Element, card: cards.Card) -> Spec:
    gauge = elements.given(element, "along") if any(f.kind == "gauge" and f.name == "along" for f in card.fields) else None
    # The fields of a force along a gauge that is no length have units of their own.
    dimension = write.dimension(gauge) if gauge else None
    loose = gauge is not None and (dimension is None or not dimension.fits(units.LENGTH))
    fields = {}
    for card_field in card.fields:
        value = elements.given(element, card_field.name)
        if value is not None:
            here, unit = (*path, card_field.name), None if loose else card_field.unit
            fields[card_field.name] = _field(write, here, card_field.kind, value, unit)
            if card_field.name in _SIZES and (write.size(value) or 0.0) < 0:
                what = f"a {card_field.name.replace('_', ' ')} cannot be negative; `{value}` is {write.size(value):g}"
                write.scope.complain(here, what, "check its sign")
    if card.type == "force" and not fields.keys() & {"direction", "x", "y"}:
        write.scope.complain(path, f"the force `{path[1]}` has no direction", "add `direction: 90 deg`, or give `x` and `y`")
    return {"name": write.prefix + str(path[1]), "type": card.type, "with": fields, "engaged": element.engaged}


def _field(write: Writer, path: Path, kind: str, value: Any, unit: str | None) -> Any:
    if kind == "points":
        return [write.point((*path, i), name) for i, name in enumerate(value)]
    if kind in ("curve", "body"):
        return write.place(path, value, kind)
    if kind in _PLACES:
        return _PLACES[kind](write, path, value)
    return _MEASURED[kind](write, path, value, unit) if kind in _MEASURED else value


def _friction(write: Writer, name: str, joint: elements.Element) -> Spec:
    words = {"kinetic": "friction", "fixed": "static_friction", "radius": "bearing_radius"}
    given = {key: word for key, word in words.items() if elements.given(joint, word) is not None}
    if not given:
        return {}
    if "kinetic" not in given:
        word = min(given.values())
        write.scope.complain(("joints", name, word), f"`{word}` goes with `friction`", "give the coefficient of sliding, too")
    written = {
        key: write.number(("joints", name, word), elements.given(joint, word), "m" if key == "radius" else "")
        for key, word in given.items()
    }
    return {"friction": written}


def _coordinates(write: Writer, name: str, joint: elements.Element) -> list[Spec]:
    named = scope.coordinate_names(name, joint)
    given = elements.coordinates(joint)
    at: Path = ("joints", name, "coordinates" if elements.given(joint, "coordinates") else "coordinate")
    return [
        _coordinate(write, (*at, i) if at[-1] == "coordinates" else at, c, card)
        for i, (c, (_, card)) in enumerate(zip(given, named, strict=False))
    ]


def _coordinate(write: Writer, path: Path, given: Any, card: cards.Coordinate) -> Spec:
    if isinstance(given, str):
        return {"name": write.prefix + given}
    zero, angle = given.zero, card.unit == "rad"
    if zero in _ZEROS and angle:
        zero = _ZEROS[zero]
    elif zero in _ZEROS or (given.absolute and not angle):
        word = "zero" if zero in _ZEROS else "absolute"
        what = f"`{word}: {getattr(given, word)}` goes with an angle; `{given.name}` is a length"
        write.scope.complain((*path, word), what, "leave it out")
        zero = 0.0
    stated = {"zero": write.number((*path, "zero"), zero, card.unit or None), "absolute": given.absolute}
    return {"name": write.prefix + given.name, "sense": -1 if given.sense in ("clockwise", "backward") else 1} | stated
