"""What stands around an equation, clause by clause: of which motions it is, ``just after the impact``, and of what, ``bar AB, ΣM_A``."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence

from .clause_words import MOTION, reworded
from .language.glyphs import CONDITION
from .pieces import RELATION, Piece, pieces_of, relates
from .wording import INSTANT

_LEADS = re.compile(
    r"\b(?:(?:so|such|find|finds|shows?|says|means|follows) that|according to|(?:falls?|grows?|rises?|drops?|decreases?|increases?|goes|changes?|varies|reads|moves\b.*) (?:as|by|with)"
    r"|equal to|(?:leads|reduces|amounts) to|(?:follows|results|comes|found|obtained) from|(?:given|expressed) (?:by|as)"
    r"|(?:pulls?|push(?:es)?|press(?:es)?|acts?|moves?|turns?|starts?|begins?|leaves?|swings?|slides?|rolls?|falls?|runs?|hits?|strikes?|rebounds?|flies|lands?|arrives?|vibrates?|oscillates?)\b.* with)\Z"
)
"""What ends words, behind which stands what is said, whatever else that is like."""
_FEWEST = 2  # words of a clause that stands directly before an equation
_SENTENCE_WORDS = 4  # of one, at least
_JOINED = "…"
_BLANK = re.compile(r"(?<!\\)\\(?:q?quad\b|[,;:!> ])")
_BOXED = re.compile(r"\\boxed\s*\{(.*)\}(?=\s*\Z)", re.S)
_SENTENCE = re.compile(r"\A[^:\n]*?[\w)]\.\s+(?=[A-Z][a-z]+\b[^:\n]*:)")
"""A sentence before that which says when something is so."""
_INTRODUCES = re.compile(r"\b(?:if|when|where|at|for|with|from|until|once|while|as|given|assuming|provided|that|and|or|on|to)\Z")
"""Words behind which an equation is a condition, and not what is said."""
_AT_TIME = ("at", "when", "where", "instant", "time", "moment")
CLAIM = re.compile(r"\s*(?:constant|limit|only if|follows|shorter|report|same at|no [^:]* in)\b")
"""With which a claim in words of its own begins."""

# -- what a clause is

_HEAD = re.compile(
    rf"(?!in\s+(?!(?:the\s+)?(?:\w+\s+)?(?:equilibrium|steady|flight|hop|air|limit|end)\b))(?:{CONDITION}|only|on(?=\s+(?:the|its)\s+(?:way|swing|stroke)\s+back)|from(?=\s+t_?[1₁]))\b",
    re.I,
)
"""With which a condition begins."""
_BEHIND = re.compile(
    rf"(?:{INSTANT})?(?:after|before)\b|(?:at|when|once|if|for|while|during|until|initially|(?:as|so) long as|provided|assuming)\b"
    rf"|in the {MOTION}\b|in (?:the )?(?:free )?(?:flight|air)\b|(?:the whole time|all the time|throughout)\b"
    r"|in\s+(?:the\s+)?(?:static\s+)?(?:steady|equilibrium)\b"
)
"""With which one begins behind an equation."""
_WITHIN = re.compile(
    rf"\s+(?={INSTANT}(?:after|before)\b|(?:after|before|while|until|once|when|if)\s+\S|(?:at|in)\s+the\s+(?:moment|instant|start|end|{MOTION})\b"
    r"|for\s+small\b|(?:for|with)\s+\S+\s*=|released\b|from\s+rest\b)"
)
"""Where one begins in a clause that first says of what it is: ``energy just after the impact``."""
_EMBEDDED = re.compile(
    rf"\b(?:{INSTANT})?(?:after|before|during)\s+the\s+\w+\Z|\b(?:{INSTANT})?(?:after|before|during)\s+the\s+\w+(?=\s+(?:is|are)\b)"
    rf"|\b(?:(?:{INSTANT})?(?:after|before)|while|until|once|when|as long as)\s+(?:it|he|she|they|both|all|the\s+\w+)\s+(?!is\b|are\b)\S+"
    r"(?:\s+(?!is\b|are\b|has\b|gives?\b|the\b)\S+)*|\b(?:at|with)\s+(?:constant|steady|uniform)\s+(?:speed|velocity)"
    r"|\bin\s+(?:the\s+)?(?:steady\s+state|equilibrium|flight|air)|\bthe\s+steady\s+(?:motion|vibration|response)"
)
"""Those in the words for that whose value an equation gives: ``the tension while they slide is T = …``."""
_ASIDE = re.compile(r"([^()]*[A-Za-z\s])\s*\(([^()]+)\)")
_IDLE = re.compile(
    r"(?:as\s+a\s+)?special\s+case|(?:since|because)\s+[^=<>]*|(?:as\s+)?(?:seen|viewed|measured)\s+(?:from|in|by)\b.*|(?:both\s+)?before\b.*\band\s+after\s+(?:it|that)"
    r"|for\s+an\s+observer\b.*|(?:solving|using|eliminating|substituting|combining|inserting)\b.*|1:?\s.*\bbefore|2:?\s.*\bafter"
    r"|(?:from|about|near)\s+(?:the\s+)?(?:static\s+)?(?:equilibrium|rest)(?:\s+position)?|(?:anti)?symmetric\s+mode|(?:as\s+a\s+)?check|(?:both|the\s+two|these)\s+equations|in\s+the\s+end|eventually|finally|at\s+last|[→←↑↓↺↻⟲⟳]\s*\+?|\+\s*[→←↑↓↺↻⟲⟳]|the\s+whole\s+time|all\s+the\s+time|throughout|\+?\s*(?:(?:(?:counter|anti)-?)?clockwise|c?cw)\b.*|positive\b.*",
    re.I,
)
"""Clauses that say nothing of it."""
_SO = re.compile(r"(?:so|hence|thus|therefore|and\s+so)\b\s*(?:that\b)?\s*")
"""Behind it what follows from the clauses before."""
_SUM = re.compile(r"(?:[↺↻↑↓→←+()]\s*)*(?:Σ|∑|\\Sigma|\\sum|[Ss]um\b)")
_ENERGIES = re.compile(r"(?=.*[+12₁₂])[\sTVUEKWΔ+=_{}()\d₁₂→\\to-]+(?:const\.?)?")
_LAW = re.compile(
    r".*[A-Za-z]{2,}\s*=\s*(?:just\s+)?[a-z]{3,}.*|.*\bbefore\s*=.*\bafter\b.*|\S+\s*=\s*[a-z]{3,}\s+[a-z]{2,}.*|.*(?:∂|\\partial).*|.*\bsince\s+t\s*=.*|.*\bfrom\s+t\s*=\s*0(?!\.).*|.*=.*\b(?:along|across)\b.*|with\s+(?:its\b|the\s+(?:inertia|term)\b).*"
    r"|(?:everything|all)\s+that\s+moves|(?!.*\bsmall\b)(?:.*\s)?about\s+(?:[a-z]+\s+[a-z]+\s+at\s+)?\S+\s*=.*|(?:.*\W)?(?:and|along|across)\s+[A-Z]{1,2}|.*=.*(?:×|\\times).*"
)
"""``momentum before = momentum after``, ``a_B = a_A + a_{B/A} along AB``."""
_DIRECTION = re.compile(r"(?:vertical|horizontal|tangential|radial|transverse)(?:ly)?|[xynrtθ]-(?:part|component|direction)")
_ALONG = re.compile(r"along|across|throughout|again|always|at all times")
_BACK = re.compile(r"on (?:the|its) (?:way|swing|stroke) back\Z")
_RATE_SIGN = re.compile(r"(?:['′\u0307]|dot\b[^<>]*)\s*[<>]")
"""``θ' <``: the sign of a rate says which way, so that the words of ``_BACK`` say it a second time."""
_SMALL = re.compile(r"(?:for\s+|with\s+)?small\b")
_LIST_OF_SMALL = re.compile(r"(?:for\s+)?small\b.*,")
"""``small θ, φ``."""
_NAMED = re.compile(r"[A-Za-z]{3,}\s+[A-Z]{1,2}\Z")
"""``bar DC``."""
_VALUE = re.compile(
    r"(?:\\?[^\W\d][\w'′″{}\u0307\u0308]*\s*=\s*)+(?:0|[\d.]+\s*°|[\d.]*\s*(?:π|\\pi)(?:/\d)?)|[^\W\d][\w'′″{}\u0307\u0308]*\s*[<>]\s*0|(?:\\d*dot\s*\{?\\?\w+\}?\s*=\s*)+0"
)
"""``φ' = φ'' = 0``, ``N = 0``."""
_AT = re.compile(r"\A(?:at|when|where)\s+")
_KIND = re.compile(r"(?:(?:very|perfectly)\s+)?(?:rigid|stiff|soft|light|heavy|massless|smooth|rough)\b[^=<>→]*")
_WORDY = re.compile(r"[A-Za-z][\w'-]*(?:\s+[\w'-]+)+")
_NAME = re.compile(r"[A-Z][a-z]+(?<!ing)")
_SYMBOL = re.compile(r"(?:\\[a-z]+|[^\W\d])(?:\d|_\w+|_\{\w+\})?[′']*")
_ARE_SMALL = re.compile(
    rf"((?:\A|(?<=[,:;(]))\s*|\b(?:if|when|where|with|for|as)\s+)((?:{_SYMBOL.pattern}\s*(?:,|\band\b)\s*)+{_SYMBOL.pattern})\s+(?:are\s+)?small\b"
)
"""``θ_1, θ_2 small``."""
_AND = re.compile(r"\s*\band\b\s*")
_AMPLITUDE = re.compile(r"(?:\bthe )?(?:\bsteady |\bforced )?\bamplitude of\s*\Z")


