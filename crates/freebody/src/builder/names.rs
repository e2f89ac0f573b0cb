//! What the names in a model mean.

use super::answers::{of_force, of_joint, LIMIT, MOTION};
use crate::error::CompileError;
use crate::expr::{self, nearest, Ast, Expr, ExprError, Kind as AstKind, Message};
use crate::gauges::{is_measured, ModelExpr, ModelVariable};
use crate::joints::{Card, Joint as _, Kind};
use crate::mechanism::Marker;
use serde::Serialize;
use std::collections::HashMap;

/// All names of a model.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Parameters.
    pub parameters: HashMap<String, usize>,
    /// Quantities with a rate of their own.
    pub states: HashMap<String, usize>,
    /// Tables.
    pub tables: HashMap<String, usize>,
    /// Bodies, ground among them.
    pub bodies: HashMap<String, usize>,
    /// Sites, as `body.point`.
    pub sites: HashMap<String, usize>,
    /// Lines, as `body.line`: the site, the body and the direction in the body's frame.
    pub lines: HashMap<String, (Marker, usize, ModelExpr)>,
    /// Curves, as `body.curve`.
    pub curves: HashMap<String, usize>,
    /// Coordinates.
    pub coordinates: HashMap<String, (usize, usize)>,
    /// Gauges.
    pub gauges: HashMap<String, ModelExpr>,
    /// Joints.
    pub joints: HashMap<String, (usize, Kind)>,
    /// Couplings and motions.
    pub drives: HashMap<String, usize>,
    /// Forces.
    pub forces: HashMap<String, (usize, Card)>,
    /// Contacts, stops and strings.
    pub groups: HashMap<String, usize>,
}

/// How much an expression may read; each level includes those before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Reach {
    /// Parameters.
    Numbers,
    /// Parameters and the parameter `s` of a curve.
    Curve,
    /// The configuration.
    Configuration,
    /// Time and rates.
    Motion,
    /// Accelerations, reactions, energies.
    Instant,
}

/// The names, seen from one expression.
pub struct Scope<'a> {
    /// The names.
    pub names: &'a Names,
    /// How much may be read.
    pub reach: Reach,
    /// Number of switches handed out so far.
    pub switches: &'a mut usize,
}

/// The distance of two sites.
pub fn distance(p: usize, q: usize) -> ModelExpr {
    let dx = ModelExpr::variable(ModelVariable::X(q)) - ModelExpr::variable(ModelVariable::X(p));
    let dy = ModelExpr::variable(ModelVariable::Y(q)) - ModelExpr::variable(ModelVariable::Y(p));
    (dx.powi(2) + dy.powi(2)).sqrt()
}

