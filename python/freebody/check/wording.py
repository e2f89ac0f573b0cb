"""Claims in the words of exercise sheets, put into the forms that ``claims`` judges: ``as k → 0, a = g sin β`` is
``limit: a = g sin β as k -> 0``."""

from __future__ import annotations

import re

from .language.glyphs import CONDITION

INSTANT = r"(?:just|immediately|right|shortly|directly)\s+"
_STARTS = rf"(?:{INSTANT})?(?:after|before)|at|when|once|if|for|(?:as|so) long as|as|given(?: that)?|provided(?: that)?|assuming(?: that)?|in the limit(?: (?:as|of|where|when))?|in(?=\s+(?:static\s+)?equilibrium)|initially"
_SINCE = r"from(?=\s+(?:the\s+)?(?:start|beginning)\b)"
_WHILE = r"while|during|until|between(?=\s+(?:\w+\s+)?\w+s\s*[:,])"
_BEFORE = re.compile(rf"({_STARTS}|{_SINCE}|with|without|in|on|{_WHILE})\b((?:(?!:=)[^:;\n])*?)\s*:(?!=)\s*(.+)", re.S)
_LABELLED = re.compile(
    rf"\A(?!\s*(?:{_STARTS}|{_SINCE}|with|in|on|{_WHILE}|only|same)\b)(?:(?:[^=<>:;,\n]*[,:]\s*){{1,3}}?(?=(?:{_STARTS}|{_WHILE}|small|with(?=[^:;\n]*=))\b[^:;\n]*:(?!=))"
    rf"|[^=<>:;,()\n]*\s(?=(?:{_STARTS}|with)\s[^:;\n]*[=<>][^:;\n]*:(?!=)))(?<!\A)"
)
"""``energy, at θ = 0:``, ``the mode with y_1 = y_2:``."""
_ASIDE = re.compile(r"\s+\(((?=[^()]*[A-Za-z]{3})(?![^()]*\b(?:sin|cos|tan|sqrt)\b)[^()=<>≤≥→]*)\)")
"""``at t = 0 (at rest, beam level)``."""
_FREQUENCIES = re.compile(
    r"(?:,?\s*\b(?:for|the))*\s*\b(?:(?:natural\s+)(?:circular\s+|angular\s+)?frequenc(?:y|ies)|(?:frequency|characteristic)\s+equation)(?:\s+(?:ω|\\?omega)\w*)?\s*(?:,|\Z)",
    re.IGNORECASE,
)
DOING = re.compile(
    r"\b(?!(?:ring|string|spring|bearing|during|being|using|taking|considering|reduced|combined)\b)[a-z]{2,}(?:ing|ed)\b"
)
"""Words of what something does."""
BLOW = "impact|collision|bounce|rebound|hit|strike|struck|blow|knock|shock|bump|jerk|catch"
LASTS = re.compile(
    r"(?:while|until|during|between|(?:as|so) long as)\b(?! at rest)|in (?:the )?(?:free )?(?:flight|air)\b|(?:\w+\s+)?hanging\b(?! still)"
)
"""``while it slips``: words of a stretch of the motion."""
_GOES_ON = re.compile(r"(?:it|he|she|they|(?:the|both|all)\s+\w+)\s+[a-z]+(?!.*(?:->|=))")
"""``as it slides down:``."""
_AT_ONCE = re.compile(
    r"\b(?:leaves?|hits?|strikes?|touch(?:es)?|lands?|reach(?:es)?|pass(?:es)?|meets?|clears?|lets?\s+go|begins?|starts?|loses?)\b"
)
"""``as the coin leaves``: a moment."""
_ELSEWHERE = r"\b(?:top|inverted|highest|upside)\b"
"""In words of a place where no model is of which nothing is said."""
_SMALL_MOTIONS = r"small (?:oscillations?|vibrations?|angles?|amplitudes?|motions?|displacements?|swings?)"
_WORDS = re.compile(r"[\w\s'-]+")
IN_WORDS = re.compile(r"(?=.*[A-Za-z]{3})[\w\s'-]+")
"""Words alone."""
_WITHOUT = re.compile(
    r",?\s*\b(?:(?:without|neglecting|ignoring|(?:if|when)\s+there\s+(?:is|were)\s+no)\s+(?:the\s+|any\s+|all\s+)?"
    r"(?:damp(?:ers?|ing)|dashpots?|(friction))|undamped|(frictionless))\b(?!\s*\(|\s+and\b),?\s*"
)
_LAWS = "rule|law|momentum|energy|impulse|moments?|forces?|work|power|equations?|balance|component|direction|radial(?:ly)?|tangential(?:ly)?|normal"
THINGS = (
    "(?:rod|bar|beam|wheel|disk|disc|cylinder|drum|pulley|roller|gear|ring|hoop|ball|sphere|block|crate|cart|car|mass|weight|bob|arm"
    "|link|crank|slider|piston|plate|pendulum|particle|frame|body|system)(?:e?s)?|bodies|pulleys"
)
_STATES = "is|are|was|were|has|have|no|not|rest|zero|cut|taut|slack|light|heavy|massless|rigid|smooth|rough|constant|steady|small|large|alone"
"""Words that tell what a condition is, which is no label."""
_NAMED_PLACE = re.compile(r"([A-Za-z][A-Za-z\s-]*?)\s*\(([^()]*[=<>][^()]*)\)")
"""``at the bottom (θ = 90°)``."""
_PLUS_CONSTANT = re.compile(r"([^=:;\n]+)=\s*const(?:ant)?\.?\s*([+−-])\s*([^=:;\n]+)")
"""``T = const + M θ``."""
_WITH_CONSTANT = re.compile(
    r"((?:[^=:;\n]*:\s*)?)([^=:;\n]+)=\s*([^=:;\n]+?)\s*[+−-]\s*(?:\\(?:text|mathrm)\s*\{\s*const(?:ant)?\.?\s*\}|const(?:ant)?\b\.?)\s*"
)
"""``V = -m g y + const``."""
_UNIFORM = re.compile(
    r"(?:moving\s+)?(?:(?:at|with|for|in)\s+)?(?:an?\s+)?(?:constant|steady|uniform)\s+(?:speeds?|velocit(?:y|ies)|motion)|(?:moving\s+)?uniformly"
)
_SYMBOL = r"(?:\\[A-Za-z]+|[^\W\d])(?:_?\{?\w\}?)?'{0,2}"
_SMALL = re.compile(
    rf"(?:\A\s*|(?<=,)\s*)(?:(?:for|with|at)\s+)?small\s+({_SYMBOL}(?:(?:(?:\s*,\s*(?:and\s+)?|\s+and\s+){_SYMBOL})*|(?:\s*=\s*[-+−]?\s*{_SYMBOL})+))\s*(?=:(?!=)|,\s*(?:{CONDITION})\b)"
)
"""``small θ:``, ``for small φ and s, if φ = 0:``, ``small y_1 = y_2:``; a small block is no angle."""
_WHICH_MODE = re.compile(
    r"\s*(?:the\s+)?(?:(first|lower|lowest|fundamental)|(second|upper|higher))\s+(?:(?:natural|normal|circular)\s+)*(?:mode|frequency)(?:\s+of\s+vibration)?\s*"
)
_GIVEN_IN_WORDS = re.compile(
    rf"\A(?!\s*(?:{CONDITION}|no (?=\w+ in))\b)\s*[A-Za-z][A-Za-z\s,'-]*\(([^():=]+=[^():]+)\)\s*(?=[,:](?!=))"
)
"""``engine off, no damping (Q = 0, c = 0):``."""
_FREQUENCY = re.compile(
    r"\A(?:the )?(?:natural (?:circular )?frequenc(?:y|ies)|(?:[Ff]requency|[Cc]haracteristic) equation):(?=.*(?:ω|\\?omega))"
)
"""Behind it ω is one of several."""
_OF_SMALL = re.compile(rf"\s*(?:(?:for|with|at)\s+)?small\b(?!.*{_ELSEWHERE})")
_SMALL_FIRST = re.compile(rf"\A\s*(?={_SMALL_MOTIONS}\b[^:;\n]*:(?!=))")
OF_WHAT = re.compile(
    rf"\s*(?!(?:{CONDITION})\b)(?=(?:about|along|across)\b|(?:.*\s)?(?:{_LAWS}|{THINGS})\b)(?!.*\b(?:\w+(?:ed|ing)|{_STATES})\b)[A-Za-z][\w\s'–-]*"
)
"""``momentum along x``, ``both rods``: behind a condition a label."""
_THROUGHOUT = re.compile(r"\A(.+?)\s*=\s*(.+?)\s+(?:throughout|always|at all times|all the time)\Z")
_TENDING = re.compile(rf"\A\s*(?={_SYMBOL}\s*(?:→|⟶|->|\\(?:to|rightarrow)\b)\s*\S[^=:;\n]*:(?!=))")
"""``φ → 0:``."""
_SAID_OF_MOMENT = re.compile(rf"\A\s*([^\s=:;,]+)\s+({INSTANT}[^=:;\n]+?)\s*(=[^:;\n]+)\Z")
"""``E just after the impact = …``."""
_STILL_FIRST = re.compile(
    r"\A\s*(?:(?:(?:if|when|while)\s+)?(?:(?:it|all)\s+(?:is|hangs|stands)\s+)?(?:held|kept|hanging|standing|holding)\s+still"
    r"|(?:(?:for\s+it|if\s+it\s+is|so\s+that\s+it\s+(?:may|can)|in\s+order)\s+)?to\s+(?:hang|stay|stand|remain|hold|keep|be|sit|lie|rest|balance)"
    r"(?:\s+(?:it|still|steady|at\s+rest|in\s+equilibrium|in\s+balance|there|at\s+any\s+\S+|in\s+any\s+(?:place|position)))*)(?=\s*[:,])"
)
"""``held still:``, ``to stay at rest:``, ``to hang still at any θ:``."""
_BEHIND = re.compile(
    rf"([^:;\n]+?(?:[=<>≈≤≥→]|\\(?:to|approx|rightarrow)\b)[^:;\n]+?)[,.]?\s+((?:{_STARTS}|while|during|until)(?:\s[^:;\n]+)?)"
)
_HAPPENS_WHEN = re.compile(
    rf"(?!(?:{_STARTS})\b)((?:(?:the|an?)\s+)?(?:\w+\s+){{1,3}}?\w{{3,}}s(?:\s+(?:to\s+)?[a-z]+){{0,4}})\s+(?:when|where|if|at|as soon as)\s+([^:;\n]+=[^:;\n]+)"
)
"""``the block breaks loose when k x = μ m g``."""
_EXTREME_WHERE = re.compile(
    r"(?:(?:it|he|she|the \w+) (?:is|moves|goes) )?((?:fastest|slowest|(?:\w+ ){0,2}(?:greatest|largest|least|smallest|highest|lowest)(?: speed)?))\s+(?:when|where|at|if)\s+([^:;\n]+=[^:;\n]+)"
)
"""``fastest where c/s² = m g sin β``."""
_PARTS = re.compile(r",|\band\b")
_WHEN = re.compile(r"\s+(?:when|where|(?<![,\s]\s)while|with(?!\s+(?:the|both)\s+(?:\w+\s+)?\w+\s*(?:,|\Z)))\s+")
_SUM = re.compile(r"\s*(?:Σ|∑|\\Sigma|\\sum)")
_BESIDE = re.compile(rf"(?:{INSTANT})?(?:after|before)\s+(?!(?:the\s+)?(?:start|release))[^=]+")
_LIMIT = re.compile(r"\\?lim(?:its)?\s*_?\s*(?:\{([^{}]+)\}|\(([^()]+)\)|([^:\s]+\s*(?:→|->|\\to)\s*[^:\s]+):?)\s*(.+)", re.S)
_ARROW = re.compile(r"\s*(?:\\(?:to|rightarrow|longrightarrow)(?![A-Za-z])|→|⟶|->)\s*")
_NOTHING = re.compile(r"\A((?:Σ|∑|\\Sigma|\\sum|[Ss]um\b)[^:=;\n]*)=\s*0\s*:")
"""``ΣF_y = 0:``, a label."""
_CONSTANT_FIRST = re.compile(r"(?:const(?:ant)?|\\(?:text|mathrm)\s*\{\s*const(?:ant)?\s*\})\s*=\s*([^=:;\n]+)")
_INFINITY = re.compile(r"([-+]?)\s*(?:\\infty|∞|infinity)")
_START = re.compile(
    r"(?:t\s*=\s*0(?:\s*s)?|(?:the )?(?:(?:moment|instant|time) of )?(?:start|release(?: from \S+)?|beginning)|being released|it is released)"
)
_STEADY = re.compile(r"(?:(?:in|for|at)\s+)?(?:the\s+)?steady(?:[\s-]+state)?(?:\s+(?:motion|vibration|response|state))?")
_CONSTANT = re.compile(
    r"(?:(?:the\s+)?(?:(?:total|angular|linear|mechanical)\s+)*(?:sum|quantity|momentum|energy)\s+(?=[^\s=]))?(?:[^=:;\n]+=\s*)*((?:[^=:;\n]|\n(?=[ \t]))+?)\s*"
    r"(?:=\s*(?:\\(?:text|mathrm)\s*\{\s*)?const(?:ant)?\b\.?\}?|\b(?:is|are|stays?|remains?|keeps) (?:constant|conserved|unchanged|the same)\b\.?|\bdo(?:es)? not change\b\.?)"
    r"(?=\s*(?:[→←↑↓↺↻]|throughout)?\s*$|\s+where\b|\s+with\b)"
)
"""``E = T + V = const``, ``p is conserved``, ``H stays the same``."""
_UNCHANGING = re.compile("cons|same|chang")
_LABEL = re.compile(rf"(?:\A|(?<=:))(?!\s*(?:{CONDITION}|only|limit)\b)[^=:;\n]*:\s*(?=constant:)")
"""``energy: T + V = const``."""
_CONSTANT_WHEN = re.compile(
    rf"\s*(?:(?!(?:{CONDITION})\b)[A-Za-z][\w\s'-]*,\s*)?constant\s*((?:{_STARTS}|{_WHILE})\s[^=:;\n]*)?:(?!=)\s*(.+)",
    re.S,
)
"""``constant after the catch: …``, ``energy, constant: …``."""
_DISPLAYED = re.compile(r"\\(?:begin|end)\s*\{(?:equation|displaymath)\*?\}|\\notag\b|\$\$|(?<!\{)\$(?!\})|(?<!\\)\\[\[\]()]")
"""What sets one formula apart in LaTeX and Markdown."""
_GIVEN = re.compile(r"((?:[^\W\d][\w{}\\]*\s*=\s*[\d.]+[^=,:;\n]*(?:,\s*|\s+and\s+|(?=:)))+):(?!=)\s*(.+)", re.S)
_GIVEN_BEFORE_LABEL = re.compile(rf"\s*((?:{_SYMBOL}\s*=\s*[\d.]+(?:,\s*|\s+and\s+))+)([A-Za-z][\w\s'\\-]*:(?!=).+)", re.S)
"""``a = 0, c = 0, natural frequencies: …``."""
_GIVEN_FIRST = re.compile(
    rf"((?:[^\W\d][\w{{}}\\]*\s*=\s*\d+(?:\.\d+)?(?:\s+[A-Za-z°][^\s,;]*|°)?(?:\s*,\s*|\s+and\s+|\s*(?=;)))+);\s*((?:{_STARTS})\b.+)",
    re.S,
)
"""``m = 2 kg, r = 0.1 m: a = 3.2 m/s²``."""
_NUMBERED = re.compile(r"([^=:;\n]+)=([^=:;\n]+)")
_TWICE = {"1": re.compile(r"(?<=\w)_?\{?[1₁]\}?(?!\w)"), "2": re.compile(r"(?<=\w)_?\{?[2₂]\}?(?!\w)")}
_ENERGIES = re.compile(r"[\sTVUEK+=()_{}12₁₂]+")
_COMPONENT = re.compile(r"\(\s*((?:\\(?:vec|mathbf|bm)\s*)?\{?[av]\}?_\{?\w+\}?)\s*\)_\{?([txynr])\}?")
"""``(a_G)_t``, a component of a vector that has an index."""
_NAMED = {
    r"(?:the )?period(?: of (?:small )?(?:oscillations?|vibrations?))?": "period",
    r"(?:the )?(?:natural|circular|angular|natural circular|natural angular) frequency": "natural_frequency",
    r"frequency": "frequency",
}
_NAMED_VALUE = re.compile(r"([a-z ]+?)\s*(?::|\bis\b)\s*([^=:;\n]+)")
_AS_OMEGA = {"period": "period = {}", "natural_frequency": "ω = {}", "frequency": "ω = 2 π ({})"}
_FROM_TO = re.compile(
    r"(∫|\\int)(?![_^])([^=;\n]*?\bd\s*\\?\w+)\s+from\s+(?:\w+\s*=\s*)?(\S+)\s+to\s+(?:\w+\s*=\s*(?=\S+\s*=))?(\S+)"
)
_INSIDE = r"((?:[^()\[\]=:;\n]|[(\[][^()\[\]=:;\n]*[)\]])*)"
_DERIVATIVE = re.compile(rf"(?<![\w\\])d(²?)\s*[(\[]{_INSIDE}[)\]]\s*/\s*dt\1(?![\w²])")
_FRACTION = re.compile(rf"\\[dt]?frac\s*\{{\s*d\s*[(\[]{_INSIDE}[)\]]\s*\}}\s*\{{\s*dt\s*\}}")
"""``d(m v)/dt``, the derivative of what stands in brackets."""


