"""What a question may ask of freebody: mechanisms, runs and instants of one system, each computed once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from freebody.catalogue.answers import Answer, formula
from freebody.catalogue.system import model_file

if TYPE_CHECKING:
    from freebody.mechanism import Mechanism
    from freebody.run.simulation import Run
    from freebody.solve.instant import Instant

RTOL = 1e-12  # of runs whose question or model does not ask for another


class Case:
    """The models of one system, and what was computed with them so far."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.runs: dict[str, Run] = {}
        self.instants: dict[str, Instant] = {}
        self._mechanisms: dict[str, Mechanism] = {}

    def mechanism(self, file: str = "model.yaml", **parameters: Any) -> Mechanism:
        """A model of the system, or by ``EX-ARM/model`` of another, some parameters overruled."""
        from freebody.mechanism import Mechanism

        name = _name(file, parameters)
        if name not in self._mechanisms:
            mechanism = Mechanism.load(model_file(file) if "/" in file else self.folder / file)
            mechanism.parameters.update(parameters)
            self._mechanisms[name] = mechanism
        return self._mechanisms[name]

    def run(self, file: str = "model.yaml", parameters: Mapping[str, Any] | None = None, **settings: Any) -> Run:
        """A motion; ``settings`` are those of ``Mechanism.simulate``, ``initial`` among them."""
        name = _name(file, parameters, settings)
        if name not in self.runs:
            mechanism = self.mechanism(file, **(parameters or {}))
            self.runs[name] = mechanism.simulate(**{"rtol": RTOL, **settings})
        return self.runs[name]

    def instant(self, file: str = "model.yaml", parameters: Mapping[str, Any] | None = None, **state: Any) -> Instant:
        """One instant; ``state`` says what differs from the model's initial state, in the same words."""
        name = _name(file, parameters, state)
        if name not in self.instants:
            self.instants[name] = self.mechanism(file, **(parameters or {})).solve(**state)
        return self.instants[name]

    def symbolically(
        self, closed: Mapping[str, str], against: str, file: str = "model.yaml", of: str = "", **asked: Any
    ) -> Iterator[Answer]:
        """Accelerations, reactions and motors symbolically, beside closed forms; ``asked`` is what ``solve_in_letters`` takes. With
        ``"theta, M → inf"`` a limit is asked for."""
        from freebody.symbolic.printers.text import text

        pairs = {key: key.partition(", ")[::2] for key in closed}
        limits = {symbol: to for _, what in pairs.values() if what for symbol, to in [what.split(" → ")]}
        wanted = list(dict.fromkeys(name for name, _ in pairs.values()))
        found = self.mechanism(file).solve_in_letters(wanted, limits=limits, **asked)
        for key, (name, what) in pairs.items():
            tree = found.limits[name, what.split(" → ")[0]] if what else found[name]
            parts = [text(found.wanted[name], found.letters), what.replace("inf", "∞"), of]
            yield formula(", ".join(filter(None, parts)), tree, closed[key], against, found.letters)

    def balances(self, closed: Sequence[str], against: str, file: str = "model.yaml") -> Iterator[Answer]:
        """The balance equations without reactions, beside closed forms of left − right in the same order."""
        from freebody.symbolic.printers.text import text

        found = self.mechanism(file).equations()
        for balance, each in zip(found.parts, closed, strict=True):
            sides = " = ".join(text(side, found.letters) for side in (balance.left, balance.right))
            answer = formula(balance.title, balance.residual, each, against, found.letters)
            yield replace(answer, said=sides, says=f"{balance.title}: {{}}")

    def eigenvalues_of(self, closed: str, against: str, file: str = "model.yaml", **at: Any) -> Answer:
        """The characteristic polynomial of small perturbations from rest, in s, or λ where s is a symbol of the model, beside a closed form."""
        from freebody.document.blocks import Equation
        from freebody.equations.topics import topic

        document = topic(self.mechanism(file), "linear", **at)
        stated = next(block for block in document.blocks if isinstance(block, Equation) and "characteristic" in str(block.name))
        return formula("0", stated.left, closed, against, document.letters)


def _name(file: str, *overruled: Mapping[str, Any] | None) -> str:
    pairs = [f"{name} = {value}" for part in overruled for name, value in (part or {}).items()]
    return ", ".join([file, *pairs])
