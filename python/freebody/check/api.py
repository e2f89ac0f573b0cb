"""Checking statements about one model."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from functools import partial
from time import thread_time
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import ModelError, MotionError
from freebody.model.errors import ModelFileError, ModelProblem
from freebody.run.moments import Unreached
from freebody.symbolic.errors import StatementError

from .assumptions import FROM_START
from .budget import Budget
from .case import Case, StatementSymbols
from .claims import claimed
from .families import ALL, BEFORE, Family, NoMotion
from .frequency_claims import OMEGA, PERIOD, as_period
from .happenings import Happenings
from .held import without_others
from .hypotheses import family, free_parameter
from .language.glyphs import CONDITION
from .language.statements import symbols_in
from .later import also_later, corrected_later, only_later
from .laws import without_laws
from .motion_sampler import MotionSampler
from .of_bodies import without_place
from .printed_symbols import PrintedSymbols
from .prose import plainly
from .symbols import Symbols
from .timed_claims import holds_on_run
from .tried_readings import stated
from .tried_sentences import LIKELY, as_said
from .verdict import Kind, Verdict
from .vibration import Vibration
from .wording import as_claim, with_condition_first

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_ROOT = re.compile(r"√|sqrt")
_STRETCH = re.compile(r"\b(?:while|until|during|as long as)\b|\b(?:for|where|when|if)\b[^:]*(?:[<>≤≥]|\\[lg]eq?\b)")
"""Words for a stretch of the model's own motion."""
_FIRST = re.compile(r"\bfirst\b")
_GIVEN = re.compile(r"(?:[A-Za-z][a-z\s-]*,)?\$?\s*([^\s=]+)\s*=\s*[^=]+")
_SMALL = re.compile(r"\s*small\b")
_ENERGY = re.compile(r"\benerg(?:y|ies)\b", re.IGNORECASE)
_WORDS = re.compile(r"`([a-z]{2,}(?:[\s-]+[a-z]+)*)` is no hypothesis")
_ROUND_OFF = 1e-9  # of the largest rate on a motion, below which it is 0
_SENSES = re.compile(r"\S+ [<>] 0(?:, \S+ [<>] 0)*")
_SMALL_ONE = re.compile(r"small\s+([^\s:,=]+)\s*:(?=.*(?:ω|omega|τ|tau|\b[Tf]\b|\b[Tf]_))", re.S)
"""``small θ_1: T_1 = …``."""
Declared = Mapping[str, str | Sequence[str | float]]
"""Own symbols, each an expression of the model language, components of a vector or a phrase; see ``Symbols``."""


