"""Functions in C."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import ClassVar

from freebody.symbolic.printers.source import Language, Step


class C99(Language):
    """C, ISO/IEC 9899:1999."""

    functions: ClassVar[Mapping[str, str]] = {
        "sin": "sin({})", "cos": "cos({})", "tan": "tan({})", "exp": "exp({})", "ln": "log({})",
        "atan2": "atan2({}, {})", "abs": "fabs({})", "sign": "sign({})", "sqrt": "sqrt({})", "power": "pow({}, {})",
    }  # fmt: skip

    def function(
        self, name: str, arrays: Sequence[str], steps: Sequence[Step], results: Sequence[str], shape: tuple[int, ...]
    ) -> str:
        taken = ", ".join(f"double {x}" if x == "t" else f"const double *{x}" for x in arrays)
        used = " ".join(value for _, value in steps) + " ".join(results)
        idle = [x for x in arrays if f"{x}[" not in used and (x != "t" or not _mentions(used, "t"))]
        body = [f"    (void)({x});" for x in idle] + [f"    const double {step} = {value};" for step, value in steps]
        if shape == ():
            return "\n".join([f"double {name}({taken})", "{", *body, f"    return {results[0]};", "}"])
        body += [f"    out[{place}] = {result};" for place, result in enumerate(results)]
        return "\n".join([f"/* out: {' × '.join(map(str, shape))} */", f"void {name}({taken}, double *out)", "{", *body, "}"])

    def file(self, header: Sequence[str], functions: Sequence[str]) -> str:
        safe = [line.replace("*/", "* /") for line in header]
        top = ["/* Generated from the equations of a freebody model, in SI units and radians.", "", *safe, "*/"]
        top += ["", "#include <math.h>"]
        if any(_mentions(function, "sign") for function in functions):
            top += ["", "static double sign(double x)", "{", "    return (double)((x > 0.0) - (x < 0.0));", "}"]
        return "\n\n".join(["\n".join(top), *functions]) + "\n"


def _mentions(code: str, word: str) -> bool:
    return re.search(rf"\b{word}\b", code) is not None
