"""Mechanisms of textbooks with statements as students write them, right and with a slip, in two halves: none is made by a rule. The check
was mended with those in ``books/``; those that people who do not know it write for its score alone are put into ``books_unseen/``.

A file holds a ``model``, ``letters``, and ``statements``: what is said, the ``verdict`` that a person came to, and the ``correction``
that a tutor would give. Both were written down before the program had seen them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from time import process_time
from typing import Any

import independent
import numpy as np
from ruamel.yaml import YAML
from slipped import slipped

from freebody.check import Checker, Kind
from freebody.check.case import Case
from freebody.check.families import ALL
from freebody.check.file import WORDS, judged_alone
from freebody.check.language.statements import Equation, symbols_in, terms
from freebody.check.prose import plainly
from freebody.check.residual import HOLDS, residual
from freebody.check.sentences import sentence
from freebody.check.two_moments import across_impact
from freebody.check.verdict import Verdict
from freebody.check.wording import as_claim, with_condition_first
from freebody.core import ModelError, MotionError
from freebody.mechanism import Mechanism
from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array
from freebody.symbolic.symbols import folded

_CONSTANT = re.compile(r"(?:.*[:,])?\s*constant:(.+)", re.S)
_IS_CONSTANT = re.compile(r"=\s*const(?:ant)?\.?\s*\Z")
_CONDITION = re.compile(r"^.*:(?!=)|^limit:|\bas\s+\S+\s*(?:→|->).*$")
"""What says of which motions an equation is."""
_TENDS = re.compile(r"→|->|\\to\b")
_OMEGA = re.compile(r"(?:ω|\\omega|\bomega)(?:_\{?n\}?)?(?![A-Za-z0-9_₀-₉])")
_NUMBERED = re.compile(r"\bomega_\d\b")
"""One of several natural frequencies, as a correction writes it."""
_CAPITAL = re.compile(r"(?<![\w\\])[A-ZΑ-Ω](?!\w)")
"""An amplitude by the capital of what goes to and fro."""
_FOLLOWS = re.compile(r"⇒|\\Rightarrow|\\implies")
_AT_START = re.compile(r"\b(?:release[ds]?|from rest|at the start|let go)\b")
_AT_STARTS = 16
_BODY = re.compile(r"(.*:(?!=)\s*)?(.+?)(\bas\s+\S+\s*(?:→|->).*)?", re.S)


def _is_one_at_start(cases: Sequence[Case], one: Equation, other: Equation) -> bool:
    """Whether two equations of the start are one but for a number as joints and laws of forces allow there, at other loads."""
    try:
        given = [case.meaning.values(case.sampler.admissible.samples(replace(ALL, at_start=True), _AT_STARTS)) for case in cases]
        return _proportional(one, other, {**given[0], **given[1]})
    except (ValueError, KeyError, ModelError, MotionError):
        return False


def _files(half: str) -> dict[str, Path]:
    return {path.stem: path for path in sorted((Path(__file__).parent / half).glob("*.yaml"))}


FILES, UNSEEN = _files("books"), _files("books_unseen")
OTHER_WORDS = YAML(typ="safe").load((Path(__file__).parent / "other_words.yaml").read_text(encoding="utf-8"))

NOT_FOUND = {
    ("epicyclic_winch", "lift with held ring"): "says that an event locks what it calls held, beside a limit",
    (
        "collar_slips_on_falling_rod",
        "angle of slip",
    ): "is of the moment at which something begins to slip, and calls it by its sentence",
    ("weight_lands_block_slides_on", "acceleration while the weight falls"): "says of a stretch what a body does on it",
    ("pencil_tips_over", "loss by rubbing"): "slides back the other way, and does not turn back",
    ("bar_on_half_cylinder", "force that just holds"): "is of an equilibrium without the friction that the model has",
    ("pebble_bounces_down_slope", "speed in the end"): "is so to what the last of infinitely many bounces leave",
    ("typewriter", "start from rest"): "calls the start by what the finger does",
    ("breakaway_rim", "energy to the lowest point"): "is of the lowest point of what moves in several ways",
    ("woodpecker_toy", "frequency in the fall"): "is of the vibration of what falls",
    ("safety_gear", "pressure of the shoe at rest"): "is of a rest that comes later, in a label",
    ("elliptic_chuck", "instantaneous centre"): "calls a length by two points of which one is none of the model",
    ("set_up_springs", "very soft springs"): "is of the period of large swings",
    ("puck_round_curved_wall", "size of the acceleration"): "has a letter a_t of a particle that nothing guides",
    ("wheel_up_a_kerb", "least speed"): "is of the motion that just gets up, of which the start would have to be found",
    ("porter_governor", "small oscillations"): "is of small motions about a steady state that it gives itself",
    ("ball_in_lift", "bounce"): "is of two ropes that the blow jerks, too",
    ("coil_on_truck", "hardest braking"): "asks of a contact that the model's numbers open at once",
    ("coil_on_truck", "moments about the corner on the bed"): "asks of a contact that the model's numbers open at once",
    ("door_closer", "when it stops opening"): "calls the only coordinate by what the door does",
    ("escalator", "speed over time"): "gives a letter behind the equation, and one with an index of ∞",
    ("locomotive_cylinder", "one stroke"): "begins at another angle of what rolls in a loop than the model",
    ("loudspeaker_on_foam", "frequencies with the coil open"): "is of a model with a state of its own",
    (
        "macpherson_strut",
        "speed of the hub from the instant centre",
    ): "calls a length by two points of which one is none of the model",
    ("mass_with_play", "whole period"): "is the period of a motion that is no small vibration",
    ("soap_box", "final speed"): "dies away too slowly to be seen to",
    ("sounding_rocket", "growing acceleration"): "is of the rate of an acceleration",
    ("square_wheel", "coasting to a corner"): "begins at another place than the model",
    ("trapeze_catch", "hanging straight"): "takes longer to arrange than there is time",
    ("climber_and_belayer", "tension oscillates"): "differentiates a tension twice",
    ("lever_safety_valve", "opened a little"): "is of small angles on a stretch that begins away from 0",
    ("punch_press", "work and energy"): "names a stretch that only a law of time tells from others",
    ("quarter_car", "steady state without damper"): "takes longer to arrange than there is time",
    ("walking_beam", "impulse while it lags"): "is of one of several slides, in words that leave open which",
    ("walking_beam", "second slide begins"): "is of one of several slides, in words that leave open which",
    ("rocking_chair", "speed of the mass centre"): "calls a length by two points of which one is none of the model",
    ("awning_window", "holding force"): "is of an equilibrium that other numbers do not have",
    ("current_collector", "train stands"): "has remarks on both sides",
    ("sector_pinion_lift", "lifting"): "is so as the model is at first, by words that are not understood",
    ("rider_on_sprung_sled", "period"): "is of the period while dry friction holds",
    ("toaster", "period of the empty carriage"): "calls the period of one part alone by the letter of an energy",
    ("cages_on_heavy_rope", "differentiated once more"): "is of the rate of an acceleration",
    ("can_lifted_by_rod", "transverse acceleration"): "names components of an acceleration by the angle",
    ("crate_on_sprung_trolley", "period with the crate carried along"): "is of the period while dry friction holds",
    ("crate_on_sprung_trolley", "friction of the ground on a wheel"): "gives letters of its own within the sentence",
    ("crate_on_sprung_trolley", "where the normal force acts"): "asks how the place of a force moves",
    ("lift_on_buffer", "same impulse on both"): "is of the jerk of a rope that was taut before",
    ("seesaw_on_tyres", "small angles"): "is of small angles on a stretch that begins away from 0",
    ("torsiograph", "fast shaft"): "is of the limit of what is largest in a steady state",
    ("motor_on_hinged_arm", "amplitude of the forced vibration"): "is of the steady state of a rotor that turns on an arm",
    ("weight_between_two_counterweights", "natural frequency"): "calls a place of rest by the index of a start",
    ("rod_hung_in_accelerating_car", "small swings about the slanted rest"): "is of small motions in a frame that accelerates",
    ("tamping_rammer", "motion before the first jump"): "is of the forced motion alone, which its start has with any numbers",
}
"""What is right of the half for mending and not found to be, with the reason."""
CALLED_WRONG = {
    ("drag_cup_speedometer", "rigid cable"): "says of a limit at what speed something turns, of any motion",
    ("sled_runs_onto_gravel", "push of the drawbar"): "is of motions from the start, which are looked for with corrections",
    ("bullet_through_two_blocks", "A held fast"): "is of a later stretch, in a limit",
    ("pole_lathe", "return stroke"): "is of small motions on a later stretch",
    ("slalom_pole", "energy of the free pole"): "flies ahead of what pushes it with other numbers",
    ("pencil_tips_over", "where it begins to slip"): "is of the moment at which something begins to slip for the first time",
    ("girder_crane", "peak on a stiff girder"): "is of the greatest of a force, in a limit",
    ("lorry_helper_spring", "static deflection"): "is of the rest behind a contact to which other numbers do not come",
    ("lorry_helper_spring", "lowest point"): "is of a place behind a contact to which other numbers do not come",
    ("reverse_bungee", "natural frequency"): "has a letter for a length at the place of rest, which is that at each place",
    ("block_slides_to_spring", "pressing in"): "is of a stretch that only a law of force tells from others",
    ("block_slides_to_spring", "fastest"): "is of a place on a stretch that only a law of force tells from others",
    ("block_slides_to_spring", "first stop"): "is of a place on a stretch that only a law of force tells from others",
    ("pencil_tips_over", "normal force while sliding back"): "slides back the other way, and does not turn back",
    ("set_up_springs", "period"): "is of the period of large swings",
    ("ball_in_lift", "relative acceleration"): "calls by B and C what are bodies there, and points of the model",
    ("chairlift_stops", "energy after the stop"): "is of a stretch that only a law of time tells from others",
    ("chairlift_stops", "first integral while braked"): "is of a stretch that only a law of time tells from others",
    ("chemists_balance", "small swings"): "is of an equilibrium at which unequal weights do not rest",
    ("dragster", "about to lift the nose"): "spins its wheels, which take a couple then, however light they are",
    ("drum_with_free_core", "thick oil"): "comes to its limit only some time after the start",
    ("loudspeaker_on_foam", "damping by the coil"): "lets a state follow at once, which stiffens the model",
    ("snakeboard", "turning circle"): "is of going forward: a curvature has a sign",
    ("sluice_gate", "impulse on the sill"): "is of an impulse, written as an integral of a force over time",
    ("tailgate_on_chain", "impulse of the chain"): "is of an impulse, written as an integral of a force over time",
    ("torsion_pendulum_catches_ring", "turning point after the catch"): "comes back where a coordinate is not greatest",
    ("car_body_roll", "steady roll angle"): "is of the steady state of small motions",
    ("climber_and_belayer", "fixed end of the rope"): "holds him by a mass that goes to infinity, and falls with it",
    ("packages_on_incline", "push while together"): "comes together at the end of many blows, of which the first is taken",
    ("punch_press", "ram while cutting"): "is of a stretch that only a law of place tells from others",
    ("punch_press", "side force"): "is of a stretch that only a law of place tells from others",
    ("bottle_dynamo", "final speed"): "is of the steady state behind an impact",
    ("rack_gripper", "grip"): "lets go with other numbers",
    ("rack_gripper", "power of the lift"): "lets go with other numbers",
    ("current_collector", "steady vibration"): "is of the steady state of a model without damping",
    ("current_collector", "at the trough of the wire"): "is of the steady state, and does not say so",
    ("wheel_over_gap", "speed after the gap"): "is of a later place of the track, in words that are not understood",
    ("pulley_hung_on_spring", "least pull on the floor"): "is of the top of the swing of what goes up and down",
    ("wagons_couple_bar_hung", "frequency"): "is of small motions on a later stretch",
    ("ballistic_cart", "time of flight"): "calls a moment by what lasts from then on",
    ("counterblow_hammer", "end of the first rebound"): "is of a stop between two blows, in words of its own",
}
"""What is right of it and called wrong: faults that are known, with the reason."""
TRUE_AT_FIRST = {("plate_compactor", "shaft taken as fixed"), ("bicycle_over_the_bars", "brake works against the wheel alone")}
"""What is wrong of the whole motion, and true as the model is at first, which the verdict says."""


@dataclass(frozen=True)
class Said:
    """A statement with its verdict; ``kind`` is what a person says of it."""

    book: str
    statement: dict[str, Any]
    verdict: Verdict

    @property
    def kind(self) -> object:
        return WORDS[self.statement["verdict"]]


@dataclass(frozen=True)
class Slip:
    """A right statement with a slip of a ``kind``, and what becomes of it."""

    book: str
    kind: str
    right: str
    says: str
    verdict: Verdict
    seconds: float


class Book:
    """One mechanism and what is said of it."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.data = YAML(typ="safe").load((FILES | UNSEEN)[name].read_text(encoding="utf-8"))

    @cached_property
    def checker(self) -> Checker:
        return Checker(Mechanism.loads(json.dumps({"freebody": 1, **self.data["model"]})), self.data.get("letters"))

    def says_the_same(self, one: str, other: str) -> bool:
        """Whether two equations, or what two claims call constant, hold at the same places, whatever the values of their symbols, or are
        one but for a number where these are as joints and laws of forces allow: m R² α is m R a of what rolls."""
        said = [self._equation(text) for text in (one, other)]
        if (numbered := _NUMBERED.search(one)) or "frequenc" in one + other or not self._has_omega:
            name = numbered[0] if numbered else "ω_1" if self.checker.vibration.count > 1 else "ω_n"
            said = [_OMEGA.sub(name, text) for text in said]
        try:
            cases = [self.checker.case(text) for text in said]
        except StatementError:  # it has letters of moments, or a frequency, that its condition alone gives
            said[1], letters = self._of_impact(said[1])
            letters |= {"ω_n": "1 rad/s"} if _OMEGA.search(one + other) else {}
            small = {folded(name): name for name in self.checker.sampler.names}
            letters |= {n: small[folded(n.lower())] for n in _CAPITAL.findall(one) if folded(n.lower()) in small}
            try:
                cases = [self.checker.case(text, letters) for text in said]
            except StatementError:
                return False
        starts, one = _AT_START.search(other) is not None, cases[0].equations[0]
        return any(
            self._is_one(cases, one, each) or (starts and _is_one_at_start(cases, one, each)) for each in cases[1].equations
        )

    def _is_one(self, cases: Sequence[Case], one: Equation, other: Equation) -> bool:
        """The same of equations of two cases."""
        if one == other:
            return True
        values = {**cases[0].values(), **cases[1].values()}
        count = min(map(len, values.values()), default=0)  # claims of vibrations and of motions are not judged on as many
        values = {key: value[:count] for key, value in values.items()}
        places = cases[0].elsewhere(values)
        if all(residual(each, places).worst < HOLDS for each in (one, other)):  # both are what the model defines a letter to be
            places = cases[0].elsewhere(values, bound=False)
        places = _tied(places, values, {n.key for each in (one, other) for n in symbols_in(each)} - cases[0].meaning.given())
        at = {n: places[n.key] for n in (*symbols_in(one), *symbols_in(other))}
        scalar = all(np.ndim(value) < 2 for value in at.values())
        if scalar:  # not every root has a value
            of_places = 0 * next(iter(at.values()))
            there = np.isfinite([independent.sides(each, at)[0] + of_places for each in (one, other)]).all(axis=0)
            at = {n: value[there] for n, value in at.items()}
        if _proportional(one, other, places) or (scalar and independent.says_the_same(one, other, at)):
            return True
        kinematic = any(case.is_kinematic(case.equations[0]) for case in cases)
        if kinematic and _names(one) <= _names(other) and _differs_in_one_term(one, other):
            return True
        return not kinematic and _proportional(one, other, {**cases[0].admissible, **cases[1].admissible})

    def _of_impact(self, text: str) -> tuple[str, dict[str, str]]:
        """What is said of just before and just after an impact, with the letters of these moments."""
        listener, heard = copy(self.checker), [(text, {})]

        def check(said: str, letters: dict[str, str], **_: object) -> Verdict:
            heard.append((said, letters))
            return Verdict(Kind.TRUE, said)

        listener.check = check  # type: ignore[method-assign]
        across_impact(listener, {}, "impact", text)
        return heard[-1]

    @cached_property
    def _has_omega(self) -> bool:
        """Whether ω means something else than what vibrations have."""
        known = self.checker.symbols()
        try:
            return bool(known.require(known.read("ω = 0")))
        except StatementError:
            return False

    def _equation(self, text: str) -> str:
        """What is said without the words that say of which motions; of a constant, that it is 0; of a limit, that it is reached."""
        return _IS_CONSTANT.sub("= 0", _TENDS.sub("=", _CONDITION.sub("", _CONSTANT.sub(r"\1 = 0", self._plain(text)))))

    def _plain(self, text: str) -> str:
        """What is said, with its condition first and without remarks."""
        names = {*self.checker.mechanism.parameters, *self.checker.sampler.names, *self.checker.declared}
        plain = with_condition_first(plainly(text, names)[0])
        return plain if ":" in plain else as_claim(plain)

    def slip(self, rng: np.random.Generator, statement: Mapping[str, Any]) -> Slip | None:
        """A right statement with a slip of a student, and the verdict; None where none is found to be wrong."""
        before, body, after = _BODY.fullmatch(self._plain(statement["says"])).groups(default="")  # type: ignore[union-attr]
        try:
            program = self.checker.symbols().read(body + " = 0" * ("constant:" in before))
            vocabulary = self.checker.case(program.text).meaning.vocabulary
        except (StatementError, ModelProblem):
            return None
        if len(program.lines) != 1 or not program.equations or program.equations[0].relation != "=":
            return None
        for kind, text in slipped(rng, program.text, program.equations[0], vocabulary):
            new = before + (text.removesuffix("= 0") if "constant:" in before else text) + after
            began = process_time()
            verdict = judged_alone(self.checker, new)
            if verdict.kind in (Kind.WRONG, Kind.DIMENSIONS):
                return Slip(self.name, kind, statement["says"], new, verdict, process_time() - began)
        return None

    def place(self, verdict: Verdict, correction: str) -> str:
        """At which place the correction of a tutor stands; of several equations that of one of them, of a conclusion that of its end."""
        names = {*self.checker.mechanism.parameters, *self.checker.sampler.names}
        said = sentence(correction, names | {*self.checker.declared}, names)
        ways = dict.fromkeys((correction, _FOLLOWS.split(correction)[-1], *(said.claims if said else ())))
        found = [i for i, each in enumerate(verdict.mends) if any(self.says_the_same(each.equation, way) for way in ways)]
        return "missing" if not found else "first" if found[0] == 0 else "among three" if found[0] < 3 else "behind the third"

    def verdicts(self, correcting: bool = True) -> Iterator[Said]:
        self.checker.correcting = correcting
        for statement in self.data["statements"]:
            yield Said(self.name, statement, judged_alone(self.checker, statement["says"]))

    def in_other_words(self, section: str) -> Iterator[Said]:
        """The verdicts about what other people make of its statements."""
        self.checker.correcting = False
        for id_, texts in OTHER_WORDS[section].get(self.name, {}).items():
            statement = next(each for each in self.data["statements"] if each["id"] == id_)
            for text in texts:
                yield Said(self.name, {**statement, "says": text}, judged_alone(self.checker, text))


