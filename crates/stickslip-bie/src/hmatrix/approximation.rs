//! How far a hierarchical matrix may differ from its entries, and how much memory it may take.

use crate::KernelError;

/// The tolerance, the precision and the memory of an [`HMatrix`](crate::HMatrix).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approximation {
    /// 0 without far blocks.
    pub(super) tolerance: f64,
    pub(super) single_precision: bool,
    pub(super) memory_limit: u64,
}

impl Default for Approximation {
    /// A tolerance of 1e-4, double precision, 8 GiB.
    fn default() -> Self {
        Self {
            tolerance: 1e-4,
            single_precision: false,
            memory_limit: 8 << 30,
        }
    }
}

impl Approximation {
    /// Sets the relative error of each far block in the Frobenius norm, positive and at most 0.1; 1e-4 by default.
    ///
    /// The error of products is some 100 times smaller, since near blocks are exact and dominate.
    ///
    /// # Errors
    /// [`KernelError`] for a tolerance out of its range.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, KernelError> {
        if tolerance > 0.0 && tolerance <= 0.1 {
            return Ok(Self { tolerance, ..self });
        }
        let what = "tolerance of an H-matrix";
        Err(KernelError::new(what, "positive, and at most", tolerance).bound(0.1))
    }

    /// Keeps all blocks as they are: near blocks alone, with the memory of the dense matrix.
    pub fn without_far_blocks(self) -> Self {
        Self {
            tolerance: 0.0,
            ..self
        }
    }

    /// Keeps far blocks in single precision: half of their memory, with a relative error of 6e-8; near blocks stay in
    /// double precision.
    pub fn in_single_precision(self) -> Self {
        Self {
            single_precision: true,
            ..self
        }
    }

    /// Sets the largest memory of the matrix \[bytes\]; 8 GiB by default. It is compared with an estimate before memory is taken.
    pub fn with_memory_limit(self, memory_limit: u64) -> Self {
        Self {
            memory_limit,
            ..self
        }
    }

    /// The tolerance; 0 without far blocks.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    pub(super) fn has_far_blocks(&self) -> bool {
        self.tolerance > 0.0
    }

    /// The bytes of a number of a far block.
    pub(super) fn bytes_of_number(&self) -> u64 {
        if self.single_precision { 4 } else { 8 }
    }
}
