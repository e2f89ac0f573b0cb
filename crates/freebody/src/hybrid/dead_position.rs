//! Dead positions: where motions drive a mechanism on to what its loops, or its strings, do not reach. Towards there
//! speeds grow without bound.

use super::HybridSystem;
use crate::dynamics::{DynamicsError, Source};
use crate::gauges::{ModelExpr, ModelVariable};
use crate::mechanism::{Drive, Level, Mechanism};

/// Independence of the closing rows below which a dead position may be near.
const NEAR: f64 = 1e-2;
/// Independence of the closing rows below which accelerations have no digit: the error of a gap of round-off over its cube.
const LOST: f64 = 1e-5;
/// Steps in a row that end there, by which a mechanism stays there; one that passes it makes one or two.
const STAYS: usize = 3;
/// Part of the time in which the mechanism moves its own length, after which a dead position is not near: beside one the
/// independence is as the square root of that part.
const SOON: f64 = 1e-2;
/// Length of a segment of a taut string, over the characteristic length, below which it may be drawn in.
const SHORT: f64 = 1e-3;
/// Part of the time in which the mechanism moves its own length, over which a short segment is watched: short even beside
/// a turn of the segment.
const GLANCE: f64 = 1e-11;
/// Times that are left after which loops that pass a singular configuration are well on its other side.
const BEYOND: f64 = 4.0;

impl HybridSystem<'_> {
    /// Refuses a state, that of the last projection, from which the motions lead to where loops cannot close, or a
    /// string has no length, a moment later.
    ///
    /// # Errors
    /// `dead_position`, `string_zero_length`.
    pub(super) fn check_dead_position(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        if !self.workspace.at().drives().any(|(_, drive)| drive.is_motion()) {
            return Ok(());
        }
        if let Some((l, left)) = self.shortening_string(t, y) {
            let q = y[..self.workspace.m.freedom()].to_vec();
            if self.close_ahead(t, y, BEYOND * left, q).is_err() {
                return Err(self.zero_length_error(l));
            }
        }
        if self.independence < NEAR {
            self.check_loops_ahead(t, y)?;
        }
        self.singular_steps = if self.independence < LOST { self.singular_steps + 1 } else { 0 };
        if self.singular_steps >= STAYS {
            return Err(self.ended(t, y, 0.0, None, DynamicsError::SingularPosition));
        }
        self.place(t, y);
        Ok(())
    }

    /// Near a dead position the square of the independence falls evenly to zero; a configuration that is passed leaves
    /// the loops closed on its other side.
    fn check_loops_ahead(&mut self, t: f64, y: &[f64]) -> Result<(), DynamicsError> {
        let n = self.workspace.m.freedom();
        let (dt, [now, next]) = self.independence_ahead(t, y);
        let left = now * now * dt / (now * now - next * next);
        if !(left > 0.0 && left * self.speed < SOON * self.workspace.length) {
            return Ok(());
        }
        let ahead = (0..n).map(|i| y[i] + BEYOND * left * y[n + i]).collect();
        let Err(open) = self.close_ahead(t, y, BEYOND * left, ahead) else { return Ok(()) };
        let opened = match open {
            DynamicsError::LoopOpened(name, _, item) if item.starts_with("joints.") => Some(name),
            _ => None,
        };
        Err(self.ended(t, y, left, opened, DynamicsError::DeadPosition))
    }

    /// The error of a loop, with where a motion brings it in the time that is `left`, and with that motion.
    fn ended(
        &mut self,
        t: f64,
        y: &[f64],
        left: f64,
        joint: Option<String>,
        error: fn(String, String, String) -> DynamicsError,
    ) -> DynamicsError {
        self.place(t, y);
        let m = self.workspace.m;
        let (index, drive) =
            self.workspace.at().drives().find(|(_, drive)| drive.is_motion()).expect("the caller saw one");
        let value = self.gauge_ahead(drive, left);
        let value = if m.turns(&drive.of) { format!("{:.1}°", value.to_degrees()) } else { format!("{value:.4} m") };
        let place = format!("{} = {value}", name_of(m, drive));
        let first = m.closures.first().map(|&joint| m.joints[joint].name.clone());
        let name = joint.or(first).unwrap_or_else(|| drive.name.clone());
        error(name, place, Source::Drive(index).path(m))
    }

    /// Closes the loops as they would be a time `later`, from coordinates near there: what motions give is where they say, or
    /// where the rates lead that they give.
    fn close_ahead(&mut self, t: f64, y: &[f64], later: f64, mut q: Vec<f64>) -> Result<f64, DynamicsError> {
        self.place(t, y);
        let moving =
            self.workspace.at().drives().filter(|(_, drive)| drive.is_motion() && drive.level != Level::Position);
        let held: Vec<_> = moving.map(|(_, drive)| (drive.of.clone(), self.gauge_ahead(drive, later))).collect();
        let at_rest = vec![0.0; q.len()];
        self.workspace.project_positions_with(&self.mode, t + later, &mut q, &at_rest, &held)
    }

    /// The gauge of a motion a time `later`, as it goes at the present state.
    fn gauge_ahead(&self, drive: &Drive, later: f64) -> f64 {
        let now = self.workspace.target_row(&drive.of, 0.0, 0.0);
        now.value.unwrap_or(0.0) + later * now.rate.unwrap_or(0.0)
    }

    /// A taut string with a segment that is short and shortens, and in what time it would have no length.
    fn shortening_string(&mut self, t: f64, y: &[f64]) -> Option<(usize, f64)> {
        let (short, n) = (SHORT * self.workspace.length, self.workspace.m.freedom());
        let l = self.taut_segments.iter().position(|segments| segments.iter().any(|s| s.norm() < short))?;
        let dt = GLANCE * self.workspace.length / self.speed;
        let later: Vec<f64> = (0..y.len()).map(|i| if i < n { y[i] + dt * y[n + i] } else { y[i] }).collect();
        self.place(t + dt, &later);
        let lengths = self.taut_segments[l].iter().zip(self.taut_segments(l)).map(|(a, b)| [a.norm(), b.norm()]);
        let left =
            lengths.filter(|[a, b]| b < a && *a < short).map(|[a, b]| a * dt / (a - b)).fold(f64::INFINITY, f64::min);
        left.is_finite().then_some((l, left))
    }
}

/// The coordinate that a motion gives, or its own name.
fn name_of<'m>(m: &'m Mechanism, drive: &'m Drive) -> &'m str {
    let coordinate = drive.of.variables().find_map(|variable| match variable {
        ModelVariable::Coordinate(joint, k) if drive.of == ModelExpr::variable(variable.clone()) => Some((*joint, *k)),
        _ => None,
    });
    coordinate.map_or(&drive.name, |(joint, k)| &m.joints[joint].coordinates[k].name)
}
