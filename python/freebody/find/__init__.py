"""All values of a parameter or an initial value for which a quantity of the motion is what it is asked to be; its extremes over
them; and where a motion tends to as time goes on."""

from .extremes import Extreme, Extremes, extremes
from .limits import Limit, NoLimit, limit, limit_over
from .roots import Found, Root, find

__all__ = ["Extreme", "Extremes", "Found", "Limit", "NoLimit", "Root", "extremes", "find", "limit", "limit_over"]
