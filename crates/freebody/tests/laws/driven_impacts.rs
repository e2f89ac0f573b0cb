//! Driven mechanisms thrown together that strike. During an impact a motion keeps its rate and a lock its place, so they
//! have impulses; with these every body balances, and their work is in the books apart from what is lost.

use crate::model::*;
use crate::random::*;
use crate::random_mechanisms::HOME;
use crate::random_motions::Thrown;
use crate::rng::{seeds, Rng};
use freebody::contact::complementarity::ImpactLaw;
use freebody::dynamics::{joint_place, DynamicsError, Route, Workspace};
use freebody::hybrid::{simulate, Impulses, ModeChange, Rule, Settings, Start, Trajectory};
use freebody::kinematics::gradient;
use freebody::mechanism::{DriveKind, Gap, Mechanism};
use freebody::motion::{Options, Outcome};
use freebody::plane::{vec2, Twist, Vec2, Wrench};
use freebody::spec::{Action, Cable, CableEnd, Contact, Event, Stop, Surface};

const DRAWS: u64 = 500;
/// Round-off of an impact, and of the ledger of a motion, over the largest that takes part.
const ROUND_OFF: f64 = 1e-9;
/// Energy over that of the start, from which speeds are taken to grow beyond bounds.
const BEYOND: f64 = 1e2;
const LAWS: [ImpactLaw; 3] = [ImpactLaw::Newton, ImpactLaw::Poisson, ImpactLaw::Sequential];

/// A mechanism with motions, its start, and what it strikes soon.
struct Striking {
    bench: Bench,
    start: State,
    rng: Rng,
}

/// Draws until there is a motion and something approaches; none of the two is sure in a mechanism thrown together.
fn draw(seed: u64) -> Striking {
    (0..).find_map(|again| draw_once(DRAWS * again + seed)).expect("one of many")
}

fn draw_once(seed: u64) -> Option<Striking> {
    let mut rng = Rng::new(7000 + seed);
    let recipe = Recipe {
        bodies: 2 + rng.below(4),
        particles: rng.below(2),
        loops: rng.below(2),
        forces: rng.below(4),
        motions: 1 + rng.below(2),
        own_directions: false,
        odd: true,
        locks: 0,
        idle: false,
    };
    let mut thrown = recipe.draw(seed, HOME);
    let bench = Bench::new(&thrown);
    let m = &bench.compiled.mechanism;
    let mut workspace = bench.balance();
    let start = bench.state(&mut workspace, &mut rng, 0.3)?;
    if !m.drives.iter().any(|drive| drive.is_motion()) {
        return None;
    }
    workspace.move_to(start.t, &start.q, &start.u);
    workspace.check_free_lengths().ok()?;
    obstruct(&mut thrown, &workspace, &mut rng)?;
    if seed.is_multiple_of(4) {
        let coordinate = m.coordinate(rng.below(m.freedom())).name.clone();
        let then = vec![Action::Lock(vec![format!("'{coordinate}'")])];
        let (name, when) = ("hold".to_string(), format!("t - {:?}", start.t + 0.02));
        thrown.model.0.events.push(Event {
            name,
            when,
            direction: 0,
            condition: None,
            opening: false,
            guard: false,
            then,
        });
    }
    let bench = Bench::new(&thrown);
    can_lock(&bench, &start).then_some(Striking { bench, start, rng })
}

/// Whether motions and loops leave free what is to be locked.
fn can_lock(bench: &Bench, start: &State) -> bool {
    let drives = &bench.compiled.mechanism.drives;
    let Some(lock) = drives.iter().position(|drive| drive.kind == DriveKind::Lock) else { return true };
    let mut workspace = bench.balance();
    workspace.move_to(start.t, &start.q, &start.u);
    workspace.instant(Route::Minimal).is_ok_and(|now| now.drives_determinate[lock])
}

