//! Running a plan: chunks on all threads, delivered in order, with few of them in memory.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::sync::{Arc, Mutex, PoisonError};

use super::Plan;
use super::chunk::{self, Chunk, Counts, Kernels};
use super::collected::Collected;
use super::reduce::{Reduced, Reductions};
use super::sink::Sink;
use super::threads::{self, Threads};
use crate::error::{Error, StudyError};

/// The most numbers that are collected in memory, 32 GiB of them: more than a workstation has to spare.
pub const MOST_COLLECTED: u64 = 1 << 32;

/// Asks running scans to stop; clones ask the same ones.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Asks to stop. What was delivered until then stays.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked for.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What is told of progress: points delivered so far, those of an earlier run included.
type Progress<'a> = &'a (dyn Fn(u64) + Sync);

/// How a plan is run. The default is all cores, uncancelled, silent.
#[derive(Clone, Default)]
pub struct Control<'a> {
    /// How many threads, or one for each core; one is the calling thread. The results are the same.
    pub threads: Option<usize>,
    /// Looked at a few thousand points apart.
    pub cancel: Cancel,
    /// Called after each chunk, on the calling thread.
    pub progress: Option<Progress<'a>>,
}

/// What a run came to.
#[derive(Clone, Debug)]
pub struct Report {
    /// The points, and how many have no value.
    pub counts: Counts,
    /// The results of the reductions, in the order in which they were asked for.
    pub reduced: Vec<Reduced>,
}

/// Why a run ended early.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Stopped<E> {
    /// The scan itself.
    #[error(transparent)]
    Scan(#[from] Error),
    /// The sink.
    #[error("{0}")]
    Sink(E),
}

/// A state of reductions from which a run can go on: the chunks before `chunk` are in it.
pub struct Saved<'a> {
    /// The next chunk.
    pub chunk: u64,
    /// The counts of those before.
    pub counts: &'a Counts,
    /// What was kept of them.
    pub reductions: &'a Reductions<'a>,
}

impl Plan {
    /// Runs the reductions; memory does not grow with the number of points.
    ///
    /// # Errors
    /// Where it was cancelled, or threads cannot be started.
    pub fn reduce(&self, control: &Control<'_>) -> Result<Report, Error> {
        self.reduce_from(0, Counts::none(self.quantities.len()), &[], control, |_| {})
    }

