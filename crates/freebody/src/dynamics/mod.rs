//! The momentum balance of one instant: accelerations of everything and every reaction, in three ways.
//!
//! - [`Route::Minimal`]: as many equations as degrees of freedom. A tree is swept in joint coordinates; loops and drives
//!   are eliminated by the null space of their rows.
//! - [`Route::NewtonEuler`]: three balance equations a body, for the joint accelerations and all reactions at once.
//! - [`Route::Constraints`]: three coordinates a body and every joint a constraint.
//!
//! All agree to round-off where the reactions are determinate; they share the loads and the rows, and nothing else.

mod answer;
mod articulated_body;
mod contact_decision;
mod contact_forces;
mod contact_modes;
mod derivatives;
mod elimination;
mod energy;
mod evaluator;
mod gaps;
mod gear_flank;
mod generalized_force;
mod impact;
mod impact_derivatives;
mod instant;
mod joint_friction;
mod loads;
mod maximal;
mod minimal;
mod momentum;
mod newton_euler;
mod painleve;
mod plate_friction;
mod projection;
mod rank;
mod reactions;
mod rows;
mod scales;
mod smooth_motion;
mod solved_view;
mod sparse_tree;
mod term_scales;
mod tree_matrices;
mod unloaded;

pub use contact_decision::ContactDecision;
pub use contact_forces::compliant_force;
pub use contact_modes::{ClosedContacts, ContactTolerances};
pub use derivatives::{Direction, RowDerivatives};
pub use energy::{kinetic, potential};
pub use evaluator::reaction_names;
pub use impact::ImpactSolution;
pub use instant::{Balances, ContactLoad, Instant};
pub use loads::{add_force, force_power, force_value, plate_load, pulled, pushed, unaccounted_power};
pub use maximal::{constraint_rows, joint_place};
pub use momentum::{add_multipliers, inertia_wrench, momentum, momentum_rate, residual};
pub use plate_friction::plate_friction;
pub(crate) use projection::{CLOSED, OPEN};
pub use rank::{Count, Determinacy, Freedom, SelfStress};
pub use reactions::JointLoad;
pub use rows::{
    closing_rows, drive_row, gap_row, joint_friction_row, joint_rows, slide_row, BodyWrenches, Row, Source,
};
pub use smooth_motion::SmoothMotion;
pub use solved_view::SolvedView;
pub use term_scales::TermScales;

use crate::bound_values::BoundValues;
pub use crate::error::DynamicsError;
use crate::kinematics::{gradient, Kinematics, State, StateView};
use crate::mechanism::{self, Mechanism, Part};
use crate::mode::{ContactMode, Mode};
use crate::plane::{Twist, Vec2, Wrench};
use crate::solve::Stalled;
use generalized_force::{generalized_force, size_of_power, visit_ancestors};
use minimal::Wanted;

/// How the equations of an instant are set up and solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// As few equations as degrees of freedom.
    Minimal,
    /// Three balance equations a body.
    NewtonEuler,
    /// Three coordinates a body, every joint a constraint.
    Constraints,
}

impl Route {
    /// Every route with its word.
    pub const ALL: &'static [(&'static str, Route)] =
        &[("minimal", Route::Minimal), ("newton_euler", Route::NewtonEuler), ("constraints", Route::Constraints)];
    /// The route of a word.
    pub fn named(word: &str) -> Option<Route> {
        Route::ALL.iter().find(|r| r.0 == word).map(|r| r.1)
    }
}

/// Part of its terms below which a sum is round-off.
const CANCELLED: f64 = 1e-13;

impl DynamicsError {
    /// Refinement that came to a halt at one of `bodies`, or of the groups of rows behind them.
    pub(crate) fn stalled(m: &Mechanism, at: &Stalled, bodies: &[usize], groups: &[Source]) -> DynamicsError {
        let (name, path) = match bodies.get(at.node) {
            Some(&body) => (m.bodies[body].name.clone(), format!("bodies.{}", m.bodies[body].name)),
            None => {
                let group = groups[at.node - bodies.len()];
                (group.name(m).to_string(), group.path(m))
            }
        };
        DynamicsError::Residual(at.residual, name, path)
    }

    /// A motion of a body that nothing resists.
    pub(crate) fn singular_inertia(m: &Mechanism, body: usize) -> DynamicsError {
        let tree_joint = m.bodies[body].tree_joint.expect("a body of the tree");
        let (name, joint) = (&m.bodies[body].name, &m.joints[tree_joint.joint].name);
        DynamicsError::ZeroInertia(format!("`{name}` can move at `{joint}`"), Some(format!("bodies.{name}")))
    }
}

