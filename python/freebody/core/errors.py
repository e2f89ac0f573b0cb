"""What the core refuses, each with its place, what is wrong and what to try."""

from __future__ import annotations

from enum import Enum


class OutcomeKind(str, Enum):
    """How a run ended, or why a state has no answer; each is the text that it is in files."""

    COMPLETED = "Completed"
    STOPPED_BY_EVENT = "StoppedByEvent"
    STEP_UNDERFLOW = "StepUnderflow"
    TOO_MANY_STEPS = "TooManySteps"
    OVERFLOW = "Overflow"
    TOLERANCE_TOO_TIGHT = "ToleranceTooTight"
    STIFF_SUSPECTED = "StiffSuspected"
    INTERRUPTED = "Interrupted"
    UNSUPPORTED_METHOD = "Unsupported"
    CHATTER = "Chatter"
    FIXED_POINT_STALLED = "FixedPointStalled"
    SINGULAR_MASS = "singular_mass"
    INSUFFICIENT_ACTUATION = "insufficient_actuation"
    INCONSISTENT_CONSTRAINTS = "inconsistent_constraints"
    INCONSISTENT_VELOCITIES = "inconsistent_velocities"
    CANNOT_ASSEMBLE = "cannot_assemble"
    BRANCH_NOT_FOUND = "branch_not_found"
    BRANCH_LOST = "branch_lost"
    PENETRATION = "penetration"
    SELF_LOCKING = "self_locking"
    PAINLEVE_INCONSISTENT = "painleve_inconsistent"
    PAINLEVE_INDETERMINATE = "painleve_indeterminate"
    CONTACT_UNSOLVED = "contact_unsolved"
    NO_IMPACT = "no_impact"
    SIMULTANEOUS_IMPACT = "simultaneous_impact"
    IMPACT_ITERATION_LIMIT = "impact_iteration_limit"
    STRING_ZERO_LENGTH = "string_zero_length"
    NO_AXES = "no_axes"
    DEAD_POSITION = "dead_position"
    HANDS_OVER_AT_ONCE = "hands_over_at_once"
    BACKWARD = "backward"
    OUT_OF_RANGE = "out_of_range"
    NOT_AN_IMPACT = "not_an_impact"
    NO_IMPACT_DERIVATIVE = "no_impact_derivative"
    FOREIGN_HISTORY = "foreign_history"
    NOT_FINITE = "not_finite"
    WRONG_SIZE = "wrong_size"
    WRONG_QUESTION = "wrong_question"
    UNKNOWN_NAME = "unknown_name"
    UNKNOWN_METHOD = "unknown_method"
    UNSUPPORTED_ROUTE = "unsupported"
    TOO_LARGE = "too_large"

    __str__ = str.__str__


class ModelError(ValueError):
    """A model that cannot be compiled, or numbers that none can have: ``path`` is like ``joints.pivot.of[1]``."""

    def __init__(self, path: str, what: str, hint: str) -> None:
        super().__init__(path, what, hint)
        self.path, self.what, self.hint = path, what, hint

    def __str__(self) -> str:
        return f"{self.path}: {self.what}" + f"\n  {self.hint}" * bool(self.hint)


class ExpressionError(ValueError):
    """Text that is no expression: from ``start`` to ``end``, counted in characters."""

    def __init__(self, start: int, end: int, what: str, hint: str) -> None:
        super().__init__(start, end, what, hint)
        self.start, self.end, self.what, self.hint = start, end, what, hint


class MotionError(RuntimeError):
    """A state that has no answer: of what ``kind``; ``path``: the item of the model that it is about (``joints.pivot``), or empty."""

    def __init__(self, kind: str, path: str, what: str, hint: str) -> None:
        super().__init__(kind, path, what, hint)
        self.kind, self.path, self.what, self.hint = OutcomeKind(kind), path, what, hint


class Indeterminate(LookupError):
    """A reaction that the balance equations do not determine was asked for as if they did."""


class NotFinite(ValueError):
    """An expression was asked for at a moment at which it has no finite value."""