def arranged(text: str, known: Collection[str], of_what: re.Pattern[str], bodies: Collection[str] = ()) -> str:
    """A statement with the conditions among the clauses around its equation first, then what it is of, then the equation; any other as it
    is. Names that are ``known`` are no words; ``of_what``: words that say of what an equation is, as the names of ``bodies`` do."""
    if "\n" in text or "⇒" in text or CLAIM.match(text) or (";" in text and RELATION.search(text.partition(";")[0])):
        return text
    text = _ARE_SMALL.sub(lambda found: f" for small {_AND.sub(', ', found[2])}", text)
    plain = _SENTENCE.sub("", _BOXED.sub(r"\1", _BLANK.sub(" ", text.replace("$", ""))))
    pieces = [*pieces_of(plain, known)]
    colon = _label_ends(plain, pieces)
    before, body = pieces[: max(colon, 0)], pieces[colon + 1 :]
    begins = _core(plain, body)
    if (
        begins is None
        or not (before or any(piece.kind == "words" for piece in pieces))
        or RELATION.match(plain[body[begins].start :].lstrip())
    ):
        return text
    if begins and sum(piece.kind == "words" for piece in body[:begins]) < _FEWEST and not _HEAD.match(plain[body[0].start :]):
        return text  # a word among symbols is one of them
    if begins and (found := _AMPLITUDE.search(plain, body[0].start, body[begins].start)):  # that is what it says something of
        begins = next(i for i, piece in enumerate(body) if piece.stop > found.start())
    core = body[begins:]
    ends = _suffix(plain, core)
    around = [[*_clauses(plain, some)] for some in (before, body[:begins], core[ends:])]
    is_label = re.compile(f"{of_what.pattern}|{_called(bodies)}") if bodies else of_what
    said = [part for clause in _conclusion(_explained([*around[0], *around[1]], is_label)) for part in _parts(clause, is_label)]
    labels = [part for part in said if _is_of_what(part, is_label)]
    conditions = [part for part in said if part not in labels]
    # What is no condition says whose value an equation gives.
    if begins and conditions and conditions[-1] == said[-1] and not _is_condition(said[-1]):
        conditions[-1:] = [reworded(found[0]) or found[0] for found in _EMBEDDED.finditer(conditions[-1])]
    if any(map(_RATE_SIGN.search, conditions)):  # that says which way
        conditions = [clause for clause in conditions if not _BACK.match(clause)]
    behind = [part for clause in around[2] for part in _parts(clause, is_label)]
    changed = [*said, *behind] != [*around[0], *around[1], *around[2]]
    is_law = any(relates(label) or _LAW.fullmatch(label) for label in labels)
    at_once = bool(before) and _is_list(conditions)
    unsaid = any(" held" in clause and not _HEAD.match(clause) for clause in conditions)
    if not (begins or changed or is_law or at_once or behind or unsaid or (labels and any(map(_is_condition, conditions)))):
        return text
    if any(map(_LIST_OF_SMALL.match, conditions)):  # a name is none of the list
        named = [clause for clause in conditions if _NAMED.match(clause)]
        labels, conditions = [*named, *labels], [clause for clause in conditions if clause not in named]
    labels = [label for label in labels if not (relates(label) or _LAW.fullmatch(label))]
    if not any(map(_is_condition, [*conditions, *behind])):
        labels, conditions = [*conditions, *labels], []
    equation = plain[core[0].start : core[ends - 1].stop].strip(" ,")
    return ": ".join(filter(None, (", ".join(_headed([*conditions, *behind])), ", ".join(labels), equation)))


