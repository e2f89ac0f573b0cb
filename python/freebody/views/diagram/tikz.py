"""A sheet as TikZ for a LaTeX article, whose letters it then has. One unit is a big point, as on the sheet."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from freebody.core import Array
from freebody.document.rendering.latex import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PREAMBLE = r"% \usepackage{amsmath,amssymb,tikz} \usetikzlibrary{arrows.meta}"
_ANCHORS = {("left", "top"): "north west", ("left", "center"): "west", ("center", "center"): "center"}
_MATHEMATICS = re.compile(r"(?<!\\)(\$.*?(?<!\\)\$)")


def tikz(figure: Figure) -> str:
    """The ``tikzpicture`` of a figure that ``paper.sheet`` has drawn."""
    from matplotlib.colors import to_hex

    colours: dict[str, str] = {}

    def tint(colour: Any) -> str:
        shown = to_hex(colour).removeprefix("#").upper()
        return colours.setdefault(shown, f"tint{len(colours)}")

    [ax] = figure.axes
    drawn = [tikz for artist in sorted(ax.get_children(), key=lambda each: each.get_zorder()) for tikz in _drawn(artist, tint)]
    named = [rf"\definecolor{{{name}}}{{HTML}}{{{shown}}}" for shown, name in colours.items()]
    opened = r"\begin{tikzpicture}[x=1bp,y=1bp,line join=round]"
    return "\n".join([_PREAMBLE, opened, *named, *drawn, r"\end{tikzpicture}", ""])


def _drawn(artist: Any, tint: Any) -> Iterable[str]:
    """What stands for a polygon, a line, a dot, an arrow or a text; nothing for what a sheet does not show."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Polygon
    from matplotlib.text import Annotation, Text

    if isinstance(artist, Polygon):
        fill = f",fill={tint(artist.get_facecolor())}" if artist.get_fill() else ""
        look = _pen(tint(artist.get_edgecolor()), artist.get_linewidth(), artist.get_linestyle() != "solid")
        corners = artist.get_xy()[:-1] if artist.get_closed() else artist.get_xy()
        yield rf"\path[{look}{fill}] {_path(corners)}{' -- cycle' if artist.get_closed() else ''};"
    elif isinstance(artist, Line2D) and artist.get_marker() == "o":
        look = _pen(tint(artist.get_markeredgecolor()), artist.get_markeredgewidth(), False)
        yield rf"\path[{look},fill={tint(artist.get_markerfacecolor())}] {_path(artist.get_xydata())} circle[radius={_short(artist.get_markersize() / 2)}];"
    elif isinstance(artist, Line2D):
        yield rf"\path[{_pen(tint(artist.get_color()), artist.get_linewidth(), artist.is_dashed())}] {_path(artist.get_xydata())};"
    elif isinstance(artist, Annotation) and artist.arrow_patch:
        arrow = artist.arrow_patch
        style, head = arrow.get_arrowstyle(), arrow.get_mutation_scale()
        tip = f"-{{Triangle[length={_short(style.head_length * head)}bp,width={_short(2 * style.head_width * head)}bp]}}"
        yield rf"\path[{_pen(tint(arrow.get_edgecolor()), arrow.get_linewidth(), False)},{tip}] {_path([artist.xyann, artist.xy])};"
    elif isinstance(artist, Text) and artist.get_text():
        size, anchor = artist.get_fontsize(), _ANCHORS[artist.get_ha(), artist.get_va()]
        font = rf"\fontsize{{{_short(size)}}}{{{_short(1.2 * size)}}}\selectfont" + r"\bfseries" * (artist.get_weight() == "bold")
        look = f"inner sep=0,anchor={anchor},text={tint(artist.get_color())},font={font}"
        yield rf"\node[{look}] at {_path([artist.get_position()])} {{{_text(artist.get_text())}}};"


def _pen(colour: str, width: float, dashed: bool) -> str:
    return (
        f"draw={colour},line width={_short(width)}bp"
        + f",dash pattern=on {_short(4 * width)}bp off {_short(3 * width)}bp" * dashed
    )


def _path(places: Array | Iterable[Any]) -> str:
    return " -- ".join(f"({_short(x)},{_short(y)})" for x, y in places)


def _short(number: float) -> str:
    return f"{number + 0.0:.2f}".rstrip("0").rstrip(".")


def _text(text: str) -> str:
    """Mathematics is written as LaTeX writes it; all else is plain."""
    parts = _MATHEMATICS.split(text)
    return "".join(part if i % 2 else plain(part.replace(r"\$", "$")) for i, part in enumerate(parts))
