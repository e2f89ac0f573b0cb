"""Ways of writing that are put into others before a statement is read: labels and conditions in brackets, conditions of other languages,
second slopes."""

from __future__ import annotations

import re
from collections.abc import Callable

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
_LETTER = r"\\?[A-Za-zα-ωΑ-Ω]+(?:_\w+)?"
_SHORT = r"(?:\\[A-Za-z]+|[^\W\d_]\w{0,2})(?:_\{?\w+\}?)?(?!\w)"
_NAME = rf"({_LETTER})"
_PUT: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\bsqrt(\d+)\b", r"sqrt(\1)"),
    # m_1, m_2 → 0: each of them
    (
        rf"(?<![\w\\])(?<!small )(?<!small \$)({_SHORT}(?:\s*(?:,|\band\b)\s*{_SHORT})+)\s*(?:→|->|\\(?:right)?to\b|\\rightarrow\b)\s*(0|∞|inf(?:inity)?\b|\\infty)",
        lambda found: ", ".join(f"{name.strip()} → {found[2]}" for name in re.split(r",|\band\b", found[1])),
    ),
    # start → first touch: …
    (r"\bstart\s*(?:→|->|\\to\b)\s*(?:the\s+)?(?=[a-z]{3})([a-z][a-z ]*?)(?=\s*[:,])", r"at the \1"),
    (r"(\bat\s+rest\s+on\s+(?:the\s+)?\w+)\s+and\s+moves?\s+(?:along\s+)?with\s+(?:it|him|them)\b", r"\1"),
    # at lift-off (N → 0): … says twice when
    (
        r"(\b(?:lift-?off|separation|leav(?:es|ing)|slack|comes? off|los(?:es|ing) contact)\b[^():=]*)\(\s*[NRSTF](?:_\{?\w+\}?)?\s*(?:→|->|\\to)\s*0\s*\)(?=\s*[:,])",
        r"\1",
    ),
    # small oscillations about α = β = 0: where one is, the other follows
    (r"(\b(?:about|around)\s+\$?\\?[^\W\d]\w*\$?)\s*=\s*\\?[^\W\d]\w*\s*(?==\s*\$?0)", r"\1 "),
    # … (for x ≠ 0)
    (r"\A(?=[^:]*\Z)(.*=.*?)\s*\(\s*(?:for|if|when)\s+(\$?[^()=<>:]{1,20}(?:\\neq?\b|≠|!=)[^()=<>:]{1,20})\)\s*\Z", r"if \2: \1"),
    # released at rest; at θ = 0: …
    (
        r"\A(\s*(?:[a-z ]+ )?(?:released|let go|starts?|started|dropped)(?:\s+from|\s+at)\s+rest)\s*;\s*(?=(?:at|when|where)\b[^:]*:)",
        r"\1, ",
    ),
    # off the bottom: …
    (r"\A\s*off the ([a-z]+)(?=\s*:(?!=))", r"while it is off the \1"),
    (r"\A\s*\\text\s*\{\s*off the ([a-z]+)\s*:\s*\}", r"while it is off the \1: "),
    # For M = 0 and small φ: …
    (r"\A\s*[Ff]or\s+([^:,=]{1,12}=[^:,=]+?)\s+and\s+(?:for\s+)?small\s+(?=[^:=]*:)", r"if \1, for small "),
    (r"\b(?:[Ii]n\s+the\s+)?[Ll]imit\s+(?=\$?\\?[^\W\d]\w*\$?\s*(?:→|->|\\to\b))", ""),
    (r"\A([a-z]+\s+just\s+[a-z]+s)\.\s+(?=[a-z]+:)", r"\1, "),  # weight just lands. energy: …
    (r"\A\s*(?:\([a-z]\)\s*)?[A-Z][^?=:]*\?\s+(?=[A-Z])", ""),  # Does the rope stay taut? For …
    (r"\A\s*([^\W\d]\w*\s*=\s*[^\W\d]\w*)\s*:(?!=)\s*(?=[^:=]+=)", r"when \1: "),  # y = h: …
    # let go at rest from y₀, θ = 0: …
    (
        r"\b(?:let\s+go|released|dropped|set\s+free)\s+(?:at|from)\s+rest\s+(?:from|at|in|where)\s+(?:\$?\\?[^\W\d]\w*\$?,\s*)?(?=[^:]*=[^:]*:(?!=))",
        "released from rest at ",
    ),
    *((rf"(?i)\A\s*(?:{words})\s+(?=[^:\n]*:(?!=))", f"{word} ") for word, words in _ABROAD.items()),
    # At the end, when both are at rest, …
    (
        r"\A\s*[Aa]t\s+the\s+end,?\s+(?:when|where|once)\s+(?:both|all|they|it|everything)\s+(?:is|are|has|have)\s+(?:come\s+to|at)\s+rest\b",
        "once it has come to rest",
    ),
    (r"\A\s*constant,?\s+(if\b[^:\n]*?)\s*:(?!=)\s*", r"\1: constant: "),
    # … with tan φ = c ω/(k − m ω²), of a phase
    (
        r"(\b(?:with|where|and)\s+)\\?tan\s*\\?\(?\s*([^\W\d]\w*)\)?\s*=\s*([^=,;]+?)\s*/\s*(\((?:[^()]|\([^()]*\))*\)|[^\s()]+)\s*\Z",
        r"\1\2 = atan2(\3, \4)",
    ),
    # no outer force → …
    (r"\A(?=[^=<>:;\n]*\b[a-z]{2,}\s+[a-z]{2,}\b)([^=<>:;\n→]*[^=<>:;\n→\s])\s*→(?!\s*(?:0|∞|inf))\s*(?=[^:;\n]*=)", r"\1: "),
    # the period is T = …, swings with the period T = …
    (
        r"\A\s*((?:[Aa]fter|[Ww]hile|[Aa]s long as|[Ww]hen|[Oo]nce|[Ff]or)\b[^:=]*?),?\s+(?:(?:the|its)\s+)?(?:(?:[a-z]+\s+)*?with\s+(?:the|a)\s+)?period"
        r"(?:\s+of\s+[a-z ]+?)?\s+(?:is\s+|becomes\s+)?\$?(?:T|τ|\\tau)\s*=(?=[^=:]+\Z)",
        r"\1: period: ",
    ),
    # B and C go apart; after the impact …
    (r"\A(?=[A-Z][^=<>:;\n]*\b[a-z]{3,}\s+[a-z]{3,}\b)[^=<>:;\n\\]*;\s*(?=[^;\n]*=)", ""),
    (r"\}\s*\\[;,:!]\s*(?=\d)", r"} \\cdot "),  # \frac{m}{M}\;2k
    # N = 0 where cos θ = 2/3: a function alone gets no name
    (r"\bwhere\s+(?=\$?\s*\\?(?:sin|cos|tan)(?![a-z])[^=:;\n]*=[^=:;\n]*\Z)", "when "),
)
"""What is written, and what is read for it, one after the other."""
_SLOPE = re.compile(
    rf"\\[dt]?frac\s*\{{\s*d\s*\^\s*\{{?2\}}?\s*{_NAME}\s*\}}\s*\{{\s*d\s*{_NAME}\s*\^\s*\{{?2\}}?\s*\}}"
    rf"|(?<![\w\\])d(?:²|\^2)\s*{_NAME}\s*/\s*d\s*{_NAME}(?:²|\^2)"
)
"""``d²u/dθ²``, of which t is read elsewhere."""
_OF_SQUARE = rf"({_LETTER}\s*(?:²|\^\s*\{{?2\}}?))"
_IN_BRACKETS = r"(?:\\left)?[(\[]((?:[^()\[\]]|\([^()]*\))*?)(?:\\right)?[)\]]"
_BY_PLACE = (
    rf"\\[dt]?frac\s*\{{\s*d\s*(?:{_IN_BRACKETS}|{_OF_SQUARE})\s*\}}\s*\{{\s*d\s*{_NAME}\s*\}}()",
    rf"(?<![\w\\])d\s*(?:{_IN_BRACKETS}|{_OF_SQUARE})\s*/\s*d\s*{_NAME}(?![\w(\[])()",
    rf"()()\\[dt]?frac\s*\{{\s*d\s*\}}\s*\{{\s*d\s*{_NAME}\s*\}}\s*{_IN_BRACKETS}",
    rf"()()(?<![\w\\])d\s*/\s*d\s*{_NAME}\s*{_IN_BRACKETS}",
)
"""``d(v²)/dθ``, ``d/dx(½ m v²)``, of which t is read elsewhere: what is differentiated, and by which place."""
_LESS = r"(?:<=|>=|[<>≤≥]|\\(?:leq?|geq?|lt|gt)(?![a-z]))"
_IN_LABEL = (
    re.compile(rf"\(([^()=:]*{_LESS}[^()=:]*)\)"),
    re.compile(rf"(?:\A|[,;])\s*((?:(?!{_LESS})[^,;()=:])+{_LESS}[^,;()=:]*)\Z"),
)
"""``on the ice (x > 0):``, ``energy, x < 0:``."""
_SAYS_WHEN = re.compile(r"\s*(?:if|when|for|while|until|once|as|given|limit|only)\b")
_LONG_WORD = re.compile(r"(?<![\\A-Za-z])(?!sin|cos|tan|sqrt)[A-Za-z]{3,}")