/// The unknowns of an instant, found.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// Joint accelerations, in the order of `q`.
    pub nu_dot: Vec<f64>,
    /// Accelerations of the joint origins and angles of all bodies.
    pub bodies: Vec<Twist>,
    /// Multipliers of the closing rows.
    pub lambda: Vec<f64>,
    /// The load that each body's joint in the tree puts on it, at its joint origin.
    pub joint_wrenches: Vec<Wrench>,
}

/// A state, and what is active in it.
struct Placed {
    mode: Mode,
    /// The mode with the flanks on which gears bear in the last solution, where these are others.
    bearing: Option<Mode>,
    t: f64,
    q: Vec<f64>,
    u: Vec<f64>,
    /// Whether the kinematics are of these numbers and this state.
    is_known: bool,
    /// Whether the last solution is the motion at this state, in the present mode.
    is_solved: bool,
}

impl Placed {
    /// Whether this is the state where the kinematics are, to the last bit.
    fn is_at(&self, t: f64, q: &[f64], u: &[f64]) -> bool {
        let same = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
        self.is_known && same(&[self.t], &[t]) && same(&self.q, q) && same(&self.u, u)
    }

    fn view<'a>(&'a self, m: &'a Mechanism, n: &'a BoundValues, k: &'a Kinematics) -> StateView<'a> {
        StateView { m, n, k, q: &self.q, u: &self.u, t: self.t, mode: self.bearing.as_ref().unwrap_or(&self.mode) }
    }
}

/// One state of a mechanism with everything that its equations need; the memory is kept from one state to the next.
pub struct Workspace<'m> {
    /// The mechanism.
    pub m: &'m Mechanism,
    /// Its numbers.
    n: BoundValues,
    /// Characteristic length, for the scaling of rows and coordinates, m; where the mechanism has none of its own, that of
    /// the first state placed.
    pub length: f64,
    /// Of every contact, how far its surfaces reach from the joint origins of its bodies, m.
    reaches: Vec<[f64; 2]>,
    /// Of every unilateral constraint whether its gap is an angle.
    turning_gaps: Vec<bool>,
    k: Kinematics,
    placed: Placed,
    arms: Vec<Vec2>,
    loads: Vec<Wrench>,
    rows: Vec<Row>,
    solved: Solution,
    articulated_body: articulated_body::ArticulatedBody,
    dense: minimal::Dense,
    /// There but while it is in use.
    memory: Option<Box<minimal::Memory>>,
    maximal: maximal::Maximal,
    sparse_tree: Option<sparse_tree::SparseTree>,
    many_loops: bool,
    preferred: Option<Route>,
    determinacy: Option<rank::Determinacy>,
    /// Friction of each joint that slides, along its coordinate.
    joint_friction_forces: Vec<f64>,
}

impl<'m> Workspace<'m> {
    /// The mechanism at parameters `p`.
    pub fn new(m: &'m Mechanism, p: &[f64]) -> Self {
        let n = m.bind(p);
        let (bodies, freedom) = (m.bodies.len(), m.freedom());
        let length = m.characteristic_length(&n).unwrap_or(0.0);
        let reaches = gaps::reaches(m, &n);
        let mut workspace = Workspace {
            m,
            n,
            length,
            reaches,
            turning_gaps: m.unilateral.iter().map(|constraint| constraint.gap.turns(m)).collect(),
            k: Kinematics::of(m),
            placed: Placed {
                mode: Mode::free(m),
                bearing: None,
                t: 0.0,
                q: vec![0.0; freedom],
                u: vec![0.0; freedom],
                is_known: false,
                is_solved: false,
            },
            arms: vec![Vec2::zero(); bodies],
            loads: vec![Wrench::zero(); bodies],
            rows: vec![],
            solved: Solution {
                nu_dot: vec![0.0; freedom],
                bodies: vec![Twist::zero(); bodies],
                lambda: vec![],
                joint_wrenches: vec![Wrench::zero(); bodies],
            },
            articulated_body: articulated_body::ArticulatedBody::new(),
            dense: Default::default(),
            memory: Some(Default::default()),
            maximal: Default::default(),
            sparse_tree: None,
            many_loops: false,
            preferred: None,
            determinacy: None,
            joint_friction_forces: vec![0.0; m.joint_friction.len()],
        };
        workspace.many_loops = workspace.prefers_sparse();
        workspace
    }

    /// Lets [`Workspace::solve`] take a given route, or the cheapest.
    pub fn prefer(&mut self, route: Option<Route>) {
        self.preferred = route;
    }

    /// Takes other parameters.
    pub fn rebind(&mut self, p: &[f64]) {
        self.n = self.m.bind(p);
        self.placed.is_known = false;
        self.forget_factors();
        self.length = self.m.characteristic_length(&self.n).unwrap_or(self.length);
        self.reaches = gaps::reaches(self.m, &self.n);
    }

