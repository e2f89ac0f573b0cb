//! Many motions of one mechanism: side by side where its equations are the same operations for all, each for itself where not;
//! over threads. A motion has the same bits whatever stands beside it; but where it finds its steps side by side, those of [`simulate`].

mod adaptive;
mod side_by_side;
mod starts;
mod threads;

pub use starts::{starts, Wish};

use crate::dynamics::{reaction_names, DynamicsError, SmoothMotion, Workspace};
use crate::hybrid::{simulate, Settings, Start, Trajectory};
use crate::mechanism::Mechanism;
use crate::motion::{self, Outcome, TIGHTEST};
use crate::series::Traced;
use adaptive::Adaptive;
use side_by_side::{SideBySide, SIDE_BY_SIDE};
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

/// Whether the motions of a mechanism by fixed steps can run side by side.
pub fn fits_lanes(m: &Mechanism) -> bool {
    m.is_tree() && SmoothMotion::<Traced>::fits(m)
}

impl Batch<'_> {
    /// Writes of each motion, at each time, coordinates and rates; where they are wanted accelerations, and reactions in the order of
    /// [`reaction_names`]; NaN after its end. Answers how each ended. `go_on` is asked now and then; None where it answers false.
    pub fn run(&self, rows: &mut [f64], go_on: &mut dyn FnMut() -> bool) -> Option<Vec<Ending>> {
        let width = self.times.len() * self.width();
        let mut endings = vec![Ending::default(); self.members];
        let fits = SmoothMotion::<Traced>::fits(self.m);
        let recorded = (fits && self.is_march()).then(|| self.record()).flatten();
        let recordings = (fits && self.has_own_steps()).then(|| self.recordings()).flatten();
        let block = if recorded.is_some() || recordings.is_some() { SIDE_BY_SIDE } else { 1 };
        let todo = rows.chunks_mut((block * width).max(1)).zip(endings.chunks_mut(block)).enumerate();
        let begin = || {
            let mut beside = recorded.as_ref().map(|recorded| SideBySide::new(self, recorded));
            let mut adaptive = recordings.as_ref().map(|recordings| Adaptive::new(self, recordings));
            move |(i, (rows, endings)): (usize, (&mut [f64], &mut [Ending]))| {
                match (&mut beside, &mut adaptive) {
                    (Some(beside), _) => beside.make(i * block, rows, endings),
                    (_, Some(adaptive)) => adaptive.make(i * block, rows, endings),
                    _ => endings[0] = self.alone(i, rows),
                }
                true
            }
        };
        share_out(todo, self.threads, begin, go_on).then_some(endings)
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
        self.m.is_tree()
            && self.settings.marches()
            && step.abs() > resolution
            && steps < self.settings.options.max_steps as f64
    }

    /// Whether each member finds its steps by the default method, and nothing is to be refused.
    fn has_own_steps(&self) -> bool {
        let Settings { method, route, options, .. } = self.settings;
        let is_step = |step: f64| step.is_finite() && step != 0.0;
        *method == motion::METHODS[0].name
            && route.is_none()
            && options.rtol >= TIGHTEST
            && options.max_step > 0.0
            && options.first_step.is_none_or(is_step)
    }

    /// Goes to the start of a member.
    fn place(&self, member: usize, workspace: &mut Workspace) {
        let [q, u] = self.state(member);
        workspace.restart(self.parameters(member));
        workspace.move_to(self.t, q, u);
    }

    /// The parameters of a member.
    fn parameters(&self, member: usize) -> &[f64] {
        row(self.p, self.m.parameters.len(), if self.has_own_parameters() { member } else { 0 })
    }

    /// The coordinates and rates with which a member starts.
    fn state(&self, member: usize) -> [&[f64]; 2] {
        [self.q, self.u].map(|of| row(of, self.m.freedom(), member))
    }

    fn has_own_parameters(&self) -> bool {
        self.p.len() > self.m.parameters.len()
    }

    /// One motion for itself.
    fn alone(&self, member: usize, rows: &mut [f64]) -> Ending {
        rows.fill(f64::NAN);
        let [q, u] = self.state(member);
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