def usual(text: str) -> str:
    """A statement in the ways of writing that are read."""
    for written, read in _PUT:
        text = re.sub(written, read, text)
    text = _ranged(text)
    for written in _BY_PLACE:
        text = re.sub(written, _by_place, text)
    return _SLOPE.sub(_slope, text)


def _ranged(text: str) -> str:
    """A statement with the range that its label gives, ``0 < s < l:``, as a condition."""
    label, colon, said = text.partition(":")
    if not colon or said.startswith("=") or _SAYS_WHEN.match(label) or re.search(r"(?<![<>])=", label):
        return text
    plain = label.replace("$", "").strip()
    found = next((found for pattern in _IN_LABEL if (found := pattern.search(plain))), None)
    if found is None or _LONG_WORD.search(found[1]):
        return text
    signs, sides = re.findall(_LESS, found[1]), [side.strip() for side in re.split(_LESS, found[1])]
    if not all(sides):
        return text
    parts = (f"{one} {sign} {other}" for one, sign, other in zip(sides[:-1], signs, sides[1:], strict=True))
    others = f"{plain[: found.start()]}{plain[found.end() :]}".strip(" ,;")
    return f"if {', '.join(parts)}: {f'{others}:' if others else ''}{said}"


def _by_place(found: re.Match[str]) -> str:
    """A derivative by what moves, as rates have it."""
    inner, square, by, behind = found.groups()
    return found[0] if by == "t" else f"((d/dt({inner or square or behind}))/{by}')"


def _slope(found: re.Match[str]) -> str:
    """The second derivative by what moves, as rates have it."""
    of, by = (name for name in found.groups() if name is not None)
    if by == "t":
        return found[0]
    return f"(({of}'' {by}' − {of}' {by}'')/({by}')^3)"