    /// Takes other parameters, and forgets where it has been.
    pub fn restart(&mut self, p: &[f64]) {
        self.length = 0.0;
        self.rebind(p);
    }

    /// Goes to a state in a mode.
    pub fn place(&mut self, mode: &Mode, t: f64, q: &[f64], u: &[f64]) {
        self.enter(mode);
        self.move_to(t, q, u);
    }

    /// Takes the present state as one in another mode.
    pub fn enter(&mut self, mode: &Mode) {
        self.placed.bearing = None;
        if self.placed.mode != *mode {
            self.placed.mode = mode.clone();
            self.forget_factors();
        }
    }

    /// Goes to another state in the present mode.
    pub fn move_to(&mut self, t: f64, q: &[f64], u: &[f64]) {
        self.placed.bearing = None;
        if self.placed.is_at(t, q, u) {
            return;
        }
        self.placed.t = t;
        self.placed.q.copy_from_slice(q);
        self.placed.u.copy_from_slice(u);
        (self.placed.is_known, self.placed.is_solved) = (true, false);
        self.k.forward_kinematics(self.m, &self.n, q, u);
        if self.length == 0.0 {
            // Where all is in one place no lever has a length: any unit will do.
            self.length = self.extent().unwrap_or(1.0);
        }
    }

    /// Gives the states with a rate of their own their values.
    pub fn set_states(&mut self, states: &[f64]) {
        let known = &mut self.n.p[self.m.first_state()..];
        if *known != *states {
            known.copy_from_slice(states);
            self.placed.is_known = false;
            self.forget_factors();
        }
    }

    /// The rates of the states with a rate of their own.
    pub fn state_rates(&self) -> Vec<f64> {
        let mut rates = vec![0.0; self.m.state_rates.len()];
        self.write_state_rates(&mut rates);
        rates
    }

    /// Writes them.
    pub fn write_state_rates(&self, out: &mut [f64]) {
        out.iter_mut().zip(&self.m.state_rates).for_each(|(out, rate)| *out = rate.eval(&State(self.at())));
    }

    /// The mode of the present state.
    pub fn mode(&self) -> &Mode {
        &self.placed.mode
    }

