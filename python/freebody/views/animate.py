"""A run as GIF, MP4 or SVG frames."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.run.records import Array
from freebody.views.impact_markers import LASTING
from freebody.views.render import frame_axes, render, render_markers
from freebody.views.scene import Scene, of_run
from freebody.views.style import axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from freebody.run.simulation import Run


def animate(run: Run, path: str | Path, fps: int = 30, speed: float = 1.0, traces: Sequence[str] | None = None) -> Path:
    """Write the motion as ``.gif``, ``.mp4`` (needs ffmpeg) or, with a path ending in ``.svg``, numbered SVG frames.

    ``speed`` 0.5 is half as fast as life; ``traces`` names the points whose paths are drawn.
    Returns the file, for frames the first one.
    """
    path = Path(path)
    if path.suffix not in (".gif", ".mp4", ".svg"):
        raise ValueError(f"an animation is .gif, .mp4 or .svg, not {path.suffix or 'without a suffix'!r}")
    scene = of_run(run, frame_times(run, fps, speed), traces)
    lasting = LASTING * speed
    if path.suffix == ".svg":
        return _write_frames(scene, path, lasting)
    return _write_movie(scene, path, fps, lasting)


def frame_times(run: Run, fps: float, speed: float = 1.0) -> Array:
    """Times (nf,) of evenly spaced frames; the nearest saved times where a run is known at those only."""
    start, end = run.edges[0], run.edges[-1]
    times = np.linspace(start, end, max(2, round((end - start) / speed * fps) + 1))
    if not run.recorded:
        return times
    return np.unique(run.t[np.abs(run.t[:, None] - times).argmin(axis=0)])


def _write_movie(scene: Scene, path: Path, fps: int, lasting: float) -> Path:
    from matplotlib.animation import FFMpegWriter, PillowWriter

    if path.suffix == ".mp4" and not shutil.which("ffmpeg"):
        raise RuntimeError("an MP4 needs the program ffmpeg, which is not on PATH; a .gif needs nothing more")
    with quiet():
        ax = _canvas(scene)
        writer = FFMpegWriter(fps=fps, extra_args=["-pix_fmt", "yuv420p"]) if path.suffix == ".mp4" else PillowWriter(fps=fps)
        with writer.saving(ax.figure, str(path), dpi=110):
            for _ in _frames(scene, ax, lasting):
                writer.grab_frame()
    return path


def _write_frames(scene: Scene, path: Path, lasting: float) -> Path:
    digits = len(str(len(scene.t) - 1))
    names = [path.with_name(f"{path.stem}_{k:0{digits}d}.svg") for k in range(len(scene.t))]
    with quiet():
        ax = _canvas(scene)
        for k, _ in enumerate(_frames(scene, ax, lasting)):
            ax.figure.savefig(names[k])
    return names[0]


def _canvas(scene: Scene) -> Axes:
    """Axes whose shape is that of the motion, with an even number of pixels both ways, as video wants it."""
    x0, x1, y0, y1 = scene.bounds()
    tall = np.clip((y1 - y0) / max(x1 - x0, 1e-12), 0.45, 1.6)
    width, height = (6.4, 6.4 * tall) if tall < 1 else (6.4 / tall, 6.4)
    even = [2 * round(side * 110 / 2) / 110 for side in (width, height)]
    ax = axes(None, (even[0], even[1]))
    ax.set_axis_off()
    frame_axes(scene, ax)
    return ax


def _frames(scene: Scene, ax: Axes, lasting: float) -> Iterator[None]:
    """Draw frame by frame on the same axes; an impact is seen for ``lasting`` s."""
    at = scene.points()
    paths = [np.array([scene.place(at[n][0], np.array([at[n][1]]), k)[0] for k in range(len(scene.t))]) for n in scene.traces]
    lines = [ax.plot([], [], color=colour(at[n][0] - 1), lw=1.2, alpha=0.7, zorder=1.5)[0] for n in scene.traces]
    clock = ax.text(0.01, 0.99, "", transform=ax.transAxes, va="top", fontsize=10)
    shown: list[Artist] = []
    for k, t in enumerate(scene.t):
        for artist in shown:
            artist.remove()
        shown = render(scene, ax, k) + render_markers(scene, ax, t, lasting)
        for line, path in zip(lines, paths, strict=True):
            line.set_data(*path[: k + 1].T)
        clock.set_text(f"t = {t:.2f} s")
        yield
