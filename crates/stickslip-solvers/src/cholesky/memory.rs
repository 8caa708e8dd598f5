//! Memory is counted before it is taken.

use crate::SolveError;

/// The memory of a factor, and of what is kept beside it \[byte\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Memory {
    /// What both together may take.
    pub(crate) allowed: usize,
    /// What the owner of the factor keeps beside it.
    pub(crate) beside: usize,
}

impl Memory {
    /// Refuses a factor of so many bytes if they are not to be had.
    pub(crate) fn admit(&self, unknowns: usize, bytes: usize) -> Result<(), SolveError> {
        let needed = bytes.saturating_add(self.beside);
        if needed > self.allowed {
            return Err(SolveError::MemoryLimit {
                unknowns,
                needed,
                allowed: self.allowed,
            });
        }
        Ok(())
    }
}
