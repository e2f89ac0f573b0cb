//! The numbers of a mechanism at given parameters.

use crate::error::{CompileError, DynamicsError};
use crate::expr::{Env, Table};
use crate::gauges::{ModelExpr, ModelVariable};
use crate::mechanism::{Body, Coordinate, Friction, FrictionSource, Mechanism, PointLocation, ValueId};
use crate::plane::{Turn, Vec2};
use crate::scalar::{Dual, Scalar};
use std::collections::HashMap;

/// All numbers of a mechanism, evaluated at parameters `p`.
#[derive(Clone, Debug)]
pub struct BoundValues<S = f64> {
    /// The parameters.
    pub p: Vec<S>,
    /// Every number of the model, by slot.
    pub values: Vec<S>,
    /// Of each site, its place from the joint origin of its body, in the body's axes.
    pub arms: Vec<Vec2<S>>,
    /// Of each body, mass in kg.
    pub mass: Vec<S>,
    /// Of each body, the mass centre from its joint origin, in the body's axes.
    pub centre: Vec<Vec2<S>>,
    /// Of each body, inertia about the mass centre, kg·m²; 1 for a particle, which nothing turns.
    pub inertia: Vec<S>,
    /// Of each body on a plain hinge, the numbers of that hinge.
    pub hinges: Vec<HingeNumbers<S>>,
    /// Acceleration of gravity.
    pub gravity: Vec2<S>,
    /// Zeros of rows of joints that stand for those of the mode, by joint and row: where these are symbols.
    pub row_offsets: HashMap<(usize, usize), S>,
}

/// All that a body on a plain hinge needs to know of it, side by side, for long chains outgrow the caches.
#[derive(Clone, Copy, Debug)]
pub struct HingeNumbers<S = f64> {
    /// From the parent's joint origin to the own, in the parent's axes.
    pub arm: Vec2<S>,
    /// Direction of the parent's marker in the parent's axes.
    pub near: S,
    /// Direction of the own marker in the own axes.
    pub far: S,
    /// How the user reads the angle.
    pub reading: Reading<S>,
}

/// How a user reads a joint coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Reading<S = f64> {
    /// The joint's measure where the user reads 0.
    pub zero: S,
    /// +1 or −1.
    pub sense: f64,
    /// From the fixed x axis instead of from the first body.
    pub absolute: bool,
}

/// What an expression of parameters may read.
struct OfParameters<'a, S> {
    p: &'a [S],
    tables: &'a [Table],
}

impl<S: Scalar> Env<S, ModelVariable> for OfParameters<'_, S> {
    fn variable(&self, variable: &ModelVariable) -> S {
        match variable {
            ModelVariable::Parameter(i) => self.p[*i],
            other => unreachable!("{other:?} in a number of the model"),
        }
    }
    fn rate(&self, _: &ModelExpr) -> S {
        S::zero()
    }
    fn accel(&self, _: &ModelExpr) -> S {
        S::zero()
    }
    fn table(&self, table: usize, x: S) -> S {
        self.tables[table].eval(x)
    }
}

impl Mechanism {
    /// The parameters, those with an entry in `given` overruled; the others follow their expressions.
    pub fn parameters_with<S: Scalar>(&self, given: &[(usize, S)]) -> Vec<S> {
        let mut p = vec![S::of(f64::NAN); self.parameters.len()];
        for &(i, value) in given {
            p[i] = value;
        }
        for &i in &self.parameter_order {
            if !given.iter().any(|&(j, _)| j == i) {
                p[i] = self.parameters[i].value.eval(&OfParameters { p: &p, tables: &self.tables });
            }
        }
        p
    }

    /// How all parameters of `p` change with one of them, which is overruled: those that follow from it, by its expression.
    pub fn parameter_direction(&self, p: &[f64], along: usize) -> Vec<f64> {
        let states = (self.first_state()..p.len()).map(|i| (i, p[i]));
        let held = self.overruled(p).into_iter().chain(states).filter(|&(i, _)| i != along);
        let mut given: Vec<(usize, Dual<1>)> = held.map(|(i, x)| (i, Dual::constant(x))).collect();
        given.push((along, Dual::variable(p[along], 0)));
        self.parameters_with(&given).into_iter().map(|x| x.du[0]).collect()
    }

    /// The parameters of `p` that do not follow from their expressions: those that were overruled. States are none of them.
    pub fn overruled(&self, p: &[f64]) -> Vec<(usize, f64)> {
        let env = OfParameters { p, tables: &self.tables };
        let follows = |i: usize| self.parameters[i].value.eval(&env) == p[i];
        (0..self.first_state()).filter(|&i| !follows(i)).map(|i| (i, p[i])).collect()
    }

    /// The numbers of the mechanism at parameters `p`.
    pub fn bind<S: Scalar>(&self, p: &[S]) -> BoundValues<S> {
        let env = OfParameters { p, tables: &self.tables };
        self.with_values(p, self.values.iter().map(|e| e.eval(&env)).collect())
    }

