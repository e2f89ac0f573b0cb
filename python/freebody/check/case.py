"""A statement beside the motions that decide about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from freebody.symbolic.evaluate import Array

from .families import ALL, Family, Samples
from .language.statements import Equation, Program, inlined
from .meaning import StatementLetters
from .motion_sampler import SAMPLES, MotionSampler
from .residual import Residual, residual


@dataclass
class Case:
    """A program of statements, what its letters mean, and true motions. ``hypothesis`` is the family of which it is said;
    ``mending``: whether corrections are wanted where it is wrong."""

    program: Program
    meaning: StatementLetters
    sampler: MotionSampler
    hypothesis: Family = ALL
    mending: bool = True
    known: dict[tuple[Family, int, int], Mapping[str, Array]] = field(default_factory=dict)

    @property
    def equations(self) -> tuple[Equation, ...]:
        """What is stated, with assigned names written out."""
        return inlined(self.program)

    def samples(self, family: Family | None = None, fresh: int = 0, count: int = SAMPLES) -> Samples:
        """True states of a family. Raises ``NoMotion``."""
        return self.sampler.samples(family or self.hypothesis, count, fresh)

    def values(self, family: Family | None = None, fresh: int = 0, count: int = SAMPLES) -> Mapping[str, Array]:
        """The letters on true states of a family. Raises ``NoMotion``."""
        key = (family or self.hypothesis, fresh, count)
        if key not in self.known:
            self.known[key] = self.meaning.values(self.samples(family, fresh, count))
        return self.known[key]

    def depends_on_stress(self, equation: Equation) -> list[str]:
        """The reactions that are not determined and of which it depends on their values whether the equation holds."""
        samples = self.samples()
        if not samples.loose:
            return []
        relaxed = Samples(samples.core, samples.samples, stress=0.0)
        after = residual(equation, self.meaning.values(relaxed)).sides.residual
        before = self.residual(equation).sides.residual
        same = np.allclose(after, before, rtol=1e-9, atol=1e-9 * float(np.abs(before).max()))
        return [] if same else sorted(samples.loose)

    def elsewhere(self, values: Mapping[str, Array], bound: bool = True) -> dict[str, Array]:
        """Values that are no true state, where only what is the same by itself is the same; or, if ``bound``, by what the model
        defines its parameters to be."""
        names, given = self.meaning.names(), self.meaning.given() if bound else ()
        sizes = {key: np.where(np.any(value), value, 1.0) for key, value in values.items()}
        rng, draws = np.random.default_rng(5), {}  # always the same places
        for key, value in sizes.items():
            draws.setdefault(names.get(key, key), value * rng.uniform(0.7, 1.4, value.shape))
        return {
            key: value if key in given and np.any(values[key]) else draws[names.get(key, key)] for key, value in sizes.items()
        }

    def residual(self, equation: Equation, family: Family | None = None, fresh: int = 0) -> Residual:
        """How far an equation is from holding."""
        return residual(equation, self.values(family, fresh))
