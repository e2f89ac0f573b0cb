"""Words around an equation that are no part of it: *Thus*, *the tension T = …*, *(i.e. to the left)*, *for all t*, *(2)*; *from rest* and
*with the given numbers* are conditions. What is passed over and might have been meant otherwise is told."""

from __future__ import annotations

import re
from collections.abc import Collection

from freebody.symbolic.alphabet import LATEX_WORDS
from freebody.symbolic.symbols import folded

from ..model.errors import ModelProblem
from ..model.names import nearest
from ..model.units import unit
from .clauses import arranged
from .idioms import usual
from .language.glyphs import CONDITION
from .language.tokens import CALLS
from .pieces import RATE
from .sentences import MUCH_LESS, is_of
from .wording import OF_WHAT

_MOVES = r"(?:start(?:s|ed|ing)?|released|let go|dropped|begin(?:s|ning)?|falls|falling|moves|moving)"
_FROM_REST = re.compile(
    rf"(?:\b(?:if|when|after)\s+)?(?:\b(?:it|they|(?:the )?\w+)\s+(?:is|was|are|were)\s+|\b(?:it|they)\s+|\bbeing\s+)?"
    rf"\b{_MOVES}\s+(?:from|at)\s+rest\b(?!\s*=)|(?:\A|(?<=[,:]\s))(?:if\s+)?from rest\b|\(from rest\)|(?<!release )\bfrom rest(?=\s*(?:[,:]|at\b|\Z))"
    r"|(?:\b(?:after|for|with|on)\s+)?\ba\s+start\s+from\s+rest\b",
    re.IGNORECASE,
)
_PLACE = r"[^\s=,():]+(?:\s*=\s*[^\s=,;():]+)+"
_REST_AT = re.compile(
    rf"\(?(if the start is at rest)\s+(?:at|with|where)\s+({_PLACE}(?:(?:,|\s+and)\s+{_PLACE}(?=\)|\s*[,:]))*)\)?"
)
"""``(starts from rest at x = 0)``, ``released from rest at θ = 90°, s = b:``."""
_REST_THERE = re.compile(r"(if the start is at rest)\s+(?:at|in|from)\s+\$?\\?[^\W\d]+_?\{?\d?[0₀]\}?\$?(?=\s*[:,])")
"""``released from rest at θ_0:``, where it starts."""
_THESE_NUMBERS = re.compile(
    r"\b(?:if\s+)?(?:with|for|using|at|from)\s+(?:the\s+|these\s+|our\s+|its\s+)?(?:given\s+|numerical\s+|above\s+)*"
    r"(?:numbers|data|values|parameters)(?:\s+given)?\b|\bnumerically\b",
    re.IGNORECASE,
)
_SENSES = {
    r"to the right": "→",
    r"to the left": "←",
    r"upwards?": "↑",
    r"downwards?": "↓",
    r"(?:counter|anti)-?clockwise|ccw": "↺",
    r"clockwise|cw": "↻",
}
_SENSE = {
    re.compile(rf"\s*,?\s*(\()?\b(?:{words})\b(?:\s*(?:\+|(?:is\s+)?positive))?(?(1)\))(?=\s*(?:[,;.]|$))", re.I): sign
    for words, sign in _SENSES.items()
}
_REMARK = re.compile(
    r"\s*\((?:i\.?\s?e\b|e\.?\s?g\b|that is|because|since|so|as|hence|thus|note|acting|by|from|see)\b[^()=]*\)(?=\s*(?:[,;.]|$))"
)
_NOTE = re.compile(
    r"(?<=\S)\s{2,}\((?![^()=]*\)|start|released|from|with|if|when|while|after|before|for|at\b|in\b)(?=[^()]*\b[a-z]{3,}\s+[a-z]{2,})[^()]*\)\s*\Z"
)
"""``… = I α   (AD = x; the friction goes through A)``: a note behind an equation, apart from it."""
_GOES_ON = r"taut|slack|touch\w*|slid\w*|slip\w*|roll\w*|stick\w*|flight|air|contact|mesh|closed|open|locked|held|rest|steady|equilibrium|small|(?:on|in)\s+the"
_STRETCH_BEHIND = re.compile(rf"(.*\S)\s{{2,}}\(((?=[^()]*\b(?:{_GOES_ON})\b)[a-z][^()=<>:]*)\)\s*", re.S)
"""``… = m s''   (belt taut, sliding forward)``."""
_STANDS_FOR = re.compile(r"(?<=\S)\s{2,}\((\\?[^\W\d]\w*\s*=\s*[^()=:;]{1,30})\)\s*\Z")
"""``J α = M   (α = θ'')``."""
_IN_LATEX = re.compile(
    r"(?<![_^{])\s*\\(?:text|textrm|mbox|mathrm)\s*\{\s*([,;(]?\s*[A-Za-z]+(?:[\s,'-]+[A-Za-z]+)*\s*[,.:]?\s*)\}(?!\s*[_^'])"
)
_OF_WHOM = re.compile(r"(?:\s*,|[\s~$\\,;(]*(?:\\Sigma|\\sum|[Σ∑]))[^=:\n]*:(?!=)|\s*:(?!=)")
"""What stands behind the name of a part in a label, ``\\text{vane}, \\Sigma F_r:``."""
_CONNECTIVES = {
    *(
        "and",
        "where",
        "with",
        "so",
        "that",
        "then",
        "thus",
        "hence",
        "therefore",
        "if",
        "when",
        "at",
        "for",
        "as",
        "or",
        "which",
        "gives",
    ),
    *("from", "rest", "start", "the", "we", "get", "have", "initially", "just", "after", "before", "starting", "released", "law"),
}
_THUS = re.compile(
    r"(?m)(?:^|(?<=[,;$])|(?<=\\\[))\s*(?:(?:so that|thus|hence|so|then|therefore|finally|consequently|also|now|or|(?:which |this )?gives"
    r"|(?:and )?(?:thus|hence|so|therefore|then)|we (?:get|have|find|obtain)"
    r"|it follows(?: that)?|i\.e\.|solving(?: for \S+)?|\d{1,2}[.)]|\(\d{1,2}\w?\)|•)[,:]?\s+)+",
    re.IGNORECASE,
)
_NOUN = (
    r"natural|circular|angular|linear|normal|tangential|radial|transverse|total|kinetic|potential|mechanical|acceleration|velocity|speed"
    r"|force|tension|friction|reaction|frequency|period|momentum|energy|moment|torque|inertia|radius|of|gyration|in|cord|rope|string"
    r"|cable|pin"
)
_CALLED = re.compile(
    rf"(?m)(?:(?<=^)|(?<=[,;:]\s))\s*(?:the\s+)?(initial\s+)?((?:(?:{_NOUN}|the)\s+)+)(?=\\?[^\s=<>]+\s*[=<>])", re.I
)
"""``the natural period T = …``."""
_DOTS = re.compile("(?<=[^\\W\\d])[¨˙]")
"""``x¨``, with dots that stand behind a letter."""
_SPACES = re.compile(r"(?<!\\)\\(?:[,;:!>]| (?![^{}]*\}))")
_BESIDE_A_MOMENT = str.maketrans("₋₊", "⁻⁺")
"""``v₋``, just before."""
_SIDE_OF_ZERO = re.compile(r"(=\s*0)\s*(?:\^?\s*\{?\s*\+\s*\}?|⁺)(?=\s*(?:[:,)]|\\q?quad|\Z))")
"""``t = 0⁺``, just after."""
_UPRIGHT = r"\s*(?:\\(?:mathrm|text|rm|mathsf)\s*)?"
_EXTREME = re.compile(
    rf"_(?:\{{{_UPRIGHT}\{{\s*\\?(max|min)\s*\}}\s*\}}|{_UPRIGHT}\{{{_UPRIGHT}\\?(max|min)\s*\}}|{_UPRIGHT}\\?(max|min)(?![A-Za-z]))"
)
"""``θ_max``, ``N_{\\max}``, ``v_{\\text{max}}``."""
_LIMITS = re.compile(r"∫_\(([^()]*)\)\^\(([^()]*)\)")
"""Limits of an integral in round brackets."""
_LIMITLESS = re.compile(r"(?:∫|\\int)(?!\s*(?:\\limits\s*)?[_^₀-₉])(?=[^=;\n]*\bd\s*t\b)(\s*)")
"""An integral over time without limits is one from the start."""
_OF_WHAT = re.compile(r"(?<=[\w)}²³])\s+(?:for|of) the [a-z]+(?: [a-z]+)*\s*\Z")
"""``… for the free end``."""
_WHERE_WHAT = re.compile(r",?\s+where\s+(?=[^=<>]*[A-Za-z]{3})[^=<>:]*\Z")
"""``…, where x, y is the place of the weight``."""
_TAIL = re.compile(
    rf"(?<=[\w)}}'′″²³])(?<![A-Za-z]{{2}})\s+(?:from(?!\s+rest)|of|for(?!\s+small)|to|by|along|across|through|under)\s+(?:(?!(?:{CONDITION})\b|from\b|on\b)[a-z]{{2,}}\s+)+[a-z]{{2,}}\s*\Z"
)
"""``f = −m x'' from the ground to be turned``."""
_AND_THERE = re.compile(
    r"(?:[,;]|[,;]?\s+and)\s+(?:at|for|on|of) the (?!start|end|moment|instant|same)[a-z]+[,:]?\s+(?=[^:=]*=[^:]*\Z)"
)
"""``… and at the lever P b = T_2 a``."""
_WAY = re.compile(r"(?<=[\w)}²°])\s+(?:down|up|along|towards?|across)\s+the\s+[a-z]+\s*\Z")
"""``a = 2.9 m/s² down the slope``."""
_AT_ONCE = re.compile(r"\A\s*(in\s+(?:static\s+)?equilibrium|at\s+rest|initially)\s+(?=[^\s:,=]+\s*=)(?![^=]*:)")
"""``in equilibrium x = m g/k``."""
_THEN = re.compile(r"(?m)^(\s*(?:if|when)\b[^:\n]*?),?\s+then\s+(?=[^:\n]*[=<>≈≤≥])")
_JUST_IT = re.compile(r"\b((?:just|immediately)\s+(?:after|before))\s+(?:it|that|this)\b(?!\s+[a-z]{2})[:,]?\s+")
_CAPITAL = re.compile(rf"\A\s*\$?(?:{CONDITION.title()}|Constant)\b")
"""A condition that begins a sentence."""
_FOLLOWS = re.compile(r"(?m)(^|[=≈][^<>\n]*?)\s*=+>")
"""``=>`` where no sign of relation can stand."""
_IN_WORDS = re.compile(
    r"(?:(?<=[:,])|\A)\s*(?:[A-Za-z]{3,}\s+){2,}(?:[A-Z]\w?\s+)?=\s*(?:[a-z]{3,}\s+)*[a-z]{3,}(?:\s+(?:about|of|at|on)\s+[A-Z]\w?)?\s*[,:]\s+(?=[^=]*=)"
)
"""``centrifugal moment about A = spring couple, …``."""
_SAYING = re.compile(r"\A\s*([A-Za-z]{2,}(?:[ ,-]+[A-Za-z]{2,})+)\s*(?:⇒|∴|\\(?:Rightarrow|implies|therefore)\b)")
_REASON = re.compile(
    rf"\A\s*(?!(?:{CONDITION})\b)((?:[A-Za-z]+[ ,'-]+){{2,}})(?<=,\s)(?:and\s+)?(?:so(?:\s+that)?|hence|thus|therefore)\s+(?=\S[^:]*[=<>])"
)
"""``no force acts along x, so p_x = const``."""
_CLOSES = r"(?=\s*(?:\$+|\\[\])]|\\end\s*\{[^{}]*\})?\s*(?:\Z|[;\n]|\\\\|⇒))"
"""The end of a line, behind which only its display is closed."""
_WHICH_POINT = re.compile(r"\A([^:=]*?)\(\s*[A-Z]\s*:\s*([A-Za-z\s]+)\)(?=[^:=]*:)")
"""``ΣM_A (A: contact):``."""
_STOP = re.compile(
    rf"\s*(?:\\q?quad\s*)?(?:(?<![.;,])[.;,!]|[□■∎✓✔]|\\(?:square|blacksquare|checkmark)|\bq\.?e\.?d\b\.?){_CLOSES}",
    re.IGNORECASE,
)
_EVER = (
    r"(?:\b(?:for|at)\s+(?:all|any|every|each)\s+(?:(?:time|instant|moment|angle|position|motion)s?\b|\\\w+|[A-Za-z]\w?\b|[^\W\x00-\x7f]\w*)(?:\s+(?:t\b|\\?theta\b|θ))?"
    r"(?:\s*(?:>=?|≥|\\geq?\b)\s*0)?|\balways|\bidentically|\ball the (?:way|time)|\b(?:throughout|during) the motion)"
)
_ALWAYS = re.compile(rf"(?:,|\\q?quad)?\s*{_EVER}{_CLOSES}|\A\s*{_EVER}(?:\s*[,:]|(?=\s))", re.IGNORECASE)
_BEHIND = r"(?<=[^\s=+*/·<>≈-])"
_NUMBER = re.compile(
    rf"{_BEHIND}\s+(?:\\q?quad\s*)?\((?:eq(?:uation|n)?\.?\s*)?(?:\d{{1,2}}[a-z]?|\*+|ii+|iv|vi+|[IVX]{{2,}})\){_CLOSES}"
)
_LETTER = re.compile(r"\A\s*(?:\([a-h]\)\s+(?=[\w\\$])|[a-h]\)\s+)")
_AS = r"as (?:expected|required|before|usual|given|shown|stated|above)"
_POINT = re.compile(r"(\b(?:about|point|through)\s+)\$([A-Z]\w?)\$")
"""``about $O$``, a name within words."""
_COMMENT = re.compile(
    rf"{_BEHIND}(?:\s*,(?:(?!\s*(?:{CONDITION})\b)|(?=\s*{_AS}\b))([^=<>≈≤≥,;:()\[\]+*/^\\$]+)"
    rf"|\s+[(\[]\s*(?:in\s)?\+?(\S+\s*(?:→|->)\s*\S+\s+[a-z][a-z ,'-]+|(?:[^()\[\]=<>≈≤≥+\\$]|\([^()]*\))+?)\+?\s*[)\]]){_CLOSES}"
)
"""Words behind an equation, after a comma or in brackets."""


