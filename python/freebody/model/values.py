"""The small things that a model is written with: numbers, points, lines, circles."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from numbers import Integral, Real
from typing import Annotated, Any, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    PlainValidator,
    Tag,
    ValidationError,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from .edition import Edition, watched
from .names import suggestion

T = TypeVar("T", bound="Section")


class Section(BaseModel):
    """A mapping of the language: its keys are known, others are errors with the nearest known one."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True, validate_assignment=True)

    @model_validator(mode="wrap")
    @classmethod
    def _name_unknown_keys(cls: type[T], data: Any, handler: Callable[[Any], T]) -> T:
        try:
            made = handler(data)
        except ValidationError as error:
            raise ValidationError.from_exception_data(cls.__name__, [cls._with_hint(e) for e in error.errors()]) from None
        made.__dict__.update({name: watched(value) for name, value in made.__dict__.items() if type(value) in (dict, list)})
        object.__setattr__(made, "__pydantic_extra__", watched(made.__pydantic_extra__))
        return made

    __setattr__ = Edition.changing(BaseModel.__setattr__)
    __delattr__ = Edition.changing(BaseModel.__delattr__)

    @classmethod
    def words(cls) -> list[str]:
        """The keys that it knows."""
        return [field.alias or name for name, field in cls.model_fields.items()]

    @classmethod
    def _with_hint(cls, error: Any) -> InitErrorDetails:
        kind, context = error["type"], error.get("ctx", {})
        if kind == "extra_forbidden" and len(error["loc"]) == 1:
            key = str(error["loc"][0])
            kind = cls._unknown(key)
        elif kind == "missing" and len(error["loc"]) == 1:
            key = str(error["loc"][0])
            kind = refuse(f"`{key}` is missing", cls._about(key))
        elif kind == "freebody" and "what" not in context:
            kind = refuse(*error["msg"].split("\n"))
        elif kind == "freebody":
            kind = refuse(context["what"], context["hint"])
        return InitErrorDetails(type=kind, loc=error["loc"], input=error["input"], ctx=context)

    @classmethod
    def _unknown(cls, key: str) -> PydanticCustomError:
        return refuse(f"unknown key `{key}`", suggestion(key, cls.words()))

    @classmethod
    def _about(cls, key: str) -> str:
        found = [f.description for name, f in cls.model_fields.items() if key in (name, f.alias) and f.description]
        return f"add `{key}:` ({found[0][0].lower()}{found[0][1:].rstrip('.')})" if found else f"add `{key}:`"

    def written(self) -> dict[str, Any]:
        """The plain data of what was given, with the keys of the language."""
        self.take_up()
        return self.model_dump(by_alias=True, exclude_unset=True)

    def take_up(self) -> None:
        """What was left out and has been filled since counts as given."""
        for name, value in self.__dict__.items():
            if isinstance(value, (dict, list)):
                if value and name not in self.model_fields_set and value != type(self).model_fields[name].default:
                    self.model_fields_set.add(name)
                inside = value.values() if isinstance(value, dict) else value
            else:
                inside = (value,)
            for each in inside:
                if isinstance(each, Section):
                    each.take_up()


def refuse(what: str, hint: str = "") -> PydanticCustomError:
    """The error that a validator raises: what is wrong and what to try."""
    return PydanticCustomError("freebody", "{what}", {"what": what, "hint": hint})


_DATE = re.compile(r"\s*\d{4}-\d\d-\d\d\b.*")


def _number(value: Any) -> float | int | str:
    if isinstance(value, str) and _DATE.fullmatch(value):
        raise refuse(f"`{value}` is a date, no number", "for a difference of numbers leave spaces around the `-`")
    if isinstance(value, str) and value.strip():
        return str(value)
    if isinstance(value, Real) and not isinstance(value, bool) and abs(value) <= sys.float_info.max:
        return int(value) if isinstance(value, Integral) else float(value)
    shown = "nothing stands here" if value is None else f"`{value}` is no number"
    raise refuse(shown, "write a number, a quantity like `400 mm`, or an expression of parameters")


