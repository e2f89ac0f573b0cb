"""All values of a parameter or an initial value for which a quantity of the motion is what it is asked to be; its extremes over
them; and where a motion tends to as time goes on."""

from .extremes import Extreme, Extremes, extremes
from .limits import RTOL, Limit, NoLimit, limit, limit_over
from .response import Response
from .roots import Found, Root, find

__all__ = [
    "RTOL",
    "Extreme",
    "Extremes",
    "Found",
    "Limit",
    "NoLimit",
    "Response",
    "Root",
    "extremes",
    "find",
    "limit",
    "limit_over",
]
