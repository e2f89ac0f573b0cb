"""Where a motion is, in words: which way a body moves, and where something is greatest or least."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.model.names import spell
from freebody.run.records import Array, quote

from .phases import called
from .stretches import first_zero

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .families import Family
    from .user_symbols import Meaning

_MOVING = re.compile(
    r"\b(?:(?:mov|slid|go|roll|travel|swing|climb|head)(?:e?s|ing|e)?|(?:on|during) (?:the|its) (?:way|stroke|motion))\b"
)
_WAYS = {
    "right": ("vx", r"(?:to(?:wards?)? the )?right(?:wards?)?"),
    "left": ("-vx", r"(?:to(?:wards?)? the )?left(?:wards?)?"),
    "up": ("vy", r"up(?:wards?|hill)?|climb(?:s|ing)|ris(?:es|ing)|ascend(?:s|ing)"),
    "down": ("-vy", r"down(?:wards?|hill)?|fall(?:s|ing)|sink(?:s|ing)|descend(?:s|ing)"),
}
"""Which way a body moves: the component of its velocity that is above 0 then, and words for it."""
_IT = re.compile(r"\bit\b")
_ALL = re.compile(r"\b(?:both|all|they)\b(?! the (?:way|time)\b)")
_GREATEST = r"(?:greatest|largest|biggest|highest|farthest|longest|maximal|maximum|max\.?|most|fastest|fullest|full)"
_LEAST = r"(?:least|smallest|lowest|shortest|minimal|minimum|min\.?|slowest)"
_EXTREME = re.compile(rf"\b(?:(?P<greatest>{_GREATEST}|top(?!\s+of\b))|(?P<least>{_LEAST}|bottom(?!\s+of\b)))(?!\w)")
_OF_SPRING = {
    "least": re.compile(r"\bcompress(?:ed|ion)\b"),
    "greatest": re.compile(r"\b(?:stretch(?:ed)?|exten(?:ded|sion)|elongat(?:ed|ion))\b"),
}
"""Of what the length of a spring is least or greatest."""
_HEIGHT = re.compile(r"\b(?:highest|lowest|height|top|bottom)\b")
_LEANS = re.compile(r"\b(?:lean(?:s|ing|ed|t)?|tilt(?:s|ing|ed)?|tip(?:s|ping|ped))\b.*\b(left|right)\b")
_LETTER = 2  # characters that the name of a quantity has at most: longer ones may be words
_STOPS = re.compile(
    r"\b(?:stops|stopped|comes? to (?:rest|a (?:stop|halt|standstill))|stands? still|(?:momentarily|instantaneously) at rest)\b"
)
_SPEED = re.compile(r"\b(?:speed|velocity|fast(?:est)?|slow(?:est)?)\b")
_UPRIGHT = re.compile(
    r"\b(?P<thing>\w+)\s+(?:(?:is|gets|hangs|stands|becomes|comes|has\s+become|passes\s+(?:through\s+)?the)\s+)?(?:(?P<up>vertical|upright|plumb)|horizontal|level)\b"
)
_AT_START = re.compile(r"\b(?:releas|start|from\s+rest|initial|begin|let\s+go)")
_LOOKS = 33  # times of a run, at which it is looked for what moves most
_STILL = 1e-6  # of the rate with which something moves at first: below it it rests
_TURNS = 1e-6  # of what is typical, what a second derivative is at least where something turns: what stays so does not
_PLACE = re.compile(
    r"\b(?:farthest out|point|place|position|height|swing|swung|angle|tilt|lean|turn|deflection|displacement|excursion|deviation|amplitude|distance|way)\b"
)


def described(words: str, checker: Checker, declared: Declared) -> Family | None:
    """The motions of which words are true: ``it moves to the left``, ``at greatest compression``, ``the speed is least``. None where they say
    nothing of the kind, or not of what."""
    return _extreme(words, checker, declared) or _way(words, checker)


def way_of(words: str, checker: Checker) -> str:
    """Which way something moves by words, in words that say nothing else; none where they do not tell."""
    way = _which_way(words)
    body = _mover(words, way, checker) if way else None
    return f"{body} moves {way}" if body else ""


def _which_way(words: str) -> str:
    found = [way for way, (_, said) in _WAYS.items() if re.search(rf"\b(?:{said})\b", words)]
    moving = _MOVING.search(words) or re.search(r"\b(?:ris|fall|sink|climb|ascend|descend)(?:s|es|ing)\b", words)
    return found[0] if len(found) == 1 and moving else ""


def _mover(words: str, way: str, checker: Checker) -> str | None:
    """The body that moves one way by words: that which they name, else the only one that moves along there."""
    if (body := _body(words, checker)) or not _IT.search(words):
        return body
    found = _moving(way, checker)
    return found[0] if len(found) == 1 else None


def _moving(way: str, checker: Checker) -> list[str]:
    """The bodies that move along a way, there or back, on the model's own run."""
    run, bodies = checker.happens.run, [body["name"] for body in checker.sampler.spec["bodies"]]
    times = np.linspace(run.t[0], float(run.outcome.t), _LOOKS)[1:-1]
    still = _STILL * checker.sampler.length * checker.sampler.rate
    along = ((name, run.evaluate(f"{_WAYS[way][0]}({quote(name)}.G)", times)) for name in bodies)
    return [name for name, speeds in along if np.abs(speeds).max() > still]


