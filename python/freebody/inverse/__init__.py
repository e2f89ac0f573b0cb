"""Inverse dynamics: the forces that a motion takes."""

from freebody.inverse.actuators import NotRealizable
from freebody.inverse.laws import quintic, recorded, steady
from freebody.inverse.result import InverseDynamics

__all__ = ["InverseDynamics", "NotRealizable", "quintic", "recorded", "steady"]
