"""Planar multibody dynamics, from the free-body diagram to the motion.

``Mechanism`` describes, solves, simulates and draws; ``load`` reads a model file. Names are imported where they are first
used, so that ``import freebody`` costs nothing.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .core import ExpressionError, Indeterminate, ModelError, MotionError, NotFinite
    from .mechanism import Mechanism
    from .model.errors import ModelFileError
    from .model.user_units import units
    from .run.simulation import Run
    from .solve.instant import Instant
    from .views.compare import compare

_HOMES = {
    "ExpressionError": "core",
    "Indeterminate": "core",
    "Instant": "solve.instant",
    "Mechanism": "mechanism",
    "ModelError": "core",
    "ModelFileError": "model.errors",
    "MotionError": "core",
    "NotFinite": "core",
    "Run": "run.simulation",
    "compare": "views.compare",
    "units": "model.user_units",
}

__all__ = [
    "ExpressionError",
    "Indeterminate",
    "Instant",
    "Mechanism",
    "ModelError",
    "ModelFileError",
    "MotionError",
    "NotFinite",
    "Run",
    "compare",
    "load",
    "units",
]


def load(path: Any) -> Mechanism:
    """The mechanism of a model file (YAML or JSON). Raises ``ModelFileError`` with all that is wrong in it."""
    from .mechanism import Mechanism

    return Mechanism.load(path)


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("freebody")
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
