"""What a stiff machine costs as its stiffness grows: radau beside dop853, and beside SciPy's Radau on the same equations.

The slider-crank of GEN-MODES whose rod bends ever less, for a turn of 20 rad/s, started straight: the bending vibrates. By how
much it is damped in a period stays (a tenth of critical), so that the motion has the same shape. SciPy integrates Lagrange's equations
by hand of its questions.
"""

from math import pi, radians, sqrt, tau
from pathlib import Path
from runpy import run_path
from time import perf_counter

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.integrate import solve_ivp

import freebody as fb

FOLDER = Path(fb.__file__).parent / "systems/GEN-MODES-vibrating-slider-crank"
SPEED, K_SHAFT, C = 20.0, 500.0, 1.0
RTOL = 1e-8
SHIELDED = 1e-3  # kg m², what about bends with the rod: it makes the damping a tenth of critical


def simulated(method: str, **parameters: float) -> tuple[fb.Run, float]:
    """The run, and how long it took, s."""
    machine = fb.Mechanism.load(FOLDER / "model.yaml")
    machine.parameters.update(w=SPEED, c=C, **parameters)
    machine.compile()
    began = perf_counter()
    run = machine.simulate(until=tau / SPEED, method=method, rtol=RTOL)
    return run, perf_counter() - began


def main() -> None:
    mechanics = run_path(str(FOLDER / "questions.py"))["mechanics"]
    table = Table("stiffness [N·m/rad]", "radau [evaluations]", "dop853 / radau", "in time", "SciPy's Radau / radau", "apart")
    table.title = f"a turn at rtol {RTOL:g}"
    for k_rod in (2e4, 2e6, 2e8):
        c_rod = 0.2 * sqrt(k_rod * SHIELDED)
        ours, time = simulated("radau", k_rod=k_rod, c_rod=c_rod)
        explicit, explicit_time = simulated("dop853", k_rod=k_rod, c_rod=c_rod)

        def rates(t: float, y: np.ndarray, k_rod: float = k_rod, c_rod: float = c_rod) -> list[float]:
            moved, taken = mechanics(y[0], y[1], y[2:])
            twist, slip = pi / 3 + SPEED * t - y[0], SPEED - y[2]
            return [*y[2:], *np.linalg.solve(moved, np.array([K_SHAFT * twist + C * slip, -k_rod * y[1] - c_rod * y[3]]) - taken)]

        begin, floor = [radians(60), 0, SPEED, 0], RTOL * 1e-6 * np.array([1, 1, SPEED, SPEED])
        theirs = solve_ivp(rates, (0, tau / SPEED), begin, method="Radau", rtol=RTOL, atol=floor)
        count = ours.stats["evaluations"]
        apart = abs(ours.evaluate("theta", [tau / SPEED])[0] - theirs.y[0, -1])
        ratios = [explicit.stats["evaluations"] / count, explicit_time / time, theirs.nfev / count]
        table.add_row(f"{k_rod:.0e}", str(count), *(f"{ratio:.1f}" for ratio in ratios), f"{apart:.0e} rad")
    Console().print(table)


if __name__ == "__main__":
    main()
