"""What comes out of a run, as records; extremes and integrals on its dense output."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev

from freebody.core import EXTREMES, Array, CompiledModel, ReportItem, cards, quote
from freebody.model.errors import ModelProblem
from freebody.model.syntax import dimension
from freebody.model.units import unit as unit_named
from freebody.solve.figures import figure
from freebody.symbolic.alphabet import GREEK
from freebody.symbolic.dimensions import Dimension
from freebody.symbolic.symbols import Name

Signal = Callable[[Array], Array]  # values (nt,) of one expression at times (nt,)

KINDS = ("coordinate", "rate", "acceleration", "dependent", "reaction", "limit", "energy", "pose")
"""Of columns, in their order."""
_DEGREE = 16
"""Of the polynomial that follows a signal between two samples: three of them or more are in a step, which one of degree 8 follows."""
_FOLLOWED = 1e-9
"""Part of its swing that the last coefficients of a polynomial may have which follows a signal."""
_LEVEL = 1e-13
"""Part of the size of a signal that is round-off."""
_CONVERGED = 1e-3
"""Part of an integral that its error may be: at a kink less is left, over a pole all."""
_MANY = 1600  # times at which a quantity is looked at in search of its largest value, in which steps follow it closely
_UNEVEN = 0.38196601125010515
"""Part of a step at which it is cut to integrate it again: no halving comes to it."""
_RARE = ("work of parameter changes", "work of impacts", "work of friction")


def plain(name: str) -> str:
    """The name with Greek letters as such: ``phi1`` → ``φ1``, ``arm.theta`` → ``arm.θ``."""
    return re.sub(r"[^\W\d_]+", lambda word: GREEK.get(word[0], word[0]), name)


@dataclass(frozen=True)
class Column:
    """One column of a run.

    ``name`` is an expression of the model language that gives the same values; ``unit`` is SI;
    ``kind`` is coordinate, rate, acceleration, dependent (of coordinates that the model names and that follow from the others: places,
    then rates, then accelerations), reaction, limit (of contacts, strings, stops, locks and motions), energy or pose.
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
        works = {f"work of {name}": name for name in self.works}
        shown = {label: name for label, name in works.items() if label not in _RARE or self[name].any()}
        return {"kinetic": "kinetic", "potential": "potential", **shown}

    @property
    def entries(self) -> dict[str, Array]:
        """The values (nt,) of ``labels``."""
        # + 0.0 turns -0 into 0.
        return {label: self[name] + 0.0 for label, name in self.labels.items()}

    @property
    def works(self) -> dict[str, Array]:
        """Work (nt,) since the start of every force and motion that no potential accounts for: of a spring, that of its damper."""
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


