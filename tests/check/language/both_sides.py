"""Both sides of the equations of a statement, evaluated."""

from collections.abc import Mapping

from freebody.check.language.statements import Program, inlined
from freebody.check.residual import Sides, equation_sides
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array


def sides(program: Program, values: Mapping[str, Array]) -> list[Sides]:
    """Of each equation, with the names that the statement gives itself; ``values`` by ``Sym.key``."""
    try:
        return [equation_sides(line, values) for line in inlined(program)]
    except StatementError as error:
        raise error.within(program.text) from None
