//! The progress bar, on a terminal only.

use std::io::IsTerminal as _;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar with rate and time left; none where stderr is no terminal.
pub(super) struct Progress(Option<ProgressBar>);

impl Progress {
    /// A bar for so many points.
    pub(super) fn new(points: u64) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self(None);
        }
        let bar = ProgressBar::new(points);
        let style =
            "{wide_bar} {percent} %  {human_pos} of {human_len} points  {per_sec}  {eta} left";
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(200));
        Self(Some(bar))
    }

    /// Shows how many points are done.
    pub(super) fn at(&self, points: u64) {
        if let Some(bar) = &self.0 {
            bar.set_position(points);
        }
    }

    /// Takes the bar away, so that what is printed next has the line for itself.
    pub(super) fn finish(&self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
