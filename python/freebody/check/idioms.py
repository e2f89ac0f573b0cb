"""Ways of writing that are put into others before a statement is read: labels and conditions in brackets, conditions of other languages,
second slopes."""

from __future__ import annotations

import re
from collections.abc import Callable

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
_LETTER = r"\\?[A-Za-zα-ωΑ-Ω]+(?:_\w+)?"
_NAME = rf"({_LETTER})"
_FROM_REST = r"(?:(?:starting|released)\s+)?from\s+rest"
_RATE = r"(?:\\d*dot\s*\{?\\?\w+\}?|[^\W\d]\w*(?:['′″]+|[\u0307\u0308]\w*))"
_SUM = r"\$?(?:Σ|∑|\\Sigma|\\sum)"
_PUT: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"\$([A-Za-z])\$(?=\s+[a-z]{3,})", r"\1"),  # at the moment $B$ begins to slip
    (r"(?<==)([^=→\n:]*[^=→\n:\s])\s+→\s+(?=[^=→:\n]+=)", r"\1 ⇒ "),  # v = r ω → v² = r² ω²
    # let go at rest from y₀, θ = 0: …
    (
        r"\b(?:let\s+go|released|dropped|set\s+free)\s+(?:at|from)\s+rest\s+(?:from|at|in|where)\s+(?:\$?\\?[^\W\d]\w*\$?,\s*)?(?=[^:]*=[^:]*:(?!=))",
        "released from rest at ",
    ),
    (r"\A\s*(?:for\s+)?small\s+(?:vibrations|oscillations|motions|swings),?\s+(?=natural\s+(?:circular\s+)?frequenc)", ""),
    # ψ' < 0, ΣM_D: …, in equilibrium, ΣM_A = 0: …
    (rf"\A([^:\n]*[<>=≤≥][^:\n]*?),\s*{_SUM}[^,:=<>]*(?:=\s*0\s*)?:(?!=)", r"\1:"),
    (rf"\A([^:=\n]*,\s*{_SUM}[^,:=<>]*)=\s*0\s*:(?!=)", r"\1:"),
    (rf"\A\s*(\$?(?:{_RATE}\s*=\s*)+0\$?)\s*:(?!=)", r"when \1:"),  # φ' = φ'' = 0: …
    # heels on the verge of lifting, N = 0: …
    (
        rf"\A\s*(?!(?:{CONDITION})\b|[^:]*\b(?:released|let\s+go|dropped|start\w*|from\s+rest)\b)[A-Za-z][^=:;,\n]*?\b[a-z]{{3}}[^=:;,\n]*,\s+(\$?\\?[^\W\d]\w*\s*=\s*(?:0|[\d.]+\s*°|[\d.]*\s*(?:π|\\pi)(?:/\d)?)\$?)\s*:(?!=)",
        r"when \1:",
    ),
    (r"=\s*(?:\\(?:text|mathrm)\s*\{\s*)?const(?:ant)?\.?\s*\}?\s*(?==)", ""),  # ω = const = v/r
    *((rf"(?i)\A\s*(?:{words})\s+(?=[^:\n]*:(?!=))", f"{word} ") for word, words in _ABROAD.items()),
    (r"\A\s*\\(?:text|textrm|mbox|mathrm)\s*\{([^{}:=]+):\s*\}\s*", r"\1: "),  # \text{plank + spool: } …
    # at θ = 0, just after release: …
    (
        r"\A\s*(?:at|when|for)\s+([^:,=]+=[^:,=]+),\s+(?:just|right|immediately)\s+(?:after|at|upon)\s+(?:the\s+)?(?:release|start)\s*:(?!=)",
        r"at the start, \1:",
    ),
    # after half a turn (θ = π): …
    (r"\A\s*after\s+(?:a|an|one|half|two|three|\d+)\b[^:()=]*\(([^():]*=[^():]*)\)\s*:(?!=)", r"when \1:"),
    # let go at β = 0: what is let go is at rest
    (
        r"\A([^:=]*\b(?:released|let\s+go|dropped|set\s+free))\s+(?:at|from|where|in)\s+(?=[^\s:=]+\s*=[^:=]*:(?!=))",
        r"\1 from rest at ",
    ),
    (r"\A\s*after\s+(?:a\s+|the\s+)?(?:time\s+)?t\s+from\s+rest\s*:(?!=)", "from rest:"),
    # small, from equilibrium: …
    (
        r"\A\s*small,?\s+(?:from|about|near)\s+(?:the\s+)?(?:static\s+)?(?:equilibrium|rest)(?:\s+position)?\s*:(?!=)",
        "for small motions:",
    ),
    # (shoe B, moments about the pin)  F c = …
    (r"\A\s*\(((?=[^()]*\b[a-z]{4})[A-Za-z]+(?:[\s,']+[A-Za-z]+)+)\)\s+(?=[^\s:])", r"\1: "),
    # jaws together (after the blow): …
    (
        rf"\A\s*(?!(?:{CONDITION})\b)[A-Za-z][^=:;\n()]*"
        r"\(((?:(?:just|right)\s+)?(?:after|before|while|until|when|once)\s[^()=<>:]+)\)\s*:(?!=)",
        r"\1:",
    ),
    # after the first blow, before the second: …
    (r"\A(\s*(?:just\s+)?after\b[^:=\n]*?),?\s+(?:and\s+)?before\s+(?:the\s+)?(?:second|next|third)\b[^:=,\n]*(?=[:,])", r"\1"),
    # right after the release (θ = θ_0, θ' = 0): where it starts so
    (
        r"\A(\s*(?:(?:just|right|immediately)\s+(?:after|at)|at)\s+(?:the\s+)?(?:release|start|beginning)(?:\s+from\s+rest)?)"
        r"\s*\([^():]*=[^():]*\)(?=\s*:)",
        r"\1",
    ),
    (r"\A\s*constant,?\s+(if\b[^:\n]*?)\s*:(?!=)\s*", r"\1: constant: "),
    # as seen from the cage, until it lands: …
    (rf"\A\s*(?:as\s+)?(?:seen|viewed|measured)\s+(?:from|in|by)\s+[^,:=]+,\s+(?=(?:{CONDITION})\b[^:]*:)", ""),
    # bounce (1 just before, 2 just after): …
    (r"\s*\((?:index(?:es)?\s+)?1:?\s[^()]*\bbefore\b[^()]*\b2:?\s[^()]*\bafter\b[^()]*\)(?=\s*:)", ""),
    (r"\A[^:=]*?\b(?:from\s+)?(t_?[1₁])\s+to\s+(t_?[2₂])\s*:(?!=)", r"from \1 to \2:"),
    # … with tan φ = c ω/(k − m ω²), of a phase
    (
        r"(\b(?:with|where|and)\s+)\\?tan\s*\\?\(?\s*([^\W\d]\w*)\)?\s*=\s*([^=,;]+?)\s*/\s*(\((?:[^()]|\([^()]*\))*\)|[^\s()]+)\s*\Z",
        r"\1\2 = atan2(\3, \4)",
    ),
    (rf"\A(\s*{_FROM_REST}),\s*[$TUVWE_{{}}()\d₁₂→\\to+−=\s-]+:(?!=)", r"\1:"),  # from rest, T_1 + U_{1→2} = T_2: …
    (rf"\A\s*([^:=]+?),\s*({_FROM_REST})\s*:(?!=)", r"\2: \1:"),  # left pinion, angular impulse, from rest: …
    (r"\A\s*for\s+an\s+(?=observer\b[^:=]*:)", ""),
    (r"\A\s*(?:both\s+)?before\s+[^:=]*?\band\s+after\s+(?:it|that)\s*:(?!=)", ""),
    # h = 0 for the first time at t = …
    (r"\A\s*([^:=]+=[^:=]+?)\s+(?:for the first time|first|again)\s+at\s+(\$?t\s*=[^:]+)\Z", r"when \1, from the start: \2"),
    # recovery (handle free): the name of a stretch
    (
        r"\A\s*(?:the\s+)?((?:recovery|coasting|rebound|(?:free\s+)?flight|(?:second|next|later|last|final)\s+(?:phase|stage|part|stretch|stroke))"
        r"(?:\s+(?:of|on|with|by)\s+[a-z ]+)?)\s*(?:\([^()=]*\)\s*)?(?=[:,](?!=))",
        r"during \1",
    ),
    # link locked (θ = 0, d = 0)
    (r"\b(held|locked|fixed|clamped|blocked)\s*\(([^()=,:]+=[^()=,:]+),\s*([^():]+=[^():]+)\)(?=[^:=]*:)", r"\1 (\2), \3"),
    # bolt in flight, ΣF_r: …
    (
        rf"\A\s*(?!(?:{CONDITION})\b)((?:the\s+)?[A-Za-z]+)\s+(in\s+(?:the\s+)?(?:flight|air)|off\s+the\s+[a-z]+|airborne)\s*(?=[,:](?!=))",
        r"while \1 is \2",
    ),
    # pure bounce has the period T = …
    (
        r"([a-z]+(?:\s+[a-z]+){0,3})\s+(?:has|have)\s+(?:the|a)\s+(?:natural\s+|circular\s+)*(?:period|frequency)\s+(?=\S+\s*=)",
        r"\1: ",
    ),
    # if k₁ a = k₂ b the car pitches by itself: …
    (r"\A(\s*(?:if|when|for)\s+[^:,=]+=[^:,=]+?)\s+(?=the\s+[a-z]+\s+[a-z]{3,}[^:=]*:(?!=))", r"\1, "),
    # cord still whole: …
    (
        r"\A\s*(?:with\s+|while\s+)?(?:the\s+)?([a-z]+)\s+(?:is\s+)?(?:still\s+)?(?:whole|intact|uncut|unbroken)\s*(?=[,:](?!=))",
        r"before the \1 is cut",
    ),
    # rolling (x' = r ω): the stretch, and no moment at which it is so
    (r"\A\s*(?:pure\s+)?(rolling|rolls|sliding|slides|slipping|slips)\s*\([^():=]+=[^():]+\)\s*:(?!=)", r"while \1:"),
    # v_A and v_B along AB: …
    (
        rf"\A(?!\s*(?:{CONDITION})\b)(?=[^:=<>]*\b(?:along|across|normal\s+to|perpendicular\s+to)\b)[^:=<>\n]*\\[^:=<>\n]*:(?!=)",
        "",
    ),
    # natural frequencies for c = 0: …
    (
        r"\A\s*(?:the\s+)?natural\s+(?:circular\s+)?frequencies,?\s+(?:for\s+|with\s+|if\s+|when\s+)?([^\s:=,]+\s*=\s*[^:,=]+?)\s*:(?!=)",
        r"if \1: natural frequencies:",
    ),
    # Tarzan just before the pickup, ΣF_y: …
    (
        rf"\A\s*(?!(?:{CONDITION})\b)(?:the\s+)?[A-Za-z]+\s+((?:just|right|immediately)\s+(?:before|after)\s+[^:,=]+)(?=[,:](?!=))",
        r"\1",
    ),
    # at the highest point after the first jerk: …
    (r"\A\s*(at\s+(?:the|its)\s+[a-z]+\s+(?:point|position|place))\s+(after\s+[^:,=]+?)\s*(?=[,:](?!=))", r"\2, \1"),
    (r"\A\s*(?:as\s+a\s+)?[Ss]pecial\s+case,?\s+(?=[^:]*=[^:]*:(?!=))", "if "),
    # no outer force → …
    (r"\A(?=[^=<>:;\n]*\b[a-z]{2,}\s+[a-z]{2,}\b)[^=<>:;\n→]*→\s*(?=[^:;\n]*=)", ""),
    # Solving both equations, …
    (r"\A\s*(?:Solving|Using|Eliminating|Substituting|Combining|Inserting)\b[^=:;\n]*?,\s+(?=[^;\n]*=)", ""),
    # B and C go apart; after the impact …
    (r"\A(?=[A-Z][^=<>:;\n]*\b[a-z]{3,}\s+[a-z]{3,}\b)[^=<>:;\n\\]*;\s*(?=[^;\n]*=)", ""),
    # skidding: the friction eats energy, T' = …
    (r":\s+(?:the\s+)?[a-z]+(?:\s+[a-z]{2,}){1,6},\s+(?=\S+\s*=)", ": "),
    (r",?\s+(?:the whole time|all the time|throughout)\s*\Z", ""),
    (r"\}\s*\\[;,:!]\s*(?=\d)", r"} \\cdot "),  # \frac{m}{M}\;2k
    # hand off, gate coming down: …
    (
        r"\A([^:=]*,\s*)?(?:the\s+)?([a-z]+)\s+(?:sliding|coming|going|moving|falling|sinking|climbing|rising)\s+(?:back\s+)?"
        r"(up|down|to\s+the\s+left|to\s+the\s+right)(?:wards?|hill)?\s*(?=[,:](?!=))",
        r"\1while \2 moves \3",
    ),
    # first turning point after the catch: …
    (r"\A\s*(?:at\s+)?(?:the\s+)?(?:first\s+)?turning\s+point\s+(after\s+[^:,=]+?)\s*(?=[,:](?!=))", r"\1, at the turning point"),
    # v_B has no part along PB, so …
    (
        r"\A(?=[^=<>:;\n]*\b[a-z]{2,}\s+[a-z]{2,}\b)[^=<>:;\n]*,\s+(?:so|hence|thus|therefore)\s+(?:that\s+)?(?:along\s+the\s+[a-z]+\s+)?(?=[^:\n]*=)",
        "",
    ),
    # right after the impact \dot\theta = …
    (
        r"(?i:\A\s*((?:(?:just|right|immediately)\s+)?(?:after|before|at|on|when|once|while))\s+)((?:[A-Za-z-]+\s+){0,6}[a-z-]{3,})\s+"
        r"(?=\$?\s*(?:\\(?!text|and\b|or\b)|[α-ωΑ-Ω½⅓¼⅔\d(]|[A-Za-z](?![a-z]))[^:\n]*=[^:\n]*\Z)",
        lambda found: f"{found[1].lower()} {found[2]}: ",
    ),
    # N = 0 where cos θ = 2/3: a function alone gets no name
    (r"\bwhere\s+(?=\$?\s*\\?(?:sin|cos|tan)(?![a-z])[^=:;\n]*=[^=:;\n]*\Z)", "when "),
    (r"(frequenc(?:y|ies))\s+of\s+the\s+\w+(?=\s+(?:with|when|if|for|where)\b)", r"\1"),
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
    found = next((found[1] for pattern in _IN_LABEL if (found := pattern.search(plain))), None)
    if found is None or _LONG_WORD.search(found):
        return text
    signs, sides = re.findall(_LESS, found), [side.strip() for side in re.split(_LESS, found)]
    if not all(sides):
        return text
    parts = (f"{one} {sign} {other}" for one, sign, other in zip(sides[:-1], signs, sides[1:], strict=True))
    return f"if {', '.join(parts)}:{said}"


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
