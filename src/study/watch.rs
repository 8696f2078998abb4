//! How far a study is, and whether it should go on: shared with whoever watches.

use crate::render::Progress;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// How far a study is, and whether it should go on.
#[derive(Debug, Default)]
pub struct Watch {
    /// Of whatever picture is under way.
    pub(super) picture: Progress,
    /// Thousandths.
    share: AtomicU64,
    /// Milliseconds.
    left: AtomicU64,
    doing: Mutex<String>,
}

impl Watch {
    /// Asks the study to stop: after the tiles under way, or the tree.
    pub fn cancel(&self) {
        self.picture.cancel();
    }

    /// Whether somebody asked the study to stop.
    pub fn is_cancelled(&self) -> bool {
        self.picture.is_cancelled()
    }

    /// The share that is done, 0..1, by the plan's own estimate.
    pub fn share(&self) -> f64 {
        self.share.load(Relaxed) as f64 / 1000.0
    }

    /// The time that is left, by the same estimate.
    pub fn left(&self) -> Duration {
        Duration::from_millis(self.left.load(Relaxed))
    }

    /// What is under way.
    pub fn doing(&self) -> String {
        let doing = self.doing.lock();
        doing.unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(super) fn tell(&self, doing: &str, share: f64, left: Duration) {
        self.share
            .store((share.clamp(0.0, 1.0) * 1000.0) as u64, Relaxed);
        self.left.store(left.as_millis() as u64, Relaxed);
        let mut now = self.doing.lock().unwrap_or_else(PoisonError::into_inner);
        doing.clone_into(&mut now);
    }
}