def _names(equation: Equation) -> set[str]:
    return {n.name for n in symbols_in(equation)}


def _differs_in_one_term(one: Equation, other: Equation) -> bool:
    """Whether equations of motions alone, which both are true, have all terms but one in common: that is the same in other letters."""
    first, second = ({*terms(each, expand=True)} for each in (one, other))
    return len(first - second) == len(second - first) == 1


def _tied(places: Mapping[str, Array], values: Mapping[str, Array], moving: Iterable[str]) -> dict[str, Array]:
    """The same places with one value for letters that are one on all motions: the rate of an angle, and the angular velocity of its body."""
    out: dict[str, Array] = dict(places)
    said = [key for key in sorted(moving) if key in values and key in places]
    for i, key in enumerate(said):
        first = next((k for k in said[:i] if values[k].shape == values[key].shape and np.allclose(values[k], values[key])), None)
        out[key] = out[first] if first else out[key]
    return out


def _proportional(one: Equation, other: Equation, places: Mapping[str, Array]) -> bool:
    """Whether what is left of two equations is one but for a factor that is a number."""
    if not places:
        return False
    first, second = (residual(equation, places).sides.residual for equation in (one, other))
    if first.shape != second.shape:
        return False
    there = np.isfinite(first + second).all(axis=1)  # not every root has a value
    if not there.any():
        return False
    first, second = first[there], second[there]
    factor = np.sum(first * second) / np.sum(second**2)
    return bool(np.allclose(first, factor * second, rtol=1e-7, atol=1e-9 * np.abs(first).max()))
