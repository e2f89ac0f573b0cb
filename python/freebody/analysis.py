"""What can be asked of a mechanism once it is described: one instant, a motion, a drawing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

from freebody.core import MotionError, Settings
from freebody.model.answers import fault, numbers
from freebody.model.errors import ModelFileError, Problem
from freebody.model.start import many_turns, quantity

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.check import Verdict
    from freebody.core import CompiledModel, FreeBodies, State
    from freebody.equations.answers import Answers
    from freebody.equations.balances.minimal import MinimalForm
    from freebody.equations.balances.smallest import SmallestSet
    from freebody.equations.derivation.derive import Equations
    from freebody.equations.derivation.first_integrals import FirstIntegral
    from freebody.find import Extremes, Found, Limit
    from freebody.impact.applied_impulse import AppliedImpulse
    from freebody.impact.impacts import Impact
    from freebody.inverse import InverseDynamics
    from freebody.inverse.laws import Law
    from freebody.model.builder import Builder
    from freebody.periodic.ask import Periodic
    from freebody.run.sampling import Times
    from freebody.run.simulation import Progress, Run
    from freebody.solve.instant import Instant
    from freebody.stability.answers import Curves, Stability
    from freebody.views.diagram import Diagram


class Moving:
    """The part of ``Mechanism`` that computes."""

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
            return Instant(replace(self.compile(), notes=tuple(notes)), state, route)

    def free_bodies(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> FreeBodies:
        """Every load on every body at one instant, by default the start; ``changes`` as in ``solve``."""
        state, _ = self.moment(initial=initial, t=t, **changes)
        with self.core_errors():
            return self.compile().free_bodies(state)

    def smallest(
        self: Builder,
        wanted: str,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        known_motion: bool = False,
        **changes: Any,
    ) -> SmallestSet:
        """The fewest balance equations that give one unknown at an instant: the acceleration of a coordinate (``theta``), a
        component of a reaction (``A.Fx``), the force or torque of a motion (its name), or that of a force of the model (its
        name). Accelerations are taken as known for the last, or where ``known_motion``; ``changes`` as in ``solve``."""
        from freebody.equations.balances.smallest import smallest_set

        return smallest_set(wanted, *self._near(initial, t, changes), known_motion)

    def minimal_form(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> MinimalForm:
        """As many balance equations as degrees of freedom, without reactions where such exist; ``changes`` as in ``solve``."""
        from freebody.equations.balances.minimal import minimal_form

        return minimal_form(*self._near(initial, t, changes))

    def equations(
        self: Builder,
        form: str = "minimal",
        *,
        want: str | None = None,
        at_rest: bool = False,
        fixed: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        **changes: Any,
    ) -> Equations:
        """The symbolic equations of motion, derived: ``form`` is ``minimal``, ``brute`` or ``constraints``. Contacts are as at a
        state, by default the start; ``changes`` as in ``solve``.

        ``want`` gives the fewest equations for one unknown instead, as in ``smallest``. With ``at_rest`` all rates are 0; ``fixed``
        coordinates and parameters stand as numbers: ``fixed={"theta": "90 deg"}``."""
        from freebody.equations.derivation.derive import derive
        from freebody.solve.symbolic_state import SymbolicState

        chosen = dict(fixed or {})
        state, notes = self.moment(initial=initial, t=t, **changes, **chosen)
        with self.core_errors():
            subject = SymbolicState(self.source(notes), state, at_rest)
            if state.t > t and (moved := chosen.keys() & set(subject.names)):
                raise ValueError(f"{min(moved)} is fixed at the start, and moves until {state.t:g} s; leave it out")
            return derive(subject.with_numbers(list(chosen)), form, want)

    def solve_in_letters(self: Builder, wanted: Sequence[str] | None = None, **asked: Any) -> Answers:
        """Accelerations (``theta``) and reactions (``pivot.Fx``) symbolically near the start: the fewest balance equations, solved,
        simplified, and held against numbers. ``at_rest``, ``set={"theta": "45 deg", "m2": "m1"}``, ``limits={"m2": "inf"}``; see
        ``freebody.equations.answers.solve_in_letters``."""
        from freebody.equations.answers import solve_in_letters

        return solve_in_letters(self, wanted, **asked)

    def code(
        self: Builder, language: str = "python", initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any
    ) -> str:
        """Code of functions that compute accelerations and all reactions without this package: ``python`` (with NumPy) or ``c``
        (C99). Changed parameters become the defaults; a changed place says no more than on which branch things are. Raises
        ``CannotGenerate`` for contacts, strings, friction, laws with cases and tables; see ``freebody.codegen``."""
        from freebody.codegen.systems import program

        state, _ = self.moment(initial=initial, t=t, **changes)
        with self.core_errors():
            return program(self.source(), state, language)

    def _near(
        self: Builder, initial: Mapping[str, Any] | None, t: float, changes: Mapping[str, Any]
    ) -> tuple[list[FreeBodies], dict[str, Any]]:
        """The free bodies at a state and at others near by, and the named points."""
        from freebody.solve.perturbed_states import nearby

        state, _ = self.moment(initial=initial, t=t, **changes)
        with self.core_errors():
            return nearby(self.source(), state), self.compile().points(state.p)

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
        progress: Progress | None = None,
        t: float = 0.0,
        **settings: Any,
    ) -> Run:
        """The motion from the start to ``until`` (s, or a quantity like ``"200 ms"``) or to an event that ends it.

        ``settings`` overrule the section ``run``: ``method``, ``rtol``, ``step``, ``max_step``, ``every``, ``route``,
        ``impacts``, ``painleve``; any others are changes as in ``solve``. ``initial`` replaces the section of that name. ``t_eval``
        fixes the output times and never changes the steps. Where an event continues with another model, its run is ``next`` of this
        one.
        """
        from freebody.run.model_sequence import Stage, follow

        words = {field.name for field in fields(Settings)}
        changes = {name: settings.pop(name) for name in settings.keys() - words}
        state, notes = self.start(initial, t, **changes)
        if initial is None and not changes and self.lowered().start.equilibrium:
            self.check_equilibrium(state)
        for file in self.lowered().hand_over.values():
            self.handed(file).compile()  # what is wrong there is said before anything moves
        stage = Stage(self, self.run_plan(until, settings), settings, t_eval, progress)
        with self.core_errors():
            return follow(stage, stage.run(state, notes))

    def first_integrals(self: Builder, **changes: Any) -> list[FirstIntegral]:
        """What stays constant besides energy and momenta: momenta less what a known force gives them, and Jacobi's integral relative to
        prescribed motions; see ``freebody.equations.derivation.first_integrals``. ``changes`` as in ``solve``."""
        from freebody.equations.derivation.first_integrals import first_integrals
        from freebody.solve.symbolic_state import SymbolicState

        state, notes = self.moment(**changes)
        with self.core_errors():
            return first_integrals(SymbolicState(self.source(notes), state))

    def find(
        self: Builder, of: str, target: Any, *, vary: str, within: tuple[Any, Any], points: int = 33, **changes: Any
    ) -> Found:
        """All values of a parameter, a coordinate of the start or its ``rate(…)`` within bounds for which a quantity of the motion is the
        target: ``m.find("x(ball.G) @ lands", "12 m", vary="angle", within=("10 deg", "80 deg"))``.

        ``of`` is what a line of a report says: ``theta @ 1 s``, ``max of A.Fx over 1 s .. 2 s``, ``A.Fx @ start``, or the label of such
        a line of the model. ``points`` is the first grid; ``changes`` are those of ``simulate``, settings among them."""
        from freebody.find import Response, find

        return find(Response(self, of, vary, changes), target, within, points)

    def extremes(self: Builder, of: str, *, vary: str, within: tuple[Any, Any], points: int = 33, **changes: Any) -> Extremes:
        """The extremes of a quantity of the motion over a parameter or a value of the start, with where; see ``find``."""
        from freebody.find import Response, extremes

        return extremes(Response(self, of, vary, changes), within, points)

    def limit(
        self: Builder,
        of: str,
        *,
        until: Any = None,
        vary: str | None = None,
        towards: Any = "inf",
        begin: Any = None,
        **changes: Any,
    ) -> Limit:
        """What an expression, or ``integral of`` one, tends to as t → ∞, with an estimate of its error; or a quantity as in ``find`` as a parameter or
        value of the start goes from ``begin`` ``towards`` a value, by default infinity. See ``freebody.find``."""
        from freebody.find import RTOL, Response, limit, limit_over

        if vary is None:
            return limit(self, of, until, changes)
        end = {} if until is None else {"until": until}
        return limit_over(Response(self, of, vary, {"rtol": RTOL, **changes, **end}), begin, towards)

    def periodic(self: Builder, returns: Mapping[str, str] | Sequence[str] | None = None, **asked: Any) -> Periodic:
        """Motions that come back, with their multipliers: after a ``period`` (s, or an expression of parameters), or just after the event,
        contact or stop ``section`` next switches, within ``horizon`` (the end of the run by default).

        ``returns`` says what a motion starts with, and what that is when it comes back: ``{"omega": "-rate(wheel.angle)"}``, a parameter of
        the start, a coordinate or ``rate(coordinate)``, and an expression, which so relabels legs or spokes. A list of
        names comes back as it is; by default the independent coordinates and their rates. Other words are changes as in ``solve``."""
        from freebody.periodic.ask import periodic

        with self.core_errors():
            return periodic(self, returns, **asked)

    def stability(
        self: Builder,
        bounds: Mapping[str, tuple[Any, Any]] | None = None,
        *,
        inputs: Sequence[str] = (),
        outputs: Sequence[str] = (),
        initial: Mapping[str, Any] | None = None,
        **changes: Any,
    ) -> Stability:
        """The equilibrium near the start, or all that are found with coordinates within ``bounds``
        (``{"theta": ("-180 deg", "180 deg")}``): each with static forces, linear equations with ``inputs`` (parameters) and ``outputs``
        (expressions), modes, and whether it is stable; ``changes`` as in ``solve``. Raises ``NoEquilibrium``; see
        ``freebody.stability``."""
        from freebody.stability.answers import stability

        state, _ = self.start(initial, **changes)
        with self.core_errors():
            return stability(self, state, bounds, inputs, outputs)

    def equilibria_along(self: Builder, parameter: str, within: tuple[Any, Any], **changes: Any) -> Curves:
        """The equilibrium near the start, followed while a parameter is within a range, through folds and onto the curves that branch
        off. Raises ``NoEquilibrium``; see ``freebody.stability``."""
        from freebody.stability.answers import curves

        state, _ = self.start(**changes)
        with self.core_errors():
            return curves(self, state, parameter, within, changes)

    def inverse(
        self: Builder,
        motion: Mapping[str, Law] | Run | str | None = None,
        actuators: Sequence[str] | str = (),
        *,
        limits: Mapping[str, Any] | None = None,
        least: bool = False,
        until: float | str | None = None,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        **settings: Any,
    ) -> InverseDynamics:
        """Inverse dynamics: the forces that a motion takes, and every reaction.

        ``motion`` gives laws of time by gauge, ``{"theta": "2*pi*t"}`` (see ``freebody.inverse.quintic``, ``steady``), or a finished
        run; ``"rest"`` keeps the start as it is; by default it is what the model prescribes. ``actuators`` are the forces of the model
        that give it, each with a parameter of its own as its value; without them the motions act along their own gauges. ``limits``
        (N, N·m) are held where they can be; where the forces are not unique, ``least`` takes those of least sum of squares. ``settings``
        and changes are those of ``simulate``.

        Raises ``NotRealizable`` for a motion that cannot be had, ``Indeterminate`` for forces that are not unique."""
        from freebody.inverse.solve import inverse

        with self.core_errors():
            return inverse(self, motion, actuators, limits, least, until, initial, t, settings)

    def check_equilibrium(self: Builder, state: State) -> None:
        """Whether all stays at rest in a state while everything is in place. Raises ``ModelFileError``."""
        from freebody.solve.instant import Instant

        instant = Instant(self.compile(), state)
        if moving := instant.nonequilibrium():
            stated = ", ".join(f"`{name}` {value}" for name, value in moving.items())
            hint = "look for a load that nothing carries, or leave `equilibrium` out"
            raise self.wrong(("initial", "equilibrium"), f"the start is no equilibrium: {stated}", hint)

    def check(
        self: Builder, text: str, letters: Mapping[str, str | Sequence[str | float]] | None = None, **asked: Any
    ) -> Verdict:
        """Whether an equation, lines of them or a claim is true of every motion in which all is in place and holds as at a moment, by
        default the start, after the events there; see ``freebody.check.Checker``.

        ``letters`` are own symbols, like ``{"phi": "theta - alpha"}``; ``asked`` are ``at``, ``before``, ``after``, ``initial``, ``t``
        and changes, as in ``solve``. Raises ``StatementError``, ``ModelProblem``, and ``ValueError`` for a moment that there is not.
        """
        from freebody.check import Checker

        return Checker(self, letters, **asked).check(text)

    @contextmanager
    def core_errors(self: Builder) -> Iterator[None]:
        """Gives a ``MotionError`` about an item of the model the place ``where`` it stands."""
        try:
            yield
        except MotionError as error:
            if error.path:
                error.where = self.lowered().where(error.path)
            raise

    def drawing(self: Builder, ax: Axes | None = None, layers: Sequence[str] | None = None) -> Axes:
        """A labelled drawing of the mechanism at the start."""
        from freebody.views.draw import drawing

        state, notes = self.start()
        return drawing(self.source(notes), state, ax, layers)

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

    def source(self: Builder, notes: Sequence[str] = ()) -> CompiledModel:
        """The compiled mechanism with all that views want to know of it."""
        model = self.model.model_dump(mode="json", by_alias=True, exclude_unset=True)
        return replace(self.compile(), model=model, report=tuple(self.report_items()), notes=tuple(notes))

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
