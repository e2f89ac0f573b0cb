//! Gaps at one state: their features and borders, which are closed, and parts put in place.

use super::rows::{closing_rows, joint_rows};
use super::{Source, Trouble, Workspace};
use crate::bound_values::BoundValues;
use crate::mechanism::{Gap, Group, Mechanism, Part};
use crate::mode::{Border, ContactMode, ContactState, Feature};

/// Depth, over the characteristic length, to which a unilateral constraint may be violated at the start.
const SHALLOW: f64 = 1e-8;
/// Depth, over the characteristic length, to which a unilateral constraint may be violated on the way.
const GRAZE: f64 = 1e-9;
/// Difference, over the characteristic length, of what features tell of a gap up to which it is one.
const SAME: f64 = 1e-10;
/// Distance, over the characteristic length, up to which two corners meet, whichever of them tells it.
const MEET: f64 = 1e-9;
/// Distance, over the characteristic length, from which bodies count as apart without a look at their outlines.
const CLEAR: f64 = 0.1;

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
    /// Finds what only the start tells of unilateral constraints: how strings are attached, and on which feature every
    /// gap is.
    ///
    /// # Errors
    /// `penetration`, where a unilateral constraint is violated.
    pub fn start_contacts(&mut self) -> Result<(), Trouble> {
        for l in 0..self.m.unilateral.len() {
            self.start_contact(l);
            let gap = self.constraint_gap(l);
            if self.m.unilateral[l].soft.is_some() {
                self.update_compliant_contact(l);
                continue;
            }
            if self.mode.contacts[l].mode != ContactMode::Off && gap < -SHALLOW * self.length {
                let group = &self.m.groups[self.m.unilateral[l].group];
                let what = match group.word {
                    "string" => format!("the string `{}` is stretched by {:.6e} m", group.name, -gap),
                    word => format!("the {word} `{}` is violated by {:.6e}", group.name, -gap),
                };
                let hint = "move the parts, or change its size";
                return Err(Trouble::Penetration(what + " at the start", hint, group.path()));
            }
        }
        Ok(())
    }

    /// Refuses a state in which a unilateral constraint without a spring is violated: what should have closed it was
    /// missed.
    ///
    /// # Errors
    /// `penetration`.
    pub fn check_gaps(&self, t: f64) -> Result<(), Trouble> {
        let apart = self.apart();
        for (l, constraint) in self.m.unilateral.iter().enumerate() {
            let mode = self.mode.contacts[l].mode;
            if mode == ContactMode::Off
                || constraint.soft.is_some()
                || (mode == ContactMode::Open && apart[constraint.group].is_some())
            {
                continue;
            }
            let gap = self.open_gap(l);
            if gap < -GRAZE * self.length {
                let group = &self.m.groups[constraint.group];
                let what = format!("the {} `{}` is violated by {:.6e} at t = {t:.12} s", group.word, group.name, -gap);
                return Err(Trouble::Penetration(what, "choose a shorter longest step, `max_step`", group.path()));
            }
        }
        Ok(())
    }

    fn start_contact(&mut self, l: usize) {
        let constraint = &self.m.unilateral[l];
        let mut feature = Feature::default();
        if let Gap::Cable(cable) = &constraint.gap {
            feature.phase = cable.initial_winding(self.m, &self.at());
        }
        self.mode.contacts[l].feature = constraint.gap.feature(self.m, &self.at(), feature);
    }

    /// Presses a unilateral constraint with a spring if it is violated.
    fn update_compliant_contact(&mut self, l: usize) {
        if self.mode.contacts[l].mode != ContactMode::Off {
            let pressed = self.constraint_gap(l) < 0.0 && self.compliant_force(l) > 0.0;
            self.mode.contacts[l].mode = if pressed { ContactMode::Compliant } else { ContactMode::Open };
        }
    }

    /// The gap of a unilateral constraint at the present state, on its feature.
    pub fn constraint_gap(&self, l: usize) -> f64 {
        self.m.unilateral[l].gap.gap(self.m, &self.mode, &self.at(), self.mode.contacts[l].feature)
    }

    /// The gap of an open unilateral constraint at the present state, on whichever feature it now is.
    pub fn open_gap(&self, l: usize) -> f64 {
        let (gap, at) = (&self.m.unilateral[l].gap, self.at());
        gap.gap(self.m, &self.mode, &at, gap.feature(self.m, &at, self.mode.contacts[l].feature))
    }

    /// The gap of an open unilateral constraint, where it can close as it now is; None too where a unilateral
    /// constraint that is closed keeps it off.
    pub fn closing_gap(&self, l: usize) -> Option<f64> {
        let (gap, at) = (&self.m.unilateral[l].gap, self.at());
        let feature = gap.feature(self.m, &at, self.mode.contacts[l].feature);
        let gap_here = gap.can_close(feature.index).then(|| gap.gap(self.m, &self.mode, &at, feature));
        gap_here.filter(|gap_here| gap_here.abs() > SAME * self.length || !self.is_doubled(l, feature))
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
        let closed = |&by: &usize| by != l && self.mode.contacts[by].mode.touches();
        let by = self.m.groups[constraint.group].constraints.clone().filter(closed);
        let mut places = by.filter_map(|by| place(by, self.mode.contacts[by].feature));
        places.any(|there| (there - here).norm() <= MEET * self.length)
    }

    /// Of every contact, stop and string a distance that its two bodies keep at least, m, where they are clearly apart:
    /// then none of its unilateral constraints is near.
    pub fn apart(&self) -> Vec<Option<f64>> {
        let apart = |(group, reach): (&Group, &[f64; 2])| {
            let [a, b] = group.ends.map(|body| self.k.pose[body].at);
            Some((a - b).norm() - reach[0] - reach[1]).filter(|&least| least > CLEAR * self.length)
        };
        self.m.groups.iter().zip(&self.reaches).map(apart).collect()
    }

    /// Takes the present features of all open unilateral constraints, those apart left as they were; `moment`, s, is
    /// short beside any of the motion.
    pub fn find_features(&mut self, moment: f64) {
        let apart = self.apart();
        for l in 0..self.m.unilateral.len() {
            if self.mode.contacts[l].mode == ContactMode::Open && apart[self.m.unilateral[l].group].is_none() {
                let feature = self.m.unilateral[l].gap.feature(self.m, &self.at(), self.mode.contacts[l].feature);
                self.mode.contacts[l].feature = feature;
                self.take_next_feature(l, moment);
            }
        }
    }

    /// Where several features tell one gap, as where corners meet, takes the one that is the largest a moment later.
    fn take_next_feature(&mut self, l: usize, moment: f64) {
        let Gap::ContactPair(touch) = &self.m.unilateral[l].gap else { return };
        let (first, gap) = (self.mode.contacts[l].feature, self.constraint_gap(l));
        if gap.abs() > SAME * self.length {
            return;
        }
        let mut borders = touch.borders(self.m, &self.at(), first.index);
        borders.retain(|border| touch.may_be_active(self.m, &self.at(), border.beyond));
        let mut best = (gap + moment * self.gap_rate(l), first);
        for border in borders.iter().filter(|border| border.value.abs() <= SAME * self.length) {
            self.mode.contacts[l].feature.index = border.beyond;
            let coming = gap - border.value + moment * self.gap_rate(l);
            if coming > best.0 {
                best = (coming, self.mode.contacts[l].feature);
            }
        }
        self.mode.contacts[l].feature = best.1;
    }

    /// The unilateral constraints whose gap is closed, or open by less than `most`.
    pub fn touching(&self, most: f64) -> Vec<usize> {
        let apart = self.apart();
        let touches = |l: &usize| {
            if apart[self.m.unilateral[*l].group].is_some_and(|least| least > most) {
                return self.mode.contacts[*l].mode.is_closed();
            }
            let contact = self.mode.contacts[*l];
            let can = || self.m.unilateral[*l].gap.can_close(contact.feature.index);
            contact.mode.is_closed()
                || (contact.mode == ContactMode::Open
                    && self.m.unilateral[*l].soft.is_none()
                    && can()
                    && self.constraint_gap(*l) <= most)
        };
        (0..self.m.unilateral.len()).filter(touches).collect()
    }

    /// The nearest border of a unilateral constraint's feature, and the feature beyond.
    pub fn border(&self, l: usize) -> Option<(f64, usize)> {
        let borders = self.m.unilateral[l].gap.borders(self.m, &self.at(), self.mode.contacts[l].feature);
        borders.iter().map(|b| (b.value, b.beyond)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Whether a part is in place.
    pub fn has(&self, part: Part) -> bool {
        match part {
            Part::Group(g) => {
                self.m.groups[g].constraints.clone().any(|l| self.mode.contacts[l].mode != ContactMode::Off)
            }
            _ => self.mode.has(part),
        }
    }

    /// Takes a part away or puts it in place, joints as they are now; answers whether that changed anything.
    pub fn put(&mut self, part: Part, there: bool) -> bool {
        let changed = match part {
            Part::Group(g) => self.put_contacts(g, there),
            _ => self.mode.put(part, there),
        };
        if let Some(mode) = self.m.held_without(part) {
            self.mode.put(mode, !there);
        }
        if let (true, true, Part::Joint(j)) = (changed, there, part) {
            let mut rows = vec![];
            joint_rows(self.at(), j, None, &mut rows);
            for row in rows {
                if let (Source::Joint(j, r), Some(value)) = (row.source, row.value) {
                    self.mode.row_offsets.insert((j, r), value);
                }
            }
        }
        changed
    }

    fn put_contacts(&mut self, g: usize, there: bool) -> bool {
        let mut changed = false;
        for l in self.m.groups[g].constraints.clone() {
            let is_there = self.mode.contacts[l].mode != ContactMode::Off;
            if is_there == there {
                continue;
            }
            changed = true;
            let mode = if there { ContactMode::Open } else { ContactMode::Off };
            self.mode.contacts[l] = ContactState { mode, ..self.mode.contacts[l] };
            if there {
                self.start_contact(l);
            }
        }
        changed
    }

    /// Whether the rows of the last solution leave nothing free, and no motion drives it.
    pub fn is_locked(&self) -> bool {
        let driven = self.at().drives().any(|(_, drive)| drive.is_motion());
        !driven && self.dense.saddle.dof() == 0
    }

    /// Takes the values of all rows of which only the change counts as their zeros.
    pub fn take_row_offsets(&mut self) {
        self.mode.row_offsets.clear();
        for row in closing_rows(self.at(), None) {
            if let Source::Joint(j, r) = row.source {
                if self.m.joints[j].is_relative[r] {
                    self.mode.row_offsets.insert((j, r), row.value.unwrap_or(0.0));
                }
            }
        }
    }
}
