//! Gaps at one state: their pieces and borders, which are closed, and parts put in place.

use super::rows::{closing_rows, joint_rows};
use super::{Balance, Source, Trouble};
use crate::mechanism::{Gap, Group, Mechanism, Part};
use crate::mode::{Border, Held, Hold, Piece};
use crate::numbers::Numbers;

/// Depth, over the characteristic length, to which a limit may be violated at the start.
const SHALLOW: f64 = 1e-8;
/// Depth, over the characteristic length, to which a limit may be violated on the way.
const GRAZE: f64 = 1e-9;
/// Difference, over the characteristic length, of what pieces tell of a gap up to which it is one.
const SAME: f64 = 1e-10;
/// Distance, over the characteristic length, up to which two corners meet, whichever of them tells it.
const MEET: f64 = 1e-9;
/// Distance, over the characteristic length, from which bodies count as apart without a look at their outlines.
const CLEAR: f64 = 0.1;

/// Of every contact, how far its surfaces reach from the pins of its two bodies, m; no bound for stops and strings.
pub(super) fn reaches(m: &Mechanism, n: &Numbers) -> Vec<[f64; 2]> {
    let none = |group: &Group| if group.word == "contact" { 0.0 } else { f64::INFINITY };
    let mut reaches: Vec<[f64; 2]> = m.groups.iter().map(|group| [none(group); 2]).collect();
    for limit in &m.limits {
        let Gap::Touch(touch) = &limit.gap else { continue };
        for (body, far) in touch.bodies(m).into_iter().zip(touch.extents(n)) {
            let end = usize::from(m.groups[limit.group].ends[0] != body);
            let reach = &mut reaches[limit.group][end];
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
                let runner = self.runners.iter().find(|runner| runner.pin == j);
                &self.joints[runner.map_or(j, |runner| runner.joint)].name
            }
            Part::Drive(d) => &self.drives[d].name,
            Part::Force(f) => &self.forces[f].name,
            Part::Group(g) => &self.groups[g].name,
        }
    }
}

