"""What is simulated, and how."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from freebody.results import ReportItem
from freebody.switched import with_dimensions

if TYPE_CHECKING:
    from freebody import _core


@dataclass(frozen=True)
class Source:
    """What is simulated: the compiled mechanism, the JSON it was compiled from, the model as JSON, what to report, and
    what is worth saying about its assembly."""

    core: _core.Mechanism
    spec: str
    model: str
    report: tuple[ReportItem, ...] = ()
    notes: tuple[str, ...] = ()

    @cached_property
    def about(self) -> dict[str, Any]:
        """What the core says of the mechanism: bodies, coordinates, joints and so on."""
        return with_dimensions(json.loads(self.core.describe()), json.loads(self.spec))

    @cached_property
    def name(self) -> str:
        """Title for reports."""
        return json.loads(self.spec).get("name") or "mechanism"


@dataclass(frozen=True)
class Settings:
    """How a run is made; times in s. ``every`` is the spacing of the output grid, ``impacts`` and ``painleve`` are the laws
    of impacts and of friction that jams."""

    until: float
    method: str = "dop853"
    rtol: float = 1e-9
    step: float | None = None
    max_step: float | None = None
    route: str = "auto"
    every: float | None = None
    impacts: str = "stop"
    painleve: str = "stop"
