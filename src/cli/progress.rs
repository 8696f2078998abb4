//! Progress on standard error: a bar on a terminal, plain lines on a pipe.

use indicatif::{ProgressBar, ProgressStyle};
use luch::render::Progress;
use std::io::{IsTerminal, Write, stderr};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How often progress is looked at.
const INTERVAL: Duration = Duration::from_millis(80);

/// Does `work` while its progress is shown, unless `quiet`.
pub(super) fn shown<T>(quiet: bool, progress: &Progress, work: impl FnOnce() -> T) -> T {
    if quiet {
        return work();
    }
    thread::scope(|scope| {
        let (finished, wait) = channel::<()>();
        let watcher = scope.spawn(move || {
            if stderr().is_terminal() {
                bar(progress, &wait)
            } else {
                lines(progress, &wait)
            }
        });
        let result = work();
        // The watcher ends when the sender is gone.
        drop(finished);
        let _ = watcher.join();
        result
    })
}

fn bar(progress: &Progress, wait: &Receiver<()>) {
    let bar = ProgressBar::new(1000);
    if let Ok(style) =
        ProgressStyle::with_template("rendering [{bar:40}] {percent:>3}%  {eta} left")
    {
        bar.set_style(style.progress_chars("=> "));
    }
    while wait.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
        bar.set_position((progress.share() * 1000.0) as u64);
    }
    bar.finish_and_clear();
}

fn lines(progress: &Progress, wait: &Receiver<()>) {
    let mut said = None;
    let mut say = || {
        let percent = (progress.share() * 100.0) as u32;
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
