"""Ways of writing that are put into others before a statement is read: labels and conditions in brackets, conditions of other languages,
second slopes."""

from __future__ import annotations

import re

from .language.glyphs import CONDITION

_ABROAD = {
    "if": "si|wenn|se",
    "when": "sobald|quand|lorsque|cuando|quando",
    "while": "solange|während(?: des| der)?|pendant(?: le| la)?|tant que|mientras|mentre",
    "after": "nach(?: dem| der)?|après(?: le| la)?|después de|dopo",
    "before": "vor(?: dem| der)?|avant(?: le| la)?|antes de|prima di",
    "at": "bei|beim",
    "for": "für|pour|para",
}
"""Words of other languages with which a condition begins."""
_FOREIGN = [(re.compile(rf"\A\s*(?:{words})\s+(?=[^:\n]*:(?!=))", re.IGNORECASE), f"{word} ") for word, words in _ABROAD.items()]
_LABEL_FIRST = re.compile(r"\A\s*\(((?=[^()]*\b[a-z]{4})[A-Za-z]+(?:[\s,']+[A-Za-z]+)+)\)\s+(?=[^\s:])")
"""``(shoe B, moments about the pin)  F c = …``."""
_WHEN_INSIDE = re.compile(
    rf"\A\s*(?!(?:{CONDITION})\b)[A-Za-z][^=:;\n()]*\(((?:(?:just|right)\s+)?(?:after|before|while|until|when|once)\s[^()=<>:]+)\)\s*:(?!=)"
)
"""``jaws together (after the blow):``."""
_BEFORE_NEXT = re.compile(
    r"\A(\s*(?:just\s+)?after\b[^:=\n]*?),?\s+(?:and\s+)?before\s+(?:the\s+)?(?:second|next|third)\b[^:=,\n]*(?=[:,])"
)
_AT_RELEASE = re.compile(
    r"\A(\s*(?:(?:just|right|immediately)\s+(?:after|at)|at)\s+(?:the\s+)?(?:release|start|beginning)(?:\s+from\s+rest)?)\s*\([^():]*=[^():]*\)(?=\s*:)"
)
"""``right after the release (θ = θ_0, θ' = 0):``, where it starts so."""
_CONSTANT_IF = re.compile(r"\A\s*constant,?\s+(if\b[^:\n]*?)\s*:(?!=)\s*")
"""``constant, if d = 0: …``."""
_HELD_AND = re.compile(r"\b(held|locked|fixed|clamped|blocked)\s*\(([^()=,:]+=[^()=,:]+),\s*([^():]+=[^():]+)\)(?=[^:=]*:)")
"""``link locked (θ = 0, d = 0)``."""
_FREQUENCY_OF = re.compile(r"(frequenc(?:y|ies))\s+of\s+the\s+\w+(?=\s+(?:with|when|if|for|where)\b)")
_STAGE = re.compile(
    r"\A\s*(?:the\s+)?((?:recovery|coasting|rebound|(?:free\s+)?flight|(?:second|next|later|last|final)\s+(?:phase|stage|part|stretch|stroke))"
    r"(?:\s+(?:of|on|with|by)\s+[a-z ]+)?)\s*(?:\([^()=]*\)\s*)?(?=[:,](?!=))"
)
"""``recovery (handle free):``, the name of a stretch."""
_SEEN = re.compile(rf"\A\s*(?:as\s+)?(?:seen|viewed|measured)\s+(?:from|in|by)\s+[^,:=]+,\s+(?=(?:{CONDITION})\b[^:]*:)")
"""``as seen from the cage, until it lands:``."""
_FIRST_TIME = re.compile(r"\A\s*([^:=]+=[^:=]+?)\s+(?:for the first time|first|again)\s+at\s+(\$?t\s*=[^:]+)\Z")
"""``h = 0 for the first time at t = …``."""
_WHICH_SIDE = re.compile(r"\s*\((?:index(?:es)?\s+)?1:?\s[^()]*\bbefore\b[^()]*\b2:?\s[^()]*\bafter\b[^()]*\)(?=\s*:)")
"""``bounce (1 just before, 2 just after):``."""
_FROM_TO = re.compile(r"\A[^:=]*?\b(?:from\s+)?(t_?[1₁])\s+to\s+(t_?[2₂])\s*:(?!=)")
_TAN_OF = re.compile(
    r"(\b(?:with|where|and)\s+)\\?tan\s*\\?\(?\s*([^\W\d]\w*)\)?\s*=\s*([^=,;]+?)\s*/\s*(\((?:[^()]|\([^()]*\))*\)|[^\s()]+)\s*\Z"
)
"""``… with tan φ = c ω/(k − m ω²)``, of a phase."""
_LAW_BEHIND = re.compile(r"\A(\s*(?:(?:starting|released)\s+)?from\s+rest),\s*[$TUVWE_{}()\d₁₂→\\to+−=\s-]+:(?!=)")
"""``from rest, T_1 + U_{1→2} = T_2: …``."""
_REST_BEHIND = re.compile(r"\A\s*([^:=]+?),\s*((?:starting\s+|released\s+)?from\s+rest)\s*:(?!=)")
"""``left pinion, angular impulse, from rest: …``."""
_OBSERVER = re.compile(r"\A\s*for\s+an\s+(?=observer\b[^:=]*:)")
_BOTH_SIDES = re.compile(r"\A\s*(?:both\s+)?before\s+[^:=]*?\band\s+after\s+(?:it|that)\s*:(?!=)")
_NAME = r"(\\?[A-Za-zα-ωΑ-Ω]+(?:_\w+)?)"
_SLOPE = re.compile(
    rf"\\[dt]?frac\s*\{{\s*d\s*\^\s*\{{?2\}}?\s*{_NAME}\s*\}}\s*\{{\s*d\s*{_NAME}\s*\^\s*\{{?2\}}?\s*\}}"
    rf"|(?<![\w\\])d(?:²|\^2)\s*{_NAME}\s*/\s*d\s*{_NAME}(?:²|\^2)"
)
"""``d²u/dθ²``, of which t is read elsewhere."""


