//! What a run does about events: land on them, let them act, go on.

use super::chatter::is_tie;
use super::dense::Segment;
use super::events::{Doubt, Kind, Mark, Unresolved};
use super::method::all_finite;
use super::outcome::{EventRecord, Outcome};
use super::probe::Probe;
use super::run::{ending, Runner};
use super::system::{After, Role, Spent, System};

/// Part of a step over which the tangent tells where a function is heading.
const GLANCE: f64 = 1e-3;
/// The least part of a time by which a step goes beyond a jump, and how that grows until it does.
const BEYOND: [f64; 2] = [4.0 * f64::EPSILON, 8.0];

impl Runner<'_> {
    /// The zeros on a segment that count, in order.
    pub(super) fn search(&mut self, segment: &Segment) -> Result<Vec<Mark>, Outcome> {
        if self.detector.is_idle() {
            return Ok(Vec::new());
        }
        let system = &mut *self.system.system;
        let marks = self.detector.search(system, segment).map_err(Outcome::DynamicsError)?;
        if self.detector.is_clear {
            return Ok(marks);
        }
        let (mut counting, mut y) = (Vec::new(), vec![0.0; self.now.y.len()]);
        for mark in marks {
            segment.at(mark.t, &mut y);
            if counts(system, &mark, &y)? {
                counting.push(mark);
            }
        }
        let mut armed = Vec::new();
        for each in std::mem::take(&mut self.detector.unresolved) {
            segment.at(each.t, &mut y);
            if system.armed(each.index, each.t, &y).map_err(Outcome::DynamicsError)? {
                armed.push(each);
            }
        }
        self.detector.unresolved = armed;
        Ok(counting)
    }

    /// Lets the events act that fall on the end of the run: a run that goes on from there does not see them.
    pub(super) fn act_at_end(&mut self) -> Result<(), Outcome> {
        if self.detector.is_idle() {
            return Ok(());
        }
        let (values, ahead) = (self.switch_values(0.0)?, self.ahead as i8);
        let glance = self.switch_values(GLANCE * self.steps.h)?;
        let later: Vec<f64> = values.iter().zip(glance).map(|(value, to)| value + (to - value) / GLANCE).collect();
        let (mut hits, system) = (Vec::new(), &mut *self.system.system);
        for (index, side, rtol) in self.detector.arriving(&values, &later) {
            let hit =
                Mark { t: self.now.t, index, kind: Kind::Crossing, direction: side * ahead, blur: 0.0, level: 0.0 };
            if system.switch(index).role != Role::Event || !counts(system, &hit, &self.now.y)? {
                continue;
            }
            if values[index].abs() <= self.detector.noise(index) {
                hits.push(hit);
            }
            let Some(on) = self.run.trajectory.segments.last() else { continue };
            if Probe::new(system, on, &[index]).depends_on_state(index, self.now.t).map_err(Outcome::DynamicsError)? {
                self.run.unresolved.push(Unresolved { t: self.now.t, index, doubt: Doubt::ComesBeforeEnd, rtol });
            }
        }
        if hits.is_empty() {
            Ok(())
        } else {
            self.let_act(&hits)
        }
    }

    /// Goes on from the zeros that events have used up where the motion comes from.
    pub(super) fn go_on_from_zeros(&mut self) -> Result<(), Outcome> {
        let spent = self.system.system.spent().to_vec();
        if !spent.is_empty() {
            let values = self.switch_values(0.0)?;
            spent.into_iter().for_each(|spent| self.detector.go_on(spent, values[spent.index], self.now.t));
        }
        Ok(())
    }

    /// The zeros that events have used up where the run ended.
    pub(super) fn spent(&mut self) -> Vec<Spent> {
        let mut spent = self.switch_values(0.0).map_or(vec![], |values| self.detector.spent(&values));
        spent.retain(|spent| self.system.system.switch(spent.index).role == Role::Event);
        spent
    }

    /// Steps to the first crossing of `marks`, lets it act and goes on from there.
    pub(super) fn go_to_event(&mut self, segment: Segment, marks: &[Mark]) -> Result<(), Outcome> {
        let crossings: Vec<Mark> = marks.iter().filter(|mark| mark.kind == Kind::Crossing).copied().collect();
        let first = *crossings.first().expect("the caller saw one");
        self.note_order(first, &crossings);
        let (mut hits, later): (Vec<Mark>, Vec<Mark>) =
            crossings.into_iter().partition(|mark| is_tie(mark.t, first.t, self.norm.time));
        let arrived = self.step_onto(&segment, first, later.first().map(|mark| mark.t))?;
        self.note_touches(&segment, marks, self.now.t);
        if !arrived {
            let values = self.switch_values(0.0)?;
            return self.look_around(&[], None, values);
        }
        self.note_end(&hits);
        self.note_unresolved(&segment, self.now.t);
        self.order_events(&mut hits);
        self.let_act(&hits)
    }

    /// Lets the events at the present act, and goes on from there.
    fn let_act(&mut self, hits: &[Mark]) -> Result<(), Outcome> {
        let is_event = |hit: &Mark| self.system.system.switch(hit.index).role == Role::Event;
        let landed = if hits.iter().any(is_event) { self.switch_values(0.0)? } else { vec![] };
        let (has_jumped, stop) = self.act(hits)?;
        let jumped_from = has_jumped.then_some(&landed[..]);
        if let Some(index) = stop {
            // A run that stops here is complete, whatever would come next.
            let _ = self.switch_values(0.0).and_then(|values| self.look_around(hits, jumped_from, values));
            return Err(Outcome::StoppedByEvent { index });
        }
        if has_jumped {
            self.stepper.reset();
            self.system.rate_of(&mut self.now).map_err(ending)?;
        }
        // Where the rate was found nothing needs to be solved again.
        let values = self.switch_values(0.0)?;
        if has_jumped && self.now.t != self.t_end {
            self.restart_steps();
            self.look_ahead();
        }
        self.look_around(hits, jumped_from, values)
    }

    /// Tells the watcher on which side of zero all functions go on, with their `values`; `landed` are those before a jump.
    fn look_around(&mut self, hits: &[Mark], landed: Option<&[f64]>, values: Vec<f64>) -> Result<(), Outcome> {
        let (now, ahead, has_jumped) = (self.now.t, self.ahead, landed.is_some());
        let sides = hits.iter().map(|hit| {
            Ok(match (self.system.system.switch(hit.index).role, landed) {
                (Role::Guard, _) => 1,
                // An action may have turned the motion, or moved the zero.
                (Role::Event, Some(landed)) => self.side(hit.index, landed[hit.index], values[hit.index])?,
                // A discontinuity has changed to the arm beyond.
                (Role::Event | Role::Discontinuity, _) => hit.direction * ahead as i8,
            })
        });
        let sides = sides.collect::<Result<Vec<i8>, Outcome>>()?;
        self.detector.stop_at(|t| ahead * (now - t) >= 0.0, values, has_jumped);
        hits.iter().zip(sides).for_each(|(hit, side)| self.detector.spend(hit.index, side, now));
        Ok(())
    }

    /// On which side of zero switching function `i` goes on, `landed` when it was at a zero and `value` after the jump there;
    /// 0 when it rests at the zero.
    fn side(&mut self, i: usize, landed: f64, value: f64) -> Result<i8, Outcome> {
        let moved = (value - landed).abs() > landed.abs() + self.detector.noise(i);
        if moved || self.detector.jumps(i, value) {
            return Ok(value.signum() as i8);
        }
        let rise = self.switch_values(GLANCE * self.steps.h)?[i] - value;
        Ok(i8::from(rise > 0.0) - i8::from(rise < 0.0))
    }

    /// Makes a step to a zero that was found on the dense output of a longer one, and once more when the function is
    /// not yet zero there; just beyond, where it jumps and never is. Answers whether it got there: not where another one vanishes
    /// clearly before, at `next` as the dense output tells it; which comes first is then found from there.
    fn step_onto(&mut self, segment: &Segment, hit: Mark, next: Option<f64>) -> Result<bool, Outcome> {
        let last = next.unwrap_or(segment.t1);
        let (t0, t1) = (segment.t0.min(last), segment.t0.max(last));
        let (mut t, mut arrives) = (hit.t, true);
        if t != self.now.t && self.jumps(segment, hit)? {
            return Ok(self.step_beyond(hit, last)? || next.is_none());
        }
        let mut on = self.system.system.is_crowded().then_some(segment);
        for _ in 0..3 {
            if t == self.now.t {
                return Ok(true);
            }
            let mut values = self.step_to(t, on)?;
            if on.is_some() && !self.holds_but_for(hit, &values) {
                on = None;
                values = self.step_to(t, on)?;
            }
            let system = &mut *self.system.system;
            let slope = Probe::new(system, segment, &[hit.index]).slope(hit.index, t, self.detector.noise(hit.index));
            let found = t - (values[hit.index] - hit.level) / slope.map_err(Outcome::DynamicsError)?;
            let better = found.clamp(t0, t1);
            arrives = next.is_none() || better != last || is_tie(found, last, self.norm.time);
            if better.is_nan() || (better - t).abs() <= 4.0 * f64::EPSILON * t.abs() {
                break;
            }
            t = better;
        }
        self.land(on)?;
        Ok(arrives)
    }

    /// Whether a function is no zero beside a time at which it changes its sign.
    fn jumps(&mut self, segment: &Segment, hit: Mark) -> Result<bool, Outcome> {
        let (least, latest) = (segment.t0.min(segment.t1), segment.t0.max(segment.t1));
        let beside = BEYOND[0] * (self.norm.time + hit.t.abs());
        let together = [hit.index];
        let mut probe = Probe::new(&mut *self.system.system, segment, &together);
        let mut value = |t: f64| probe.one(hit.index, t.clamp(least, latest)).map_err(Outcome::DynamicsError);
        let sides = [value(hit.t - beside)?, value(hit.t + beside)?];
        Ok(sides.iter().all(|&value| self.detector.jumps(hit.index, value)))
    }

    /// Makes a step to just beyond a jump that was found on the dense output of a longer one, or to the time `last`;
    /// answers whether it got beyond.
    fn step_beyond(&mut self, hit: Mark, last: f64) -> Result<bool, Outcome> {
        let (mut t, [mut part, growth]) = (hit.t, BEYOND);
        let is_beyond = loop {
            let values = self.step_to(t, None)?;
            let is_beyond = values[hit.index] * f64::from(hit.direction) * self.ahead > 0.0;
            if is_beyond || t == last {
                break is_beyond;
            }
            let (later, left) = (part * (self.norm.time + hit.t.abs()), (last - hit.t).abs());
            t = if later < left { hit.t + self.ahead * later } else { last };
            part *= growth;
        };
        self.land(None)?;
        Ok(is_beyond)
    }

    /// Makes a true step to `t`, which is known to be short enough, or goes there `on` the dense output of a longer one; returns the
    /// switching functions there.
    fn step_to(&mut self, t: f64, on: Option<&Segment>) -> Result<Vec<f64>, Outcome> {
        self.next.t = t;
        if let Some(longer) = on {
            longer.at(t, &mut self.next.y);
        } else {
            let attempt = self.stepper.attempt(&mut self.system, &self.now, &mut self.next, &self.norm);
            attempt.map_err(ending)?;
        }
        self.project()?.map_err(ending)?;
        let mut values = vec![0.0; self.system.system.switches()];
        self.system.system.switch_values(t, &self.next.y, &mut values).map_err(Outcome::DynamicsError)?;
        Ok(values)
    }

    /// Makes the end of that step the present.
    fn land(&mut self, on: Option<&Segment>) -> Result<(), Outcome> {
        let landed = on.map_or_else(|| self.segment(), |longer| Ok(longer.clone()))?;
        self.push(landed);
        Ok(())
    }

    /// Whether no guard but that of `hit` is below zero: else a dense output is not accurate enough there.
    fn holds_but_for(&self, hit: Mark, values: &[f64]) -> bool {
        let system = &*self.system.system;
        let is_below = |i: usize| {
            let spec = system.switch(i);
            spec.role == Role::Guard && values[i] < -spec.leeway
        };
        (0..values.len()).filter(|&i| values[i] < 0.0 && i != hit.index).all(|i| !is_below(i))
    }

    /// What the events at the present do: whether the state or the law changed, and which of them ends the run.
    fn act(&mut self, hits: &[Mark]) -> Result<(bool, Option<usize>), Outcome> {
        let (before, mut has_jumped, mut stop) = (self.now.y.clone(), false, None);
        for hit in hits {
            let system = &mut *self.system.system;
            let role = system.switch(hit.index).role;
            let is_dense = self.chatter.is_dense(hit.index, role, self.now.t);
            if is_dense && role != Role::Event {
                return Err(Outcome::Chatter { index: hit.index });
            }
            let after = system.act(hit.index, self.now.t, &mut self.now.y);
            let after = after.map_err(Outcome::DynamicsError)?;
            if is_dense && after != After::Continue {
                return Err(Outcome::Chatter { index: hit.index });
            }
            if is_dense {
                // What is only recorded does not end the motion.
                self.detector.mute(hit.index);
                self.run.unrecorded.push((hit.index, self.now.t));
                continue;
            }
            match role {
                Role::Discontinuity => self.run.discontinuities += 1,
                Role::Event => self.run.events.push(event_record(hit, self.now.t, &before)),
                Role::Guard => {}
            }
            has_jumped |= role != Role::Event || after == After::Restart;
            if after == After::Stop {
                stop.get_or_insert(hit.index);
            }
        }
        all_finite(&self.now.y).map_err(ending)?;
        Ok((has_jumped || self.now.y != before, stop))
    }

    /// Records the touches before time `until`.
    pub(super) fn note_touches(&mut self, segment: &Segment, marks: &[Mark], until: f64) {
        let start = segment.t0;
        for mark in marks.iter().filter(|mark| mark.kind == Kind::Touch) {
            if (mark.t - start).abs() <= (until - start).abs() {
                let mut y = vec![0.0; self.now.y.len()];
                segment.at(mark.t, &mut y);
                self.run.events.push(event_record(mark, mark.t, &y));
            }
        }
    }

    /// Records once what events do before time `until` by less than the motion is known.
    pub(super) fn note_unresolved(&mut self, segment: &Segment, until: f64) {
        for each in std::mem::take(&mut self.detector.unresolved) {
            let known = |other: &Unresolved| (other.index, other.doubt) == (each.index, each.doubt);
            if (each.t - segment.t0).abs() <= (until - segment.t0).abs() && !self.run.unresolved.iter().any(known) {
                self.run.unresolved.push(each);
            }
        }
    }

    /// Puts the events among what happens in one instant into the order of the model; the rest keeps its place.
    fn order_events(&self, hits: &mut [Mark]) {
        let is_event = |mark: &Mark| self.system.system.switch(mark.index).role == Role::Event;
        let mut events: Vec<Mark> = hits.iter().copied().filter(is_event).collect();
        events.sort_by_key(|mark| mark.index);
        hits.iter_mut().filter(|hit| is_event(hit)).zip(events).for_each(|(hit, event)| *hit = event);
    }

    /// Notes the events that act so soon after the first that they may come before it.
    fn note_order(&mut self, first: Mark, crossings: &[Mark]) {
        let system = &*self.system.system;
        let acts = |mark: &&Mark| system.switch(mark.index).acts && system.switch(first.index).acts;
        for mark in crossings.iter().filter(acts).filter(|mark| !is_tie(mark.t, first.t, self.norm.time)) {
            let (apart, blur) = ((mark.t - first.t).abs(), first.blur + mark.blur);
            if apart <= blur {
                let (t, doubt, rtol) = (first.t, Doubt::ComesBefore(mark.index), self.norm.rtol * apart / blur);
                self.detector.unresolved.push(Unresolved { t, index: first.index, doubt, rtol });
            }
        }
    }

    /// Notes what happens so soon before the end of the run that it may come after it.
    fn note_end(&mut self, hits: &[Mark]) {
        let (t, left) = (self.now.t, (self.t_end - self.now.t).abs());
        for hit in hits.iter().filter(|hit| left < hit.blur) {
            let (index, rtol) = (hit.index, self.norm.rtol * left / hit.blur);
            self.detector.unresolved.push(Unresolved { t, index, doubt: Doubt::ComesBeforeEnd, rtol });
        }
    }

    /// The switching functions at the present, or a time `h` further along its tangent.
    fn switch_values(&mut self, h: f64) -> Result<Vec<f64>, Outcome> {
        let system = &mut *self.system.system;
        let mut values = vec![0.0; system.switches()];
        let y: Vec<f64> = self.now.y.iter().zip(&self.now.dy).map(|(y, dy)| y + h * dy).collect();
        system.switch_values(self.now.t + h, &y, &mut values).map_err(Outcome::DynamicsError)?;
        Ok(values)
    }
}

/// Whether the zero of a switching function counts, at the state there.
fn counts(system: &mut dyn System, mark: &Mark, y: &[f64]) -> Result<bool, Outcome> {
    let spec = system.switch(mark.index);
    let is_passing = mark.kind == Kind::Touch && spec.role != Role::Event;
    let other_way = spec.direction * mark.direction < 0;
    Ok(!is_passing && !other_way && system.armed(mark.index, mark.t, y).map_err(Outcome::DynamicsError)?)
}

fn event_record(mark: &Mark, t: f64, y: &[f64]) -> EventRecord {
    EventRecord { t, y: y.to_vec(), index: mark.index, kind: mark.kind, direction: mark.direction }
}
