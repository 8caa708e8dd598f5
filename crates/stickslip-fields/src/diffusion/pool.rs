//! Scratch of steps, kept from one to the next.

use std::sync::{Mutex, PoisonError};

use super::work::Work;

/// Scratch that calls take and give back: none is allocated once each thread had its own. A result never depends on
/// which one a call took.
#[derive(Debug, Default)]
pub(super) struct Pool(Mutex<Vec<Work>>);

impl Pool {
    /// One that was given back, or a new one.
    pub(super) fn take(&self, new: impl FnOnce() -> Work) -> Work {
        let kept = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        kept.unwrap_or_else(new)
    }

    pub(super) fn give_back(&self, work: Work) {
        self.0
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .push(work);
    }

    pub(super) fn clear(&mut self) {
        self.0
            .get_mut()
            .unwrap_or_else(PoisonError::into_inner)
            .clear();
    }
}

impl Clone for Pool {
    fn clone(&self) -> Self {
        Self::default()
    }
}
