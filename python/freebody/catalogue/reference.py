"""Independent routes for the checks: other people's integrators, and a slow one of many digits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Rates = Callable[[float, Array], Sequence[float]]


def motion(
    rates: Rates, start: Sequence[float], times: Sequence[float], kink: Callable[[float, Array], float] | None = None
) -> Array:
    """States (nt, n) at the times from t = 0, by SciPy's DOP853 at rtol 1e-13.

    Steps end on the times, and where ``kink`` changes sign; nothing is interpolated.
    """
    y, t, states = np.array(start, float), 0.0, []
    for until in times:
        while t < until:
            t, y = _advance(rates, t, y, float(until), kink)
        states.append(y)
    return np.array(states)


def event(rates: Rates, start: Sequence[float], when: Callable[[float, Array], float], before: float) -> tuple[float, Array]:
    """Time and state of the first zero of ``when``, polished by secants on freshly integrated states."""
    from scipy.integrate import solve_ivp

    near = solve_ivp(rates, (0.0, before), start, method="DOP853", rtol=1e-10, atol=1e-12, events=_ending(when))
    t = float(near.t_events[0][0])
    base = 0.9 * t
    anchor = motion(rates, start, [base])[0]

    def value(time: float) -> float:
        return when(*_advance(rates, base, anchor, time))

    old, f_old = t * (1 - 1e-5), value(t * (1 - 1e-5))
    for _ in range(8):
        f = value(t)
        if f == 0 or t == old or f == f_old:
            break
        old, f_old, t = t, f, t - f * (t - old) / (f - f_old)
    return _advance(rates, base, anchor, t)


def _ending(when: Callable[[float, Array], float]) -> Callable[[float, Array], float]:
    """An event of SciPy's that ends the integration."""
    event = partial(when)
    event.terminal = True  # type: ignore[attr-defined]
    return event


def _advance(
    rates: Rates, t: float, y: Array, until: float, kink: Callable[[float, Array], float] | None = None
) -> tuple[float, Array]:
    """Time and state at ``until``, or at the next kink if that comes first."""
    from scipy.integrate import solve_ivp

    def integrate(end: float, **more: Any) -> Any:
        solution = solve_ivp(rates, (t, end), y, method="DOP853", rtol=1e-13, atol=1e-15, **more)
        if not solution.success:
            raise ArithmeticError(f"the reference solution stops: {solution.message}")
        return solution

    if kink is None:
        return until, integrate(until).y[:, -1]
    off = min(1e-6 * until, until - t)  # a step clear of the kink just met
    y, t = integrate(t + off).y[:, -1], t + off

    solution = integrate(until, events=_ending(kink)) if t < until else None
    return (float(solution.t[-1]), solution.y[:, -1]) if solution else (t, y)


def many_digits(
    rates: Callable[[Any, list[Any]], list[Any]],
    start: Sequence[Any],
    times: Sequence[float],
    digits: int = 30,
    step: float = 0.1,
    order: int = 10,
) -> list[list[Any]]:
    """States at the times in ``digits`` decimal digits: Gragg's midpoint rule, extrapolated ``order`` times.

    Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.9. The state is a list of mpmath numbers.
    """
    import mpmath

    with mpmath.workdps(digits + 8):
        y, t, states = [mpmath.mpf(v) for v in start], mpmath.mpf(0), []
        for until in times:
            span = mpmath.mpf(until) - t
            count = max(1, int(mpmath.ceil(span / step)))
            for _ in range(count if span else 0):
                y = _extrapolate(rates, t, y, span / count, order)
                t += span / count
            states.append(list(y))
        return states


def _extrapolate(rates: Callable[[Any, list[Any]], list[Any]], t: Any, y: list[Any], step: Any, order: int) -> list[Any]:
    from mpmath import mpf

    table: list[list[Any]] = []
    for j in range(order):
        n = 2 * (j + 1)
        row = _midpoint(rates, t, y, step, n)
        for k in range(j):
            ratio = (mpf(n) / (2 * (j - k))) ** 2
            table[k], row = row, [a + (a - b) / (ratio - 1) for a, b in zip(row, table[k], strict=True)]
        table.append(row)
    return table[-1]


def _midpoint(rates: Callable[[Any, list[Any]], list[Any]], t: Any, y: list[Any], step: Any, n: int) -> list[Any]:
    h = step / n
    before, now = y, [a + h * f for a, f in zip(y, rates(t, y), strict=True)]
    for i in range(1, n):
        before, now = now, [a + 2 * h * f for a, f in zip(before, rates(t + i * h, now), strict=True)]
    return now
