//! Many motions of one mechanism: side by side in lanes where its equations are the same operations for all, each for itself where not;
//! over threads. A motion has the bits of [`simulate`], whatever stands beside it.

mod starts;
mod threads;

pub use starts::{starts, Wish};

use crate::bound_values::BoundValues;
use crate::dynamics::{reaction_names, DynamicsError, TreeMotion};
use crate::hybrid::{simulate, Settings, Start, Trajectory};
use crate::mechanism::Mechanism;
use crate::motion::{march, Outcome, Span};
use crate::scalar::{Lanes, Scalar, LANES};
use multiversion::multiversion;
use threads::share_out;

/// Motions to be made, from states at one time.
pub struct Batch<'a> {
    /// The mechanism.
    pub m: &'a Mechanism,
    /// How many.
    pub members: usize,
    /// Parameters: a row for each, or one for all.
    pub p: &'a [f64],
    /// Coordinates, a row for each.
    pub q: &'a [f64],
    /// Rates, a row for each.
    pub u: &'a [f64],
    /// When all start, s.
    pub t: f64,
    /// When they end, s.
    pub until: f64,
    /// Increasing times at which their states are wanted, s.
    pub times: &'a [f64],
    /// Whether accelerations and reactions are wanted, too.
    pub reactions: bool,
    /// How each is made.
    pub settings: &'a Settings,
    /// On how many threads.
    pub threads: usize,
}

/// How a motion ended.
#[derive(Clone, Debug, Default)]
pub struct Ending {
    /// Its name.
    pub name: &'static str,
    /// Whether it did what was asked.
    pub is_ok: bool,
    /// When, s.
    pub t: f64,
    /// In a sentence.
    pub sentence: String,
    /// The item of the model that it is about, or nothing.
    pub path: String,
}

/// Motions made.
pub struct Motions {
    /// Of each motion, at each time, coordinates and rates; where they are wanted accelerations, and reactions in the order of
    /// [`reaction_names`]. NaN after its end.
    pub rows: Vec<f64>,
    /// How each ended.
    pub endings: Vec<Ending>,
}

/// Whether the motions of a mechanism by fixed steps can run side by side.
pub fn fits_lanes(m: &Mechanism) -> bool {
    TreeMotion::<Lanes>::fits(m)
}

