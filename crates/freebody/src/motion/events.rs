//! Finding where switching functions vanish within a step.

use super::dense::Segment;
use super::probe::{Node, Probe};
use super::roots::{chebyshev_points, SAMPLES};
use super::system::{DynamicsError, Role, Spent, System};

mod memory;
mod nodes;

use memory::{beyond, Memory, Place};

/// A value is zero when it is below this many times the size of its function.
const NOISE: f64 = 4.0 * f64::EPSILON;
/// An extremum touches zero when it is below this many times the size of its function,
const TOUCH: f64 = 1e-12;
/// or below this many tolerances of the way that its function has come since it was zero: the motion is known no nearer.
const GRAZE: f64 = 30.0;
/// The same of an event that acts: whether it does must not depend on more than the tolerance asked for.
const GRAZE_OF_ACTION: f64 = 1.0;
/// Tolerances of that way by which an event that acts must clear zero, and of its instant by which another must be apart,
/// to be sure of what it does.
const DOUBT: f64 = 10.0;
/// Mean over swing from which a polynomial cannot reach zero: |Tₖ| ≤ 1, and a little for the rounding of its sums.
const CLEAR_OF_ZERO: f64 = 1.001;
/// Part of a step within which zeros may be one instant.
const TOGETHER: f64 = 1e-9;
/// Size of a value, over that of its function, at a change of sign that is no zero: there the function jumps.
const JUMP: f64 = 1e-6;
/// How a switching function met zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It changed its sign.
    Crossing,
    /// It has an extremum that is zero; nothing was done about it.
    Touch,
    /// None: it happened at the start, before anything moved.
    Opening,
}

/// A zero of a switching function on a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mark {
    pub t: f64,
    pub index: usize,
    pub kind: Kind,
    /// +1 where the function rises as time grows, −1 where it falls, 0 for a touch.
    pub direction: i8,
    /// How far the time of an event is not sure, s; 0 where time alone decides.
    pub blur: f64,
    /// The value there: 0 but for a guard that began at zero.
    pub level: f64,
}

/// What is not sure of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doubt {
    /// Whether it acts.
    Acts,
    /// Whether it comes before another.
    ComesBefore(usize),
    /// Whether it comes before the end of the run.
    ComesBeforeEnd,
}

/// What an event does by less than the motion is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unresolved {
    /// When.
    pub t: f64,
    /// The event.
    pub index: usize,
    /// What is not sure of it.
    pub doubt: Doubt,
    /// The relative tolerance that may tell.
    pub rtol: f64,
}

/// Which functions the samples are of.
fn functions<const N: usize>(samples: &[(usize, [f64; N])]) -> Vec<usize> {
    samples.iter().map(|(i, _)| *i).collect()
}

/// Watches the switching functions along a run.
///
/// A zero where the run starts does not count: the first value clearly away from zero tells on
/// which side the function is. Nor does a zero where an event has just acted.
pub(super) struct EventDetector {
    memory: Vec<Memory>,
    points: [f64; SAMPLES],
    /// Relative tolerance of the motion.
    rtol: f64,
    /// What acts on the segment last searched, or does not, and is not sure.
    pub unresolved: Vec<Unresolved>,
    /// Whether all functions are bounded away from zero on the segment last searched.
    pub is_clear: bool,
    bounds: Vec<[f64; 2]>,
    /// The values at the present, and at the end of the segment last searched, where they are known.
    here: Option<Vec<f64>>,
    ahead: Option<Vec<f64>>,
}

impl EventDetector {
    /// Watches the functions of a system that is followed at a relative tolerance; 0 where that is not known.
    pub fn new(system: &dyn System, rtol: f64) -> Self {
        let memory = |i| {
            let spec = system.switch(i);
            let is_guard = spec.role == Role::Guard;
            let now = Place { side: spec.side, reach: 0.0, grazes: None, last_touch: f64::NAN, begins: is_guard };
            let graze = match spec.role {
                Role::Guard => 0.0,
                _ if spec.acts => GRAZE_OF_ACTION * rtol,
                _ => GRAZE * rtol,
            };
            let blur = if spec.role == Role::Event { DOUBT * rtol } else { 0.0 };
            let doubt = if spec.acts { blur } else { 0.0 };
            let (size, leeway) = (spec.scale, spec.leeway);
            Memory { now, ahead: now, size, is_spent: false, is_muted: false, is_guard, leeway, graze, doubt, blur }
        };
        let memory: Vec<Memory> = (0..system.switches()).map(memory).collect();
        let bounds = vec![[0.0; 2]; memory.len()];
        let points = chebyshev_points();
        Self { memory, points, rtol, unresolved: vec![], is_clear: false, bounds, here: None, ahead: None }
    }

