//! Loss of orthogonality of Lanczos vectors.

use faer::Mat;

/// The largest component of a vector along others that it should be orthogonal to: eigenvalues keep full accuracy.
const LOSS: f64 = 1e-8;
/// The component right after an orthogonalisation: a rounding of each subtracted part.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A bound of the component of the last two blocks along older ones, by the recurrence of H. D. Simon, The Lanczos
/// algorithm with partial reorthogonalization, Math. Comp. 42 (1984).
///
/// With `A Q_j = Q_{j+1} B_j + Q_j A_j + Q_{j-1} B_{j-1}^T`, the loss propagates by
///
/// ```text
/// w_{j+1} <= (|A| w_j + |B_{j-1}| w_{j-1}) / min B_j
/// ```
pub(super) struct Loss {
    /// `|A|`, estimated from its images so far.
    norm: f64,
    /// `|B|` of the last block.
    linked: f64,
    /// `w` of the block before the last, and of the last.
    of: [f64; 2],
}

impl Loss {
    /// The loss before the first block; `norm` is at least the eigenvalues of vectors that all blocks are to be
    /// orthogonal to.
    pub(super) fn new(norm: f64) -> Self {
        Self {
            norm,
            linked: 0.0,
            of: [ROUNDING; 2],
        }
    }

    /// Adds a block: `images` are the lengths of the operator's images of the last block, and `beside` is their new
    /// part. Returns whether the loss is too large.
    pub(super) fn carry(&mut self, images: &[f64], beside: &Mat<f64>) -> bool {
        self.norm = images.iter().copied().fold(self.norm, f64::max);
        let [before, last] = self.of;
        let next = (self.norm * last + self.linked * before) / least(beside);
        self.linked = beside.norm_max();
        self.of = [last, next];
        next > LOSS
    }

    /// Resets the loss: the last block was made orthogonal to all others.
    pub(super) fn mend(&mut self) {
        self.of[1] = ROUNDING;
    }
}

/// The smallest new part of the next vectors along a direction; zero if a vector was dependent.
fn least(beside: &Mat<f64>) -> f64 {
    let count = beside.nrows();
    if count < beside.ncols() {
        return 0.0;
    }
    (0..count).fold(f64::INFINITY, |least, i| least.min(beside[(i, i)]))
}