impl Batch<'_> {
    /// Makes them. `go_on` is asked now and then; None where it answers false.
    pub fn run(&self, go_on: &mut dyn FnMut() -> bool) -> Option<Motions> {
        let width = self.times.len() * self.width();
        let mut made =
            Motions { rows: vec![f64::NAN; self.members * width], endings: vec![Ending::default(); self.members] };
        let in_lanes = self.is_march() && fits_lanes(self.m);
        let block = if in_lanes { LANES } else { 1 };
        let rows = made.rows.chunks_mut((block * width).max(1));
        let todo = rows.zip(made.endings.chunks_mut(block)).enumerate();
        let begin = || {
            let mut tree = in_lanes.then(|| TreeMotion::new(self.m, self.bind_lanes(0)));
            move |(i, (rows, endings)): (usize, (&mut [f64], &mut [Ending]))| {
                let done = tree.as_mut().is_some_and(|tree| self.side_by_side(tree, i * block, rows, endings));
                if !done {
                    let each = rows.chunks_mut(width).zip(endings).enumerate();
                    each.for_each(|(k, (rows, ending))| *ending = self.alone(i * block + k, rows));
                }
                true
            }
        };
        share_out(todo, self.threads, begin, go_on).then_some(made)
    }

    /// How many numbers there are of a motion at a time.
    pub fn width(&self) -> usize {
        let n = self.m.freedom();
        2 * n + if self.reactions { n + reaction_names(self.m).len() } else { 0 }
    }

    /// Whether it is a march of fixed steps to [`simulate`], too, and not too many.
    fn is_march(&self) -> bool {
        let Some(step) = self.settings.options.first_step else { return false };
        let steps = (self.until - self.t).abs() / step.abs();
        let resolution = 4.0 * f64::EPSILON * self.t.abs().max(self.until.abs());
        self.settings.method == "rk4"
            && self.settings.route.is_none()
            && step.abs() > resolution
            && steps < self.settings.options.max_steps as f64
    }

    /// The parameters of a member.
    fn parameters(&self, member: usize) -> &[f64] {
        row(self.p, self.m.parameters.len(), if self.has_own_parameters() { member } else { 0 })
    }

    fn has_own_parameters(&self) -> bool {
        self.p.len() > self.m.parameters.len()
    }

    /// The numbers of the members from one on, each in its lane; the last fills those that are left.
    fn bind_lanes(&self, first: usize) -> BoundValues<Lanes> {
        let members = |lane: usize| self.parameters((first + lane).min(self.members - 1));
        let values: [Vec<f64>; LANES] = std::array::from_fn(|lane| self.m.bind(members(lane)).values);
        let p: Vec<Lanes> = (0..self.m.parameters.len()).map(|i| Lanes::from_fn(|lane| members(lane)[i])).collect();
        self.m.with_values(&p, (0..self.m.values.len()).map(|i| Lanes::from_fn(|lane| values[lane][i])).collect())
    }

    /// A block in lanes; false where one of them fails, for then each is to be made for itself.
    fn side_by_side(
        &self,
        tree: &mut TreeMotion<Lanes>,
        first: usize,
        rows: &mut [f64],
        endings: &mut [Ending],
    ) -> bool {
        let (n, last) = (self.m.freedom(), self.members - 1);
        if self.has_own_parameters() {
            tree.n = self.bind_lanes(first);
        }
        let gather = |of: &[f64], i: usize| Lanes::from_fn(|lane| row(of, n, (first + lane).min(last))[i]);
        let mut y: Vec<Lanes> = [self.q, self.u].iter().flat_map(|of| (0..n).map(|i| gather(of, i))).collect();
        // Those of the tree are where the block before came to.
        let own = |i: usize| Lanes::from_fn(|lane| self.parameters((first + lane).min(last))[i]);
        y.extend((self.m.first_state()..self.m.parameters.len()).map(own));
        let step = self.settings.options.first_step.unwrap_or(f64::NAN).abs() * (self.until - self.t).signum();
        let span = Span { from: self.t, to: self.until, step, times: self.times };
        let mut shown = vec![Lanes::from_fn(|_| f64::NAN); self.times.len() * self.width()];
        if carry(tree, span, &y, &mut shown).is_err() {
            return false;
        }
        for (lane, rows) in rows.chunks_mut(shown.len()).enumerate() {
            rows.iter_mut().zip(&shown).for_each(|(x, lanes)| *x = lanes.0[lane]);
        }
        endings.fill(Ending::of(&Outcome::Completed, self.until, Outcome::Completed.to_string()));
        true
    }

    /// One motion for itself.
    fn alone(&self, member: usize, rows: &mut [f64]) -> Ending {
        let n = self.m.freedom();
        let (q, u) = (row(self.q, n, member), row(self.u, n, member));
        let start = Start { p: self.parameters(member), t: self.t, q, u, mode: None };
        let made = simulate(self.m, &start, self.until, self.settings, &mut |_| true);
        made.and_then(|run| self.read(&run, rows)).unwrap_or_else(|error| {
            let outcome = Outcome::DynamicsError(error);
            Ending::of(&outcome, self.t, outcome.to_string())
        })
    }

    fn read(&self, run: &Trajectory, rows: &mut [f64]) -> Result<Ending, DynamicsError> {
        let end = *run.steps.last().expect("a run has its start");
        let known = self.times.partition_point(|&t| t <= end);
        let read = if self.reactions { Trajectory::instants } else { Trajectory::sample };
        let found = read(run, self.m, &self.times[..known])?;
        rows.iter_mut().zip(found.concat()).for_each(|(row, x)| *row = x);
        Ok(Ending::of(&run.outcome, end, run.sentence(self.m, &[])))
    }
}

impl Ending {
    fn of(outcome: &Outcome, t: f64, sentence: String) -> Self {
        Ending { name: outcome.name(), is_ok: outcome.is_ok(), t, sentence, path: outcome.path().to_string() }
    }
}

fn row(of: &[f64], width: usize, i: usize) -> &[f64] {
    &of[i * width..(i + 1) * width]
}

/// Carries a tree along a span in the widest registers that the machine has.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx512bw+avx512cd+avx2", "x86_64+avx2"))]
fn carry(tree: &mut TreeMotion<Lanes>, span: Span, start: &[Lanes], shown: &mut [Lanes]) -> Result<(), DynamicsError> {
    let (width, n, mut seen) = (shown.len() / span.times.len().max(1), tree.m.freedom(), vec![]);
    march(span, start, |t, y, dy| tree.rate(t, y, dy), |y| seen.push(y.to_vec()))?;
    for (i, (y, &t)) in seen.iter().zip(span.times).enumerate() {
        let (state, solution) = shown[i * width..(i + 1) * width].split_at_mut(2 * n);
        state.copy_from_slice(&y[..2 * n]);
        if !solution.is_empty() {
            tree.write_solution(Lanes::of(t), y, solution)?;
        }
    }
    Ok(())
}
