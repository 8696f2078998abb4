//! Ctrl-C, and what ends programs from outside: the program ends at once, and leaves no partial file.

use luch::Error;
use luch::output::Destination;
use luch::study::Watch;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicI32, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};

/// The number of SIGINT, on every system.
const SIGINT: i32 = 2;
/// The signal that came last.
static SIGNAL: AtomicI32 = AtomicI32::new(SIGINT);

/// The exit code after the signal that came last: 128 and its number, so 130 after SIGINT and 143 after SIGTERM.
pub(super) fn exit_code() -> u8 {
    128 + SIGNAL.load(Relaxed).clamp(0, 127) as u8
}

/// From now on calls `ended` at each signal that asks the program to end, on a thread of its own.
///
/// Where the system refuses, signals still end the program; only temporary files would stay.
fn at_each_signal(ended: impl FnMut() + Send + 'static) {
    #[cfg(unix)]
    {
        use signal_hook::consts::{SIGHUP, SIGTERM};
        let mut ended = ended;
        if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM, SIGHUP]) {
            std::thread::spawn(move || {
                for signal in signals.forever() {
                    SIGNAL.store(signal, Relaxed);
                    ended();
                }
            });
        }
    }
    #[cfg(not(unix))]
    {
        let _ = ctrlc::set_handler(ended);
    }
}

/// Files to remove when the program is interrupted.
#[derive(Clone, Default)]
pub(super) struct Interrupt {
    temporary: Arc<Mutex<Vec<PathBuf>>>,
}

impl Interrupt {
    /// From now on an interrupt ends the program, whatever it is doing.
    pub(super) fn watch() -> Interrupt {
        let interrupt = Interrupt::default();
        let on_signal = interrupt.clone();
        at_each_signal(move || {
            let files = on_signal.temporary.lock();
            for file in files.unwrap_or_else(PoisonError::into_inner).iter() {
                let _ = std::fs::remove_file(file);
            }
            std::process::exit(exit_code().into());
        });
        interrupt
    }

    /// From now on an interrupt asks a study to stop, and a second one ends the program.
    pub(super) fn watch_once(study: Arc<Watch>) {
        at_each_signal(move || {
            if study.is_cancelled() {
                std::process::exit(exit_code().into());
            }
            study.cancel();
        });
    }

    /// Claims a destination, whose temporary file an interrupt then removes.
    pub(super) fn claim(&self, path: &Path) -> Result<Destination, Error> {
        // Locked until the file is on the list, so that an interrupt never comes between.
        let mut temporary = self
            .temporary
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        // A sequence claims again and again: those that took their places need no removal.
        temporary.retain(|file| file.exists());
        let destination = Destination::claim(path)?;
        temporary.push(destination.temporary_path().to_owned());
        Ok(destination)
    }
}
