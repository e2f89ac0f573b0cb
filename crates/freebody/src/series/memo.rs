//! Programs that were made before.

use super::Program;
use rustc_hash::FxHashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

/// Programs, each by what it holds for, made once; none where there can be none.
#[derive(Debug)]
pub struct Memo<K>(Mutex<FxHashMap<K, Option<Arc<Program>>>>);

impl<K> Default for Memo<K> {
    fn default() -> Self {
        Memo(Mutex::default())
    }
}

impl<K: Eq + Hash> Memo<K> {
    /// The program for something.
    pub fn program(&self, holds_for: K, make: impl FnOnce() -> Option<Program>) -> Option<Arc<Program>> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry(holds_for).or_insert_with(|| make().map(Arc::new)).clone()
    }
}
