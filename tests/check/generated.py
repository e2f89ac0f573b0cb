"""Models made by rule: chains, trolleys with pendulums, sliders in a row."""

from __future__ import annotations


def chain(links: int, shape: str) -> str:
    """Links that hang from each other, each with its absolute angle."""
    numbers = range(1, links + 1)
    sizes = ", ".join(f"m{i}: {i + 1} kg, l{i}: 0.{i + 3} m" for i in numbers)
    bodies = ", ".join(f"link{i}: {{shape: {shape}, length: l{i}, mass: m{i}}}" for i in numbers)
    joints = "\n".join(
        f"  p{i}: {{type: hinge, of: [{f'link{i - 1}.end' if i > 1 else 'ground.O'}, link{i}.start],"
        f" coordinate: {{name: theta{i}, absolute: true, zero: down}}}}"
        for i in numbers
    )
    start = ", ".join(f"theta{i}: 0.{i + 2}" for i in numbers)
    return f"""freebody: 1
parameters: {{{sizes}, g: 9.81 m/s^2}}
gravity: g
bodies: {{{bodies}}}
joints:
{joints}
initial: {{{start}}}
"""


def trolley(links: int) -> str:
    """A trolley with bobs on light rods, one below the other, on a slope."""
    numbers = range(1, links + 1)
    sizes = ", ".join(f"m{i}: {i + 1} kg, l{i}: 0.{i + 3} m" for i in numbers)
    bodies = "".join(f", bob{i}: {{shape: particle, mass: m{i}}}" for i in numbers)
    joints = "\n".join(
        f"  r{i}: {{type: link, of: [{f'bob{i - 1}.centre' if i > 1 else 'trolley.origin'}, bob{i}.centre], length: l{i},"
        f" coordinate: {{name: theta{i}, zero: down}}}}"
        for i in numbers
    )
    start = ", ".join(f"theta{i}: 0.{i + 2}" for i in numbers)
    return f"""freebody: 1
parameters: {{{sizes}, M: 4 kg, beta: 20 deg, F: 3 N, g: 9.81 m/s^2}}
gravity: g
bodies: {{trolley: {{mass: M}}{bodies}}}
joints:
  rail: {{type: slider, along: {{through: ground.O, angle: beta}}, line: {{through: trolley.origin, angle: 0}}, coordinate: s}}
{joints}
forces: {{pull: {{type: force, at: trolley.origin, x: F, y: 0}}}}
initial: {{s: 0, {start}}}
"""


def row(blocks: int) -> str:
    """Blocks on a rail with springs between them, the last one pushed."""
    numbers = range(1, blocks + 1)
    sizes = ", ".join(f"m{i}: {i + 1} kg, k{i}: {40 + 10 * i} N/m" for i in numbers)
    bodies = ", ".join(f"block{i}: {{mass: m{i}}}" for i in numbers)
    joints = "\n".join(
        f"  rail{i}: {{type: slider, along: {{through: ground.O, angle: 0}}, line: {{through: block{i}.origin, angle: 0}},"
        f" coordinate: x{i}}}"
        for i in numbers
    )
    springs = "\n".join(
        f"  spring{i}: {{type: spring, along: x{i}{f' - x{i - 1}' if i > 1 else ''}, stiffness: k{i}}}" for i in numbers
    )
    start = ", ".join(f"x{i}: 0.{i}" for i in numbers)
    return f"""freebody: 1
parameters: {{{sizes}, F: 3 N, g: 9.81 m/s^2}}
gravity: g
bodies: {{{bodies}}}
joints:
{joints}
forces:
{springs}
  push: {{type: force, at: block{blocks}.origin, x: F, y: 0}}
initial: {{{start}}}
"""


GENERATED = {
    **{f"chain of {n} rods": chain(n, "rod") for n in (1, 2, 3)},
    **{f"trolley with {n}": trolley(n) for n in (1, 2)},
    **{f"row of {n} blocks": row(n) for n in (2, 3)},
}
"""Models by name, in the language of model files."""
