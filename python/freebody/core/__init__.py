"""All that speaks with the compiled core: a model compiled, states of it, and what it answers, as typed objects.

Text and plain data of ``freebody._core`` end here; everybody else imports from this package.
"""

from __future__ import annotations

from freebody._core import Evaluator, parse

from .compiled import BEFORE, EXTREMES, CompiledModel, PlotItem, ReportItem, Settings, Spec, quote
from .errors import ExpressionError, Indeterminate, ModelError, MotionError, NotFinite, OutcomeKind
from .free_bodies import GROUND, Body, FreeBodies, Load, Pair, Part, Row
from .motion import Change, Event, Impulses, Motion, Outcome, Snapshot, Trajectory, there
from .solution import Limit, Rank, RowDerivatives, Solution, SymbolicAnswers
from .state import Array, State

__all__ = [
    "BEFORE",
    "EXTREMES",
    "GROUND",
    "Array",
    "Body",
    "Change",
    "CompiledModel",
    "Evaluator",
    "Event",
    "ExpressionError",
    "FreeBodies",
    "Impulses",
    "Indeterminate",
    "Limit",
    "Load",
    "ModelError",
    "Motion",
    "MotionError",
    "NotFinite",
    "Outcome",
    "OutcomeKind",
    "Pair",
    "Part",
    "PlotItem",
    "Rank",
    "ReportItem",
    "Row",
    "RowDerivatives",
    "Settings",
    "Snapshot",
    "Solution",
    "Spec",
    "State",
    "SymbolicAnswers",
    "Trajectory",
    "parse",
    "quote",
    "there",
]
