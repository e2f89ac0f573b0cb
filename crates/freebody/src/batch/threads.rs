//! Work shared out among threads.

use std::sync::Mutex;
use std::thread;

const UNPOISONED: &str = "no thread panics while it takes work";

/// Hands out what is to be done, in order, to threads, each of which does it by what `begin` gives it. That answers whether all may
/// go on, and so does `go_on`, which is asked now and then; false where they did not.
pub fn share_out<T: Send, W: FnMut(T) -> bool>(
    todo: impl Iterator<Item = T> + Send,
    threads: usize,
    begin: impl Fn() -> W + Sync,
    go_on: &mut dyn FnMut() -> bool,
) -> bool {
    let todo = Mutex::new(Some(todo));
    let left = || todo.lock().expect(UNPOISONED);
    let work = |go_on: &mut dyn FnMut() -> bool| {
        let mut work = begin();
        loop {
            let next = left().as_mut().and_then(Iterator::next);
            let Some(next) = next else { return };
            if !(work(next) && go_on()) {
                *left() = None;
            }
        }
    };
    thread::scope(|scope| {
        (1..threads).for_each(|_| drop(scope.spawn(|| work(&mut || true))));
        work(go_on);
    });
    todo.into_inner().expect(UNPOISONED).is_some()
}
