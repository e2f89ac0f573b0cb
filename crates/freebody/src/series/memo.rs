//! Programs that were made before.

use super::Program;
use rustc_hash::FxHashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Programs, each by what it holds for, made once; none where there can be none.
#[derive(Debug, Default)]
pub struct Memo(Mutex<FxHashMap<Vec<bool>, Option<Arc<Program>>>>);

impl Memo {
    /// The program for something.
    pub fn program(&self, holds_for: &[bool], make: impl FnOnce() -> Option<Program>) -> Option<Arc<Program>> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(holds_for.to_vec()).or_insert_with(|| make().map(Arc::new)).clone()
    }
}