_LESS = r"(?:<=|>=|[<>≤≥]|\\(?:leq?|geq?|lt|gt)(?![a-z]))"
_IN_LABEL = (
    re.compile(rf"\(([^()=:]*{_LESS}[^()=:]*)\)"),
    re.compile(rf"(?:\A|[,;])\s*((?:(?!{_LESS})[^,;()=:])+{_LESS}[^,;()=:]*)\Z"),
)
"""``on the ice (x > 0):``, ``energy, x < 0:``."""
_SAYS_WHEN = re.compile(r"\s*(?:if|when|for|while|until|once|as|given|limit|only)\b")
_LONG_WORD = re.compile(r"(?<![\\A-Za-z])(?!sin|cos|tan|sqrt)[A-Za-z]{3,}")
_CONSTANT_SIDE = re.compile(r"=\s*(?:\\(?:text|mathrm)\s*\{\s*)?const(?:ant)?\.?\s*\}?\s*(?==)")


def usual(text: str) -> str:
    """A statement in the ways of writing that are read."""
    text = _CONSTANT_SIDE.sub("", _ranged(text))
    for words, word in _FOREIGN:
        text = words.sub(word, text)
    text = _WHEN_INSIDE.sub(r"\1:", _LABEL_FIRST.sub(r"\1: ", text))
    text = _CONSTANT_IF.sub(r"\1: constant: ", _AT_RELEASE.sub(r"\1", _BEFORE_NEXT.sub(r"\1", text)))
    text = _TAN_OF.sub(r"\1\2 = atan2(\3, \4)", _FROM_TO.sub(r"from \1 to \2:", _WHICH_SIDE.sub("", _SEEN.sub("", text))))
    text = _BOTH_SIDES.sub("", _OBSERVER.sub("", _REST_BEHIND.sub(r"\2: \1:", _LAW_BEHIND.sub(r"\1:", text))))
    text = _FIRST_TIME.sub(r"when \1, from the start: \2", text)
    text = _STAGE.sub(r"during \1", text)
    text = _FREQUENCY_OF.sub(r"\1", _HELD_AND.sub(r"\1 (\2), \3", text))
    return _SLOPE.sub(_slope, text)


def _ranged(text: str) -> str:
    """A statement with the range that its label gives, ``0 < s < l:``, as a condition."""
    label, colon, said = text.partition(":")
    if not colon or said.startswith("=") or _SAYS_WHEN.match(label) or re.search(r"(?<![<>])=", label):
        return text
    plain = label.replace("$", "").strip()
    found = next((found[1] for pattern in _IN_LABEL if (found := pattern.search(plain))), None)
    if found is None or _LONG_WORD.search(found):
        return text
    signs, sides = re.findall(_LESS, found), [side.strip() for side in re.split(_LESS, found)]
    if not all(sides):
        return text
    parts = (f"{one} {sign} {other}" for one, sign, other in zip(sides[:-1], signs, sides[1:], strict=True))
    return f"if {', '.join(parts)}:{said}"


def _slope(found: re.Match[str]) -> str:
    """The second derivative by what moves, as rates have it."""
    of, by = (name for name in found.groups() if name is not None)
    if by == "t":
        return found[0]
    return f"(({of}'' {by}' − {of}' {by}'')/({by}')^3)"