    /// The numbers of the mechanism at parameters `p` and values of its slots.
    pub fn with_values<S: Scalar>(&self, p: &[S], bound: Vec<S>) -> BoundValues<S> {
        let at = |xy: [ValueId; 2]| Vec2 { x: bound[xy[0]], y: bound[xy[1]] };
        let heavy: Vec<_> = self.bodies.iter().map(|body| mass_properties(body, &bound)).collect();
        let place = |site: usize| match self.sites[site].at {
            PointLocation::At(xy) => at(xy),
            PointLocation::MassCentre => heavy[self.sites[site].body].1,
        };
        let pins: Vec<Vec2<S>> = self.bodies.iter().map(|body| place(body.joint_origin)).collect();
        let arms: Vec<Vec2<S>> = (0..self.sites.len()).map(|i| place(i) - pins[self.sites[i].body]).collect();
        BoundValues {
            p: p.to_vec(),
            gravity: at(self.gravity),
            hinges: self.bodies.iter().map(|body| self.hinge_numbers(body, &bound, &arms)).collect(),
            arms,
            mass: heavy.iter().map(|h| h.0).collect(),
            centre: heavy.iter().zip(&pins).map(|(h, &pin)| h.1 - pin).collect(),
            inertia: heavy.iter().zip(&self.bodies).map(|(h, b)| if b.particle { S::one() } else { h.2 }).collect(),
            values: bound,
            row_offsets: HashMap::new(),
        }
    }

    fn hinge_numbers<S: Scalar>(&self, body: &Body, bound: &[S], arms: &[Vec2<S>]) -> HingeNumbers<S> {
        let Some(branch) = body.tree_joint.filter(|b| b.hinge) else { return HingeNumbers::none() };
        let joint = &self.joints[branch.joint];
        let (near, far) = joint.sides(branch.reversed);
        let reading = joint.coordinates.first().map_or(Reading::plain(), |c| c.reading(bound));
        HingeNumbers { arm: arms[near.site], near: bound[near.angle], far: bound[far.angle], reading }
    }
}

impl Coordinate {
    /// How its user reads it.
    #[inline(always)]
    pub fn reading<S: Scalar>(&self, bound: &[S]) -> Reading<S> {
        Reading { zero: bound[self.zero], sense: self.sense, absolute: self.absolute }
    }
}

impl<S: Scalar> HingeNumbers<S> {
    fn none() -> Self {
        HingeNumbers { arm: Vec2::zero(), near: S::zero(), far: S::zero(), reading: Reading::plain() }
    }
}

impl<S: Scalar> Reading<S> {
    fn plain() -> Self {
        Reading { zero: S::zero(), sense: 1.0, absolute: false }
    }
    /// The joint's own coordinate and rate from the user's.
    #[inline(always)]
    pub fn to_joint(&self, q: S, u: S, base_angle: S, base_rate: S) -> (S, S) {
        let (at, rate) = (self.zero + q.scale(self.sense), u.scale(self.sense));
        if self.absolute {
            (at - base_angle, rate - base_rate)
        } else {
            (at, rate)
        }
    }
    /// The user's rate from the joint's own.
    #[inline(always)]
    pub fn to_user(&self, rate: S, base_rate: S) -> S {
        (if self.absolute { rate + base_rate } else { rate }).scale(self.sense)
    }
}

impl Mechanism {
    /// Refuses numbers that no body can have.
    ///
    /// # Errors
    /// A number that is undefined; a negative mass, inertia or friction; a restitution that is not from 0 to 1.
    pub fn check(&self, p: &[f64]) -> Result<(), CompileError> {
        let n = self.bind(p);
        let named = |i: usize| format!("parameters.{}", self.parameters[i].name);
        if let Some(i) = p.iter().position(|x| !x.is_finite()) {
            return Err(CompileError::new(
                named(i),
                "this parameter has no finite value",
                "look for a division by 0 or a negative root",
            ));
        }
        for (i, body) in self.bodies.iter().enumerate().skip(1) {
            let path = |field: &str| format!("bodies.{}.{field}", body.name);
            for piece in &body.mass_elements {
                let (mass, inertia) = (n.values[piece.mass], piece.inertia.map_or(0.0, |s| n.values[s]));
                for (field, x) in [("mass", mass), ("inertia", inertia)] {
                    if !x.is_finite() || x < 0.0 {
                        return Err(CompileError::new(
                            path(field),
                            format!("the {field} is {x}"),
                            "it must be 0 or more",
                        ));
                    }
                }
            }
            if !(n.inertia[i].is_finite() && n.centre[i].norm().is_finite()) {
                return Err(CompileError::new(
                    path("shape"),
                    "the shape has no finite mass centre and inertia",
                    "look for sizes that are 0 or undefined",
                ));
            }
        }
        self.check_contacts(&n)?;
        self.check_joint_friction(&n)
    }

