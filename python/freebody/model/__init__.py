"""The model language: files, the builder, and what both become for the core.

- ``reading``, ``file``: read and written; ``errors.ModelFileError`` tells all that is wrong, with places.
- ``mechanism``: ``Mechanism``, which says in Python what a file says.
- ``schema``: ``Model``, the language as types, and ``schema()``, its JSON Schema.
- ``lower``: ``lower``, from a ``Model`` to the spec of the core, with start, run and report.
- ``units``: quantities and dimensions.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .errors import ModelFileError
    from .mechanism import Mechanism

__all__ = ["Mechanism", "ModelFileError"]


def __getattr__(name: str) -> Any:
    """Imports a name where it is first used, so that importing freebody stays fast."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{'errors' if name == 'ModelFileError' else 'mechanism'}"), name)