def place_of(words: str, checker: Checker) -> str:
    """Where a rod, a link or a spring is ``vertical`` or ``horizontal``, as an equation of the model language; none where words do not tell."""
    found = None if _AT_START.search(words) else _UPRIGHT.search(words)
    if found is None:
        return ""
    spec, name = checker.sampler.spec, found["thing"]
    rods = [body["name"] for body in spec["bodies"] if any(piece["shape"] == "rod" for piece in body["pieces"])]
    if name in rods or (name == "it" and len(rods) == 1):
        return f"{'cos' if found['up'] else 'sin'}(angle({quote(name if name in rods else rods[0])})) = 0"
    linked = {joint["name"]: joint["with"]["of"] for joint in spec["joints"] if joint["type"] == "link"}
    linked |= {force["name"]: force["with"]["between"] for force in spec["forces"] if "between" in force["with"]}
    if name not in linked:
        return ""
    one, other = (f"{'x' if found['up'] else 'y'}({end})" for end in linked[name])
    return f"{one} = {other}"


def _way(words: str, checker: Checker) -> Family | None:
    """Motions of a body one way, or of all of them."""
    way = _which_way(words)
    if not way:
        return None
    every = _moving(way, checker) if _ALL.search(words) and _body(words, checker) is None else []
    bodies = every or list(filter(None, [_mover(words, way, checker)]))
    if not bodies:
        return None
    moving = (f"{_WAYS[way][0]}({quote(body)}.G)" for body in bodies)
    return replace(checker.hypothesis, above=(*checker.hypothesis.above, *moving))


def _extreme(words: str, checker: Checker, declared: Declared) -> Family | None:
    """Motions from the start to where something is first greatest or least, or the only coordinate comes to rest."""
    given, sampler = checker.hypothesis, checker.sampler
    if (found := _EXTREME.search(words)) and (rates := _rates(words, found.lastgroup == "least", checker, declared)):
        first, *second = rates
        size = sampler.size_of(first, sampler.own)  # not finite where a cord starts with no length
        least = float(np.nan_to_num(_TURNS * sampler.rate * size))
        above = (f"{text} - {least!r}" for text in second)
        return replace(given, vanishing=(*given.vanishing, first), above=(*given.above, *above), since="start")
    tops = found is not None and found.lastgroup == "greatest" and _HEIGHT.search(words) is not None
    presses = _OF_SPRING["least"].search(words) is not None  # a contact
    if (tops or presses or _STOPS.search(words)) and (name := _coming_to_rest(checker)):
        place = f"x({quote(body)}.G)" if (body := _body(words, checker)) else ""
        side = [
            f"{sign}({place} - ⟦{place}⟧)" for way, sign in (("right", ""), ("left", "-")) if place and f"on the {way}" in words
        ]
        given = replace(given, above=(*given.above, *side))
        return replace(given, vanishing=(*given.vanishing, f"rate({spell(name)})"), since="start")
    return None


