//! What a person writes for a joint or a force, and what he reads of it.

use serde::Serialize;

/// The card of a joint or of a force: its word and its fields; for joints also coordinates and rows, for forces its
/// loads.
#[derive(Clone, Debug, Serialize)]
pub struct Card {
    /// The word in a model file.
    #[serde(rename = "type")]
    pub word: &'static str,
    /// One sentence.
    pub doc: &'static str,
    /// What must or may be given.
    pub fields: Vec<Field>,
    /// Coordinates of the second body relative to the first, in the order of `pose`.
    pub coordinates: Vec<CoordinateCard>,
    /// Rows of `residual`, in order.
    pub rows: Vec<RowCard>,
    /// Whether it can have friction along its first coordinate.
    pub has_friction: bool,
    /// The loads of a force, in the order of its pulls and pushes.
    pub parts: Vec<LoadCard>,
    /// The glyph by which drawings show it, of the set in `views/symbols.py`; empty for none.
    pub glyph: &'static str,
    /// Strokes that drawings show at the two points of the joint, in sizes of symbols along fixed axes.
    pub outline: &'static [&'static [[f64; 2]]],
}

/// One field of a card.
#[derive(Clone, Debug, Serialize)]
pub struct Field {
    /// Its word.
    pub name: &'static str,
    /// What may stand there.
    pub kind: FieldKind,
    /// Unit of numbers, in SI; None where any will do.
    pub dimension: Option<&'static str>,
    /// What is taken when it is left out; None when it must be given.
    pub default: Option<&'static str>,
    /// One sentence.
    pub doc: &'static str,
    /// What it is to the joint.
    pub role: Role,
}

/// What may stand in a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FieldKind {
    /// `body.point`.
    Point,
    /// Two points or more.
    Points,
    /// A line of a body.
    Line,
    /// Centre and radius.
    Circle,
    /// A body by its shape, a circle, or a polygon.
    Area,
    /// A named curve.
    Curve,
    /// A body.
    Body,
    /// A number of the model: an expression of parameters.
    Number,
    /// Several numbers.
    Numbers,
    /// An expression of time and state.
    Law,
    /// An expression of the configuration.
    Gauge,
    /// On or off.
    Flag,
    /// `fixed` or `body`.
    Frame,
}

/// What a field is to a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// A number, in the order of the fields.
    Number,
    /// The marker on the first body.
    First,
    /// The marker on the second body.
    Second,
    /// Both markers: the first point and the second.
    Both,
}

/// A coordinate of a joint.
#[derive(Clone, Debug, Serialize)]
pub struct CoordinateCard {
    /// Its word, used when the person gives no name.
    pub name: &'static str,
    /// `m` or `rad`, or empty for a curve parameter.
    pub dimension: &'static str,
    /// The turn of the second body, which a particle does not have.
    pub turn: bool,
    /// The line along which, or across which, it moves the second body, `{}` being the joint: `the slider {}`; or
    /// empty.
    pub line: &'static str,
    /// Whether it moves the body across that line.
    pub across: bool,
    /// Whether it is a gap, which a stop called `JOINT.contact` keeps from falling below 0.
    pub gap: bool,
    /// What is said of the joint where this falls to 0 and a motion ends: `is wound up`; or empty.
    pub ends: &'static str,
}

/// What a load is: a component of a reaction, a force of the model, friction. Who names it, draws it or tells its unit
/// reads it here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct LoadCard {
    /// What it is called: `normal force`.
    pub name: &'static str,
    /// What an expression of the model calls it behind the name of its owner: `Fn`.
    pub reading: &'static str,
    /// The stem of its symbol: `N`; empty for the components of a pin's force, which are named after the pin.
    pub stem: &'static str,
    /// Whether it is a couple, N·m, and not a force, N.
    pub couple: bool,
    /// Whether it is a tension: where it is positive it draws its two bodies together.
    pub pulls: bool,
    /// Whether one side presses on the other with it: where it would pull, what is one-sided lets go.
    pub presses: bool,
    /// Whether it acts along two surfaces that touch.
    pub tangent: bool,
    /// Whether its sign says on which flank teeth bear.
    pub flank: bool,
}

impl LoadCard {
    /// A force.
    pub const fn force(name: &'static str, reading: &'static str, stem: &'static str) -> Self {
        LoadCard { name, reading, stem, couple: false, pulls: false, presses: false, tangent: false, flank: false }
    }
    /// A couple.
    pub const fn couple(name: &'static str, reading: &'static str) -> Self {
        LoadCard { couple: true, ..LoadCard::force(name, reading, "M") }
    }
    /// A normal force, by which one side presses on the other.
    pub const fn press(name: &'static str, reading: &'static str) -> Self {
        LoadCard { presses: true, ..LoadCard::force(name, reading, "N") }
    }
    /// A tension.
    pub const fn tension() -> Self {
        LoadCard { pulls: true, ..LoadCard::force("tension", "tension", "T") }
    }
    /// The same as a couple, if what it acts along is a turn.
    pub fn along(self, turns: bool) -> Self {
        if turns {
            LoadCard { couple: true, stem: "M", ..self }
        } else {
            self
        }
    }
}

