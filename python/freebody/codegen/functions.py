"""Source code of functions that evaluate trees.

Every distinct subexpression is one node of a graph, found bottom-up by what it is made of; a node that is used twice gets a
name and is computed once."""

from __future__ import annotations

import keyword
import re
from collections.abc import Mapping, Sequence

from freebody.codegen.languages import LANGUAGES
from freebody.codegen.source import Language, Writer
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.symbols import ascii_name
from freebody.symbolic.tree import PI, Entries, Sym, Tree, symbols

_WORDS_OF_C = (
    "auto break case char const continue default do double else enum extern float for goto if inline int long register "
    "restrict return short signed sizeof static struct switch typedef union unsigned void volatile while"
)
_USED = "np _array q u p t a r out sin cos tan exp log atan2 fabs sign sqrt pow NAN INFINITY HUGE_VAL"
_RESERVED = frozenset([*_WORDS_OF_C.split(), *_USED.split(), *keyword.kwlist])
_HELP = {
    "q": "coordinates", "u": "rates of the coordinates", "p": "parameters", "t": "time in s",
    "a": "accelerations of the coordinates", "r": "unknowns: reactions and motors",
}  # fmt: skip


def generate(functions: Mapping[str, Entries], nomenclature: Nomenclature, language: str = "python") -> str:
    """Source code with one function for every name.

    A function takes ``q, u, p, t``: coordinates, their rates, parameters and constants as arrays in the order of the symbols,
    and time; behind them ``a`` (accelerations) and ``r`` (unknowns) if any of the functions needs those. In Python it returns a
    number or an array of the shape of the entries, with the shape of array arguments ``q[i]`` behind it. In C it is
    ``void name(const double *q, …, double *out)``, rows first, or returns a ``double``."""
    if language not in LANGUAGES:
        raise ValueError(f"language {language!r} is unknown; there are {', '.join(LANGUAGES)}")
    spelling = LANGUAGES[language]
    for name in functions:
        if not re.fullmatch(r"[A-Za-z_]\w*", name) or name in _RESERVED:
            raise ValueError(f"{name!r} cannot be the name of a function; letters, digits and underscores can")
    flat = {name: _flatten(entries) for name, entries in functions.items()}
    used, given = symbols(*(tree for trees, _ in flat.values() for tree in trees)), _arguments(nomenclature)
    places = {symbol: "t" if x == "t" else f"{x}[{i}]" for x, members in given.items() for i, symbol in enumerate(members)}
    for symbol in sorted(used - places.keys() - {Sym(PI)}, key=str):
        raise ValueError(f"{symbol.name!r} differentiated {symbol.dots} times is no argument; say what it is in the nomenclature")
    arrays = [x for x, members in given.items() if x in "qupt" or used & set(members)]
    made = [_function(name, trees, shape, places, arrays, spelling) for name, (trees, shape) in flat.items()]
    return spelling.file(_header(nomenclature, arrays), made)


def _arguments(nomenclature: Nomenclature) -> dict[str, list[Sym]]:
    """The symbols that stand in each array, in their order."""
    q, p, t, r = (nomenclature.of_kind(*kinds) for kinds in (("coordinate",), ("parameter", "constant"), ("time",), ("unknown",)))
    names = {"q": (q, 0), "u": (q, 1), "p": ([name for name in p if name != PI], 0), "t": (t, 0), "a": (q, 2), "r": (r, 0)}
    return {array: [Sym(name, dots) for name in held] for array, (held, dots) in names.items()}


def _flatten(entries: Entries) -> tuple[list[Tree], tuple[int, ...]]:
    if not isinstance(entries, Sequence):
        return [entries], ()
    if not entries:
        return [], (0,)
    parts = [_flatten(entry) for entry in entries]
    if len({shape for _, shape in parts}) != 1:
        raise ValueError("the rows of a matrix must be equally long")
    return [tree for trees, _ in parts for tree in trees], (len(parts), *parts[0][1])


def _header(nomenclature: Nomenclature, arrays: Sequence[str]) -> list[str]:
    given, lines = _arguments(nomenclature), []
    for array in arrays:
        lines.append(f"{array}: {_HELP[array]}")
        for place, symbol in enumerate(given[array] if array in "qpr" else ()):
            symbol = nomenclature[symbol.name]
            unit = f" [{symbol.unit}]" if symbol.unit else ""
            lines.append(f"    {array}[{place}] {symbol.name}{unit}{f': {symbol.doc}' if symbol.doc else ''}")
    return lines + [str(said) for name, said in nomenclature.renamed.items() if name in nomenclature]


def _function(
    name: str,
    trees: Sequence[Tree],
    shape: tuple[int, ...],
    places: Mapping[Sym, str],
    arrays: Sequence[str],
    spelling: Language,
) -> str:
    used, named = symbols(*trees), dict[Sym, str]()
    for symbol in (each for each in places if each in used):
        named[symbol] = "t" if places[symbol] == "t" else _identifier(symbol, set(named.values()))
    writer = Writer(spelling, named)
    results = writer.write(trees)
    loaded = [(name, places[symbol]) for symbol, name in named.items() if name != places[symbol]]
    return spelling.function(name, arrays, loaded + writer.steps, results, shape)


def _identifier(symbol: Sym, taken: set[str]) -> str:
    made = re.sub(r"\W", "_", ascii_name(symbol.name), flags=re.ASCII) + ("", "_dot", "_ddot")[symbol.dots]
    made = f"_{made}" if made[0].isdigit() else made
    # s1, s2 … are the names of shared subexpressions.
    while made in taken or made in _RESERVED or re.fullmatch(r"s\d+", made):
        made += "_"
    return made
