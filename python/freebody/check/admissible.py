"""States that joints, motions and laws of forces allow, and at which no balance holds: those of the same model under other loads.

What is true there is true by kinematics or by a law; what is one equation in several letters (m R² α and m R a of what rolls) is one there.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.model.lower import Lowered
from freebody.symbolic.dimensions import ENERGY, FORCE

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .motion_sampler import MotionSampler

_SHARE = 0.2  # of a force typical of the model: what touches goes on touching


class UnderOtherLoads:
    """A mechanism on each body of which a force and a couple act that it does not have."""

    def __init__(self, sampler: MotionSampler) -> None:
        self._mechanism: Builder = sampler.mechanism
        self._sampler = sampler

    def __getattr__(self, name: str) -> Any:
        return getattr(self._mechanism, name)

    def lowered(self) -> Lowered:
        """The model with these loads."""
        given, spec, forces, parameters, dimensions = self._mechanism.lowered(), self._mechanism.lowered().spec, [], [], {}
        signs = np.random.default_rng(2)
        for i, (loads, wanted) in enumerate(_loads(spec["bodies"])):
            names = [f"other_load_{i}_{k}" for k in range(len(wanted))]
            forces.append({**loads, "name": f"other load {i}", "engaged": True})
            forces[-1]["with"] = loads["with"] | dict(zip(wanted, names, strict=True))
            its = FORCE if "x" in wanted else ENERGY
            size = _SHARE * self._sampler.unit(its)
            parameters += [{"name": n, "value": float(size * signs.choice([-1.0, 1.0])), "unit": ""} for n in names]
            dimensions |= dict.fromkeys(names, its)
        spec = {**spec, "forces": [*spec["forces"], *forces], "parameters": [*spec["parameters"], *parameters]}
        start = replace(given.start, parameters=given.start.parameters | dimensions)
        return replace(given, spec=spec, start=start)


def _loads(bodies: list[dict[str, Any]]) -> Iterator[tuple[dict[str, Any], list[str]]]:
    for body in bodies:
        yield {"type": "force", "with": {"at": f"{body['name']}.G"}}, ["x", "y"]
        if not body["particle"]:
            yield {"type": "torque", "with": {"on": body["name"], "from": "ground"}}, ["value"]
