"""Words of sentences around equations: with which a condition begins, with which the main clause goes on, and what conditions are called."""

from __future__ import annotations

import re


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


CONJUNCTION = re.compile(
    r"\b(?:(?:just|right|immediately|directly|shortly|even) )?(?:(?:as|so) (?:long|soon) as|by the time|from the (?:instant|moment) (?=when|that|the|it)"
    r"|while|when(?:ever)?|once|after|before|until|during|if|provided(?: that)?|assuming(?: that)?|supposing(?: that)?|suppose|upon)\b",
    re.I,
)
"""With which a clause begins that says when."""
PREPOSITIONS = _words("on in at against with without for near")
"""With which a place or a circumstance begins."""
CIRCUMSTANCES = _words(
    "at in on with without for from near neglecting ignoring about under the a an no nothing both all it everything"
)
"""With which words begin that may say when."""
CONDITIONAL = _words(
    "set setting put putting let letting suppose supposing take taking assume assuming choose choosing given provided if "
    "when whenever where while once until after before with at for as from near nearly through past passes reaches because "
    "since case means"
)
"""Words behind which a relation is a condition."""
AMBIGUOUS = _words("with at for from as near nearly past through since because where means case")
"""Those of them behind which it may be what is claimed as well: ``swings at ω = …``."""
ADJACENT = 5  # words before a relation among which one of these makes it a condition, or one from which another follows
PREMISES = _words(
    "differentiate differentiating using eliminate eliminating insert inserting substitute substituting combine combining "
    "integrate integrating add adding divide dividing solve solving"
)
"""Words behind which a relation is one from which another follows."""
VERBS = _words(
    "is are was become becomes give gives yield yields get gets have has find finds obtain obtains follow follows read "
    "reads result results remain remains means"
)
"""Words behind which a relation is claimed, whatever stands before them."""
LEADS = _words(
    "obey obeys say says hold holds stay stays satisfy satisfies equal equals need needs must that so then hence therefore "
    "thus to by law equation relation condition rule answer according there us out we and it only"
)
"""Words behind which a relation is claimed, unless it is a premise."""
SHORT = 6
"""Words of a clause at most in which a condition is named, and not spoken of."""
PRONOUNS = _words("it he she they we you there which one everything nothing its their his her this that so then")
DETERMINERS = _words("the a an every each both all no")
FOLLOWED = _words(
    "at in on with for from of to by about against along over under into through toward towards round around off up down "
    "than as and or is are was has have had been between near past after before during until while when once if out not "
    "still just only left leave leaves leaving hit hits strike strikes struck reach reaches reached touch touches touched "
    "meet meets met passes passed catch catches caught lost loses let lets cut cuts carries carried carry press presses "
    "pressed takes taken took comes gets"
)
"""Words behind which an article goes on with the same clause."""
AWAY = re.compile(r"\b(?:[a-z]{2,}wn|back|again|off|away|loose|on it)\b")
"""What has become of something: ``thrown back``."""
NAMED_VALUES, IS = ("period", "frequency"), ("is", "of", "then", "becomes", "was", "equals")
"""What is said to be a value without a letter, and words between."""
VANISHES = re.compile(
    r"(?:is|are|must be|has to be|becomes?|equals) (?:equal to )?(?:zero|nought|nothing)|vanish(?:es)?|must vanish", re.I
)
_WORDS: tuple[tuple[str, str], ...] = (
    (r"\bi\.\s?e\.?", "that is"),
    (r"\be\.\s?g\.?", "for instance"),
    (r"\b(eqs?|lin|mom|imp|max|min|const|approx|resp|fig|vib|osc)\.", r"\1"),
    (r"\b(?-i:I) (?=(?:take|get|have|find|obtain|write|use|put|set|need|think|had|wrote|then|can|would)\b)", "we "),
    (r"\bpost[- ](?=[a-z])", "after the "),
    (r"\bpre[- ](?=(?:impact|blow|collision|release|contact|slip)\b)", "just before the "),
    (r"\b(?:right|directly|immediately|straight|shortly) (?=(?:after|before)\b)", "just "),
    (r"\bdirectly behind (?=(?:the|a) )", "just after "),
    (r"\b(?:right|just|immediately|directly) afterwards?\b", "just after that"),
    (r"\b(?:at |in )?the last (?:moment|instant) before\b", "just before"),
    (r"\b(?:crash|smash)\b", "impact"),
    (r"\bletting go\b", "the release"),
    (r"\s&\s", ", "),
    (r"\b(?:at|in) the (?:instant|moment|time) (?=(?:after|before|when|where|that|at which)\b)", ""),
    (r"\bthe (?:instant|moment) (?:that |at which )?(?=(?:the|it|he|she|they|both)\b)", "when "),
    (r"\bby the time (?:that )?", "when "),
    (r"\b(has|have|had) come to a (?:stop|halt|standstill)", r"\1 come to rest"),
    (r"\bno longer (?:turns?|moves?|rotates?|runs?)\b", "has come to rest"),
    (r"\btill\b", "until"),
    (r"\bwhilst\b", "while"),
    (r"\bfor as long as\b", "as long as"),
    (r"\b(?:so|as) soon as\b", "once"),
)
"""What is written, and the plainer words that are read for it."""
_REST = r"(?:rest|standstill|no (?:initial )?(?:speed|velocity)|zero (?:speed|velocity))"
_SAYS: tuple[tuple[str, str], ...] = (
    (
        r"small|little|slight(?:ly)?|tiny|infinitesimal|lin|lineari[sz]\w*|linear (?:in|theory|approximation|terms)|first order|nearly|almost|close to",
        "for small motions",
    ),
    (
        r"steady[ -]state|stationary|transients?|settled|died (?:away|out|down)|decayed|faded|steady (?:motion|vibration|response|running|oscillation)",
        "in the steady state",
    ),
    (
        rf"(?:start(?:s|ed|ing)?|releas(?:e|ed)|let go|dropped|beg(?:in|ins|an|un)|set free) (?:[a-z]+ )?(?:(?:from|at|with) )?{_REST}|from (?:a )?{_REST}|(?:was|were) (?:all )?(?:still )?at rest"
        rf"|{_REST} (?:at|in) (?:the )?(?:start|beginning|first|t = 0)|at rest (?:initially|at first)|without (?:an? )?(?:initial )?(?:speed|velocity|push)|(?:was|were) still\b"
        r"|nothing moving yet|(?:with )?no speed|zero speed",
        "if the start is at rest",
    ),
    (
        r"equilibrium|(?:held|kept|stands?|standing|holds?|hangs?|hanging|sits?|is|stays?) (?:perfectly |quite )?(?:still|motionless)|nothing moves|motionless|statics?"
        r"|does not move|in balance|standing still",
        "in equilibrium",
    ),
    (
        r"(?<!momentarily )(?<!instantaneously )(?<!moment )(?<!come to )(?<!comes to )at rest(?! again| for (?:a|an) (?:moment|instant))",
        "at rest",
    ),
    (
        r"first (?:instant|moment)|releas(?:e|ed)|let go|set free|at (?:the )?(?:very )?(?:start|beginning|outset)|initial(?:ly)?|starts to move",
        "at the start",
    ),
    (
        r"(?:constant|steady|uniform|unchanging) (?:speed|velocity|rate|pace)|without acceleration|(?:does|is) not accelerat\w+|uniformly",
        "at constant speed",
    ),
    (
        r"(?:without|no|neglecting|ignoring|disregarding) (?:the |any )?(?:damping|damper|dashpot)|undamped|dashpot (?:removed|off|away)",
        "without damping",
    ),
    (r"(?:without|no|neglecting|ignoring|disregarding) (?:the |any )?friction|frictionless", "without friction"),
    (
        r"after (?:the |a )?(?:way|distance|time|angle|path|turn)(?: of)? \S{1,4}|the time \S{1,3} has (?:gone by|passed|elapsed)",
        "if from the start",
    ),
    (r"(?:highest|top(?:most)?|greatest height)(?: (?:point|place|position))?(?! speed)", "at the highest point"),
    (
        r"lowest(?: (?:point|place|position))?|bottom of (?:the|its) (?:fall|way|path|swing|motion)|deepest point",
        "at the lowest point",
    ),
    (
        r"(?:momentarily|instantaneously|for (?:a|an) (?:moment|instant)) (?:at rest|stands? still|stops)|(?:at rest|stands? still|stops) for (?:a|an) (?:moment|instant)|turning point|turns? (?:back|round)",
        "at the turning point",
    ),
    (
        r"impending (?:slip|motion|slid)\w*|(?:on the (?:point|verge) of|about to|just (?:does|do) not) (?:slip|slid|mov)\w*|just not slip\w*",
        "just before it slips",
    ),
)
"""What is found in a condition, and how it is said in few words."""
FROM_REST, FROM_START, SMALL = "if the start is at rest", "if from the start", "for small motions"
_NOT_WITH_REST = ("in equilibrium", "at rest", "at the start")


def plain_words(text: str) -> str:
    """Sentences with plainer words for some that mean the same."""
    for written, read in _WORDS:
        text = re.sub(written, read, text, flags=re.I)
    return text


def says(words: str) -> list[str]:
    """Conditions that words may name."""
    found = [condition for said, condition in _SAYS if re.search(rf"\b(?:{said})(?!\w)", words, re.I)]
    return [each for each in found if each not in _NOT_WITH_REST] if FROM_REST in found else found
