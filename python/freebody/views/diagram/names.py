"""What is written at the arrows of a diagram."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from freebody.core import FreeBodies, Load
from freebody.solve.symbolic_state import Motion, SymbolicState
from freebody.solve.symbols import PLAIN, coefficient
from freebody.symbolic.alphabet import columns
from freebody.symbolic.printers.text import text
from freebody.symbolic.printers.typeset import latex
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Add, Sym, Tree, is_zero, symbols
from freebody.views.dimension_lines import FIGURES

_LONGEST = 8  # columns of an expression that is written out for a mass


@dataclass(frozen=True)
class Sign:
    """What is written at an arrow: in LaTeX without dollars, and as plain text."""

    latex: str
    plain: str

    @classmethod
    def of(cls, name: Name, dots: int = 0, bold: bool = False) -> Sign:
        """That of a name."""
        return cls(name.latex(dots, bold=bold), name.unicode(dots))

    def __mul__(self, other: Sign) -> Sign:
        return Sign(rf"{self.latex}\,{other.latex}", f"{self.plain} {other.plain}")


@dataclass(frozen=True)
class Labels:
    """What the arrows of a model are called, by the symbols of its equations; ``free`` are the loads that are drawn, and of their
    values so many ``figures`` hold."""

    subject: SymbolicState
    free: FreeBodies
    figures: int = FIGURES
    unit: ClassVar[str] = "N"
    turning_unit: ClassVar[str] = "N·m"

    @property
    def loads(self) -> Mapping[str, Name]:
        """The names of loads by their symbols."""
        return self.subject.symbols.loads

    def of(self, load: Load) -> Sign:
        """Of a load; on both sides of a cut it is the same. Friction that slides is μ times its normal force."""
        if load.kind == "weight":
            g = self._gravity
            return self.mass(load.on[0].body) * Sign.of(g or Name("g"), bold=g is None)
        if load.follows and (symbol := coefficient(self.subject.source, load.name)):
            ratio = self.subject.symbols.names.get(symbol, Name.parse(symbol))
            return Sign.of(ratio) * self.of(self.free.loads[load.follows[0]])
        return Sign.of(self.loads[load.symbol])

    @property
    def _gravity(self) -> Name | None:
        """The name of gravity: its parameter's, else g; None where it is a vector of two parameters."""
        x, y = (str(part).strip("-()") for part in self.subject.source.spec["gravity"] or (0, 0))
        symbols = self.subject.symbols
        if PLAIN.search(x) or float(x):
            return None
        return (
            symbols.names.get(y, Name.parse(y))
            if PLAIN.fullmatch(y)
            else symbols.taken.give("gravity", Name("g"), Name("gravity"))
        )

    def whole(self, load: Load) -> Sign:
        """Of a force of which a load is one component."""
        name = self.loads.get(load.symbol)
        return Sign.of(replace(name, below=name.below[:-1])) if name and load.axis else self.of(load)

    @property
    def renamed(self) -> list[str]:
        """Sentences about what is not written as usual, as far as it has been asked for."""
        return list(map(str, self.subject.symbols.taken.renamed.values()))

    def mass(self, body: str) -> Sign:
        """Of a body's mass: its symbol, or a short expression of symbols."""
        tree = self._motion(body).mass
        short = symbols(tree) and not isinstance(tree, Add) and columns(text(tree)) <= _LONGEST
        return self._written(tree) if short else Sign.of(self.subject.symbols.of_body("m", body))

    def inertia(self, body: str) -> Sign:
        """Of a body's inertia about its mass centre."""
        tree = self._motion(body).inertia
        return self._written(tree) if isinstance(tree, Sym) else Sign.of(self.subject.symbols.of_body("I", body))

    def _motion(self, body: str) -> Motion:
        return next(motion for motion in self.subject.motions if motion.body == body)

    def _written(self, tree: Tree) -> Sign:
        return Sign(latex(tree, self.subject.nomenclature), text(tree, self.subject.nomenclature))

    def acceleration(self, body: str) -> Sign:
        """Of the acceleration of a body's mass centre."""
        return Sign.of(self._of_body("a", body), bold=True)

    def component(self, body: str, part: str) -> Sign:
        """Of a component, x or y, of that acceleration."""
        name = self._of_body("a", body)
        return Sign.of(replace(name, below=(*name.below, part)))

    def angular(self, body: str) -> Sign:
        """Of the angular acceleration of a body: ω with a dot where α is something else."""
        alpha, omega = (self._of_body(stem, body) for stem in ("alpha", "omega"))
        return Sign.of(omega, dots=1) if self.subject.symbols.taken.owner(alpha) else Sign.of(alpha)

    def _of_body(self, stem: str, body: str) -> Name:
        """A letter with its body below, if there are several."""
        heavy = [motion for motion in self.subject.motions if not is_zero(motion.mass)]
        return Name(stem) if len(heavy) == 1 else Name.parse(f"{stem}_{body}")


def symbol(name: str) -> str:
    """Of a coordinate, a point or a parameter."""
    return Name.parse(name).latex()
