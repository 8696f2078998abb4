//! Progress: a bar on a terminal, plain lines on a pipe, or what Open Job Description reads.

use super::arguments::{ProgressValue, RenderArguments};
use super::print;
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

/// To whom progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Listener {
    Nobody,
    /// Standard error.
    Person,
    /// Standard output.
    Openjd,
}

impl Listener {
    /// Whom the arguments name.
    pub(super) fn of(arguments: &RenderArguments) -> Listener {
        match (arguments.progress, arguments.quiet) {
            (ProgressValue::Openjd, _) => Listener::Openjd,
            (ProgressValue::Auto, true) => Listener::Nobody,
            (ProgressValue::Auto, false) => Listener::Person,
        }
    }
}

/// Tells Open Job Description something, on a line of its own: `progress`, `status` or `fail`.
pub(super) fn to_openjd(kind: &str, what: &str) {
    let line = format!("openjd_{kind}: {}\n", print::one_line(what));
    // A pipe that nobody reads any more is no reason to stop.
    let _ = print::to_stdout(line.as_bytes());
}

/// Does `work` while its progress is shown.
pub(super) fn shown<T>(
    listener: Listener,
    state: &(dyn Fn() -> State + Sync),
    work: impl FnOnce() -> T,
) -> T {
    if listener == Listener::Nobody {
        return work();
    }
    thread::scope(|scope| {
        let (finished, wait) = channel::<()>();
        let watcher = scope.spawn(move || {
            if listener == Listener::Openjd {
                openjd(state, &wait)
            } else if stderr().is_terminal() {
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

fn openjd(state: &dyn Fn() -> State, wait: &Receiver<()>) {
    let mut said = (None, String::new());
    let mut say = || {
        let State { doing, share, .. } = state();
        let percent = (share * 100.0).floor();
        if said.1 != doing {
            to_openjd("status", &doing);
            said.1 = doing;
        }
        if said.0 != Some(percent) {
            to_openjd("progress", &format!("{percent:.1}"));
            said.0 = Some(percent);
        }
    };
    while wait.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
        say();
    }
    say();
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
