"""What can be found out about a mechanism: its equations, values that meet a target, periodic motions, stability, inverse dynamics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from freebody.check import Verdict
    from freebody.core import FreeBodies
    from freebody.equations.answers import Answers
    from freebody.equations.balances.minimal import MinimalForm
    from freebody.equations.balances.smallest import SmallestSet
    from freebody.equations.derivation.derive import Equations
    from freebody.equations.derivation.first_integrals import FirstIntegral
    from freebody.equations.topics.frame import PointMotion
    from freebody.find import Extremes, Found, Limit
    from freebody.inverse import InverseDynamics
    from freebody.inverse.laws import Law
    from freebody.model.builder import Builder
    from freebody.periodic.ask import Periodic
    from freebody.run.simulation import Run
    from freebody.stability.answers import Curves, Stability


class Analysis:
    """The part of ``Mechanism`` that derives and finds; words that are not explained are those of ``Moving``."""

    def smallest(
        self: Builder,
        wanted: str,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        known_motion: bool = False,
        about: Sequence[str] = (),
        **changes: Any,
    ) -> SmallestSet:
        """The fewest balance equations that give one unknown at an instant: the acceleration of a coordinate (``theta``), a
        component of a reaction (``A.Fx``), the force or torque of a motion (its name), or that of a force of the model (its
        name). Accelerations are taken as known for the last, or where ``known_motion``. ``about`` are the points and directions to be
        taken, ``["B", "B", "x"]``, one for each equation; ``changes`` as in ``solve``."""
        from freebody.equations.balances.smallest import smallest_set

        return smallest_set(wanted, *self._near(initial, t, changes), known_motion, about)

    def minimal_form(self: Builder, initial: Mapping[str, Any] | None = None, t: float = 0.0, **changes: Any) -> MinimalForm:
        """As many balance equations as degrees of freedom, without reactions where such exist; ``changes`` as in ``solve``."""
        from freebody.equations.balances.minimal import minimal_form

        return minimal_form(*self._near(initial, t, changes))

    def equations(
        self: Builder,
        form: str = "minimal",
        *,
        want: str | None = None,
        about: Sequence[str] = (),
        at_rest: bool = False,
        fixed: Mapping[str, Any] | None = None,
        of: str | None = None,
        frame: Sequence[str] | str | None = None,
        long: bool = False,
        limits: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        t: float = 0.0,
        **changes: Any,
    ) -> Equations | PointMotion:
        """The symbolic equations of motion, derived: ``form`` is ``minimal``, ``brute``, ``constraints`` or ``first-order``. Contacts
        are as at a state, by default the start; ``changes`` as in ``solve``.

        ``want`` gives the fewest equations for one unknown instead, or those ``about`` some points, as in ``smallest``. With
        ``at_rest`` all rates are 0; ``fixed`` coordinates and parameters stand as numbers: ``fixed={"theta": "90 deg"}``. What is
        printed is a page, or, ``long``, also positions and velocities, every load by itself, matrices, and what is conserved; behind it
        what is left of each equation in ``limits``, ``{"m2": "inf", "l": 0}``.

        ``of`` gives position, velocity and acceleration of a point (``rod.B``) instead, through the ``frame`` of a body, or by a chain
        of bodies, each seen from the one before; by default the chain that leads to it. Every term has its name, and its value."""
        from freebody.equations.derivation.derive import derive
        from freebody.equations.topics import topic
        from freebody.solve.symbolic_state import SymbolicState

        chosen = dict(fixed or {})
        state, notes = self.moment(initial=initial, t=t, **changes, **chosen)
        with self.core_errors():
            if of or frame:
                if form != "minimal" or want or at_rest or chosen or limits:
                    raise ValueError("of and frame are not for form, want, at_rest, fixed and limits; leave these out")
                return topic(self, "frame", state, point=of, body=frame)
            subject = SymbolicState(self.source(notes), state, at_rest)
            if state.t > t and (moved := chosen.keys() & set(subject.names)):
                raise ValueError(f"{min(moved)} is fixed at the start, and moves until {state.t:g} s; leave it out")
            return derive(subject.with_numbers(list(chosen)), form, want, about, long, limits)

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

    def first_integrals(self: Builder, **changes: Any) -> list[FirstIntegral]:
        """What stays constant besides energy and momenta: momenta less what a known force gives them, and Jacobi's integral relative to
        prescribed motions; see ``freebody.equations.derivation.first_integrals``. ``changes`` as in ``solve``."""
        from freebody.equations.derivation.first_integrals import first_integrals
        from freebody.solve.symbolic_state import SymbolicState

        state, notes = self.moment(**changes)
        with self.core_errors():
            return first_integrals(SymbolicState(self.source(notes), state))

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
        names comes back as it is; by default the independent coordinates and their rates, angles less the whole turns that they make in the
        period. Other words are changes as in ``solve``."""
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
