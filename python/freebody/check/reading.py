"""A text read with the symbols of a model: what a statement says, in the ways in which its letters, units and arrows can be meant."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from freebody.core import cards
from freebody.model.errors import ModelProblem
from freebody.model.names import nearest
from freebody.symbolic.dimensions import NUMBER_ONLY
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Column, Dot, Fn, Matrix, Mul, Negative, Num, Pow, Sym, Unit, exchange, walk

from . import integrals
from .language.dimensions import check_dimensions, dimension, misfit
from .language.elimination import eliminated
from .language.parser import parse
from .language.sizes import with_sizes
from .language.spelling import spell as written
from .language.statements import Directed, Equation, Integral, Program, symbols_in
from .user_symbols import INITIAL, LARGEST, LEAST, Meaning
from .usual_names import ENERGIES

if TYPE_CHECKING:
    from .symbols import Symbols

_DAMPED = re.compile(r"\\?(omega|[ωTfτ])_(?:d(?!\w)|\{d\})")
"""ω_d and the like, which would be rates as programs have them."""
_OWNED = re.compile(r"(?<![\w.)])([^\W\d](?:[\w.]*\w)?)\.([A-Za-z]\w*)(?![\w.(])")
_FUNCTIONS = sorted(cards.functions().keys() | {"rate", "accel"})
_READING = re.compile(rf"(?<![\w.])(?:{'|'.join(_FUNCTIONS)})\s*\([^()]*\)")
_ASKED = re.compile(r"(.+?)(0|\(0\)|(?<=_)max|(?<=_)min)")
_SECOND = re.compile(r"(.+)_2")
_MOMENTS = {"max": f"{LARGEST}: ", "min": f"{LEAST}: "}
"""What is asked of a motion by an index."""
_WORD = 3
"""Letters of a name from which on one that is nearly another is a slip of the pen: T1 is none of T, lenght is length."""
_ARROWS = {"→": (1, "i"), "←": (-1, "i"), "↑": (1, "j"), "↓": (-1, "j")}
_MEASURE = re.compile(r"(?<![\w.])(?:[1-9]\d*\.\d+|[1-9]\d+)(?![eE][-+]?\d)\s*(?=[A-Za-z])")
"""A figure that may have a unit behind it; half a force is no half newton."""


class Reading:
    """A text that is read; what letters usually mean, where it needs that, becomes known as it goes. ``tight``: as ``parse`` has it."""

    def __init__(self, known: Symbols, text: str, tight: bool = False) -> None:
        self.known, self.text, self.tight = known, text, tight

    def program(self, units: bool = True) -> Program:
        """The statement that it is, with ``units`` for symbols of their names where dimensions fit only so. Raises ``StatementError``."""
        self._in_words_of_the_model()
        self._vibrating(f"{'ω' if found[1] == 'omega' else found[1]}_d" for found in _DAMPED.finditer(self.text))
        self._vibrating(self.known.vibration.forced if self.known.vibration else ())
        program = self._parsed(self.known.names)
        if {"d", "dd"} & self.known.bodies:  # x_d is a place, not ẋ as programs have it
            self._add(self.known.printed.plain, program)
            program = self._parsed(self.known.names)
        # what printed equations call things comes after the symbols of the model, and then what letters usually mean
        usual = (lambda: self.known.usual, lambda: self._initial(program))
        for added in (lambda: self.known.printed.plain, lambda: self.known.printed.momenta, *usual):
            if self._unknown(program):
                self._add(added(), program, assumed=added in usual)
                program = self._parsed(self.known.names)
        names = self.known.names
        if clashing := self._clashing(program):
            names = tuple(name for name in names if name not in clashing)
            program = self._parsed(names)
        program = self._eliminated(program)
        if self._unknown(program):
            self._add(ENERGIES, program, assumed=True)
            self._vibrating(n.name for n in self._unknown(program) if not n.dots)
            names = (*names, *(name for name in self.known.names if name not in names))
            program = self._eliminated(self._parsed(names), chains=True)
        self._require_written_out(program)
        return self._sized(self._fitting(self._exponential(program), names, units))

    def _exponential(self, program: Program) -> Program:
        """The same with e^(…) as the exponential function where e is a length, say, which nothing but a number can be an exponent of."""
        measures = {name for name, dimension in self.known.dimensions.items() if dimension != NUMBER_ONLY}
        for node in [n for n in walk(program) if isinstance(n, Pow) and n.base == Sym("e") and "e" in measures]:
            if any(isinstance(n, Sym) for n in walk(node.exponent)):
                program = exchange(program, node, Fn("exp", (node.exponent,), span=node.span))
        return program

    def _in_words_of_the_model(self) -> None:
        """What is asked in the model's own words, ``ax(rod.G)``, ``energy()``, ``accel(s)``, becomes a symbol. Raises ``StatementError``."""
        for found in _READING.finditer(self.text):
            name = "".join(found[0].split())
            if name not in self.known.meanings:
                with suppress(ModelProblem):
                    measured, dimension = self.known.measure(name)
                    self.known.put(name, Meaning("reading", (measured,), dimension))
        for found in _OWNED.finditer(self.text):
            owner, word = found.groups()
            if owner in self.known.named.owners and found[0] not in self.known.meanings:
                has = [name.removeprefix(f"{owner}.") for name in self.known.meanings if name.startswith(f"{owner}.")]
                hint = f"it has {', '.join(has)}" if has else "nothing can be read of it"
                raise StatementError(f"`{owner}` has no `{word}`", found.span(), hint, self.text)

    def _require_written_out(self, program: Program) -> None:
        """Raises ``StatementError`` where something is differentiated partially that holds a symbol of which it is not known how it
        depends on coordinates."""
        if not re.search(r"∂|\\partial", program.text):
            return
        lasting = ("initial", "inertia", "vibration")
        for n in symbols_in(program):
            if n.name in self.known.assumed and n.name in self.known.meanings and self.known.meanings[n.name].kind not in lasting:
                what = f"what ∂ makes of `{n.name}` is not known: it is not written out"
                raise StatementError(what, n.span, f"give it in a line: `{n.name} = …`", program.text)

    def _parsed(self, names: Sequence[str], **way: bool) -> Program:
        """The lines of the text, with integrals of what has a meaning as symbols of their own, and with directions for arrows."""
        program = parse(self.text, names, self.known.constants, no_rates=self.known.no_rates, **{"tight": self.tight, **way})
        constants = self.known.of_kind("parameter", "gravity")
        for node in [n for n in walk(program) if isinstance(n, Integral)]:
            if all(n.name in self.known.meanings for n in (*symbols_in(node.of), node.by)):
                name = f"∫_({written(node.lower)})^({written(node.upper)}) {written(node.of)} d{node.by.name}"
                found = integrals.meaning(node, self.known.meanings, lambda of: self.known.measured(written(of))[0], constants)
                parts = [dimension(part, self.known.dimensions) for part in (node.of, node.by)]
                size = parts[0].times(parts[1]) if None not in parts else None
                self.known.put(name, replace(found, dimension=size))
                program = exchange(program, node, Sym(name, span=node.span))
        return self._directed(program)

    def _directed(self, program: Program) -> Program:
        """The lines, where an arrow behind what a vector is said to be is a direction; one behind a number says nothing."""
        self.known.unjudged.clear()
        for line in [line for line in program.lines if isinstance(line, Equation) and isinstance(line.right, Directed)]:
            of, arrow = line.right.of, line.right.arrow
            vector = isinstance(line.left, Sym) and line.left.name in self.known.meanings
            if vector and self.known.meanings[line.left.name].is_vector and arrow in _ARROWS:
                sign, axis = _ARROWS[arrow]
                along = Mul((of, Sym(axis)), span=of.span)
                of = Negative(along, span=of.span) if sign < 0 else along
            else:
                self.known.unjudged.add(arrow)
            program = exchange(program, line.right, of)
        for found in [n for n in walk(program) if isinstance(n, Directed)]:  # behind what a letter is given
            self.known.unjudged.add(found.arrow)
            program = exchange(program, found, found.of)
        return program

    def _fitting(self, program: Program, names: Sequence[str], units: bool) -> Program:
        """The same, or where its dimensions do not fit, as it fits: T a period, 5 m/s a speed though m and s are symbols, 2k/3m with m below
        the stroke."""
        energy = self.known.meanings.get("T") if "T" in self.known.assumed else None
        period = self.known.vibration.meanings(["period"]).get("period") if energy and self.known.vibration else None
        of_numbers = all(n.name in (*self.known.constants, "T") for n in symbols_in(program))
        fits = not misfit(program, self.known.dimensions, strictly=True)
        if fits and not (period and of_numbers):  # a kinetic energy changes
            return self._measured(program, names) if units else program
        ways = [*([{"units": True}] if units else []), {"apart": True}, {"tight": True}]
        for meaning in ((period, energy) if fits else (energy, period)) if period else (None,):
            if meaning:
                self.known.meanings["T"] = meaning
            for way in ([{}] if meaning and meaning is period else []) + ways:
                with suppress(StatementError):
                    other = self._eliminated(self._parsed(names, **way))
                    check_dimensions(other, self.known.dimensions)
                    if meaning and meaning is period:
                        self._vibrates("T", meaning)
                    return other
        if energy:
            self.known.meanings["T"] = energy
        return program

    def _measured(self, program: Program, names: Sequence[str]) -> Program:
        """The same, where 98.1 N is a measure though N is a symbol, if dimensions fit so, too."""
        if measures := {found.end() for found in _MEASURE.finditer(self.text)}:
            with suppress(StatementError):
                other = self._eliminated(self._parsed(names, units=True), chains=True)
                said, units = ({n.span[0] for n in walk(each) if isinstance(n, Unit)} for each in (program, other))
                if said < units <= said | measures and not misfit(other, self.known.dimensions, strictly=True):
                    return other
        return program

    def _sized(self, program: Program) -> Program:
        """The same with letters that usually are vectors as their sizes, where it makes sense only so."""
        vectors = {name for name, m in self.known.meanings.items() if m.is_vector}
        for node in [n for n in walk(program) if isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.name in vectors]:
            if isinstance(node.exponent, Num) and node.exponent.value == 2:  # v² is v · v
                program = exchange(program, node, Dot(node.base, node.base, span=node.span))
        loose = {name for name in vectors - self.known.own if re.match("[vra](_|$)", name)}
        program, sized = with_sizes(program, vectors, loose)
        self.known.assumed |= {name: f"the size of {self.known.assumed.get(name, name)}, without a sign" for name in sized}
        return program

    def _vibrating(self, names: Iterable[str]) -> None:
        """What a small vibration has, where names without a meaning may be that."""
        known = {folded(name) for name in self.known.meanings}
        asked = [name for name in names if folded(name) not in known]
        for name, meaning in self.known.vibration.meanings(asked).items() if self.known.vibration else ():
            self.known.put(name, meaning)
            self._vibrates(name, meaning)

    def _vibrates(self, name: str, meaning: Meaning) -> None:
        self.known.assumed[name] = (
            f"the {meaning.texts[0].removeprefix('the ')} of small vibrations about {self.known.vibration.place}"  # type: ignore[union-attr]
        )

    def _initial(self, program: Program) -> dict[str, str]:
        """Of symbols with the index 0, max or min what is asked: θ₀, v₀, θ(0), N_max, of anything that has a meaning without it."""
        known = {
            **{folded(name): name for name in self.known.meanings},
            **{folded(name): said for name, said in ENERGIES.items()},
        }
        found = {}
        for name in dict.fromkeys(n.name for n in self._unknown(program)):
            if not (asked := _ASKED.fullmatch(name)):
                continue
            base = known.get(folded(asked[1].rstrip("_")))
            if base in self.known.meanings and self.known.meanings[base].is_vector:
                base = "hypot({}, {})".format(*self.known.meanings[base].texts[:2])
            if base:
                found[name] = f"{_MOMENTS.get(asked[2], INITIAL)}{base}"
        return {**self._at_ends(program), **found}

    def _at_ends(self, program: Program) -> dict[str, str]:
        """Of the only coordinate and its rate at the beginning and the end of a stretch, v_1 and v_2, what is asked."""
        if len(self.known.metadata["coordinates"]) > 1 or len(self.known.metadata["bodies"]) > 1:
            return {}
        known, unknown = {folded(name): name for name in self.known.meanings}, {n.name for n in self._unknown(program)}
        pairs = [(found[1], name) for name in sorted(unknown) if (found := _SECOND.fullmatch(name))]
        bases = [(known[folded(base)], base, name) for base, name in pairs if folded(base) in known]
        return {
            end: said
            for meant, base, name in bases
            if (first := f"{base}_1") in unknown
            for end, said in ((first, f"{INITIAL}{meant}"), (name, meant))
        }

    def _add(self, found: Mapping[str, str], program: Program, assumed: bool = False) -> None:
        """Symbols that are not taken by what there is, or by a line of the statement; of those that are only ``assumed``, which a
        statement needs."""
        taken = {folded(name) for name in (*self.known.meanings, *(line.name.name for line in program.assignments))}
        written = folded(re.sub(r"[\\{}\s]", "", program.text))
        unknown = [folded(n.name) for n in self._unknown(program)]
        for name, said in found.items():
            if folded(name) not in taken and (not assumed or any(folded(name) in text for text in (written, *unknown))):
                with suppress(ModelProblem):
                    self.known.declare(name, said)
                    self.known.assumed |= {name: said} if assumed else {}

    def _unknown(self, program: Program) -> list[Sym]:
        """The symbols of a program that have no meaning."""
        given = {line.name for line in program.assignments}
        return [n for n in symbols_in(program) if n.name not in self.known.meanings and n not in given]

    def _eliminated(self, program: Program, chains: bool = False) -> Program:
        """The lines without unknowns of the writer's own, ``chains`` as in ``eliminated``; a word that is nearly one of the model is a
        slip, and none of them."""
        own = [n for n in self._unknown(program) if not n.dots and not self._is_slip(n.name)]
        return eliminated(program, own, chains) if own else program

    def _is_slip(self, name: str) -> bool:
        """Whether a name is one of the model but for a slip of the pen; T_A is none of r_A, but N_b is of N_B."""
        near = nearest(name, self.known.meanings) if len(name) >= _WORD else None
        return near is not None and (len(name.partition("_")[0]) >= _WORD or near.lower() == name.lower())

    def _clashing(self, program: Program) -> set[str]:
        """Symbols of the model to which a line of several gives a meaning of its own: what stands there cannot be theirs."""
        found = set()
        for line in program.equations if len(program.lines) > 1 else ():
            meaning = self.known.meanings.get(line.left.name) if isinstance(line.left, Sym) and not line.left.dots else None
            if meaning is not None and line.left.name not in self.known.declared:
                moves = any(isinstance(n, Sym) and n.name not in self.known.constants for n in walk(line.right))
                other = meaning.kind == "direction" or (meaning.kind in ("parameter", "gravity") and moves)
                other |= isinstance(line.right, Column | Matrix) and not meaning.is_vector
                if other or misfit(Program((line,)), self.known.dimensions, strictly=True):
                    found.add(line.left.name)
        return found
