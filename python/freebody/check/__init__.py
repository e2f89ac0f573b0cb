"""Is my equation right? Statements of a person against the mechanics of a model."""

from .api import Checker, check
from .verdict import Evidence, Kind, Mend, Verdict

__all__ = ["Checker", "Evidence", "Kind", "Mend", "Verdict", "check"]
