//! Work on all cores.

use std::num::NonZero;
use std::thread::available_parallelism;

/// What `work` makes of each item, in order, worked out on all cores.
pub(crate) fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = available_parallelism().map_or(1, NonZero::get);
    let work = &work;
    let mut parts: Vec<_> = std::thread::scope(|scope| {
        let part = |thread| {
            scope.spawn(move || {
                let own = items.iter().skip(thread).step_by(threads);
                own.map(work).collect::<Vec<R>>()
            })
        };
        let started: Vec<_> = (0..threads).map(part).collect();
        let joined = started.into_iter().map(|part| {
            part.join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
                .into_iter()
        });
        joined.collect()
    });
    let next = |item: usize| parts.get_mut(item % threads).and_then(Iterator::next);
    (0..items.len()).filter_map(next).collect()
}