    fn check_contacts(&self, n: &BoundValues<f64>) -> Result<(), CompileError> {
        for group in &self.groups {
            for constraint in &self.unilateral[group.constraints.clone()] {
                let e = n.values[constraint.restitution];
                if !(0.0..=1.0).contains(&e) {
                    let what = format!("a coefficient of restitution of {e}");
                    let path = format!("{}.restitution", group.path());
                    return Err(CompileError::new(path, what, "it is between 0, plastic, and 1, elastic"));
                }
                if let Some(Friction::Coulomb { fixed, kinetic }) = constraint.friction {
                    check_friction(&group.path(), n.values[fixed], n.values[kinetic])?;
                }
            }
        }
        Ok(())
    }

    fn check_joint_friction(&self, n: &BoundValues<f64>) -> Result<(), CompileError> {
        for friction in &self.joint_friction {
            let path = match friction.of {
                FrictionSource::Joint { joint, .. } => format!("joints.{}", self.joints[joint].name),
                FrictionSource::Unilateral(constraint) => self.groups[self.unilateral[constraint].group].path(),
            };
            check_friction(&path, n.values[friction.fixed], n.values[friction.kinetic])?;
        }
        Ok(())
    }
}

/// Refuses coefficients that no friction has.
fn check_friction(path: &str, fixed: f64, kinetic: f64) -> Result<(), CompileError> {
    if kinetic.is_nan() || kinetic < 0.0 {
        let what = format!("a coefficient of friction of {kinetic}");
        return Err(CompileError::new(format!("{path}.friction"), what, "it is 0 or more"));
    }
    if fixed < kinetic {
        let what = format!("friction at rest, {fixed}, is below that of sliding, {kinetic}");
        let hint = "the coefficient at rest is the larger one";
        return Err(CompileError::new(format!("{path}.static_friction"), what, hint));
    }
    Ok(())
}

impl Mechanism {
    /// Whether arrays are a state: parameters, time, coordinates and rates, finite and as many as the mechanism has.
    ///
    /// # Errors
    /// `wrong_size`, `not_finite`.
    pub fn check_state(&self, p: &[f64], t: f64, q: &[f64], u: &[f64]) -> Result<(), DynamicsError> {
        let coordinate = |i: usize| &self.coordinate(i).name;
        self.check_parameters(p)?;
        check_array("coordinate", q, self.freedom(), |i| coordinate(i).clone())?;
        check_array("rate", u, self.freedom(), |i| format!("rate of {}", coordinate(i)))?;
        check_array("time", &[t], 1, |_| "t".to_string())
    }

    /// Whether an array has a finite value of every parameter.
    ///
    /// # Errors
    /// `wrong_size`, `not_finite`.
    pub fn check_parameters(&self, p: &[f64]) -> Result<(), DynamicsError> {
        check_array("parameter", p, self.parameters.len(), |i| self.parameters[i].name.clone())
    }
}

fn check_array(
    what: &'static str,
    values: &[f64],
    wanted: usize,
    name: impl Fn(usize) -> String,
) -> Result<(), DynamicsError> {
    if values.len() != wanted {
        return Err(DynamicsError::WrongSize { what, wanted, given: values.len() });
    }
    match values.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(DynamicsError::NoFiniteNumber(name(i), values[i])),
        None => Ok(()),
    }
}

/// Mass, mass centre in the body's frame and inertia about it, of all pieces together (Steiner's theorem).
///
/// The centre of a body without mass is that of its first piece; ground has none.
fn mass_properties<S: Scalar>(body: &Body, bound: &[S]) -> (S, Vec2<S>, S) {
    let placed: Vec<(S, Vec2<S>, S)> = body
        .mass_elements
        .iter()
        .map(|piece| {
            let sizes: Vec<S> = piece.sizes.iter().map(|&s| bound[s]).collect();
            let (centre, gyration2) = piece.shape.geometry(&sizes);
            let at = Vec2 { x: bound[piece.at[0]], y: bound[piece.at[1]] };
            let mass = bound[piece.mass];
            let inertia = piece.inertia.map_or(mass * gyration2, |id| bound[id]);
            (mass, at + Turn::by(bound[piece.angle]).apply(centre), inertia)
        })
        .collect();
    let mut mass = S::zero();
    let mut moment = Vec2::zero();
    for (m, c, _) in &placed {
        mass += *m;
        moment += *c * *m;
    }
    let centre = match placed.first() {
        Some((_, first, _)) if mass.value() == 0.0 => *first,
        Some(_) => moment * (S::one() / mass),
        None => Vec2::zero(),
    };
    let mut inertia = S::zero();
    for (m, c, i) in &placed {
        let arm = *c - centre;
        inertia += *i + *m * arm.dot(arm);
    }
    (mass, centre, inertia)
}
