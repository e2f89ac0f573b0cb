"""Clauses in words of exercise books, and the words of claims that are read for them: ``swing``, during the swing."""

from __future__ import annotations

import re

from .language.glyphs import CONDITION
from .wording import INSTANT

_NEAR = "(?:about|around|near|for)"
_HELD = r"(?:is |are )?(?:held|fixed|locked|clamped|blocked)(?: (?:still|fixed|fast|in place))?"
MOTION = r"(?:(?:first )?hop|turn|fall|swing|rise|run|climb|jump|dive|stroke|pull|push|throw|slide|roll|drop|descent|ascent|braking|burn|recovery)"
_WORDS: tuple[tuple[str, str], ...] = (
    (r"(?:[a-z]+ )*?(?:standing|hanging|lying|resting|sitting) still at (\S+ ?= ?\S+)", r"in equilibrium, \1"),
    (
        r"(?:the )?((?:recovery|coasting|braking|rebound|(?:free )?flight|(?:second|next|later|last|final) (?:phase|stage|part|stretch|stroke))"
        r"(?: (?:of|on|with|by) [a-z ]+)?)",
        r"during \1",
    ),
    (
        rf"(?!(?:{CONDITION})\b)((?:the )?[A-Za-z]+(?: [a-z]+)?) (in (?:the )?(?:flight|air)|off the [a-z]+|airborne)",
        r"while \1 is \2",
    ),
    (
        r"(?:the )?([a-z]+) (?:sliding|coming|going|moving|falling|sinking|climbing|rising) (?:back )?"
        r"(up|down|to the left|to the right)(?:wards?|hill)?",
        r"while \1 moves \2",
    ),
    (
        r"(while|as long as) ((?:[a-z]+ )*?)slid(ing|es?) (up|down|to the left|to the right)(?:wards?|hill)?",
        r"\1 \2mov\3 \4",
    ),
    (
        rf"(?!(?:{CONDITION})\b)((?:[a-z]+ )*(?:touch(?:ed|ing)|still touch(?:es)?|in (?:contact|touch)|(?:com)?pressed)(?: [a-z]+)*)",
        r"while \1",
    ),
    (r"(?:(?:once|when|after) )?((?:it|both|all|(?:the )?[a-z]+)) (?:is |are )?at rest again", r"after \1 has come to rest"),
    (r"(?:the )?((?:first )?(?:swing|fall|climb|descent|ascent|glide)(?: (?:on|down|up|from|of) [a-z0-9 ]+)?)", r"during the \1"),
    (r"(?:the )?([a-z]+) just (lands|stops|leaves|slips|lifts|touches|tips)", r"when the \1 \2"),
    (r"(?:still )?in (?:contact|touch)((?: with [a-z ]+)?)", r"while in contact\1"),
    (r"(slip(?:ping)?|sliding|rolling|contact) (ends|stops|begins|starts)", r"when \1 \2"),
    (r"just (?:been )?(?:released|let go)", "just after the release"),
    (r"(?:thrown|pushed|flung|kicked|driven|sent) back", "on the way back"),
    (r"(at the (?:top|highest point)) of the (?:first )?(?:rebound|bounce)", r"\1, after the impact"),
    (
        r"(?:at )?(?:the )?(?:top|highest point) of (?:the )?(\S+?)['’]s flight",
        r"at the highest point of the \1, after lift-off",
    ),
    (r"(?:at )?(?:the )?(?:top|highest point) of (?:its |his |her |the )?flight", "at the highest point, after lift-off"),
    (r"(?!with\b).*[a-z] with (?:the )?([a-z]+) (on|against) the ([a-z]+)", r"while the \1 is \2 the \3"),
    (r"(?:the )?([a-z]+) (?:is )?free again", r"after the \1 is released"),
    (
        r"(?:once|when) (?:the )?(?:speed|velocity) (?:no longer changes|does not change any ?more|stays the same)",
        "in the steady state",
    ),
    (r"(?:from )?(t_?[1₁]) to (t_?[2₂])", r"from \1 to \2"),
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
    (
        r"(?:[a-z]+ )*?(?:(?:at|with|in) (?:an? )?(?:constant|steady|uniform)|const\.?|constant) (?:speed|velocity)|(?:constant|steady|uniform) (?:riding|running|driving|towing|hoisting)",
        "at constant speed",
    ),
    (r"(?:the )?(?!beam |floor |gravity )([a-z]+) (?:is )?(vertical|upright|horizontal)", r"when the \1 is \2"),
    (
        r"(?:in )?between (?:the )?(?:two |both |first and (?:the )?second )?(impact|blow|collision|bounce|shock|hit)s?",
        r"after the first \1",
    ),
    (
        r"from (?:the )?[a-z]+ of (?:the )?[a-z]+ to (?:just before )?(?:the )?((?:first |second )?[a-z]+(?: of (?:the )?[a-z]+)?)",
        r"until the \1",
    ),
    (r"(?:and )?before (?:the )?(?:second|next|third)\b.*", ""),
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
    (r"(?:the )?steady[ -]state|steady (?:motion|vibration|response)", "in the steady state"),
    (
        r"(?:for )?small(?: (?:[a-z]+ing|oscillations?|vibrations?|angles?|amplitudes?|motions?|displacements?|swings?)(?: about [^\s=]+)?)?",
        "for small motions",
    ),
    (r"(?:the )?natural (?:circular )?frequencies(?: of the \w+)?", "frequencies"),
    (r"((?:in (?:the )?steady[ -]state|in (?:static )?equilibrium|at rest)) the .*", r"\1"),
    (r"(?:if|where|for|with|without) (?!.*\b(?:kept|prevented)\b)[a-z'’ -]+ \(([^()]*(?:[=<>→]|->|\\to)[^()]*)\)", r"if \1"),
    (r"(?:once|when|after) (?:the )?\S+ (?:is|has become) (?:steady|constant)", "in the steady state"),
    (r"((?:when|at|once|while|after|with|without|for|if) [^()]*\([^()]*[=<>→][^()]*\)) [a-z]+ [^=<>→]*", r"\1"),
    (r"where (?!.*\b(?:measured|counted|taken|denotes?|stands? for|means?)\b)([^=<>→]+ [^=<>→]+)", r"when \1"),
    (r"(.*[a-z]{3}) (?:at|when|where)(?: the (?:instant|time|moment))?", r"when \1"),
)
"""Clauses in words of exercise books, and what is read for them."""


def reworded(clause: str) -> str | None:
    """What is read for a clause in words of exercise books; None where it is none of these."""
    said = " ".join(clause.split())
    return next((found.expand(read) for written, read in _WORDS if (found := re.fullmatch(written, said, re.I))), None)
