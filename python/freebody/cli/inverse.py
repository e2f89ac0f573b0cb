"""``freebody inverse``: the forces that a motion takes."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from freebody.cli.models import opened, pairs, written
from freebody.cli.options import AsJson, Changes, Model, Units, Until
from freebody.cli.terminal import print_json
from freebody.cli.user_errors import UserError

if TYPE_CHECKING:
    from freebody.inverse import InverseDynamics

_SPANS = 3  # of a limit that is passed, at most so many are named


def inverse(
    model: Model,
    motion: Annotated[
        list[str] | None, typer.Option(metavar="GAUGE=LAW", help="Its place as a law of t, like 'theta=2*pi*t'; repeatable.")
    ] = None,
    speed: Annotated[
        list[str] | None, typer.Option(metavar="GAUGE=SPEED", help="A constant speed, 'theta=20 rad/s'; repeatable.")
    ] = None,
    record: Annotated[
        list[str] | None,
        typer.Option(metavar="GAUGE=FILE:COLUMN", help="Its place as recorded over the column t of a CSV file; repeatable."),
    ] = None,
    rest: Annotated[bool, typer.Option("--rest", help="The start stays at rest.")] = False,
    actuator: Annotated[
        list[str] | None, typer.Option(metavar="FORCE", help="A force of the model that gives the motion; repeatable.")
    ] = None,
    limit: Annotated[
        list[str] | None, typer.Option(metavar="FORCE=LIMIT", help="The largest size of an actuator; repeatable.")
    ] = None,
    least: Annotated[bool, typer.Option("--least", help="Where forces are not unique, those of least sum of squares.")] = False,
    changes: Changes = None,
    until: Until = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="All curves: {inverse.result}.")] = None,
    plot: Annotated[
        Path | None, typer.Option(help="A picture: forces over angle and time, polar load diagrams; .png, .svg, .pdf.")
    ] = None,
    axes: Annotated[str, typer.Option(metavar="BODY", help="Along whose axes the polar load diagrams are.")] = "ground",
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Inverse dynamics: torques and forces that a motion takes, and every reaction; by default of the motions of the model."""
    from freebody.inverse import recorded, steady

    laws: dict[str, Any] = {**pairs(motion), **{gauge: steady(value) for gauge, value in pairs(speed).items()}}
    for gauge, source in pairs(record).items():
        file, colon, column = source.rpartition(":")
        if not colon:
            raise UserError(f"--record {gauge}={source}: which column?", f"write it like --record '{gauge}={source}:{gauge}'")
        laws[gauge] = recorded(file, column)
    given = "rest" if rest else laws or None
    found = opened(model, changes).inverse(given, actuator or (), limits=pairs(limit), least=least, until=until)
    made = [found.save(output)] if output else []
    if plot:
        from freebody.views.inverse import save

        made.append(save(found, plot, axes, ", ".join([found.name, *(change.replace("=", " = ") for change in changes or [])])))
    if as_json:
        print_json(data(found) | {"files": [str(path) for path in made]})
        return
    show(found)
    written(*made)


def data(found: InverseDynamics) -> dict[str, Any]:
    """The figures as plain data, SI."""
    motors = {
        name: {"unit": motor.unit, "force": asdict(found.summary(motor.force)), "power": asdict(found.summary(motor.power)),
               "work": found.work(name)}
        for name, motor in found.motors.items()
    }  # fmt: skip
    pins = {name: found.greatest(f"{name}.F") for name in found.pins}
    force, moment = found.greatest_shaking
    return {
        "name": found.name,
        "span": [float(found.run.edges[0]), float(found.run.edges[-1])],
        "gauge": found.gauge,
        "motors": motors,
        "pins": {name: place and asdict(place) for name, place in pins.items()},
        "shaking": {"force": asdict(force), "moment": asdict(moment), "moment_about": "ground.O"},
        "beyond_limits": found.beyond,
        "free": found.free_combinations,
        "error": found.error,
    }


def show(found: InverseDynamics) -> None:
    """The figures as tables."""
    from freebody.cli.show import put
    from freebody.solve.figures import figure
    from freebody.solve.rich_tables import table
    from freebody.views.plots import pretty_unit

    angle = f"{found.gauge} [{found.run.unit_of(found.gauge)}]"
    forces, extremes, zeros = [], [], []
    for name, motor in found.motors.items():
        unit, summary = pretty_unit(motor.unit), found.summary(motor.force)
        power = found.summary(motor.power)
        peak = max(abs(power.greatest.value), abs(power.least.value))
        forces.append((name, unit, summary.mean, summary.rms, peak, found.work(name)))
        named = [("greatest", summary.greatest), ("least", summary.least)]
        extremes += [
            (name if i == 0 else "", word, place.value, unit, place.t, place.angle) for i, (word, place) in enumerate(named)
        ]
        zeros += [(name if i == 0 else "", place.t, place.angle) for i, place in enumerate(summary.zeros)]
    pins = [(name, found.greatest(f"{name}.F")) for name in found.pins]
    stated = [(name, *((place.value, place.t, place.angle) if place else (float("nan"), None, None))) for name, place in pins]
    shaking = [
        (word, place.value, unit, place.t, place.angle)
        for (word, unit), place in zip((("force", "N"), ("moment about ground.O", "N·m")), found.greatest_shaking, strict=True)
    ]
    start, end = found.run.edges[[0, -1]]
    put(
        f"{found.name}: what the motion takes, from t = {figure(start)} s to {figure(end)} s\n",
        table("motors", ["", "unit", "mean", "rms", "largest power [W]", "work [J]"], forces),
        table("extremes", ["", "", "value", "unit", "t [s]", angle], extremes),
        table("zero crossings", ["", "t [s]", angle], zeros),
        table("largest pin loads", ["", "force [N]", "t [s]", angle], stated),
        table("largest on the ground", ["", "value", "unit", "t [s]", angle], shaking),
        *(f"{name} passes its limit {_spans(spans)}" for name, spans in found.beyond.items()),
        *(
            f"not unique: any multiple of {way} can be added; these are of least sum of squares"
            for way in found.free_combinations
        ),
        f"verified: {found.verified}",
    )


def _spans(spans: list[tuple[float, float]]) -> str:
    named = ", ".join(f"from {a:.4g} s to {b:.4g} s" for a, b in spans[:_SPANS])
    return named + (f" and {len(spans) - _SPANS} times more" if len(spans) > _SPANS else "")