def with_condition_first(text: str) -> str:
    """A statement with the condition that stands behind it before it, and what is said to be constant in the form of a claim."""
    said = _FROM_TO.sub(
        r"\1_{\3}^{\4}\2", _COMPONENT.sub(lambda found: _component(*found.groups()), _DISPLAYED.sub("", text).strip())
    )
    said = _NOTHING.sub(r"\1:", _FRACTION.sub(r"d/dt(\1)", _DERIVATIVE.sub(r"d\1/dt\1(\2)", said)))
    if said.startswith("limit:"):
        return said
    if found := _CONSTANT_WHEN.fullmatch(said):
        said = f"{found[1].strip()}: constant: {found[2]}" if found[1] else f"constant: {found[2]}"
    if found := _PLUS_CONSTANT.fullmatch(said):
        return f"constant: {found[1]} {'-' if found[2] == '+' else '+'} ({found[3]})"
    if found := _WITH_CONSTANT.fullmatch(said):
        return _LABEL.sub("", f"{found[1]}constant: {found[2]} - ({found[3]})")
    if found := _CONSTANT_FIRST.fullmatch(said):
        return f"constant: {found[1]}"
    if found := _GIVEN.fullmatch(said) or _GIVEN_FIRST.fullmatch(said):
        return f"if {found[1]}: {found[2]}"
    if found := _GIVEN_BEFORE_LABEL.fullmatch(said):
        return f"if {found[1].strip().removesuffix(',')}: {found[2]}"
    if found := _LIMIT.fullmatch(said):
        return f"as {next(filter(None, found.groups()[:3]))}: {found[4]}"
    if (
        "+" in said
        and (found := _NUMBERED.fullmatch(said))
        and _ENERGIES.fullmatch(said)
        and (same := _same_twice(*found.groups()))
    ):
        return f"constant: {same}"
    if (found := _NAMED_VALUE.fullmatch(said)) and (name := _quantity(found[1])):
        return f"{name} = {found[2]}"
    if found := _EXTREME_WHERE.fullmatch(said):
        return f"when it is {found[1]}: {found[2]}"
    if found := _SAID_OF_MOMENT.fullmatch(said):
        return f"{found[2]}: {found[1]} {found[3]}"
    if found := _HAPPENS_WHEN.fullmatch(said):
        return f"when {found[1]}: {found[2]}"
    if (found := _BEHIND.fullmatch(said)) and not re.match(rf"(?:{_STARTS}|while|during|until)\b", said):
        said = f"{found[2]}: {found[1]}"
    return _LABEL.sub("", _CONSTANT.sub(r"constant: \1", said)) if _UNCHANGING.search(said) else said


