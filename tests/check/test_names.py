"""Names of parts read in statements as in models; a statement's own names go before the model's; errors have a place."""

from __future__ import annotations

import random

import pytest
from store import ANSWERED, every, mechanism

from freebody.check import Checker, Kind
from freebody.core import quote
from freebody.mechanism import Mechanism
from freebody.symbolic.errors import StatementError

_OF_LIMITS = {"gap", "slack", "N", "T", "tension", "x", "y", "slip"}
"""What one limit has and another has not."""


@every(ANSWERED)
def test_what_a_model_reads_of_its_parts_a_statement_reads(model: str) -> None:
    checker = Checker(mechanism(model))
    known = checker.symbols()
    for owner, readings in known.named.readings.items():
        read = [word for word in readings if f"{quote(owner)}.{word}" in known.meanings]
        if known.named.owners[owner] not in ("joint", "lock") or read:
            assert set(readings) - set(read) <= _OF_LIMITS | {"M", "friction"}, owner
        for word in read if owner.isidentifier() else ():
            assert [n.name for n in known.require(known.read(f"{owner}.{word} = 0"))] == [f"{owner}.{word}"]
        if owner.isidentifier():
            with pytest.raises(StatementError, match=f"`{owner}` has no `colour`") as error:
                checker.check(f"1 = {owner}.colour")
            assert all(word in error.value.hint for word in read)
            assert error.value.span == (4, 4 + len(f"{owner}.colour"))


BEAD = """
freebody: 1
parameters: {l: 1 m, m: 0.2 kg, d: 3 N, c: 2 m/s}
bodies: {rod: {shape: rod, length: l, mass: m}, bead: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  along: {type: slot, along: [rod.start, rod.end], point: bead.centre, coordinate: r}
initial: {theta: 0.3, r: 0.4 m}
"""


@pytest.mark.parametrize("name", ["d", "c", "g", "i", "k", "theta_0", "w"])
@pytest.mark.parametrize("between", ["; ", "\n"])
def test_own_names_go_before_those_of_the_model(name: str, between: str) -> None:
    checker = Checker(Mechanism.loads(BEAD))
    known = {"d": "parameter", "c": "parameter", "g": "parameter", "i": "direction", "k": "direction"}.get(name)
    right = f"r {name}' = 2 r' r theta' + r^2 theta'' - r' r theta'{between}{name} = r theta'"
    verdict = checker.check(right)
    assert verdict.kind is Kind.TRUE, str(verdict)
    assert [known] * bool(known) == [known for note in verdict.notes if f"Here {name} is" in note and str(known) in note]
    wrong = checker.check(right.replace("2 r' r", "3 r' r"))
    assert wrong.kind is Kind.WRONG, str(wrong)


def test_columns_of_an_own_name() -> None:
    """BAR-9 in its own symbols, of which d is a length of the model."""
    symbols = {"β": "beta", "φ": "phi", "ℓ1": "l1", "ℓ2": "l2", "ℓ3": "l3"}
    stated = """B w = C c SIGN D d
      w = (β̈, φ̈)
      B = [−ℓ2 sinβ, ℓ3 sinφ; −ℓ2 cosβ, ℓ3 cosφ]
      C = ℓ1 [sinθ, cosθ; cosθ, −sinθ]
      c = (θ̈, θ̇^2)
      D = [−cosβ, cosφ; sinβ, −sinφ]
      d = (ℓ2 β̇^2, ℓ3 φ̇^2)"""
    verdicts = [Checker(mechanism("S19.22/model"), symbols).check(stated.replace("SIGN", sign)) for sign in "+−"]
    assert [verdict.kind for verdict in verdicts] == [Kind.WRONG, Kind.TRUE]
    assert all("Here d is" in verdict.notes[0] for verdict in verdicts)


CLAIMS = [
    "r'' = r theta'^2", "at 0.1 s: r = 0.4", "if at rest: r'' = 0", "constant: m r^2 theta'", "limit: r'' = 0 as m -> 0",
    "follows: r'' = 0 from r = 1", "shorter: r = 1 than r = 2", "same at end for m = 0.1, 0.5: r", "no r in: theta''", "at 1e9 s: r = 1",
    "no r in the factors of theta'': theta'' = 0", "report: r = 1", "[1, 2; 3, 4] (r, l) = (1, 2)", "d/dt(r) = 1", "along.F = 10^999",
]  # fmt: skip
_PIECES = [
    *"()[]{}=+-*/^.,;:'|\\× \n0rmd",
    "at ",
    "if ",
    "\\frac",
    "''",
    "limit:",
    "inf",
    "->",
    "\ud800",
    "\0",
    "∞",
    "1e400",
    "O.",
    "== ",
]


def test_what_cannot_be_read_is_answered_with_a_place() -> None:
    checker, rng, refused = Checker(Mechanism.loads(BEAD)), random.Random(11), 0
    for text in CLAIMS * 12:
        for _ in range(rng.randint(0, 3)):
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(_PIECES) + text[at + rng.randint(0, 2) :]
        try:
            checker.check(text, correcting=False)
        except StatementError as error:
            refused += 1
            assert error.text and error.span[0] <= error.span[1] <= len(error.text) and not str(error).startswith("("), text
    assert refused > len(CLAIMS)
