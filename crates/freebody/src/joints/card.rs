//! What a person writes for a joint or a force, and what he reads of it.

use serde::Serialize;

/// The card of a joint or of a force: its word and its fields; for joints also coordinates and rows.
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
    /// Whether it can rub along its first coordinate.
    pub rubs: bool,
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
    #[serde(skip)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    #[serde(skip)]
    pub turn: bool,
}

/// A row of a joint told as a constraint.
#[derive(Clone, Debug, Serialize)]
pub struct RowCard {
    /// What its multiplier is: `force` in N, or `couple` in N·m.
    pub name: &'static str,
    /// It holds a turn, which a particle does not have.
    #[serde(skip)]
    pub turning: bool,
    /// It is a component of the force of a pin, which a person tells along fixed axes: 0 for x, 1 for y.
    #[serde(skip)]
    pub pin: Option<usize>,
    /// Only its change counts: its value at the start of a motion is its zero (teeth mesh as they are put).
    #[serde(skip)]
    pub phased: bool,
}

impl Card {
    /// A card with its word and sentence.
    pub fn new(word: &'static str, doc: &'static str) -> Self {
        Card { word, doc, fields: vec![], coordinates: vec![], rows: vec![], rubs: false }
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
        self.coordinates.push(CoordinateCard { name, dimension, turn: false });
        self
    }
    /// The coordinate that is the turn of the second body.
    pub fn turn(mut self) -> Self {
        self.coordinates.push(CoordinateCard { name: "angle", dimension: "rad", turn: true });
        self
    }
    /// The two rows that keep a point on a point.
    pub fn pin(self) -> Self {
        let axis = |name, axis| RowCard { name, turning: false, pin: Some(axis), phased: false };
        self.row(axis("force along x", 0)).row(axis("force along y", 1))
    }
    /// A row whose multiplier is a force.
    pub fn force(self, name: &'static str) -> Self {
        self.row(RowCard { name, turning: false, pin: None, phased: false })
    }
    /// A force row of which only the change counts.
    pub fn phased(self, name: &'static str) -> Self {
        self.row(RowCard { name, turning: false, pin: None, phased: true })
    }
    /// It can rub along its first coordinate.
    pub fn rubbing(mut self) -> Self {
        self.rubs = true;
        self
    }
    /// A row that holds the second body's turn.
    pub fn couple(self) -> Self {
        self.row(RowCard { name: "couple", turning: true, pin: None, phased: false })
    }
    fn row(mut self, row: RowCard) -> Self {
        self.rows.push(row);
        self
    }
}
