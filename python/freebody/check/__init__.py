"""Is my equation right? Statements of a person against the mechanics of a model."""

from .api import Checker
from .verdict import Correction, Evidence, Kind, Verdict

__all__ = ["Checker", "Correction", "Evidence", "Kind", "Verdict"]