class Checker:
    """Checks many statements about one model; its true motions are made once.

    ``letters`` are own symbols for all of them. ``seconds`` of computing are spent on a statement at most before what was found is
    answered: by default 2 up to ten bodies, 10 from twenty on. ``seed`` makes the random motions reproducible. ``asked`` tells the moment of which the
    model is spoken, ``at``, ``before`` or ``after``, and the start, ``initial``, ``t`` and changes, as in ``Mechanism.solve``.
    """

    def __init__(
        self, mechanism: Builder, letters: Declared | None = None, seed: int = 0, seconds: float | None = None, **asked: Any
    ) -> None:
        self.mechanism = mechanism
        self.declared = dict(letters or {})
        self.sampler, self.printed = MotionSampler(mechanism, seed, **asked), PrintedSymbols(mechanism, **asked)
        self.vibration, self.happens = Vibration(self.sampler), Happenings(self)
        self.hypothesis = ALL
        self.correcting, self.is_at_first = True, False
        self.no_place: frozenset[str] = frozenset()  # what is not of a balance of the bodies that are named
        self.of_energy = False  # whether a label calls what is said an energy
        self.seconds = Budget.seconds_for(len(self.sampler.metadata["bodies"])) if seconds is None else seconds
        self.budget = Budget(self.seconds)
        self.whole: Budget | None = None
        self._seed, self._asked = seed, asked
        self._vibrations: dict[
            tuple[str, tuple[str, ...], tuple[tuple[str, float], ...]], Vibration
        ] = {}  # of what swings alone, with what is held
        self._beside: dict[tuple[Any, ...], Checker] = {}  # the same of other moments

    def symbols(self, declared: Declared | None = None) -> Symbols:
        """The symbols of the model with own ones. Raises ``ModelProblem``."""
        return Symbols(self.mechanism, {**self.declared, **(declared or {})}, self.sampler.gravity, self.printed, self.vibration)

    def case(
        self,
        text: str,
        letters: Declared | None = None,
        hypothesis: Family | None = None,
        units: bool = True,
        tight: bool = False,
    ) -> Case:
        """A statement beside the motions that decide about it, read with ``units`` or without, and ``tight`` or not as ``parse`` does.
        Raises ``StatementError`` and ``ModelProblem``."""
        given = hypothesis or self.hypothesis
        known = self.symbols(letters)
        known.vibration, known.no_place, known.of_energy = self.vibration_of(given), self.no_place, self.of_energy
        began = thread_time()
        program = known.read(text, units, tight)
        self.budget.leaves_out_since(began)  # for vibrations a place of rest is looked for
        meaning = StatementSymbols(known, program, self.sampler, given.at_start)
        if meaning.needs_past and not given.since:
            since_start = meaning.names_moments or (meaning.sums_up and self.sampler.moment)
            given = replace(given, since=BEFORE if since_start else "start")
        return Case(program, meaning, self.sampler, given, self.correcting, self.budget)

    def check(
        self, text: str, letters: Declared | None = None, hypothesis: Family | None = None, correcting: bool = True
    ) -> Verdict:
        """The verdict about an equation, several lines of them, or a claim (see docs/check.md).

        ``hypothesis``: the motions of which it is said. Without ``correcting`` it is only judged, which is quicker where it is wrong.
        Raises ``StatementError``, with the place, where it cannot be read or asks for what the model does not have.
        """
        how = (text, letters, hypothesis, correcting)
        if self.whole is None:  # else it is a question of a claim that is asked already
            asked = copy(self)
            asked.whole = Budget(self.seconds, begins=thread_time())
            return asked.check(*how) if hypothesis else as_said(asked, text, letters, correcting)
        if (
            (one := _SMALL_ONE.search(with_condition_first(plainly(text)[0])))
            and not self.vibration.alone
            and (alone := self.swinging(one[1], letters))
        ):
            return alone.check(*how)
        try:
            if re.search(r"\bsmall\b[^:]*:", text) and (found := self._of_frequencies(*how)):
                return found
            verdict = self._checked(*how)
            as_rate = verdict.kind is Kind.WRONG and any(note.startswith("Here ω is read as") for note in verdict.notes)
            as_energy = verdict.kind is Kind.DIMENSIONS and any(note.startswith("Here T is read as") for note in verdict.notes)
            found = self._of_frequencies(*how) if as_rate or as_energy else None  # a rate is no expression of what stays the same
            return replace(found, text=verdict.text) if found else verdict
        except StatementError as error:
            is_of_omega = re.search("`(?:(?:ω|omega)(?:_[A-Za-z])?|T|τ|tau)`", error.what) is not None
            others = (self._of_frequencies,) * is_of_omega + (self._without_laws, partial(self._without_words, error))
            if found := next(filter(None, (other(*how) for other in others)), None):
                return found
            raise

    def _keeps(self, senses: str, letters: Declared | None) -> bool:
        """Whether rates have such senses on the model's own motion, as what rises has on its way."""
        run = self.happens.run
        rates = [run.evaluate(text, run.t) for text in family(senses, self, letters or {}).above]
        return all(rate.any() and np.all(rate >= -_ROUND_OFF * np.abs(rate).max()) for rate in rates)

    def swinging(self, coordinate: str, letters: Declared | None) -> Checker | None:
        """The same of the vibration of one of several coordinates, which swings for itself; None where it does not."""
        meaning = self.symbols(letters).spelt(coordinate)
        if meaning is None or meaning.kind != "coordinate" or len(self.sampler.names) < 2:
            return None
        if self.vibration.rest is None:
            other = without_others(self, meaning.texts[0])
            return other if other and other.vibration.rest else None
        if not self.vibration.is_of_several:
            return None
        other = copy(self)
        other.vibration = Vibration(self.sampler, meaning.texts[0])
        return other if other.vibration.count else None

    def _of_frequencies(self, text: str, letters: Declared | None, *how: Any) -> Verdict | None:
        """The verdict where ω, which has no other meaning, stands among quantities of the model alone: it is what small vibrations have."""
        condition, colon, said = with_condition_first(plainly(text)[0]).rpartition(":")
        if self.vibration.count > 1 and (period := PERIOD.match(said)) and not OMEGA.search(said):
            found = self._of_frequencies(f"{condition}{colon} ω = 2*pi/({period[2]})", letters, *how)
            return found and replace(found, mends=tuple(as_period(mend, period[1]) for mend in found.mends))
        if "frequencies:" in text or not OMEGA.search(said):
            return None
        # Of several one alone stays finite where a stiffness grows without bound.
        if self.vibration.is_of_several and re.search(r"→|->|\\(?:right)?to\b|\\rightarrow", condition):
            asked = [self.check(OMEGA.sub(f"ω_{1 + i}", text), letters, *how) for i in range(self.vibration.count)]
            return next((one for one in asked if one.ok), asked[0])
        claim = as_claim(f"{'for ' * bool(_SMALL.match(condition))}{condition}: frequencies: {said}")
        if not re.match(rf"(?:{CONDITION}|frequencies)\b", claim):
            if re.search(r"[=<>→]|\bmode\b", condition):  # which of them is meant is not understood
                return None
            claim = f"frequencies: {text}"
        with suppress(StatementError, ModelProblem):  # what letters lack is told of the statement itself
            known = self.symbols(letters)
            taken = {*known.meanings}
            if "ω" not in taken and all(
                (OMEGA.fullmatch(n.name) and n.name not in taken) or n.name in known.constants
                for n in symbols_in(known.read(with_condition_first(said)))
            ):
                return self.check(claim, letters, *how)
        return None

    def _without_laws(self, text: str, letters: Declared | None, *how: Any) -> Verdict | None:
        """The verdict where what cannot be read begins with a law, and says something behind it; where both can be read, about both."""
        for other, law in without_laws(text):
            if re.search(r"(?:→|->|\\to\b)\s*(?:0|∞|inf|\\infty)", law):  # no law but a condition
                continue
            if (said := _GIVEN.fullmatch(law)) and free_parameter(said[1], self, letters or {}) and self.hypothesis == ALL:
                return self.check(f"if {law.rpartition(',')[2]}: {other}", letters, *how)
            with suppress(StatementError):
                found = self.check(other, letters, *how)
                if law or found.kind is not Kind.DIMENSIONS:
                    passed = (f"`{law}` is read as a law that comes before, and not judged.",) if law else ()
                    return replace(found, text=text.strip(), notes=(*found.notes, *passed))
        return None

    def _without_words(self, error: StatementError, text: str, letters: Declared | None, *how: Any) -> Verdict | None:
        """The verdict where words among conditions are not understood: about the motions of which the others are. What is true of these is
        so; that something is wrong is said only where a likely correction is true of all of them, too."""
        words = _WORDS.fullmatch(error.what)
        other = re.sub(rf"{re.escape(words[1])}\s*,|,\s*{re.escape(words[1])}(?=\s*[:,])", "", text) if words else text
        if other == text:
            return None
        checker = copy(self)
        checker.correcting = True
        with suppress(StatementError):
            found = checker.check(other, letters, how[0])
            if found.ok or (found.kind is Kind.WRONG and found.mends and found.mends[0].size <= LIKELY):
                note = f"`{words[1]}` is not understood, and passed over."  # type: ignore[index]
                mends = found.mends if self.correcting and how[1] else ()
                return replace(found, text=text.strip(), mends=mends, notes=(*found.notes, note))
        return None

    def _checked(self, text: str, letters: Declared | None, hypothesis: Family | None, correcting: bool) -> Verdict:
        """The verdict of ``check`` about a text as it stands."""
        if broken := re.search("[\ud800-\udfff]", text):  # half of a character, as a damaged file has it
            shown = text.encode(errors="replace").decode()
            raise StatementError("this is no character", broken.span(), "write it again", shown)
        checker = copy(self)
        checker.hypothesis, checker.correcting = hypothesis or self.hypothesis, correcting and self.correcting
        checker.budget = self.whole.part() if self.whole else Budget(self.seconds, begins=thread_time())
        names = {*self.mechanism.parameters, *self.sampler.names, *self.declared, *(letters or ())}
        plain, passed = plainly(
            text, names, {*self.mechanism.parameters}, [body["name"] for body in self.sampler.metadata["bodies"]]
        )
        if any(name.startswith("Δ") for name in (*self.declared, *(letters or ()))):  # a letter, and no change
            plain = re.sub(r"\\Delta\s*(?=\w)", "Δ", plain)
        try:
            label, colon, _ = plain.rpartition(":")
            checker.no_place |= without_place(label, checker.symbols(letters), self.sampler.spec) if colon else frozenset()
            checker.of_energy |= _ENERGY.search(label) is not None
            found = claimed(checker, plain, letters or {})
            verdict = replace(found, text=text.strip()) if found else stated(checker, with_condition_first(plain), letters)
            verdict = replace(verdict, notes=(*verdict.notes, *passed))
            if verdict.kind is Kind.TRUE_IF and _SENSES.fullmatch(words := verdict.assumption) and self._keeps(words, letters):
                verdict = replace(verdict, kind=Kind.TRUE, reason=f"holds where {words}, as in the whole motion of the model")
            if verdict.kind is Kind.TRUE_IF and verdict.assumption == FROM_START and _STRETCH.search(text):
                why = f"holds on {FROM_START}, of a stretch of which it speaks"
                verdict = replace(verdict, kind=Kind.TRUE, reason=why, assumption="", mends=(), evidence=None)
            rooted = verdict.ok and not found and checker.hypothesis == ALL and verdict.assumption == FROM_START
            rooted &= _FIRST.search(text) is None
            if rooted and _ROOT.search(plain) and not holds_on_run(checker, letters or {}, with_condition_first(plain)):
                verdict = replace(
                    verdict, kind=Kind.TRUE_IF, reason=f"holds on {FROM_START} at first, and later with the other root"
                )
            plainly_said = verdict.ok and not found and checker.hypothesis == ALL
            if plainly_said and not (self.is_at_first or self.sampler.moment):
                verdict = also_later(self, verdict, text, letters)
            as_said = not found and checker.hypothesis == ALL and not (self.is_at_first or self.sampler.moment)
            if as_said and verdict.kind is Kind.WRONG:
                verdict = only_later(self, verdict, text, letters)
            if as_said and verdict.kind is Kind.WRONG and verdict.mends:
                verdict = corrected_later(self, verdict, text, letters)
            if verdict.moment or not self.sampler.has(checker.hypothesis):
                return verdict
            return replace(verdict, moment=self.sampler.own.moment)
        except NoMotion as error:
            return Verdict.without_motion(text, error)
        except (ModelProblem, ModelError, MotionError) as error:
            what, hint = error.args[-2:]
        except Unreached as error:
            what, hint = str(error), ""
        except ModelFileError as error:  # a number of a parameter that is none
            what, hint = error.problems[0].what, error.problems[0].hint
        except StatementError as error:
            if error.text:
                raise
            what, hint = error.what, error.hint
        word = next((word for word in re.findall("`([^`]+)`", what) if word in text), text)
        start = text.find(word)
        raise StatementError(what, (start, start + len(word)), hint, text)

    def at_first(self) -> Checker:
        """The same, of which is asked what is so as the model is at first, whatever switches on it later."""
        other = copy(self)
        other.is_at_first = True
        return other

    def beside(self, side: str, event: str, held: Mapping[str, float]) -> Checker:
        """The same of the model ``before`` or ``after`` something that happens, as a person calls it: by the name of the event or of a
        part that changes; with parameters that are ``held``. Raises ``ModelProblem``."""
        return self._of_moment(side, self.happens.called(event), held)

    def at_time(self, t: float) -> Checker:
        """The same of the model as its own motion has it at a time, s."""
        return self._of_moment("at", t, {})

    def _of_moment(self, side: str, moment: str | float, held: Mapping[str, float]) -> Checker:
        key = (side, moment, *held.items())
        if key not in self._beside:
            asked = {word: given for word, given in {**self._asked, **held}.items() if word not in ("at", "before", "after")}
            self._beside[key] = type(self)(self.mechanism, self.declared, self._seed, self.seconds, **asked, **{side: moment})
        other = copy(self._beside[key])
        other.correcting, other.whole = self.correcting, self.whole
        return other

    def of_model(self, key: tuple[Any, ...], change: Callable[[Builder], None]) -> Checker:
        """The same of the model after a ``change``, which a ``key`` tells from others."""
        if key not in self._beside:
            mechanism = self.mechanism.copy()
            change(mechanism)
            self._beside[key] = type(self)(mechanism, self.declared, self._seed, self.seconds, **self._asked)
        other = copy(self._beside[key])
        other.correcting, other.whole = self.correcting, self.whole
        return other

    def vibration_of(self, family: Family) -> Vibration:
        """The vibration of the model; where parameters have a number of their own, with that: it may rest nowhere else."""
        held = tuple((name, float(value)) for name, value in family.held if str(value).replace(".", "", 1).isdecimal())
        if not held:
            return self.vibration
        key = (self.vibration.alone, self.vibration.places, held)
        if key not in self._vibrations:
            sampler = MotionSampler(self.mechanism, self._seed, **{**self._asked, **dict(held)})
            self._vibrations[key] = Vibration(sampler, self.vibration.alone, self.vibration.places)
        return self._vibrations[key]
