//! Random mechanisms, and random states of them.

use crate::model::*;
use crate::random_motions::*;
use crate::rng::Rng;
use freebody::compile::Compiled;
use freebody::dynamics::{Route, Workspace};
use freebody::forces;
use freebody::joints::{FieldKind, Joint, Kind};
use freebody::mechanism::{DriveKind, Mechanism, Part};
use freebody::spec::*;

/// What a random mechanism is to hold.
#[derive(Clone, Copy)]
pub struct Recipe {
    pub bodies: usize,
    pub particles: usize,
    pub loops: usize,
    pub forces: usize,
    pub motions: usize,
    /// Coordinates and distances that are held where they are.
    pub locks: usize,
    /// Whether actuators may have a direction of their own, and laws may read the state.
    pub own_directions: bool,
    /// Odd zeros and senses of the coordinates, absolute angles.
    pub odd: bool,
    /// Whether some forces, motions and joints that close loops are not in place.
    pub idle: bool,
}

/// The motion of `base`, to which all else is joined as if it were ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// Welded to ground at a place.
    At([f64; 3]),
    /// Sliding along x at a given acceleration.
    Sliding(f64),
}

impl Recipe {
    /// A mechanism drawn from a seed: masses from 1e-2 to 1e2 kg, lengths of a metre, forces of some newtons. All
    /// masses and all force laws have the parameter `scale` as a factor.
    pub fn draw(&self, seed: u64, base: Base) -> Thrown {
        let mut rng = Rng::new(seed);
        let rng = &mut rng;
        let direction = rng.about(3.0);
        let gravity = turned(freebody::plane::vec2(9.81, 0.0), direction + base.angle());
        let mut thrown = Thrown::new([gravity.x, gravity.y]);
        thrown.model = std::mem::take(&mut thrown.model).parameter("scale", 1.0);
        base.lay(&mut thrown);
        let mut bodies = vec!["base".to_string()];
        for i in 0..self.bodies + self.particles {
            let name = format!("b{i}");
            let kind = match i {
                0 => *rng.of(&moving()),
                _ if i < self.bodies => *rng.of(&of_the_tree()),
                _ => *rng.of(&for_particles()),
            };
            let rigid: Vec<String> = bodies.iter().filter(|b| !thrown.is_particle(b)).cloned().collect();
            let parent = rng.of(&rigid).clone();
            // Two massless links in a row would fold with no inertia to resist it.
            let after_massless = massless_body(&thrown, &bodies[i]);
            let mass = 10f64.powf(rng.about(2.0));
            let place = [rng.about(2.0), rng.about(2.0), rng.about(3.0)];
            // A massless link has something hinged to its far end that is sure to resist its turning.
            let massless =
                i + 1 < self.bodies && !after_massless && !massless_body(&thrown, &parent) && rng.chance(0.2);
            let (kind, parent) = if after_massless { (Kind::Hinge, bodies[i].clone()) } else { (kind, parent) };
            if i >= self.bodies {
                thrown.throw_particle(&name, heavy(mass), [place[0], place[1]]);
            } else if massless {
                thrown.throw(&name, literal(0.0), literal(0.0), [0.0, 0.0], place);
            } else {
                let k = rng.within(0.1, 0.5);
                let centre = [rng.about(0.5), rng.about(0.5)];
                thrown.throw(&name, heavy(mass), heavy(mass * k * k), centre, place);
            }
            let kind = if massless { Kind::Hinge } else { kind };
            let reversed = i < self.bodies && !massless && rng.chance(0.3);
            let ends = if reversed { [name.as_str(), &parent] } else { [parent.as_str(), &name] };
            thrown.join(rng, &format!("j{i}"), kind, ends, true, self.odd && !reversed);
            bodies.push(name);
        }
        for i in 0..self.loops {
            let b = rng.of(&bodies[1..]).clone();
            let others: Vec<String> = bodies.iter().filter(|&a| *a != b && !thrown.is_particle(a)).cloned().collect();
            let a = rng.of(&others).clone();
            let kinds: Vec<Kind> = Kind::ALL.iter().copied().filter(|k| closes(k, 1 + i % 2)).collect();
            let fits = |k: &&Kind| !thrown.is_particle(&b) || suits_particle(**k);
            let fitting: Vec<Kind> = kinds.iter().filter(fits).copied().collect();
            let kind = *rng.of(&fitting);
            thrown.join(rng, &format!("loop{i}"), kind, [&a, &b], false, false);
        }
        for i in 0..self.forces {
            // What lies still on a table has no friction of sliding.
            let all: Vec<_> = forces::ALL.iter().filter(|f| !f.card().word.ends_with("_friction")).collect();
            let kind = *all[i % all.len()];
            let turns = kind.card().fields.iter().any(|f| f.kind == FieldKind::Body);
            let able: Vec<String> = bodies.iter().filter(|b| !(turns && thrown.is_particle(b))).cloned().collect();
            let two = [rng.of(&able[1..]).clone(), rng.of(&able).clone()];
            let two = if two[0] == two[1] { [two[0].clone(), "base".into()] } else { two };
            let force = force_for(&format!("f{i}"), kind, &two, base.angle(), &mut thrown, rng);
            thrown.model.0.forces.push(force);
        }
        for i in 0..self.motions {
            let rigid: Vec<String> = bodies[1..].iter().filter(|b| !thrown.is_particle(b)).cloned().collect();
            let body = rng.of(&rigid).clone();
            self.drive(&mut thrown, &format!("m{i}"), &body, rng);
        }
        for i in 0..self.locks {
            lock(&mut thrown, &format!("e{i}"), &bodies[1..], rng);
        }
        let Spec { joints, forces, motions, .. } = &mut thrown.model.0;
        // What runs along a curve has no place on it before it is there.
        let on_curve = |word: &str| ["cam", "curved_slot"].contains(&word);
        let loops = joints.iter_mut().filter(|joint| joint.name.starts_with("loop") && !on_curve(&joint.kind));
        let loops = loops.map(|joint| &mut joint.engaged);
        let others = forces
            .iter_mut()
            .map(|f| &mut f.engaged)
            .chain(motions.iter_mut().filter(|m| m.name != "hold").map(|m| &mut m.engaged));
        for engaged in loops.chain(others).filter(|_| self.idle) {
            *engaged = rng.chance(0.6);
        }
        thrown
    }

