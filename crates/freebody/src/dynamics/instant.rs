//! A solved instant, as it is handed out, and the reading of expressions at states.

use super::energy::{
    angular_momentum, force_potential, kinetic, kinetic_energy, potential, whole_mass_centre, whole_momentum,
};
use super::{
    force_power, force_value, plate_load, Determinacy, DynamicsError, JointLoad, Route, SolvedView, TermScales,
    Workspace,
};
use crate::gauges::{is_measured, Axis, ContactQuantity, ModelExpr, ModelVariable, Reading};
use crate::kinematics::Observed;
use crate::mechanism::FrictionSource;
use crate::mode::ContactMode;
use crate::plane::Vec2;
use crate::scalar::Scalar;

/// Everything about one instant.
#[derive(Clone, Debug)]
pub struct Instant {
    /// Accelerations of the coordinates, in the order of `q`.
    pub accelerations: Vec<f64>,
    /// Of each body (ground left out): acceleration of the mass centre and angular acceleration.
    pub bodies: Vec<[f64; 3]>,
    /// The reaction of each joint; of all that balance, the least where it is not determinate.
    pub joints: Vec<JointLoad>,
    /// Whether (Fx, Fy, M) of each joint are determinate.
    pub determinate: Vec<[bool; 3]>,
    /// Force or torque of each coupling and motion.
    pub drives: Vec<f64>,
    /// Whether those are determinate.
    pub drives_determinate: Vec<bool>,
    /// The joints in place.
    pub joints_in_place: Vec<usize>,
    /// The couplings, motions and locks in place.
    pub drives_in_place: Vec<usize>,
    /// Ways in which joints can load each other, in words.
    pub self_stress: Vec<String>,
    /// What each contact, stop and string does.
    pub contacts: Vec<ContactLoad>,
}

/// How well the bodies of a solved instant balance.
#[derive(Clone, Debug)]
pub struct Balances {
    /// What is left of the momentum balance of each body, N, N, N·m.
    pub residuals: Vec<[f64; 3]>,
    /// The largest of them relative to the largest load.
    pub residual: f64,
    /// How large the terms are of which accelerations and reactions are made.
    pub sizes: TermScales,
}

/// What a contact, stop or string does.
#[derive(Clone, Debug)]
pub struct ContactLoad {
    /// One word: `off`, `open`, `closed`, `stuck`, `sliding`.
    pub state: &'static str,
    /// Least gap, m.
    pub gap: f64,
    /// Force along the gaps, and along the tangent on the first body, N.
    pub along: [f64; 2],
    /// Force on the first body, N, fixed axes.
    pub force: Vec2,
    /// Where the resultant of the normal forces acts; None where it is open, or no contact.
    pub at: Option<Vec2>,
    /// Whether the force on the first body (Fx, Fy), the normal force and the friction are determinate.
    pub determinate: [bool; 4],
}

impl Workspace<'_> {
    /// What every contact, stop and string does in the last solution.
    fn contact_loads(&self, determinate: &[[bool; 4]]) -> Vec<ContactLoad> {
        determinate.iter().enumerate().map(|(g, sure)| self.contact_load(g, *sure)).collect()
    }

    fn contact_load(&self, group: usize, determinate: [bool; 4]) -> ContactLoad {
        let modes = || self.m.groups[group].constraints.clone().map(|l| self.mode_seen(l));
        let state = match () {
            _ if modes().all(|h| h == ContactMode::Off) => "off",
            _ if modes().any(|h| matches!(h, ContactMode::Slip(_))) => "sliding",
            _ if modes().any(ContactMode::sticks) => "stuck",
            _ if modes().any(ContactMode::touches) => "closed",
            _ => "open",
        };
        let seen = self.solved_view();
        let read = |quantity| seen.read_contact(group, quantity);
        let at = seen.resultant_at(group);
        ContactLoad {
            state,
            gap: read(ContactQuantity::Gap),
            along: [read(ContactQuantity::Force), read(ContactQuantity::Friction)],
            force: seen.force_on_first(group),
            at: at.x.is_finite().then_some(at),
            determinate,
        }
    }
}

impl Workspace<'_> {
    /// Everything about the present state.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn instant(&mut self, route: Route) -> Result<Instant, DynamicsError> {
        self.solve_by(route)?;
        self.check_finite()?;
        let mut accelerations = vec![0.0; self.m.freedom()];
        self.accelerations(&mut accelerations);
        let (joints, drives) = (self.solved_view().joint_loads(), self.solved_view().drive_forces());
        let joints_in_place = (0..self.m.joints.len()).filter(|&j| self.at().mode.has(self.m.part_of(j))).collect();
        let drives_in_place = self.at().drives().map(|(drive, _)| drive).collect();
        let bodies = (1..self.m.bodies.len())
            .map(|i| {
                let a = self.centre_acceleration(i);
                [a.x, a.y, self.solved.bodies[i].w]
            })
            .collect();
        let stresses = self.self_stresses();
        let Determinacy { joints: determinate, drives: drives_determinate, groups } = self.determinacy_under(&stresses);
        let self_stress = stresses.iter().map(|s| self.describe_self_stress(s)).filter(|s| !s.is_empty()).collect();
        let contacts = self.contact_loads(&groups);
        Ok(Instant {
            contacts,
            accelerations,
            bodies,
            joints,
            determinate,
            drives,
            drives_determinate,
            joints_in_place,
            drives_in_place,
            self_stress,
        })
    }

    /// How well the bodies balance in the last solution.
    pub fn balances(&self) -> Balances {
        let (residuals, sizes) = (self.residuals(), self.term_scales());
        let size = |r: &[f64; 3]| r[0].abs().max(r[1].abs()).max(r[2].abs() / self.length);
        let residual = residuals.iter().map(size).fold(0.0, f64::max) / sizes.load;
        Balances { residuals, residual, sizes }
    }
}

