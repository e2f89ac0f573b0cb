//! Back onto the closed loops: corrections of positions and velocities that change the motion least.

use super::minimal::{Force, Memory, Wanted};
use super::rows::closing_rows_into;
use super::tree_matrices::{column_scale, column_scales, gradients, row_scales, rows_in_coordinates};
use super::{visit_ancestors, DynamicsError, Row, Source, Workspace};
use crate::gauges::ModelExpr;
use crate::kinematics::JointView;
use crate::mode::Mode;
use crate::solve::{Lu, Matrix, Orthogonal, Rank};
use smallvec::SmallVec;

/// Corrections after which a position is given up.
const CORRECTIONS: usize = 12;
/// Gap, relative to the characteristic length, at which a loop counts as closed.
pub(crate) const CLOSED: f64 = 1e-14;
/// Gap below which all is closed: no place is known any closer.
const SHUT: f64 = 0.1 * CLOSED;
/// Gap above which the closing of a loop has failed.
pub(crate) const OPEN: f64 = 1e-9;
/// Part of what turns make of a row below which shifts make nothing of it.
const UNMOVED: f64 = 1e-9;
/// Correction, over the gap that it closes, beyond which the rows all but depend on each other.
const FAR: f64 = 1e4;
/// Part of the fastest rate below which what is left of a rate asked for is round-off,
const UNMET: f64 = 1e-8;
/// and below which it is not corrected any more.
const MET: f64 = 1e-13;
/// Displacement, in the units of the coordinates, within which factored equations close gaps that are no larger themselves,
const NEAR: f64 = 1e-7;
/// and part of the velocities that may be wrong in their correction by factors of another state.
const UNSEEN: f64 = 1e-16;
/// Square of the independence of rows below which a gap is left rather than closed from afar.
const DAMPING: f64 = 1e-8;

