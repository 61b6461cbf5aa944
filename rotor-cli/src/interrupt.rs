//! What an interrupted run (Ctrl-C, `kill`) leaves behind: nothing.
//!
//! Unfinished files and folders are listed here while they exist. A signal removes them and ends the program with the
//! code that a shell expects, 128 and the signal's number; while finished files are moved to their places it waits.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files and folders that must not outlive the program.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());
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
#[cfg(unix)]
pub(crate) fn watch() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM, SIGHUP]) else {
        return;
    };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end(signal);
        }
    });
}

/// Elsewhere the system's own way of ending a program stays.
#[cfg(not(unix))]
pub(crate) fn watch() {}

#[cfg(unix)]
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