/// What expressions ask of an instant beyond its state.
struct Needs {
    /// Its solution.
    solution: bool,
    /// Reactions, and whether they are determinate.
    reactions: bool,
}

impl Needs {
    fn of(laws: &[&ModelExpr]) -> Self {
        let mut needs = Needs { solution: false, reactions: false };
        for law in laws {
            needs.solution |= law.depends_on_accelerations();
            for variable in law.variables() {
                let ModelVariable::Reading(reading) = variable else { continue };
                needs.reactions |= match reading {
                    Reading::Reaction(..) | Reading::Drive(_) | Reading::DrivePower(_) => true,
                    Reading::Contact(_, quantity) => !quantity.needs().is_empty(),
                    _ => false,
                };
                needs.solution |= needs.reactions || matches!(reading, Reading::JointFriction(_));
            }
        }
        needs
    }
}

impl Workspace<'_> {
    /// The values of expressions at the present state, which is solved only when one of them asks for it; `works` of
    /// all forces, each with the potential that it has now, of all drives and of friction since the start, J. What is not
    /// determinate is NaN.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn evaluate(&mut self, laws: &[&ModelExpr], works: &[f64]) -> Result<Vec<f64>, DynamicsError> {
        let needs = Needs::of(laws);
        let derivatives = laws.iter().flat_map(|law| law.derivatives());
        let solved: Vec<&ModelExpr> = derivatives.map(|(of, _)| of).filter(|of| !is_measured(of)).collect();
        let rates = self.rates_along_motion(&solved, works)?;
        let rates: Vec<(&ModelExpr, f64)> = solved.into_iter().zip(rates).collect();
        let mut accelerations = vec![0.0; self.m.freedom()];
        if needs.solution {
            self.solve()?;
            self.accelerations(&mut accelerations);
        }
        let determinacy = needs.reactions.then(|| self.determinacy());
        let seen = self.solved_view();
        let read = |reading| seen.read(reading, works, determinacy.as_ref());
        let observed = Observed {
            at: seen.at,
            bodies: &self.solved.bodies,
            accelerations: &accelerations,
            read: &read,
            rates: &rates,
        };
        Ok(laws.iter().map(|law| law.eval(&observed)).collect())
    }
}

impl<S: Scalar> SolvedView<'_, S> {
    /// A quantity of the instant; `works` as those of [`Workspace::evaluate`]. NaN where it is not determinate.
    pub fn read(&self, reading: Reading, works: &[S], determinacy: Option<&Determinacy>) -> S {
        let (at, m) = (self.at, self.at.m);
        let known = |is_sure: &dyn Fn(&Determinacy) -> bool, value: S| {
            S::select(determinacy.is_none_or(is_sure), value, S::of(f64::NAN))
        };
        match reading {
            Reading::Reaction(j, axis) => {
                let (parts, value) = self.component(j, axis);
                known(&|sure| parts.iter().all(|&i| sure.joints[j][i]), value)
            }
            Reading::Drive(d) => known(&|sure| sure.drives[d], self.drive_forces()[d]),
            Reading::DrivePower(d) => known(&|sure| sure.drives[d], self.drive_powers()[d]),
            Reading::DriveWork(d) => works[m.forces.len() + d],
            Reading::Force(f) => force_value(at, f),
            Reading::Plate(f, Axis::X) => plate_load(at, f).f.x,
            Reading::Plate(f, Axis::Y) => plate_load(at, f).f.y,
            Reading::Plate(f, _) => plate_load(at, f).m,
            Reading::ForcePower(f) => force_power(at, f),
            Reading::ForceWork(f) => works[f] - force_potential(at, f),
            Reading::Kinetic(Some(body)) => kinetic(at, body),
            Reading::Kinetic(None) => kinetic_energy(at),
            Reading::Potential => potential(at),
            Reading::Momentum(Axis::X) => whole_momentum(at).x,
            Reading::Momentum(_) => whole_momentum(at).y,
            Reading::AngularMomentum(site) => angular_momentum(at, at.site(site)),
            Reading::Centre(Axis::X) => whole_mass_centre(at).x,
            Reading::Centre(_) => whole_mass_centre(at).y,
            Reading::Contact(group, quantity) => {
                let is_sure = |flags: &[bool; 4]| quantity.needs().iter().all(|&i| flags[i]);
                known(&|sure| sure.groups.get(group).is_none_or(is_sure), self.read_contact(group, quantity))
            }
            Reading::JointFriction(joint) => {
                let of_joint = |source| matches!(source, FrictionSource::Joint { joint: j, .. } if j == joint);
                let friction = m.joint_friction.iter().position(|friction| of_joint(friction.of));
                friction.map_or(S::zero(), |friction| self.joint_friction_force(friction))
            }
            Reading::FrictionWork => works[m.forces.len() + m.drives.len()],
        }
    }

    /// One component of a reaction, and which of (Fx, Fy, M) must be determinate for it.
    fn component(&self, joint: usize, axis: Axis) -> (&'static [usize], S) {
        let load = self.joint_load(joint);
        match axis {
            Axis::X => (&[0], load.force.x),
            Axis::Y => (&[1], load.force.y),
            Axis::Couple => (&[2], load.couple),
            Axis::Along => (&[0, 1], load.in_joint_axes().x),
            Axis::Across => (&[0, 1], load.in_joint_axes().y),
            Axis::Size => (&[0, 1], load.force.norm()),
            Axis::Tension => (&[0, 1], load.tension()),
            Axis::Row(row) => (&[0, 1, 2], self.row_loads(joint)[row]),
        }
    }
}