def plainly(
    text: str, known: Collection[str] = (), fixed: Collection[str] = (), bodies: Collection[str] = ()
) -> tuple[str, tuple[str, ...]]:
    """A statement without words that say nothing of it, and with the conditions among them in the words of claims; names that are
    ``known`` are no words, those that are ``fixed`` have no place at the start, and ``bodies`` are what an equation may be of. And what is
    to be said of what was passed over."""
    passed: list[str] = []
    if (read := usual(text)) != text:
        passed.append(f"It is read as: {read.strip()}")

    def told(found: re.Match[str], what: str) -> str:
        passed.append(f"`{found[0].strip(' ,')}` is read as {what}.")
        return " "

    def at_start(found: re.Match[str]) -> str:
        chains = [re.split(r"\s*=\s*", place) for place in re.findall(_PLACE, found[2])]
        said = [(name if name in fixed else f"{name}_0", value) for *names, value in chains for name in names if name != "t"]
        return ", ".join([found[1], *(f"{name} = {value}" for name, value in said if folded(name) != folded(value))])

    def another(found: re.Match[str]) -> str:
        if "=" in found.string[: found.start()]:
            return f"\n{told(found, 'a remark, and not judged')}"
        return f", {told(found, 'a remark, and not judged')}" if "and" in found[0] else found[0]

    def comment(found: re.Match[str]) -> str:
        measured = said[: found.start()].strip()[-1].isdigit()  # 5 [m/s] is a measure
        words = found[1] or found[2]
        is_comment = "→" in words or _is_comment(words, known, measured)
        return told(found, "a remark, and not judged") if is_comment else found[0]

    def in_words(found: re.Match[str]) -> str:
        said = re.findall(r"[A-Za-z]{3,}", found[0])
        is_condition = re.match(CONDITION, found[0].lstrip()) is not None
        named = any(word in known or word in CALLS or word in LATEX_WORDS for word in said)
        return found[0] if is_condition or named else told(found, "a law in words, and not judged")

    said = _IN_LATEX.sub(_of_latex, _SPACES.sub("  ", _DOTS.sub(lambda found: "'" * (1 + (found[0] == "¨")), read))).lstrip()
    said = _POINT.sub(r"\1\2", said.translate(_BESIDE_A_MOMENT))
    said = _CAPITAL.sub(lambda found: found[0].lower(), _SIDE_OF_ZERO.sub(r"\1", said))
    said = _EXTREME.sub(lambda found: f"_{{{found[1] or found[2] or found[3]}}}", said)
    said = _LIMITS.sub(r"∫_{\1}^{\2}", said)
    said = _LIMITLESS.sub(lambda found: f"∫_0^t {found[1]}", said)
    said = MUCH_LESS.sub(r"small \1", said)
    said = _THEN.sub(r"\1: ", _JUST_IT.sub(r"\1: ", said))
    said = _AT_ONCE.sub(r"\1: ", _WAY.sub(lambda found: told(found, "a remark, and not judged"), said))
    said = _WHERE_WHAT.sub(lambda found: told(found, "a remark, and not judged"), said)
    said = _AND_THERE.sub(another, said)
    said = _STRETCH_BEHIND.sub(r"\2: \1", _STANDS_FOR.sub(r" with \1", said))
    said = _NOTE.sub(lambda found: told(found, "a remark, and not judged"), said)
    said = _OF_WHAT.sub(lambda found: told(found, "a remark, and not judged"), said)
    said = _REST_AT.sub(at_start, _REST_THERE.sub(r"\1", _FROM_REST.sub("if the start is at rest", said)))
    said = _THESE_NUMBERS.sub("if with these numbers", said)
    said = _WHICH_POINT.sub(r"\1", _REMARK.sub("", said))
    for sense, sign in _SENSE.items():
        said = sense.sub(f" {sign}", said)
    said = _ALWAYS.sub(" ", _STOP.sub("", _FOLLOWS.sub(r"\1 ⇒", said)))
    said = _NUMBER.sub(lambda found: told(found, "the number of the equation"), said)
    said = _STOP.sub("", _COMMENT.sub(comment, said))
    said = _TAIL.sub(lambda found: told(found, "a remark, and not judged"), said)
    said = _IN_WORDS.sub(in_words, said)
    said = _SAYING.sub(
        lambda found: f"{found[1]}: " if re.match(CONDITION, found[1]) else told(found, "a remark, and not judged"), said
    )
    said = _REASON.sub(lambda found: told(found, "a remark, and not judged"), said)
    said = _LETTER.sub(lambda found: told(found, "the letter of a question"), said)
    said = _THUS.sub(lambda found: found[0] if {*re.findall(r"\w+", found[0])} & {*known} else " ", said)
    said = _CALLED.sub(lambda found: found[0] if {*found[2].split()} & {*known} else "initially: " * bool(found[1]), said)
    return arranged(_given_first(said, fixed), known, OF_WHAT, bodies), tuple(passed)


