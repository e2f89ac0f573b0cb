"""The model language as types: they read a model, and the JSON Schema is made from them."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, PlainValidator, WithJsonSchema, model_validator

from freebody.core import EXTREMES, Settings, cards

from . import user_units
from .appearance import Look, Outline, PieceLook
from .elements import Force, Joint
from .errors import ModelProblem
from .switches import Contact, Event, Stop, String
from .values import (
    Angle,
    Circle,
    Inertia,
    Length,
    Line,
    Mass,
    Name,
    Number,
    Pair,
    Place,
    Section,
    Text,
    Time,
    TwoPoints,
    number_in,
    one_of,
    refuse,
)

VERSION = 1
"""The version of the language."""

SHAPES: dict[str, tuple[str, ...]] = {
    "particle": (),
    "rod": ("length",),
    "disk": ("radius",),
    "ring": ("radius",),
    "rectangle": ("width", "height"),
    "triangle": ("corners",),
    "polygon": ("corners",),
    "general": (),
}
"""The shapes with the sizes that each needs."""
SIZES = tuple(dict.fromkeys(size for sizes in SHAPES.values() for size in sizes))


class Shaped(Section):
    """Something of a shape: a body or a piece of one."""

    shape: Literal[tuple(SHAPES)] = "general"
    length: Length = Field(None, description="Length of a rod.")
    radius: Length = Field(None, description="Radius of a disk or ring.")
    width: Length = Field(None, description="Size of a rectangle along x.")
    height: Length = Field(None, description="Size of a rectangle along y.")
    corners: list[Pair] = Field(None, description="Corners of a triangle or polygon, in order.")
    mass: Mass = Field(None, description="Mass; 0 is allowed.")
    inertia: Inertia = Field(None, description="Inertia about the mass centre; overrules the shape's.")

    @model_validator(mode="after")
    def _sizes_suit_shape(self) -> Shaped:
        needed = set(SHAPES[self.shape])
        given = self.model_fields_set & set(SIZES)
        kind = f"a {self.shape}" if self.shape != "general" else "a body without a shape"
        if missing := min(needed - given, default=None):
            raise refuse(f"{kind} needs a `{missing}`", f"add `{missing}:`")
        if alien := min(given - needed, default=None):
            fitting = " or ".join(shape for shape, sizes in SHAPES.items() if alien in sizes)
            raise refuse(f"{kind} has no `{alien}`", f"`{alien}` belongs to the shape {fitting}")
        if self.shape == "triangle" and len(self.corners) != 3:
            raise refuse(f"a triangle has 3 corners, not {len(self.corners)}", "use `shape: polygon` for more")
        if self.shape == "polygon" and len(self.corners) < 3:
            raise refuse(f"a polygon has 3 corners or more, not {len(self.corners)}")
        return self


class Piece(Shaped):
    """A piece of a composite body, in a frame of its own."""

    look: PieceLook = Field(None, description="How it is drawn, where not as its body.")
    mass: Mass = Field(description="Mass; 0 is allowed.")
    at: Pair = Field([0, 0], description="Place of the piece's own origin in the body's frame.")
    angle: Angle = Field(0, description="Angle of the piece's x axis in the body's frame.")

    @model_validator(mode="after")
    def _looks_like_it(self) -> Piece:
        if self.look:
            self.look.suits(self.shape)
        return self


class PointMass(Section):
    """A mass added to a body at one of its points."""

    at: Place
    mass: Mass


class Arc(Section):
    """A piece of a track: from where the track is, about a centre, the shorter way to a point."""

    centre: Name
    to: Name


class Stretch(Section):
    """One piece of a track: a line or an arc."""

    line: TwoPoints = Field(None, description="From one point straight to another.")
    arc: Arc = Field(None, description="From where the track is, about a centre, to a point.")

    @model_validator(mode="after")
    def _one_of_two(self) -> Stretch:
        if len(self.model_fields_set) != 1:
            raise refuse("a stretch of a track is either a `line` or an `arc`", "give one of the two")
        return self


class CurveShape(Section):
    """A curve: coordinates as expressions of the curve parameter ``s``, or a whole circle (``s`` is the angle)."""

    x: Text = Field(None, description="x as an expression of s.")
    y: Text = Field(None, description="y as an expression of s.")
    arc: Circle = Field(None, description="A circle; s is the angle from the body's x axis.")

    @model_validator(mode="after")
    def _one_way(self) -> CurveShape:
        if self.model_fields_set not in ({"x", "y"}, {"arc"}):
            raise refuse("a curve needs `x` and `y`, or `arc`", "e.g. `{x: 2*s, y: s^2}` or `{arc: {centre: A, radius: r}}`")
        return self


Curve = one_of(
    "this is no curve",
    "write `{x: …, y: …}`, `{arc: {centre: A, radius: r}}`, or a list of lines and arcs",
    pair=list[Stretch],
    mapping=CurveShape,
)


class Marked(Section):
    """Something with named points, lines and curves: a body, or ground."""

    points: dict[str, Place] = Field({}, description="Named points: `[x, y]` or the name of another point.")
    lines: dict[str, Line] = Field({}, description="Named lines.")
    curves: dict[str, Curve] = Field({}, description="Named curves.")
    outline: Outline = Field(None, description="What drawings show: points, an SVG path, or none.")


class Ground(Marked):
    """The ground, which has the point ``ground.O``."""


class Body(Marked, Shaped):
    """A rigid body or a particle."""

    look: Look = Field(None, description="How it is drawn.")

    centre: Pair = Field(None, description="Mass centre; overrules the shape's.")
    point_masses: list[PointMass] = Field([], description="Masses added at points.")
    pieces: list[Piece] | dict[str, Piece] = Field(None, description="Pieces of a composite body, as a list or by name.")

    @model_validator(mode="after")
    def _has_mass(self) -> Body:
        given = self.model_fields_set
        if "pieces" in given and (alien := given & {"mass", "inertia", "centre", "shape"}):
            raise refuse(f"a body of pieces takes its mass from them; `{min(alien)}` has no place here", "give it to a piece")
        if not given & {"mass", "pieces", "point_masses"}:
            raise refuse("this body has no mass", "add `mass:`; a massless body says `mass: 0`")
        if self.look:
            self.look.suits(self.shape)
        if self.shape == "particle" and given & {"inertia", "centre"}:
            raise refuse("a particle has neither `inertia` nor `centre`", "leave the shape out for a body that can turn")
        return self


class Column(Section):
    """A column of a CSV file."""

    column: Name = Field(description="Its name in the first line of the file.")
    unit: str = Field("", description="The unit of its numbers; SI by default.")


Points = one_of(
    "these are no numbers", "write a list, or `{column: name, unit: mm}` of a file", pair=list[Number], mapping=Column
)


class Table(Section):
    """A function given by points; outside them the end value holds, or it is periodic."""

    x: Points = Field(description="Arguments, which grow.")
    y: Points = Field(description="Values.")
    file: Name = Field(None, description="A CSV file, relative to this one, whose columns `x` and `y` name.")
    interpolation: Literal["linear", "pchip", "spline"] = "linear"
    periodic: bool = Field(False, description="Whether the values come again with the span of the arguments.")

    @model_validator(mode="after")
    def _has_its_file(self) -> Table:
        columns = isinstance(self.x, Column) + isinstance(self.y, Column)
        if columns and self.file is None:
            raise refuse("a column needs the file that holds it", "add `file:` with the name of a CSV file")
        if self.file is not None and columns < 2:
            raise refuse(
                "the points of this table stand in a file", "name its columns, `x: {column: angle, unit: deg}`, `y` likewise"
            )
        return self


class StateVariable(Section):
    """A quantity that changes at a rate of its own: the integral of a controller, the output of a filter."""

    rate: Number = Field(description="Its rate: an expression of time and of the state.")
    start: Number = Field(0, description="Its value at the start.")


class Part(Section):
    """Another model file whose items come in under the name of the part."""

    file: Name = Field(description="The file, relative to this one.")
    parameters: dict[str, Number] = Field({}, description="Its parameters, overruled.")


class Motion(Section):
    """A prescribed motion of a gauge."""

    of: Text = Field(description="The gauge whose motion is given.")
    law: Number = Field(alias="is", description="Its value, rate or acceleration: an expression of time and state.")
    level: Literal["position", "velocity", "acceleration"] = "position"
    by: Text = Field(None, description="The gauge along which the actuator acts; `of` by default.")
    engaged: bool = Field(True, description="Whether it acts from the start.")


class Initial(Section):
    """How the motion starts; further keys are coordinates, held exactly."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Number]

    rates: dict[str, Number] = Field({}, description="Rates of coordinates.")
    at_rest: bool = Field(False, description="Whether all rates are 0.")
    guess: dict[str, Number] = Field({}, description="Approximate values of the other coordinates.")
    points: dict[str, Pair] = Field({}, description="Places of points, held exactly.")
    branch: dict[str, Literal["positive", "negative"]] = Field({}, description="Signs of expressions that choose the assembly.")
    equilibrium: bool = Field(False, description="Whether nothing accelerates while all is in place; it is checked.")


