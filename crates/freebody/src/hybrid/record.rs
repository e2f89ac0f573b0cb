//! The record of a run, as data.

use super::guards::SwitchingFunction;
use super::mode_changes::{ContactImpulse, ModeChange};
use super::Trajectory;
use crate::gauges::ModelExpr;
use crate::mechanism::{DriveKind, Mechanism};
use crate::motion::{Doubt, Kind, Outcome, Unresolved, TIGHTEST};
use serde_json::{json, Value};

impl Trajectory {
    /// What happened, what switched, how the run ended and what it took; `reported` is what is read of it besides.
    pub fn record(&self, m: &Mechanism, reported: &[ModelExpr]) -> Value {
        json!({
            "events": self.events.iter().map(|h| {
                let kind = match h.kind {
                    Kind::Crossing => "crossing",
                    Kind::Touch => "touch",
                    Kind::Opening => "start",
                };
                state(m, &h.y, json!({"name": m.events[h.index].name, "t": h.t, "kind": kind, "direction": h.direction}))
            }).collect::<Vec<_>>(),
            "changes": self.mode_changes.iter().map(|c| change(m, c)).collect::<Vec<_>>(),
            "outcome": {
                "name": self.outcome.name(), "ok": self.outcome.is_ok(), "t": self.steps.last(),
                "sentence": self.sentence(m, reported), "path": self.path(m),
            },
            "stats": {
                "accepted": self.counts[0], "rejected": self.counts[1], "evaluations": self.counts[2], "kinks": self.discontinuities,
                "method": self.settings.method, "rtol": self.settings.options.rtol, "closure": self.worst_gap,
                "stiff_since": self.stiff_since,
            },
        })
    }

    /// The item of the model that its end is about, or nothing.
    fn path(&self, m: &Mechanism) -> String {
        match &self.outcome {
            Outcome::Chatter { index } => match SwitchingFunction::all(m).nth(*index) {
                Some(SwitchingFunction::Discontinuity(law)) => m.discontinuous_items[law].clone(),
                _ => String::new(),
            },
            other => other.path().to_string(),
        }
    }

    /// How it ended, with the names of the model.
    pub fn sentence(&self, m: &Mechanism, reported: &[ModelExpr]) -> String {
        let ending = match &self.outcome {
            Outcome::StoppedByEvent { index } => format!("the event `{}` ended the run", m.events[*index].name),
            Outcome::Chatter { index } => {
                let of = SwitchingFunction::all(m).nth(*index).expect("it is of this mechanism");
                let advice = match of {
                    SwitchingFunction::Discontinuity(_) => {
                        "jumps to and fro within one instant, where what it switches by stays at zero; dry friction that may \
                         hold is `friction` of a contact, hinge, slot, curved_slot or slider, and any other jump can be made \
                         steep, as tanh(x/a) with a small a for sign(x)"
                    }
                    _ => {
                        "comes back again and again within one instant; change what happens there, or loosen the tolerance"
                    }
                };
                format!("the {} {advice}", of.name(m))
            }
            other => other.to_string(),
        };
        let dense = |&(event, t): &(usize, f64)| {
            format!(
                "; the event `{}` comes more often than can be recorded, from t = {t:.9} s on",
                m.events[event].name
            )
        };
        let unresolved = |each: &Unresolved| {
            let (name, t, rtol) = (|event: usize| &m.events[event].name, each.t, each.rtol);
            let what = match each.doubt {
                Doubt::Acts => format!("whether `{}` acts", name(each.index)),
                Doubt::ComesBefore(other) => {
                    format!("which of `{}` and `{}` comes first", name(each.index), name(other))
                }
                Doubt::ComesBeforeEnd => format!("whether `{}` comes before the end of the run", name(each.index)),
            };
            let by = if rtol > TIGHTEST { format!("rtol {rtol:.0e}") } else { "a smaller one".to_string() };
            format!("; {what}, at t = {t:.6} s, is not resolved at this rtol; {by} may tell")
        };
        let left = |(table, t): (usize, f64)| {
            format!("; the table `{}` was left, from t = {t:.6} s on its end value holds", m.table_names[table])
        };
        let tables = self.tables_left(m, reported).unwrap_or_default().into_iter().map(left);
        let unresolved = self.unresolved.iter().map(unresolved);
        ending + &self.unrecorded.iter().map(dense).chain(unresolved).chain(tables).collect::<String>()
    }
}

/// A record, with the coordinates and rates of a state vector.
fn state(m: &Mechanism, y: &[f64], mut record: Value) -> Value {
    let n = m.freedom();
    record["q"] = json!(y[..n]);
    record["u"] = json!(y[n..2 * n]);
    record
}

fn change(m: &Mechanism, c: &ModeChange) -> Value {
    let impacting = |s: &ContactImpulse| json!({"name": s.name, "normal": s.normal, "tangent": s.tangent, "restitution": s.restitution, "slides": s.slides});
    let impulses = c.impulses.as_ref().map(|i| {
        let groups: Vec<_> = i.groups.iter().map(|(name, p)| json!([name, [p.x, p.y]])).collect();
        let impacting: Vec<_> = i.contacts.iter().map(impacting).collect();
        let named = |of: &[f64]| {
            let named = m.drives.iter().zip(of).filter(|(drive, x)| drive.kind != DriveKind::Hold && **x != 0.0);
            named.map(|(drive, x)| json!([drive.name, x])).collect::<Vec<_>>()
        };
        let (drives, works) = (named(&i.drives), named(&i.drive_works));
        let joints: Vec<_> = m.listed_joints().map(|joint| i.joints[joint]).collect();
        json!({"limits": groups, "joints": joints, "drives": drives, "works": works, "contact_impulses": impacting, "spared": i.unloaded})
    });
    let side = |i: usize| c.states.as_ref().map(|states| state(m, &states[i], json!({})));
    json!({
        "t": c.t, "kind": c.kind, "of": c.of, "lost": c.lost, "note": c.note, "impulses": impulses,
        "before": side(0), "after": side(1),
    })
}
