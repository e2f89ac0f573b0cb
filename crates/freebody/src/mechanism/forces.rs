//! Forces as compiled: laws on gauges and loads in a direction.

use crate::gauges::ModelExpr;
use crate::joints::LoadCard;

/// A force, compiled.
#[derive(Clone, Debug, Default)]
pub struct Force {
    /// Name.
    pub name: String,
    /// Its word in the list.
    pub word: &'static str,
    /// Laws on gauges.
    pub gauge_forces: Vec<GaugeForce>,
    /// Loads in a direction.
    pub point_forces: Vec<PointForce>,
    /// Friction of a plate.
    pub plate: Option<PlateFriction>,
    /// The potential energy of its conservative pulls, J; the work of all else is accounted for.
    pub potential: Option<ModelExpr>,
    /// What each of its pulls and pushes is, in this order.
    pub cards: Vec<LoadCard>,
}

impl Force {
    /// A law on a gauge.
    pub fn along_gauge(gauge: ModelExpr, value: ModelExpr, potential: Option<ModelExpr>) -> Self {
        let conservative = potential.is_some();
        Force {
            gauge_forces: vec![GaugeForce { gauge, value, bodies: vec![], conservative }],
            potential,
            ..Force::default()
        }
    }
    /// The laws that it evaluates.
    pub fn laws(&self) -> impl Iterator<Item = &ModelExpr> {
        let gauge_forces = self.gauge_forces.iter().flat_map(|p| [&p.gauge, &p.value]);
        let point_forces = self.point_forces.iter().flat_map(|p| [&p.x, &p.y]);
        gauge_forces.chain(point_forces).chain(self.plate.as_ref().map(|plate| &plate.most)).chain(&self.potential)
    }
    /// Whether its potential accounts for all its work.
    pub fn is_conservative(&self) -> bool {
        let potential = self.point_forces.is_empty() && self.plate.is_none();
        potential && self.gauge_forces.iter().all(|pull| pull.conservative)
    }
    /// The entry of the energy ledger for the work that no potential accounts for: of a spring, that of the damper beside it.
    pub fn ledger_entry(&self) -> String {
        let damper = if self.potential.is_some() { "damper of " } else { "" };
        format!("{damper}{}", self.name)
    }
    /// Whether its law has cases, like `max` or `if`.
    pub fn has_cases(&self) -> bool {
        let gauge_forces = self.gauge_forces.iter().map(|pull| &pull.value);
        gauge_forces
            .chain(self.point_forces.iter().flat_map(|push| [&push.x, &push.y]))
            .any(|law| law.discontinuities().next().is_some())
    }
}

/// A force that acts to increase a gauge.
#[derive(Clone, Debug)]
pub struct GaugeForce {
    /// The gauge.
    pub gauge: ModelExpr,
    /// How strongly, N for a length and N·m for an angle.
    pub value: ModelExpr,
    /// The bodies on which the gauge depends.
    pub bodies: Vec<usize>,
    /// Whether the potential of its force accounts for its work.
    pub conservative: bool,
}

/// A force at a point.
#[derive(Clone, Debug)]
pub struct PointForce {
    /// The site at which it acts.
    pub site: usize,
    /// Component along x, N.
    pub x: ModelExpr,
    /// Component along y, N.
    pub y: ModelExpr,
    /// Its value in a direction, N, where it is given so: negative, it acts the other way.
    pub value: Option<ModelExpr>,
    /// Whether x and y are the body's axes.
    pub with_body: bool,
}

/// Coulomb friction of an area, or of its rim, that is pressed evenly on a table.
#[derive(Clone, Debug)]
pub struct PlateFriction {
    /// The body that lies on the table.
    pub body: usize,
    /// What bounds the area.
    pub outline: PlateOutline,
    /// Whether only the rim of the area lies on the table.
    pub rim: bool,
    /// Its largest force: coefficient of friction times load, N.
    pub most: ModelExpr,
}

/// What bounds an area of a body.
#[derive(Clone, Debug)]
pub enum PlateOutline {
    /// The sites of the corners of a polygon that does not cross itself, either way round.
    Polygon(Vec<usize>),
    /// The site of the centre of a disk, and its radius, m.
    Disk(usize, ModelExpr),
}