def _is_list(conditions: Sequence[str]) -> bool:
    """Whether conditions are values, or relations beside others, without a word for that."""
    if not conditions or any(map(_HEAD.match, conditions[:1])):
        return False
    return all(map(_VALUE.fullmatch, conditions)) or (len(conditions) > 1 and any(map(relates, conditions)))


def _label_ends(text: str, pieces: Sequence[Piece]) -> int:
    """Where among the pieces the colon is behind which the statement begins; -1 where none is."""
    ends = -1
    for i in (i for i, piece in enumerate(pieces) if piece.kind == ":"):
        inner = pieces[ends + 1 : i]
        begins = _core(text, inner) if ends >= 0 else None
        if begins is not None and not _VALUE.fullmatch(text[inner[begins].start : inner[begins].stop].strip()):
            break  # an equation from which another follows
        ends = i
    return ends


def _called(bodies: Collection[str]) -> str:
    """A pattern for what is called by a body: ``the left wheel``."""
    one = rf"(?:(?:the|an?|both|whole)\s+)?(?:(?!no\b)[a-z]+\s+)?(?:{'|'.join(map(re.escape, bodies))})"
    return rf"{one}(?:\s*(?:\+|and)\s*{one})*"


def _explained(clauses: Sequence[str], is_label: re.Pattern[str]) -> list[str]:
    """The clauses without those for which relations stand behind them: ``engine off, no damping (Q = 0, c = 0)``, ``about to lift, N = 0``."""
    out: list[str] = []
    for clause in clauses:
        aside = _ASIDE.fullmatch(clause)
        is_value = _VALUE.fullmatch(_AT.sub("", clause)) is not None and not _SUM.match(clause)
        stand = aside[2].count(",") if aside and relates(aside[2]) else int(is_value)
        for _ in range(stand):
            before = out[-1] if out else ""
            tells = (
                _is_condition(before)
                or _SMALL.match(before)
                or reworded(before)
                or _is_of_what(before, is_label)
                or _WITHIN.search(before)
            )
            if _WORDY.fullmatch(before) and not tells:
                out.pop()
        out.append(clause)
    return out


