"""``Mechanism``: the builder with one method for each shape, joint and force, made from the cards of the core."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any

from freebody.analysis import Moving
from freebody.core import cards

from . import elements, schema
from .builder import Builder
from .handles import Body, Element
from .scope import coordinate_names


class Mechanism(Moving, Builder):
    """A mechanism under construction; see ``Builder``. Each shape, joint and force is a method: ``rod``, ``hinge`` …;
    ``Moving`` solves, simulates and draws it."""


_KEYWORD = inspect.Parameter.KEYWORD_ONLY
_PYTHON = {"from": "from_", "is": "is_", "in": "in_", "with": "with_", "as": "as_"}


def _keyword(name: str, required: bool) -> inspect.Parameter:
    return inspect.Parameter(_PYTHON.get(name, name), _KEYWORD, default=inspect.Parameter.empty if required else None)


def _shape_method(shape: str, sizes: tuple[str, ...]) -> Callable[..., Body]:
    def method(self: Builder, name: str, **words: Any) -> Body:
        return self.body(name, shape=shape, **words)

    common = ("mass", "inertia", "centre", "point_masses", "points", "lines", "curves", "outline")
    taken = common if shape != "particle" else tuple(w for w in common if w not in ("inertia", "centre"))
    parameters = [_keyword(s, True) for s in sizes] + [_keyword(w, w == "mass") for w in taken]
    article = "A uniform" if sizes else "A"
    described = "\n".join(f"    {s}: {schema.Shaped.model_fields[s].description}" for s in (*sizes, "mass"))
    return _dressed(method, shape, f"{article} {shape}.\n\n{described}", [_positional("name"), *parameters], Body)


def _positional(name: str) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD)


def _element_method(section: str, card: cards.Card) -> Callable[..., Element]:
    several = [f.name for f in card.fields if f.kind == "points" and f.required][:1]
    back = {_PYTHON[f.name]: f.name for f in card.fields if f.name in _PYTHON}

    def method(self: Builder, *points: Any, name: str = "", **words: Any) -> Element:
        if points and not several:
            raise TypeError(f"{card.type}() takes keywords only: {', '.join(f.name for f in card.fields)}")
        given = {back.get(key, key): value for key, value in words.items() if value is not None}
        given |= {several[0]: list(points)} if points else {}
        name = name or _free_name(card.type, getattr(self.model, section))
        self.put(section, name, {"type": card.type} | given)
        made = getattr(self.model, section)[name]
        return Element(name, [c for c, _ in coordinate_names(name, made)] if section == "joints" else [])

    fields = [_keyword(f.name, f.required) for f in card.fields if f.name not in several]
    own = {"type", *(f.name for f in card.fields)}
    more = [_keyword(word, False) for word in elements.of(section)[card.type].model_fields if word not in own]
    points = [inspect.Parameter(several[0], inspect.Parameter.VAR_POSITIONAL)] if several else []
    doc = "\n".join(f"    {_PYTHON.get(f.name, f.name)}: {f.doc}{f' ({f.unit})' if f.unit else ''}" for f in card.fields)
    return _dressed(method, card.type, f"{card.doc}\n\n{doc}", [*points, _keyword("name", False), *fields, *more], Element)


def _free_name(word: str, taken: Mapping[str, Any]) -> str:
    name, i = word, 1
    while name in taken:
        i += 1
        name = f"{word}{i}"
    return name


def _dressed(method: Any, name: str, doc: str, parameters: list[inspect.Parameter], answer: Any) -> Any:
    method.__name__, method.__qualname__, method.__doc__ = name, f"Mechanism.{name}", doc
    first = inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    method.__signature__ = inspect.Signature([first, *parameters], return_annotation=answer)
    return method


def _methods() -> dict[str, Any]:
    shapes = {shape: _shape_method(shape, sizes) for shape, sizes in schema.SHAPES.items() if shape != "general"}
    joints = {word: _element_method("joints", card) for word, card in cards.joints().items()}
    forces = {word: _element_method("forces", card) for word, card in cards.forces().items()}
    return shapes | joints | forces


for _word, _method in _methods().items():
    setattr(Mechanism, _word, _method)
