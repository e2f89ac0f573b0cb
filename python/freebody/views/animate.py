"""A run as GIF, MP4 or SVG frames."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array
from freebody.formats import Formats, replacing
from freebody.views.impact_markers import LASTING
from freebody.views.render import frame_axes, render, render_markers
from freebody.views.scene import of_run
from freebody.views.sketch import Sketch
from freebody.views.style import axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from freebody.run.simulation import Run

MAX_FRAMES = 20_000
"""Of a film: ten minutes at 30 a second."""


def animate(run: Run, path: str | Path, fps: int = 30, speed: float = 1.0, traces: Sequence[str] | None = None) -> Path:
    """Write the motion as ``.gif``, ``.mp4`` (needs ffmpeg) or, with a path ending in ``.svg``, numbered SVG frames.

    ``speed`` 0.5 is half as fast as life; ``traces`` names the points whose paths are drawn.
    Returns the file, for frames the first one.
    """
    path = Path(path)
    write = FORMATS.of(path)
    sketch = of_run(run, frame_times(run, fps, speed), traces)
    with quiet():
        ax = _canvas(sketch)
        return write(path, ax.figure, _frames(sketch, ax, LASTING * speed), len(sketch.t), fps)


def frame_times(run: Run, fps: float, speed: float = 1.0) -> Array:
    """Times (nf,) of evenly spaced frames; the nearest saved times where a run is known at those only."""
    start, end = run.edges[0], run.edges[-1]
    frames = max(2, round((end - start) / speed * fps) + 1)
    if frames > MAX_FRAMES:
        raise ValueError(
            f"the film would have {frames} frames; at most {MAX_FRAMES} are drawn: take a shorter run, or a higher speed"
        )
    times = np.linspace(start, end, frames)
    if not run.recorded:
        return times
    return np.unique(run.t[np.abs(run.t[:, None] - times).argmin(axis=0)])


def write_film(path: Path, figure: Figure, frames: Iterator[None], count: int, fps: int) -> Path:
    """A GIF or MP4 of what a figure shows after each of the frames. Raises ``RuntimeError`` where ffmpeg is missing."""
    from matplotlib.animation import FFMpegWriter, PillowWriter

    gif = path.suffix == ".gif"
    if not gif and not shutil.which("ffmpeg"):
        raise RuntimeError("an MP4 needs the program ffmpeg, which is not on PATH; a .gif needs nothing more")
    writer = PillowWriter(fps=fps) if gif else FFMpegWriter(fps=fps, extra_args=["-pix_fmt", "yuv420p"])
    with replacing(path) as beside, writer.saving(figure, str(beside), dpi=110):
        for _ in frames:
            writer.grab_frame()
    return path


def _write_frames(path: Path, figure: Figure, frames: Iterator[None], count: int, fps: int) -> Path:
    digits = len(str(count - 1))
    names = [path.with_name(f"{path.stem}_{k:0{digits}d}.svg") for k in range(count)]
    for name, _ in zip(names, frames, strict=True):
        with replacing(name) as beside:
            figure.savefig(beside)
    return names[0]


FORMATS = Formats("an animation is", {".gif": write_film, ".mp4": write_film, ".svg": _write_frames})


def _canvas(sketch: Sketch) -> Axes:
    """Axes whose shape is that of the motion, with an even number of pixels both ways, as video wants it."""
    x0, x1, y0, y1 = sketch.bounds()
    tall = np.clip((y1 - y0) / max(x1 - x0, 1e-12), 0.45, 1.6)
    width, height = (6.4, 6.4 * tall) if tall < 1 else (6.4 / tall, 6.4)
    even = [2 * round(side * 110 / 2) / 110 for side in (width, height)]
    ax = axes(None, (even[0], even[1]))
    ax.set_axis_off()
    frame_axes(sketch, ax)
    return ax


def _frames(sketch: Sketch, ax: Axes, lasting: float) -> Iterator[None]:
    """Draw frame by frame on the same axes; an impact is seen for ``lasting`` s."""
    paths, lines = [], []
    for name in sketch.traces:
        body, at = sketch.at[name]
        paths.append(np.array([sketch.moved(body, at[None], k)[0] for k in range(len(sketch.t))]))
        lines += ax.plot([], [], color=colour(sketch.tone(body)), lw=1.2, alpha=0.7, zorder=1.5)
    clock = ax.text(0.01, 0.99, "", transform=ax.transAxes, va="top", fontsize=10)
    shown: list[Artist] = []
    for k, t in enumerate(sketch.t):
        for artist in shown:
            artist.remove()
        shown = render(sketch, ax, k) + render_markers(sketch, ax, t, lasting)
        for line, path in zip(lines, paths, strict=True):
            line.set_data(*path[: k + 1].T)
        clock.set_text(f"t = {t:.2f} s")
        yield