impl Workspace<'_> {
    /// What is open at a row: its value less its zero, angles brought to the nearest turn; None where nothing
    /// is prescribed at the level of positions.
    pub(crate) fn gap(&self, row: &Row) -> Option<f64> {
        let value = row.value?;
        let Source::Joint(j, r) = row.source else { return Some(value) };
        let joint = &self.m.joints[j];
        let zero = match self.mode().row_offsets.get(&(j, r)) {
            Some(zero) => *zero,
            None if joint.is_relative[r] => return None,
            None => 0.0,
        };
        let period = JointView::new(self.m, &self.n, joint, |x: f64| x).period(r);
        let open = value - zero;
        Some(if period > 0.0 { open - period * (open / period).round() } else { open })
    }

    /// The closing rows of the present state.
    pub(crate) fn update_rows(&mut self) {
        self.placed.is_solved = false;
        let mut rows = std::mem::take(&mut self.rows);
        closing_rows_into(self.at(), None, &mut rows);
        self.rows = rows;
    }

    /// Largest gap of the present state, lengths in units of the characteristic length.
    pub fn worst_gap(&mut self) -> f64 {
        self.update_rows();
        self.widest_gap()
    }

    /// The same with rows that hold gauges at given values.
    fn worst_gap_with(&mut self, held: &[(ModelExpr, f64)]) -> f64 {
        self.update_rows();
        let targets: Vec<Row> = held.iter().map(|(gauge, value)| self.target_row(gauge, *value, 0.0)).collect();
        self.rows.extend(targets);
        self.widest_gap()
    }

    /// Largest gap of the rows as they are.
    pub(crate) fn widest_gap(&self) -> f64 {
        let size = |row: &Row| self.gap(row).map_or(0.0, |g| g.abs() / self.row_unit(row));
        // What has no gap (wheels that overlap) is wide open.
        self.rows.iter().map(size).fold(0.0, |most, gap| if gap.is_nan() { f64::INFINITY } else { most.max(gap) })
    }

    /// Unit of a row's value: what a shift by the characteristic length makes of it, or a turn by a radian where no shift
    /// does.
    pub(crate) fn row_unit(&self, row: &Row) -> f64 {
        let turn = row.motion.iter().map(|(_, w)| w.m.abs()).fold(0.0, f64::max);
        let shift = row.motion.iter().map(|(_, w)| w.f.norm()).fold(0.0, f64::max) * self.length;
        match shift > UNMOVED * turn {
            true => shift,
            false if turn > 0.0 => turn,
            false => 1.0,
        }
    }

    /// Closes the loops at (t, q) in a mode: returns the size of the correction.
    ///
    /// # Errors
    /// `branch_lost` when the loops cannot be closed from here.
    pub fn project_positions(&mut self, mode: &Mode, t: f64, q: &mut [f64], u: &[f64]) -> Result<f64, DynamicsError> {
        self.project_positions_with(mode, t, q, u, &[])
    }

    /// As [`Workspace::project_positions`], with further gauges that must have given values. The closing rows are then those of
    /// the present state.
    pub(crate) fn project_positions_with(
        &mut self,
        mode: &Mode,
        t: f64,
        q: &mut [f64],
        u: &[f64],
        held: &[(ModelExpr, f64)],
    ) -> Result<f64, DynamicsError> {
        let moved = self.close(mode, t, q, u, held);
        self.rows.retain(|row| row.source != Source::TARGET);
        moved
    }

    fn close(
        &mut self,
        mode: &Mode,
        t: f64,
        q: &mut [f64],
        u: &[f64],
        held: &[(ModelExpr, f64)],
    ) -> Result<f64, DynamicsError> {
        self.enter(mode);
        let (mut moved, mut last) = (0.0_f64, f64::INFINITY);
        for _ in 0..CORRECTIONS {
            self.move_to(t, q, u);
            let gap = self.worst_gap_with(held);
            if gap <= SHUT || (gap >= 0.5 * last && gap <= OPEN) {
                return Ok(moved);
            }
            last = gap;
            let asked: Vec<f64> = self.rows.iter().map(|row| self.gap(row).map_or(0.0, |g| -g)).collect();
            let present: Vec<bool> = self.rows.iter().map(|row| self.gap(row).is_some()).collect();
            let least = self.correction(&asked, &present, NEAR)?;
            let mut step = self.rates_of(&least);
            // Contacts that all but depend on each other keep their gaps, lest the bodies go far, and up, to close
            // them.
            if self.m.closures.is_empty() && gap <= OPEN && self.size_of(&step) > FAR * gap {
                let open_rows = self.rows.iter().filter_map(|row| Some((row.clone(), self.gap(row)?)));
                let (rows, gaps): (Vec<_>, Vec<_>) = open_rows.unzip();
                step = self.rates_of(&self.damped_motion(&rows, &gaps, DAMPING));
            }
            moved = moved.max(self.size_of(&step));
            q.iter_mut().zip(&step).for_each(|(q, d)| *q += d);
        }
        self.move_to(t, q, u);
        if self.worst_gap_with(held) <= OPEN {
            return Ok(moved);
        }
        self.update_rows();
        let row = self.widest_row();
        let gap = self.gap(row).map_or(0.0, f64::abs);
        Err(DynamicsError::LoopOpened(row.source.name(self.m).to_string(), gap, row.source.path(self.m)))
    }

    /// Makes the velocities at (t, q) keep the loops closed in a mode: returns the size of the correction.
    ///
    /// # Errors
    /// As [`Workspace::solve`].
    pub fn project_velocities(&mut self, mode: &Mode, t: f64, q: &[f64], u: &mut [f64]) -> Result<f64, DynamicsError> {
        self.place(mode, t, q, u);
        self.update_rows();
        self.close_rates(u)
    }

    /// The same at the present state, of which the closing rows are.
    pub(crate) fn close_rates(&mut self, u: &mut [f64]) -> Result<f64, DynamicsError> {
        let asked: Vec<f64> = self.rows.iter().map(|row| row.rate.map_or(0.0, |r| -r)).collect();
        if asked.iter().all(|&r| r == 0.0) {
            return Ok(0.0);
        }
        let present: Vec<bool> = self.rows.iter().map(|row| row.rate.is_some()).collect();
        let fastest = self.size_of(&self.placed.u);
        let rates = self.rows.iter().zip(&asked).map(|(row, asked)| (asked / self.row_unit(row)).abs());
        let near = NEAR.min(UNSEEN * fastest / rates.fold(0.0, f64::max));
        let step = self.correction(&asked, &present, near)?;
        let step = self.rates_of(&step);
        u.iter_mut().zip(&step).for_each(|(u, d)| *u += d);
        Ok(self.size_of(&step))
    }

    /// The motion that changes the present rows by `asked`, least in the metric of the masses; least in plain scaled
    /// coordinates where a free motion has no mass. Equations factored at a state as `near` as that do.
    fn correction(&mut self, asked: &[f64], present: &[bool], near: f64) -> Result<Vec<f64>, DynamicsError> {
        if self.many_loops && present.iter().all(|&p| p) {
            let targets = self.rows.iter().any(|row| row.source == Source::TARGET);
            if self.sparse_tree.is_some() && !targets {
                if let Ok(least) = self.sparse_tree_correction(asked, near) {
                    return Ok(least);
                }
            }
            return self.sparse_correction(asked, &[]);
        }
        let mut keep = present.iter();
        self.rows.retain(|_| *keep.next().expect("one for each row"));
        let asked: Vec<f64> = asked.iter().zip(present).filter(|(_, &p)| p).map(|(a, _)| *a).collect();
        if !self.is_factored(near, false) {
            super::loads::centre_arms(self.placed.view(self.m, &self.n, &self.k), &mut self.arms);
            if self.factor_for(Wanted::Motion, Force::Gradient).is_err() {
                return Ok(self.least_motion(&self.rows, &asked));
            }
        }
        let Memory { force, found, islands, .. } = &mut **self.memory.get_or_insert_default();
        force.clear();
        force.resize(self.m.freedom(), 0.0);
        match self.dense.solve_into(force, &asked, found, islands) {
            Ok(()) => Ok(found.a.clone()),
            Err(_) => Ok(self.least_motion(&self.rows, &asked)),
        }
    }

    /// The least motion, in scaled coordinates, that changes `rows` by `asked` as nearly as possible.
    pub(crate) fn least_motion(&self, rows: &[Row], asked: &[f64]) -> Vec<f64> {
        let (scaled, scales, columns) = self.scaled(rows);
        let side: Vec<f64> = asked.iter().zip(&scales).map(|(a, s)| a * s).collect();
        let mut step = vec![0.0; columns.len()];
        Orthogonal::factor(&scaled).add_solution(&side, &mut step);
        step.iter_mut().zip(&columns).for_each(|(s, c)| *s *= c);
        step
    }

    /// As [`Workspace::project_velocities`] in the present mode, with further gauges whose rates must have given
    /// values.
    pub(crate) fn project_velocities_with(
        &mut self,
        t: f64,
        q: &[f64],
        u: &mut [f64],
        contact: &[(String, ModelExpr, f64)],
    ) -> Result<(), DynamicsError> {
        self.move_to(t, q, u);
        self.update_rows();
        let targets: Vec<Row> = contact.iter().map(|(_, gauge, rate)| self.target_row(gauge, 0.0, *rate)).collect();
        self.rows.extend(targets.iter().cloned());
        let fastest = self.size_of(&self.placed.u);
        let is_met = |row: &Row| row.rate.is_none_or(|r| (r / self.row_unit(row)).abs() <= MET * fastest);
        if self.rows.iter().all(is_met) {
            return Ok(());
        }
        let asked: Vec<f64> = self.rows.iter().map(|row| row.rate.map_or(0.0, |r| -r)).collect();
        let present: Vec<bool> = self.rows.iter().map(|row| row.rate.is_some()).collect();
        super::loads::centre_arms(self.placed.view(self.m, &self.n, &self.k), &mut self.arms);
        let sparse = self.many_loops && present.iter().all(|&p| p);
        let step = match sparse.then(|| self.sparse_correction(&asked, &targets)) {
            Some(Ok(step)) => step,
            // Ranks decide where loops depend on each other, or on what is asked for.
            _ => {
                let sparse = std::mem::replace(&mut self.many_loops, false);
                let step = self.correction(&asked, &present, 0.0);
                self.many_loops = sparse;
                step?
            }
        };
        let step = self.rates_of(&step);
        u.iter_mut().zip(&step).for_each(|(u, d)| *u += d);
        Ok(())
    }

    /// Refuses present rates that do not keep the loops closed, or gauges at given rates: what asks for them excludes each
    /// other. `before`: rates from which these were found.
    ///
    /// # Errors
    /// `inconsistent_velocities`.
    pub(crate) fn check_rates(
        &mut self,
        given: &[(String, ModelExpr, f64)],
        before: &[f64],
    ) -> Result<(), DynamicsError> {
        self.update_rows();
        let units = self.units();
        let rates = |u: &[f64]| u.iter().zip(&units).map(|(u, unit)| (u / unit).abs()).fold(0.0, f64::max);
        let fastest = rates(&self.placed.u).max(rates(before));
        let closing = self
            .rows
            .iter()
            .filter(|row| row.rate.is_some())
            .map(|row| (row.source.name(self.m).to_string(), Some(row.source.path(self.m)), row.clone()));
        let held = given
            .iter()
            .map(|(name, gauge, rate)| (format!("rate of {name}"), None, self.target_row(gauge, 0.0, *rate)));
        let asking: Vec<(String, Option<String>, Row)> = closing.chain(held).collect();
        let over = |left: f64, row: &Row| (left / self.row_unit(row)).abs();
        if asking.iter().all(|(.., row)| over(row.rate.unwrap_or(0.0), row) <= UNMET * fastest) {
            return Ok(());
        }
        let rows: Vec<Row> = asking.iter().map(|(.., row)| row.clone()).collect();
        let left = self.unmet_rates(&rows);
        let worst = rows.iter().zip(&left).map(|(row, &left)| over(left, row)).fold(0.0, f64::max);
        let mut named: Vec<(String, f64)> = vec![];
        let mut item = None;
        for ((name, path, row), left) in asking.into_iter().zip(left) {
            if over(left, &row) >= UNMET * worst && named.iter().all(|(known, _)| *known != name) {
                named.push((name, left));
                item = item.or(path);
            }
        }
        Err(DynamicsError::InconsistentRates(named, item))
    }

    /// What the motion that comes nearest leaves of the rates of rows: 0 but for those that contradict each other.
    fn unmet_rates(&self, rows: &[Row]) -> Vec<f64> {
        let (scaled, scales, _) = self.scaled(rows);
        let split = Orthogonal::factor(&scaled);
        let rates: Vec<f64> = rows.iter().zip(&scales).map(|(row, scale)| row.rate.unwrap_or(0.0) * scale).collect();
        let mut left = vec![0.0; rows.len()];
        for stress in (split.rank().rank..rows.len()).map(|k| split.y().row(k)) {
            let along: f64 = stress.iter().zip(&rates).map(|(s, r)| s * r).sum();
            left.iter_mut().zip(stress).for_each(|(l, s)| *l += along * s);
        }
        left.iter().zip(&scales).map(|(l, scale)| l / scale).collect()
    }

    /// A motion of the tree in the user's rates.
    fn rates_of(&self, motion: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; motion.len()];
        self.to_user(motion, &mut rates);
        rates
    }

    /// Number of independent rows.
    pub(crate) fn rank_of(&self, rows: &[Row]) -> usize {
        if rows.is_empty() {
            return 0;
        }
        Orthogonal::factor(&self.scaled(rows).0).rank().rank
    }

    /// The motion that lessens the gaps of rows, damped (in scaled coordinates).
    pub(crate) fn damped_motion(&self, rows: &[Row], gaps: &[f64], damping: f64) -> Vec<f64> {
        if damping == 0.0 {
            return self.least_motion(rows, &gaps.iter().map(|gap| -gap).collect::<Vec<_>>());
        }
        // Weighed by the units in which gaps are compared, so that a short enough step lessens them.
        let (g, scales, columns) = self.scaled(rows);
        let weights: Vec<f64> = rows.iter().zip(&scales).map(|(row, s)| 1.0 / (s * self.row_unit(row))).collect();
        let g = Matrix::from_fn(g.rows(), g.cols(), |i, j| g[(i, j)] * weights[i]);
        let n = g.cols();
        let side: Vec<f64> = gaps.iter().zip(rows).map(|(gap, row)| -gap / self.row_unit(row)).collect();
        let normal = Matrix::from_fn(n, n, |i, j| {
            let sum: f64 = (0..g.rows()).map(|r| g[(r, i)] * g[(r, j)]).sum();
            sum + if i == j { damping } else { 0.0 }
        });
        let mut right = vec![0.0; n];
        g.add_t_mul_vec(&side, &mut right);
        let mut step = Lu::factor(&normal).map(|lu| lu.solve(&right)).unwrap_or(right);
        step.iter_mut().zip(&columns).for_each(|(s, c)| *s *= c);
        step
    }

    /// Rows by scaled coordinates, each of order one, with the scales of rows and coordinates.
    fn scaled(&self, rows: &[Row]) -> (Matrix, Vec<f64>, Vec<f64>) {
        let g = gradients(self.at(), rows, self.length);
        let columns = self.units();
        let scales: Vec<f64> = row_scales(&g, &columns).collect();
        let scaled = Matrix::from_fn(g.rows(), g.cols(), |i, j| g[(i, j)] * scales[i] * columns[j]);
        (scaled, scales, columns)
    }

    /// A row that holds a gauge at a value, and its rate at a rate.
    pub(crate) fn target_row(&self, gauge: &ModelExpr, value: f64, rate: f64) -> Row {
        let going = crate::kinematics::MotionView { at: self.at(), bodies: None, accelerations: None };
        let jet = crate::kinematics::jet(&going, gauge);
        Row {
            source: Source::TARGET,
            value: Some(jet.d0 - value),
            rate: Some(jet.d1 - rate),
            bias: 0.0,
            motion: super::rows::gauge_wrenches(self.at(), gauge),
            force: None,
        }
    }

    /// How far the closing rows are from depending on one another: the least row, and where there are few rows the
    /// least combination of rows, relative to the greatest, in units of the characteristic length; 1 where there is none.
    pub(crate) fn independence(&mut self) -> f64 {
        if self.rows.is_empty() {
            return 1.0;
        }
        if self.many_loops {
            let sizes = self.rows.iter().map(|row| self.size_in_units(row));
            let (least, most) = sizes.fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
            return least / most;
        }
        let (mut scaled, mut sizes) =
            (std::mem::take(&mut self.dense.rows_in_units), std::mem::take(&mut self.dense.sizes));
        self.in_units(&self.rows, &mut scaled, &mut sizes);
        let independence = self.dense.independence.find(&scaled).kept;
        (self.dense.rows_in_units, self.dense.sizes) = (scaled, sizes);
        independence
    }

    /// Size of a row by coordinates, in units of the characteristic length.
    fn size_in_units(&self, row: &Row) -> f64 {
        let (at, mut entries) = (self.at(), SmallVec::<[(usize, f64); 16]>::new());
        visit_ancestors(at, row.motion.iter().copied(), |i, load, column| {
            let part = load.power(column) * column_scale(at, i, self.length);
            match entries.iter_mut().find(|(known, _)| *known == i) {
                Some((_, sum)) => *sum += part,
                None => entries.push((i, part)),
            }
        });
        entries.iter().map(|(_, x)| x * x).sum::<f64>().sqrt() / self.row_unit(row)
    }

    /// Rows in units of the characteristic length, and their rank.
    pub(crate) fn independence_of(&self, rows: &[Row]) -> (Matrix, Rank) {
        let mut scaled = Matrix::default();
        self.in_units(rows, &mut scaled, &mut vec![]);
        let rank = Orthogonal::factor(&scaled).rank();
        (scaled, rank)
    }

    /// Rows by coordinates, each over its unit, coordinates in theirs.
    fn in_units(&self, rows: &[Row], out: &mut Matrix, sizes: &mut Vec<f64>) {
        rows_in_coordinates(self.at(), rows, self.length, |row| &row.motion, out, sizes);
        for (i, row) in rows.iter().enumerate() {
            let unit = 1.0 / self.row_unit(row);
            let columns = column_scales(self.at(), self.length);
            out.row_mut(i).iter_mut().zip(columns).for_each(|(entry, column)| *entry = *entry * unit * column);
        }
    }

    fn size_of(&self, user: &[f64]) -> f64 {
        let unit = column_scales(self.at(), self.length);
        user.iter().zip(unit).map(|(x, u)| (x / u).abs()).fold(0.0, f64::max)
    }

    /// The row that is farthest from closed.
    fn widest_row(&self) -> &Row {
        let open = |row: &Row| self.gap(row).map_or(0.0, f64::abs) / self.row_unit(row);
        let worst = self.rows.iter().max_by(|a, b| open(a).total_cmp(&open(b)));
        worst.expect("only a row can be open")
    }
}
