"""Laws that stand before an equation, in letters that the model does not have: ``T_1 + V_1 = T_2 + V_2: ½ I ω² = m g h``,
``ΣM_O = I_O α ⇒ m g L = I α``; a definition there, ``m_e = 3/2 m: m_e ẍ + k x = 0``, is one."""

from __future__ import annotations

import re
from collections.abc import Iterator

from .language.glyphs import CONDITION

_RELATION = re.compile(r"[=<>≤≥]|\\(?:leq?|geq?|approx)(?![A-Za-z])")
_COLON = re.compile(r":(?!=)")
_ARROW = re.compile(r"⇒|⟹|∴|→(?=[^=]*=)|\\(?:Rightarrow|implies|Longrightarrow|therefore)(?![A-Za-z])")
_CONDITION = re.compile(
    rf"\s*\$?\s*(?:{CONDITION}|constant|limit|only|follows|shorter|report|same|no|near|small\b.*\babout|linear(?:is|iz)ed)\b"
)
_ITS_CONDITION = re.compile(rf"([^,]*),\s*((?:{CONDITION})\b.*)", re.S)
"""``(H_O)_1 = (H_O)_2, just after the impact``."""
_WORDS = re.compile(r"\s*[A-Z]?[a-z]+(?:[ ,'-]+[A-Za-z]+)+\s+(?=(?:when|if|once)\b[^:]*:)")
"""``the ladder leaves the wall when …: …``."""


def without_laws(text: str) -> Iterator[tuple[str, str]]:
    """A statement in other ways: with what stands before it as a line of its own, and without that; each with what is then passed over."""
    if found := _WORDS.match(text):
        yield text[found.end() :], found[0].strip()
    for sign in (_COLON, _ARROW):
        for found in sign.finditer(text):
            law, rest = text[: found.start()].strip(), text[found.end() :].strip()
            if sign is _COLON and (behind := _ITS_CONDITION.fullmatch(law)):
                law, rest = behind[1], f"{behind[2]}: {rest}"
            if _is_law(law) and _RELATION.search(rest):
                if not _COLON.search(rest):
                    yield f"{law}\n{rest}", ""
                yield rest, law


def _is_law(text: str) -> bool:
    """Whether it states something, under no condition."""
    return bool(_RELATION.search(text)) and not _CONDITION.match(text) and text.count("(") == text.count(")")
