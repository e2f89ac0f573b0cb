//! Strings: their length along the way, its rates and loads, the borders between ways of being wound.

use crate::model::*;
use crate::random_cables::*;
use crate::rng::Rng;
use freebody::cables::{Stretch, Winding, WrapState};
use freebody::compile::Compiled;
use freebody::mode::Feature;
use freebody::plane::{vec2, Twist, Vec2, Wrench};
use freebody::spec::{Cable, CableEnd, Guide};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A string is one line, straight where it is free and without corners where it is bent; it is as long as its
/// stretches, and what is wound at the start is what is given.
#[test]
fn a_string_is_one_smooth_line() {
    let mut ways = std::collections::HashSet::new();
    every_string(|scene, at, feature, label, _| {
        let outline = scene.outline(at, feature);
        ways.insert(format!("{:?}", Winding::of(feature.index).states));
        for pair in outline.stretches.windows(2) {
            let ([_, (end, t)], [(next, s), _]) = (ends_of(&pair[0]), ends_of(&pair[1]));
            assert!((end - next).norm() < 1e-12, "{label}: torn at {end:?}, {next:?}");
            let bent = matches!(pair[0], Stretch::Arc { .. }) || matches!(pair[1], Stretch::Arc { .. });
            let corner = t.zip(s).map_or(0.0, |(t, s)| (t - s).norm());
            // A pulley that is passed on the wrong side has an arc below 0, on which the string runs back.
            let back = pair.iter().filter_map(swept).any(|a| a.abs() < FRAC_PI_2) && (corner - 2.0).abs() < 1e-12;
            assert!(!bent || back || corner < 1e-12, "{label}: a corner of {corner:e}");
        }
        let parts = outline.free_length + outline.over_length + outline.wound_length.iter().sum::<f64>();
        assert!((parts - feature.phase[2]).abs() < 1e-12 * parts, "{label}");
        assert!(scene.gap(at, feature).abs() < 1e-12 * parts, "{label}");
        let below: f64 = outline.stretches.iter().map(length_of).sum();
        assert!(below + 1e-12 > parts, "{label}: {below} {parts}");
    });
    assert!(ways.len() == 9, "{ways:?}");
}

