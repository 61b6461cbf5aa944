//! Work on all cores.

use std::num::NonZero;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

/// The least operations that are worth a thread: some hundred microseconds of work.
pub(crate) const WORTH_A_THREAD: usize = 1 << 16;

/// What an operation counts for that is rebuilt, or whose like is looked for, beside one that is evaluated at a point: that
/// takes some microseconds.
pub(crate) const SEARCHED: usize = 256;

/// How many cores there are. To ask the system takes as long as all work on a small formula.
static CORES: LazyLock<usize> = LazyLock::new(|| available_parallelism().map_or(1, NonZero::get));

/// What `work` makes of each item, in order, worked out on all cores where all of it together is so many operations that
/// this is worth it, and here where it is not.
pub(crate) fn on_worthwhile_cores<T: Sync, R: Send>(
    items: &[T],
    operations: usize,
    work: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    if operations < WORTH_A_THREAD {
        return items.iter().map(work).collect();
    }
    on_all_cores(items, work)
}

/// What `work` makes of each item, in order, worked out on all cores; a core that is done takes the next item.
pub(crate) fn on_all_cores<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = (*CORES).min(items.len());
    if threads < 2 {
        return items.iter().map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(place) else {
                return done;
            };
            done.push((place, work(item)));
        }
    };
    let mut done = std::thread::scope(|scope| {
        let helpers: Vec<_> = (1..threads).map(|_| scope.spawn(take)).collect();
        let mut done = take();
        for helper in helpers {
            let of_helper = helper.join();
            done.extend(of_helper.unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        }
        done
    });
    done.sort_unstable_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, result)| result).collect()
}

/// What two pieces of work make, done side by side where they are so many operations that this is worth it.
pub(crate) fn both<A: Send, B>(
    operations: usize,
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B,
) -> (A, B) {
    if operations < WORTH_A_THREAD || *CORES < 2 {
        return (first(), second());
    }
    std::thread::scope(|scope| {
        let first = scope.spawn(first);
        let second = second();
        let first = first.join();
        (
            first.unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            second,
        )
    })
}