def as_claim(text: str) -> str:
    """A claim with its condition in one of the forms ``if …: …``, ``limit: … as …`` and ``after …: …``; any other as it is."""
    text = _LABELLED.sub("", _GIVEN_IN_WORDS.sub(r"if \1", text))
    text = _SMALL_FIRST.sub("for ", _SMALL.sub(_all_small, text))
    text = _STILL_FIRST.sub("in equilibrium", _TENDING.sub("as ", text))
    label, colon, rest = text.partition(":")
    if colon and (found := _WHICH_MODE.fullmatch(label)):
        return f"frequencies {1 if found[1] else 2}: {rest}"
    if colon and "=" in rest and (found := _WITHOUT.search(label)):
        others = f"{label[: found.start()]} {label[found.end() :]}".strip()
        return f"if without {'friction' if any(found.groups()) else 'damping'}: {f'{others}:' if others else ''}{rest}"
    if colon and "=" in rest and (found := _FREQUENCIES.search(label)):
        before = f"{label[: found.start()]}{label[found.end() :]}".strip()
        return as_claim(f"{before}: frequencies: {rest}") if before else f"frequencies: {rest}"
    found = _BEFORE.fullmatch(text)
    if not found:
        return text
    word, words = " ".join(found[1].split()), " ".join(_plainly(found[2]).split())
    if word == "as" and _GOES_ON.match(words):
        word = "when" if _AT_ONCE.search(words) else "while"
    return _conditional(word, words, found[3])