/// Rates and accelerations against differences of eighth order along a motion of the bodies.
#[test]
fn rates_of_the_slack_are_its_differences() {
    every_string(|scene, at, feature, label, rng| {
        let (rates, accelerations) = (threes(rng, at.len(), 1.0), threes(rng, at.len(), 1.0));
        let jet = scene.jet(at, &rates, &accelerations, feature);
        let h = 4e-3;
        let gap = |k: f64| scene.gap(&along(at, &rates, &accelerations, k * h), feature);
        // Fornberg, Mathematics of Computation 51, 699 (1988), table 1.
        let first = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
        let second = [8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
        let (mut d1, mut d2) = (0.0, -205.0 / 72.0 * gap(0.0));
        for (k, (a, b)) in (1..).zip(first.iter().zip(second)) {
            let (later, behind) = (gap(f64::from(k)), gap(-f64::from(k)));
            d1 += a * (later - behind) / h;
            d2 += b * (later + behind);
        }
        d2 /= h * h;
        assert!((jet.d0).abs() < 1e-12 * feature.phase[2], "{label}");
        assert!((jet.d1 - d1).abs() < 1e-11 * (1.0 + d1.abs()), "{label}: {} {d1}", jet.d1);
        assert!((jet.d2 - d2).abs() < 1e-8 * (1.0 + d2.abs()), "{label}: {} {d2}", jet.d2);
    });
}

/// A unit tension pulls with one newton along every straight stretch, at both ends of it, wherever these move to.
#[test]
fn the_loads_of_a_string_are_pulls_along_its_straight_stretches() {
    every_string(|scene, at, feature, label, rng| {
        let straight: Vec<[Vec2; 2]> = scene
            .outline(at, feature)
            .stretches
            .iter()
            .filter_map(|s| match *s {
                Stretch::Straight { from, to } => Some([from, to]),
                Stretch::Arc { .. } => None,
            })
            .collect();
        assert_eq!(straight.len(), at.len() - 1);
        let loads = scene.loads(at, feature);
        let mut power = 0.0;
        let rates = threes(rng, at.len(), 1.0);
        for (i, place) in at.iter().enumerate() {
            let origin = vec2(place[0], place[1]);
            let mut pull = Wrench::zero();
            for (k, [from, to]) in straight.iter().enumerate() {
                let along = (*to - *from) * (1.0 / (*to - *from).norm());
                if k == i {
                    pull += Wrench::force(along, *from - origin);
                } else if k + 1 == i {
                    pull += Wrench::force(-along, *to - origin);
                }
            }
            assert!(apart(&loads[i].parts(), &pull.parts(), 1.0) < 1e-12, "{label}: {:?} {pull:?}", loads[i]);
            power += loads[i].power(Twist::from_parts(rates[i]));
        }
        let rate = scene.jet(at, &rates, &[], feature).d1;
        assert!((power - rate).abs() < 1e-12 * (1.0 + rate.abs()), "{label}: {power} {rate}");
    });
}

/// Goes along a motion from feature to feature, and holds the gap and its rate against each other on both sides of each
/// border.
fn follow(
    scene: &Scene,
    label: &str,
    mut feature: Feature,
    steps: usize,
    motion: impl Fn(f64) -> (Vec<Three>, Vec<Three>),
) -> (Feature, Vec<[WrapState; 2]>) {
    let lowest = |t: f64, feature: Feature| {
        let borders = scene.see(&motion(t).0, &[], |placed, cable| cable.borders(placed.m, &placed, feature));
        borders.into_iter().min_by(|a, b| a.value.total_cmp(&b.value))
    };
    let mut passed = vec![Winding::of(feature.index).states];
    for step in 0..steps {
        let [t, next] = [step, step + 1].map(|i| i as f64 / steps as f64);
        let mut before = t;
        while lowest(next, feature).is_some_and(|b| b.value < 0.0) {
            let (mut low, mut high) = (before, next);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                *(if lowest(middle, feature).expect("a border").value < 0.0 { &mut high } else { &mut low }) = middle;
            }
            let beyond = Feature { index: lowest(high, feature).expect("a border").beyond, ..feature };
            let (at, rates) = motion(low);
            let [a, b] = [feature, beyond].map(|feature| scene.jet(&at, &rates, &[], feature));
            let label = format!("{label}: {:?} to {:?}", Winding::of(feature.index), Winding::of(beyond.index));
            assert!((a.d0 - b.d0).abs() < 1e-11 && (a.d1 - b.d1).abs() < 1e-10, "{label}: {a:?} {b:?}");
            let kept = scene.see(&at, &[], |placed, cable| {
                [feature, beyond].map(|feature| cable.feature(placed.m, &placed, feature) == feature.index)
            });
            assert_eq!(kept, [true, true], "{label}");
            (feature, before) = (beyond, high);
            passed.push(Winding::of(feature.index).states);
        }
    }
    (feature, passed)
}

/// Over every border from one way of being wound to another, and from one swing to the next, gap and rate go on; and
/// what is wound up is wound off again.
#[test]
fn slack_and_its_rate_go_on_over_every_border() {
    let mut seen = std::collections::HashSet::new();
    for seed in 0..40 {
        let mut rng = Rng::new(seed);
        let sense = rng.sign() as i8;
        let other = if rng.chance(0.5) { tied("b1.P") } else { attached("b1.P", 0.4, rng.sign() as i8, 1.0) };
        let mut ends = [wound("b0.P", 0.7, sense, 1.0), other];
        if rng.chance(0.5) {
            ends.reverse();
        }
        let scene = Scene::new(&[[0.2, 0.1], [0.1, -0.3]], string(ends, vec![]));
        let (spin, round, own) = (rng.about(15.0), rng.about(15.0), rng.about(8.0));
        let motion = |t: f64| {
            // To somewhere and back.
            let (s, ds) = ((PI * t).sin(), PI * (PI * t).cos());
            let (sin, cos) = (0.3 + round * s).sin_cos();
            let distance = 4.0 + s;
            let place = [distance * cos, distance * sin, own * s];
            let rate = [ds * (cos - distance * sin * round), ds * (sin + distance * cos * round), ds * own];
            (vec![[0.0, 0.0, spin * s], place], vec![[0.0, 0.0, spin * ds], rate])
        };
        let start = scene.start(&motion(0.0).0);
        let (end, passed) = follow(&scene, &format!("seed {seed}"), start, 200, motion);
        seen.extend(passed.windows(2).filter(|w| w[0] != w[1]).map(|w| format!("{w:?}")));
        let gap = scene.gap(&motion(1.0).0, end);
        assert!(gap.abs() < 1e-11, "seed {seed}: {gap:e} is left of a motion to and fro");
        assert_eq!(Winding::of(end.index).states, Winding::of(start.index).states, "seed {seed}");
    }
    assert!(seen.len() > 12, "{seen:?}");
}

