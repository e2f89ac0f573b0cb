"""Words around an equation that are no part of it: *Thus*, *the tension T = …*, *(i.e. to the left)*; *from rest* and *with the given
numbers* are conditions."""

from __future__ import annotations

import re
from collections.abc import Collection

_MOVES = r"(?:start(?:s|ed|ing)?|released|let go|dropped|begin(?:s|ning)?|falls|falling|moves|moving)"
_FROM_REST = re.compile(
    rf"(?:\b(?:if|when|after)\s+)?(?:\b(?:it|they|(?:the )?\w+)\s+(?:is|was|are|were)\s+|\b(?:it|they)\s+|\bbeing\s+)?"
    rf"\b{_MOVES}\s+(?:from|at)\s+rest\b(?!\s*=)|(?:\A|(?<=[,:]\s))(?:if\s+)?from rest\b",
    re.IGNORECASE,
)
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
_SENSE = {re.compile(rf"\s*,?\s*(\()?\b(?:{words})\b(?(1)\))(?=\s*(?:[,;.]|$))", re.I): sign for words, sign in _SENSES.items()}
_REMARK = re.compile(
    r"\s*\((?:i\.?\s?e\b|e\.?\s?g\b|that is|because|since|so|as|hence|thus|note|acting|by|from|see)\b[^()=]*\)(?=\s*(?:[,;.]|$))"
)
_IN_LATEX = re.compile(r"(?<![_^{])\s*\\(?:text|textrm|mbox|mathrm)\s*\{\s*([a-z]+(?:[\s,]+[a-z]+)*[,.:]?)\s*\}")
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
    *("from", "rest", "start", "the", "we", "get", "have", "initially", "just", "after", "before", "starting", "released"),
}
_THUS = re.compile(
    r"(?m)^\s*(?:(?:thus|hence|so|then|therefore|finally|consequently|also|now|or|(?:which |this )?gives|we (?:get|have|find|obtain)"
    r"|it follows(?: that)?|i\.e\.|solving(?: for \S+)?|\d[.)]|•)[,:]?\s+)+",
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


def plainly(text: str, known: Collection[str] = ()) -> str:
    """A statement without words that say nothing of it, and with the conditions among them in the words of claims; names that are
    ``known`` are no words."""
    said = _IN_LATEX.sub(_of_latex, text)
    said = _FROM_REST.sub("if the start is at rest", said)
    said = _THESE_NUMBERS.sub("if with these numbers", said)
    said = _REMARK.sub("", said)
    for sense, sign in _SENSE.items():
        said = sense.sub(f" {sign}", said)
    said = _THUS.sub("", said)
    return _CALLED.sub(lambda found: found[0] if {*found[2].split()} & {*known} else "initially: " * bool(found[1]), said)


def _of_latex(found: re.Match[str]) -> str:
    """Words that are set upright in LaTeX, if they join what stands around them."""
    return f" {found[1]} " if {*re.findall("[a-z]+", found[1])} <= _CONNECTIVES else found[0]
