//! What an interrupted run (Ctrl-C, `kill`) leaves behind: nothing.
//!
//! Unfinished files and folders are listed here while they exist. A signal removes them and ends the program with the
//! code that a shell expects, 128 and the signal's number; while finished files are moved to their places it waits. Work
//! that can stop by itself, with what it has finished, is asked to first.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files and folders that must not outlive the program.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
/// The signal that work was asked to stop by; that of Ctrl-C until there is one.
static ASKED_BY: AtomicU8 = AtomicU8::new(2);
/// Held while files are moved to their places.
static MOVING: Mutex<()> = Mutex::new(());

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // A list of paths is whole whatever panicked beside it.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A path on the list, as long as this lives.
pub(crate) struct Unfinished(PathBuf);

impl Unfinished {
    /// Puts a path on the list.
    pub(crate) fn new(path: &Path) -> Self {
        lock(&UNFINISHED).push(path.to_owned());
        Self(path.to_owned())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        lock(&UNFINISHED).retain(|path| *path != self.0);
    }
}

/// Until this is dropped, a signal waits.
pub(crate) fn while_moving() -> MutexGuard<'static, ()> {
    lock(&MOVING)
}

/// From here on signals remove what is unfinished. Where they cannot be watched they end the program as ever.
pub(crate) fn watch() {
    on_signals(end);
}

/// From here on the first signal asks work to stop, a second one ends the program as [`watch`] says.
pub(crate) fn watch_asking(stop: impl Fn() + Send + 'static) {
    let mut asked = false;
    on_signals(move |signal| {
        if asked {
            end(signal);
        }
        asked = true;
        ASKED_BY.store(u8::try_from(signal).unwrap_or(2), Ordering::Relaxed);
        stop();
    });
}

/// The exit code of work that stopped because it was asked to.
pub(crate) fn exit_code() -> u8 {
    128 + ASKED_BY.load(Ordering::Relaxed)
}

#[cfg(unix)]
fn on_signals(mut what: impl FnMut(i32) + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    std::thread::spawn(move || signals.forever().for_each(&mut what));
}

/// Elsewhere the system's own way of ending a program stays.
#[cfg(not(unix))]
fn on_signals(_: impl FnMut(i32) + Send + 'static) {}

#[allow(
    clippy::exit,
    reason = "a signal ends the program wherever it is; the locks are kept so that nothing goes on meanwhile"
)]
fn end(signal: i32) {
    let _moving = lock(&MOVING);
    let unfinished = lock(&UNFINISHED);
    for path in unfinished.iter() {
        let removed = std::fs::remove_file(path);
        if removed.is_err() {
            // What cannot be removed stays; there is nobody left to be told.
            let _ = std::fs::remove_dir_all(path);
        }
    }
    std::process::exit(128 + signal);
}
