"""``Mechanism``: the builder with one method for each shape, joint and force, made from the cards of the core."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from itertools import count
from typing import Any

import freebody.views.figures  # noqa: F401, registers how the figures of derivations are drawn
from freebody.analysis import Analysis
from freebody.core import cards
from freebody.model import elements, schema
from freebody.model.builder import Builder
from freebody.model.handles import Body, Element
from freebody.model.scope import coordinate_names
from freebody.moving import Moving


class Mechanism(Moving, Analysis, Builder):
    """A mechanism under construction; see ``Builder``. Each shape, joint and force is a method: ``rod``, ``hinge`` …;
    ``Moving`` solves, simulates and draws it, ``Analysis`` derives its equations and finds what is asked of its motions."""

    def __dir__(self) -> list[str]:
        """What a user asks for; not what the parts of the package ask of each other."""
        return [name for name in super().__dir__() if not name.startswith("_") and name not in _WITHIN]


_WITHIN = {
    "core_errors", "handed", "initial_state", "lowered", "mark", "moment", "noted", "opening", "others", "put", "report_items",
    "run_numbers", "run_plan", "run_settings", "source", "validated", "wrong",
}  # fmt: skip

_POSITIONAL, _KEYWORD = inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY
_PYTHON = {"from": "from_", "is": "is_", "in": "in_", "with": "with_", "as": "as_"}


def _keyword(name: str, required: bool) -> inspect.Parameter:
    return inspect.Parameter(_PYTHON.get(name, name), _KEYWORD, default=inspect.Parameter.empty if required else None)


def _shape_method(shape: str, sizes: tuple[str, ...]) -> Callable[..., Body]:
    def method(self: Builder, name: str, **words: Any) -> Body:
        return self.body(name, shape=shape, **words)

    common = ("mass", "inertia", "centre", "point_masses", "points", "lines", "curves", "outline", "look")
    taken = common if shape != "particle" else tuple(w for w in common if w not in ("inertia", "centre"))
    parameters = [_keyword(s, True) for s in sizes] + [_keyword(w, w == "mass") for w in taken]
    article = "A uniform" if sizes else "A"
    described = "\n".join(f"    {s}: {schema.Shaped.model_fields[s].description}" for s in (*sizes, "mass"))
    return _dressed(
        method, shape, f"{article} {shape}.\n\n{described}", [inspect.Parameter("name", _POSITIONAL), *parameters], Body
    )


def _element_method(section: str, card: cards.Card) -> Callable[..., Element]:
    several = [f.name for f in card.fields if f.kind == "points" and f.required][:1]
    back = {_PYTHON[f.name]: f.name for f in card.fields if f.name in _PYTHON}

    def method(self: Builder, *points: Any, name: str = "", **words: Any) -> Element:
        if points and not several:
            raise TypeError(f"{card.type}() takes keywords only: {', '.join(f.name for f in card.fields)}")
        given = {back.get(key, key): value for key, value in words.items() if value is not None}
        given |= {several[0]: list(points)} if points else {}
        taken = getattr(self.model, section)
        name = name or next(free for i in count(1) if (free := f"{card.type}{i if i > 1 else ''}") not in taken)
        self.put(section, name, {"type": card.type} | given)
        made = getattr(self.model, section)[name]
        return Element(name, [c for c, _ in coordinate_names(name, made)] if section == "joints" else [])

    fields = [_keyword(f.name, f.required) for f in card.fields if f.name not in several]
    own = {"type", *(f.name for f in card.fields)}
    types = {"joints": elements.JOINTS, "forces": elements.FORCES}[section]
    more = [_keyword(word, False) for word in types[card.type].model_fields if word not in own]
    points = [inspect.Parameter(several[0], inspect.Parameter.VAR_POSITIONAL)] if several else []
    doc = "\n".join(f"    {_PYTHON.get(f.name, f.name)}: {f.doc}{f' ({f.unit})' if f.unit else ''}" for f in card.fields)
    return _dressed(method, card.type, f"{card.doc}\n\n{doc}", [*points, _keyword("name", False), *fields, *more], Element)


def _dressed(method: Any, name: str, doc: str, parameters: list[inspect.Parameter], answer: Any) -> Any:
    method.__name__, method.__qualname__, method.__doc__ = name, f"Mechanism.{name}", doc
    method.__signature__ = inspect.Signature([inspect.Parameter("self", _POSITIONAL), *parameters], return_annotation=answer)
    return method


for _word, _sizes in schema.SHAPES.items():
    if _word != "general":
        setattr(Mechanism, _word, _shape_method(_word, _sizes))
for _section, _cards in (("joints", cards.joints()), ("forces", cards.forces())):
    for _word, _card in _cards.items():
        setattr(Mechanism, _word, _element_method(_section, _card))