def over_time(unit: str) -> str:
    """The SI unit of the time integral of what has a unit; empty where that is not known."""
    return unit.removesuffix("/s") if unit.endswith("/s") else f"{unit}*s" if unit else ""


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

    @property
    def amid(self) -> Array:
        """A time within every step, where no halving comes to."""
        return self.edges[:-1] + _UNEVEN * np.diff(self.edges)

    def samples(self, least: int = 8) -> Array:
        """Times evenly spread over every step: eight in each, of very many steps not so many, but at least ``least``."""
        per_step = int(np.clip(_MANY // len(self.edges), least, 8))
        fractions = np.arange(per_step) / per_step
        inner = self.edges[:-1, None] + np.diff(self.edges)[:, None] * fractions
        return np.append(inner.ravel(), self.edges[-1])


def maximum(signal: Signal, window: Window, candidates: int = 6, rate: Signal | None = None) -> tuple[float, float]:
    """Time and value of the largest value in the window: the best samples, each refined; by the ``rate`` of the signal, if given."""
    t = window.samples(least=3)
    return refined(signal, t, signal(t), candidates, rate)


def refined(signal: Signal, t: Array, y: Array, candidates: int = 6, rate: Signal | None = None) -> tuple[float, float]:
    """Time and value of the largest value, from samples y (nt,) at times t (nt,): the best of them, each refined."""
    padded = np.concatenate([[-np.inf], y, [-np.inf]])
    peaks = np.flatnonzero((y >= padded[:-2]) & (y >= padded[2:]))
    best = peaks[np.argsort(y[peaks])[-candidates:]]
    return max((_peak(signal, t, i, rate) for i in best), key=lambda pair: pair[1])


def maxima(signal: Signal, window: Window, rate: Signal | None = None) -> list[tuple[float, float]]:
    """Times and values of all local maxima within the window, in order; its ends are none. What rises or falls by less than
    round-off is level."""
    t = window.samples()
    y = signal(t)
    level = _LEVEL * float(np.abs(y).max())
    found, best, rises = [], 0, False
    for i, value in enumerate(y.tolist()):
        if rises and value < y[best] - level:
            found.append(_peak(signal, t, best, rate))
        if (value < y[best] - level) if rises else (value > y[best] + level):
            best, rises = i, not rises
        elif (value > y[best]) if rises else (value < y[best]):
            best = i
    return found


def _peak(signal: Signal, t: Array, i: int, rate: Signal | None) -> tuple[float, float]:
    """The largest value beside sample ``i``: of each side by itself, for steps end at samples."""
    sides = [(a, b) for a, b in pairwise(t[max(i - 1, 0) : i + 2].tolist()) if a < b]
    here = float(t[i]), float(signal(t[i : i + 1])[0])
    return max((here, *(_largest(signal, *side, rate) for side in sides)), key=lambda pair: pair[1])


def _largest(signal: Signal, start: float, end: float, rate: Signal | None) -> tuple[float, float]:
    """The largest value between two times: at a root of the derivative, or at an end, where it may jump. What no polynomial
    follows has a kink there: then by narrowing a small grid about the best place."""
    followed = Chebyshev.interpolate(rate or signal, _DEGREE, [start, end])
    sizes = np.abs(followed.coef)
    if sizes[-2:].max() <= _FOLLOWED * sizes[1:].sum() + _LEVEL * sizes[0]:
        roots = (followed if rate else followed.deriv()).roots()
        inside = [float(root.real) for root in roots if abs(root.imag) <= _FOLLOWED * (end - start) and start < root.real < end]
        t = np.array([start, *inside, np.nextafter(end, start), end])
        y = signal(t)
        return float(t[y.argmax()]), float(y.max())
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
    """The time integral over the window: adaptive Gauss–Kronrod (QUADPACK) on every step, since the signal is smooth within one; NaN
    where it does not converge, or not to the same from other parts of a step."""
    from scipy.integrate import quad

    least = rtol * float(np.abs(signal(window.amid)).mean())  # at an edge the signal may be singular
    if not math.isfinite(least):
        return math.nan

    def value(t: float) -> float:
        return float(signal(np.array([t]))[0])

    def over(a: float, b: float) -> tuple[float, float]:
        # With full_output it gives what it has instead of a warning where a kink within a step costs it the last digits.
        found, error, report, *_ = quad(value, a, b, epsabs=least * (b - a), epsrel=rtol, limit=30, full_output=True)
        if report["last"] == 1:
            return found, error
        # Extrapolation from halves makes a number of a pole that they come to.
        if _is_pole(value, a, b - a) or _is_pole(value, b, a - b):
            return found, math.inf
        amid = a + _UNEVEN * (b - a)
        again = quad(value, a, b, epsabs=least * (b - a), epsrel=rtol, limit=100, points=[amid], full_output=True)[0]
        apart = abs(again - found)
        return found, error if apart <= _CONVERGED * abs(found) + least * (b - a) else math.inf

    values, errors = np.array([over(a, b) for a, b in pairwise(window.edges.tolist())]).T
    return float(values.sum()) if errors.sum() <= _CONVERGED * np.abs(values).sum() + least * window.length else math.nan


def _is_pole(value: Callable[[float], float], end: float, length: float) -> bool:
    """Whether the integral diverges at an end of a step: what is within a distance of it does not vanish with that."""
    far, near = (abs(value(end + part * length)) * part for part in (2.0**-12, 2.0**-24))
    return near > far / 2 > 0


def reduce(how: str, signal: Signal, window: Window, rate: Signal | None = None) -> list[tuple[float | None, float]]:
    """Time (None where it is not one) and value of an extreme, mean, rms or integral over a window; of all local maxima or minima.
    ``rate`` is the time derivative of the signal, if there is one."""
    if how in ("min", "minima"):
        falling = rate and (lambda t: -rate(t))
        return [(t, -y) for t, y in reduce(how.replace("min", "max"), lambda t: -signal(t), window, falling)]
    if how == "max":
        return [maximum(signal, window, rate=rate)]
    if how == "maxima":
        return [*maxima(signal, window, rate)]
    if how == "integral":
        return [(None, integral(signal, window))]
    if how == "mean":
        return [(None, integral(signal, window) / window.length)]
    if how == "rms":
        return [(None, float(np.sqrt(integral(lambda t: signal(t) ** 2, window) / window.length)))]
    raise ValueError(f"no such reduction: {how!r}; there are {', '.join(EXTREMES)}")


def expression_of_entry(entry: str, metadata: Mapping[str, Any]) -> str:
    """The expression that gives an entry of the energy ledger; empty where none does."""
    works = {part["name"]: f"{quote(part['name'])}.work" for section in ("forces", "motions") for part in metadata[section]}
    return (works | {"kinetic": "kinetic()", "potential": "potential()", "friction": "friction_work()"}).get(entry, "")


def columns_of(source: CompiledModel, ledger: Sequence[str]) -> list[Column]:
    """All columns, kind by kind, in the order of the core's arrays; ``ledger`` names the entries of the energy ledger."""
    made, metadata = list[Column](), source.metadata

    def add(kind: str, text: str, sign: Name, unit: str, dots: int = 0) -> None:
        made.append(Column(text, sign.latex(dots), unit, kind))

    rates = (("coordinate", "{}", ""), ("rate", "rate({})", "/s"), ("acceleration", "accel({})", "/s^2"))
    following = [("dependent", text, per) for _, text, per in rates]
    for coordinates, forms in ((metadata["coordinates"], rates), (source.dependent_coordinates, following)):
        for dots, (kind, text, per) in enumerate(forms):
            for each in coordinates:
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
    signs = {"kinetic": Name("T"), "potential": Name("V")}
    for entry in ledger:
        text = expression_of_entry(entry, metadata)
        add("energy", text or entry, signs.get(entry, Name("W", (entry,)) if text else Name(entry)), "J")
    for body in (each["name"] for each in metadata["bodies"]):
        for text, stem, unit in (("x({}.origin)", "x", "m"), ("y({}.origin)", "y", "m"), ("angle({})", "phi", "rad")):
            add("pose", text.format(quote(body)), Name(stem, (body,)), unit)
    return made


def unit_of(text: str, columns: Sequence[Column], metadata: Mapping[str, Any]) -> str:
    """The SI unit of an expression; empty for a plain number, and where bare numbers in it leave the unit open."""
    text = text.strip()
    if (unit := _stated_unit(text, columns, metadata)) is not None:
        return unit
    if call := re.fullmatch(r"(\w+)\([^()]*\)", text):
        function = cards.functions().get(call[1])
        if function:
            return function.unit

    def lookup(name: str) -> Dimension | None:
        unit = _stated_unit(name, columns, metadata)
        return None if unit is None else unit_named(unit).dimension

    try:
        found = dimension(text, lookup)
    except ModelProblem:
        return ""
    return found.unit() if found else ""


def _stated_unit(name: str, columns: Sequence[Column], metadata: Mapping[str, Any]) -> str | None:
    """The unit of a column, a parameter, the time or one reading of a part; None for anything else."""
    known = {column.name: column.unit for column in columns} | {each["name"]: each["unit"] for each in metadata["parameters"]}
    if name in known or name == "t":
        return known.get(name, "s")
    owner, dot, word = name.rpartition(".")
    parts = (part for section in ("joints", "forces", "motions", "locks", "limits") for part in metadata[section] if dot)
    return next((part["readings"].get(word) for part in parts if quote(part["name"]) == owner), None)
