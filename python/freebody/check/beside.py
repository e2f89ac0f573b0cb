"""A statement beside a true balance, term by term, at states where no balance holds; and a balance in the statement's letters."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import quote
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Mul, Negative, Node, Quotient, Sym, addends

from .coefficients import multiplied
from .language.statements import Equation, symbols_in
from .powers import powers_of, written

if TYPE_CHECKING:
    from .case import Case

_SAME = 1e-7  # relative: below it two terms are one
_LETTER = re.compile(r"(-)?(?:(rate|accel)\()?\(?([^\W\d][\w.]*)\)?\)?(?:([*/])([^\W\d]\w*))?")
_DOTS = {None: 0, "rate": 1, "accel": 2}
_READ = ("{}", "rate({})", "accel({})")

Term = tuple[Node, Array]
"""A term with its values."""


@dataclass(frozen=True)
class Difference:
    """What a balance has that a statement lacks, and what a statement has that is not in it, each in the statement's sense."""

    missing: tuple[Node, ...]
    strange: tuple[Node, ...]
    common: int

    @property
    def rank(self) -> tuple[bool, int, int]:
        """How much differs: first terms that a statement has and a balance has not."""
        return self.common == 0, len(self.strange) if self.common else 0, len(self.missing) if self.common else 0


def difference(said: Sequence[Term], true: Sequence[Term]) -> Difference:
    """How the terms of a statement differ from those of a balance, which may be written with any factor."""
    ratios = {
        (i, k): found for i, (_, s) in enumerate(said) for k, (_, t) in enumerate(true) if (found := ratio(s, t)) is not None
    }
    often = Counter(round(ratio, 6) for ratio in ratios.values())
    factor = max(often, key=lambda ratio: often[ratio], default=1.0)
    alone, rest = [], dict(enumerate(true))
    for i, (node, value) in enumerate(said):
        place = next((k for k in rest if (i, k) in ratios and abs(ratios[i, k] / factor - 1) < _SAME * 10), None)
        if place is None:
            alone.append((node, value))
        else:
            del rest[place]
    if alone and (lost := _lacking(said, true)) is not None:
        return lost
    common, shares = len(said) - len(alone), {}
    for i, (node, _) in enumerate(said if common else ()):  # a part of a term of the balance
        place = next((k for k in rest if 0 < ratios.get((i, k), 0) / factor < 1 and k not in shares), None)
        if place is not None and any(node is each for each, _ in alone):
            shares[place] = ratios[i, place]
            alone = [each for each in alone if each[0] is not node]
    missing = (multiplied(node, float(factor - shares.get(k, 0.0))) for k, (node, _) in rest.items())
    return Difference(tuple(node for node in missing if node is not None), tuple(n for n, _ in alone), common)


def _lacking(said: Sequence[Term], true: Sequence[Term]) -> Difference | None:
    """What is lacking where all terms together are made of those of the balance, as where a letter stands for a sum; else None."""
    rows, whole = np.array([value for _, value in true]).T, sum(value for _, value in said)
    if rows.ndim != 2 or len(rows) < rows.shape[1] or not np.isfinite(whole).all():  # not every root has a value
        return None
    shares, *_ = np.linalg.lstsq(rows, whole, rcond=_SAME)
    if np.abs(rows @ shares - whole).max() > _SAME * np.abs(rows).max():
        return None
    numbers = np.round(shares, 6)
    factor = max((n for n in numbers.tolist() if n), key=numbers.tolist().count, default=0.0)
    kept = np.isclose(numbers, factor)
    missing = [multiplied(node, float(factor - n)) for (node, _), n, same in zip(true, numbers, kept, strict=True) if not same]
    return None if None in missing else Difference(tuple(n for n in missing if n is not None), (), int(kept.sum()))


def ratio(one: Array, other: Array) -> float | None:
    """By which number a term is another times it."""
    with np.errstate(all="ignore"):
        found = one / other
    same = one.shape == other.shape and np.isfinite(found).all() and np.ptp(found) <= _SAME * np.abs(found).max()
    return float(np.median(found)) if same and found[0] else None


def said_terms(equation: Equation, values: Mapping[str, Array]) -> list[Term]:
    """The terms of a statement, all on one side and multiplied out."""
    found = [*addends(equation.left, expand=True), *((-sign, term) for sign, term in addends(equation.right, expand=True))]
    return [(signed(sign, node), sign * sampled(node, values)) for sign, node in found]


def signed(sign: float, node: Node) -> Node:
    """A term with its sign."""
    return node if sign > 0 else Negative(node)


class Letters:
    """The symbols of a model in those of a statement."""

    def __init__(self, case: Case, equation: Equation, table: Mapping[str, Mapping[str, Any]]) -> None:
        self._table = table
        self.samples = case.admissible_samples()
        said, known = [Sym(n.name) for n in symbols_in(equation)], case.meaning.symbols
        gauges = {gauge["name"]: gauge["value"] for gauge in case.sampler.spec["gauges"]}
        self._own: dict[Sym, Node] = {}
        for symbol in dict.fromkeys((*said, *map(Sym, known.of_kind("gauge")))):
            if symbol.key not in case.values():
                continue
            texts = [str(gauges.get(text, text)) for text in known.meanings[symbol.name].texts]
            found = _LETTER.fullmatch(texts[0]) if len(texts) == 1 else None
            if found and found[3] not in {n.name for n in said}:
                sign, word, name, operation, other = found.groups()
                for dots in range(_DOTS[word], 3):
                    own: Node = Sym(symbol.name, dots - _DOTS[word])
                    own = own if not other else Mul((Sym(other), own)) if operation == "/" else Quotient(own, Sym(other))
                    self._own.setdefault(Sym(name, dots), Negative(own) if sign else own)

    @property
    def are_others(self) -> bool:
        """Whether the statement has letters of its own."""
        return bool(self._own)

    def terms(self, left: Node, right: Node) -> Iterator[Term]:
        """The terms of a balance, all on one side and multiplied out, in the letters of the statement."""
        found = [*addends(left, expand=True), *((-sign, term) for sign, term in addends(right, expand=True))]
        names = {n for _, term in found for n in symbols_in(term)}
        texts = {n: _READ[n.dots].format(self._read(n.name)) for n in names}
        read = self.samples.values([*texts.values()])
        values = {n.key: read[text] for n, text in texts.items()}
        yield from ((self.written(term, sign), sign * sampled(term, values)) for sign, term in found)

    def _read(self, name: str) -> str:
        """How a symbol of a balance is read: a load by itself, a mass without a name by its value."""
        if name == "pi":
            return name
        entry = self._table[name]
        return {"unknown": name, "number": repr(entry["value"])}.get(entry["kind"]) or quote(name)

    def written(self, node: Node, sign: int = 1) -> Node:
        """A term as a person writes it."""
        number, powers = powers_of(node, self._own)
        return written(sign * number, powers)