/// Puts something in the way of a point of a body, of its turning, or of its going away.
fn obstruct(thrown: &mut Thrown, now: &Workspace, rng: &mut Rng) -> Option<()> {
    let names: Vec<String> =
        thrown.pose.keys().filter(|b| !["base", "ground"].contains(&b.as_str())).cloned().collect();
    let a = rng.of(&names).clone();
    let others: Vec<String> = thrown.pose.keys().filter(|b| **b != a && !thrown.is_particle(b)).cloned().collect();
    let b = rng.of(&others).clone();
    let p = thrown.some_point(&a, rng);
    let (place, v) = moving(thrown, now, &p, &a);
    let (soon, e) = (rng.within(0.02, 0.1), literal(*rng.of(&[0.0, 0.3, 0.7, 1.0])));
    let kind = rng.below(3);
    if kind == 0 && !thrown.is_particle(&a) {
        let body = body_named(now.m, &a);
        let (angle, w) = (now.at().k.pose[body].turn.angle, now.at().k.twist[body].w);
        let gap = format!("{:?}*(angle({a}) - ({:?}))", -w.signum(), angle + w * soon);
        let (name, stiffness, damping) = ("bumper".into(), None, None);
        thrown.model.0.stops.push(Stop { name, gap, restitution: e, stiffness, damping, engaged: true });
        return (w.abs() > 0.1).then_some(());
    }
    let frame = now.frame(body_named(now.m, &b));
    let twist = now.at().k.twist[body_named(now.m, &b)];
    let other = |at: Vec2| twist.at(at - now.at().k.pose[body_named(now.m, &b)].at);
    let own = |at: Vec2| pose(frame).turn.undo(at - pose(frame).at);
    if kind == 1 {
        let q = thrown.point(&b, own(place + turned(vec2(rng.within(0.3, 1.0), 0.0), rng.about(3.0))));
        let there = pose(frame).place(own_point(thrown, &q));
        let (span, rate) = (place - there, v - other(there));
        let going = span.dot(rate) / span.norm();
        let ends = [&p, &q].map(|point| CableEnd::Point(point.clone()));
        let length = Some(literal(span.norm() + going * soon));
        let (name, over, stiffness, damping) = ("bumper".into(), vec![], None, None);
        let string = Cable { name, ends, over, length, restitution: e, stiffness, damping, engaged: true };
        thrown.model.0.strings.push(string);
        return (going > 0.1).then_some(());
    }
    let rate = v - other(place);
    let normal = turned(rate * (-1.0 / rate.norm()), rng.about(0.7));
    let foot = thrown.point(&b, own(place + normal * (rate.dot(normal) * soon)));
    let angle = normal.y.atan2(normal.x) - std::f64::consts::FRAC_PI_2 - frame[2];
    let (friction, nought) = (literal(*rng.of(&[0.0, 0.2, 0.6])), None);
    let of = [Surface::Point(p), Surface::Line(crate::model::place(&foot, angle))];
    thrown.model.0.contacts.push(Contact {
        name: "bumper".into(),
        of,
        friction,
        static_friction: nought,
        rough: false,
        restitution: e,
        stiffness: None,
        damping: None,
        engaged: true,
    });
    (rate.norm() > 0.1).then_some(())
}

/// A point in its body's frame.
fn own_point(thrown: &Thrown, name: &str) -> Vec2 {
    let point = thrown.model.0.points.iter().find(|point| point.name == name).expect("a point of the model");
    let [x, y] = [0, 1].map(|i| if let freebody::spec::Number::Literal(x) = point.at[i] { x } else { f64::NAN });
    vec2(x, y)
}

/// Place and velocity of a point of a body.
fn moving(thrown: &Thrown, now: &Workspace, point: &str, body: &str) -> (Vec2, Vec2) {
    let body = body_named(now.m, body);
    let place = pose(now.frame(body)).place(own_point(thrown, point));
    (place, now.at().k.twist[body].at(place - now.at().k.pose[body].at))
}

fn run(striking: &mut Striking) -> Trajectory {
    let Striking { bench, start, rng } = striking;
    let options = Options { rtol: 1e-11, max_steps: 20_000, ..Options::default() };
    let impacts = Rule::Law(*rng.of(&LAWS));
    let settings = Settings { method: "dop853".into(), options, route: None, impacts, jam_by_impact: true };
    let at = Start { p: &bench.p, t: start.t, q: &start.q, u: &start.u, mode: None };
    simulate(&bench.compiled.mechanism, &at, start.t + 0.2, &settings, &mut |_| true).expect("a state to start from")
}

