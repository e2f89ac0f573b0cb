"""As many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import FreeBodies
from freebody.equations.balances.candidates import WORTH, Candidate, bits, candidates
from freebody.equations.balances.equation import BalanceEquation, equation
from freebody.equations.balances.groups import groups
from freebody.equations.balances.lower_bound import fewest, without_reactions
from freebody.equations.balances.search import Supports, plainest, set_cost, unions, within
from freebody.equations.balances.smallest import COUNT
from freebody.equations.balances.system import Problem, problem
from freebody.equations.balances.virtual_motions import NamedPoints
from freebody.solve.perturbed_states import DEPENDENT
from freebody.solve.rich_tables import PlainText


@dataclass(frozen=True)
class MinimalForm(PlainText):
    """Independent equations that hold the accelerations of ``coordinates``, and the ``forces`` of prescribed motions if these
    were asked for: as many as there are, and no other unknowns. Where something slides with friction, the forces that this
    follows from, ``rubbing``, are asked for as well, as a person does who needs them for the friction.

    Where loops leave no such set, it is larger by the fewest reactions that cannot be kept out, ``stays``; ``equations`` is
    empty where these are more than four. ``least``: no set of balances of connected groups holds fewer reactions, whatever
    the points and directions; ``groups``: how many groups that was shown of, ``exact`` if these are all.
    ``virtual``: how many independent equations without reactions virtual power gives.
    """

    coordinates: tuple[str, ...]
    equations: tuple[BalanceEquation, ...]
    stays: tuple[str, ...]
    forces: tuple[str, ...] = ()
    rubbing: tuple[str, ...] = ()
    least: int = 0
    groups: int = 0
    exact: bool = True
    virtual: int = 0

    @property
    def proven(self) -> bool:
        """Whether no set of balances does with fewer reactions."""
        return self.exact and bool(self.equations) and self.least == len(self.stays)

    @property
    def wanted(self) -> int:
        """How many accelerations and forces the equations are for."""
        return len(self.coordinates) + len(self.forces) + len(self.rubbing)

    @property
    def fewest_words(self) -> str:
        """How many reactions stay in every set of balances, and of which sets of bodies that was shown."""
        some = f"{self.groups} connected sets of bodies"
        tried = f"all {some} were tried" if self.exact else f"{some} were tried, there are too many to try all: this is no proof"
        stay = "reaction stays" if self.least == 1 else "reactions stay"
        return f"at least {COUNT[self.least]} {stay} in every set of balances ({tried}, with every point and direction)"

    def __str__(self) -> str:
        names = ", ".join([*self.coordinates, *self.forces, *self.rubbing])
        if not names:
            return "Motions and loops prescribe every acceleration: there is no equation of motion."
        stated = [f"Minimal form in {names}, without {'other reactions' if self.rubbing else 'reactions'}:"]
        if self.stays or not self.equations:
            stay = f"here {', '.join(self.stays)}" if self.stays else "and more are not worth it"
            stated = [f"No set in {names} alone: {self.fewest_words}, {stay}."]
        for i, each in enumerate(self.equations, 1):
            stated += ["", *each.lines(i)]
        return "\n".join(stated)


def minimal_form(states: Sequence[FreeBodies], points: NamedPoints | None = None, forces: bool = False) -> MinimalForm:
    """The minimal form at ``states[0]``; ``states`` and ``points`` are those of ``smallest_set``. ``forces``: equations for the
    forces of prescribed motions are wanted as well. Where the loops are singular at ``states[0]``, the numbers are those of the next."""
    given = problem(regular(states))
    moving = [i for i, unknown in enumerate(given.unknowns) if unknown.coordinate]
    driving = [i for i in range(len(given.unknowns)) if forces and i not in moving and _drives(given, i)]
    leading = {load.follows[0] for load in given.free.loads if load.follows}
    rubbing = [i for i, unknown in enumerate(given.unknowns) if unknown.load in leading]
    wanted = [*moving, *driving, *rubbing]
    coordinates = tuple(given.unknowns[i].coordinate or "" for i in moving)
    asked = [tuple(given.unknowns[i].name for i in some) for some in (driving, rubbing)]
    sets, every = groups(given)
    if not wanted:
        return MinimalForm(coordinates, (), (), *asked)
    shown = fewest(given, sets, wanted, WORTH)
    stated = (*asked, shown, len(sets), every, without_reactions(given, wanted))
    chosen, stays = _best(given, points or {}, wanted, bits(moving), shown)
    names = tuple(unknown.name for i, unknown in enumerate(given.unknowns) if stays >> i & 1)
    return MinimalForm(coordinates, tuple(equation(given, candidate) for candidate in chosen), names, *stated)


def regular(states: Sequence[FreeBodies]) -> Sequence[FreeBodies]:
    """Without the first where its loops hold less than they do near by, and so do not tell which coordinates are free."""
    ranks = [_rank(state) for state in states]
    return states[1:] if len(states) > 1 and ranks[0] < ranks[1] else states


def _rank(state: FreeBodies) -> int:
    table = np.array([list(row.coefficients.values()) for row in state.rows])
    return int(np.linalg.matrix_rank(table, tol=DEPENDENT * np.abs(table).max())) if table.size else 0


def _drives(given: Problem, place: int) -> bool:
    load = given.load(given.unknowns[place])
    return load is not None and load.kind == "motion"


def _best(
    given: Problem, points: NamedPoints, wanted: Sequence[int], accelerations: int, least: int
) -> tuple[list[Candidate], int]:
    """The plainest set with the fewest reactions, from ``least`` on, and these as bits."""
    reactions = bits(range(len(given.unknowns))) & ~bits(wanted)
    by_reactions: dict[int, list[Candidate]] = {}
    for support, alike in candidates(given, points, counted=reactions).by_support.items():
        by_reactions.setdefault(support & reactions, []).extend(alike)
    for size in range(least, WORTH + 1):
        if found := _of_size(by_reactions, accelerations, size, len(wanted)):
            return found
    return [], 0


def _of_size(by_reactions: Supports, accelerations: int, size: int, wanted: int) -> tuple[list[Candidate], int] | None:
    """The best set with ``size`` reactions, and these as bits."""
    sets = ((unknowns, within(by_reactions, unknowns)) for unknowns in unions(by_reactions, size))
    solved = ((plainest(equations, size + wanted, accelerations), unknowns) for unknowns, equations in sets)
    return min(((chosen, stays) for chosen, stays in solved if chosen), key=lambda f: set_cost(f[0], accelerations), default=None)
