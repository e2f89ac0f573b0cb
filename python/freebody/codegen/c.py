"""Functions in C, and the part of generated C that solves."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, ClassVar

from freebody.codegen.source import Language, Step

if TYPE_CHECKING:
    from freebody.codegen.systems import Systems

_SOLVE = """/* Solves a x = b, a of n rows, by elimination with row interchanges; x comes in b. 1 if a is singular, else 0. */
static int solve(int n, double *a, double *b)
{
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i*n + k]) > fabs(a[pivot*n + k]))
                pivot = i;
        if (!(fabs(a[pivot*n + k]) > 0.0))
            return 1;
        for (int j = 0; j < n; j++) {
            const double kept = a[k*n + j];
            a[k*n + j] = a[pivot*n + j];
            a[pivot*n + j] = kept;
        }
        const double right = b[k];
        b[k] = b[pivot];
        b[pivot] = right;
        for (int i = k + 1; i < n; i++) {
            const double factor = a[i*n + k]/a[k*n + k];
            for (int j = k; j < n; j++)
                a[i*n + j] -= factor*a[k*n + j];
            b[i] -= factor*b[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            b[k] -= a[k*n + j]*b[j];
        b[k] /= a[k*n + k];
    }
    return 0;
}"""
_FREE = """/* out: second derivatives of the coordinates, the solution of mass_matrix q'' = right_hand_side. 1 if singular, else 0. */
int accelerations(const double *q, const double *u, const double *p, double t, double *out)
{
    double matrix[COORDINATES*COORDINATES];
    mass_matrix(q, u, p, t, matrix);
    right_hand_side(q, u, p, t, out);
    return solve(COORDINATES, matrix, out);
}"""
_CLOSED = """/* out: second derivatives of the coordinates, then the multipliers:
   mass_matrix q'' = right_hand_side + multiplier_matrix multipliers, constraint_jacobian q'' + constraint_bias = 0. */
static int accelerations_and_multipliers(const double *q, const double *u, const double *p, double t, double *out)
{
    enum { ALL = COORDINATES + MULTIPLIERS };
    double mass[COORDINATES*COORDINATES], held[COORDINATES*MULTIPLIERS], rows[MULTIPLIERS*COORDINATES];
    double matrix[ALL*ALL] = {0.0};
    mass_matrix(q, u, p, t, mass);
    multiplier_matrix(q, u, p, t, held);
    constraint_jacobian(q, u, p, t, rows);
    right_hand_side(q, u, p, t, out);
    constraint_bias(q, u, p, t, out + COORDINATES);
    for (int i = 0; i < COORDINATES; i++) {
        for (int j = 0; j < COORDINATES; j++)
            matrix[i*ALL + j] = mass[i*COORDINATES + j];
        for (int j = 0; j < MULTIPLIERS; j++) {
            matrix[i*ALL + COORDINATES + j] = -held[i*MULTIPLIERS + j];
            matrix[(COORDINATES + j)*ALL + i] = rows[j*COORDINATES + i];
        }
    }
    for (int j = COORDINATES; j < ALL; j++)
        out[j] = -out[j];
    return solve(ALL, matrix, out);
}

/* out: second derivatives of the coordinates. 1 if singular, else 0. */
int accelerations(const double *q, const double *u, const double *p, double t, double *out)
{
    double all[COORDINATES + MULTIPLIERS];
    const int singular = accelerations_and_multipliers(q, u, p, t, all);
    for (int i = 0; i < COORDINATES; i++)
        out[i] = all[i];
    return singular;
}

/* out: the loads that hold the constraints, in the order of MULTIPLIER_NAMES. 1 if singular, else 0. */
int multipliers(const double *q, const double *u, const double *p, double t, double *out)
{
    double all[COORDINATES + MULTIPLIERS];
    const int singular = accelerations_and_multipliers(q, u, p, t, all);
    for (int j = 0; j < MULTIPLIERS; j++)
        out[j] = all[COORDINATES + j];
    return singular;
}"""
_LOADS = """/* out: all unknown loads, in the order of LOAD_NAMES, from the balances of all bodies,
   balance_matrix x = balance_right_hand_side. 1 if singular, else 0. */
int reactions(const double *q, const double *u, const double *p, double t, double *out)
{
    enum { ALL = COORDINATES + LOADS };
    double matrix[ALL*ALL], all[ALL];
    balance_matrix(q, u, p, t, matrix);
    balance_right_hand_side(q, u, p, t, all);
    const int singular = solve(ALL, matrix, all);
    for (int i = 0; i < LOADS; i++)
        out[i] = all[COORDINATES + i];
    return singular;
}"""
_RATE = """/* out: rate of the state y = (q, u). 1 if singular, else 0. */
int derivative(double t, const double *y, const double *p, double *out)
{
    for (int i = 0; i < COORDINATES; i++)
        out[i] = y[COORDINATES + i];
    return accelerations(y, y + COORDINATES, p, t, out + COORDINATES);
}"""


class C99(Language):
    """C, ISO/IEC 9899:1999."""

    word, ending, doc = "c", "c", "C99"
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

    def solvers(self, systems: Systems) -> str:
        parts = [_names(systems), _SOLVE, _CLOSED if systems.rows else _FREE, *([_LOADS] if systems.loads else []), _RATE]
        return "\n" + "\n\n".join(parts) + "\n"


def _names(systems: Systems) -> str:
    named = {"COORDINATE": systems.coordinates, "LOAD": systems.loads, "MULTIPLIER": systems.multipliers}
    named = {word: names for word, names in named.items() if names}
    counts = ", ".join(f"{word}S = {len(names)}" for word, names in named.items())
    lines = [f"enum {{ {counts} }};"]
    for word, names in named.items():
        lines.append(_array(f"const char *const {word}_NAMES", [(json.dumps(name), systems.nomenclature[name].doc) for name in names]))
    values = [(repr(float(value)), f"{name} [{systems.nomenclature[name].unit}]") for name, value in systems.values.items()]
    return "\n".join([*lines, _array("const double DEFAULTS", values or [("0.0", "no parameters")])])


def _array(what: str, entries: list[tuple[str, str]]) -> str:
    safe = [(entry, comment.replace("*/", "* /")) for entry, comment in entries]
    lines = [f"    {entry}, /* {comment} */\n" if comment else f"    {entry},\n" for entry, comment in safe]
    return f"{what}[] = {{\n{''.join(lines)}}};"


def _mentions(code: str, word: str) -> bool:
    return re.search(rf"\b{word}\b", code) is not None
