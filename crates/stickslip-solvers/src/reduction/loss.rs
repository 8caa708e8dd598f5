//! How far vectors of Lanczos' method are from orthogonal.

use faer::Mat;

/// What of a vector may be along others that it ought to be orthogonal to: eigenvalues are as exact as if nothing were.
const LOSS: f64 = 1e-8;
/// That of vectors that have just been made orthogonal: a rounding of each of the parts that are taken off.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A bound for what of the last two blocks is along older ones, by the recurrence of H. D. Simon, The Lanczos algorithm
/// with partial reorthogonalization, Math. Comp. 42 (1984).
///
/// With `A Q_j = Q_{j+1} B_j + Q_j A_j + Q_{j-1} B_{j-1}^T`, what is lost is carried along by
///
/// ```text
/// w_{j+1} <= (|A| w_j + |B_{j-1}| w_{j-1}) / min B_j
/// ```
pub(super) struct Loss {
    /// `|A|`, by what it has done so far.
    norm: f64,
    /// `|B|` of the last block.
    linked: f64,
    /// `w` of the block before the last, and of the last.
    of: [f64; 2],
}

impl Loss {
    /// Before the first block; no smaller `norm` than the eigenvalues of vectors that all blocks are to be orthogonal to.
    pub(super) fn new(norm: f64) -> Self {
        Self {
            norm,
            linked: 0.0,
            of: [ROUNDING; 2],
        }
    }

    /// Goes on by a block: what the operator made of the last one was as long as `images`, and `beside` of it is new.
    /// Returns whether too much is lost.
    pub(super) fn carry(&mut self, images: &[f64], beside: &Mat<f64>) -> bool {
        self.norm = images.iter().copied().fold(self.norm, f64::max);
        let [before, last] = self.of;
        let next = (self.norm * last + self.linked * before) / least(beside);
        self.linked = beside.norm_max();
        self.of = [last, next];
        next > LOSS
    }

    /// The last block was made orthogonal to all others.
    pub(super) fn mend(&mut self) {
        self.of[1] = ROUNDING;
    }
}

/// The least that is new in a direction of the next vectors; zero where nothing was left of one.
fn least(beside: &Mat<f64>) -> f64 {
    let count = beside.nrows();
    if count < beside.ncols() {
        return 0.0;
    }
    (0..count).fold(f64::INFINITY, |least, i| least.min(beside[(i, i)]))
}
