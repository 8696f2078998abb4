//! Progress on standard error: a bar on a terminal, plain lines on a pipe.

use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, Write, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How often progress is looked at.
const INTERVAL: Duration = Duration::from_millis(80);

/// How far some work is.
pub(super) struct State {
    /// What is under way.
    pub(super) doing: String,
    /// 0..1.
    pub(super) share: f64,
    /// What the work itself expects; reckoned from the share where it is `None`.
    pub(super) left: Option<Duration>,
}

/// Does `work` while its progress is shown, unless `quiet`.
pub(super) fn shown<T>(
    quiet: bool,
    state: &(dyn Fn() -> State + Sync),
    work: impl FnOnce() -> T,
) -> T {
    if quiet {
        return work();
    }
    thread::scope(|scope| {
        let (finished, wait) = channel::<()>();
        let watcher = scope.spawn(move || {
            if stderr().is_terminal() {
                bar(state, &wait)
            } else {
                lines(state, &wait)
            }
        });
        let result = work();
        // The watcher ends when the sender is gone.
        drop(finished);
        let _ = watcher.join();
        result
    })
}

fn bar(state: &dyn Fn() -> State, wait: &Receiver<()>) {
    let bar = ProgressBar::new(1000);
    let style = |template| ProgressStyle::with_template(template).map(|s| s.progress_chars("=> "));
    let template = match state().left {
        None => "{msg} [{bar:40}] {percent:>3}%  {eta} left",
        Some(_) => "[{bar:30}] {percent:>3}%  {prefix} left  {msg}",
    };
    if let Ok(style) = style(template) {
        bar.set_style(style);
    }
    while wait.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
        let State { doing, share, left } = state();
        bar.set_position((share * 1000.0) as u64);
        bar.set_message(doing);
        if let Some(left) = left {
            bar.set_prefix(format!("{:>3} s", left.as_secs()));
        }
    }
    bar.finish_and_clear();
}

fn lines(state: &dyn Fn() -> State, wait: &Receiver<()>) {
    let mut said = None;
    let mut say = || {
        let percent = (state().share * 100.0) as u32;
        if said != Some(percent) {
            // A pipe that nobody reads any more is no reason to stop.
            let _ = writeln!(stderr(), "Progress: {percent}%").and_then(|()| stderr().flush());
            said = Some(percent);
        }
    };
    while wait.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
        say();
    }
    say();
}