    /// Runs the reductions from the chunk number `chunk` on, with the counts and the state that
    /// [`Reductions::to_bytes`] gave after the chunks before it (no bytes: no chunks). `save` is
    /// called after each chunk, in order, and may keep what it is given.
    ///
    /// # Errors
    /// As [`Plan::reduce`], and where the state does not belong to this plan.
    pub fn reduce_from(
        &self,
        chunk: u64,
        mut counts: Counts,
        state: &[u8],
        control: &Control<'_>,
        mut save: impl FnMut(&Saved<'_>),
    ) -> Result<Report, Error> {
        let mut reductions = if chunk == 0 {
            Reductions::of_all(self)
        } else {
            Reductions::from_bytes(self, state)?
        };
        let kernels = Kernels::new(self);
        let work = |number, stop: &dyn Fn() -> bool| chunk::reduce(&kernels, number, stop);
        let all = chunk..self.chunk_count();
        let outcome = self.ordered(all, control, work, |number, (part_counts, part)| {
            counts.add(&part_counts);
            reductions.merge(&part);
            if let Some(progress) = control.progress {
                progress(counts.points);
            }
            save(&Saved {
                chunk: number + 1,
                counts: &counts,
                reductions: &reductions,
            });
            Ok::<_, Error>(())
        });
        match outcome {
            Ok(()) => Ok(Report {
                counts,
                reduced: reductions.finish(),
            }),
            Err(Stopped::Scan(error) | Stopped::Sink(error)) => Err(error),
        }
    }

    /// Runs the scan and gives every chunk to a sink, in order; chunks that the sink has already are
    /// not computed.
    ///
    /// # Errors
    /// The sink's errors, and as [`Plan::reduce`].
    pub fn write_to<S: Sink>(
        &self,
        sink: &S,
        control: &Control<'_>,
    ) -> Result<Counts, Stopped<S::Error>> {
        let mut counts = Counts::none(self.quantities.len());
        let kernels = Kernels::new(self);
        let work = |number, stop: &dyn Fn() -> bool| {
            if let Some(counts) = sink.finished(number) {
                return Some(Ok((counts, None)));
            }
            let chunk = chunk::evaluate(&kernels, number, stop)?;
            let encoded = sink.encode(&chunk);
            Some(encoded.map(|encoded| (chunk.counts().clone(), Some(encoded))))
        };
        self.ordered(0..self.chunk_count(), control, work, |number, outcome| {
            let (part, encoded) = outcome?;
            if let Some(encoded) = encoded {
                sink.take(number, encoded)?;
            }
            counts.add(&part);
            if let Some(progress) = control.progress {
                progress(counts.points);
            }
            Ok(())
        })?;
        Ok(counts)
    }

    /// Runs the scan and keeps every quantity at every point in memory.
    ///
    /// ```
    /// use rotor_core::input::NumericInput;
    /// use rotor_core::jeffcott::rotor::Rotor;
    /// use rotor_core::quantity::Quantity;
    /// use rotor_core::study::{Axis, Control, Scan};
    ///
    /// let depth = NumericInput::find("crack.depth_ratio").ok_or("no such input")?;
    /// let scan = Scan::of(&Rotor::default()).vary(Axis::linear(depth, (0.0, 0.4), 5)?);
    /// let collected = scan.quantity(Quantity::CirWidth).plan()?.collect(&Control::default())?;
    /// assert!(collected.column(0).complete().is_some_and(|widths| widths.len() == 5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Where there are more than [`MOST_COLLECTED`] numbers; it was cancelled; or threads cannot be started.
    pub fn collect(&self, control: &Control<'_>) -> Result<Collected, Error> {
        let mut collected = Collected::new();
        self.collect_into(&mut collected, control)?;
        Ok(collected)
    }

    /// Does as [`Plan::collect`], in the memory of an earlier collection.
    ///
    /// # Errors
    /// As [`Plan::collect`]; then nothing is collected.
    pub fn collect_into(
        &self,
        collected: &mut Collected,
        control: &Control<'_>,
    ) -> Result<(), Error> {
        let quantities = self.quantities.len() as u64;
        let numbers = self.space.len().saturating_mul(quantities);
        let length = usize::try_from(self.space.len());
        let (true, Ok(length)) = (numbers <= MOST_COLLECTED, length) else {
            return Err(StudyError::TooMuchToCollect {
                numbers,
                most: MOST_COLLECTED,
            }
            .into());
        };
        let mut results = std::mem::take(&mut collected.results);
        collected.counts = Counts::none(0);
        collected.quantities.clone_from(&self.quantities);
        results.truncate(self.quantities.len());
        results.retain(|result| result.len() == length);
        // Zeros are memory that the threads are the first to touch.
        results.resize_with(self.quantities.len(), || vec![0.0; length]);
        collected.counts = self.fill(&mut results, control)?;
        collected.results = results;
        Ok(())
    }

    /// Fills columns with the quantities at all points, chunk by chunk on all threads.
    fn fill(&self, results: &mut [Vec<f64>], control: &Control<'_>) -> Result<Counts, Error> {
        let mut rest: Vec<&mut [f64]> = results.iter_mut().map(Vec::as_mut_slice).collect();
        let parts = (0..self.chunk_count()).map(|number| {
            let (_, length) = chunk::extent(self, number);
            let slices = rest
                .iter_mut()
                .filter_map(|rest| rest.split_off_mut(..length as usize));
            Mutex::new(slices.collect::<Vec<_>>())
        });
        let parts: Vec<_> = parts.collect();
        let kernels = Kernels::new(self);
        let work = |number: u64, stop: &dyn Fn() -> bool| {
            let part = parts.get(number as usize)?;
            // Each chunk is worked on once.
            let mut part = part.lock().unwrap_or_else(PoisonError::into_inner);
            chunk::fill(&kernels, number, &mut part, stop)
        };
        let mut counts = Counts::none(self.quantities.len());
        let all = 0..self.chunk_count();
        let outcome = self.ordered(all, control, work, |_, part| {
            counts.add(&part);
            if let Some(progress) = control.progress {
                progress(counts.points);
            }
            Ok::<_, Error>(())
        });
        match outcome {
            Ok(()) => Ok(counts),
            Err(Stopped::Scan(error) | Stopped::Sink(error)) => Err(error),
        }
    }

    /// The chunks, one after the other; as many as there are threads are computed together.
    pub fn chunks(&self) -> Chunks<'_> {
        Chunks {
            plan: self,
            kernels: Kernels::new(self),
            next: 0,
            ready: VecDeque::new(),
        }
    }