    /// A motion of a body's angle or of one of its points, that holds at time 0 at the pose thrown.
    fn drive(&self, thrown: &mut Thrown, name: &str, body: &str, rng: &mut Rng) {
        let local = freebody::plane::vec2(rng.about(1.0), rng.about(1.0));
        let (point, now) = (thrown.point(body, local), thrown.frame(body).place(local));
        let bench = Bench::new(thrown);
        let some = rng.below(bench.q.len());
        let coordinate = &bench.compiled.mechanism.coordinate(some).name;
        let (gauge, at) = match rng.below(4) {
            3 => (format!("'{coordinate}'"), bench.q[some]),
            0 => (format!("angle({body})"), thrown.pose[body][2]),
            1 => (format!("x({point})"), now.x),
            _ => (format!("y({point})"), now.y),
        };
        let feedback = self.own_directions && rng.chance(0.5);
        let state = if feedback {
            format!(" + 0.1*sin(x({body}.origin)) - 0.1*sin({:?})", thrown.pose[body][0])
        } else {
            String::new()
        };
        let (level, law) = match rng.below(3) {
            0 => ("position", format!("{at:?} + 0.2*sin(3*t){state}")),
            1 => ("velocity", format!("0.4*cos(2*t){state}")),
            _ => ("acceleration", format!("1.5*sin(t){state} - 0.3*rate({gauge})")),
        };
        // An actuator that pushes another way, but not across what it drives.
        let by = (self.own_directions && rng.chance(0.5))
            .then(|| format!("({gauge}) + 0.2*angle({body}) + 0.1*x({body}.origin)"));
        let before = thrown.model.clone();
        thrown.model = before.clone().motion(name, &gauge, &law, level, by.as_deref());
        if !is_possible(thrown) {
            thrown.model = before;
        }
    }
}

/// A lock of a coordinate of a joint, or of a distance.
fn lock(thrown: &mut Thrown, name: &str, bodies: &[String], rng: &mut Rng) {
    let named = thrown.model.0.joints.iter().filter(|joint| joint.name.starts_with('j'));
    let names: Vec<String> = named.flat_map(|joint| &joint.coordinates).map(|c| format!("'{}'", c.name)).collect();
    let body = rng.of(bodies).clone();
    let far = thrown.some_point(&body, rng);
    let gauge = if rng.chance(0.6) { rng.of(&names).clone() } else { format!("distance(base.O, {far})") };
    let before = thrown.model.clone();
    let (name, when, then) = (name.to_string(), "1".to_string(), vec![Action::Lock(vec![gauge])]);
    let event = Event { name, when, direction: 0, condition: None, opening: true, guard: false, then };
    thrown.model.0.events.push(event);
    if !is_possible(thrown) {
        thrown.model = before;
    }
}

/// Whether loops and other motions neither exclude a motion or lock, nor already give it.
fn is_possible(thrown: &Thrown) -> bool {
    let bench = Bench::new(thrown);
    let mut workspace = bench.balance();
    workspace.move_to(0.0, &bench.q, &vec![0.0; bench.q.len()]);
    workspace.instant(Route::Minimal).is_ok_and(|now| now.drives_determinate.iter().all(|&sure| sure))
}