def _conclusion(clauses: Sequence[str]) -> list[str]:
    """The clauses from the last on that follows from others: ``D is at rest, so along the strut``."""
    last = max((i for i, clause in enumerate(clauses) if _SO.match(clause)), default=0)
    so = _SO.match(clauses[last]) if clauses else None
    first = clauses[last][so.end() :] if so else "".join(clauses[last : last + 1])
    return [clause for clause in (first, *clauses[last + 1 :]) if clause]


def _parts(clause: str, is_label: re.Pattern[str]) -> Iterator[str]:
    """What a clause says, in the words that are read: what it is of, and of which motions, each for itself."""
    if clause.startswith(_JOINED):
        clause = clause.removeprefix(_JOINED)
        if not (_is_condition(clause) or reworded(clause) or _is_of_what(clause, is_label)):
            return  # if R → ∞ nothing is lost: …
    within = _WITHIN.search(clause.partition("(")[0])
    first = clause[: within.start()] if within else ""
    if within and not _HEAD.match(clause) and (_is_of_what(first, is_label) or reworded(first) or first.isalpha()):
        yield from (part for each in (first, clause[within.end() :]) for part in _parts(each, is_label))
        return
    if (read := reworded(clause)) is not None:
        yield from filter(None, map(str.strip, read.split(",")))
        return
    aside = _ASIDE.fullmatch(clause)
    if aside and (reworded(aside[1]) or _explains(aside) or all(_IDLE.fullmatch(each.strip()) for each in aside[2].split(","))):
        yield from _parts(aside[1].strip(), is_label)
    elif (
        aside
        and not (_HEAD.match(clause) or _is_of_what(aside[2], is_label))
        and (_is_condition(aside[2]) or _SMALL.match(aside[2]))
    ):
        # Brackets behind other words say what these mean.
        what = [aside[1].strip()] if _is_of_what(aside[1].strip(), is_label) or reworded(aside[1]) else []
        yield from (part for each in (*what, *_listed(aside[2])) for part in _parts(each.strip(), is_label))
    elif clause and not _IDLE.fullmatch(clause):
        yield clause