def _conditional(word: str, words: str, statement: str) -> str:
    """A claim whose condition is ``words`` behind the ``word`` with which it begins."""
    side, place = word.split()[-1], _NAMED_PLACE.search(words)
    if "small" in words and (found := _NAMED_VALUE.fullmatch(statement)) and (name := _quantity(found[1])):
        statement = f"frequencies: {_AS_OMEGA[name].format(found[2])}"
    named = place is not None and (side in ("after", "before") or place[1].startswith(("the ", "a ")))  # it may be an event
    said = _WHEN.sub(", ", _ASIDE.sub(r", \1", _NAMED_PLACE.sub(r"\1, \2" if named else r"\2", words)))
    if word == "at" and said == "start":
        return f"at start: {statement}"  # of the model's own run, as ``at end``
    labels = _SUM.match, OF_WHAT.fullmatch
    whole, *rest = said.split(",")
    rest = [part for part in rest if not OF_WHAT.fullmatch(part)]
    first, *others = (part for each in (whole, *rest) for part in _PARTS.split(each))
    parts = [first, *(part for part in others if part.strip() and not any(is_label(part) for is_label in labels))]
    if (kept := [part for part in parts if part.strip() not in ("constant", "conserved")]) and len(kept) < len(parts):
        parts, statement = kept, f"constant: {statement}"
    parts[0] = "from the start" if word == "from" else parts[0]
    if " " in word and side == "after" and len(parts) > 1 and _START.fullmatch(parts[0].strip()):
        others = ", ".join(map(_condition, parts[1:]))
        return as_claim(f"{'as' if '->' in others else 'if'} {others}, at the start: {statement}")
    first = f"{word} {parts[0].strip()}"
    if (
        (LASTS.match(first) or word in ("on", "once", "in") or (word == "with" and len(parts) == 1))
        and _WORDS.fullmatch(first)
        and _condition(parts[0]) == parts[0].strip()
    ):
        parts[0] = first
    said = ",".join(parts)
    each = [parts[0] if parts[0] == first else f"{word} {parts[0]}", *parts[1:]]
    if len(parts) > 1 and (beside := next((part for part in each if _BESIDE.fullmatch(part.strip())), None)):
        others = ", ".join(_condition(part) for part in each if part is not beside)
        if "->" in others or "small motions" in others:
            return as_claim(f"{beside.strip()}: as {others}: {statement}")
        return as_claim(f"if {others}: {beside.strip()}: {statement}")
    if side == "after" and re.fullmatch(r"(?:(?:the|a) )?time t|t (?:s|sec|seconds)", said):
        word, side, said = "if", "", "from the start"
    is_start = word == "initially" or (" " in word and side == "after" and (not said or _START.fullmatch(said)))
    if side in ("after", "before") and not is_start:
        return f"{'just ' if ' ' in word else ''}{side} {said}: {statement}"
    said = "at the start" if is_start else said
    parts = _PARTS.split(said)
    statement = _FREQUENCY.sub("frequencies:", statement)
    if statement.startswith("frequencies:"):  # they are of small motions
        parts = [_OF_SMALL.sub("", part) for part in parts if "=" in part or not _OF_SMALL.match(part)]
        if not parts:
            return statement
    parts = [_condition(part) for part in parts]
    small = {part.removesuffix(" -> 0") for part in parts if part.endswith(" -> 0")}
    parts = [part for part in parts if part.rstrip("'") == part or part.rstrip("'") not in small]  # so are its rates
    if any("->" in part for part in parts):  # these are the ones
        parts = [part for part in parts if part != "small motions"]
    if any("->" in part or part == "small motions" for part in parts):
        inner = re.fullmatch(r"limit:\s*(.+)\s+as\s(.+)", as_claim(statement), re.S)
        statement, parts = (inner[1], [*parts, inner[2]]) if inner else (statement, parts)
        return f"limit: {_ARROW.sub(' = ', statement)} as {', '.join(parts)}"
    if word == "at" and parts == [said] and not re.search("[=<>]", said):
        return f"at {said}: {statement}"  # a moment of the run by its name
    if word == "at" and (moment := re.fullmatch(r"t\s*=\s*([\d.]+\s*\w*)", said)) and parts == [said]:
        return f"at {moment[1]}: {statement}"
    return f"if {', '.join(parts)}: {statement}"


