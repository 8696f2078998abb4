//! Ctrl-C: ends at once, and leaves no partial file.

use luch::Error;
use luch::output::Destination;
use luch::study::Watch;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// The exit code after an interrupt, 128 and the number of SIGINT.
pub(super) const INTERRUPTED: i32 = 130;

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
        // Without a handler Ctrl-C still ends the program; only the temporary file would stay.
        let _ = ctrlc::set_handler(move || {
            let files = on_signal.temporary.lock();
            for file in files.unwrap_or_else(PoisonError::into_inner).iter() {
                let _ = std::fs::remove_file(file);
            }
            std::process::exit(INTERRUPTED);
        });
        interrupt
    }

    /// From now on an interrupt asks a study to stop, and a second one ends the program.
    pub(super) fn watch_once(study: Arc<Watch>) {
        let _ = ctrlc::set_handler(move || {
            if study.is_cancelled() {
                std::process::exit(INTERRUPTED);
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
        let destination = Destination::claim(path)?;
        temporary.push(destination.temporary_path().to_owned());
        Ok(destination)
    }
}
