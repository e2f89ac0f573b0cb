//! What the names in a model mean.

use crate::error::CompileError;
use crate::expr::{self, nearest, Ast, Expr, ExprError, Kind as AstKind, Message};
use crate::gauges::{Axis, ContactQuantity, ModelExpr, ModelVariable, Reading};
use crate::joints::{Joint as _, Kind};
use crate::mechanism::Marker;
use std::collections::HashMap;

/// All names of a model.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Parameters.
    pub parameters: HashMap<String, usize>,
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
    pub forces: HashMap<String, usize>,
    /// Contacts, stops and strings.
    pub groups: HashMap<String, usize>,
}

/// How much an expression may read; each level includes those before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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

const READINGS: &[(&str, usize)] = &[
    ("kinetic", 0),
    ("potential", 0),
    ("energy", 0),
    ("momentum_x", 0),
    ("momentum_y", 0),
    ("angular_momentum", 1),
    ("centre_x", 0),
    ("centre_y", 0),
    ("friction_work", 0),
];

/// Functions of places and bodies: name, what may read them.
const MEASURES: &[(&str, Reach)] = &[
    ("x", Reach::Configuration),
    ("y", Reach::Configuration),
    ("angle", Reach::Configuration),
    ("distance", Reach::Configuration),
    ("direction", Reach::Configuration),
    ("along", Reach::Configuration),
    ("across", Reach::Configuration),
    ("vx", Reach::Motion),
    ("vy", Reach::Motion),
    ("speed", Reach::Motion),
    ("omega", Reach::Motion),
    ("ax", Reach::Instant),
    ("ay", Reach::Instant),
    ("alpha", Reach::Instant),
];

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
        n.parameters.keys().chain(n.coordinates.keys()).chain(n.gauges.keys()).map(String::as_str)
    }

    /// The site of a name, or what to write instead.
    pub fn site(&self, name: &str) -> Result<usize, Message> {
        self.names.site(name)
    }

    fn reading(&self, name: &str) -> Option<Result<ModelExpr, Message>> {
        let (owner, part) = name.rsplit_once('.')?;
        let n = self.names;
        let reading = if let (Some(&(joint, _)), "friction") = (n.joints.get(owner), part) {
            Reading::JointFriction(joint)
        } else if let Some(&(joint, kind)) = n.joints.get(owner) {
            let axis =
                match (part, kind) {
                    ("Fx", _) => Axis::X,
                    ("Fy", _) => Axis::Y,
                    ("M", _) => Axis::Couple,
                    ("F", _) => Axis::Size,
                    ("Fs", _) => Axis::Along,
                    ("Fn", _) => Axis::Across,
                    ("tension", Kind::Link) => Axis::Tension,
                    ("F1" | "F2", _) if kind.card().rows.len() >= row_number(part) => Axis::Row(row_number(part) - 1),
                    _ => return Some(Err(parts(
                        owner,
                        "Fx, Fy, M, F, Fs, Fn, friction, for each of its constraints F1, F2 (and tension for a link)",
                    ))),
                };
            Reading::Reaction(joint, axis)
        } else if let Some(&drive) = n.drives.get(owner) {
            match part {
                "force" | "F" => Reading::Drive(drive),
                "power" => Reading::DrivePower(drive),
                "work" => Reading::DriveWork(drive),
                _ => return Some(Err(parts(owner, "force, power and work"))),
            }
        } else if let Some(&force) = n.forces.get(owner) {
            match part {
                "value" => Reading::Force(force),
                "power" => Reading::ForcePower(force),
                "work" => Reading::ForceWork(force),
                _ => return Some(Err(parts(owner, "value, power and work"))),
            }
        } else if let Some(&group) = n.groups.get(owner) {
            match bound(part) {
                Some(bound) => Reading::Contact(group, bound),
                None => return Some(Err(parts(owner, "gap, F, N, T, Fx, Fy, x, y, slip (and tension for a string)"))),
            }
        } else {
            return None;
        };
        if self.reach < Reach::Instant {
            return Some(Err(Message::new(
                format!("`{name}` is an answer; it cannot be read here"),
                "reactions, powers and works may stand in events and reports",
            )));
        }
        Some(Ok(ModelExpr::variable(ModelVariable::Reading(reading))))
    }

    fn place(&self, argument: &Ast) -> Result<usize, ExprError> {
        match &argument.kind {
            AstKind::Name(name) => self.site(name).map_err(|m| m.at(&argument.span)),
            _ => Err(Message::new("a point is needed here", "write `body.point`").at(&argument.span)),
        }
    }

    fn body(&self, argument: &Ast) -> Result<usize, ExprError> {
        let AstKind::Name(name) = &argument.kind else {
            return Err(Message::new("a body is needed here", "write its name").at(&argument.span));
        };
        let bodies = &self.names.bodies;
        bodies.get(name).copied().ok_or_else(|| unknown("body", name, bodies.keys()).at(&argument.span))
    }

    /// The place of a site along or across a line: its offset in the line's own axes.
    fn offset(&self, site: usize, line: &Ast, across: bool) -> Result<ModelExpr, ExprError> {
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

    fn measure(&mut self, name: &str, a: &[Ast]) -> Result<ModelExpr, ExprError> {
        let variable = ModelExpr::variable;
        let rate = |e: ModelExpr| e.rate().expect("a place has a rate");
        let accel = |e: ModelExpr| e.accel().expect("a place has an acceleration");
        Ok(match name {
            "x" => variable(ModelVariable::X(self.place(&a[0])?)),
            "y" => variable(ModelVariable::Y(self.place(&a[0])?)),
            "angle" => variable(ModelVariable::Angle(self.body(&a[0])?)),
            "distance" => distance(self.place(&a[0])?, self.place(&a[1])?),
            "direction" => {
                let (p, q) = (self.place(&a[0])?, self.place(&a[1])?);
                (variable(ModelVariable::Y(q)) - variable(ModelVariable::Y(p)))
                    .atan2(variable(ModelVariable::X(q)) - variable(ModelVariable::X(p)))
            }
            "along" | "across" => self.offset(self.place(&a[0])?, &a[1], name == "across")?,
            "vx" => rate(variable(ModelVariable::X(self.place(&a[0])?))),
            "vy" => rate(variable(ModelVariable::Y(self.place(&a[0])?))),
            "speed" => {
                let site = self.place(&a[0])?;
                let (x, y) = (rate(variable(ModelVariable::X(site))), rate(variable(ModelVariable::Y(site))));
                (x.powi(2) + y.powi(2)).sqrt()
            }
            "omega" => rate(variable(ModelVariable::Angle(self.body(&a[0])?))),
            "ax" => accel(variable(ModelVariable::X(self.place(&a[0])?))),
            "ay" => accel(variable(ModelVariable::Y(self.place(&a[0])?))),
            _ => accel(variable(ModelVariable::Angle(self.body(&a[0])?))),
        })
    }

    fn whole(&self, name: &str, a: &[Ast]) -> Result<ModelExpr, ExprError> {
        let read = |r| ModelExpr::variable(ModelVariable::Reading(r));
        Ok(match name {
            "kinetic" => read(Reading::Kinetic(a.first().map(|b| self.body(b)).transpose()?)),
            "potential" => read(Reading::Potential),
            "energy" => read(Reading::Kinetic(None)) + read(Reading::Potential),
            "momentum_x" => read(Reading::Momentum(Axis::X)),
            "momentum_y" => read(Reading::Momentum(Axis::Y)),
            "centre_x" => read(Reading::Centre(Axis::X)),
            "centre_y" => read(Reading::Centre(Axis::Y)),
            "friction_work" => read(Reading::FrictionWork),
            _ => read(Reading::AngularMomentum(self.place(&a[0])?)),
        })
    }
}