/// A mass with its factor.
fn heavy(mass: f64) -> Number {
    written(format!("scale*{mass:?}"))
}

/// Joints that a body may hang on.
fn of_the_tree() -> Vec<Kind> {
    Kind::ALL.iter().copied().filter(|&k| has_pose(k)).collect()
}

fn moving() -> Vec<Kind> {
    of_the_tree().into_iter().filter(|k| !k.card().coordinates.is_empty()).collect()
}

fn for_particles() -> Vec<Kind> {
    of_the_tree().into_iter().filter(|&k| suits_particle(k)).collect()
}

/// Whether a body has no mass of its own.
fn massless_body(thrown: &Thrown, body: &str) -> bool {
    let spec = thrown.model.0.bodies.iter().find(|b| b.name == body);
    spec.is_some_and(|b| b.pieces[0].mass == literal(0.0))
}

impl Base {
    fn angle(&self) -> f64 {
        match self {
            Base::At([_, _, angle]) => *angle,
            Base::Sliding(_) => 0.0,
        }
    }
    fn lay(&self, thrown: &mut Thrown) {
        let pose = if let Base::At(pose) = self { *pose } else { [0.0; 3] };
        thrown.throw("base", written("scale*1.0"), written("scale*1.0"), [0.0, 0.0], [0.0; 3]);
        let model =
            std::mem::take(&mut thrown.model).point("ground.base", [pose[0], pose[1]]).point("base.O", [0.0; 2]);
        let of = points(&["ground.base", "base.O"]);
        thrown.readings.insert("foundation".into(), vec![0.0]);
        thrown.model = match self {
            Base::At(_) => model.joint("foundation", "weld", &[("of", of), ("angle", value(pose[2]))], &[]),
            Base::Sliding(a) => model
                .joint(
                    "foundation",
                    "slider",
                    &[("along", line("ground.base", 0.0)), ("line", line("base.O", 0.0))],
                    &["foundation"],
                )
                .motion("hold", "foundation", &format!("{a:?}"), "acceleration", None),
        };
    }
}

/// Whether a joint closes a loop of places by so many rows.
fn closes(kind: &Kind, rows: usize) -> bool {
    let card = kind.card();
    card.rows.len() == rows && !card.rows.iter().any(|row| row.of_rates)
}

/// A force of the list between two bodies, its fields drawn as its card asks.
pub fn force_for(
    name: &str,
    kind: &dyn forces::ForceKind,
    [a, b]: &[String; 2],
    turn: f64,
    thrown: &mut Thrown,
    rng: &mut Rng,
) -> Element {
    let card = kind.card();
    let (p, q) = (thrown.some_point(a, rng), thrown.some_point(b, rng));
    let gauge = match rng.below(3) {
        1 if !thrown.is_particle(a) && !thrown.is_particle(b) => format!("angle({a}) - angle({b})"),
        2 => format!("distance({p}, {q})^2"),
        _ => format!("distance({p}, {q})"),
    };
    // The axes of a particle do not turn.
    let body_fixed = rng.chance(0.5) && !thrown.is_particle(a);
    let stiffness = rng.within(1.0, 20.0);
    let has = |word: &str| card.fields.iter().any(|f| f.name == word);
    let mut fields = vec![];
    for field in &card.fields {
        let drawn = match (field.name, field.kind) {
            // A spring is given between two points or along a gauge.
            ("along", _) if has("between") => continue,
            ("between", _) if rng.chance(0.5) => {
                fields.push(("along", text(gauge.clone())));
                continue;
            }
            ("value", _) if has("potential") => text(format!("-scale*{stiffness:?}*(({gauge}) - 0.7)")),
            ("potential", _) => text(format!("scale*{stiffness:?}/2*(({gauge}) - 0.7)^2")),
            ("direction", _) => text(format!("{:?} + 0.2*t", rng.about(3.0) + if body_fixed { 0.0 } else { turn })),
            ("x" | "y", FieldKind::Law) if !body_fixed => continue,
            (_, FieldKind::Point) => text(p.clone()),
            (_, FieldKind::Points) => points(&[&p, &q]),
            (_, FieldKind::Area) => circle(&p, rng.within(0.2, 1.0)),
            (_, FieldKind::Flag) => Value::Flag(rng.chance(0.5)),
            ("from", FieldKind::Body) => text(b.clone()),
            (_, FieldKind::Body) => text(a.clone()),
            (_, FieldKind::Gauge) => text(gauge.clone()),
            (_, FieldKind::Frame) => text(if body_fixed { "body" } else { "fixed" }),
            (_, FieldKind::Number) => match field.dimension {
                Some("m" | "rad") => value(rng.within(0.2, 1.0)),
                _ => text(format!("scale*{:?}", rng.within(0.5, 10.0))),
            },
            (_, FieldKind::Law) => text(format!("scale*({:?} + 1.5*sin(2*t) - 0.3*rate({gauge}))", rng.about(5.0))),
            other => panic!("a force with a field that is new to this test: {other:?}"),
        };
        fields.push((field.name, drawn));
    }
    element(name, card.word, &fields, vec![])
}

