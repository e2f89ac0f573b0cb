"""The command line. Every command imports what it needs itself, so that ``--help`` is quick."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal, get_args

import typer

from freebody.cli.check import check
from freebody.cli.code import code
from freebody.cli.equations import equations
from freebody.cli.find import find
from freebody.cli.inverse import inverse
from freebody.cli.models import figures_of, how_far, leading_to, moment, obtained, opened, simulated, time_of, written
from freebody.cli.options import After, AsJson, At, Before, Changes, Command, Model, Units, Until
from freebody.cli.periodic import periodic
from freebody.cli.stability import stability
from freebody.cli.systems import systems
from freebody.cli.terminal import print_json
from freebody.cli.user_errors import NOT_TRUE, Guarded, UserError
from freebody.formats import check_writable, replacing

app = typer.Typer(
    cls=Guarded,
    help="Planar multibody dynamics, from the free-body diagram to the motion.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


Route = Literal["minimal", "newton_euler", "constraints", "all"]
Axes = Literal["fixed", "joint"]
Method = Annotated[str | None, typer.Option(help="Integrator, like dop853; a wrong word lists them all.")]
Rtol = Annotated[float | None, typer.Option(help="Relative tolerance.")]


@app.command(cls=Command)
def run(
    model: Model,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Save the run: {run.storage}.")] = None,
    column: Annotated[
        list[str] | None,
        typer.Option(
            metavar="EXPRESSION", help="Only this into -o, as {run.selection}: A.F, x(P), a point or a column; repeatable."
        ),
    ] = None,
    changes: Changes = None,
    until: Until = None,
    method: Method = None,
    rtol: Rtol = None,
    report: Annotated[Path | None, typer.Option(help="Where the HTML report goes; default MODEL.html here.")] = None,
    no_report: Annotated[bool, typer.Option("--no-report", help="Write no HTML report.")] = False,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Simulate; print what happened and write a report. A model that it continues with follows, with files of its own."""
    from freebody.cli import show

    page = report or Path(f"{model.stem}.html")
    if page.suffix.lower() not in ("", ".html", ".htm"):
        raise UserError(f"a report is .html, not {page.suffix!r}", f"write e.g. `--report {page.with_suffix('.html')}`")
    if column and not output:
        raise UserError("--column says what a table holds, and there is none", "add e.g. `-o table.csv`")
    if not no_report:
        check_writable(page)
    runs = [simulated(model, changes, until=until, method=method, rtol=rtol)]
    while (after := runs[-1].next) is not None:
        runs.append(after)
    files: list[list[Path]] = []
    for stage, each in enumerate(runs, 1):
        if not as_json:
            show.run(each)
        ending = f"-{stage}" if stage > 1 else ""  # the files of a model that it continues with have their number in the name
        files.append([each.save(output.with_stem(output.stem + ending), *(column or ()))] if output else [])
        if not no_report:
            from freebody.views.report import write_report

            files[-1].append(write_report(each, page.with_stem(page.stem + ending)))
        if not as_json:
            written(*files[-1])
    if as_json:
        show.runs_as_json(runs, files)
    if not all(each.outcome.ok for each in runs):
        raise typer.Exit(NOT_TRUE)


