"""What the symbols of a statement mean in a model."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from freebody.model import meanings
from freebody.model.errors import ModelProblem
from freebody.model.names import nearest, replace_names, spell
from freebody.model.writer import Writer
from freebody.run.records import quote
from freebody.symbolic.dimensions import ACCELERATION, ANGLE, LENGTH, NUMBER_ONLY, PER_SECOND, TIME, Dimension
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Num, Sym, Unit, exchange, substitute, walk

from .asked_model import with_gravity
from .language.dimensions import misfit
from .language.elimination import Elimination
from .language.parser import parse_expression
from .language.spelling import spell as written
from .language.statements import Program, inlined
from .language.tokens import Names
from .printed_symbols import PrintedSymbols
from .reading import Reading
from .user_symbols import OF_START, Array, Meaning, Reader
from .usual_names import senses, usual

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .families import Samples
    from .vibration import Vibration

_WITHOUT = {
    "contact": {"tension", "slack"},
    "string": {"N", "T", "gap", "x", "y", "slip"},
    "stop": {"T", "tension", "slack", "x", "y", "slip"},
}
"""Readings of every limit that say nothing of one kind."""
_NO_FORCE = ("gap", "slack", "slip", "x", "y", "power", "work")
_CENTRE = re.compile(r"\bcentre_([xy])\(\)")
_NAME = re.compile(r"[^\W\d_][^\s=+*^;,:$%#@!?~`\\\"<>|&\x00-\x1f]*")
_WORD = re.compile(r"(?<![\w.])[^\W\d]\w*")
_OF_ANGLE = re.compile(r"\b(?:sin|cos)\(s\)")
_FUNCTIONS = ("sqrt", "sin", "cos", "tan", "pi")
"""Of parameters, what does not change."""
_SHORT = {"Fx": "x", "Fy": "y"}
DOUBTFUL = re.compile(r"/\s*\d+[^\W\d]")
_INVERSE = re.compile(r"(?:sin|cos|tan)h?\s*(?:⁻¹|\^\s*\{?\s*\(?[-−]\s*1)")
"""2k/3m, of which only a person knows whether m is below the stroke."""
_DIRECTIONS = {"i": ("1", "0", "0"), "j": ("0", "1", "0"), "k": ("0", "0", "1")}


class Symbols:
    """All symbols that a statement about a model may use.

    By themselves: parameters, coordinates and gauges (with dots: rates, accelerations), ``t``, ``g``, the unit vectors ``i j k``,
    and forces by the names of what makes them (``pivot.Fx`` or ``pivot_x``, ``floor.N``, ``motor.value``).

    ``declared`` adds own ones, each as

    - an expression of the model language, earlier symbols included: ``phi: theta - alpha``;
    - components of a vector: ``[x(upper.G) - x(ground.O), y(upper.G) - y(ground.O)]``;
    - a phrase: ``position of P``, ``… from Q``; ``velocity of P relative to Q``, ``acceleration of …``;
      ``direction from P to Q`` (a unit vector), ``normal from P to Q`` (a quarter turn to its left); ``force of JOINT on BODY``,
      ``couple of JOINT on BODY``; ``force on BODY, …`` (all of them), ``moment on BODY, … about P``,
      ``angular momentum of BODY, … about P`` (``all`` bodies, too).

    Rates of declared symbols follow. ``gravity``: the parameter that stands for it, where it was made one.
    Raises ``ModelProblem`` for a declaration that means nothing.
    """

    def __init__(
        self,
        mechanism: Builder,
        declared: Mapping[str, str | Sequence[str | float]] | None = None,
        gravity: str | None = None,
        printed: PrintedSymbols | None = None,
        vibration: Vibration | None = None,
    ) -> None:
        self.vibration = vibration
        self.printed = printed or PrintedSymbols(mechanism)
        lowered = mechanism.lowered()
        self.spec, self.start = lowered.spec, lowered.start
        self.named = meanings.meanings(lowered.root)
        if gravity is not None:
            self.named.values.setdefault(gravity, ("parameter", ACCELERATION))
        self.writer = Writer(lowered.root, self.named, {})
        self.metadata = mechanism.source().metadata
        self.bodies = frozenset(spell(body["name"]) for body in self.metadata["bodies"])
        self.meanings: dict[str, Meaning] = self._own(gravity)
        self.declared: set[str] = set()
        self.own = frozenset(declared or ())
        self.assumed: dict[str, str] = {}  # what letters usually mean, where a statement needed that
        self.no_place: frozenset[str] = frozenset()  # joints, forces and masses that are not of a balance
        self.of_energy = False  # whether a label calls what is read an energy
        self.unjudged: set[str] = set()  # arrows behind what is no vector
        self.hidden: dict[str, str] = {}  # what of the model an own symbol stands before, in words
        self._measure_gauges()
        for name, said in (declared or {}).items():
            try:
                self.declare(name, self._with_gravity(said, gravity))
            except ModelProblem as problem:
                self._declare_as_stated(name, said, problem)
            self._hide_others(name)

    def _with_gravity(self, said: str | Sequence[str | float], gravity: str | None) -> str | Sequence[str | float]:
        """What a letter stands for, with the symbol of gravity for its number: 9.81 in it is no other one."""
        pull = self.spec.get("gravity")
        if gravity is None or not isinstance(said, str) or not pull:
            return said
        return with_gravity(said, -pull[1], gravity)

    # --- what there is -------------------------------------------------------------------------

    @property
    def names(self) -> tuple[str, ...]:
        """All symbols, for ``parse``."""
        return tuple(self.meanings)

    @property
    def dimensions(self) -> dict[str, Dimension]:
        """The dimension of each symbol where it is known, for ``check_dimensions``."""
        return {name: m.dimension for name, m in self.meanings.items() if m.dimension is not None}

    @property
    def no_rates(self) -> list[str]:
        """Symbols that are no rates by their dimension, and make no angle with a time."""
        return [name for name, its in self.dimensions.items() if its._replace(angle=0) != PER_SECOND]

    def of_kind(self, *kinds: str) -> list[str]:
        """Symbols that are ``parameter``, ``coordinate``, ``gauge``, ``reaction``, ``direction``, ``declared`` …, scalar or vector."""
        return [name for name, m in self.meanings.items() if m.kind in kinds]

    @property
    def constants(self) -> list[str]:
        """Symbols that do not change with time; letters for what parameters make are among them."""
        parameters = (name for name, (kind, _) in self.named.values.items() if kind == "parameter")  # also behind another name
        still = {*map(spell, parameters), *_FUNCTIONS}
        made = [n for n in self.of_kind("declared") if all({*_WORD.findall(text)} <= still for text in self.meanings[n].texts)]
        return [*self.of_kind("parameter", "gravity", "direction", "initial", "vibration", "inertia"), *made]

    def read(self, text: str, units: bool = True, tight: bool = False) -> Program:
        """The statement that a text is, see ``Reading``. Raises ``StatementError``."""
        return Reading(self, text, tight).program(units)

    def notes(self, program: Program) -> tuple[str, ...]:
        """Of each symbol of a program that usually means something else what that is called here."""
        said_names = {n.name for n in walk(program) if isinstance(n, Sym)} - {line.name.name for line in program.assignments}
        used = {folded(n.name) for n in walk(program) if isinstance(n, Sym)}
        own = [line.name.name for line in program.assignments if line.name.name in self.meanings and not line.name.dots]
        clashes = [
            f"Here {name} is what the statement gives that name, not the {self.meanings[name].kind} of the model." for name in own
        ]
        clashes += [
            f"Here {n} is what is declared, not {other} of the model." for n, other in self.hidden.items() if folded(n) in used
        ]
        gone = [line for line in program.assignments if isinstance(line, Elimination)]
        said = [re.split(r"[;\n]", program.text[line.span[0] :])[0].strip() for line in gone]
        made = [f"Here {line.name.name} is what `{text}` makes it." for line, text in zip(gone, said, strict=True)]
        made += [f"Here {name} is read as: {self.assumed[name]}." for name in self.assumed if name in said_names]
        doubtful = DOUBTFUL.search(program.text) and misfit(program, self.dimensions)
        if program.tight or program.apart or doubtful or _INVERSE.search(program.text):
            made.append(f"It is read as: {written(program)}")
        made += [f"The arrow {arrow} is not judged: it stands behind what is no vector here." for arrow in self.unjudged]
        return (*clashes, *made, *(str(each) for each in self.printed.renamed if folded(each.usual.unicode()) in used))

    # --- values --------------------------------------------------------------------------------

    def require(self, program: Program) -> list[Sym]:
        """The symbols of a program that need values. Raises ``StatementError`` at one that has no meaning."""
        given = {line.name for line in program.assignments}
        found: dict[Sym, None] = {}
        for node in walk(program):
            if isinstance(node, Sym) and node not in given:
                try:
                    self._meaning(node).needed(node.dots)
                except ModelProblem as problem:
                    raise StatementError(problem.what, node.span, problem.hint, program.text) from None
                found[node] = None
        return list(found)

    def values(self, found: Sequence[Sym], samples: Samples) -> dict[str, Array]:
        """The symbols on true states, by ``Sym.key``: (K,), vectors (K, 3)."""
        texts = dict.fromkeys(text for n in found for text in self._meaning(n).needed(n.dots))
        known = samples.values(list(texts))
        return {n.key: self._meaning(n).value(n.dots, known, samples.masses) for n in found}

    def _meaning(self, symbol: Sym) -> Meaning:
        if symbol.name in self.meanings:
            return self.meanings[symbol.name]
        bare = symbol.name.rstrip("'")
        near = next((name for name in self.meanings if name.endswith(f".{bare}")), nearest(symbol.name, self.meanings))
        hint = f"did you mean `{near}`? Otherwise d" if near else "d"
        hint += f"eclare it, like `{bare}: …`, on the command line by `--where '{bare}=…'`"
        raise ModelProblem(f"the symbol `{symbol.name}` has no meaning in this model", hint)

    def expression(self, text: str) -> str:
        """An expression of a statement in the model language; what is asked of the start of a motion between ⟦ and ⟧. Raises
        ``StatementError`` and ``ModelProblem``."""
        program = self.read(f"{text} = 0")
        (line, *others), given = inlined(program), {}
        if others:
            raise ModelProblem(f"`{text}` is more than one expression", "write one, without a sign of equality")
        for symbol in self.require(program):
            meaning = self._meaning(symbol)
            said = (
                ()
                if meaning.is_vector or meaning.kind in ("integral", "quadrature", "vibration")
                else meaning.needed(symbol.dots)
            )
            if len(said) != 1:
                raise ModelProblem(f"`{symbol.key}` cannot stand in a condition")
            given[symbol] = Sym(f"({said[0]})")
        found = substitute(line.left, given)
        for unit in [n for n in walk(found) if isinstance(n, Unit)]:
            found = exchange(found, unit, Num(unit.size))
        return written(found)

    # --- building ------------------------------------------------------------------------------

    def _own(self, gravity: str | None) -> dict[str, Meaning]:
        there = {c["name"] for part in ("coordinates", "closure_coordinates") for c in self.metadata[part]}
        values = ((name, *v) for name, v in self.named.values.items() if v[0] != "coordinate" or name in there)
        out = {name: Meaning(kind, (spell(name),), dimension) for name, kind, dimension in values}
        for coordinate in self.metadata["coordinates"]:
            name = coordinate["name"]
            if not coordinate["dimension"] and coordinate["joint"] in self._round and (own := out.get(name)):
                out[name] = replace(own, dimension=ANGLE)
            out.setdefault(name, Meaning("coordinate", (spell(name),), LENGTH if coordinate["dimension"] == "m" else ANGLE))
            owner, _, stem = name.rpartition(".")
            if owner:
                out.setdefault(f"{stem}_{owner}", out[name])  # as LaTeX prints it
        out.setdefault("t", Meaning("time", ("t",), TIME))
        x, y = self.spec["gravity"] or (None, None)
        if gravity or x == 0:  # it points down
            down = gravity or (repr(-y) if isinstance(y, int | float) else f"-({y})")
            out.setdefault("g", Meaning("gravity", (down,), ACCELERATION))
        for name, texts in _DIRECTIONS.items():
            out.setdefault(name, Meaning("direction", texts, NUMBER_ONLY))
        for name, meaning in self._reactions().items():
            out.setdefault(name, meaning)
        return out

    @cached_property
    def _round(self) -> set[str]:
        """Joints along curves whose own coordinate is an angle, as that of a circle is."""
        angular = {curve["name"] for curve in self.spec["curves"] if _OF_ANGLE.search(f"{curve['x']} {curve['y']}")}
        return {joint["name"] for joint in self.spec["joints"] if str(joint["with"].get("along")) in angular}

    def _measure_gauges(self) -> None:
        """Gauges have the dimension of their expression, where that has one, and so do letters for them."""
        for gauge in self.spec["gauges"]:
            if (own := self.meanings.get(name := gauge["name"])) is not None and own.dimension is None:
                with suppress(ModelProblem):
                    self.meanings[name] = replace(own, dimension=self.measure(str(gauge["value"]))[1])
                    self.named.values[name] = (own.kind, self.meanings[name].dimension)

    def _reactions(self) -> dict[str, Meaning]:
        """Forces by the names of what makes them, in two spellings."""
        out: dict[str, Meaning] = {}
        rough = {joint["name"] for joint in self.spec["joints"] if joint.get("friction")}
        joints = {joint["name"]: joint for joint in self.metadata["joints"] if joint["reaction"]}
        for owner, kind in self.named.owners.items():
            if kind == "joint" and owner not in joints:
                continue
            absent = _WITHOUT.get(kind, set()) | (set() if owner in rough else {"friction"})
            absent |= {"M"} if kind == "joint" and not joints[owner]["couple"] else set()
            for part in (word for word in self.named.readings[owner] if word not in absent):
                text, force = f"{spell(owner)}.{part}", part not in _NO_FORCE
                dimension = self.named.dimension(f"{owner}.{part}", self.writer.scope)
                endings = [f".{part}", *([f"_{part}", f"_{_SHORT.get(part, part)}"] if force else [])]
                names = (text, *(f"{owner.replace(' ', '_')}{ending}" for ending in endings))
                out |= dict.fromkeys(names, Meaning("reaction" if force else "reading", (text,), dimension))
        return out

    def declare(self, name: str, said: str | Sequence[str | float]) -> None:
        if not _NAME.fullmatch(name):
            hint = "begin it with a letter, and leave out blanks and signs"
            raise ModelProblem(f"`{' '.join(name.split())}` is no name of a symbol", hint)
        bodies = [b["name"] for b in self.metadata["bodies"]]
        particles = frozenset(b["name"] for b in self.metadata["bodies"] if b.get("particle"))
        joints = {j["name"]: (j["first"], j["second"]) for j in self.metadata["joints"]}
        try:
            read = Reader(self.measured, joints, bodies, particles, self._happenings).read
            self.put(name, read(" ".join(said.split()) if isinstance(said, str) else said))
        except ModelProblem as problem:
            raise ModelProblem(f"symbol `{name}`: {problem.what}", problem.hint) from None

    @property
    def _happenings(self) -> list[str]:
        """The events of the model, and its parts that may change how it moves."""
        kinds = ("events", "contacts", "strings", "stops", "joints", "forces")
        names = [part["name"] for kind in kinds for part in self.spec[kind]]
        return [*dict.fromkeys(each for name in names for each in (name, name.partition(".")[0]))]

    def _declare_as_stated(self, name: str, said: str | Sequence[str | float], problem: ModelProblem) -> None:
        """A symbol by an expression in which something is asked of the start: ``2 v_0/g``."""
        with suppress(StatementError, ModelProblem):
            text = self.expression(said) if isinstance(said, str) else ""
            if OF_START.search(text):
                self.put(name, Meaning("initial", (text,)))
                return
        raise problem

    def _hide_others(self, name: str) -> None:
        """What of the model reads like a declared symbol is not meant by it: ω is not the parameter omega."""
        for other in [n for n in self.meanings if n not in self.declared and folded(n) == folded(name)]:
            meaning = self.meanings.pop(other)
            if meaning.texts != self.meanings[name].texts:
                self.hidden[name] = f"the {meaning.kind} {other}"

    def put(self, name: str, meaning: Meaning) -> None:
        self.meanings[name] = meaning
        self.declared.add(name)
        self.__dict__.pop("_spellings", None)

    def measure(self, said: str) -> tuple[str, Dimension | None]:
        """An expression in SI with its dimension; symbols declared before, and Greek ones, are written out."""
        return self.writer.measured(replace_names(_CENTRE.sub(self._centre, said), self._written_out))

    def _centre(self, found: re.Match[str]) -> str:
        """The place of the mass centre of all bodies, by those of each: that has an acceleration, too."""
        bodies = {quote(body["name"]): [piece.get("mass") for piece in body["pieces"]] for body in self.spec["bodies"]}
        if any(mass is None for masses in bodies.values() for mass in masses):
            return found[0]
        heavy = {body: " + ".join(some) for body, masses in bodies.items() if (some := [*filter(None, map(_in_kg, masses))])}
        sums = " + ".join(f"({mass})*{found[1]}({body}.G)" for body, mass in heavy.items())
        return f"(({sums})/({' + '.join(heavy.values())}))" if heavy else found[0]

    def measured(self, said: str) -> tuple[str, Dimension | None]:
        """The same; what is none of the model language, like ``m g/k``, is read as in a statement."""
        try:
            return self.measure(said)
        except ModelProblem as problem:
            try:
                return self.measure(written(parse_expression(said, self.names, self.constants)))
            except (StatementError, ModelProblem, TypeError):  # or has no spelling there
                raise problem from None

    def _written_out(self, token: str, is_call: bool) -> str:
        if is_call or (token in self.named.values and token not in self.declared) or token in self.bodies:
            return token
        name = token if token in self.meanings else self._spellings.find(folded(token)) if "." not in token else None
        found = self.meanings.get(name[0] if isinstance(name, tuple) else name or "")
        if found is None or found.is_vector or token in ("t", "pi"):
            return token
        dots = name[1] if isinstance(name, tuple) else 0
        return "(" + found.needed(dots)[0] + ")"

    @cached_property
    def usual(self) -> dict[str, str]:
        own = {name: m.texts[0] for name, m in self.meanings.items() if name in self.own and len(m.texts) == 1}
        return usual(self.spec, self.metadata, own)

    def spelt(self, name: str) -> Meaning | None:
        """What a name means that may be spelt as in LaTeX."""
        found = self._spellings.find(folded(re.sub(r"[\\{}]", "", name)))
        return self.meanings[found[0]] if found and not found[1] else None

    @cached_property
    def senses(self) -> dict[str, str]:
        """Letters that may be meant clockwise, so."""
        return senses(self.spec, self.metadata, self.usual)

    @cached_property
    def _spellings(self) -> Names:
        return Names(self.names)


def declarations(lines: Iterable[str]) -> dict[str, str]:
    """Symbols declared in lines like ``phi = theta - alpha`` or ``phi: theta - alpha``. Raises ``ModelProblem``."""
    out = {}
    for line in lines:
        found = re.fullmatch(r"\s*([^\s:=]+)\s*[:=]\s*(.+)", line)
        if not found:
            raise ModelProblem(f"`{line}` declares no symbol", "write it like `phi = theta - alpha`")
        out[found[1]] = found[2].strip()
    return out


def _in_kg(mass: str | float) -> str:
    """A mass of a model that is written in SI; nothing of a body without one."""
    try:
        return f"{mass} kg" if float(mass) else ""
    except ValueError:
        return f"({mass})"