class Run(Section):
    """How far and how the motion is computed."""

    until: Time = Field(None, description="Time of the end.")
    method: Literal[tuple(cards.methods())] = Settings.method
    rtol: Number = Field(Settings.rtol, description="Relative tolerance.")
    every: Time = Field(None, description="Time between rows of the output.")
    max_step: Time = Field(None, description="Longest step.")
    step: Time = Field(None, description="The step of methods with fixed steps.")
    impacts: Literal["newton", "poisson", "sequential", "stop"] = Field(
        Settings.impacts, description="The law of impacts that restitution alone does not decide; `stop` ends the run there."
    )
    painleve: Literal["stop", "impact"] = Field(
        Settings.painleve, description="What happens where friction lets no motion go on: the run ends, or an impact."
    )


Moment = Number


class Question(Section):
    """A quantity to report, as a mapping."""

    value: Text = Field(None, description="An expression.")
    at: Moment = Field(None, description="`start`, `end`, an event, or a time.")
    max: Text = None
    min: Text = None
    maxima: Text = Field(None, description="All local ones.")
    minima: Text = Field(None, description="All local ones.")
    mean: Text = None
    rms: Text = None
    integral: Text = None
    over: list[Moment] = Field(None, description="From one moment to another.", min_length=2, max_length=2)
    unit: Name = Field(None, description="Unit of the printed figure.")

    @model_validator(mode="after")
    def _one_question(self) -> Question:
        asked = self.model_fields_set & {"value", *EXTREMES}
        if len(asked) != 1:
            raise refuse(
                f"a report needs one of `value`, {', '.join(f'`{word}`' for word in EXTREMES)}", "give exactly one of them"
            )
        if "over" in self.model_fields_set and "value" in asked:
            raise refuse(f"`over` goes with {', '.join(EXTREMES)}", "for one moment write `at`")
        if "at" in self.model_fields_set and "value" not in asked:
            raise refuse("`at` goes with `value`", "for a window write `over: [a, b]`")
        return self


