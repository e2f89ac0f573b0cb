//! Gaps at one state: their features and borders, which are closed, and parts put in place.

use super::projection::OPEN;
use super::rows::{closing_rows, joint_rows};
use super::{compliant_force, DynamicsError, Source, Workspace};
use crate::bound_values::BoundValues;
use crate::joints::Joint as _;
use crate::kinematics::{Config, MotionView, Poses as _, Travel, TravelView};
use crate::mechanism::{Gap, Group, Mechanism, Part, Profile};
use crate::mode::{Border, ContactMode, ContactState, Feature, Mode};
use crate::plane::{vec2, Turn};
use crate::scalar::Ball;

/// Depth, over the characteristic length, to which a unilateral constraint may be violated at the start.
const SHALLOW: f64 = 1e-8;
/// Depth, over the characteristic length, to which a unilateral constraint may be violated on the way.
const GRAZE: f64 = 1e-9;
/// Difference, over the characteristic length, of what features tell of a gap up to which it is one.
const ONE_GAP: f64 = 1e-10;
/// Distance, over the characteristic length, up to which two corners meet, whichever of them tells it.
const MEET: f64 = 1e-9;
/// Gap, over the size of the mechanism or the reach of its bodies, below which the small offsets of its formula, as of sides that are set back, may count.
const AS_GOOD_AS_CLOSED: f64 = 1e-6;
/// Distance, over the characteristic length, from which bodies count as apart without a look at their outlines.
const CLEARLY_APART: f64 = 0.1;

/// Of every contact, how far its surfaces reach from the joint origins of its two bodies, m; no bound for stops and
/// strings.
pub(super) fn reaches(m: &Mechanism, n: &BoundValues) -> Vec<[f64; 2]> {
    let none = |group: &Group| if group.word == "contact" { 0.0 } else { f64::INFINITY };
    let mut reaches: Vec<[f64; 2]> = m.groups.iter().map(|group| [none(group); 2]).collect();
    for constraint in &m.unilateral {
        let Gap::ContactPair(touch) = &constraint.gap else { continue };
        for (body, far) in touch.bodies(m).into_iter().zip(touch.extents(n)) {
            let end = usize::from(m.groups[constraint.group].ends[0] != body);
            let reach = &mut reaches[constraint.group][end];
            *reach = reach.max(far);
        }
    }
    reaches
}

impl Mechanism {
    /// The name of a part.
    pub fn name_of(&self, part: Part) -> &str {
        match part {
            Part::Joint(j) => {
                let follower = self.curve_followers.iter().find(|follower| follower.released_joint == j);
                &self.joints[follower.map_or(j, |follower| follower.joint)].name
            }
            Part::Drive(d) => &self.drives[d].name,
            Part::Force(f) => &self.forces[f].name,
            Part::Group(g) => &self.groups[g].name,
        }
    }
}

