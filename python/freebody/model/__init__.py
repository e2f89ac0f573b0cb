"""The model language: files, the builder, and what both become for the core.

- ``file``: ``load``, ``loads``, ``save``, ``dumps``; ``errors.ModelFileError`` tells all that is wrong, with places.
- ``mechanism``: ``Mechanism``, which says in Python what a file says.
- ``schema``: ``Model``, the language as types, and ``schema()``, its JSON Schema.
- ``lower``: ``lower``, from a ``Model`` to the spec of the core, with start, run and report.
- ``units``: quantities and dimensions.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .errors import ModelFileError, Problem
    from .file import load, loads, save
    from .mechanism import Mechanism

_HOMES = {
    "Mechanism": "mechanism",
    "ModelFileError": "errors",
    "Problem": "errors",
    "load": "file",
    "loads": "file",
    "save": "file",
}

__all__ = ["Mechanism", "ModelFileError", "Problem", "load", "loads", "save"]


def __getattr__(name: str) -> Any:
    """Imports a name where it is first used, so that importing freebody stays fast."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
