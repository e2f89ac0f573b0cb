"""The modes of an equilibrium, each drawn at both ends of its swing or as a film of it; its frequency response."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, State
from freebody.formats import Formats, replacing
from freebody.stability.equilibria import Equilibrium
from freebody.stability.modes import Mode, response
from freebody.views.animate import write_film
from freebody.views.render import frame_axes, render
from freebody.views.scene import drawn
from freebody.views.sketch import Sketch, sketch_of_state
from freebody.views.style import colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SWING = 0.3
"""The largest amplitude that is drawn, rad or part of the mechanism."""
_FAINT, _ACROSS, _WIDTH, _HEIGHT = 0.25, 3, 3.4, 3.2
_NONE = 1e-9
"""Amplitude that is printed as 0."""
_FRAMES, _A_SECOND = 48, 24
"""Of a film, in which every mode swings once, whatever its frequency."""
_FOLDS = 3.0
"""Powers of e by which a mode that does not oscillate dies away, or grows, in a film."""


def draw_modes(rest: Equilibrium, path: Path) -> Path:
    """Writes one drawing a mode, with its frequency, damping ratio and the amplitudes of the coordinates, or a film (``.gif``, ``.mp4``)
    in which each swings once, all with their phases; loops are closed in each. What does not oscillate dies away or grows."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    count = max(1, len(rest.modes))
    across = min(_ACROSS, count)
    down = -(-count // across)
    with quiet():
        figure = Figure(figsize=(_WIDTH * across, _HEIGHT * down), layout="constrained", dpi=110)
        FigureCanvasAgg(figure)
        shown = [_stage(rest, mode, figure.add_subplot(down, across, i + 1)) for i, mode in enumerate(rest.modes)]
        return FORMATS.of(path)(rest, figure, shown, path)


_Shown = tuple["Axes", list[Sketch], Array]
"""Where a mode is drawn; the mechanism at rest and at both ends of its swing; the displacements (frames, n) of the swing."""


def _stage(rest: Equilibrium, mode: Mode, ax: Axes) -> _Shown:
    """The axes of a mode with its title, as wide as its swing."""
    ax.set_axis_off()
    units = rest.source.free_bodies(rest.state).units(rest.source.metadata["coordinates"])
    shape = np.array(list(mode.shape.values()))
    shape = _SWING * shape / (np.abs(shape / units).max() or 1.0)
    phase = 2 * np.pi * np.arange(_FRAMES) / _FRAMES
    if mode.frequency:
        swing = (shape * np.exp(1j * phase[:, None])).real
    else:
        part = phase / (2 * np.pi) if mode.eigenvalue.real > 0 else 1 - phase / (2 * np.pi)
        swing = shape.real * np.exp(_FOLDS * (part[:, None] - 1))
    ends = [_moved(rest, by) for by in (0 * shape.real, -shape.real, shape.real)]
    corners: list[list[float]] = []
    for sketch in ends:
        frame_axes(sketch, ax, margin=4.0)
        corners.append([*ax.get_xlim(), *ax.get_ylim()])
    low_x, high_x, low_y, high_y = np.array(corners).T
    ax.set(xlim=(low_x.min(), high_x.max()), ylim=(low_y.min(), high_y.max()))
    parts = ", ".join(f"{name} {x.real if abs(x.real) > _NONE else 0.0:.3g}" for name, x in list(mode.shape.items())[:4])
    stated = f"{mode.frequency:.4g} Hz, ζ = {mode.damping:.3g}" if mode.frequency else f"λ = {mode.eigenvalue.real:.4g} 1/s"
    ax.set_title(f"{stated}\n{parts}".replace("$", r"\$"), fontsize=8)
    return ax, ends, swing


def _picture(rest: Equilibrium, figure: Figure, shown: Sequence[_Shown], path: Path) -> Path:
    """Both ends of each swing."""
    for ax, ends, _ in shown:
        for sketch, alpha in zip(ends, (_FAINT, _FAINT, 1.0), strict=True):
            for artist in render(sketch, ax):
                artist.set_alpha(alpha)
    with replacing(path) as beside:
        figure.savefig(beside)
    return path


def _film(rest: Equilibrium, figure: Figure, shown: Sequence[_Shown], path: Path) -> Path:
    return write_film(path, figure, _frames(rest, shown), _FRAMES, _A_SECOND)


FORMATS = Formats(
    "modes are drawn as", dict.fromkeys((".svg", ".png", ".pdf"), _picture) | dict.fromkeys((".gif", ".mp4"), _film)
)


def _frames(rest: Equilibrium, shown: Sequence[_Shown]) -> Iterator[None]:
    """Draws frame by frame, over the faint place of rest."""
    for ax, (still, *_), _ in shown:
        for artist in render(still, ax):
            artist.set_alpha(_FAINT)
    for k in range(_FRAMES):
        artists = [artist for ax, _, swing in shown for artist in render(_moved(rest, swing[k]), ax)]
        yield
        for artist in artists:
            artist.remove()


def draw_response(rest: Equilibrium, frequencies: Array, path: Path) -> Path:
    """Writes amplitude (SI) and phase of each output over frequencies in Hz, for each input; both axes of the amplitudes are
    logarithmic. Frequencies of modes are among those drawn."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    space, (low, high) = rest.space, frequencies[[0, -1]]
    own = [mode.frequency for mode in rest.modes if low < mode.frequency < high]
    f = np.unique(np.concatenate([frequencies, *(x * (1 + np.geomspace(1e-4, 0.1, 20) * s) for x in own for s in (-1, 1)), own]))
    f = f[(f >= low) & (f <= high)]
    found = response(space, f)
    with quiet():
        figure: Figure = Figure(figsize=(6.4, 5.2), layout="constrained", dpi=110)
        FigureCanvasAgg(figure)
        size, phase = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
        for k, (i, j) in enumerate(product(range(len(space.outputs)), range(len(space.inputs)))):
            gain = found[:, i, j]
            size.loglog(f, np.abs(gain), color=colour(k), label=f"{space.outputs[i]} / {space.inputs[j]}".replace("$", r"\$"))
            turned = np.degrees(np.angle(gain))
            turned[1:][np.abs(np.diff(turned)) > 180] = np.nan  # no stroke from −180° to 180°
            phase.semilogx(f, turned, color=colour(k))
        for x in own:
            for ax in (size, phase):
                ax.axvline(x, lw=0.6, ls=":", color="0.5")
        size.set_ylabel("amplitude  [SI]")
        size.legend(fontsize=8)
        phase.set(xlabel="f  [Hz]", ylabel="phase  [°]", ylim=(-190, 190), yticks=(-180, -90, 0, 90, 180), xlim=(low, high))
        with replacing(path) as beside:
            figure.savefig(beside)
    return path


def _moved(rest: Equilibrium, by: Array) -> Sketch:
    """The mechanism displaced, its loops closed, with symbols as large as at rest."""
    guess = dict(zip(rest.space.coordinates, (rest.state.q + by).tolist(), strict=True))
    free = {name: guess[name] for name in rest.space.free}
    state: State = rest.source.assemble(rest.state.p, rest.state.t, fixed=free, guess=guess, history=rest.state.history)[0]
    sketch = sketch_of_state(rest.source, state)
    sketch.size = sketch_of_state(rest.source, rest.state).size
    return drawn(sketch)
