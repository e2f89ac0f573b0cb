"""What can be asked of a mechanism once it is described: one instant, a motion, impacts, drawings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

from freebody.core import Evaluator, ModelError, MotionError, Settings
from freebody.model.answers import fault, numbers
from freebody.model.errors import ModelFileError, Problem
from freebody.model.start import many_turns, quantity

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

    from freebody.core import FreeBodies, State
    from freebody.impact.applied_impulse import AppliedImpulse
    from freebody.impact.impacts import Impact
    from freebody.model.builder import Builder
    from freebody.run.batch import Given
    from freebody.run.progress import Progress
    from freebody.run.reference import Reference
    from freebody.run.sampling import Times
    from freebody.run.simulation import Run
    from freebody.solve.instant import Instant
    from freebody.views.diagram import Diagram


_SETTINGS = {field.name for field in fields(Settings)}


class Placing:
    """What gives errors of the core a place in a model."""

    __slots__ = ("mechanism",)

    def __init__(self, mechanism: Builder) -> None:
        self.mechanism = mechanism

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if isinstance(error, MotionError) and error.path:
            error.where = self.mechanism.lowered().where(error.path)


class Moving:
    """The part of ``Mechanism`` that solves, simulates and draws it."""

    def start(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> tuple[State, list[str]]:
        """The assembled state that ``initial`` describes (the model's own by default), with ``changes`` in the same words,
        and what is worth saying about the assembly. Raises ``ModelFileError`` and ``MotionError``."""
        given = self.initial_state(changes, initial)
        p, turns = given.pop("p"), many_turns(self.lowered().start, initial, changes)
        with self.core_errors():
            state, notes = self.compile().assemble(p, t, **given)
        return state, [*turns, *notes]

    def moment(
        self: Builder,
        at: float | str | None = None,
        *,
        before: str | None = None,
        after: str | None = None,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        **changes: Any,
    ) -> tuple[State, list[str]]:
        """A state of the motion from ``start``, and what is worth saying about that: at a time ``at`` (s, or ``"200 ms"``), after
        what happens then; just ``before`` or ``after`` the first event or mode change of a name (``"start"``: what happens there);
        by default at the start, after the events there. Raises ``ValueError`` for what the motion does not reach."""
        from freebody.run.moments import state_of

        state, notes = self.start(initial, t, **changes)
        with self.core_errors():
            return state_of(self, state, self.source(), at, before, after), notes

    def solve(
        self: Builder, route: str = "minimal", initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any
    ) -> Instant:
        """Accelerations and every reaction at one instant, by default the start, after the events there.

        ``changes`` are coordinates or parameters (``phi2="90 deg"``), or the words of ``initial`` (``rates={"phi1": 2}``); ``at``,
        ``before`` and ``after`` are those of ``moment``. ``route`` is ``minimal``, ``newton_euler`` or ``constraints``.
        """
        from freebody.solve.instant import Instant

        state, notes = self.moment(initial=initial, t=t, **changes)
        with self.core_errors():
            return Instant(self.compile().with_notes(notes), state, route)

    def evaluator(self: Builder, **parameters: Any) -> Evaluator:
        """What gives accelerations and all reactions at one state after another, as arrays and with nothing made in between: for
        inner loops. ``at = m.evaluator(); a, r = at(q, u)`` has as many numbers as ``at.coordinates`` and ``at.reactions`` have names;
        see ``freebody.core.Evaluator``."""
        p = self.initial_state(parameters)["p"]
        return Evaluator(self.compile().spec, p)

    def free_bodies(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> FreeBodies:
        """Every load on every body at one instant, by default the start; ``changes`` as in ``solve``."""
        state, _ = self.moment(initial=initial, t=t, **changes)
        with self.core_errors():
            return self.compile().free_bodies(state)

    def opening(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> Run | None:
        """A moment of motion from ``start``: at its start the events there have happened (``changes``, ``instant``); None where the
        model has no such event."""
        from freebody.run.moments import opening

        state, notes = self.start(initial, t, **changes)
        with self.core_errors():
            return opening(self, state, self.source(notes))

    def simulate(
        self: Builder,
        until: float | str | None = None,
        *,
        initial: Mapping[str, Any] | None = None,
        t_eval: Times | None = None,
        progress: Progress | bool | None = None,
        t: float = 0.0,
        **settings: Any,
    ) -> Run:
        """The motion from the start to ``until`` (s, or a quantity like ``"200 ms"``) or to an event that ends it.

        ``settings`` overrule the section ``run``: ``method``, ``rtol``, ``step``, ``max_step``, ``every``, ``route``,
        ``impacts``, ``painleve``; any others are changes as in ``solve``. ``initial`` replaces the section of that name, but for
        what is guessed and the branch. ``t_eval`` fixes the output times and never changes the steps. ``progress=True`` shows a bar
        (tqdm); a function is told the time reached (s), and ends the run by returning False. Where an event continues with
        another model, its run is ``next`` of this one.
        """
        from freebody.run.model_sequence import Stage, follow

        changes = {name: settings.pop(name) for name in settings.keys() - _SETTINGS}
        state, notes = self.start(initial, t, **changes)
        if initial is None and not changes and self.lowered().start.equilibrium:
            self.check_equilibrium(state)
        for file in self.lowered().hand_over.values():
            self.handed(file).compile()  # what is wrong there is said before anything moves
        stage = Stage(self, self.run_plan(until, settings), settings, t_eval, progress)
        with self.core_errors():
            return follow(stage, stage.run(state, notes))

    def reference(
        self: Builder,
        until: float | str | None = None,
        *,
        initial: Mapping[str, Any] | None = None,
        t_eval: Times | None = None,
        digits: int = 25,
        t: float = 0.0,
        **changes: Any,
    ) -> Reference:
        """Coordinates and their rates to 25 digits and more, as a reference for other programs: by Taylor series over pairs of doubles.

        At the times ``t_eval`` (s), by default 101 until ``until``; ``changes`` as in ``simulate``. The numbers of the model and of its start are
        taken for exactly the doubles that they are. The motion is followed twice, by other steps; ``ValueError`` where they agree to fewer than
        ``digits``. Trees whose laws have no branches, without events; ``MotionError`` else.
        """
        from freebody.run.reference import evenly, reference

        state, _ = self.start(initial, t, **changes)
        times = evenly(state.t, self.run_plan(until, {}).until) if t_eval is None else [float(time) for time in t_eval]
        with self.core_errors():
            return reference(self.compile(), state, times, digits)

    def batch(
        self: Builder,
        q0: Given | None = None,
        u0: Given | None = None,
        p: Mapping[str, Any] | None = None,
        until: float | str | None = None,
        *,
        t_eval: Times | None = None,
        threads: int | None = None,
        reactions: bool = False,
        t: float = 0.0,
        **settings: Any,
    ) -> xarray.Dataset:
        """Many motions, each as ``simulate`` makes it: with its own coordinates ``q0`` and rates ``u0`` at the start, and its own
        parameters ``p``.

        Each of the three is by name an array (members,) in SI, or one value for all, which may be a quantity; ``q0`` and ``u0`` may be arrays
        (members, n) in the order of the coordinates. What they do not name is as in the model. ``settings`` are those of ``simulate``.
        The answer, an ``xarray.Dataset``, holds ``q`` and ``u`` (member, time, coordinate) at the times ``t_eval`` or ``every``, by default
        101 of them, and of each member ``outcome``, ``ok``, ``end`` (s) and ``sentence``; what comes after the end of a motion is NaN.
        With ``reactions=True`` it holds ``accelerations`` (member, time, coordinate) and ``reactions`` (member, time, reaction), too, by the
        names that ``evaluator`` gives them: ``"pivot.Fx"``. They are solved again at each of these times, and NaN where indeterminate.

        Trees, and small loops by the default method, are carried side by side where nothing happens; all else is made motion by motion. Both
        run on all ``threads``, and have the same bits on any number of them, in any order. Raises ``ModelFileError`` for arrays that do not fit
        together, and ``MotionError`` for a member that has no start.
        """
        from freebody.run.batch import Members, batch

        words = {field.name for field in fields(Settings)}
        changes = {name: settings.pop(name) for name in settings.keys() - words}
        with self.core_errors():
            return batch(Members(self, q0, u0, p, changes), self.run_plan(until, settings), t, t_eval, threads, reactions)

    def check_equilibrium(self: Builder, state: State) -> None:
        """Whether all stays at rest in a state while everything is in place. Raises ``ModelFileError``."""
        from freebody.solve.instant import Instant

        instant = Instant(self.compile(), state)
        if moving := instant.nonequilibrium():
            stated = ", ".join(f"`{name}` {value}" for name, value in moving.items())
            hint = "look for a load that nothing carries, or leave `equilibrium` out"
            raise self.wrong(("initial", "equilibrium"), f"the start is no equilibrium: {stated}", hint)

    def core_errors(self: Builder) -> Placing:
        """Gives a ``MotionError`` about an item of the model the place ``where`` it stands."""
        return Placing(self)

    def drawing(self: Builder, ax: Axes | None = None, layers: Sequence[str] | None = None) -> Axes:
        """A labelled drawing of the mechanism at the start."""
        from freebody.views.draw import drawing

        state, notes = self.start()
        return drawing(self.source(notes), state, ax, layers)

    def _repr_html_(self: Builder) -> str | None:
        """For a notebook, the mechanism at its start with its coordinates; None as long as it has no body or no start."""
        from freebody.views.diagram.configuration import Configuration

        if not self.model.bodies:
            return None
        try:
            state, notes = self.start()
            return Configuration(self.source(notes), state).inline()
        except (ModelError, ModelFileError, MotionError):
            return None

    def diagram(
        self: Builder,
        of: str | Sequence[str] | None = None,
        at: float | str | None = None,
        *,
        to_scale: bool = False,
        effective: bool = True,
        column: float = 160.0,
        initial: Mapping[str, Any] | None = None,
        **changes: Any,
    ) -> Diagram:
        """Free-body diagrams: symbolic, with symbols in their positive sense, or ``to_scale``, with what acts.

        ``of`` is a body, a group cut free together (``"crank+coupler"``), ``"all"``, or a list of these; by default each body
        by itself. Drawn is the moment that ``at``, ``before`` and ``after`` name, by default the start, with ``changes``, as in
        ``solve``.
        ``effective`` draws m a and I α beside. ``column`` is the width of the text in which it will stand, mm: the drawings are
        made for it, letters keep their size. Raises ``ValueError`` for a body that is none, for a time that the motion does not
        reach and for a column that is too narrow.
        """
        from freebody.views.diagram import diagram, groups, points

        state, _ = self.moment(at, initial=initial, **changes)
        with self.core_errors():
            free = self.compile().free_bodies(state)
        return diagram(self.source(), state, free, groups(of, free), to_scale, effective, points(column))

    def blow(self: Builder, number: int = 1, *, of: str | None = None, at: float | str | None = None) -> Impact:
        """The impact of a ``number``, from 1, in the run of the model: of all, of those of one contact, string or stop, or of those
        from a time on (s, or ``"200 ms"``). Raises ``NoImpact``."""
        from freebody.impact.impacts import find

        return find(self.simulate(), number, of=of, after=None if at is None else quantity("at", at, "s"))

    def strike(self: Builder, point: str, direction: Any = 0, impulse: Any = 1.0, *, frame: str = "fixed") -> AppliedImpulse:
        """What an ``impulse`` (N·s) at a named point does to the model, which stands still as at its start; see
        ``freebody.impact.applied_impulse.strike``."""
        from freebody.impact.applied_impulse import strike

        return strike(self, self.start()[0], point, direction, impulse, frame)

    def impulse_diagram(
        self: Builder,
        of: str | Sequence[str] | None = None,
        number: int = 1,
        *,
        at: float | str | None = None,
        to_scale: bool = False,
        effective: bool = True,
        column: float = 160.0,
    ) -> Diagram:
        """Impulse diagrams of an impact, chosen as in ``blow`` by ``number`` and ``at``; all else as in ``diagram``, with m Δv and I Δω
        in place of m a and I α."""
        from freebody.views.diagram import groups, points
        from freebody.views.diagram.impulses import impulse_diagram

        found = self.blow(number, at=at)
        return impulse_diagram(found, groups(of, found.impulses), to_scale, effective, points(column))

    def run_plan(self: Builder, until: float | str | None, overrules: Mapping[str, Any]) -> Any:
        """The section ``run`` as numbers, overruled where asked. Raises ``ModelFileError`` when the run has no end."""
        asked = self.run_numbers()
        end = asked.until if until is None else quantity("until", until, "s")
        if end is None:
            hint = "add `run: {until: 5 s}` to the model, or say until=5 (--until 5)"
            raise ModelFileError([Problem(self.lowered().where("run"), "the run has no end", hint)])
        settings = replace(asked, until=end, **numbers(overrules, {}))
        if wrong := fault(settings):
            raise self.error(("run", wrong[0]), *wrong[1:])
        return settings
