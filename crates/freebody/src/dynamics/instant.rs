//! A solved instant, as it is handed out, and the reading of expressions at states.

use super::{force_power, force_value, Determinacy, DynamicsError, JointLoad, Route, TermScales, Workspace};
use crate::gauges::{Axis, ContactQuantity, ModelExpr, ModelVariable, Reading};
use crate::kinematics::Observed;
use crate::mechanism::FrictionSource;
use crate::mode::ContactMode;
use crate::plane::Vec2;

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
    /// The couplings, motions and locks in place.
    pub drives_in_place: Vec<usize>,
    /// What is left of the momentum balance of each body, N, N, N·m.
    pub residuals: Vec<[f64; 3]>,
    /// The largest of them relative to the largest load.
    pub residual: f64,
    /// How large the terms are of which accelerations and reactions are made.
    pub sizes: TermScales,
    /// Ways in which joints can load each other, in words.
    pub self_stress: Vec<String>,
    /// What each contact, stop and string does.
    pub contacts: Vec<ContactLoad>,
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
        let read = |bound| self.read_contact(group, bound);
        let at = self.resultant_at(group);
        ContactLoad {
            state,
            gap: read(ContactQuantity::Gap),
            along: [read(ContactQuantity::Force), read(ContactQuantity::Friction)],
            force: self.force_on_first(group),
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
        let joints = self.joint_loads();
        let drives = self.drive_forces();
        let drives_in_place = self.at().drives().map(|(drive, _)| drive).collect();
        let (residuals, sizes) = (self.residuals(), self.term_scales());
        let length = self.length;
        let size = |r: &[f64; 3]| r[0].abs().max(r[1].abs()).max(r[2].abs() / length);
        let residual = residuals.iter().map(size).fold(0.0, f64::max) / sizes.load;
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
            drives_in_place,
            residuals,
            residual,
            sizes,
            self_stress,
        })
    }
}

impl Workspace<'_> {
    /// The values of expressions at the present state, which is solved only when one of them asks for it; `works` of
    /// all forces, then of all drives. What is not determinate is NaN.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn evaluate(&mut self, laws: &[&ModelExpr], works: &[f64]) -> Result<Vec<f64>, DynamicsError> {
        let (mut needs_solution, mut needs_reactions) = (false, false);
        for law in laws {
            needs_solution |= law.depends_on_accelerations();
            for variable in law.variables() {
                let ModelVariable::Reading(reading) = variable else { continue };
                needs_reactions |= match reading {
                    Reading::Reaction(..) | Reading::Drive(_) | Reading::DrivePower(_) => true,
                    Reading::Contact(_, bound) => !bound.needs().is_empty(),
                    _ => false,
                };
                needs_solution |= needs_reactions || matches!(reading, Reading::JointFriction(_));
            }
        }
        let (mut joints, mut drives, mut powers) = (vec![], vec![], vec![]);
        let (mut sure, mut drives_sure, mut groups_sure) = (vec![], vec![], vec![]);
        let mut accelerations = vec![0.0; self.m.freedom()];
        if needs_solution {
            self.solve()?;
            self.accelerations(&mut accelerations);
        }
        if needs_reactions {
            joints = self.joint_loads();
            drives = self.drive_forces();
            powers = self.drive_powers();
            Determinacy { joints: sure, drives: drives_sure, groups: groups_sure } = self.determinacy();
        }
        let b = &*self;
        let read = |reading: Reading| -> f64 {
            let known = |sure: bool, x: f64| if sure { x } else { f64::NAN };
            match reading {
                Reading::Reaction(j, Axis::Row(r)) => known(sure[j].iter().all(|&s| s), b.row_loads(j)[r]),
                Reading::Reaction(j, axis) => component(&joints[j], sure[j], axis),
                Reading::Drive(d) => known(drives_sure[d], drives[d]),
                Reading::DrivePower(d) => known(drives_sure[d], powers[d]),
                Reading::DriveWork(d) => works.get(b.m.forces.len() + d).copied().unwrap_or(0.0),
                Reading::Force(f) => force_value(b.at(), f),
                Reading::ForcePower(f) => force_power(b.at(), f),
                Reading::ForceWork(f) => works.get(f).copied().unwrap_or(0.0),
                Reading::Kinetic(Some(body)) => super::kinetic(b.at(), body),
                Reading::Kinetic(None) => b.kinetic_energy(),
                Reading::Potential => b.potential_energy(),
                Reading::Momentum(Axis::X) => b.momentum().x,
                Reading::Momentum(_) => b.momentum().y,
                Reading::AngularMomentum(site) => b.angular_momentum(b.site(site)),
                Reading::Centre(Axis::X) => b.mass_centre().x,
                Reading::Centre(_) => b.mass_centre().y,
                Reading::Contact(group, bound) => {
                    let sure = groups_sure.get(group).is_none_or(|flags| bound.needs().iter().all(|&i| flags[i]));
                    known(sure, b.read_contact(group, bound))
                }
                Reading::JointFriction(joint) => {
                    let friction = b.m.joint_friction.iter().position(
                        |friction| matches!(friction.of, FrictionSource::Joint { joint: j, .. } if j == joint),
                    );
                    friction.map_or(0.0, |friction| b.joint_friction_force(friction))
                }
                Reading::FrictionWork => works.get(b.m.forces.len() + b.m.drives.len()).copied().unwrap_or(0.0),
            }
        };
        let observed = Observed { at: b.at(), bodies: &b.solved().bodies, accelerations: &accelerations, read: &read };
        Ok(laws.iter().map(|law| law.eval(&observed)).collect())
    }
}

/// One component of a reaction, NaN where it is not determinate.
fn component(load: &JointLoad, sure: [bool; 3], axis: Axis) -> f64 {
    let (needed, value) = match axis {
        Axis::X => (sure[0], load.force.x),
        Axis::Y => (sure[1], load.force.y),
        Axis::Couple => (sure[2], load.couple),
        Axis::Along => (sure[0] && sure[1], load.in_joint_axes().x),
        Axis::Across => (sure[0] && sure[1], load.in_joint_axes().y),
        Axis::Size => (sure[0] && sure[1], load.force.norm()),
        Axis::Row(_) => unreachable!("a row is read by its own way"),
        Axis::Tension => (sure[0] && sure[1], load.tension()),
    };
    if needed {
        value
    } else {
        f64::NAN
    }
}
