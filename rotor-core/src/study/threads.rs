//! The threads that work on a scan: all cores with the feature `rayon`, without it the calling thread.

#[cfg(feature = "rayon")]
pub(super) use on_all_cores::{Threads, map};
#[cfg(not(feature = "rayon"))]
pub(super) use on_the_calling_thread::{Threads, map};

#[cfg(feature = "rayon")]
mod on_all_cores {
    use std::ops::Range;

    use rayon::prelude::*;
    use rayon::{Scope, ThreadPool, ThreadPoolBuilder};

    use crate::error::{Error, StudyError};

    /// Threads of a scan's own.
    pub(in crate::study) struct Threads(ThreadPool);

    impl Threads {
        /// Starts a number of threads, or one for each core.
        ///
        /// # Errors
        /// Where the system gives none.
        pub(in crate::study) fn new(count: Option<usize>) -> Result<Self, Error> {
            let pool = ThreadPoolBuilder::new().num_threads(count.unwrap_or(0));
            let pool = pool.build().map_err(|error| StudyError::Threads {
                reason: error.to_string(),
            })?;
            Ok(Self(pool))
        }

        /// How many there are.
        pub(in crate::study) fn count(&self) -> usize {
            self.0.current_num_threads()
        }

        /// Runs `body` on the calling thread; what it spawns runs on the others and ends before this does.
        pub(in crate::study) fn scope<'scope, R>(
            &self,
            body: impl FnOnce(&Scope<'scope>) -> R,
        ) -> R {
            self.0.in_place_scope(body)
        }
    }

    /// Works on some of the numbers, from the first on, as many as there are threads; the answers in order, and the number
    /// after the last.
    pub(in crate::study) fn map<T: Send>(
        numbers: Range<u64>,
        work: impl Fn(u64) -> Option<T> + Sync + Send,
    ) -> (Vec<T>, u64) {
        let together = rayon::current_num_threads() as u64;
        let end = numbers.end.min(numbers.start.saturating_add(together));
        let answers = (numbers.start..end).into_par_iter().filter_map(work);
        (answers.collect(), end)
    }
}

#[cfg(not(feature = "rayon"))]
mod on_the_calling_thread {
    use std::ops::Range;

    use crate::error::Error;

    /// The calling thread.
    pub(in crate::study) struct Threads;

    /// Where work is spawned, and done at once.
    pub(in crate::study) struct Scope;

    impl Threads {
        /// One, whatever the count.
        ///
        /// # Errors
        /// None: the thread is there.
        pub(in crate::study) const fn new(_count: Option<usize>) -> Result<Self, Error> {
            Ok(Self)
        }

        /// One.
        pub(in crate::study) const fn count(&self) -> usize {
            1
        }

        /// Runs `body`.
        pub(in crate::study) fn scope<R>(&self, body: impl FnOnce(&Scope) -> R) -> R {
            body(&Scope)
        }
    }

    impl Scope {
        /// Does the work.
        pub(in crate::study) fn spawn(&self, work: impl FnOnce(&Self)) {
            work(self);
        }
    }

    /// Works on the first of the numbers; its answer, and the number after it.
    pub(in crate::study) fn map<T>(
        numbers: Range<u64>,
        work: impl Fn(u64) -> Option<T>,
    ) -> (Vec<T>, u64) {
        let end = numbers.end.min(numbers.start.saturating_add(1));
        ((numbers.start..end).filter_map(work).collect(), end)
    }
}
