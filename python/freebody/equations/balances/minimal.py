"""As many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import FreeBodies
from freebody.equations.balances.candidates import WORTH, Candidate, best, bits, candidates, unions
from freebody.equations.balances.equation import BalanceEquation, equation
from freebody.equations.balances.lower_bound import fewest, without_reactions
from freebody.equations.balances.smallest import COUNT
from freebody.equations.balances.system import groups, problem
from freebody.equations.balances.virtual_motions import NamedPoints
from freebody.solve.perturbed_states import DEPENDENT
from freebody.solve.rich_tables import PlainText


@dataclass(frozen=True)
class MinimalForm(PlainText):
    """Independent equations that hold the accelerations of ``coordinates``, and the ``forces`` of prescribed motions if these
    were asked for: as many as there are, and no other unknowns. Where something slides with friction, the forces that this
    follows from, ``frictional``, are asked for as well, as a person does who needs them for the friction.

    Where loops leave no such set, it is larger by the fewest reactions that cannot be kept out, ``stays``; ``equations`` is
    empty where these are more than four. ``least``: no set of balances of connected groups holds fewer reactions, whatever
    the points and directions; ``groups``: how many groups that was shown of, ``exact`` if these are all.
    ``virtual``: how many independent equations without reactions virtual power gives.
    """

    coordinates: tuple[str, ...]
    equations: tuple[BalanceEquation, ...]
    stays: tuple[str, ...]
    forces: tuple[str, ...] = ()
    frictional: tuple[str, ...] = ()
    least: int = 0
    groups: int = 0
    exact: bool = True
    virtual: int = 0

    @property
    def wanted(self) -> int:
        """How many accelerations and forces the equations are for."""
        return len(self.coordinates) + len(self.forces) + len(self.frictional)

    @property
    def fewest_words(self) -> str:
        """How many reactions stay in every set of balances, where any are known to, and of which sets of bodies that was shown."""
        some = f"{self.groups} connected sets of bodies"
        tried = f"all {some} were tried" if self.exact else f"{some} were tried, there are too many to try all: this is no proof"
        tried = tried if self.groups > 1 else "there is one connected set of bodies"
        if not self.least:
            return f"{tried}, and every point and direction was tried"
        stay = "reaction stays" if self.least == 1 else "reactions stay"
        return f"at least {COUNT[self.least]} {stay} in every set of balances ({tried}, with every point and direction)"

    def __str__(self) -> str:
        names = ", ".join([*self.coordinates, *self.forces, *self.frictional])
        if not names:
            return "Motions and loops prescribe every acceleration: there is no equation of motion."
        stated = [f"Minimal form in {names}, without {'other reactions' if self.frictional else 'reactions'}:"]
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
    unknowns, loads = given.unknowns, given.free.loads
    leading = {load.follows[0] for load in loads if load.follows}
    moving = [i for i, unknown in enumerate(unknowns) if unknown.coordinate]
    driving = [
        i for i, unknown in enumerate(unknowns) if forces and unknown.load is not None and loads[unknown.load].kind == "motion"
    ]
    frictional = [i for i, unknown in enumerate(unknowns) if unknown.load in leading]
    wanted = [*moving, *driving, *frictional]
    coordinates = tuple(unknowns[i].coordinate or "" for i in moving)
    asked = [tuple(unknowns[i].name for i in some) for some in (driving, frictional)]
    if not wanted:
        return MinimalForm(coordinates, (), (), *asked)
    sets, every = groups(given)
    least = fewest(given, sets, wanted, WORTH)
    reactions, accelerations = bits(range(len(unknowns))) & ~bits(wanted), bits(moving)
    by_reactions: dict[int, list[Candidate]] = {}
    for support, alike in candidates(given, points or {}, counted=reactions)[0].items():
        by_reactions.setdefault(support & reactions, []).extend(alike)
    tried = (best(by_reactions, unions(by_reactions, n), n + len(wanted), accelerations) for n in range(least, WORTH + 1))
    chosen, stays = next((found for found in tried if found[0]), ([], 0))
    names = tuple(unknown.name for i, unknown in enumerate(unknowns) if stays >> i & 1)
    equations = tuple(equation(given, candidate) for candidate in chosen)
    return MinimalForm(coordinates, equations, names, *asked, least, len(sets), every, without_reactions(given, wanted))


def regular(states: Sequence[FreeBodies]) -> Sequence[FreeBodies]:
    """Without the first where its loops hold less than they do near by, and so do not tell which coordinates are free."""
    tables = [np.array([list(row.coefficients.values()) for row in state.rows]) for state in states[:2]]
    ranks = [np.linalg.matrix_rank(table, tol=DEPENDENT * np.abs(table).max()) if table.size else 0 for table in tables]
    return states[1:] if len(states) > 1 and ranks[0] < ranks[1] else states