def _coming_to_rest(checker: Checker) -> str | None:
    """The coordinate whose rate vanishes where all comes to rest: the only one, or that which moves most where the others come to rest with it."""
    run, names = checker.happens.run, checker.sampler.names
    if len(names) == 1:
        return names[0]
    begins, ends = max(float(run.t[0]), checker.sampler.own.t), float(run.outcome.t)

    def rates(times: Array) -> Array:
        """Of each coordinate, beside what it typically is, (n, nt)."""
        found = [np.abs(run.evaluate(f"rate({spell(name)})", times)) for name in names]
        return np.array(found) / checker.sampler.sizes[:, None]

    most = rates(np.linspace(begins, ends, _LOOKS)).max(axis=1)
    k = int(np.argmax(most))
    stops = first_zero(lambda times: run.evaluate(f"rate({spell(names[k])})", times), begins, ends) or ends
    return names[k] if np.all(rates(np.array([stops])) <= _STILL * most[k]) else None


def _rates(words: str, least: bool, checker: Checker, declared: Declared) -> tuple[str, ...]:
    """Of that of which words speak, what comes to 0 where it is extreme, and what is above 0 there; nothing where that is not clear."""
    names, body = checker.sampler.names, _body(words, checker)
    for side, pattern in _OF_SPRING.items():
        if pattern.search(words):
            length = _length(checker)
            return _of(length, (side == "least") is not least) if length else ()
    known = checker.symbols(declared)
    for word in re.findall(r"\\?[^\W\d]\w*", words):
        letter = known.spelt(word) if word.startswith("\\") else known.meanings.get(word) if len(word) <= _LETTER else None
        if letter and letter.kind in ("coordinate", "declared", "reading"):
            return _signed(letter.needed(1)[0], *_second(letter), least=least)
    if body and (leans := _LEANS.search(words)):  # angles are counted counter-clockwise
        return _of(f"angle({quote(body)})", (leans[1] == "right") is not least)
    if _SPEED.search(words):
        return (f"accel({spell(names[0])})",) if len(names) == 1 else ()
    if _HEIGHT.search(words):
        return _of(f"y({quote(body)}.G)" if body else _heights(checker), least) if body or checker.sampler.moves_one_way else ()
    name = names[0] if len(names) == 1 else _turning(body, checker)
    return _of(spell(name), least) if _PLACE.search(words) and name else ()


def _turning(body: str | None, checker: Checker) -> str | None:
    """The only coordinate of the joint that holds a body to another."""
    own = [
        joint["coordinates"]
        for joint in checker.sampler.spec["joints"]
        if joint["with"].get("of", [""])[-1].startswith(f"{body}.")
    ]
    return own[0][0]["name"] if len(own) == 1 and len(own[0]) == 1 else None


def _heights(checker: Checker) -> str:
    """The sum of masses times heights, kg m, in the model language: greatest where the mass centre of all bodies is highest."""
    masses = {body["name"]: body["mass"] for body in checker.sampler.metadata["bodies"] if body.get("mass")}
    weighed = (f"{mass!r}*y({quote(name)}.G)" for name, mass in masses.items())
    return f"({' + '.join(weighed)})"


def _second(letter: Meaning) -> list[str]:
    """The second derivative of a letter, if it has one."""
    with suppress(ModelProblem):
        return letter.needed(2)
    return []


def _of(text: str, least: bool) -> tuple[str, ...]:
    return _signed(f"rate({text})", f"accel({text})", least=least)


def _signed(first: str, *second: str, least: bool) -> tuple[str, ...]:
    return first, *(text if least else f"-({text})" for text in second)


def _length(checker: Checker) -> str | None:
    """That of the only spring, or string that stretches."""
    spec = checker.sampler.spec
    springs = [force["with"] for force in spec["forces"] if force["type"] == "spring"]
    strings = [string for string in spec["strings"] if string.get("stiffness") and not string["over"]]
    if len(springs) + len(strings) != 1:
        return None
    ends = springs[0].get("between") if springs else [end.get("point") for end in strings[0]["ends"]]
    return "distance({}, {})".format(*ends) if ends and all(ends) else springs[0].get("along") if springs else None


def _body(words: str, checker: Checker) -> str | None:
    """The body that words name; the only one where they name none."""
    bodies = [body["name"] for body in checker.sampler.spec["bodies"]]
    named = called(bodies, re.findall(r"\w+", words))
    return named[0] if len(named) == 1 else bodies[0] if len(bodies) == 1 else None