/// What an impact puts on a body.
struct Impulse {
    body: usize,
    at: Vec2,
    of: Wrench,
}

/// The impulses of an impact, each where it acts, in the configuration in which `now` is.
fn impulses(now: &Workspace, impact: &Impulses) -> Vec<Impulse> {
    let (m, at) = (now.m, now.at());
    let mut all = vec![];
    let mut pair = |[a, b]: [usize; 2], place: Vec2, of: Wrench| {
        all.extend([Impulse { body: b, at: place, of }, Impulse { body: a, at: place, of: -of }]);
    };
    for (i, [x, y, couple]) in impact.joints.iter().enumerate() {
        pair(m.ends(&m.joints[i]), joint_place(at, i), Wrench { f: vec2(*x, *y), m: *couple });
    }
    for (name, on_first) in &impact.groups {
        let group = m.groups.iter().find(|group| group.name == *name).expect("a group of the model");
        let (constraint, [a, b]) = (&m.unilateral[group.constraints.start], group.ends);
        let of = Wrench { f: -*on_first, m: 0.0 };
        match &constraint.gap {
            // A string pulls along itself: where on that line does not matter.
            Gap::Cable(cable) => match cable.ends[0] {
                freebody::mechanism::End::Tied(site) => pair([a, b], now.site(site), of),
                _ => unreachable!("the strings drawn are tied"),
            },
            Gap::ContactPair(touch) => pair([a, b], now.site(touch.disk.centre), of),
            Gap::Gauge(_) => {}
        }
    }
    let mut along = |gauge: &freebody::gauges::ModelExpr, impulse: f64| {
        for body in m.bodies_of(gauge) {
            all.push(Impulse { body, at: at.k.pose[body].at, of: gradient(at, gauge, body) * impulse });
        }
    };
    for (drive, &impulse) in m.drives.iter().zip(&impact.drives) {
        along(&drive.of, impulse);
    }
    for contact in &impact.contacts {
        let group = m.groups.iter().find(|group| group.name == contact.name).expect("a group of the model");
        if let Gap::Gauge(gap) = &m.unilateral[group.constraints.start].gap {
            along(gap, contact.normal);
        }
    }
    all
}

/// The velocities of all bodies at a state of the impact.
fn twists(now: &mut Workspace, t: f64, y: &[f64]) -> Vec<Twist> {
    let n = now.m.freedom();
    now.move_to(t, &y[..n], &y[n..2 * n]);
    now.at().k.twist.clone()
}

