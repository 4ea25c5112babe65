//! A progress bar on the error stream, shown on a terminal only.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressFinish, ProgressStyle};

/// The time between two updates of a bar.
pub(crate) const INTERVAL: Duration = Duration::from_millis(100);

/// A bar of `length` steps; hidden where the error stream is no terminal.
pub(crate) fn bar(length: u64, what: &str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length), target());
    // A run that fails leaves no piece of a bar before its message.
    let bar = bar.with_finish(ProgressFinish::AndClear);
    // The template is a constant; a mistake in it would only lose the style.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent}% {eta}") {
        bar.set_style(style);
    }
    bar.set_message(what.to_owned());
    bar
}

/// True if bars are shown.
pub(crate) fn visible() -> bool {
    std::io::stderr().is_terminal()
}

fn target() -> ProgressDrawTarget {
    if visible() { ProgressDrawTarget::stderr_with_hz(5) } else { ProgressDrawTarget::hidden() }
}

/// Work of unknown length; its line is there while this lives.
pub(crate) struct Phase(ProgressBar);

/// Shows what is being done, and for how long already; hidden where the error stream is no terminal.
pub(crate) fn phase(what: &str) -> Phase {
    let spinner = ProgressBar::with_draw_target(None, target());
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        spinner.set_style(style);
    }
    spinner.set_message(what.to_owned());
    spinner.enable_steady_tick(INTERVAL);
    Phase(spinner)
}

impl Drop for Phase {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
