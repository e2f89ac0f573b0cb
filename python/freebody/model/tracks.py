"""Circles, and tracks of lines and arcs, as expressions of the curve parameter ``s``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .arithmetic import Number, difference, text, worked
from .errors import ModelProblem
from .schema import Stretch

At = list[Number]


def circle(centre: At, radius: Number) -> tuple[str, str]:
    """x and y of a circle; ``s`` is the angle from the x axis."""
    x, y = (text(c) for c in centre)
    return f"{x} + {text(radius)}*cos(s)", f"{y} + {text(radius)}*sin(s)"


@dataclass(frozen=True)
class _Leg:
    """One stretch: its length and its coordinates as expressions of the way ``{w}`` from its beginning."""

    length: str
    x: str
    y: str


def track(stretches: list[Stretch], at: Callable[[int, str], At]) -> tuple[str, str]:
    """x and y of stretches one after another; ``s`` is the length of the way. Beyond its ends the track goes on as there.

    ``at(i, name)`` gives the coordinates of a point of stretch ``i``. Raises ``ModelProblem``.
    """
    if not stretches:
        raise ModelProblem("a track needs a line or an arc", "write `[{line: [A, B]}]`")
    legs: list[_Leg] = []
    end: At | None = None
    for i, stretch in enumerate(stretches):
        if stretch.line is not None:
            start, stop = (at(i, name) for name in stretch.line)
            if end is not None and start != end:
                raise ModelProblem("the track has a gap", f"the line {stretch.line} must begin where the stretch before it ends")
            legs.append(_line(start, stop))
            end = stop
        elif end is None:
            raise ModelProblem(
                "a track cannot begin with an arc", "an arc begins where the stretch before it ends: begin with a line"
            )
        else:
            stop = at(i, stretch.arc.to)
            legs.append(_arc(end, at(i, stretch.arc.centre), stop))
            end = stop
    return _joined(legs)


def _line(start: At, stop: At) -> _Leg:
    dx, dy = (difference(b, a) for a, b in zip(start, stop, strict=True))
    length = _operand(f"hypot({dx}, {dy})")
    return _Leg(length, f"{text(start[0])} + {dx}*{{w}}/{length}", f"{text(start[1])} + {dy}*{{w}}/{length}")


def _arc(start: At, centre: At, stop: At) -> _Leg:
    (ax, ay), (bx, by) = ([difference(p, c) for p, c in zip(point, centre, strict=True)] for point in (start, stop))
    radius = _operand(f"hypot({ax}, {ay})")
    sweep = f"atan2({ax}*{by} - {ay}*{bx}, {ax}*{bx} + {ay}*{by})"
    turn = f"{_operand(f'sign({sweep})')}*{{w}}/{radius}"
    x = f"{text(centre[0])} + {ax}*cos({turn}) - {ay}*sin({turn})"
    y = f"{text(centre[1])} + {ax}*sin({turn}) + {ay}*cos({turn})"
    return _Leg(_operand(f"{radius}*abs({sweep})"), x, y)


def _joined(legs: list[_Leg]) -> tuple[str, str]:
    before, ways = "", []
    for leg in legs:
        ways.append(f"(s - ({before}))" if before else "s")
        before = f"{before} + {leg.length}" if before else leg.length
    x, y = (getattr(legs[-1], axis).format(w=ways[-1]) for axis in "xy")
    for i in range(len(legs) - 2, -1, -1):
        until = " + ".join(leg.length for leg in legs[: i + 1])
        x, y = (f"if(s < {until}, {getattr(legs[i], axis).format(w=ways[i])}, {later})" for axis, later in (("x", x), ("y", y)))
    return x, y


def _operand(expression: str) -> str:
    """The expression, or its value where it has no names, as a factor."""
    found = worked(expression)
    return found if isinstance(found, str) else text(found)