/// The impulses on every body are the change of its momentum; those of the drives do the work that the books have, and
/// those of what is struck take what is lost. Returns the largest impulse of a drive over the largest of all.
fn assert_balanced(label: &str, now: &mut Workspace, change: &ModeChange) -> f64 {
    let (m, impact) = (now.m, change.impulses.as_ref().expect("an impact"));
    let [before, after] = change.states.as_ref().expect("an impact");
    let old = twists(now, change.t, before);
    let new = twists(now, change.t, after);
    let all = impulses(now, impact);
    let size = |p: &Impulse| p.of.f.norm().max(p.of.m.abs());
    let most = all.iter().map(size).fold(f64::MIN_POSITIVE, f64::max);
    for body in 1..m.bodies.len() {
        let (centre, _) = now.centre(body);
        let (mass, inertia, arm) = (now.at().n.mass[body], now.at().n.inertia[body], centre - now.at().k.pose[body].at);
        let mut left = (new[body].at(arm) - old[body].at(arm)) * -mass;
        let mut turn = (new[body].w - old[body].w) * -inertia;
        let mut largest = most.max(mass * (new[body].at(arm).norm() + old[body].at(arm).norm()));
        for p in all.iter().filter(|p| p.body == body) {
            left += p.of.f;
            turn += p.of.m + (p.at - centre).cross(p.of.f);
            largest = largest.max((p.at - centre).norm() * p.of.f.norm());
        }
        let off = if m.bodies[body].particle { left.norm() } else { left.norm().max(turn.abs()) };
        assert!(off < ROUND_OFF * largest, "{label}: {}: {off:e} N·s of {largest:e} left over", m.bodies[body].name);
    }
    let energy = now.kinetic_energy() + change.lost.abs();
    let (mut work, mut strongest) = (0.0, 0.0_f64);
    for (i, drive) in m.drives.iter().enumerate().filter(|(_, drive)| drive.kind != DriveKind::Coupling) {
        let along = |of: &[Twist]| -> f64 {
            m.bodies_of(&drive.of).into_iter().map(|body| gradient(now.at(), &drive.of, body).power(of[body])).sum()
        };
        let (p, booked, rate) = (impact.drives[i], impact.drive_works[i], along(&new));
        let grown = if drive.kind == DriveKind::Lock { 0.0 } else { (p * (along(&old) - rate)).abs() };
        let engaged = change.of.contains(&drive.name);
        assert!(engaged || grown < ROUND_OFF * energy, "{label}: the rate of {} jumps", drive.name);
        assert!((booked - p * rate).abs() < ROUND_OFF * energy, "{label}: {} did {booked} J", drive.name);
        work += p * rate;
        strongest = strongest.max(p.abs() / most);
    }
    // What the impulses of contacts, strings, stops and of what is engaged take, at the mean of the rates.
    let mean = |i: usize| (old[i] + new[i]) * 0.5;
    let gain: f64 = (1..m.bodies.len())
        .map(|i| {
            let arm = now.centre(i).0 - now.at().k.pose[i].at;
            let (jump, mid) = (new[i].at(arm) - old[i].at(arm), mean(i).at(arm));
            now.at().n.mass[i] * jump.dot(mid) + now.at().n.inertia[i] * (new[i].w - old[i].w) * mean(i).w
        })
        .sum();
    assert!(
        (work - gain - change.lost).abs() < ROUND_OFF * energy,
        "{label}: {} J lost of {}",
        change.lost,
        work - gain
    );
    assert!(change.lost > -ROUND_OFF * energy, "{label}: {} J created", -change.lost);
    strongest
}

#[test]
fn a_drive_that_strikes_has_an_impulse_and_does_work() {
    let (mut impacts, mut driven, mut closed, mut total) = (0, 0, 0, 0);
    for seed in seeds(0..DRAWS, 10) {
        let mut striking = draw(seed);
        let run = run(&mut striking);
        let bench = &striking.bench;
        let label = format!("seed {seed}, {}, {:?}", bench.label(), run.settings.impacts);
        let mut now = bench.balance();
        for change in run.mode_changes.iter().filter(|change| change.impulses.is_some()) {
            impacts += 1;
            driven += usize::from(assert_balanced(&label, &mut now, change) > 1e-6);
        }
        closed += usize::from(books_close(&label, &bench.compiled.mechanism, &run));
        total += 1;
        let refused = run.outcome.name() == "no_impact" && !is_driven_through(&run.outcome);
        assert!(!refused, "{label}: {}", run.outcome);
    }
    assert!(
        driven > total / 2 && 10 * closed > 8 * total,
        "{impacts} impacts, {driven} with drives, {closed} ledgers of {total}"
    );
}

/// Whether a motion or a lock met what cannot yield to it.
fn is_driven_through(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::DynamicsError(DynamicsError::DrivenTogether(_)))
}

/// The energy left over at every step, beside the largest entry of the ledger. No figure is asked of a motion that is
/// driven towards a dead position, where speeds grow beyond bounds.
fn books_close(label: &str, m: &Mechanism, run: &Trajectory) -> bool {
    let ledger = run.ledger(m, &run.steps).unwrap_or_else(|e| panic!("{label}: {e:?}"));
    let last = ledger.names.len() - 1;
    let most = ledger.rows.iter().flat_map(|row| &row[..last]).fold(0.0_f64, |most, x| most.max(x.abs()));
    let left = ledger.rows.iter().map(|row| row[last].abs()).fold(0.0, f64::max);
    let start = ledger.rows[0].iter().fold(1.0_f64, |most, x| most.max(x.abs()));
    let tame = most < BEYOND * start && (run.outcome.is_ok() || is_driven_through(&run.outcome));
    assert!(!tame || left < ROUND_OFF * most, "{label}: {left:e} of {most:e} J left over");
    tame
}