    pub fn is_idle(&self) -> bool {
        self.memory.is_empty()
    }

    /// All zeros on a segment, in the order of the run.
    pub fn search(&mut self, system: &mut dyn System, on: &Segment) -> Result<Vec<Mark>, DynamicsError> {
        self.is_clear = system.switch_bounds(on, &mut self.bounds) && self.stays_clear();
        let here = self.here.take();
        self.ahead = None;
        if self.is_clear {
            return Ok(vec![]);
        }
        // First, while the solution of the rate at the end is there.
        let mut end = vec![0.0; self.memory.len()];
        system.switch_values(on.t1, on.end(), &mut end)?;
        let watched = match &here {
            Some(here) => system.watched(on, here),
            None => (0..self.memory.len()).collect(),
        };
        let (of_forces, others): (Vec<usize>, Vec<usize>) = watched.iter().partition(|&&i| system.switch(i).of_forces);
        let mut probe = Probe::new(system, on, &of_forces);
        probe.know(on.t1, &end);
        self.ahead = Some(end);
        if let Some(here) = here {
            self.memory.iter_mut().zip(&here).for_each(|(memory, value)| memory.stay(value.abs()));
            probe.know(on.t0, &here);
        }
        self.unresolved.clear();
        let mut marks = Vec::new();
        for (i, values) in self.coming(&mut probe, &of_forces, &others)? {
            let until = self.decided(i, &marks, on);
            let nodes = self.nodes(i, &values, until, &mut probe)?;
            self.walk(i, &nodes, &mut probe, &mut marks)?;
        }
        marks.sort_by(|a, b| (a.t - on.t0).abs().total_cmp(&(b.t - on.t0).abs()));
        Ok(marks)
    }

    /// Samples of the functions that do not clearly stay away from zero: those first that are beyond it first. Forces, which cost a
    /// solution each time and are smooth, are sampled at few points first where events crowd: steps are short there.
    fn coming(
        &mut self,
        probe: &mut Probe,
        of_forces: &[usize],
        others: &[usize],
    ) -> Result<Vec<(usize, [f64; SAMPLES])>, DynamicsError> {
        let mut unclear = of_forces.to_vec();
        if probe.system.is_crowded() {
            unclear = functions(&self.samples::<3>(probe, &unclear)?);
            unclear = functions(&self.samples::<5>(probe, &unclear)?);
        }
        let mut coming = self.samples::<SAMPLES>(probe, &unclear)?;
        coming.extend(self.samples::<SAMPLES>(probe, others)?);
        coming.sort_by_key(|(i, values)| {
            let is_beyond = |value: &f64| value * f64::from(self.memory[*i].now.side) < 0.0;
            (values.iter().position(is_beyond).unwrap_or(SAMPLES), *i)
        });
        Ok(coming)
    }

    /// Samples, at N of the points, of those of some functions that do not clearly stay away from zero.
    fn samples<const N: usize>(
        &mut self,
        probe: &mut Probe,
        of: &[usize],
    ) -> Result<Vec<(usize, [f64; N])>, DynamicsError> {
        if of.is_empty() {
            return Ok(vec![]);
        }
        let mut samples: Vec<(usize, [f64; N])> = of.iter().map(|&i| (i, [0.0; N])).collect();
        for j in 0..N {
            let t = probe.time(self.points[j * (SAMPLES - 1) / (N - 1)]);
            let values = probe.values(of, t)?;
            samples.iter_mut().for_each(|(i, samples)| samples[j] = values[*i]);
        }
        samples.retain(|(i, values)| {
            let (spec, memory) = (probe.system.switch(*i), &mut self.memory[*i]);
            memory.learn(spec, self.rtol, values);
            !memory.is_muted && !memory.stays_away(values)
        });
        Ok(samples)
    }