impl expr::Scope<ModelVariable> for Scope<'_> {
    fn name(&mut self, name: &str) -> Result<ModelExpr, Message> {
        let n = self.names;
        // A curve's own letter hides a parameter of that name.
        if name == "s" && self.reach == Reach::Curve {
            return Ok(ModelExpr::variable(ModelVariable::Local));
        }
        if let Some(&i) = n.parameters.get(name) {
            return Ok(ModelExpr::variable(ModelVariable::Parameter(i)));
        }
        if self.reach >= Reach::Configuration {
            if let Some(&(joint, k)) = n.coordinates.get(name) {
                return Ok(ModelExpr::variable(ModelVariable::Coordinate(joint, k)));
            }
            if let Some(gauge) = n.gauges.get(name) {
                return Ok(gauge.clone());
            }
        }
        if name == "t" && self.reach >= Reach::Motion {
            return Ok(ModelExpr::variable(ModelVariable::Time));
        }
        if let Some(reading) = self.reading(name) {
            return reading;
        }
        if self.reach < Reach::Configuration && (n.coordinates.contains_key(name) || n.gauges.contains_key(name)) {
            return Err(Message::new(
                format!("`{name}` changes with the motion; here stands a number of the model"),
                "use parameters only",
            ));
        }
        Err(unknown("name", name, self.known().map(str::to_string).collect::<Vec<_>>().iter()))
    }

    fn call(&mut self, name: &str, arguments: &[Ast]) -> Option<Result<ModelExpr, ExprError>> {
        let wanted = |count: &[usize]| {
            (!count.contains(&arguments.len())).then(|| {
                let span = arguments.first().map_or(0..0, |a| a.span.clone());
                let numbers = count.iter().map(usize::to_string).collect::<Vec<_>>().join(" or ");
                Message::new(format!("`{name}` takes {numbers} arguments, not {}", arguments.len()), "").at(&span)
            })
        };
        let too_far = |reach: Reach| {
            (self.reach < reach).then(|| {
                let span = arguments.first().map_or(0..0, |a| a.span.clone());
                Message::new(
                    format!("`{name}(…)` cannot be read here"),
                    "see which expressions may read what in docs/model_file.md",
                )
                .at(&span)
            })
        };
        if let Some(&(_, reach)) = MEASURES.iter().find(|(word, _)| *word == name) {
            let count: &[usize] =
                if matches!(name, "distance" | "direction" | "along" | "across") { &[2] } else { &[1] };
            return Some(match wanted(count).or_else(|| too_far(reach)) {
                Some(error) => Err(error),
                None => self.measure(name, arguments),
            });
        }
        if name == "tension" {
            let mut of = |argument: &Ast| match &argument.kind {
                AstKind::Name(owner) => {
                    expr::Scope::name(self, &format!("{owner}.tension")).map_err(|m| m.at(&argument.span))
                }
                _ => Err(Message::new("a link or a string is needed here", "write its name").at(&argument.span)),
            };
            return Some(match (wanted(&[1]), arguments) {
                (None, [argument]) => of(argument),
                (error, _) => Err(error.expect("it has no argument, or several")),
            });
        }
        if let Some(&(_, count)) = READINGS.iter().find(|(word, _)| *word == name) {
            let count: &[usize] = if name == "kinetic" { &[0, 1] } else { &[count] };
            return Some(match wanted(count).or_else(|| too_far(Reach::Instant)) {
                Some(error) => Err(error),
                None => self.whole(name, arguments),
            });
        }
        None
    }

    fn table(&self, name: &str) -> Option<usize> {
        self.names.tables.get(name).copied()
    }

    fn functions(&self) -> Vec<String> {
        let words = MEASURES.iter().map(|m| m.0).chain(READINGS.iter().map(|r| r.0)).chain(["tension"]);
        words.map(str::to_string).chain(self.names.tables.keys().cloned()).collect()
    }

    fn discontinuity(&mut self) -> usize {
        *self.switches += 1;
        *self.switches - 1
    }
}