def _explains(aside: re.Match[str]) -> bool:
    """Whether words in brackets only explain a relation before them: ``k → ∞ (rigid strut PC)``."""
    return relates(aside[1]) and _KIND.fullmatch(aside[2].strip()) is not None


def _listed(said: str) -> list[str]:
    """The conditions in brackets; what is small is one."""
    parts = [part for part in said.split(",") if not _IDLE.fullmatch(part.strip())]
    small = _SMALL.match(said)
    return [f"for small{','.join(parts)[small.end() :].rstrip()}"] if small else parts


def _headed(conditions: Iterable[str]) -> list[str]:
    """The conditions with one first that begins with a word for that."""
    ranked = sorted(conditions, key=lambda clause: _SMALL.match(clause) is not None)
    heads = [clause for clause in ranked if _HEAD.match(clause) and not _SMALL.match(clause)]
    first = next((clause for clause in heads if _BACK.match(clause)), heads[0] if heads else None)  # then what is so there
    ranked = [*([first] if first else []), *(clause for clause in ranked if clause is not first)]
    is_bare = bool(ranked) and not (_HEAD.match(ranked[0]) or _SMALL.match(ranked[0])) and any(map(_is_condition, ranked))
    if is_bare:
        ranked.sort(key=lambda clause: not _is_condition(clause))
    return [f"if {ranked[0]}", *ranked[1:]] if is_bare and not _HEAD.match(ranked[0]) else ranked


def _is_condition(clause: str) -> bool:
    return bool(_HEAD.match(clause)) or relates(clause) or " held" in clause


def _is_of_what(clause: str, is_label: re.Pattern[str]) -> bool:
    """Whether a clause says of what an equation is: a sum, a law in letters, the name of a part."""
    if _LAW.fullmatch(clause) or " held" in clause:
        return " held" not in clause
    whole = _ENERGIES.fullmatch, _DIRECTION.fullmatch, is_label.fullmatch, _SYMBOL.fullmatch, _NAME.fullmatch
    return clause in ("frequencies", "natural frequency") or (
        not _HEAD.match(clause) and (_SUM.match(clause) is not None or any(match(clause) for match in whole))
    )


# -- where an equation stands


