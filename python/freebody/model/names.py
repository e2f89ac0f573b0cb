"""Names: their spelling in expressions, indices in brackets, and the nearest known one."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

WORD = r"(?:[^\W\d]\w*|'[^']*')"
INDEX = r"\[[^\[\]]*\]"
NAME = rf"{WORD}(?:{INDEX})*(?:\.{WORD}(?:{INDEX})*)*"
NUMBER = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"

TOKEN = re.compile(rf"(?P<name>{NAME})|(?P<number>{NUMBER})|(?P<degree>°)|(?P<space>\s+)|(?P<sign>.)", re.DOTALL)
"""The pieces of an expression; every text is a row of these."""

_PLAIN = re.compile(NAME.replace("|'[^']*'", ""))
_INDEX = re.compile(r"(?<=[\w'\]])\[([^\[\]]+)\]")
_FORBIDDEN = re.compile(r"[.'\"\[\](){},@|`&#\\\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffd]")
_SYNONYMS = {
    **dict.fromkeys(("pin", "pivot", "revolute"), ("hinge",)),
    **dict.fromkeys(("prismatic", "translational"), ("slider", "slot")),
    **dict.fromkeys(("fixed", "rigid", "clamped"), ("weld",)),
    **dict.fromkeys(("bar", "beam", "stick"), ("rod",)),
    **dict.fromkeys(("wheel", "cylinder", "circle"), ("disk",)),
    **dict.fromkeys(("box", "block", "plate", "square"), ("rectangle",)),
    **dict.fromkeys(("point", "ball", "bob"), ("particle",)),
    **dict.fromkeys(("dashpot", "damping"), ("damper",)),
    "hoop": ("ring",),
}
"""Words of other programs and books, with those of the language."""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """The known word nearest in spelling, when near enough to be a slip: one slip in three letters."""
    allowed = max(len(word) // 3, 1)
    lower = word.lower()
    found = [(slips, k) for k in known if (slips := distance(lower, k.lower(), allowed)) <= allowed and slips < len(k)]
    return min(found, default=(0, None), key=lambda pair: pair[0])[1]


def distance(a: str, b: str, enough: int) -> int:
    """Insertions, deletions, replacements and swaps of neighbours from ``a`` to ``b``; above ``enough`` any larger number."""
    if abs(len(a) - len(b)) > enough:
        return enough + 1
    before: list[int] = []
    above = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        row = [i]
        for j, other in enumerate(b, 1):
            best = min(above[j - 1] + (letter != other), above[j] + 1, row[j - 1] + 1)
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                best = min(best, before[j - 2] + 1)
            row.append(best)
        before, above = above, row
    return above[-1]


def suggestion(word: str, known: Iterable[str], what: str = "") -> str:
    """``did you mean `hinge`?``, or the list of the known words when it is short."""
    known = sorted(set(known))
    meant = [k for k in _SYNONYMS.get(word.lower(), ()) if k in known] or [k for k in [nearest(word, known)] if k]
    if meant:
        return f"did you mean {' or '.join(f'`{k}`' for k in meant)}?"
    if not known:
        return f"the model has no {what}" if what else ""
    shown = ", ".join(f"`{k}`" for k in known[:20])
    return f"there is {shown}" if len(known) <= 20 else f"there is {shown}, …"


def spell(name: str) -> str:
    """A name as it stands in an expression: words that are not plain go in quotes."""
    parts = [part.partition("[") for part in name.split(".")]
    return ".".join((word if _PLAIN.fullmatch(word) else f"'{word}'") + bracket + rest for word, bracket, rest in parts)


def unquote(text: str) -> str:
    """A name without the quotes that an expression needs: ``'crank drive'.end`` → ``crank drive.end``."""
    return text.replace("'", "")


def fault(name: str) -> str | None:
    """What is wrong with a name that somebody gives, or None."""
    bare = _INDEX.sub("", name)
    if not bare.strip() or bare != bare.strip():
        return "a name needs letters, and no space around them"
    bad = _FORBIDDEN.search(bare)
    if bad and not bad[0].isprintable():
        return f"a name cannot hold the character U+{ord(bad[0]):04X}"
    return f"a name cannot hold `{bad[0]}`" if bad else None


def work_out_indices(text: str, value: Callable[[str], int]) -> str:
    """The text with what stands in brackets after names worked out: ``link[i-1].end`` → ``link[2].end``.

    ``value`` turns the inside of a bracket to a whole number.
    """
    return _INDEX.sub(lambda found: f"[{value(found[1])}]", text) if "[" in text else text


def replace_names(text: str, other: Callable[[str, bool], str]) -> str:
    """The expression with each name (dotted, with indices) replaced by ``other(name, is_call)``.

    What stands directly after a number is a unit and stays.
    """
    tokens = [(token.lastgroup, token[0]) for token in TOKEN.finditer(text)]
    solid = [i for i, (kind, _) in enumerate(tokens) if kind != "space"]
    out = [piece for _, piece in tokens]
    for before, i, after in zip([None, *solid], solid, [*solid[1:], None], strict=False):
        if tokens[i][0] == "name" and (before is None or tokens[before][0] != "number"):
            out[i] = other(tokens[i][1], after is not None and tokens[after][1] == "(")
    return "".join(out)
