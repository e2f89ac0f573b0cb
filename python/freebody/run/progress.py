"""How far a run is, as it goes on: by a function of one's own, or as a bar of tqdm, in a notebook too."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[float], bool]
"""Called now and then with the time reached, s; False ends the run."""


@contextmanager
def reporting(progress: Progress | bool | None, end: float) -> Iterator[Progress | None]:
    """What the core calls on the way to ``end`` (s): the function itself, or for ``True`` what moves a bar. Raises ``ImportError``."""
    if progress is not True:
        yield progress or None
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise ImportError("a progress bar needs tqdm, which is not installed: pip install tqdm") from None
    with tqdm(total=end, bar_format="{l_bar}{bar}| {n:.4g} of {total:.4g} s [{elapsed}<{remaining}]") as bar:

        def move(t: float) -> bool:
            bar.update(t - bar.n)
            return True

        yield move
        move(end)
