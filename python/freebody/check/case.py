"""A statement beside the motions that decide about it: its symbols on true states, and what else could stand there."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field
from functools import cached_property
from time import thread_time

import numpy as np

from freebody.core import ModelError, MotionError
from freebody.model.errors import ModelProblem
from freebody.run.moments import Unreached
from freebody.symbolic.dimensions import ANGLE, NUMBER_ONLY, Known
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Fn, Sym, addends, walk

from .asked_model import WORD
from .budget import Budget
from .families import ALL, Family, NoMotion, Samples
from .language.dimensions import misfit
from .language.statements import Equation, Program, inlined, symbols_in
from .motion_sampler import SAMPLES, MotionSampler
from .residual import Residual, residual
from .symbols import Symbols
from .user_symbols import AMPLITUDE, LARGEST, LEAST, MOMENT, WORK, Meaning
from .vocabulary import Vocabulary

_FORCES = "Fx|Fy|M|F|Fs|Fn|F1|F2|tension|N|T"
_ENERGY = re.compile(r"(?:kinetic|potential|energy)\(")
_BEYOND = re.compile(
    r"\b(rate|accel|vx|vy|speed|curvature|omega|ax|ay|alpha|tension|kinetic|potential|energy|momentum_[xy]|angular_momentum|friction_work|centre_[xy])\("
    rf"|\.({_FORCES}|friction|force|value|power|work)\b"
)
"""What reads more than the configuration."""
_SOLVED = re.compile(rf"\b(accel|ax|ay|alpha|tension)\(|\.({_FORCES})\b")
"""What reads an acceleration or an unknown force."""
_UNIFORM = re.compile(r"[^\W\d]\w*\s*\*\s*t|t\s*\*\s*[^\W\d]\w*")
"""The law of what moves uniformly, which has a letter for its rate."""
_TENSION = re.compile(r"\btension\(([^()]*)\)")
_BRACKETS = re.compile(r"^\(((?:[\w.\[\]]|'[^']+')+)\)$")
_ADMISSIBLE = 24  # states at which no balance holds
_KINEMATIC = 1e-8  # what is left there of an equation that is none
_ROUND_OFF = 1e-11  # of what is typical of a dimension
_FEWER = 16  # states, where each takes long
_OF_MOMENTS = 32  # states, where for each a motion is followed
_EXTREME = re.compile(rf"⟦(?:{LARGEST}|{LEAST}): |{AMPLITUDE}")
_MANY = 12  # reactions, beyond which only those of the statement are thought of


class StatementSymbols:
    """What the symbols of a program mean in a model. Raises ``StatementError`` at a symbol without a meaning."""

    def __init__(self, symbols: Symbols, program: Program, sampler: MotionSampler, of_instant: bool = False) -> None:
        self.symbols, self.program, self.sampler, self.figures = symbols, program, sampler, False
        self._of_instant = of_instant
        self.required = symbols.require(program)
        self.used = list(dict.fromkeys(Sym(n.name) for n in self.required))

    def texts(self, symbol: Sym) -> tuple[str, ...]:
        """The expressions of the model language that a symbol stands for."""
        return self._one(symbol).texts if symbol.name in self.symbols.meanings else ()

    def read_from(self, symbol: Sym) -> str:
        """The expression from which a number is read, with its dots."""
        (text,) = self._one(symbol).needed(symbol.dots)
        return text

    def values(self, samples: Samples) -> Mapping[str, Array]:
        """The value of every symbol on true states, by ``Sym.key``; what is 0 but for round-off is 0."""
        found = self.symbols.values(self._valued, samples)
        for n in self._valued:
            one = self._one(n)
            if one.kind not in ("parameter", "gravity") or one.texts[0] not in self.sampler.free_parameters:
                size = self.sampler.unit(one.dimension) * self.sampler.rate**n.dots
                left = _ROUND_OFF**2 if one.texts[0].startswith("kinetic(") else _ROUND_OFF  # of squares of rates
                found[n.key] = found[n.key] * (np.abs(found[n.key]) >= left * size)
        return found

    def fits(self, equation: Equation) -> bool:
        """Whether its terms have one dimension, as far as that is known."""
        return misfit(Program((equation,)), self.symbols.dimensions, figures=self.figures) is None

    def in_figures(self) -> StatementSymbols:
        """The same where figures stand for measures in SI units, so that they fit any dimension."""
        other = copy(self)
        other.figures = True
        return other

    def of_start(self) -> StatementSymbols:
        """The same of motions from the start, of which its numbers may be spoken, too."""
        other = StatementSymbols(self.symbols, self.program, self.sampler, of_instant=True)
        other.figures = self.figures
        return other

    def solved(self, symbol: Sym) -> bool:
        """Whether it is what the equations of an instant are solved for: an acceleration or an unknown force."""
        one = self.symbols.meanings.get(symbol.name)
        return one is not None and (one.kind == "reaction" or any(_SOLVED.search(text) for text in one.needed(symbol.dots)))

    def is_answer(self, symbol: Sym) -> bool:
        """Whether a figure may be the answer to what it is: an acceleration, a force, what a vibration has or is largest."""
        return self.solved(symbol) or self._one(symbol).kind in ("vibration", "initial")

    def limit(self, symbol: Sym) -> str | None:
        """The contact, string or stop of which a symbol reads something."""
        owners = (text.rpartition(".")[0] for text in self.texts(symbol))
        return next((name for name in owners if self.symbols.named.owners.get(name) in ("contact", "string", "stop")), None)

    @property
    def needs_past(self) -> bool:
        """Whether it reads works, or where a motion started, which a state has only as one of a motion from the start."""
        read = [self._one(n) for n in self.required]
        return self.sums_up or any(one.kind in ("initial", "integral") for one in read)

    @property
    def sums_up(self) -> bool:
        """Whether it reads works, which are done from the model's start on."""
        return any(map(WORK.search, (text for n in self.required for text in self._one(n).texts)))

    @property
    def names_moments(self) -> bool:
        """Whether it reads what something is at moments of the motion from the start, which may be before the moment of the model."""
        return any(MOMENT in text for n in self.required for text in self._one(n).texts)

    @property
    def takes_long(self) -> bool:
        """Whether it reads what takes long to find: what is largest or least on a motion, or of a vibration."""
        return any(self._one(n).kind == "vibration" for n in self.required) or any(
            _EXTREME.search(text) for n in self.required for text in self._one(n).texts
        )

    def speaks_of_start(self, equation: Equation) -> bool:
        """Whether it names the time or what the model has at its start alone, so that it is of motions from there."""
        said = [text for n in symbols_in(equation) for text in self.texts(Sym(n.name))]
        words = {word for text in said for word in WORD.findall(text)}
        derived = {name for name in self.sampler.derived_start if not _named(name, self.mechanics)}
        return "t" in said or not words.isdisjoint(derived.union(self.of_start_alone))

    @cached_property
    def of_start_alone(self) -> list[str]:
        """Free parameters that say where and how fast the model starts, and nothing else."""
        free, gravities, said = self.sampler.free_parameters, self.sampler.gravities, self.sampler.in_initial_or_events
        return [name for name in free if name in said and name not in gravities and not _named(name, self.mechanics)]

    def names(self) -> Mapping[str, tuple[str, ...]]:
        """What each symbol with a value stands for, by ``Sym.key``: symbols that only name one quantity twice agree in it."""
        return {n.key: _meant(self._one(n).needed(n.dots)) for n in self._valued}

    def given(self) -> frozenset[str]:
        """Symbols made of parameters alone, by ``Sym.key``: random on true states, and bound by what the model defines."""
        return frozenset(n.key for n in self._valued if not n.dots and self._is_fixed(n))

    @cached_property
    def _valued(self) -> list[Sym]:
        """The symbols of the statement and of the vocabulary, with their rates."""
        known = self.vocabulary
        dotted = [Sym(n.name, dots) for n in known.coordinates for dots in range(3)]
        changing = [n for n in (Sym(n.name, 1) for n in known.others) if known.is_load(n) and self._has_rate(n)]
        return list(dict.fromkeys([*self.required, *known.parameters, *dotted, *known.others, *changing, *known.vectors]))

    def _has_rate(self, symbol: Sym) -> bool:
        """Whether the model has what a symbol stands for, with its dots."""
        try:
            return bool(self._one(symbol).needed(symbol.dots))
        except ModelProblem:
            return False

    @cached_property
    def vocabulary(self) -> Vocabulary:
        """The symbols that a true equation may be written in: those of the statement, and what of the model it leaves out."""
        parameters = [n for n in self._parameters if not self._one(n).is_vector]
        coordinates = self._coordinates
        taken = {*parameters, *coordinates}
        directions = map(Sym, self.symbols.of_kind("declared", "direction"))
        vectors = [n for n in (*self.used, *directions) if self._one(n).is_vector]
        known = dict.fromkeys([*self.used, *map(Sym, self.symbols.of_kind("declared", "gauge"))])
        others = [n for n in known if n not in taken and not self._one(n).is_vector and n.name != "t"]
        others += self._reactions({_meant(self._one(n).texts) for n in others})
        others = [n for n in others if n in self.used or not any(_owners(text) & self.symbols.no_place for text in self.texts(n))]
        groups = (parameters, coordinates, others, vectors)
        plain = [{n: self._dimension(n) for n in group} for group in groups]
        named = [n for n in others if n in self.used or n.name in self.symbols.own]
        angles = {n for n in (*parameters, *coordinates, *named) if self._one(n).dimension == ANGLE}
        angles |= {n for n in parameters if plain[0][n] == NUMBER_ONLY and (n in self._turning or self._turns(n))}
        angular = frozenset(angles | {n for n in coordinates if plain[1][n] == NUMBER_ONLY})
        energies = frozenset(n for n in others if any(map(_ENERGY.match, self._one(n).texts)))
        return Vocabulary(*plain, angular=angular, letters=frozenset(map(Sym, self.symbols.own)), energies=energies)

    def _reactions(self, said: set[tuple[str, ...]]) -> list[Sym]:
        """The determined reactions of the model that are not said, in the components of their joints."""
        loads = self.sampler.core.free_bodies(self.sampler.own).loads
        named = [Sym(load.symbol) for load in loads if load.unknown and load.determinate]
        known = [n for n in named if n.name in self.symbols.meanings and _meant(self._one(n).texts) not in said]
        return known if len(known) <= _MANY else []

    def _one(self, symbol: Sym) -> Meaning:
        return self.symbols.meanings[symbol.name]

    def _dimension(self, symbol: Sym) -> Known:
        """The dimension of a symbol, radians aside; a parameter that is a bare number is one."""
        dimension, name = self._one(symbol).dimension, self._one(symbol).texts[0]
        if dimension is None:
            return NUMBER_ONLY if name in self.sampler.free_parameters or Sym(symbol.name) in self._turning else None
        return dimension._replace(angle=0)

    def _turns(self, parameter: Sym) -> bool:
        """Whether a parameter without a unit is an angle in a sine or cosine of the model, and no factor of one."""
        term = rf"(?:[\d.]+\s*\*\s*)?{re.escape(parameter.name)}\s*(?:[*/]\s*[\d.]+\s*)?"
        return bool(re.search(rf"\b(sin|cos|tan)\((?:[^()]*[+-])?\s*{term}[+)-]", self.mechanics))

    @cached_property
    def _turning(self) -> frozenset[Sym]:
        """The symbols that are angles in sines and cosines, and no factors of one."""
        calls = (n for n in walk(self.program) if isinstance(n, Fn) and n.name in ("sin", "cos", "tan"))
        terms = (symbols_in(term) for call in calls for _, term in addends(call.args[0], expand=True))
        return frozenset(found[0] for found in terms if len(found) == 1)

    @cached_property
    def _parameters(self) -> list[Sym]:
        there = self.symbols.of_kind("parameter", "gravity")  # of them those that are said, or more than numbers of the start
        used = (name == "g" or _named(name, self.mechanics) for name in there)
        start = self._of_instant or bool(self.sampler.own.moment)  # then its numbers count, too
        derived = {each["name"]: each["value"] for each in self.sampler.spec["parameters"] if isinstance(each["value"], str)}
        named = {n.name for n in self.used} | derived.keys()
        made_of = [n.name for n in self.used]
        for name in made_of:  # the numbers of the start of which a letter is made count, too
            made_of += [word for word in WORD.findall(derived.get(name, "")) if word not in made_of]
        named |= {*made_of}
        own = [Sym(name) for name, matters in zip(there, used, strict=True) if matters or start or name in named]
        own = [n for n in own if n in self.used or n.name not in self.symbols.no_place]
        own.sort(key=lambda n: n.name not in self.sampler.free_parameters)
        declared = map(Sym, self.symbols.of_kind("declared"))  # some only name a parameter anew
        renamed = [n for n in declared if _meant(self._one(n).texts)[0] in self.sampler.free_parameters]
        letters = [*self.used, *map(Sym, sorted(self.symbols.own))]
        made = [n for n in letters if self._one(n).kind == "declared" and self._is_fixed(n)] + renamed
        return self._once([*made, *(n for n in own if n in self.used), *own])

    def _once(self, found: list[Sym]) -> list[Sym]:
        """Without symbols that only name again what another does."""
        first = {self._one(n).texts: n for n in reversed(found)}
        return [n for n in dict.fromkeys(found) if first[self._one(n).texts] == n]

    @cached_property
    def mechanics(self) -> str:
        """What of the model, as text, decides how it moves from a given start."""
        spec = self.sampler.spec
        given = {k: v for k, v in spec.items() if k not in ("parameters", "name", "events", "points")}
        used = json.dumps(given, ensure_ascii=False)
        used += json.dumps([point["at"] for point in spec["points"] if _named(point["name"], used)], ensure_ascii=False)
        return self.sampler.with_formulas(used)

    def _is_fixed(self, symbol: Sym) -> bool:
        """Whether it is made of parameters alone."""
        if self._one(symbol).kind == "vibration":
            return False
        words = {word for text in self._one(symbol).texts for word in WORD.findall(text)}
        return words <= {*(p["name"] for p in self.sampler.spec["parameters"]), "pi", "sqrt", "sin", "cos", "tan"}

    @cached_property
    def _coordinates(self) -> list[Sym]:
        """Symbols that measure the configuration, those of the statement first; then the model's own, but for angles that are Ω t, and what else
        is declared where some are missing."""
        movable = self._once([n for n in self.used if self._moves(n)])
        said = {self._one(n).texts for n in movable}
        measured = (*self.sampler.coordinates, *self.sampler.metadata["closure_coordinates"])
        names = [c["name"] for c in measured if c["name"].isidentifier() and c["name"] in self.symbols.meanings]
        uniform = {motion["of"] for motion in self.sampler.spec["motions"] if _UNIFORM.fullmatch(str(motion["is"]))}
        names = [name for name in names if name not in uniform]
        found = [*movable, *(Sym(name) for name in names if (name,) not in said)]
        declared = [n for n in map(Sym, self.symbols.of_kind("declared")) if n not in found and self._moves(n)]
        return [*found, *declared[: max(len(self.sampler.coordinates) - len(found), 0)]]

    def _moves(self, symbol: Sym) -> bool:
        """Whether it is a coordinate, or declared by configuration alone, so that it has rates and accelerations."""
        one = self._one(symbol)
        states = self.sampler.metadata["states"]  # of which the first rate is known alone
        beyond = any(_BEYOND.search(text) or any(_named(name, text) for name in states) for text in one.texts)
        if beyond or one.is_vector or self._is_fixed(symbol):
            return False
        if one.kind not in ("coordinate", "declared", "gauge"):
            return False
        try:
            return all(one.needed(dots) for dots in (1, 2))
        except ModelProblem:
            return False


