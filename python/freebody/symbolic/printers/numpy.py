"""Functions in Python with NumPy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

from freebody.symbolic.printers.source import Language, Step


class NumPy(Language):
    """Python with NumPy."""

    functions: ClassVar[Mapping[str, str]] = {
        "sin": "np.sin({})", "cos": "np.cos({})", "tan": "np.tan({})", "exp": "np.exp({})", "ln": "np.log({})",
        "atan2": "np.arctan2({}, {})", "abs": "np.abs({})", "sign": "np.sign({})",
        "sqrt": "np.sqrt({})", "power": "np.power({}, {})",
    }  # fmt: skip

    def function(
        self, name: str, arrays: Sequence[str], steps: Sequence[Step], results: Sequence[str], shape: tuple[int, ...]
    ) -> str:
        lines = [f"def {name}({', '.join(arrays)}):", *(f"    {step} = {value}" for step, value in steps)]
        if shape == ():
            return "\n".join([*lines, f"    return {results[0]}"])
        entries = [f"        {result}," for result in results]
        return "\n".join([*lines, "    return _array([", *entries, f"    ], {shape!r})"])

    def file(self, header: Sequence[str], functions: Sequence[str]) -> str:
        safe = [line.replace("\\", "\\\\").replace('"', "'") for line in header]
        top = ['"""Generated from the equations of a freebody model, in SI units and radians.', "", *safe, '"""']
        top += ["", "import numpy as np", "", "", "def _array(entries, shape):"]
        top += ["    entries = np.broadcast_arrays(*entries)"]
        top += ["    return np.stack(entries).reshape(shape + entries[0].shape)"]
        return "\n\n\n".join(["\n".join(top), *functions]) + "\n"
