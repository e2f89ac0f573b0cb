"""What generated functions cannot hold: their formulas are those of one state, so nothing may switch between formulas."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from freebody.core import CompiledModel, FreeBodies, cards
from freebody.model import syntax
from freebody.model.errors import ModelProblem
from freebody.symbolic.tree import Fn, walk

_SWITCHES = frozenset(["abs", "sign", "step", "min", "max", "clamp", "mod", "if"])
_COMPARED = frozenset(["<", "<=", ">", ">=", "==", "!=", "and", "or", "not"])
_LIMITS = {"contacts": "opens and closes", "strings": "goes slack", "stops": "opens and closes"}
_LAWS = ("forces", "motions", "joints", "gauges")


class CannotGenerate(ValueError):
    """A mechanism of which no functions can be generated; says why, and what to try."""


def check(source: CompiledModel, free: FreeBodies) -> None:
    """Raises ``CannotGenerate`` for what switches or has no symbols, and where reactions are not determined."""
    spec = source.spec
    if not source.metadata["coordinates"]:
        raise CannotGenerate("the mechanism has no coordinates, so there is nothing to generate; solve() gives its reactions")
    for section, what in _LIMITS.items():
        for item in spec[section]:
            raise CannotGenerate(
                f"{section}.{item['name']} {what}, and one formula holds in one of its states only; "
                "leave it out, or put a joint that holds it closed (a hinge, a slot, a link) in its place"
            )
    here = {**spec, **{section: [item for item in spec[section] if item.get("engaged", True)] for section in _LAWS}}
    for joint in here["joints"]:
        if joint.get("friction") not in (None, 0, 0.0):
            raise CannotGenerate(f"joints.{joint['name']} has friction, which sticks or slides; leave `friction` out")
        if any(row.flank for row in cards.joints()[joint["type"]].rows):
            raise CannotGenerate(f"joints.{joint['name']} pushes with one flank or the other; a coupling has one formula")
    _check_laws(here)
    lost = [load.symbol for load in free.loads if load.unknown and not load.determinate]
    if lost:
        raise CannotGenerate(
            f"the balances do not determine {', '.join(lost)} at this state: the joints hold more than they need to; "
            "release one of them, or start elsewhere"
        )


def _check_laws(spec: Mapping[str, Any]) -> None:
    tables = {table["name"] for table in spec["tables"]}
    for section in _LAWS:
        for item in spec[section]:
            for text in _texts(item):
                used = _words(text)
                if found := sorted(used & tables):
                    what, hint = f"is given by the table {found[0]!r}", "a formula in its place can be generated"
                elif found := sorted(used & (_SWITCHES | _COMPARED)):
                    what, hint = f"switches between formulas ({found[0]})", "a smooth law, like tanh in place of sign, does not"
                else:
                    continue
                raise CannotGenerate(f"{section}.{item['name']}: {text!r} {what}; {hint}")


def _texts(item: Any) -> Iterator[str]:
    if isinstance(item, str):
        yield item
    elif isinstance(item, Mapping):
        for key, value in item.items():
            if key not in ("name", "type", "of", "on", "from", "between", "level", "by"):
                yield from _texts(value)
    elif isinstance(item, list):
        for value in item:
            yield from _texts(value)


def _words(text: str) -> set[str]:
    """Names of functions, and operators that compare, in an expression; nothing where the text is none (the name of a point)."""
    try:
        return {node.name for node in walk(syntax.parse(text).tree) if isinstance(node, Fn)}
    except ModelProblem:
        return set()