    /// The present state, as what measures sees it; gears bear as in the last solution.
    pub fn at(&self) -> StateView<'_> {
        self.placed.view(self.m, &self.n, &self.k)
    }

    /// Solves the present state the quickest way; see [`Workspace::solved`].
    ///
    /// # Errors
    /// `singular_mass`, `inconsistent_constraints`, named after the bodies and joints concerned.
    pub fn solve(&mut self) -> Result<(), DynamicsError> {
        self.solve_by(self.cheapest())
    }

    /// Solves the present state for its accelerations and the powers of drives, and for no reactions of the tree. The flank on which
    /// gears bear changes none of them unless something rubs or is pressed, so the multipliers found may be those of the other
    /// flank.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn solve_motion(&mut self) -> Result<(), DynamicsError> {
        if !self.m.joint_friction.is_empty() {
            return self.solve();
        }
        if self.placed.is_solved {
            return Ok(());
        }
        self.placed.bearing = None;
        let route = self.cheapest();
        self.solve_once(route, Wanted::Motion)?;
        if self.m.is_hybrid() {
            self.turn_gear_flanks(route, Wanted::Motion)?;
        }
        self.placed.is_solved = self.placed.bearing.is_none();
        Ok(())
    }

    /// Solves the present state for its accelerations and all reactions: whether these are determinate is known then, and where all are
    /// no more about the rank of the rows.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn solve_reactions(&mut self) -> Result<(), DynamicsError> {
        let wanted = if self.m.is_hybrid() { Wanted::Rank } else { Wanted::Reactions };
        self.solve_for(self.cheapest(), wanted)
    }

    fn cheapest(&self) -> Route {
        self.preferred.unwrap_or(if self.many_loops { Route::Constraints } else { Route::Minimal })
    }

    /// Solves the present state by a given route.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn solve_by(&mut self, route: Route) -> Result<(), DynamicsError> {
        self.solve_for(route, Wanted::Rank)
    }

    fn solve_for(&mut self, route: Route, wanted: Wanted) -> Result<(), DynamicsError> {
        self.placed.bearing = None;
        self.joint_friction_forces.fill(0.0);
        self.solve_once(route, wanted)?;
        self.turn_gear_flanks(route, wanted)?;
        match self.m.joint_friction.is_empty() {
            true => Ok(()),
            false => self.solve_joint_friction(route),
        }
    }

    /// Solves it again with gears on the other flank, and back again where teeth would pull there too.
    fn turn_gear_flanks(&mut self, route: Route, wanted: Wanted) -> Result<(), DynamicsError> {
        for _ in 0..2 {
            let Some(mode) = self.other_gear_flanks() else { break };
            self.placed.bearing = Some(mode);
            self.solve_once(route, wanted)?;
        }
        Ok(())
    }

    /// Solves the present state for what is wanted, gears bearing on the flanks that the mode says.
    fn solve_once(&mut self, route: Route, wanted: Wanted) -> Result<(), DynamicsError> {
        self.placed.is_solved = false;
        let at = self.placed.view(self.m, &self.n, &self.k);
        loads::centre_arms(at, &mut self.arms);
        loads::loads(at, &self.arms, &mut self.loads);
        joint_friction::add_joint_friction(at, &self.joint_friction_forces, &mut self.loads);
        contact_forces::add_compliant_forces(at, &mut self.loads);
        if !self.loads.iter().all(|load| load.parts().iter().all(|part| part.is_finite())) {
            return Err(self.infinite_load());
        }
        let at = self.placed.view(self.m, &self.n, &self.k);
        match route {
            Route::Minimal if !self.is_closed() => {
                self.rows.clear();
                self.solved.lambda.clear();
                let Solution { nu_dot, bodies, joint_wrenches, .. } = &mut self.solved;
                let (sweep, arms, loads) = (&mut self.articulated_body, &self.arms, &self.loads);
                match wanted {
                    Wanted::Motion => sweep.solve(at, arms, loads, nu_dot, bodies, |_, _| {}),
                    Wanted::Reactions | Wanted::Rank => {
                        sweep.solve(at, arms, loads, nu_dot, bodies, |i, wrench| joint_wrenches[i] = wrench)
                    }
                }
            }
            Route::Minimal => self.solve_minimal(wanted),
            Route::NewtonEuler => self.solve_newton_euler(),
            Route::Constraints
                if wanted == Wanted::Motion && self.preferred.is_none() && self.sparse_tree.is_some() =>
            {
                self.solve_sparse_tree().or_else(|_| self.solve_constraints())
            }
            Route::Constraints => self.solve_constraints(),
        }
    }

    /// Refuses a solution that is no motion.
    ///
    /// # Errors
    /// `not_finite`.
    pub fn check_finite(&self) -> Result<(), DynamicsError> {
        match self.solved.nu_dot.iter().all(|a| a.is_finite()) {
            true => Ok(()),
            false => Err(DynamicsError::NoFiniteAcceleration),
        }
    }

    /// Says which force is not finite.
    fn infinite_load(&self) -> DynamicsError {
        let at = self.at();
        let is_infinite = |force: &mechanism::Force| {
            let mut loads = vec![Wrench::zero(); self.m.bodies.len()];
            add_force(at, force, &mut loads);
            !loads.iter().flat_map(Wrench::parts).all(f64::is_finite)
        };
        let Some((_, force)) = at.forces().find(|(_, force)| is_infinite(force)) else {
            return DynamicsError::NoFiniteAcceleration;
        };
        let (name, item) = (force.name.clone(), format!("forces.{}", force.name));
        let has_direction = |pull: &mechanism::GaugeForce| {
            let mut along = pull.bodies.iter().flat_map(|&body| gradient(at, &pull.gauge, body).parts());
            along.all(f64::is_finite)
        };
        match force.gauge_forces.iter().all(has_direction) {
            false => DynamicsError::ForceWithoutDirection(name, item),
            true => DynamicsError::InfiniteForce(name, item),
        }
    }

    /// Whether anything but the tree constrains the motion in the present mode.
    pub fn is_closed(&self) -> bool {
        let mode = &self.placed.mode;
        self.m.closures.iter().any(|&joint| mode.has(Part::Joint(joint)))
            || self.at().drives().next().is_some()
            || mode.contacts.iter().any(|contact| contact.mode.is_closed())
            || mode.joint_friction.contains(&ContactMode::Stick)
    }

    /// What the last solution found.
    pub fn solved(&self) -> &Solution {
        &self.solved
    }

    /// The closing rows of the last solution.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Accelerations of the user's coordinates of the last solution.
    pub fn accelerations(&self, out: &mut [f64]) {
        self.k.user_rates(self.m, &self.n, &self.solved.bodies, &self.solved.nu_dot, out);
    }

    /// A motion of the coordinates from joint rates (or displacements) `nu` of the tree.
    pub(crate) fn to_user(&self, nu: &[f64], out: &mut [f64]) {
        let mut bodies = vec![Twist::zero(); self.m.bodies.len()];
        self.k.propagate_motion(self.m, nu, false, &mut bodies);
        self.k.user_rates(self.m, &self.n, &bodies, nu, out);
    }
}