class Over(Section):
    """A plot of one quantity over another, or around an angle."""

    of: Text = Field(description="An expression, upwards or as the radius.")
    over: Text = Field(None, description="The expression across.")
    around: Text = Field(None, description="The angle around which it goes.")

    @model_validator(mode="after")
    def _one_way(self) -> Over:
        if len(self.model_fields_set & {"over", "around"}) != 1:
            raise refuse(
                "a plot goes either `over` a quantity or `around` an angle",
                "give one of the two; over time write the expression alone",
            )
        return self


Plot = one_of(
    "this is no plot", "write an expression, a list of them, or `{of: …, over: …}`", text=Text, pair=list[Text], mapping=Over
)
_Acceleration = number_in("m/s^2")
Gravity = one_of(
    "this is no gravity", "write `none`, a size like `9.81`, or `[gx, gy]`", text=_Acceleration, number=_Acceleration, pair=Pair
)
Report = one_of("this is no quantity to report", "write `expression @ moment`", text=Text, mapping=Question)


def _user_units(value: Any) -> str:
    try:
        user_units.choice(str(value))
    except ModelProblem as problem:
        raise refuse(problem.what, problem.hint) from None
    return str(value)


UserUnits = Annotated[str, PlainValidator(_user_units), WithJsonSchema({"type": "string"})]


class Model(Section):
    """A whole model, as it is written."""

    freebody: Literal[1] = Field(VERSION, description="Version of the language.")
    name: str = Field("", description="Title.")
    parameters: dict[str, Number] = Field({}, description="Named numbers, in any order.")
    tables: dict[str, Table] = Field({}, description="Functions given by points.")
    gravity: Gravity = Field(9.81, description="`none`, a size, or `[gx, gy]`.")
    ground: Ground = Field(None, description="Points, lines and curves of the ground.")
    parts: dict[str, Part] = Field({}, description="Other model files, used as parts.")
    bodies: dict[str, Body] = Field({}, description="The bodies.")
    gauges: dict[str, Text] = Field({}, description="Named expressions of the configuration.")
    states: dict[str, StateVariable] = Field({}, description="Quantities with a rate of their own: integrals, filters.")
    joints: dict[str, Joint] = Field({}, description="The joints.")
    forces: dict[str, Force] = Field({}, description="The forces, gravity apart.")
    motions: dict[str, Motion] = Field({}, description="Prescribed motions.")
    contacts: dict[str, Contact] = Field({}, description="Surfaces that can push each other.")
    strings: dict[str, String] = Field({}, description="Strings, which can only pull.")
    stops: dict[str, Stop] = Field({}, description="Ends of the way of coordinates and other quantities.")
    initial: Initial = Field(None, description="How the motion starts.")
    events: dict[str, Event] = Field({}, description="What to watch for.")
    run: Run = Field(None, description="How far and how the motion is computed.")
    report: dict[str, Report] = Field({}, description="Quantities to report.")
    units: UserUnits = Field(None, description="Units in which figures are shown: `lb-ft`, or a list like `mm, deg, rpm`.")
    plots: dict[str, Plot] = Field({}, description="Plots, by their titles.")


def schema() -> dict[str, Any]:
    """The JSON Schema (2020-12) of a model file."""
    made = Model.model_json_schema(by_alias=True)
    head = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"https://freebody.invalid/schema/model/{VERSION}",
        "title": f"freebody model file, version {VERSION}",
    }
    return head | {key: value for key, value in made.items() if key not in head}