impl Workspace<'_> {
    /// The present mode with what only the start tells of unilateral constraints: how strings are attached, on which
    /// feature every gap is, and which springs are pressed.
    ///
    /// # Errors
    /// `penetration`, where a unilateral constraint is violated.
    pub fn start_contacts(&mut self) -> Result<Mode, DynamicsError> {
        let mut mode = self.mode().clone();
        for l in 0..self.m.unilateral.len() {
            mode.contacts_mut()[l].feature = self.initial_feature(l);
        }
        self.enter(&mode);
        for l in 0..self.m.unilateral.len() {
            let (gap, is_off) = (self.constraint_gap(l), mode.contacts[l].mode == ContactMode::Off);
            if self.m.unilateral[l].soft.is_some() {
                let pressed = gap < 0.0 && compliant_force(self.at(), l) > 0.0;
                mode.contacts_mut()[l].mode = match (is_off, pressed) {
                    (true, _) => ContactMode::Off,
                    (_, true) => ContactMode::Compliant,
                    _ => ContactMode::Open,
                };
                continue;
            }
            if !is_off && gap * self.lever(l) < -SHALLOW * self.length {
                let group = &self.m.groups[self.m.unilateral[l].group];
                let hint = match group.word {
                    "contact" => {
                        "hold a point at its place, as by `points: {box.A: [0, 0]}` under `initial`; \
                         a line is free on its left, as one goes along it"
                    }
                    _ => "move the parts, or change its size",
                };
                return Err(DynamicsError::Penetration(self.violation(l, gap) + " at the start", hint, group.path()));
            }
        }
        Ok(mode)
    }

    /// A sentence for each contact of a point that is just on a straight line while the mass centre of its body is
    /// behind it: as where the line goes the wrong way round, which no gap tells.
    pub(crate) fn behind_lines(&self) -> Vec<String> {
        let (m, at) = (self.m, self.at());
        let behind = m.unilateral.iter().enumerate().filter_map(|(l, constraint)| {
            let Gap::ContactPair(pair) = &constraint.gap else { return None };
            let (Profile::Line(line), None) = (&pair.against, pair.disk.radius) else { return None };
            let (body, surface) = (m.body_of(pair.disk.centre), at.k.pose[m.body_of(line.site)]);
            let pose = at.k.pose[body];
            let along = Turn::by(surface.turn.angle + at.n.values[line.angle]).apply(vec2(1.0, 0.0));
            let centre = pose.at + pose.turn.apply(at.n.centre[body]);
            let height = along.cross(centre - surface.at - surface.turn.apply(at.n.arms[line.site]));
            let touches = self.mode().contacts[l].mode != ContactMode::Off
                && self.constraint_gap(l).abs() < SHALLOW * self.length;
            (body > 0 && touches && height < -SHALLOW * self.length).then(|| {
                let (contact, name) = (&m.groups[constraint.group].name, &m.bodies[body].name);
                format!(
                    "{contact}: `{name}` touches the line, and its mass centre is behind it: a line is free on its \
                     left, as one goes along it; where that is the wrong side, turn it by 180 deg"
                )
            })
        });
        behind.collect()
    }

    /// Refuses a state in which a unilateral constraint without a spring is violated: what should have closed it was
    /// missed.
    ///
    /// # Errors
    /// `penetration`.
    pub fn check_gaps(&self, t: f64) -> Result<(), DynamicsError> {
        let apart = self.apart();
        for (l, constraint) in self.m.unilateral.iter().enumerate() {
            let mode = self.mode().contacts[l].mode;
            if mode == ContactMode::Off
                || constraint.soft.is_some()
                || (mode == ContactMode::Open && apart[constraint.group].is_some())
            {
                continue;
            }
            let gap = self.open_gap(l);
            if gap * self.lever(l) < -GRAZE * self.length {
                return Err(DynamicsError::Penetration(
                    format!("{} at t = {t:.12} s", self.violation(l, gap)),
                    "choose a shorter longest step, `max_step`",
                    self.m.groups[constraint.group].path(),
                ));
            }
        }
        Ok(())
    }

    /// By how much a unilateral constraint is violated, to three digits.
    fn violation(&self, l: usize, gap: f64) -> String {
        let group = &self.m.groups[self.m.unilateral[l].group];
        let (verb, unit) = match group.word {
            "string" => ("stretched", "m"),
            _ => ("violated", if self.m.unilateral[l].gap.turns(self.m) { "rad" } else { "m" }),
        };
        let size = format!("{:.2e}", -gap).parse().unwrap_or(-gap);
        format!("the {} `{}` is {verb} by {size} {unit}", group.word, group.name)
    }

    /// The feature of a gap as the state alone gives it.
    fn initial_feature(&self, l: usize) -> Feature {
        let constraint = &self.m.unilateral[l];
        let mut feature = Feature::default();
        if let Gap::Cable(cable) = &constraint.gap {
            feature.phase = cable.initial_winding(self.m, &self.at());
        }
        constraint.gap.feature(self.m, &self.at(), feature)
    }

    /// The gap of a unilateral constraint at the present state, on its feature.
    pub fn constraint_gap(&self, l: usize) -> f64 {
        self.gap_on(l, self.mode().contacts[l].feature)
    }

    fn gap_on(&self, l: usize, feature: Feature) -> f64 {
        self.m.unilateral[l].gap.gap(self.m, self.mode(), &self.at(), feature)
    }

    /// The gap of an open unilateral constraint at the present state, on whichever feature it now is.
    pub fn open_gap(&self, l: usize) -> f64 {
        let (gap, feature) = (&self.m.unilateral[l].gap, self.mode().contacts[l].feature);
        self.gap_on(l, gap.feature(self.m, &self.at(), feature))
    }

    /// The gap of an open unilateral constraint, where it can close as it now is; None too where a unilateral
    /// constraint that is closed keeps it off.
    pub fn closing_gap(&self, l: usize) -> Option<f64> {
        let gap = &self.m.unilateral[l].gap;
        let feature = gap.feature(self.m, &self.at(), self.mode().contacts[l].feature);
        let gap_here = gap.can_close(feature.index).then(|| self.gap_on(l, feature));
        gap_here.filter(|gap_here| gap_here.abs() > ONE_GAP * self.length || !self.is_doubled(l, feature))
    }

    /// Whether a corner is on a corner, so that its gap may as well be expressed by the other, and the other is closed.
    fn is_doubled(&self, l: usize, feature: Feature) -> bool {
        let (constraint, at) = (&self.m.unilateral[l], self.at());
        let place =
            |l: usize, feature: Feature| self.m.unilateral[l].gap.contact(self.m, &at, feature).map(|c| c.point);
        let other =
            |border: &Border| !constraint.gap.can_close(border.beyond) && border.value.abs() <= MEET * self.length;
        let Some(here) = place(l, feature).filter(|_| constraint.gap.borders(self.m, &at, feature).iter().any(other))
        else {
            return false;
        };
        let closed = |&by: &usize| by != l && self.mode().contacts[by].mode.touches();
        let by = self.m.groups[constraint.group].constraints.clone().filter(closed);
        let mut places = by.filter_map(|by| place(by, self.mode().contacts[by].feature));
        places.any(|there| (there - here).norm() <= MEET * self.length)
    }

    /// Of every contact, stop and string a distance that its two bodies keep at least, m, where they are clearly apart:
    /// then none of its unilateral constraints is near.
    pub fn apart(&self) -> Vec<Option<f64>> {
        let clearly = |g: usize| Some(self.distance_kept(g)).filter(|&least| least > CLEARLY_APART * self.length);
        (0..self.m.groups.len()).map(clearly).collect()
    }

    /// A distance that the two bodies of a contact keep at least, m; below 0 where it is not known.
    fn distance_kept(&self, g: usize) -> f64 {
        let [a, b] = self.m.groups[g].ends.map(|body| self.k.pose[body].at);
        (a - b).norm() - self.reaches[g][0] - self.reaches[g][1]
    }

    /// The gap of an open unilateral constraint, or a distance that keeps it open, with how far that goes at most; None
    /// where it has no bound.
    pub fn gap_bound(&self, l: usize, travel: &Travel) -> Option<Ball> {
        let (constraint, view) = (&self.m.unilateral[l], TravelView { at: self.at(), travel });
        let [a, b] = self.m.groups[constraint.group].ends;
        let apart = Ball { mid: self.distance_kept(constraint.group), radius: travel.way(a) + travel.way(b) };
        match &constraint.gap {
            _ if apart.mid > 2.0 * apart.radius => Some(apart),
            Gap::ContactPair(touch) if touch.has_one_feature() => Some(touch.gap(self.m, &view, 0)),
            Gap::Gauge(law) => Some(law.eval(&Config { poses: &view, m: self.m, mode: self.mode() })),
            Gap::ContactPair(_) | Gap::Cable(_) => None,
        }
    }

    /// Whether an open unilateral constraint stays open throughout a step, at one end of which its gap is `gap`, m; `travel` bounds how far
    /// bodies go from the middle of the step. May be false where it does.
    pub fn stays_open(&self, l: usize, gap: f64, travel: &Travel) -> bool {
        let constraint = &self.m.unilateral[l];
        let (ends, reaches) = (self.m.groups[constraint.group].ends, self.reaches[constraint.group]);
        let way: f64 = ends.iter().zip(reaches).map(|(&body, reach)| travel.way_within(body, reach)).sum();
        let size = reaches.into_iter().filter(|reach| reach.is_finite()).fold(self.length, f64::max);
        matches!(&constraint.gap, Gap::ContactPair(touch) if touch.is_a_distance())
            && constraint.soft.is_none()
            && gap > 2.0 * way + AS_GOOD_AS_CLOSED * size
    }

    /// The present mode with the present features of all open unilateral constraints, those apart left as they were;
    /// `moment`, s, is short beside any of the motion.
    pub fn find_features(&self, moment: f64) -> Mode {
        let (mut mode, apart) = (self.mode().clone(), self.apart());
        for (constraint, contact) in self.m.unilateral.iter().zip(mode.contacts_mut()) {
            if contact.mode == ContactMode::Open && apart[constraint.group].is_none() {
                let feature = constraint.gap.feature(self.m, &self.at(), contact.feature);
                contact.feature = self.next_feature(&constraint.gap, feature, moment);
            }
        }
        mode
    }

    /// Where several features tell one gap, as where corners meet, the one on which it is the largest a moment later.
    fn next_feature(&self, gap: &Gap, first: Feature, moment: f64) -> Feature {
        let Gap::ContactPair(touch) = gap else { return first };
        let going = MotionView { at: self.at(), bodies: None, accelerations: None };
        let jet = |feature: Feature| gap.gap(self.m, self.mode(), &going, feature);
        let now = gap.gap(self.m, self.mode(), &self.at(), first);
        if now.abs() > ONE_GAP * self.length {
            return first;
        }
        let mut borders = touch.borders(self.m, &self.at(), first.index);
        borders.retain(|border| touch.may_be_active(self.m, &self.at(), border.beyond));
        let mut best = (now + moment * jet(first).d1, first);
        for border in borders.iter().filter(|border| border.value.abs() <= ONE_GAP * self.length) {
            let beyond = Feature { index: border.beyond, ..first };
            let coming = now - border.value + moment * jet(beyond).d1;
            if coming > best.0 {
                best = (coming, beyond);
            }
        }
        best.1
    }

    /// The unilateral constraints whose gap is closed, or open by less than `most`, m.
    pub fn touching(&self, most: f64) -> Vec<usize> {
        let apart = self.apart();
        let touches = |l: &usize| {
            if apart[self.m.unilateral[*l].group].is_some_and(|least| least > most) {
                return self.mode().contacts[*l].mode.is_closed();
            }
            let contact = self.mode().contacts[*l];
            let can = || self.m.unilateral[*l].gap.can_close(contact.feature.index);
            contact.mode.is_closed()
                || (contact.mode == ContactMode::Open
                    && self.m.unilateral[*l].soft.is_none()
                    && can()
                    && self.constraint_gap(*l) * self.lever(*l) <= most)
        };
        (0..self.m.unilateral.len()).filter(touches).collect()
    }

    /// The nearest border of a unilateral constraint's feature, and the feature beyond.
    pub fn border(&self, l: usize) -> Option<(f64, usize)> {
        let borders = self.m.unilateral[l].gap.borders(self.m, &self.at(), self.mode().contacts[l].feature);
        borders.iter().map(|b| (b.value, b.beyond)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The present mode with a part taken away or put in place, joints as they are now; None if that changes nothing.
    pub fn switch_part(&self, part: Part, there: bool) -> Option<Mode> {
        let mut mode = self.mode().clone();
        let changes = match part {
            Part::Group(g) => self.switch_contacts(&mut mode, g, there),
            _ => mode.put(part, there),
        };
        if !changes {
            return None;
        }
        if let Some(stand_in) = self.m.held_without(part) {
            mode.put(stand_in, !there);
        }
        if let (true, Part::Joint(j)) = (there, part) {
            let mut rows = vec![];
            joint_rows(self.at(), j, None, &mut rows);
            for row in rows {
                if let (Source::Joint(j, r), Some(value)) = (row.source, row.value) {
                    mode.row_offsets.insert((j, r), value);
                }
            }
        }
        Some(mode)
    }

    /// That what a joint has taken hold of has axes to turn with.
    ///
    /// # Errors
    /// A pin that has taken hold of two particles at a distance.
    pub fn check_axes(&self, joint: usize) -> Result<(), DynamicsError> {
        let pin = &self.m.joints[joint];
        let bodies = [&pin.first, &pin.second].map(|marker| &self.m.bodies[self.m.body_of(marker.site)]);
        let pins = pin.kind.card().rows.iter().any(|row| row.pin.is_some());
        if pins && bodies.iter().all(|body| body.particle) && self.at().pin_shift(joint).norm() > OPEN * self.length {
            return Err(DynamicsError::NoAxes(pin.name.clone(), bodies.map(|body| body.name.clone())));
        }
        Ok(())
    }

    /// That no string is drawn in beyond its drum: its equations have solutions there that are no motions.
    ///
    /// # Errors
    /// `penetration`, where a free length is below zero.
    pub fn check_free_lengths(&self) -> Result<(), DynamicsError> {
        for (j, joint) in self.m.joints.iter().enumerate() {
            let Some(k) = joint.coordinates.iter().position(|coordinate| coordinate.ends) else { continue };
            let of = joint.coordinates[k].reading(&self.at().n.values);
            let (length, _) = of.to_joint(self.at().coordinate(j, k), 0.0, 0.0, 0.0);
            if self.mode().has(Part::Joint(j)) && length < -SHALLOW * self.length {
                let what = format!("the free length of `{}` would be {length:.3} m", joint.name);
                let hint = "its end would be within the drum: move it out, or choose another length";
                return Err(DynamicsError::Penetration(what, hint, format!("joints.{}", joint.name)));
            }
        }
        Ok(())
    }

    fn switch_contacts(&self, mode: &mut Mode, g: usize, there: bool) -> bool {
        let constraints = self.m.groups[g].constraints.clone();
        let switched: Vec<usize> =
            constraints.filter(|&l| (mode.contacts[l].mode != ContactMode::Off) != there).collect();
        for &l in &switched {
            mode.contacts_mut()[l] = match there {
                true => ContactState { mode: ContactMode::Open, feature: self.initial_feature(l) },
                false => ContactState { mode: ContactMode::Off, ..mode.contacts[l] },
            };
        }
        !switched.is_empty()
    }

    /// How many motions the last solution leaves: those that its rows leave free, and those that are driven.
    pub fn dof(&self) -> usize {
        let driven = self.at().drives().filter(|(_, drive)| drive.is_motion()).count();
        driven + if self.is_closed() { self.dense.saddle.dof() } else { self.m.freedom() }
    }

    /// The present mode with the values of all rows of which only the change counts as their zeros.
    pub fn with_row_offsets(&self) -> Mode {
        let mut mode = self.mode().clone();
        mode.row_offsets.clear();
        for row in closing_rows(self.at(), None) {
            if let Source::Joint(j, r) = row.source {
                if self.m.joints[j].is_relative[r] {
                    mode.row_offsets.insert((j, r), row.value.unwrap_or(0.0));
                }
            }
        }
        mode
    }
}