@dataclass
class Case:
    """A program of statements, what its symbols mean, and true motions. ``hypothesis`` is the family of which it is said;
    ``correcting``: whether corrections are wanted where it is wrong, as far as the ``budget`` goes."""

    program: Program
    meaning: StatementSymbols
    sampler: MotionSampler
    hypothesis: Family = ALL
    correcting: bool = True
    budget: Budget = field(default_factory=lambda: Budget(math.inf))
    known: dict[tuple[Family, int, int], Mapping[str, Array]] = field(default_factory=dict)

    @property
    def equations(self) -> tuple[Equation, ...]:
        """What is stated, with assigned names written out."""
        return inlined(self.program)

    def samples(self, family: Family | None = None, fresh: int = 0, count: int = SAMPLES) -> Samples:
        """True states of a family. Raises ``NoMotion``."""
        most = _FEWER if self.meaning.takes_long else _OF_MOMENTS if self.meaning.names_moments else count
        return self.sampler.samples(family or self.hypothesis, min(count, most), fresh)

    def values(self, family: Family | None = None, fresh: int = 0, count: int = SAMPLES) -> Mapping[str, Array]:
        """The symbols on true states of a family. Raises ``NoMotion``."""
        key = (family or self.hypothesis, fresh, count)
        if key not in self.known:
            began = thread_time()
            self.known[key] = self.meaning.values(self.samples(family, fresh, count))
            if self.meaning.names_moments and key[0] == self.hypothesis:  # to which motions are followed: that is no search
                self.budget.leaves_out_since(began)
        return self.known[key]

    @cached_property
    def admissible(self) -> Mapping[str, Array]:
        """The symbols on states at which no balance holds; none where there are no such states."""
        with suppress(NoMotion, Unreached, ModelProblem, ModelError, MotionError, StatementError):
            return self.meaning.values(self.admissible_samples())
        return {}

    def admissible_samples(self) -> Samples:
        """States at which no balance holds. Raises ``NoMotion``."""
        return self.sampler.admissible.samples(ALL, _ADMISSIBLE)

    def is_kinematic(self, equation: Equation) -> bool:
        """Whether an equation holds whatever the balances say."""
        try:
            return bool(self.admissible) and residual(equation, self.admissible).worst < _KINEMATIC
        except (KeyError, ValueError):
            return False

    def depends_on_stress(self, equation: Equation) -> list[str]:
        """The reactions that are not determined and of which it depends on their values whether the equation holds."""
        samples = self.samples()
        if not samples.loose:
            return []
        relaxed = Samples(samples.core, samples.states, stress=0.0)
        after = residual(equation, self.meaning.values(relaxed)).sides.residual
        before = self.residual(equation).sides.residual
        same = np.allclose(after, before, rtol=1e-9, atol=1e-9 * float(np.abs(before).max()))
        return [] if same else sorted(samples.loose)

    def elsewhere(self, values: Mapping[str, Array], bound: bool = True) -> dict[str, Array]:
        """Values that are no true state, where only what is the same by itself is the same; or, if ``bound``, by what the model
        defines its parameters to be, and places at its start."""
        names, given = self.meaning.names(), self.meaning.given() if bound else frozenset()
        given |= (
            {n.key for n in self.meaning.vocabulary.coordinates}
            if bound and self.hypothesis.at_start and not self.sampler.moment
            else set()
        )
        sizes = {key: np.where(np.any(value), value, 1.0) for key, value in values.items()}
        rng, draws = np.random.default_rng(5), {}  # always the same places
        for key, value in sizes.items():
            draws.setdefault(names.get(key, key), value * rng.uniform(0.7, 1.4, value.shape))
        return {
            key: value if key in given and np.any(values[key]) else draws[names.get(key, key)] for key, value in sizes.items()
        }

    def residual(self, equation: Equation, family: Family | None = None, fresh: int = 0) -> Residual:
        """How far an equation is from holding."""
        return residual(equation, self.values(family, fresh))


def _meant(texts: Iterable[str]) -> tuple[str, ...]:
    """Expressions of the model language, one name in one spelling: without brackets, tensions by what they are in."""
    return tuple(_TENSION.sub(r"\1.tension", _BRACKETS.sub(r"\1", text)) for text in texts)


def _named(name: str, text: str) -> bool:
    """Whether a name stands in an expression or a list of them."""
    return re.search(rf"(?<![\w.]){re.escape(name)}(?![\w.])", text) is not None


def _owners(text: str) -> set[str]:
    """The joints and forces of which an expression reads something."""
    return {owner.strip("'") for owner in re.findall(r"('[^']+'|[^\W\d]\w*)\.", text)}