impl Balance<'_> {
    /// Finds what only the start tells of limits: how strings are attached, and on which piece every gap is.
    ///
    /// # Errors
    /// `penetration`, where a limit is violated.
    pub fn start_limits(&mut self) -> Result<(), Trouble> {
        for l in 0..self.m.limits.len() {
            self.start_limit(l);
            let gap = self.limit_gap(l);
            if self.m.limits[l].soft.is_some() {
                self.lean_on_spring(l);
                continue;
            }
            if self.mode.limits[l].hold != Hold::Off && gap < -SHALLOW * self.length {
                let group = &self.m.groups[self.m.limits[l].group];
                let what = match group.word {
                    "string" => format!("the string `{}` is stretched by {:.6e} m", group.name, -gap),
                    word => format!("the {word} `{}` is violated by {:.6e}", group.name, -gap),
                };
                let what = what + " at the start; move the parts, or change its size";
                return Err(Trouble::new("penetration", what).about(group.path()));
            }
        }
        Ok(())
    }

    /// Refuses a state in which a limit without a spring is violated: what should have closed it was missed.
    ///
    /// # Errors
    /// `penetration`.
    pub fn check_gaps(&self, t: f64) -> Result<(), Trouble> {
        let apart = self.apart();
        for (l, limit) in self.m.limits.iter().enumerate() {
            let hold = self.mode.limits[l].hold;
            if hold == Hold::Off || limit.soft.is_some() || (hold == Hold::Open && apart[limit.group].is_some()) {
                continue;
            }
            let gap = self.open_gap(l);
            if gap < -GRAZE * self.length {
                let group = &self.m.groups[limit.group];
                let what = format!("the {} `{}` is violated by {:.6e} at t = {t:.12} s", group.word, group.name, -gap);
                return Err(Trouble::new("penetration", what + "; choose a shorter longest step, `max_step`")
                    .about(group.path()));
            }
        }
        Ok(())
    }

    fn start_limit(&mut self, l: usize) {
        let limit = &self.m.limits[l];
        let mut piece = Piece::default();
        if let Gap::Cord(cord) = &limit.gap {
            piece.phase = cord.phases(self.m, &self.at());
        }
        self.mode.limits[l].piece = limit.gap.piece(self.m, &self.at(), piece);
    }

    /// Presses a limit with a spring if it is violated.
    fn lean_on_spring(&mut self, l: usize) {
        if self.mode.limits[l].hold != Hold::Off {
            let pressed = self.limit_gap(l) < 0.0 && self.press(l) > 0.0;
            self.mode.limits[l].hold = if pressed { Hold::Pressed } else { Hold::Open };
        }
    }

    /// The gap of a limit at the present state, on its piece.
    pub fn limit_gap(&self, l: usize) -> f64 {
        self.m.limits[l].gap.gap(self.m, &self.mode, &self.at(), self.mode.limits[l].piece)
    }

    /// The gap of an open limit at the present state, on whichever piece it now is.
    pub fn open_gap(&self, l: usize) -> f64 {
        let (gap, at) = (&self.m.limits[l].gap, self.at());
        gap.gap(self.m, &self.mode, &at, gap.piece(self.m, &at, self.mode.limits[l].piece))
    }

    /// The gap of an open limit, where it can close as it now is; None too where a limit that is closed keeps it off.
    pub fn closing_gap(&self, l: usize) -> Option<f64> {
        let (gap, at) = (&self.m.limits[l].gap, self.at());
        let piece = gap.piece(self.m, &at, self.mode.limits[l].piece);
        let told = gap.can_close(piece.index).then(|| gap.gap(self.m, &self.mode, &at, piece));
        told.filter(|told| told.abs() > SAME * self.length || !self.is_doubled(l, piece))
    }

    /// Whether a corner is on a corner, so that its gap may as well be told by the other, and the other is closed.
    fn is_doubled(&self, l: usize, piece: Piece) -> bool {
        let (limit, at) = (&self.m.limits[l], self.at());
        let place = |l: usize, piece: Piece| self.m.limits[l].gap.contact(self.m, &at, piece).map(|c| c.point);
        let other = |border: &Border| !limit.gap.can_close(border.beyond) && border.value.abs() <= MEET * self.length;
        let Some(here) = place(l, piece).filter(|_| limit.gap.borders(self.m, &at, piece).iter().any(other)) else {
            return false;
        };
        let closed = |&by: &usize| by != l && self.mode.limits[by].hold.touches();
        let by = self.m.groups[limit.group].limits.clone().filter(closed);
        let mut places = by.filter_map(|by| place(by, self.mode.limits[by].piece));
        places.any(|there| (there - here).norm() <= MEET * self.length)
    }

    /// Of every contact, stop and string a distance that its two bodies keep at least, m, where they are clearly apart: then
    /// none of its limits is near.
    pub fn apart(&self) -> Vec<Option<f64>> {
        let apart = |(group, reach): (&Group, &[f64; 2])| {
            let [a, b] = group.ends.map(|body| self.k.pose[body].at);
            Some((a - b).norm() - reach[0] - reach[1]).filter(|&least| least > CLEAR * self.length)
        };
        self.m.groups.iter().zip(&self.reaches).map(apart).collect()
    }

    /// Takes the present pieces of all open limits, those apart left as they were; `moment`, s, is short beside any of the
    /// motion.
    pub fn find_pieces(&mut self, moment: f64) {
        let apart = self.apart();
        for l in 0..self.m.limits.len() {
            if self.mode.limits[l].hold == Hold::Open && apart[self.m.limits[l].group].is_none() {
                let piece = self.m.limits[l].gap.piece(self.m, &self.at(), self.mode.limits[l].piece);
                self.mode.limits[l].piece = piece;
                self.take_coming_piece(l, moment);
            }
        }
    }

    /// Where several pieces tell one gap, as where corners meet, takes the one that is the largest a moment later.
    fn take_coming_piece(&mut self, l: usize, moment: f64) {
        let Gap::Touch(touch) = &self.m.limits[l].gap else { return };
        let (first, gap) = (self.mode.limits[l].piece, self.limit_gap(l));
        if gap.abs() > SAME * self.length {
            return;
        }
        let mut borders = touch.borders(self.m, &self.at(), first.index);
        borders.retain(|border| touch.may_tell(self.m, &self.at(), border.beyond));
        let mut best = (gap + moment * self.gap_rate(l), first);
        for border in borders.iter().filter(|border| border.value.abs() <= SAME * self.length) {
            self.mode.limits[l].piece.index = border.beyond;
            let coming = gap - border.value + moment * self.gap_rate(l);
            if coming > best.0 {
                best = (coming, self.mode.limits[l].piece);
            }
        }
        self.mode.limits[l].piece = best.1;
    }

    /// The limits whose gap is closed, or open by less than `most`.
    pub fn touching(&self, most: f64) -> Vec<usize> {
        let apart = self.apart();
        let touches = |l: &usize| {
            if apart[self.m.limits[*l].group].is_some_and(|least| least > most) {
                return self.mode.limits[*l].hold.is_closed();
            }
            let held = self.mode.limits[*l];
            let can = || self.m.limits[*l].gap.can_close(held.piece.index);
            held.hold.is_closed()
                || (held.hold == Hold::Open && self.m.limits[*l].soft.is_none() && can() && self.limit_gap(*l) <= most)
        };
        (0..self.m.limits.len()).filter(touches).collect()
    }

    /// The nearest border of a limit's piece, and the piece beyond.
    pub fn border(&self, l: usize) -> Option<(f64, usize)> {
        let borders = self.m.limits[l].gap.borders(self.m, &self.at(), self.mode.limits[l].piece);
        borders.iter().map(|b| (b.value, b.beyond)).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Whether a part is in place.
    pub fn has(&self, part: Part) -> bool {
        match part {
            Part::Group(g) => self.m.groups[g].limits.clone().any(|l| self.mode.limits[l].hold != Hold::Off),
            _ => self.mode.has(part),
        }
    }

    /// Takes a part away or puts it in place, joints as they are now; answers whether that changed anything.
    pub fn put(&mut self, part: Part, there: bool) -> bool {
        let changed = match part {
            Part::Group(g) => self.put_limits(g, there),
            _ => self.mode.put(part, there),
        };
        if let Some(hold) = self.m.held_without(part) {
            self.mode.put(hold, !there);
        }
        if let (true, true, Part::Joint(j)) = (changed, there, part) {
            let mut rows = vec![];
            joint_rows(self.at(), j, None, &mut rows);
            for row in rows {
                if let (Source::Joint(j, r), Some(value)) = (row.source, row.value) {
                    self.mode.phases.insert((j, r), value);
                }
            }
        }
        changed
    }

    fn put_limits(&mut self, g: usize, there: bool) -> bool {
        let mut changed = false;
        for l in self.m.groups[g].limits.clone() {
            let is_there = self.mode.limits[l].hold != Hold::Off;
            if is_there == there {
                continue;
            }
            changed = true;
            let hold = if there { Hold::Open } else { Hold::Off };
            self.mode.limits[l] = Held { hold, ..self.mode.limits[l] };
            if there {
                self.start_limit(l);
            }
        }
        changed
    }

    /// Whether the rows of the last solution leave nothing free, and no motion drives it.
    pub fn is_locked(&self) -> bool {
        let driven =
            self.m.drives.iter().enumerate().any(|(d, drive)| !drive.coupling && self.mode.has(Part::Drive(d)));
        !driven && self.dense.saddle.dof() == 0
    }

    /// Takes the values of all rows of which only the change counts as their zeros.
    pub fn take_phases(&mut self) {
        self.mode.phases.clear();
        for row in closing_rows(self.at(), None) {
            if let Source::Joint(j, r) = row.source {
                if self.m.joints[j].phased[r] {
                    self.mode.phases.insert((j, r), row.value.unwrap_or(0.0));
                }
            }
        }
    }
}
