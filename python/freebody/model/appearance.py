"""What a model says of how it is drawn, as types."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .values import Length, Pair, Place, Section, one_of, refuse

COLOURS = ("blue", "orange", "green", "pink", "yellow", "sky", "purple", "grey")
"""Those that bodies are drawn in, in turn."""


class PieceLook(Section):
    """How a piece of a body is drawn; nothing of it is mechanics."""

    colour: Literal[COLOURS] = Field(None, description="Its colour.")
    thickness: Length = Field(None, description="How wide a rod and arms are, or the rim of a disk or ring.")
    spokes: int = Field(None, ge=2, le=60, description="How many spokes a disk or ring has.")
    wheels: Length = Field(None, description="The radius of two wheels on which a rectangle stands, within its outline.")

    def suits(self, shape: str) -> None:
        """Raises where a shape cannot look so."""
        if self.spokes and shape not in ("disk", "ring"):
            raise refuse(f"a {shape} has no spokes", "leave them out; a disk or ring has some")
        if self.wheels is not None and shape != "rectangle":
            raise refuse(f"a {shape} stands on no wheels", "leave them out; a rectangle does")


class Look(PieceLook):
    """How a body is drawn; nothing of it is mechanics."""

    layer: Literal["behind", "front"] = Field(None, description="Whether it lies behind all other bodies, or in front of them.")


class SvgPath(Section):
    """An outline as the data of an SVG path."""

    path: str = Field(description="The data, as in the `d` of a `<path>`.")
    unit: Length = Field(1, description="The length of 1 in the data.")
    at: Pair = Field([0, 0], description="Where the origin of the data is, in the body's frame.")
    y: Literal["up", "down"] = Field("up", description="Which way y goes in the data; in drawing programs down.")


Outline = one_of(
    "this is no outline",
    "write a list of points, `{path: M 0 0 L 40 0 L 20 30 Z, unit: 1 mm}`, or `none`",
    text=Literal["none"],
    pair=list[Place],
    mapping=SvgPath,
)
