"""What a model says of itself before anything of it moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import CompiledModel, MotionError, State
from freebody.core.state import Array
from freebody.model.start import Start, initial_state
from freebody.symbolic.dimensions import Dimension

if TYPE_CHECKING:
    from freebody.model.builder import Builder


class StaticFacts:
    """A model as its true motions need it: its parameters, its own start, and what sizes are typical of it."""

    def __init__(self, mechanism: Builder) -> None:
        lowered = mechanism.lowered()
        self.start: Start = lowered.start
        self.spec: dict[str, Any] = {**lowered.spec, "parameters": list(lowered.spec["parameters"])}
        self.gravity = self._parametrised_gravity()
        self.core = CompiledModel.of(self.spec)
        self.metadata = self.core.metadata
        text = mechanism.model.model_dump_json(by_alias=True, exclude_unset=True)
        self.counts = {name for name in mechanism.model.parameters if f".. {name}]" in text or f"..{name}]" in text}

    def _parametrised_gravity(self) -> str | None:
        """A gravity that is a plain number becomes a parameter, so that nothing is true by the number 9.81."""
        given = self.spec.get("gravity")
        if given is None or not all(isinstance(part, int | float) for part in given) or given[0] != 0 or given[1] == 0:
            return None
        taken = {p["name"] for p in self.spec["parameters"]} | set(self.start.coordinates)
        name = next(name for name in ("g", "gravity", "gravity2") if name not in taken)
        self.spec["parameters"] += [{"name": name, "value": -given[1], "unit": "m/s^2"}]
        self.spec["gravity"] = [0.0, f"-{name}"]
        self.start = replace(self.start, parameters=self.start.parameters | {name: Dimension(length=1, time=-2)})
        return name

    @cached_property
    def free_parameters(self) -> dict[str, float]:
        """Parameters that are plain numbers in the model, with those; the others follow from them, or count items."""
        numbers = {p["name"]: p["value"] for p in self.spec["parameters"] if isinstance(p["value"], int | float)}
        return {name: float(value) for name, value in numbers.items() if name not in self.counts}

    @cached_property
    def parameter_names(self) -> list[str]:
        """All parameters in the order of ``p``."""
        return [p["name"] for p in self.metadata["parameters"]]

    @cached_property
    def coordinates(self) -> list[Mapping[str, Any]]:
        """The coordinates of the state, as the core describes them."""
        return list(self.metadata["coordinates"])

    @cached_property
    def names(self) -> list[str]:
        """Those of the coordinates."""
        return [c["name"] for c in self.coordinates]

    def named(self, q: Array) -> dict[str, float]:
        """Coordinates, or rates, by their names."""
        return dict(zip(self.names, q.tolist(), strict=True))

    @cached_property
    def sizes(self) -> Array:
        """By what each coordinate changes noticeably: 1 rad, or a length typical of the model."""
        return np.array([1.0 if c["dimension"] == "rad" else self.length for c in self.coordinates])

    @cached_property
    def frictions(self) -> list[str]:
        """Free parameters that are a coefficient of friction."""
        rough = [*self.spec.get("contacts", []), *self.spec["joints"]]
        written = [item.get(word) for item in rough for word in ("friction", "static_friction")]
        return [name for name in self.free_parameters if name in written]

    @cached_property
    def gravities(self) -> list[str]:
        """Free parameters that stand alone in the gravity of the model."""
        parts = [str(part).strip("-() ") for part in self.spec.get("gravity") or ()]
        return [name for name in self.free_parameters if name in parts]

    # -- the model's own state

    @cached_property
    def first(self) -> State:
        """The state in which the model starts."""
        return self.started({})

    def started(self, parameters: Mapping[str, float]) -> State:
        """The start with other parameters. Raises ``MotionError`` and ``ModelProblem``."""
        words = initial_state(self.start, self.core, parameters)
        return self.core.assemble(words.pop("p"), 0.0, **words)[0]

    @cached_property
    def length(self) -> float:
        """A length typical of the model, m."""
        places = self.core.points(self.core.bind({}))
        found = [math.hypot(x, y) for _, x, y in places.values()]
        found += [abs(q) for q, c in zip(self.first.q, self.coordinates, strict=True) if c["dimension"] == "m"]
        return max([x for x in found if x > 0], default=1.0)

    @cached_property
    def mass(self) -> float:
        """A mass typical of the model, kg."""
        return max([b["mass"] for b in self.metadata["bodies"] if b.get("mass")], default=1.0)

    @cached_property
    def rate(self) -> float:
        """A rate typical of the model, 1/s: what its accelerations at rest and its own rates suggest."""
        found = float(np.max(np.abs(self.first.u / self.sizes), initial=0.0))
        with suppress(MotionError):
            accelerations = self.core.instant(self.first).accelerations
            found = max(found, math.sqrt(np.max(np.abs(accelerations / self.sizes), initial=0.0)))
        return float(np.clip(found, 1e-3, 1e3)) if found > 0 else 1.0

    @cached_property
    def freedom(self) -> int:
        """Rates that can be given at will."""
        given = sum(motion["engaged"] and motion["level"] != "acceleration" for motion in self.spec["motions"])
        return max(self.core.instant(self.first).rank.freedom - given, 0)

    @cached_property
    def loops(self) -> int:
        """How many joints close a loop."""
        return len(self.metadata.get("closure_coordinates", [])) + sum(1 for j in self.metadata["joints"] if j.get("cut"))

    def shapes_loop(self, name: str) -> bool:
        """Whether a parameter may be a length of a closed loop."""
        dimension = self.start.parameters.get(name)
        return self.loops > 0 and (dimension is None or (dimension.mass == 0 and dimension.time == 0))
