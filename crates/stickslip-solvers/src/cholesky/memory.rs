//! Memory limits, checked before allocation.

use crate::SolveError;

/// The memory limit of a factor and of the data beside it \[byte\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Memory {
    /// The limit for both together.
    pub(crate) allowed: usize,
    /// The memory that the owner of the factor needs beside it.
    pub(crate) beside: usize,
}

impl Memory {
    /// Refuses a factor of so many bytes if it exceeds the limit.
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
