//! Programs and tapes that were made before.

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

/// What was made last, with what it holds for.
#[derive(Debug)]
pub struct Latest<K, V>(Mutex<Option<(K, Arc<V>)>>);

impl<K, V> Default for Latest<K, V> {
    fn default() -> Self {
        Latest(Mutex::default())
    }
}

impl<K: PartialEq, V> Latest<K, V> {
    /// What holds for something, made where that is not the last.
    ///
    /// # Errors
    /// Those of making it.
    pub fn of<E>(&self, holds_for: K, make: impl FnOnce() -> Result<V, E>) -> Result<Arc<V>, E> {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &*last {
            Some((known, made)) if *known == holds_for => Ok(Arc::clone(made)),
            _ => Ok(Arc::clone(&last.insert((holds_for, Arc::new(make()?))).1)),
        }
    }
}