def _text(value: Any) -> str:
    if isinstance(value, str) and value.strip():
        return str(value)
    if isinstance(value, Real) and not isinstance(value, bool):
        return str(value)
    raise refuse(
        "an expression stands here as text" if value is not None else "nothing stands here", "write an expression, e.g. `R - l`"
    )


def _name(value: Any) -> str:
    if isinstance(value, str) and value.strip():
        return str(value)
    if isinstance(value, list) and len(value) == 2:
        x, y = value
        raise refuse("a name is needed here", f"name the place, `points: {{P: [{x}, {y}]}}` of its body, and write `P`")
    raise refuse("a name is needed here", "names are texts; put quotes around one that looks like something else")


def number_in(unit: str) -> Any:
    """The type of a number with that SI unit: a bare number, a quantity or an expression."""
    schema = {"type": ["number", "string"], "x-unit": unit} if unit else {"type": ["number", "string"]}
    return Annotated[float | int | str, PlainValidator(_number), WithJsonSchema(schema)]


Number = number_in("")
Length, Angle, Mass, Inertia, Time = (number_in(u) for u in ("m", "rad", "kg", "kg*m^2", "s"))
Text = Annotated[str, PlainValidator(_text), WithJsonSchema({"type": ["string", "number"]})]
Name = Annotated[str, PlainValidator(_name), WithJsonSchema({"type": "string"})]


def several(item: Any, what: str, least: int = 2, most: int | None = None) -> Any:
    """The type of a list of ``least`` items to ``most``; ``what`` says what is needed."""

    def check(value: Any) -> Any:
        if not isinstance(value, (list, tuple)) or not least <= len(value) <= (most or len(value)):
            raise refuse(what)
        return value

    return Annotated[list[item], BeforeValidator(check), Field(min_length=least, max_length=most)]


Pair = several(Length, "two coordinates are needed: `[x, y]`", most=2)
TwoPoints = several(Name, "two points are needed: `[P, Q]`", most=2)
Points = several(Name, "a list of two points or more is needed: `[P, Q]`")
Numbers = several(Number, "a list of two numbers or more is needed")


class Through(Section):
    """A line through a point at an angle from the x axis of its body."""

    through: Name
    angle: Angle


class Circle(Section):
    """A circle about a point."""

    centre: Name
    radius: Length


def one_of(what: str, hint: str, **kinds: Any) -> Any:
    """A union told apart by how a value is written: ``text``, ``number``, ``pair`` (a list) or ``mapping``."""

    def kind(value: Any) -> str | None:
        if isinstance(value, (dict, BaseModel)):
            return "<mapping>"
        if isinstance(value, (list, tuple)):
            return "<pair>"
        if isinstance(value, Real) and not isinstance(value, bool):
            return "<number>"
        return "<text>" if isinstance(value, str) else None

    union: Any = None
    for word, type_ in kinds.items():
        member = Annotated[type_, Tag(f"<{word}>")]
        union = member if union is None else union | member
    # The message holds both sentences, because a context would make the type unhashable.
    stated = Discriminator(kind, custom_error_type="freebody", custom_error_message=f"{what}\n{hint}")
    return Annotated[union, stated]


Line = one_of(
    "this is no line",
    "a line is written `body.name`, `[P, Q]` or `{through: P, angle: a}`",
    text=Name,
    pair=TwoPoints,
    mapping=Through,
)
Area = one_of(
    "this is no area",
    "name a disk, ring, rectangle or polygon, or write `{centre: P, radius: r}` or the corners `[P, Q, R]`",
    text=Name,
    pair=several(Name, "an area has three corners or more: `[P, Q, R]`", least=3),
    mapping=Circle,
)
Place = one_of("this is no point", "a point is written `[x, y]`, or with the name of another", text=Name, pair=Pair)
Names = one_of("names are needed here", "write a name, or `[a, b]`", text=Name, pair=list[Name])
Texts = one_of("expressions are needed here", "write an expression, or a list of them", text=Text, pair=list[Text])