/// A row of a joint expressed as a constraint, by the load that its multiplier is.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RowCard {
    /// The load. One that pulls is read against the multiplier, which pushes where it is positive.
    #[serde(flatten)]
    pub load: LoadCard,
    /// It is a component of the force of a pin, which a person tells along fixed axes: 0 for x, 1 for y.
    #[serde(skip)]
    pub pin: Option<usize>,
    /// Only its change counts: its value at the start of a motion is its zero (teeth mesh as they are put).
    #[serde(skip)]
    pub is_relative: bool,
    /// It is a force that passes beside the joint's point, and so has a moment about it.
    #[serde(skip)]
    pub beside: bool,
    /// It constrains rates only: a non-holonomic constraint.
    #[serde(skip)]
    pub of_rates: bool,
}

impl RowCard {
    /// A row whose multiplier is this load.
    pub fn of(load: LoadCard) -> Self {
        RowCard { load, pin: None, is_relative: false, beside: false, of_rates: false }
    }
    /// The sign of its load for a positive multiplier.
    pub fn sign(&self) -> f64 {
        if self.load.pulls {
            -1.0
        } else {
            1.0
        }
    }
    /// Whether it gives the joint's reaction a moment about the joint's point.
    pub fn turns(&self) -> bool {
        self.load.couple || self.beside
    }
}

impl Card {
    /// A card with its word and sentence.
    pub fn new(word: &'static str, doc: &'static str) -> Self {
        Card {
            word,
            doc,
            fields: vec![],
            coordinates: vec![],
            rows: vec![],
            has_friction: false,
            parts: vec![],
            glyph: "",
            outline: &[],
        }
    }
    /// A field that must be given.
    pub fn needs(
        mut self,
        name: &'static str,
        kind: FieldKind,
        role: Role,
        dimension: &'static str,
        doc: &'static str,
    ) -> Self {
        self.fields.push(Field { name, kind, dimension: Some(dimension), default: None, doc, role });
        self
    }
    /// A field that may be left out.
    pub fn takes(
        mut self,
        name: &'static str,
        kind: FieldKind,
        dimension: &'static str,
        default: &'static str,
        doc: &'static str,
    ) -> Self {
        let role = Role::Number;
        self.fields.push(Field { name, kind, dimension: Some(dimension), default: Some(default), doc, role });
        self
    }
    /// A coordinate.
    pub fn coordinate(mut self, name: &'static str, dimension: &'static str) -> Self {
        let (turn, across, gap) = (false, false, false);
        self.coordinates.push(CoordinateCard { name, dimension, turn, line: "", across, gap, ends: "" });
        self
    }
    /// The line along which the last coordinate moves the second body, `{}` being the joint.
    pub fn along(mut self, line: &'static str) -> Self {
        self.coordinates.last_mut().expect("a coordinate").line = line;
        self
    }
    /// The line across which it does.
    pub fn across(mut self, line: &'static str) -> Self {
        self = self.along(line);
        self.coordinates.last_mut().expect("a coordinate").across = true;
        self
    }
    /// The coordinate that is the turn of the second body.
    pub fn turn(mut self) -> Self {
        self = self.coordinate("angle", "rad");
        self.coordinates.last_mut().expect("a coordinate").turn = true;
        self
    }
    /// The coordinate that is the gap between what can only push each other, with a field for their restitution.
    pub fn gap(mut self) -> Self {
        self = self.coordinate("gap", "m");
        self.coordinates.last_mut().expect("a coordinate").gap = true;
        self.takes("restitution", FieldKind::Number, "", "0", "speed of parting over speed of approach, 0 to 1")
    }
    /// A motion ends where the last coordinate, a free length, falls to 0, by an event that says so of the joint.
    pub fn ends(mut self, words: &'static str) -> Self {
        self.coordinates.last_mut().expect("a coordinate").ends = words;
        self
    }
    /// Whether its bodies push each other by a stop, and have no reaction besides.
    pub fn is_one_sided(&self) -> bool {
        self.coordinates.iter().any(|coordinate| coordinate.gap)
    }
    /// The two rows that keep a point on a point.
    pub fn pin(self) -> Self {
        let axis = |name, reading, axis| RowCard { pin: Some(axis), ..RowCard::of(LoadCard::force(name, reading, "")) };
        self.row(axis("force along x", "Fx", 0)).row(axis("force along y", "Fy", 1))
    }
    /// A row that holds the second body's turn.
    pub fn couple(self) -> Self {
        self.row(RowCard::of(LoadCard::couple("couple", "M")))
    }
    /// It can have friction along its first coordinate.
    pub fn with_friction(mut self) -> Self {
        self.has_friction = true;
        self
    }
    /// The glyph by which drawings show it.
    pub fn glyph(mut self, name: &'static str) -> Self {
        self.glyph = name;
        self
    }
    /// Strokes that drawings show at the two points of the joint, in sizes of symbols.
    pub fn outline(mut self, strokes: &'static [&'static [[f64; 2]]]) -> Self {
        self.outline = strokes;
        self
    }
    /// The loads of a force, in the order of its pulls and pushes.
    pub fn loads(mut self, parts: &[LoadCard]) -> Self {
        self.parts = parts.to_vec();
        self
    }
    /// A row.
    pub fn row(mut self, row: RowCard) -> Self {
        self.rows.push(row);
        self
    }
}