    /// Works on the chunks of a range one after the other, on the calling thread.
    fn in_turn<T, E>(
        &self,
        numbers: std::ops::Range<u64>,
        control: &Control<'_>,
        work: impl Fn(u64, &dyn Fn() -> bool) -> Option<T>,
        mut deliver: impl FnMut(u64, T) -> Result<(), E>,
    ) -> Result<(), Stopped<E>> {
        let stop = || control.cancel.is_cancelled();
        for number in numbers {
            match work(number, &stop).filter(|_| !stop()) {
                Some(outcome) => deliver(number, outcome).map_err(Stopped::Sink)?,
                None => {
                    return Err(Stopped::Scan(
                        StudyError::Cancelled {
                            chunks: number,
                            all: self.chunk_count(),
                        }
                        .into(),
                    ));
                }
            }
        }
        Ok(())
    }

    /// Works on the chunks of a range on all threads and delivers what comes of them in order.
    fn ordered<T: Send, E>(
        &self,
        mut numbers: std::ops::Range<u64>,
        control: &Control<'_>,
        work: impl Fn(u64, &dyn Fn() -> bool) -> Option<T> + Sync,
        mut deliver: impl FnMut(u64, T) -> Result<(), E>,
    ) -> Result<(), Stopped<E>> {
        if control.threads == Some(1) {
            return self.in_turn(numbers, control, work, deliver);
        }
        let threads = Threads::new(control.threads)?;
        // Each thread has one chunk at work and one that waits for its turn.
        let in_flight = 2 * threads.count();
        let failed = AtomicBool::new(false);
        let stop = || failed.load(Ordering::Relaxed) || control.cancel.is_cancelled();
        threads.scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            let mut outstanding = VecDeque::new();
            let mut done = BTreeMap::new();
            loop {
                while outstanding.len() < in_flight
                    && let Some(number) = numbers.next()
                {
                    outstanding.push_back(number);
                    let (sender, work, stop) = (sender.clone(), &work, &stop);
                    scope.spawn(move |_| {
                        let outcome = catch_unwind(AssertUnwindSafe(|| work(number, stop)));
                        // Nobody listens any more after a failure.
                        let _ = sender.send((number, outcome));
                    });
                }
                let Some(number) = outstanding.pop_front() else {
                    return Ok(());
                };
                while !done.contains_key(&number)
                    && let Ok((number, outcome)) = receiver.recv()
                {
                    done.insert(number, outcome);
                }
                let outcome = match done.remove(&number) {
                    Some(Ok(Some(outcome))) if !control.cancel.is_cancelled() => outcome,
                    Some(Err(panic)) => {
                        failed.store(true, Ordering::Relaxed);
                        resume_unwind(panic)
                    }
                    _ => {
                        return Err(Stopped::Scan(
                            StudyError::Cancelled {
                                chunks: number,
                                all: self.chunk_count(),
                            }
                            .into(),
                        ));
                    }
                };
                if let Err(error) = deliver(number, outcome) {
                    failed.store(true, Ordering::Relaxed);
                    return Err(Stopped::Sink(error));
                }
            }
        })
    }
}

/// Iterator over the chunks of a plan; see [`Plan::chunks`].
pub struct Chunks<'a> {
    plan: &'a Plan,
    kernels: Kernels<'a>,
    next: u64,
    ready: VecDeque<Chunk<'a>>,
}

impl<'a> Iterator for Chunks<'a> {
    type Item = Chunk<'a>;

    fn next(&mut self) -> Option<Chunk<'a>> {
        if self.ready.is_empty() {
            let numbers = self.next..self.plan.chunk_count();
            let work = |number| chunk::evaluate(&self.kernels, number, &|| false);
            let (chunks, next) = threads::map(numbers, work);
            self.next = next;
            self.ready.extend(chunks);
        }
        self.ready.pop_front()
    }
}