/// What a word after the name of a contact, stop or string stands for.
fn bound(part: &str) -> Option<ContactQuantity> {
    Some(match part {
        "gap" | "slack" => ContactQuantity::Gap,
        "N" | "tension" => ContactQuantity::Force,
        "T" => ContactQuantity::Friction,
        "F" => ContactQuantity::OnFirst(Axis::Size),
        "Fx" => ContactQuantity::OnFirst(Axis::X),
        "Fy" => ContactQuantity::OnFirst(Axis::Y),
        "x" => ContactQuantity::Place(Axis::X),
        "y" => ContactQuantity::Place(Axis::Y),
        "slip" => ContactQuantity::Slip,
        _ => return None,
    })
}

/// 2 for `F2`.
fn row_number(part: &str) -> usize {
    part[1..].parse().unwrap_or(usize::MAX)
}

fn parts(owner: &str, known: &str) -> Message {
    Message::new(format!("`{owner}` has no such part"), format!("it has {known}"))
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

/// Refuses time derivatives of what is found by solving an instant: they would need the equations differentiated.
fn check_derivatives(law: &ModelExpr, ast: &Ast) -> Result<(), ExprError> {
    let found = |variable: &ModelVariable| matches!(variable, ModelVariable::Reading(_));
    if law.derivatives().any(|(inner, _)| inner.variables().any(found)) {
        let hint = "`rate` and `accel` take expressions of the configuration; sample the quantity over a run instead";
        return Err(Message::new("a time derivative of a force, a momentum or an energy", hint).at(&ast.span));
    }
    Ok(())
}
