"""Clauses in words of exercise books, and the words of claims that are read for them: ``swing``, during the swing."""

from __future__ import annotations

import re

from .language.glyphs import CONDITION
from .wording import INSTANT

_NEAR = "(?:about|around|near|for)"
_HELD = r"(?:is |are )?(?:held|fixed|locked|clamped|blocked)(?: (?:still|fixed|fast|in place))?"
MOTION = (
    r"(?:turn|fall|swing|rise|run|climb|jump|dive|stroke|pull|push|throw|slide|roll|drop|descent|ascent|braking|burn|recovery)"
)
_WORDS: tuple[tuple[str, str], ...] = (
    (rf"in (?:the|its|his|her) ({MOTION})", r"during the \1"),
    (
        r"(?:the )?((?:recovery|coasting|rebound|(?:free )?flight|(?:second|next|later|last|final) (?:phase|stage|part|stretch|stroke))"
        r"(?: (?:of|on|with|by) [a-z ]+)?)",
        r"during \1",
    ),
    (
        rf"(?!(?:{CONDITION})\b)((?:the )?[A-Za-z]+(?: [a-z]+)?) (in (?:the )?(?:flight|air)|off the [a-z]+|airborne)",
        r"while \1 is \2",
    ),
    (r"(?:with |while )?(?:the )?([a-z]+) (?:is )?(?:still )?(?:whole|intact|uncut|unbroken)", r"before the \1 is cut"),
    (
        r"(?:the )?([a-z]+) (?:sliding|coming|going|moving|falling|sinking|climbing|rising) (?:back )?"
        r"(up|down|to the left|to the right)(?:wards?|hill)?",
        r"while \1 moves \2",
    ),
    (
        rf"(?!(?:{CONDITION})\b)((?:[a-z]+ )*(?:touch(?:ed|ing)|still touch(?:es)?|in (?:contact|touch)|(?:com)?pressed)(?: [a-z]+)*)",
        r"while \1",
    ),
    (r"(?:once|when|after) ((?:it|both|all|(?:the )?[a-z]+)) (?:is|are) at rest again", r"after \1 has come to rest"),
    (
        r"((?:it|he|she|they|(?:the )?[a-z]+) (?:lets? go|breaks?|snaps?|tears?|takes? off|lifts? off|(?:is|are) (?:released|cut|let go)))",
        r"when \1",
    ),
    (r"(?:the )?((?:first )?(?:swing|fall|climb|descent|ascent|glide)(?: (?:on|down|up|from|of) [a-z0-9 ]+)?)", r"during the \1"),
    (r"(?:the )?([a-z]+) just (lands|stops|leaves|slips|lifts|touches|tips)", r"when the \1 \2"),
    (r"for (?:the )?((?!small\b)[a-z]+ (?:[a-z]+ )*(?:moments?|forces?|balance|momentum)(?: [A-Za-z]+)*?)(?: gives?)?", r"\1"),
    (r"after (?:the |being )?releas(?:e|ed) (?:from|at) (?!rest\b)[^\s=]+", "from the start"),
    (r"(?:still )?in (?:contact|touch)((?: with [a-z ]+)?)", r"while in contact\1"),
    (r"(slip(?:ping)?|sliding|rolling|contact) (ends|stops|begins|starts)", r"when \1 \2"),
    (r"just (?:been )?(?:released|let go)", "just after the release"),
    (r"held in (?:static )?equilibrium", "in equilibrium"),
    (r"(?:the )?([a-z]+) not yet ([a-z]+)", r"before the \1 is \2"),
    (
        r"((?:when|once|while|as long as) (?:the )?[a-z]+ (?:is|are|stays?|remains?) (?:still )?(?:in|on|at|off) (?:the )?[a-z]+) (?:the|it|he|she|they) .*",
        r"\1",
    ),
    (r"(?:thrown|pushed|flung|kicked|driven|sent) back", "on the way back"),
    (r"(at the (?:top|highest point)) of the (?:first )?(?:rebound|bounce)", r"\1, after the impact"),
    (
        r"(?:at )?(?:the )?(?:top|highest point) of (?:the )?(\S+?)['’]s flight",
        r"at the highest point of the \1, after lift-off",
    ),
    (r"(?:at )?(?:the )?(?:top|highest point) of (?:its |his |her |the )?flight", "at the highest point, after lift-off"),
    (
        r"(?:(?:the )?(?:[a-z]+ )?(?:is |are )?)(?:just )?(?:about to|on the (?:point|verge) of) (?:slip(?:ping)?|slid(?:e|ing))\b.*",
        "just before it slips",
    ),
    (r"(?:[a-z]+ )*?(?:standing|hanging|lying|resting|sitting) still at (\S+ ?= ?\S+)", r"in equilibrium, \1"),
    (
        r"(?:once|when) (?:the )?(?:speed|velocity) (?:no longer changes|does not change any ?more|stays the same)",
        "in the steady state",
    ),
    (r"(?:at )?(?:the )?(?:first )?turning point( after .*)?", r"at the turning point,\1"),
    (r"(at (?:the|its) \S+ (?:point|position|place)) (after .*)", r"\1, \2"),
    (r"(?:from )?(t_?[1₁]) to (t_?[2₂])", r"from \1 to \2"),
    (r"(?:as a )?special case,? (.*=.*)", r"if \1"),
    (
        r"(?:(?:the )?\S+ )?(?:pass(?:ing|es)|swing(?:ing|s) through)(?: through)? (?:the (?:[a-z]+ )?(?:position|place|point) )?(\S+ ?= ?\S+)",
        r"when \1",
    ),
    (
        r"(?:(?:the )?[a-z]+ )?(?:[a-z]+ing )?(?:about|over|on|at) (?:the )?(?:edge|corner) ([A-Z]\w*)",
        r"while it turns about \1",
    ),
    (r"(?:the )?(?!\w+ing\b)([a-z]+) on", r"once the \1 is on"),
    (r"for the first time", "from the start"),
    (r"(?:going|moving|sliding|running) (up|down)(?:wards?|hill)?", r"while it moves \1"),
    (r"(?:the )?([a-z]+) (?:is )?in motion", r"while the \1 moves"),
    (r"(?:past|beyond) (\S+) ?= ?([^-−\s]\S*)", r"if \1 > \2"),
    (
        r"(?:[a-z]+ )*?(?:(?:at|with|in) (?:an? )?(?:constant|steady|uniform)|const\.?|constant) (?:speed|velocity)|(?:constant|steady|uniform) (?:riding|running|driving|towing|hoisting)",
        "at constant speed",
    ),
    (r"(?:the )?((?:greatest|largest|most|full|maximum|max\.?) (?:compression|extension|stretch|elongation))", r"at the \1"),
    (r"(?:and )?before (?:the )?(?:second|next|third)\b.*", ""),
    (r"after (?:a |the )?(?:time )?t (?:from rest|if the start is at rest)", "if the start is at rest"),
    (r"after (?:a|an|one|half|two|three|\d+)\b[^()=]*\(([^()]*=[^()]*)\)", r"when \1"),
    (r"(?:pure )?(rolling|rolls|sliding|slides|slipping|slips) \([^()=]+=[^()]+\)", r"while \1"),
    (rf"({INSTANT}(?:after|at)|at) ((?:the )?(?:release|start|beginning))(?: from rest)? ?\([^()1-9]*=[^()1-9]*\)", r"\1 \2"),
    (rf"((?:{INSTANT})?(?:after|before) .*[a-z]) \([^()=<>→]*\)", r"\1"),
    (r".*\bfrom \S+ \(at rest\)", "if the start is at rest"),
    (rf"(?:with )?(?:the )?([\w' -]+?) {_HELD} ?(?:\(|at )\s*(\S+?) ?= ?([^(),]+?)\)?", r"\2 held at \3"),
    (rf"(?:with )?(?:the )?([\w' -]+?) {_HELD} ?\((\S+?) ?= ?([^(),]+?), ([^()]+)\)", r"\2 held at \3, \4"),
    (rf"(?:with )?(?:the )?([\w' -]+?) {_HELD}", r"\1 held"),
    (
        rf"(?:linear(?:is|iz)ed {_NEAR}|near|close to|(?:for )?small \S+ {_NEAR}) (?:the (?:place|position) )?([^\s=]+) ?= ?([^\s=]+)",
        r"as \1 -> \2",
    ),
    (r"(\S{1,6}) (?:is )?small", r"small \1"),
    (r"(\S{1,6}) (?:is )?(?:negligible|neglected)|negligible (\S{1,6})", r"\1\2 -> 0"),
    (r"(?:held|kept|hanging|standing|holding) still", "in equilibrium"),
    (r"(?:the )?steady[ -]state|steady (?:motion|vibration|response)", "in the steady state"),
    (r"(?:the )?(?:static )?equilibrium", "in equilibrium"),
    (
        r"(?:for )?small(?: (?:[a-z]+ing|oscillations?|vibrations?|angles?|amplitudes?|motions?|displacements?|swings?)(?: about [^\s=]+)?)?",
        "for small motions",
    ),
    (r"(?:without|neglecting|ignoring) [a-z ]*\(([^()=]+=[^()]+)\)", r"if \1"),
    (r"(?:the )?natural (?:circular )?frequencies(?: of the \w+)?", "frequencies"),
    (r"(?:the )?natural (?:circular )?frequency of the \w+", "natural frequency"),
    (r"((?:in (?:the )?steady[ -]state|in (?:static )?equilibrium|at rest)) the .*", r"\1"),
    (r"(?:if|where|for|with|without) (?!.*\b(?:kept|prevented)\b)[a-z'’ -]+ \(([^()]*(?:[=<>→]|->|\\to)[^()]*)\)", r"if \1"),
    (r"((?:in (?:the )?(?:flight|air)|during (?:the )?(?:[a-z]+ )?flight)) (?:only|nothing|no|there|it|the) .*", r"\1"),
    (r"(?:once|when|after) (?:the )?\S+ (?:is|has become) (?:steady|constant)", "in the steady state"),
    (
        rf"((?:{INSTANT})?(?:when|once|after|while|as (?:long|soon) as) (?:it|he|she|they|both|(?:the )?[a-z]+) .*?) (?:the|it|he|she|they|its|an?) (?:(?!the\b|it\b)[a-z]+ ){{0,3}}(?:is|are|has|have|had)\b.*",
        r"\1",
    ),
    (r"(?:when|if|at) [^()=<>]*[⊥∥][^()=<>]*\(([^()]*[=<>][^()]*)\)", r"if \1"),
    (r"((?:when|at|once|while|after|with|without|for|if) [^()]*\([^()]*[=<>→][^()]*\)) [a-z]+ [^=<>→]*", r"\1"),
    (
        rf"((?:{INSTANT})?(?:when|once|after|before|while|as (?:long|soon) as) (?:the )?[a-z]+ (?:is|are|has|have|was)(?: not)?(?: been)? [a-z]+(?: (?:off|out|away|open|loose|up|down|still))?)"
        r" (?:the [a-z]+|it|he|she|they|both) (?:[a-z]+s|can|must|will|may|only|just|then|still)\b.*",
        r"\1",
    ),
    (r"((?:once|when|after|while) (?:the )?[a-z]+ (?:has|have|is|are) .*?) (?:only|no|nothing|all|both) .*", r"\1"),
    (r"((?:when|once|after|while|as long as) (?:the )?[a-z]+ .*?) (?:it|he|she|they) (?!is\b|are\b)[a-z]+.*", r"\1"),
    (rf"({INSTANT}(?:after|before|at) the [a-z]+) (?:the [a-z]+|it|he|they|both) (?!is\b|are\b)[a-z]+.*", r"\1"),
    (
        r"((?:the|an?|it|he|she) .*[a-z]{3}) (?:at|when|where)(?: the (?:instant|time|moment))?",
        r"when \1",
    ),  # it blows off at t = …
    (r"(?:the )?([a-z]+ [a-z]+|[a-z]+) at(?: the (?:instant|time|moment))?", r"just before the \1"),  # first impact at t = …
    (r"(.*[a-z]{3}) (?:at|when|where)(?: the (?:instant|time|moment))?", r"when \1"),
)
"""Clauses in words of exercise books, and what is read for them."""


def reworded(clause: str) -> str | None:
    """What is read for a clause in words of exercise books; None where it is none of these."""
    said = " ".join(clause.split())
    return next((found.expand(read) for written, read in _WORDS if (found := re.fullmatch(written, said, re.I))), None)
