"""The command ``stability``: where does it rest, is that stable, how does it vibrate there?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from freebody.cli.models import opened, pairs, ranges, written
from freebody.cli.options import AsJson, Changes, Model, Units
from freebody.cli.terminal import print_json
from freebody.cli.user_errors import UserError


def stability(
    model: Model,
    at: Annotated[list[str] | None, typer.Option(metavar="NAME=VALUE", help="A coordinate near the equilibrium.")] = None,
    bounds: Annotated[
        list[str] | None, typer.Option(metavar="NAME=A..B", help="All equilibria with a coordinate within these.")
    ] = None,
    along: Annotated[str | None, typer.Option(metavar="NAME=A..B", help="Follow the equilibrium as a parameter changes.")] = None,
    inputs: Annotated[list[str] | None, typer.Option("--input", metavar="PARAMETER", help="Of forces or controllers.")] = None,
    outputs: Annotated[list[str] | None, typer.Option("--output", metavar="EXPRESSION", help="What responds.")] = None,
    response: Annotated[str | None, typer.Option(metavar="A..B", help="Frequency response of outputs to inputs, Hz.")] = None,
    poles: Annotated[
        str | None, typer.Option(metavar="LIST", help="Gains of inputs for these eigenvalues, like '-1,-2+1j,-2-1j'.")
    ] = None,
    output: Annotated[Path | None, typer.Option("-o", help="The modes, drawn or as a film: {views.modes}.")] = None,
    plot: Annotated[Path | None, typer.Option(help="Draw the frequency response: {views.draw}.")] = None,
    changes: Changes = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Equilibria and their stability, modes, frequency response, gains for given poles."""
    import numpy as np
    from rich.console import Console

    from freebody.stability import modes
    from freebody.stability.answers import response_table

    mechanism, near = opened(model, changes), pairs(at)
    if plot and not (response and inputs and outputs):
        raise UserError("--plot draws a frequency response", "say --input, --output and --response A..B with it")
    if along and (bounds or inputs or outputs or response or poles or output):
        raise UserError(
            "--along follows curves and gives nothing else", "ask for the rest without it, or with --set at one value"
        )
    if along:
        ((name, within),) = ranges([along], "--along").items()
        found: Any = mechanism.equilibria_along(name, within, **near)
    else:
        found = mechanism.stability(bounds=ranges(bounds, "--bounds"), inputs=inputs or (), outputs=outputs or (), **near)
    asked: list[Any] = []
    stated = found.to_json()
    for rest, plain in () if along else zip(found, stated["equilibria"], strict=True):
        if response:
            low, high = _numbers(response.split(".."), "--response", "write two frequencies in Hz, like --response 0.1..20")
            frequencies = np.geomspace(low, high, 25)
            asked.append(response_table(rest, frequencies))
            values = modes.response(rest.space, frequencies).view(float).reshape(25, len(rest.space.outputs), -1, 2)
            plain["response"] = [
                {"frequency": f, "values": each} for f, each in zip(frequencies.tolist(), values.tolist(), strict=True)
            ]
        if poles:
            wanted = _numbers(poles.split(","), "--poles", "write as many as there are states, like --poles='-1,-2'", complex)
            found_gains = modes.gains(rest.space, wanted)
            asked.append(_gain_table(rest.space, found_gains))
            plain["gains"] = found_gains.tolist()
    made = []
    if output:
        from freebody.views.modes import draw_modes

        made += [draw_modes(rest, path) for rest, path in zip(found, _paths(output, len(found)), strict=True)]
    if plot:
        from freebody.views.modes import draw_response

        frequencies = np.geomspace(low, high, 400)
        made += [draw_response(rest, frequencies, path) for rest, path in zip(found, _paths(plot, len(found)), strict=True)]
    if as_json:
        print_json(stated | {"files": [str(path) for path in made]} if made else stated)
        return
    Console().print(found, *asked)
    written(*made)


def _paths(path: Path, count: int) -> list[Path]:
    """One file for each equilibrium."""
    return [path] if count == 1 else [path.with_name(f"{path.stem}-{i}{path.suffix}") for i in range(1, count + 1)]


def _numbers(texts: list[str], option: str, hint: str, kind: type = float) -> list[Any]:
    try:
        found = [kind(text.strip().replace("i", "j") if kind is complex else text) for text in texts]
    except ValueError:
        raise UserError(f"{option} {','.join(texts)}: these are no numbers", hint) from None
    if kind is float and not (len(found) == 2 and 0 < found[0] < found[1]):
        raise UserError(f"{option} {'..'.join(texts)}: from which to which frequency?", hint)
    return found


def _gain_table(space: Any, found: Any) -> Any:
    from freebody.solve.rich_tables import table

    rows = [(name, *row) for name, row in zip(space.inputs, found.tolist(), strict=True)]
    return table("gains: input = Σ gain × state, SI", ["input", *space.states], rows, space.states)