/// The end of a taut string that is wound off a fixed drum runs along the involute of its circle, over any number of
/// turns.
#[test]
fn the_end_runs_along_the_involute() {
    for (sense, phi) in [(1, 0.4), (-1, 2.9)] {
        let s = f64::from(sense);
        let (radius, length) = (0.3, 7.0);
        let end = |angle: f64| {
            let (sin, cos) = (phi + s * angle).sin_cos();
            let (out, free) = (vec2(cos, sin), length - radius * angle);
            let at = vec2(1.0, 2.0) + out * radius + out.perp() * (s * free);
            vec![[1.0, 2.0, 0.0], [at.x, at.y, 0.0]]
        };
        let most = 22.0;
        let mut written = string([wound("b0.P", radius, sense, radius * most), tied("b1.P")], vec![]);
        written.length = Some(literal(length));
        let scene = Scene::new(&[[0.0, 0.0]; 2], written);
        let mut feature = scene.start(&end(most));
        for step in 0..=440 {
            let angle = most * (1.0 - f64::from(step) / 440.0);
            let at = end(angle);
            feature.index = scene.see(&at, &[], |placed, cable| cable.feature(placed.m, &placed, feature));
            let (gap, outline) = (scene.gap(&at, feature), scene.outline(&at, feature));
            assert!(gap.abs() < 1e-13 * length, "sense {sense}, {angle} rad: {gap:e}");
            assert!((outline.wound_length[0] - radius * angle).abs() < 1e-12, "sense {sense}, {angle} rad");
        }
        assert_eq!(Winding::of(feature.index).states[0], WrapState::Wound);
    }
}

/// From one reel to another: each reel that turns takes up or gives its radius times its angle, for any number of
/// turns.
#[test]
fn reels_take_up_what_they_turn() {
    for (a, b) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
        let (r, s) = (0.5, 0.3);
        let ends = [wound("b0.P", r, a, 20.0), wound("b1.P", s, b, 9.0)];
        let scene = Scene::new(&[[0.0, 0.0]; 2], string(ends, vec![]));
        let at = |i: f64, j: f64| [[0.0, 0.0, i], [-3.0, 0.4, j]];
        let feature = scene.start(&at(0.3, -7.0));
        assert!(apart(&scene.outline(&at(0.3, -7.0), feature).wound_length, &[20.0, 9.0], 1.0) < 1e-14);
        for (i, j) in [(1.0, 0.0), (-30.0, 4.0), (12.0, -25.0), (0.0, 28.0)] {
            let given = r * f64::from(a) * i + s * f64::from(b) * j;
            let gap = scene.gap(&at(0.3 + i, -7.0 + j), feature);
            assert!((gap - given).abs() < 1e-12, "{a} {b}: {gap} {given}");
        }
    }
}