/// A workspace with all locks in place.
pub fn with_locks<'m>(m: &'m Mechanism, p: &[f64]) -> Workspace<'m> {
    let mut workspace = Workspace::new(m, p);
    for d in (0..m.drives.len()).filter(|&d| m.drives[d].kind == DriveKind::Lock) {
        let mode = workspace.switch_part(Part::Drive(d), true).expect("a lock comes with its event");
        workspace.enter(&mode);
    }
    workspace
}

/// A mechanism that can be put into random states.
pub struct Bench {
    pub compiled: Compiled,
    pub q: Vec<f64>,
    pub p: Vec<f64>,
}

#[derive(Clone, Debug)]
pub struct State {
    pub t: f64,
    pub q: Vec<f64>,
    pub u: Vec<f64>,
}

impl Bench {
    pub fn new(thrown: &Thrown) -> Self {
        let compiled = thrown.model.compile();
        let p = compiled.mechanism.parameters_with(&[]);
        let q = thrown.coordinates(&compiled.mechanism, &compiled.mechanism.bind(&p));
        Bench { compiled, q, p }
    }

    /// The same model, left out of it what is not in place.
    pub fn without_idle(thrown: &Thrown) -> Self {
        let mut thrown = thrown.clone();
        let Spec { joints, forces, motions, .. } = &mut thrown.model.0;
        joints.retain(|joint| joint.engaged);
        forces.retain(|force| force.engaged);
        motions.retain(|motion| motion.engaged);
        Bench::new(&thrown)
    }

    pub fn balance(&self) -> Workspace<'_> {
        with_locks(&self.compiled.mechanism, &self.p)
    }

    /// The mechanism in a few words, for whoever reads a failure.
    pub fn label(&self) -> String {
        let m = &self.compiled.mechanism;
        let n = m.bind(&self.p);
        let body = |b: usize| format!("{}({:.2} kg)", m.bodies[b].name, n.mass[b]);
        let joint = |j: &freebody::mechanism::Joint| {
            let [a, b] = m.ends(j).map(body);
            format!("{} {:?} {a} {b}{}", j.name, j.kind, if j.child.is_some() { "" } else { " closing" })
        };
        let drives = m.drives.iter().map(|d| format!("motion {}", d.name));
        m.joints.iter().map(joint).chain(drives).collect::<Vec<_>>().join("; ")
    }

    /// Whether every distance from a pole is well above 0, where polar coordinates are singular.
    fn off_the_pole(&self, q: &[f64]) -> bool {
        let m = &self.compiled.mechanism;
        let n = m.bind(&self.p);
        m.coordinates.iter().zip(q).all(|(&(joint, k), q)| {
            let c = &m.joints[joint].coordinates[k];
            let word = m.joints[joint].kind.card().coordinates[c.card].name;
            word != "r" || n.values[c.zero] + c.sense * q > 0.1
        })
    }

    /// A random state on the closed loops within `reach` of the pose thrown, or nearer where loops close nowhere else;
    /// None where no state was found.
    pub fn state(&self, workspace: &mut Workspace, rng: &mut Rng, reach: f64) -> Option<State> {
        let n = self.q.len();
        let at_rest = vec![0.0; n];
        workspace.move_to(0.0, &self.q, &at_rest);
        let mode = workspace.with_row_offsets();
        workspace.enter(&mode);
        for i in 0..200 {
            let reach = reach * 0.97_f64.powi(i);
            let t = rng.within(0.0, 1.0);
            let mut q: Vec<f64> = self.q.iter().map(|q| q + rng.about(reach)).collect();
            let mut u = rng.vector(n, 2.0);
            let closed = workspace.project_positions(&mode, t, &mut q, &at_rest).is_ok()
                && workspace.project_velocities(&mode, t, &q, &mut u).is_ok();
            // Loops may close far off, at a place where the mechanism is all but singular.
            let near = q.iter().zip(&self.q).all(|(a, b)| (a - b).abs() < 2.0) && u.iter().all(|u| u.abs() < 20.0);
            if closed && near && self.off_the_pole(&q) {
                return Some(State { t, q, u });
            }
        }
        None
    }
}