    /// The time up to which function `i` must be searched. A guard need not be searched beyond the second fall of a guard through zero
    /// found so far: the first is what acts, and what comes next is known by then.
    fn decided(&self, i: usize, marks: &[Mark], on: &Segment) -> f64 {
        let length = on.t1 - on.t0;
        let never = f64::INFINITY.copysign(length);
        let falls =
            |mark: &&Mark| mark.kind == Kind::Crossing && mark.direction < 0 && self.memory[mark.index].is_guard;
        let earlier = |a: f64, b: f64| if (b - a) * length < 0.0 { b } else { a };
        let times = || marks.iter().filter(|mark| self.memory[i].is_guard && falls(mark)).map(|mark| mark.t);
        let first = times().fold(never, earlier);
        times().filter(|&t| (t - first).abs() > TOGETHER * length.abs()).fold(never, earlier)
    }

    /// Whether the bounds keep every function where it is; if so, they are what is known of it.
    fn stays_clear(&mut self) -> bool {
        let mut all = self.memory.iter().zip(&self.bounds);
        if !all.all(|(memory, &bound)| memory.is_muted || memory.is_kept_away(bound)) {
            return false;
        }
        self.unresolved.clear();
        for (memory, [value, _]) in self.memory.iter_mut().zip(&self.bounds) {
            memory.size = memory.size.max(value.abs());
            memory.stay(value.abs());
        }
        true
    }

    fn walk(
        &mut self,
        i: usize,
        nodes: &[Node],
        probe: &mut Probe,
        marks: &mut Vec<Mark>,
    ) -> Result<(), DynamicsError> {
        let memory = &mut self.memory[i];
        let (mut place, mut last, end) = (memory.now, nodes[0], probe.segment.t1);
        let inside = nodes.iter().filter(|node| probe.ahead() * (node.t - end) <= 0.0).count();
        for k in usize::from(memory.is_spent)..inside {
            let (node, near) = (nodes[k], memory.near(place));
            let may_touch = place.reach > near;
            let unsure = |turn: &Node, t: f64| {
                let part = turn.value.abs() / place.reach;
                let unsure = Unresolved { t, index: i, doubt: Doubt::Acts, rtol: part / DOUBT };
                (memory.doubt > 0.0 && part <= memory.doubt).then_some(unsure)
            };
            if node.is_extremum {
                self.unresolved.extend(unsure(&node, node.t));
            }
            // What is clearly across, by the tolerance, crosses twice.
            let clear = (memory.graze * place.reach).max(NOISE * memory.size);
            let turns = |node: &Node| {
                let is_near = node.is_extremum && node.value.abs() <= near;
                may_touch && is_near && beyond(node.value, clear) != -place.side
            };
            if turns(&node) && place.side != 0 && place.grazes != Some(true) {
                marks.push(Mark { t: node.t, index: i, kind: Kind::Touch, direction: 0, blur: 0.0, level: 0.0 });
                (place.grazes, place.last_touch) = (Some(true), node.t);
            }
            let noise = match place.grazes {
                _ if place.begins => memory.leeway.max(NOISE * memory.size),
                Some(_) => near,
                None => NOISE * memory.size,
            };
            let sign = beyond(node.value, noise);
            if sign != 0 && place.side == -sign && place.grazes.is_none() {
                // It turns back before it is clearly on the other side.
                place.grazes =
                    nodes[k..].iter().find(|node| node.is_extremum).filter(|node| turns(node)).map(|_| false);
            }
            if sign == 0 || place.grazes.is_some() && node.value.abs() <= near {
                // Too small to tell, but the zero lies beyond it.
                last = if node.value * f64::from(place.side) > 0.0 { node } else { last };
                continue;
            }
            if place.side == -sign {
                // What holds may start within its round-off, or within its leeway. Where it has just acted it may stay there for a
                // while: it falls where it leaves that.
                let has_stayed = memory.is_spent && last.value.abs() <= noise;
                let is_from_zero = memory.is_guard && (place.begins || has_stayed);
                let shifts = match memory.is_guard {
                    true if is_from_zero => [noise; 2],
                    true => [0.0, NOISE * memory.size],
                    false => [0.0; 2],
                };
                let t = probe.root(i, last, node, shifts.map(|shift| f64::from(place.side) * shift))?;
                let direction = sign * probe.ahead() as i8;
                let turn = nodes[k..].iter().find(|node| node.is_extremum);
                self.unresolved.extend(turn.and_then(|turn| unsure(turn, t)));
                let slope = ((node.value - last.value) / (node.t - last.t)).abs();
                let blur = match memory.blur > 0.0 && probe.depends_on_state(i, t)? {
                    true => memory.blur * place.reach / slope,
                    false => 0.0,
                };
                let level = if place.begins { -noise } else { 0.0 };
                marks.push(Mark { t, index: i, kind: Kind::Crossing, direction, blur, level });
                place.reach = 0.0;
            } else if place.grazes == Some(false) {
                marks.push(Mark { t: last.t, index: i, kind: Kind::Touch, direction: 0, blur: 0.0, level: 0.0 });
                place.last_touch = last.t;
            }
            let reach = place.reach.max(node.value.abs());
            place = Place { side: sign, reach, grazes: None, begins: false, ..place };
            last = node;
        }
        memory.ahead = place;
        Ok(())
    }

