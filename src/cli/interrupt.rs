//! Ctrl-C: ends at once, and leaves no partial file.

use std::path::Path;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The exit code after an interrupt, 128 and the number of SIGINT.
const INTERRUPTED: i32 = 130;

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
            let files = on_signal
                .temporary
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            for file in files.iter() {
                let _ = std::fs::remove_file(file);
            }
            std::process::exit(INTERRUPTED);
        });
        interrupt
    }

    /// Removes `file` when the program is interrupted.
    pub(super) fn remove_on_interrupt(&self, file: &Path) {
        self.temporary
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(file.to_owned());
    }
}
