"""Numbers on their way to the browser."""

from __future__ import annotations

import base64

import numpy as np
from numpy.typing import ArrayLike


def floats(values: ArrayLike) -> str:
    """As Float32, little-endian, in base64."""
    return base64.b64encode(np.asarray(values, "<f4").tobytes()).decode()
