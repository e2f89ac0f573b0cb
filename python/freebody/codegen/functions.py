"""Source code of functions that evaluate trees.

Every distinct subexpression is one node of a graph, found bottom-up by what it is made of; a node that is used twice gets a
name and is computed once."""

from __future__ import annotations

import json
import keyword
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from freebody.codegen.languages import LANGUAGES, Language
from freebody.codegen.source import Writer
from freebody.document.templates import template
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.symbols import ascii_name
from freebody.symbolic.tree import PI, Entries, Sym, Tree, symbols

if TYPE_CHECKING:
    from freebody.codegen.systems import Systems

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


def generate(
    functions: Mapping[str, Entries], nomenclature: Nomenclature, language: str = "python", systems: Systems | None = None
) -> str:
    """Source code with one function for every name; of the functions of ``systems``, also what solves with them.

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
    for symbol in sorted(used - {Sym(PI)}.union(*given.values()), key=str):
        raise ValueError(f"{symbol.name!r} differentiated {symbol.dots} times is no argument; say what it is in the nomenclature")
    given = {x: members for x, members in given.items() if x in "qupt" or used & set(members)}
    made = [_function(name, trees, shape, given, spelling) for name, (trees, shape) in flat.items()]
    codes = [code for each in made for code in (*each["results"], *(value for _, value in each["steps"]))]
    return template(__package__, f"program.{spelling.ending}.j2").render(
        header=_header(nomenclature, given),
        arrays=list(given),
        functions=made,
        signs=any("sign(" in code for code in codes),
        systems=systems,
        quoted=json.dumps,
        repr=repr,
    )


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


def _header(nomenclature: Nomenclature, given: Mapping[str, Sequence[Sym]]) -> list[str]:
    lines = []
    for array, members in given.items():
        lines.append(f"{array}: {_HELP[array]}")
        for place, member in enumerate(members if array in "qpr" else ()):
            symbol = nomenclature[member.name]
            unit = f" [{symbol.unit}]" if symbol.unit else ""
            lines.append(f"    {array}[{place}] {symbol.name}{unit}{f': {symbol.doc}' if symbol.doc else ''}")
    return lines + [str(said) for name, said in nomenclature.renamed.items() if name in nomenclature]


def _function(
    name: str, trees: Sequence[Tree], shape: tuple[int, ...], given: Mapping[str, Sequence[Sym]], spelling: Language
) -> dict[str, Any]:
    """What a template needs to know of a function; ``idle``: the arguments that it does not use."""
    used, named, steps = symbols(*trees), dict[Sym, str](), []
    for array, members in given.items():
        for i, symbol in enumerate(members):
            if symbol in used:
                named[symbol] = "t" if array == "t" else _identifier(symbol, set(named.values()))
                steps += [] if array == "t" else [(named[symbol], f"{array}[{i}]")]
    writer = Writer(spelling, named)
    results, idle = writer.write(trees), [array for array, members in given.items() if not used & set(members)]
    return {"name": name, "shape": shape, "steps": steps + writer.steps, "results": results, "idle": idle}


def _identifier(symbol: Sym, taken: set[str]) -> str:
    made = re.sub(r"\W", "_", ascii_name(symbol.name), flags=re.ASCII) + ("", "_dot", "_ddot")[symbol.dots]
    made = f"_{made}" if made[0].isdigit() else made
    # s1, s2 … are the names of shared subexpressions.
    while made in taken or made in _RESERVED or re.fullmatch(r"s\d+", made):
        made += "_"
    return made