@app.command(cls=Command)
def solve(
    model: Model,
    at: At = None,
    before: Before = None,
    after: After = None,
    changes: Changes = None,
    route: Annotated[Route, typer.Option(help="How to solve; all compares the three.")] = "minimal",
    axes: Annotated[Axes, typer.Option(help="Reactions along fixed axes or along and across each joint.")] = "fixed",
    balance: Annotated[bool, typer.Option("--balance", help="The residual of each body's momentum balance.")] = False,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Accelerations and all reactions at one instant, by default the start, before and after the events there."""
    from freebody.cli import show

    mechanism, asked = opened(model, changes), moment(at, before, after)
    timed = {"at", "before", "after"} & asked.keys()
    opening = None if timed else mechanism.opening(**asked)
    routes = [each for each in get_args(Route) if each != "all"] if route == "all" else [route]
    solved = [mechanism.solve(route=name, **asked | ({"before": "start"} if opening else {})) for name in routes]
    show.instants(solved, opening, leading_to(mechanism, time_of(mechanism, asked)), axes == "joint", balance, as_json)


@app.command(cls=Command)
def validate(
    model: Model,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Labelled drawing: {views.draw}.")] = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """Say what is modelled, ignored and assumed; draw the labelled mechanism."""
    from freebody.cli import show

    mechanism = opened(model)
    show.mechanism(mechanism.solve(), as_json)
    if output:
        with replacing(output) as beside:
            mechanism.drawing().figure.savefig(beside)
        if not as_json:
            written(output)


@app.command(cls=Command)
def diagram(
    model: Model,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="The picture: {views.diagram.picture}; fbd.svg by default.")
    ] = None,
    of: Annotated[
        list[str] | None, typer.Option(metavar="BODIES", help="A body, a group like crank+rod, or all; repeatable.")
    ] = None,
    at: At = None,
    before: Before = None,
    after: After = None,
    changes: Changes = None,
    to_scale: Annotated[bool, typer.Option("--to-scale", help="What acts at the instant, with a scale of forces.")] = False,
    effective: Annotated[bool, typer.Option("--effective/--no-effective", help="Draw m a and I alpha beside.")] = True,
    column: Annotated[float, typer.Option(metavar="MM", help="Width of the text in which it will stand.")] = 160.0,
    impact: Annotated[
        int | None,
        typer.Option(metavar="NUMBER", help="Impulses during this impact of the run, from 1; --at TIME counts from then."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Draw free-body diagrams, by default of every body by itself; or impulse diagrams of an impact."""
    asked, mechanism = moment(at, before, after), opened(model, changes)
    if impact is None:
        t, drawn = (
            time_of(mechanism, asked),
            mechanism.diagram(of, to_scale=to_scale, effective=effective, column=column, **asked),
        )
    elif asked.keys() - {"at"}:
        raise UserError(
            "--impact is of the run: --at takes a time, and --before and --after are not for it", "change the start in the model"
        )
    else:
        t = mechanism.blow(impact, **asked).change.t
        drawn = mechanism.impulse_diagram(of, impact, to_scale=to_scale, effective=effective, column=column, **asked)
    known = leading_to(mechanism, t)
    if as_json:
        print_json([cut | ({"digits": known.to_json()} if known else {}) for cut in drawn.data])
    if output or not as_json:
        saved = (drawn.with_remark(how_far(known), figures_of(known)) if known else drawn).save(output or Path("fbd.svg"))
        if not as_json:
            written(saved)


@app.command(cls=Command)
def certify(
    model: Model,
    changes: Changes = None,
    until: Until = None,
    method: Method = None,
    rtol: Rtol = None,
    digits: Annotated[int, typer.Option(metavar="NUMBER", min=1, max=15, help="How many digits each route must agree to.")] = 5,
    as_json: AsJson = False,
) -> None:
    """Find the motion again by independent routes, and say to how many digits they agree and which link is the weakest."""
    from freebody.cli import show
    from freebody.run.certificate import Certificate

    certificate = Certificate(simulated(model, changes, until=until, method=method, rtol=rtol))
    show.certificate(certificate, digits, as_json)
    if certificate.weakest.digits < digits:
        raise typer.Exit(NOT_TRUE)


@app.command(cls=Command)
def animate(
    model: Model,
    output: Annotated[
        Path, typer.Option("-o", "--output", help="{views.animate}; an .mp4 needs ffmpeg, .svg is one file a frame.")
    ],
    changes: Changes = None,
    until: Until = None,
) -> None:
    """Simulate and write the motion as a film."""
    from freebody.views.animate import animate as film

    written(film(simulated(model, changes, until=until), output))


@app.command(cls=Command)
def compare(
    a: Annotated[Path, typer.Argument(metavar="A", help="A saved run ({run.storage}) or a model.")],
    b: Annotated[Path, typer.Argument(metavar="B", help="Another.")],
    report: Annotated[
        Path | None, typer.Option(help="An HTML report of the first with the curves of the second over it.")
    ] = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """How far two runs lie apart, column by column."""
    from freebody.cli import show
    from freebody.views.compare import compare as compared

    if report:
        check_writable(report)
    first, second = obtained(a), obtained(b)
    show.comparison(compared(first, second), as_json)
    if report:
        from freebody.views.report import write_report

        made = write_report(first, report, {b.stem if b.stem != a.stem else "the second": second})
        if not as_json:
            written(made)


app.command()(systems)
app.command(cls=Command)(equations)
app.command(cls=Command)(code)
app.command()(find)
app.command()(periodic)
app.command(cls=Command)(stability)
app.command()(check)
app.command(cls=Command)(inverse)


@app.command(cls=Command)
def schema() -> None:
    """Print the JSON Schema of the model file."""
    from freebody.model.schema import schema as model_schema

    print_json(model_schema())


@app.command(cls=Command)
def version() -> None:
    """Print the version."""
    from importlib.metadata import version as installed

    print(installed("freebody"))
