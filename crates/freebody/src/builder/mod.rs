//! A mechanism being built: what names mean, how expressions, numbers, places and fields of the model are read.

pub mod answers;
mod fields;
mod names;
mod places;
pub mod readings;

pub use fields::Fields;
pub use names::{chosen, distance, unknown, Names, Reach, Scope};

use crate::error::CompileError;
use crate::expr::Message;
use crate::gauges::ModelExpr;
use crate::mechanism::{Marker, Mechanism, ValueId};
use crate::spec::{Number, Spec};

impl CompileError {
    /// A message about an expression, said to be about an item of the model.
    pub(crate) fn from(path: impl Into<String>, message: Message) -> Self {
        CompileError::new(path, message.what, message.hint)
    }
}

/// What building answers.
pub type Result<T> = std::result::Result<T, CompileError>;

/// A mechanism being built, with the meaning of its names.
pub struct Builder<'s> {
    pub(crate) spec: &'s Spec,
    pub(crate) names: Names,
    pub(crate) m: Mechanism,
}

impl Builder<'_> {
    pub(crate) fn scope(&mut self, reach: Reach) -> Scope<'_> {
        Scope { names: &self.names, reach, switches: &mut self.m.switches }
    }

    pub(crate) fn law(&mut self, path: &str, text: &str, reach: Reach) -> Result<ModelExpr> {
        self.scope(reach).law(text).map_err(|e| Names::error(path, text, e))
    }

    pub(crate) fn number(&mut self, path: &str, number: &Number) -> Result<ModelExpr> {
        match number {
            Number::Literal(value) if value.is_finite() => Ok(ModelExpr::constant(*value)),
            Number::Literal(value) => {
                Err(CompileError::new(path, format!("{value} is no number"), "give a finite number"))
            }
            Number::Expression(text) => self.law(path, text, Reach::Numbers),
        }
    }

    /// A new slot.
    pub(crate) fn value(&mut self, law: ModelExpr) -> ValueId {
        self.m.values.push(law);
        self.m.values.len() - 1
    }

    /// A site with a direction.
    pub(crate) fn marker(&mut self, site: usize, direction: ModelExpr) -> Marker {
        let turned = direction != ModelExpr::constant(0.0);
        Marker { site, angle: self.value(direction), turned }
    }

    /// The same, along the axes of its body.
    pub(crate) fn straight_marker(&mut self, site: usize) -> Marker {
        self.marker(site, ModelExpr::constant(0.0))
    }

    /// A new slot, of a length.
    pub(crate) fn length(&mut self, law: ModelExpr) -> ValueId {
        self.m.lengths.push(self.m.values.len());
        self.value(law)
    }

    pub(crate) fn number_value(&mut self, path: &str, number: &Number) -> Result<ValueId> {
        let law = self.number(path, number)?;
        Ok(self.value(law))
    }

    pub(crate) fn length_value(&mut self, path: &str, number: &Number) -> Result<ValueId> {
        let law = self.number(path, number)?;
        Ok(self.length(law))
    }
}

pub(crate) fn twice(path: impl Into<String>, name: &str) -> CompileError {
    CompileError::new(path, format!("the name `{name}` is given twice"), "give each its own name")
}
