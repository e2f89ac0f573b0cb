"""An answer in words: what was found, and how it was checked."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from freebody.catalogue.answers import Answer
from freebody.solve.figures import figure

_SHOWN = 6
"""Figures of a long row that a sentence tells, unless all are asked for."""


def figures(answer: Answer) -> list[str]:
    """Figures with the digits that hold, or yes and no."""
    if np.asarray(answer.value).dtype == bool:
        return ["yes" if x else "no" for x in answer.row]
    return [figure(x, 8) for x in answer.known]


def found(answer: Answer, full: bool = False) -> str:
    """What was found, in symbols or in figures with their unit; of a long row the first ones, of a constant row one."""
    told = figures(answer)
    told = told[:1] if not full and len(set(told)) == 1 else told
    if answer.said or full or len(told) <= _SHOWN:
        return answer.said or _with_unit(", ".join(told), answer.unit)
    return f"{_with_unit(', '.join(told[:_SHOWN]) + ', …', answer.unit)} ({len(told)} in all; --full)"


def sentence(answer: Answer, full: bool = False) -> str:
    """What the answer says: its own words with what was found in them, or ``symbol = …``, or ``label: …``."""
    if answer.says.count("{") > 1:
        return answer.says.format(*(_with_unit(told, answer.unit) for told in figures(answer)))
    if answer.says:
        return answer.says.format(found(answer, full))
    return f"{answer.label}{':' if ' ' in answer.label else ' ='} {found(answer, full)}"


def folded(variant: str, answers: Sequence[Answer]) -> str:
    """The answers of a variant on one line; the label is left out where there is only one."""
    told = [sentence(answer) if answer.says or len(answers) > 1 else found(answer) for answer in answers]
    return f"{variant}: {' '.join(one if one.endswith('.') else f'{one};' for one in told).rstrip(';')}"


def checks(answers: Sequence[Answer]) -> str:
    """What answers were checked against and to how many digits; each that disagrees, by name."""
    lines = [_disagreement(answer) for answer in answers if not answer.ok]
    for own in (False, True):
        agree = [answer for answer in answers if answer.ok and answer.own == own]
        if agree:
            sources = "; ".join(dict.fromkeys(answer.against for answer in agree))
            least = int(min(answer.digits for answer in agree))
            digits = f"{'at least ' * (len(agree) > 1)}{least} digit{'s' * (least != 1)}"
            lines.append(f"{'of the same run, no check' if own else 'checked'}: {sources}, {digits}")
    return "\n".join(lines)


def _with_unit(told: str, unit: str) -> str:
    return f"{told} {unit}" if unit else told


def _disagreement(answer: Answer) -> str:
    value, check = np.broadcast_arrays(*(np.ravel(np.asarray(x, float)) for x in (answer.value, answer.check)))
    worst = int(np.argmax(np.nan_to_num(np.abs(value - check), nan=np.inf)))
    if math.isnan(check[worst]):
        return f"not checked: {answer.label}"
    return f"disagrees: {answer.label}: {answer.against}: {check[worst]:.10g}, not {value[worst]:.10g}"
