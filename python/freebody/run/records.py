"""What comes out of a run, as records; extremes and integrals on its dense output."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np

from freebody.core import Array, ReportItem, cards, quote
from freebody.solve.figures import figure
from freebody.symbolic.alphabet import GREEK
from freebody.symbolic.symbols import Name

Signal = Callable[[Array], Array]  # values (nt,) of one expression at times (nt,)

KINDS = ("coordinate", "rate", "acceleration", "reaction", "limit", "energy", "pose")
"""Of columns, in their order."""
ENTRIES = ("parameter changes", "impacts", "balance")
"""Entries of the ledger that no expression gives."""
_RARE = ("work of parameter changes", "work of impacts", "work of friction")


def plain(name: str) -> str:
    """The name with Greek letters as such: ``phi1`` → ``φ1``, ``arm.theta`` → ``arm.θ``."""
    return re.sub(r"[^\W\d_]+", lambda word: GREEK.get(word[0], word[0]), name)


@dataclass(frozen=True)
class Column:
    """One column of a run.

    ``name`` is an expression of the model language that gives the same values; ``unit`` is SI;
    ``kind`` is coordinate, rate, acceleration, reaction, limit (of contacts, strings, stops, locks and motions), energy or pose.
    The entries of the ledger that no expression gives go by their names.
    """

    name: str
    symbol: str
    unit: str
    kind: str


@dataclass(frozen=True)
class Energy:
    """The ledger in J over the times ``t`` (nt,): what is stored, what was put in, and what does not add up."""

    t: Array
    names: tuple[str, ...]
    values: Array

    def __getitem__(self, name: str) -> Array:
        return self.values[:, self.names.index(name)]

    @property
    def kinetic(self) -> Array:
        """Kinetic energy (nt,)."""
        return self["kinetic"]

    @property
    def potential(self) -> Array:
        """Potential energy (nt,) of gravity, springs and laws that have one."""
        return self["potential"]

    @property
    def balance(self) -> Array:
        """Kinetic + potential − works − their start value (nt,); 0 when the books close."""
        return self["balance"]

    @property
    def labels(self) -> dict[str, str]:
        """What is worth showing, by words: the names of what is stored and of every work; of changes of parameters, impacts and
        friction where there were any."""
        works = {f"work of {name.removesuffix('.work')}": name for name in self.works}
        shown = {label: name for label, name in works.items() if label not in _RARE or self[name].any()}
        return {"kinetic": "kinetic", "potential": "potential", **shown}

    @property
    def entries(self) -> dict[str, Array]:
        """The values (nt,) of ``labels``."""
        # + 0.0 turns -0 into 0.
        return {label: self[name] + 0.0 for label, name in self.labels.items()}

    @property
    def works(self) -> dict[str, Array]:
        """Work (nt,) since the start of every force and motion that has no potential."""
        return {name: self[name] for name in self.names if name not in ("kinetic", "potential", "balance")}


@dataclass(frozen=True)
class Reported:
    """A reported quantity: its figure in ``unit``, the time in s where that is one, and a note.

    ``value`` is None where there is no figure; then the note says why.
    """

    value: float | None
    unit: str
    t: float | None = None
    note: str = ""

    @classmethod
    def of(cls, item: ReportItem, value: float, t: float | None, si: str, note: str = "") -> Reported:
        """A value in SI as the item asks for it; ``si`` is its unit there."""
        return cls(value / unit_size(item.unit), item.unit or si, t, note)

    def __str__(self) -> str:
        stated = self.note if self.value is None else f"{figure(self.value, 10)} {self.unit}".rstrip()
        return f"{stated} (t = {figure(self.t)} s)" if self.t is not None else stated


def unit_size(unit: str) -> float:
    """What a unit is in SI; 1 without one."""
    if not unit:
        return 1.0
    from freebody.model.units import convert

    return convert(unit)[0]


@dataclass(frozen=True)
class Window:
    """A stretch of a run: the times where the motion may have kinks (edges of steps), first and last included."""

    edges: Array = field(repr=False)

    @classmethod
    def within(cls, edges: Array, over: tuple[float, float] | None) -> Window:
        """The edges between two times, which become the ends; all of them without a window."""
        if over is None:
            return cls(edges)
        start, end = over
        slack = 1e-9 * (edges[-1] - edges[0])
        if not edges[0] - slack <= start <= end <= edges[-1] + slack:
            raise ValueError(f"the window {start:g} s .. {end:g} s reaches outside the run, {edges[0]:g} s .. {edges[-1]:g} s")
        start, end = max(start, edges[0]), min(end, edges[-1])
        inside = edges[(edges > start) & (edges < end)]
        return cls(np.concatenate([[start], inside, [end]]))

    @property
    def length(self) -> float:
        """Duration in s."""
        return float(self.edges[-1] - self.edges[0])

    def samples(self, per_step: int = 8) -> Array:
        """Times evenly spread over every step."""
        fractions = np.arange(per_step) / per_step
        inner = self.edges[:-1, None] + np.diff(self.edges)[:, None] * fractions
        return np.append(inner.ravel(), self.edges[-1])


def maximum(signal: Signal, window: Window, candidates: int = 6) -> tuple[float, float]:
    """Time and value of the largest value in the window: the best samples, each refined."""
    t = window.samples()
    return refined(signal, t, signal(t), candidates)


def refined(signal: Signal, t: Array, y: Array, candidates: int = 6) -> tuple[float, float]:
    """Time and value of the largest value, from samples y (nt,) at times t (nt,): the best of them, each refined."""
    padded = np.concatenate([[-np.inf], y, [-np.inf]])
    peaks = np.flatnonzero((y >= padded[:-2]) & (y >= padded[2:]))
    best = peaks[np.argsort(y[peaks])[-candidates:]]
    found = [_zoom(signal, t[max(i - 1, 0)], t[min(i + 1, len(t) - 1)]) for i in best]
    return max(found, key=lambda pair: pair[1])


def minimum(signal: Signal, window: Window) -> tuple[float, float]:
    """Time and value of the smallest value in the window."""
    when, negative = maximum(lambda t: -signal(t), window)
    return when, -negative


def _zoom(signal: Signal, start: float, end: float) -> tuple[float, float]:
    """The largest value between two times, by narrowing a small grid about its best place; kinks do no harm."""
    # A smooth peak is flat to round-off within the square root of the machine's epsilon.
    least = 1e-9 * max(abs(start), abs(end))
    while True:
        t = np.linspace(start, end, 17)
        y = signal(t)
        i = int(np.argmax(y))
        if end - start <= least or np.ptp(y) <= 1e-15 * np.abs(y).max():
            return float(t[i]), float(y[i])
        start, end = t[max(i - 1, 0)], t[min(i + 1, 16)]


def integral(signal: Signal, window: Window, rtol: float = 1e-11) -> float:
    """The time integral over the window: adaptive Gauss–Kronrod (QUADPACK) on every step, since the signal is smooth within one."""
    from scipy.integrate import quad

    least = rtol * float(np.abs(signal(window.samples(2))).mean())

    def value(t: float) -> float:
        return float(signal(np.array([t]))[0])

    # With full_output it gives what it has instead of a warning where a kink within a step costs it the last digits.
    steps = pairwise(window.edges.tolist())
    return sum(quad(value, a, b, epsabs=least * (b - a), epsrel=rtol, limit=30, full_output=True)[0] for a, b in steps)


def reduce(how: str, signal: Signal, window: Window) -> tuple[float | None, float]:
    """Time (None where it is not one) and value of an extreme, mean, rms or integral over a window."""
    if how in ("max", "min"):
        return (maximum if how == "max" else minimum)(signal, window)
    if how in ("integral", "mean"):
        return None, integral(signal, window) / (1.0 if how == "integral" else window.length)
    if how == "rms":
        return None, float(np.sqrt(integral(lambda t: signal(t) ** 2, window) / window.length))
    raise ValueError(f"no such reduction: {how!r}; there are max, min, mean, rms, integral")


def columns_of(metadata: Mapping[str, Any], ledger: Sequence[str]) -> list[Column]:
    """All columns, kind by kind, in the order of the core's arrays; ``ledger`` names the entries of the energy ledger."""
    made: list[Column] = []

    def add(kind: str, text: str, sign: Name, unit: str, dots: int = 0) -> None:
        made.append(Column(text, sign.latex(dots), unit, kind))

    rates = (("coordinate", "{}", ""), ("rate", "rate({})", "/s"), ("acceleration", "accel({})", "/s^2"))
    for dots, (kind, text, per) in enumerate(rates):
        for each in metadata["coordinates"]:
            add(kind, text.format(quote(each["name"])), Name.parse(each["name"]), each["dimension"] + per, dots)
    for joint in (each["name"] for each in metadata["joints"]):
        add("reaction", f"{quote(joint)}.Fx", Name(joint, ("x",)), "N")
        add("reaction", f"{quote(joint)}.Fy", Name(joint, ("y",)), "N")
        add("reaction", f"{quote(joint)}.M", Name("M", (joint,)), "N*m")
    for limit in metadata["limits"]:
        name, length = limit["name"], limit["dimension"]
        for word in {"contact": ("N", "T"), "string": ("tension",), "stop": ("N",)}[limit["type"]]:
            add("limit", f"{quote(name)}.{word}", Name(word[0].upper(), (name,)), {"m": "N", "rad": "N*m"}.get(length, ""))
        add("limit", f"{quote(name)}.gap", Name("g", (name,)), length)
    for lock in metadata["locks"]:
        add("limit", f"{quote(lock['name'])}.force", Name("F", (lock["name"],)), "N*m" if lock["turns"] else "N")
    for motion in metadata["motions"]:
        unit = motion["readings"]["force"]
        add("limit", f"{quote(motion['name'])}.force", Name("M" if unit == "N*m" else "F", (motion["name"],)), unit)
    own = {"kinetic": ("kinetic()", Name("T")), "potential": ("potential()", Name("V"))} | {
        each: (each, Name(each)) for each in ENTRIES
    }
    own |= {"friction": ("friction_work()", Name("W", ("friction",)))}
    for entry in ledger:
        of = entry.removesuffix(".work")
        add("energy", *own.get(entry, (f"{quote(of)}.work", Name("W", (of,)))), "J")
    for body in (each["name"] for each in metadata["bodies"]):
        for text, stem, unit in (("x({}.origin)", "x", "m"), ("y({}.origin)", "y", "m"), ("angle({})", "phi", "rad")):
            add("pose", text.format(quote(body)), Name(stem, (body,)), unit)
    return made


def unit_of(text: str, columns: Sequence[Column], metadata: Mapping[str, Any]) -> str:
    """The SI unit of a simple expression (a column, one call, one reading of a part); empty where it takes more to tell."""
    text = text.strip()
    for column in columns:
        if column.name == text:
            return column.unit
    if text == "t":
        return "s"
    if call := re.fullmatch(r"(\w+)\([^()]*\)", text):
        function = cards.functions().get(call[1])
        return function.unit if function else ""
    owner, dot, word = text.rpartition(".")
    parts = (part for section in ("joints", "forces", "motions", "locks", "limits") for part in metadata[section] if dot)
    return next((part["readings"].get(word) or "" for part in parts if quote(part["name"]) == owner), "")