/// A belt from a point of its straight strand round two pulleys and back, against its length in handbooks.
#[test]
fn belts_have_the_length_of_handbooks() {
    let (big, small, far) = (0.8_f64, 0.3_f64, 2.5_f64);
    for crossed in [false, true] {
        let (sum, sense) = if crossed { (big + small, -1) } else { (big - small, 1) };
        let lean = (sum / far).asin();
        let straight = (far * far - sum * sum).sqrt();
        let label = match crossed {
            false => 2.0 * straight + PI * (big + small) + 2.0 * (big - small) * lean,
            true => 2.0 * straight + (big + small) * (PI + 2.0 * lean),
        };
        // The strand on which the string comes back to the big pulley: t turned by the lean from the line of centres.
        let t = vec2(-lean.cos(), lean.sin());
        let touch = t.perp() * -big;
        let place = touch - t * (0.4 * straight);
        let over = vec![pulley("b1.P", big, 1), pulley("b2.P", small, sense)];
        let scene = Scene::new(&[[0.0, 0.0]; 3], string([tied("b0.P"), tied("b0.origin")], over));
        let at = [[place.x, place.y, 0.0], [0.0; 3], [far, 0.0, 0.0]];
        let feature = scene.start(&at);
        assert!((feature.phase[2] - label).abs() < 1e-13 * label, "crossed {crossed}: {} {label}", feature.phase[2]);
    }
}

/// Without free length, at its drum or at an eyelet, a string has finite slack, rates and loads; at the drum they go
/// on.
#[test]
fn a_string_without_free_length_is_finite() {
    let finite = |scene: &Scene, at: &[Three], rates: &[Three]| {
        let feature = scene.start(at);
        let jet = scene.jet(at, rates, &[], feature);
        let loads = scene.loads(at, feature);
        assert!([jet.d0, jet.d1, jet.d2].iter().all(|x| x.is_finite()), "{jet:?}");
        assert!(loads.iter().flat_map(Wrench::parts).all(f64::is_finite), "{loads:?}");
        (jet, loads)
    };
    let tip = Scene::new(&[[0.0, 0.0]; 2], string([tied("b0.P"), tied("b1.P")], vec![]));
    finite(&tip, &[[1.0, 2.0, 0.0]; 2], &[[0.3, 0.1, 0.0], [0.0; 3]]);
    for sense in [-1, 1] {
        let ends = [wound("b0.P", 0.1, sense, 2.0), tied("b1.P")];
        let scene = Scene::new(&[[0.0, 0.0]; 2], string(ends, vec![]));
        for angle in [0.0, 0.7, 2.0, 4.4] {
            let out: Vec2 = vec2(f64::cos(angle), f64::sin(angle));
            let along = out.perp() * f64::from(sense);
            let at = [[0.0; 3], [0.1 * out.x, 0.1 * out.y, 0.0]];
            let rates = [[0.0; 3], [along.x, along.y, 0.0]];
            let (jet, loads) = finite(&scene, &at, &rates);
            assert!(jet.d0.abs() < 1e-14 && (jet.d1 + 1.0).abs() < 1e-7, "{jet:?}");
            assert!((loads[0].m - 0.1 * f64::from(sense)).abs() < 1e-8, "{loads:?}");
        }
    }
}