    /// The segment last searched was passed to its end.
    pub fn pass(&mut self) {
        self.here = self.ahead.take();
        for memory in &mut self.memory {
            memory.now = memory.ahead;
            memory.is_spent = false;
        }
    }

    /// Functions that come to zero where the run ends, no farther than they are known, with the side that they go to and the
    /// tolerance that may tell on which they are there; `values` there, and those a step `later` as they go.
    pub fn arriving<'a>(&'a self, values: &'a [f64], later: &'a [f64]) -> impl Iterator<Item = (usize, i8, f64)> + 'a {
        self.memory.iter().enumerate().filter_map(|(i, memory)| {
            let (left, side, reach) = (values[i].abs(), memory.now.side, memory.now.reach);
            let is_near = !memory.is_spent && !memory.is_muted && left <= self.noise(i).max(memory.blur * reach);
            (is_near && later[i] * f64::from(side) < 0.0).then_some((i, -side, left / (DOUBT * reach)))
        })
    }

    /// The run stopped at a zero, beyond the times that `passed`; `values` are those of all functions there. A sign that
    /// an action changed is no event: that side is found anew.
    pub fn stop_at(&mut self, passed: impl Fn(f64) -> bool, values: Vec<f64>, has_jumped: bool) {
        for (memory, &value) in self.memory.iter_mut().zip(&values) {
            memory.is_spent = false;
            let (mut place, touch, near) = (memory.now, memory.ahead.last_touch, memory.near(memory.now));
            let at_touch = !has_jumped && value.abs() <= near;
            if touch != place.last_touch && passed(touch) {
                (place.grazes, place.last_touch) = (at_touch.then_some(true), touch);
            }
            place.side = match memory.sign(value) {
                _ if memory.is_guard => 1,
                0 => place.side,
                _ if at_touch => place.side,
                sign if has_jumped && sign != place.side => 0,
                sign => sign,
            };
            place.begins |= has_jumped && memory.is_guard;
            place.reach = place.reach.max(value.abs());
            memory.now = place;
        }
        self.here = Some(values);
    }

    /// Size below which a value of function `i` is zero.
    pub fn noise(&self, i: usize) -> f64 {
        NOISE * self.memory[i].size
    }

    /// Whether a value of function `i` where it changes its sign is no zero.
    pub fn jumps(&self, i: usize, value: f64) -> bool {
        value.abs() > JUMP * self.memory[i].size
    }

    /// Function `i` is not watched any more.
    pub fn mute(&mut self, i: usize) {
        self.memory[i].is_muted = true;
    }

    /// The zeros that are used up where the run ended, of functions with these `values` there.
    pub fn spent(&self, values: &[f64]) -> Vec<Spent> {
        let spent = |(index, memory): (usize, &Memory)| {
            let (side, value, size) = (memory.now.side, values[index], memory.size);
            memory.is_spent.then_some(Spent { index, side, value, size })
        };
        self.memory.iter().enumerate().filter_map(spent).collect()
    }

    /// Goes on at `t` from a zero that was used up, unless the function has another `value` there by now.
    pub fn go_on(&mut self, spent: Spent, value: f64, t: f64) {
        let memory = &mut self.memory[spent.index];
        memory.size = memory.size.max(spent.size);
        if (value - spent.value).abs() <= TOUCH * memory.size {
            self.spend(spent.index, spent.side, t);
        }
    }

    /// Function `i` acted at `t`, where the run stopped, and is now heading for `side`: its zero there is used up.
    pub fn spend(&mut self, i: usize, side: i8, t: f64) {
        let memory = &mut self.memory[i];
        memory.is_spent = true;
        memory.now = Place { side, reach: 0.0, grazes: None, last_touch: t, ..memory.now };
    }
}
