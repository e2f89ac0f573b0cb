"""What is written at the arrows of a diagram, in LaTeX without dollars."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import ClassVar

from freebody.core import Load
from freebody.solve.symbols import Naming
from freebody.symbolic.printers.text import columns, text
from freebody.symbolic.printers.typeset import latex
from freebody.symbolic.symbols import Name, unicode_name
from freebody.symbolic.tree import Add, Sym, is_zero, symbols

_LONGEST = 8  # columns of an expression that is written out for a mass


@dataclass(frozen=True)
class Labels:
    """What the arrows of a model are called, by the letters of its equations."""

    naming: Naming
    unit: ClassVar[str] = "N"
    turning_unit: ClassVar[str] = "N·m"

    def of(self, load: Load) -> str:
        """Of a load; on both sides of a cut it is the same. Friction that slides is μ times its normal force."""
        if load.kind == "weight":
            g = self.naming.gravity
            return rf"{self.mass(load.on[0].body)}\,{g.latex()}" if g else rf"{self.mass(load.on[0].body)}\,\mathbf{{g}}"
        if load.follows:
            ratio, normal = self.naming.friction(load), self.naming.free.loads[load.follows[0]]
            if ratio:
                return f"{ratio.latex()}\\,{self.of(normal)}"
        return self.naming.loads[load.symbol].latex()

    def plain(self, load: Load) -> str:
        """Of a load, in a remark."""
        name = self.naming.loads.get(load.symbol)
        return name.unicode() if name else spoken(self.of(load))

    def whole(self, load: Load) -> str:
        """Of a force of which a load is one component."""
        name = self.naming.loads.get(load.symbol)
        if name is None or not load.axis:
            return self.of(load)
        return replace(name, below=name.below[:-1]).latex()

    @property
    def renamed(self) -> list[str]:
        """Sentences about what is not written as usual, as far as it has been asked for."""
        return list(map(str, self.naming.symbols.taken.renamed.values()))

    def mass(self, body: str) -> str:
        """Of a body's mass: its letter, or a short expression of letters."""
        tree = self.naming.bodies[body][0]
        short = symbols(tree) and not isinstance(tree, Add) and columns(text(tree)) <= _LONGEST
        return latex(tree, self.naming.letters) if short else self.naming.symbols.of_body("m", body).latex()

    def inertia(self, body: str) -> str:
        """Of a body's inertia about its mass centre."""
        tree = self.naming.bodies[body][1]
        if isinstance(tree, Sym):
            return latex(tree, self.naming.letters)
        return self.naming.symbols.of_body("I", body).latex()

    def acceleration(self, body: str, alone: bool) -> str:
        """Of the acceleration of a body's mass centre, by itself or among several."""
        return self._of_body("a", body, alone).latex(bold=True)

    def component(self, part: str) -> str:
        """Of a component, x or y, of the acceleration of a body's mass centre."""
        return f"a_{part}"

    def angular(self, body: str, alone: bool) -> str:
        """Of the angular acceleration of a body, by itself or among several."""
        taken, wanted = self.naming.symbols.taken, self._of_body("alpha", body, alone)
        what = "the angular acceleration" + f" of {body}" * bool(wanted.below)
        return taken.give(what, wanted, Name("angular acceleration", wanted.below)).latex()

    def _of_body(self, stem: str, body: str, alone: bool) -> Name:
        heavy = [mass for mass, _ in self.naming.bodies.values() if not is_zero(mass)]
        return Name(stem) if alone or len(heavy) == 1 else Name.parse(f"{stem}_{body}")


def spoken(label: str) -> str:
    """A letter without LaTeX: ``\\mathrm{pivot}_{x}`` → ``pivot_x``, ``\\mu`` → μ."""
    plain = re.sub(r"\\(?:mathrm|mathbf|text)\{([^{}]*)\}", r"\1", label)
    plain = re.sub(r"\\[, ]", " ", plain)
    plain = re.sub(r"\\([a-zA-Z]+) ?", lambda found: unicode_name(found[1]), plain)
    return re.sub(r"[{}]|\\", "", plain)


def letter(name: str) -> str:
    """Of a coordinate, a point or a parameter."""
    return Name.parse(name).latex()