def _core(text: str, body: Sequence[Piece]) -> int | None:
    """Where among the pieces behind the label the equation begins; None where they state none."""
    said = ""
    for i, piece in enumerate(body):
        last = said.rpartition(" ")[2]
        if piece.kind == "words":
            said = f"{said} {text[piece.start : piece.stop]}".lstrip()
        elif piece.kind in ",;:":
            said = ""
        elif piece.relation and (
            said == "and" or _is_last(said, body, i) or _LEADS.search(said) or not (last in _AT_TIME or _INTRODUCES.search(last))
        ):
            return i
        elif piece.relation and last in _AT_TIME and i == len(body) - 1 and _is_moment(text, body[:i]):
            return i  # the first impact at t = …, the box slides when …
        else:
            said = "" if piece.relation else said
    return _given_with(text, body)


def _is_last(said: str, body: Sequence[Piece], i: int) -> bool:
    """Whether a relation is the only one behind a sentence that goes on with it: ``during the flight it turns uniformly and θ = …``."""
    return (
        said.endswith((" and", " with"))
        and said.count(" ") > _SENTENCE_WORDS
        and not any(piece.relation for piece in [*body[:i], *body[i + 1 :]])
    )


def _given_with(text: str, body: Sequence[Piece]) -> int | None:
    """Where the only relation begins, if it stands at the end of a sentence: ``the pin slides along the slot with s' = …``."""
    relations = [i for i, piece in enumerate(body) if piece.relation]
    words = [text[piece.start : piece.stop] for piece in body if piece.kind == "words"]
    is_last = relations == [len(body) - 1] == [len(words)]
    return relations[0] if is_last and len(words) > _FEWEST and words[-1] == "with" and not _HEAD.match(words[0]) else None


def _is_moment(text: str, before: Sequence[Piece]) -> bool:
    """Whether pieces before a relation say what happens where it is so."""
    last = max((i + 1 for i, piece in enumerate(before) if piece.kind in ",;:"), default=0)
    words = [text[piece.start : piece.stop] for piece in before[last:] if piece.kind == "words"]
    return len(words) > 1 and not (_HEAD.match(words[0]) or any(piece.relation for piece in before[last:]))


def _suffix(text: str, core: Sequence[Piece]) -> int:
    """Where among the pieces from the equation on a condition begins behind it; their number where none does."""
    for i, piece in enumerate(core[1:], 1):
        if piece.kind == "words":
            return i if _BEHIND.match(text, piece.start) else len(core)
    return len(core)


def _clauses(text: str, pieces: Sequence[Piece]) -> Iterator[str]:
    """The clauses of some pieces: what stands between signs that part them, and an equation that is a condition for itself; with a mark
    what stands behind that without a sign between."""
    at, closed, joined = 0, False, False
    for i, piece in enumerate(pieces):
        parts = piece.kind in ",;:" and not _goes_on(text, pieces, at, i)
        if parts or (closed and piece.kind == "words" and not _ALONG.match(text, piece.start)):
            if at < i:
                yield _JOINED * joined + text[pieces[at].start : pieces[i - 1].stop].strip()
            joined = closed and not parts
            at = i + (parts or text[piece.start : piece.stop] == "and")
            closed = False
        said = text[piece.start : piece.stop].strip()
        in_words = any(map(RELATION.match, (said[:1], said[-1:])))  # words are what is equal
        closed |= piece.relation and not in_words
    if at < len(pieces):
        yield _JOINED * joined + text[pieces[at].start : pieces[-1].stop].strip()


def _goes_on(text: str, pieces: Sequence[Piece], at: int, i: int) -> bool:
    """Whether behind a comma the list of what is small goes on."""
    after = [p.kind for p in pieces[i + 1 : i + 3]]
    small = re.search(r"\bsmall\b", text[pieces[at].start : pieces[i].start])
    return (
        small is not None and after[:1] == ["formula"] and not pieces[i + 1].relation and after[1:] in ([], [","], [":"], [";"])
    )