def _all_small(found: re.Match[str]) -> str:
    """``for small φ, small s``, and what is said of them beside, ``φ = s``."""
    parts = [part.strip() for part in _PARTS.split(found[1]) if part.strip()]
    names = dict.fromkeys(name.strip(" -+−") for part in parts for name in part.split("="))
    return f"for {', '.join([*(f'small {name}' for name in names), *(part for part in parts if '=' in part)])}"


def _plainly(condition: str) -> str:
    """A condition with arrows and infinities of one kind, without LaTeX's blanks."""
    return _INFINITY.sub(r"\1inf", _ARROW.sub(" -> ", condition.strip().replace(r"\,", " ").strip("$ ")))


def _condition(part: str) -> str:
    """One part of a condition in the words of a hypothesis."""
    said = part.strip()
    said = re.sub(
        r"\A(?:(?:when|if|after(?=\s+\S+\s*=)|(?:as|so) long as(?=[^:]*[<>≤≥]))\s+|(?:for|at|as)\s+(?=small|large|\S+\s*(?:=|->)))",
        "",
        said,
    )
    if re.fullmatch(
        rf"{_SMALL_MOTIONS}(?: about (?:the )?(?:(?:static |position of )?equilibrium|(?:place|position) of rest))?", said
    ):
        return "small motions"
    if found := re.fullmatch(rf"(small|large)\s+(.+?)(?:\s+about\s(?!.*{_ELSEWHERE})[^=]*)?", said):
        return f"{found[2]} -> {'0' if found[1] == 'small' else 'inf'}"
    if _START.fullmatch(re.sub(rf"\A{INSTANT}(?:after|at|upon)\s+", "", said)):
        return "at the start"
    if re.fullmatch(r"(?:in |at )?(?:static )?equilibrium", said):
        return "in equilibrium"
    if _STEADY.fullmatch(said):
        return "in the steady state"
    if _UNIFORM.fullmatch(said):
        return "at constant speed"
    if found := re.fullmatch(r"\w+\s+(first\s+)?(?:passes|reaches|comes\s+to)\s+(?:through\s+)?(\S+\s*=.+)", said):
        return f"{found[2]}{', from the start' * bool(found[1])}"
    if found := re.fullmatch(r"(.+[=<>].+)\s+again", said):
        return f"{found[1]}, from the start"
    if found := _THROUGHOUT.fullmatch(said):  # so are its rates
        return f"{found[1]} = {found[2]}, ({found[1]})' = ({found[2]})'"
    return (
        "at rest" if re.fullmatch(r"(?:(?:it|all|everything) is )?(?:at )?rest(?: in (?:the|its) [\w ]*frame)?", said) else said
    )


def named(name: str, said: str) -> tuple[str, str]:
    """A name and what a line, ``p = …``, says that it is; of ``p² = …`` that is the root."""
    square = re.fullmatch(r"(.+?)(?:²|\^\{?2\}?)", name)
    return (square[1], f"sqrt({said})") if square else (name, said)


def _component(vector: str, axis: str) -> str:
    """``a_{Gt}`` for ``(a_G)_t``."""
    symbol, _, index = re.sub(r"\\(?:vec|mathbf|bm)\s*|[{}]", "", vector).partition("_")
    return f"{symbol}_{{{index}{axis}}}"


def _same_twice(left: str, right: str) -> str | None:
    """What has one value at two places, ``T_1 + V_1 = T_2 + V_2``; None where the two sides are not alike."""
    first, second = ("".join(_TWICE[i].sub("", side).split()) for i, side in zip("12", (left, right), strict=True))
    numbered = all(_TWICE[i].search(side) for i, side in zip("12", (left, right), strict=True))
    return first if numbered and first == second else None


def _quantity(words: str) -> str | None:
    """The name of what a vibration has, in words."""
    return next((name for said, name in _NAMED.items() if re.fullmatch(said, words)), None)