/// How a drum is wound at the start: by the length wound; else not, where the way from the attachment is free; else by
/// less than a turn, or by as many turns as leave least of a given length slack.
#[test]
fn the_start_tells_how_a_drum_is_wound() {
    let at = [[0.0; 3], [2.0, 0.0, 0.0]];
    let started = |end: CableEnd, length: Option<f64>| {
        let mut written = string([end, tied("b1.P")], vec![]);
        written.length = length.map(literal);
        let scene = Scene::new(&[[0.0, 0.0]; 2], written);
        let feature = scene.start(&at);
        (Winding::of(feature.index).states[0], scene.outline(&at, feature).wound_length[0], scene.gap(&at, feature))
    };
    // The tangent point, from which the string runs away along +t.
    let leaving = -(0.5_f64 / 2.0).acos();
    let close = |label: (WrapState, f64, f64), way: WrapState, wound: f64, gap: f64| {
        assert!(label.0 == way && (label.1 - wound).abs() < 1e-12 && (label.2 - gap).abs() < 1e-12, "{label:?}");
    };
    close(started(wound("b0.P", 0.5, 1, 10.0), None), WrapState::Wound, 10.0, 0.0);
    close(started(wound("b0.P", 0.5, 1, 0.0), None), WrapState::Wound, 0.0, 0.0);
    close(started(attached("b0.P", 0.5, 1, 0.2), None), WrapState::Pivot, 0.0, 0.0);
    close(started(attached("b0.P", 0.5, 1, leaving - 1.0), None), WrapState::Wound, 0.5, 0.0);
    close(started(attached("b0.P", 0.5, 1, leaving - 3.4), None), WrapState::Wound, 1.7, 0.0);
    close(started(attached("b0.P", 0.5, 1, leaving - 1.0 + 2.0 * TAU), None), WrapState::Wound, 0.5, 0.0);
    let free = (4.0_f64 - 0.25).sqrt();
    let several = free + 0.5 * (1.0 + 3.0 * TAU);
    close(started(attached("b0.P", 0.5, 1, leaving - 1.0), Some(several + 0.3)), WrapState::Wound, several - free, 0.3);
    close(started(attached("b0.P", 0.5, 1, 0.0), Some(1.6)), WrapState::Pivot, 0.0, 0.1);
    let (way, wound, gap) = started(attached("b0.P", 0.5, 1, 0.0), Some(8.0));
    assert!(way == WrapState::Wound && wound > 4.0 && gap.abs() < PI * 0.5, "{way:?} {wound} {gap}");
}

/// What is wrong with a string is reported where it stands.
#[test]
fn a_string_that_cannot_be_is_refused() {
    let drum = |radius: f64, sense: i8, attached: Option<f64>, wound: Option<f64>| CableEnd::Drum {
        centre: "b0.P".into(),
        radius: literal(radius),
        sense,
        attached: attached.map(literal),
        wound: wound.map(literal),
    };
    let from = |end: CableEnd| string([end, tied("b1.P")], vec![]);
    let by = |change: fn(&mut Cable)| {
        let mut cable = from(drum(1.0, 1, None, Some(1.0)));
        change(&mut cable);
        cable
    };
    let over = |guide: Guide| string([tied("b0.P"), tied("b1.P")], vec![Guide::Eyelet("ground.O".into()), guide]);
    let wrong = [
        ("strings.s.ends[0]", from(tied("b0.Q"))),
        ("strings.s.ends[0]", from(drum(1.0, 1, None, None))),
        ("strings.s.ends[0]", from(drum(1.0, 1, Some(0.0), Some(1.0)))),
        ("strings.s.ends[0].sense", from(drum(1.0, 0, None, Some(1.0)))),
        ("strings.s.ends[0].radius", from(drum(-1.0, 1, None, Some(1.0)))),
        ("strings.s.ends[0].wound", from(drum(1.0, 1, None, Some(-1.0)))),
        ("strings.s.ends[1].centre", by(|c| c.ends[1] = wound("b1.Q", 1.0, 1, 1.0))),
        ("strings.s.over[1]", over(Guide::Eyelet("b2.P".into()))),
        ("strings.s.over[1].sense", over(pulley("b1.P", 1.0, -128))),
        ("strings.s.restitution", by(|c| c.restitution = literal(1.1))),
        ("strings.s.length", by(|c| c.length = Some(literal(0.0)))),
        ("strings.s", string([tied("b0.P"), tied("b0.origin")], vec![])),
    ];
    for (path, cable) in wrong {
        let model = strung(&[[0.0, 0.0]; 2], cable);
        let error = Compiled::new(&model.0).err().unwrap_or_else(|| panic!("{path} was taken"));
        assert_eq!(error.path, path, "{error}");
    }
    let mut twice = strung(&[[0.0, 0.0]; 2], by(|c| c.engaged = false));
    let m = twice.compile().mechanism;
    assert!(m.unilateral[0].bodies.len() == 2 && !m.groups[0].engaged && m.groups[0].constraints == (0..1));
    twice.0.strings.push(by(|_| ()));
    assert!(Compiled::new(&twice.0).is_err_and(|e| e.what.contains("twice")));
}
