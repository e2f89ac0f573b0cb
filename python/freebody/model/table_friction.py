"""Where a body that slides on a table comes to rest, as the event it comes to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from freebody.core import Spec

from .names import spell

if TYPE_CHECKING:
    from .writer import Writer

WORD = "table_friction"


def resting(name: str) -> str:
    """The event at which the body rests."""
    return f"{name} rests"


def rest(write: Writer, name: str, written: Spec) -> None:
    """The event that ends a run where the points of a force, which has been ``written``, have all but stopped: what friction at
    rest holds is not decided."""
    fields, full = written["with"], write.prefix + resting(name)
    points = fields["points"]
    speeds = " + ".join(f"hypot(vx({p}), vy({p}))" for p in map(spell, points))
    when = f"({speeds})/{len(points)} - ({fields.get('rest_speed', 1e-10)})"
    plain = {"direction": -1, "condition": None, "opening": False, "guard": True}
    write.spec["events"].append({"name": full, "when": when} | plain | {"then": ["stop"]})
    write.items[f"events.{full}"] = (write.scope, ("forces", name))