impl Scope<'_> {
    /// Parses and resolves a number-valued expression.
    pub fn law(&mut self, text: &str) -> Result<ModelExpr, ExprError> {
        let ast = expr::parse(text)?;
        let law = Expr::resolve(&ast, self)?;
        self.check_rates(&law, &ast)?;
        Ok(law)
    }

    /// Parses and resolves a condition.
    pub fn condition(&mut self, text: &str) -> Result<crate::expr::Condition<ModelVariable>, ExprError> {
        let ast = expr::parse(text)?;
        let condition = crate::expr::Condition::resolve(&ast, self)?;
        check_derivatives(condition.as_expr(), &ast)?;
        Ok(condition)
    }

    fn check_rates(&self, law: &ModelExpr, ast: &Ast) -> Result<(), ExprError> {
        check_derivatives(law, ast)?;
        if self.reach < Reach::Motion && law.depends_on_rates() {
            return Err(Message::new(
                "a time derivative stands where only the configuration may be read",
                "leave out `rate` and `accel` here",
            )
            .at(&ast.span));
        }
        if self.reach < Reach::Instant && law.depends_on_accelerations() {
            return Err(Message::new(
                "an acceleration stands where only the state may be read",
                "accelerations are answers; a law may read positions and rates",
            )
            .at(&ast.span));
        }
        Ok(())
    }

    fn known(&self) -> impl Iterator<Item = &str> {
        let n = self.names;
        n.parameters
            .keys()
            .chain(n.states.keys())
            .chain(n.coordinates.keys())
            .chain(n.gauges.keys())
            .map(String::as_str)
    }

    /// The site of a name, or what to write instead.
    pub fn site(&self, name: &str) -> Result<usize, Message> {
        self.names.site(name)
    }

    pub(super) fn reading(&self, name: &str) -> Option<Result<ModelExpr, Message>> {
        let (owner, part) = name.rsplit_once('.')?;
        let n = self.names;
        let (number, answers) = if let Some(&(joint, kind)) = n.joints.get(owner) {
            (joint, of_joint(&kind.card()).into_iter().map(|(answer, _)| answer).collect())
        } else if let Some(&drive) = n.drives.get(owner) {
            (drive, MOTION.to_vec())
        } else if let Some((force, card)) = n.forces.get(owner) {
            (*force, of_force(card))
        } else {
            (*n.groups.get(owner)?, LIMIT.to_vec())
        };
        let Some(answer) = answers.iter().find(|answer| answer.word == part) else {
            let known: Vec<_> = answers.iter().map(|answer| answer.word).collect();
            let hint = match known.is_empty() {
                true => format!("what it pushes with is `'{owner}.contact'.N`"),
                false => format!("it has {}", known.join(", ")),
            };
            return Some(Err(Message::new(format!("`{owner}` has no such part"), hint)));
        };
        let reading = (answer.read)(number);
        if self.reach < Reach::Instant {
            return Some(Err(Message::new(
                format!("`{name}` is an answer; it cannot be read here"),
                "reactions, powers and works may stand in events and reports",
            )));
        }
        Some(Ok(ModelExpr::variable(ModelVariable::Reading(reading))))
    }

    pub(super) fn place(&self, argument: &Ast) -> Result<usize, ExprError> {
        match &argument.kind {
            AstKind::Name(name) => self.site(name).map_err(|m| m.at(&argument.span)),
            _ => Err(Message::new("a point is needed here", "write `body.point`").at(&argument.span)),
        }
    }

    pub(super) fn body(&self, argument: &Ast) -> Result<usize, ExprError> {
        let AstKind::Name(name) = &argument.kind else {
            return Err(Message::new("a body is needed here", "write its name").at(&argument.span));
        };
        let bodies = &self.names.bodies;
        bodies.get(name).copied().ok_or_else(|| unknown("body", name, bodies.keys()).at(&argument.span))
    }

    /// The place of a site along or across a line: its offset in the line's own axes.
    pub(super) fn offset(&self, site: usize, line: &Ast, across: bool) -> Result<ModelExpr, ExprError> {
        let AstKind::Name(name) = &line.kind else {
            return Err(
                Message::new("a named line is needed here", "give the line a name under `lines`").at(&line.span)
            );
        };
        let lines = &self.names.lines;
        let (marker, body, direction) =
            lines.get(name).ok_or_else(|| unknown("line", name, lines.keys()).at(&line.span))?;
        let dx = ModelExpr::variable(ModelVariable::X(site)) - ModelExpr::variable(ModelVariable::X(marker.site));
        let dy = ModelExpr::variable(ModelVariable::Y(site)) - ModelExpr::variable(ModelVariable::Y(marker.site));
        let turn = ModelExpr::variable(ModelVariable::Angle(*body)) + direction.clone();
        let (cos, sin) = (turn.clone().cos(), turn.sin());
        Ok(if across { dy * cos - dx * sin } else { dx * cos + dy * sin })
    }

    /// x of a point.
    pub(super) fn x(&self, point: &Ast) -> Result<ModelExpr, ExprError> {
        Ok(ModelExpr::variable(ModelVariable::X(self.place(point)?)))
    }
    /// y of a point.
    pub(super) fn y(&self, point: &Ast) -> Result<ModelExpr, ExprError> {
        Ok(ModelExpr::variable(ModelVariable::Y(self.place(point)?)))
    }
    /// Angle of a body.
    pub(super) fn angle(&self, body: &Ast) -> Result<ModelExpr, ExprError> {
        Ok(ModelExpr::variable(ModelVariable::Angle(self.body(body)?)))
    }
    /// Tension of a link or string.
    pub(super) fn tension(&self, owner: &Ast) -> Result<ModelExpr, ExprError> {
        let AstKind::Name(name) = &owner.kind else {
            return Err(Message::new("a link or a string is needed here", "write its name").at(&owner.span));
        };
        let found = self.reading(&format!("{name}.tension")).unwrap_or_else(|| Err(self.nothing(name)));
        found.map_err(|m| m.at(&owner.span))
    }
    pub(super) fn nothing(&self, name: &str) -> Message {
        unknown("name", name, self.known().map(str::to_string).collect::<Vec<_>>().iter())
    }
}

/// The message for a name that nothing bears.
pub fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a String>) -> Message {
    let mut known: Vec<&str> = known.map(String::as_str).collect();
    known.sort_unstable();
    let hint = match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => format!("this model has no {what}"),
        None => format!("there is {}", known.iter().take(8).map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", ")),
    };
    Message::new(format!("no {what} is called `{name}`"), hint)
}

/// What a word of a closed list means.
pub fn chosen<T>(what: &str, word: &str, all: impl IntoIterator<Item = (&'static str, T)>) -> Result<T, CompileError> {
    let mut known = vec![];
    for (name, meaning) in all {
        if name == word {
            return Ok(meaning);
        }
        known.push(name.to_string());
    }
    Err(CompileError::from(word, unknown(what, word, known.iter())))
}

impl Names {
    /// The site of a name, or what to write instead.
    pub fn site(&self, name: &str) -> Result<usize, Message> {
        self.sites.get(name).copied().ok_or_else(|| unknown("point", name, self.sites.keys()))
    }
    /// An error about an expression at a path of the model.
    pub fn error(path: &str, text: &str, error: ExprError) -> CompileError {
        let what = if error.at.len() < text.len() && error.at.end <= text.len() {
            format!("in `{text}`, at `{}`: {}", &text[error.at.clone()], error.what)
        } else {
            format!("in `{text}`: {}", error.what)
        };
        CompileError { path: path.to_string(), what, hint: error.hint }
    }
}

/// Refuses time derivatives beyond the first of what is found by solving an instant: there are no second ones along the motion.
fn check_derivatives(law: &ModelExpr, ast: &Ast) -> Result<(), ExprError> {
    let beyond = |(inner, second): (&ModelExpr, bool)| {
        !is_measured(inner) && (second || inner.derivatives().any(|(within, _)| !is_measured(within)))
    };
    if law.derivatives().any(beyond) {
        let what = "a second time derivative of a force, a momentum, an energy or a rate";
        return Err(Message::new(what, "take the first, and sample that over a run").at(&ast.span));
    }
    Ok(())
}
