"""Symbols for what is long in the equations of an impact."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from freebody.symbolic.algebra import equal
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import ONE, Add, Fn, Sym, Tree, mul, negative, operations, rebuilt, replace, symbols

_ENTRY, _ANGLE = "h", "psi"
_LONG = 5
"""Operations of an entry above which it gets a symbol."""
_MANY = 3
"""Terms of an angle from which on it gets a symbol; one in which a term is more than ± a symbol gets one as well."""


@dataclass
class Names:
    """Symbols for what is long: angles of several terms, and what impulses give to momenta."""

    taken: frozenset[str]
    made: dict[Sym, Tree] = field(default_factory=dict)

    def angles(self, tree: Tree) -> Tree:
        """With symbols for its long angles."""

        def put(part: Tree) -> Tree | None:
            if not isinstance(part, Fn) or part.name not in ("sin", "cos") or not isinstance(part.args[0], Add):
                return None
            [angle] = part.args
            if len(angle.terms) < _MANY and all(operations(term) <= 1 for term in angle.terms):
                return None
            known = next((name for name, tree in self.made.items() if tree == angle), None)
            return Fn(part.name, (known or self._new(_ANGLE, angle),))

        return rebuilt(tree, put)

    def entry(self, tree: Tree) -> Tree:
        """It, or the symbol for it, or for what it is the negative of."""
        if operations(tree) <= _LONG:
            return tree
        for name, known in self.made.items():
            for sign in (ONE, negative(ONE)):
                if equal(tree, mul(sign, known)):
                    return mul(sign, name)
        return self._new(_ENTRY, tree)

    def spelt(self, tree: Tree) -> Tree:
        """With the entries themselves; angles keep their symbols."""
        return replace(tree, {name: entry for name, entry in self.made.items() if name.name.startswith(_ENTRY)})

    def plain_angles(self, tree: Tree) -> Tree:
        """Where a symbol of an angle is one of several terms of another angle, what it stands for: cos(ψ₁ − θ) is cos α."""

        def put(part: Tree) -> Tree | None:
            if not isinstance(part, Fn) or not isinstance(part.args[0], Add) or not symbols(part) & self.made.keys():
                return None
            angle = sympy.expand(to_sympy(replace(part.args[0], self.made)))
            return from_sympy(to_sympy(Fn(part.name, (from_sympy(angle),))))

        return rebuilt(tree, put)

    def used(self, trees: Iterable[Tree]) -> Mapping[Sym, Tree]:
        """The symbols that occur, also in what others stand for."""
        there = symbols(*trees)
        for name in reversed(self.made):
            there |= symbols(self.made[name]) if name in there else set()
        return {name: tree for name, tree in self.made.items() if name in there}

    def _new(self, stem: str, tree: Tree) -> Sym:
        free = (f"{stem}{i}" for i in range(1, 1000))
        name = Sym(next(each for each in free if each not in self.taken and Sym(each) not in self.made))
        self.made[name] = tree
        return name