def _given_first(text: str, fixed: Collection[str]) -> str:
    """A statement with what its label says of parameters alone as its condition: ``period of small swings, p n = M a: τ = …``."""
    label, colon, said = text.rpartition(":")
    parts = [part.strip(" $") for part in label.split(",")]
    given = [part for part in parts[1:] if part.count("=") == 1 and is_of(part, fixed)]
    if not given or "=" in parts[0] or re.match(CONDITION, parts[0]):
        return text
    others = ", ".join(part for part in parts if part not in given)
    return f"if {', '.join(given)}: {others}{colon}{said}"


def _is_comment(words: str, known: Collection[str], measured: bool) -> bool:
    """Whether what stands behind an equation, or a figure that is ``measured``, is words: one of them at least, and none nearly a name that
    is known; or the unit of a formula."""
    if any(sign.isalpha() and not sign.isascii() for sign in words) or "/dt" in words:
        return False
    if _is_unit(words) and words not in known:
        return not measured
    found = (
        [word for word in re.findall(r"[^\W\d_]{3,}", words) if word.isalpha()] if not re.search(r"[*/^·×_-]|\.\w", words) else []
    )
    return any(word not in CALLS for word in found) and not any(
        RATE.sub("", word) in known
        or nearest(folded(word), map(folded, known))
        or word in CALLS
        or word.lower().startswith("const")
        for word in found
        if word not in _CONNECTIVES
    )


def _is_unit(words: str) -> bool:
    try:
        return bool(unit(words))
    except ModelProblem:
        return False


def _of_latex(found: re.Match[str]) -> str:
    """Words that are set upright in LaTeX, if they are several or join what stands around them: ``\\text{while } C \\text{ rests}``."""
    words = re.findall("[A-Za-z]+", found[1])
    several = len(words) > 1 or found[1][-1] in ",.: " or _OF_WHOM.match(found.string, found.end())
    return f" {found[1]} " if several or {*words} <= _CONNECTIVES else found[0]
