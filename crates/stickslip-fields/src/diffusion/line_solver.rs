//! The tridiagonal solver of lines.

/// The factors of `(diag(a) + q L) x = b` on a line, `L` the Laplacian with the conductances of the faces.
///
/// Elimination keeps `a` and the conductances apart, as resistors in series and in parallel do: no difference of large
/// numbers occurs, whatever `q` is.
#[derive(Debug, Clone, Default)]
pub(super) struct LineSolver {
    /// `1/D_i`, `D_i = s_i + q c_i`, with `s_i = a_i + q c_(i-1) s_(i-1)/D_(i-1)`.
    inverse: Vec<f64>,
    /// `q c_i/D_i`; 0 in the last cell.
    ratio: Vec<f64>,
}

impl LineSolver {
    pub(super) fn new(count: usize) -> Self {
        Self {
            inverse: vec![0.0; count],
            ratio: vec![0.0; count],
        }
    }

    /// Computes the factors.
    pub(super) fn factor(&mut self, diagonal: &[f64], faces: &[f64], q: f64) {
        let last = diagonal.len() - 1;
        let mut carried = 0.0;
        for i in 0..last {
            let (alone, face) = (diagonal[i] + carried, q * faces[i]);
            let inverse = 1.0 / (alone + face);
            let ratio = face * inverse;
            self.inverse[i] = inverse;
            self.ratio[i] = ratio;
            carried = ratio * alone;
        }
        self.inverse[last] = 1.0 / (diagonal[last] + carried);
        self.ratio[last] = 0.0;
    }

    /// Replaces `b` by the solution.
    pub(super) fn solve(&self, b: &mut [f64]) {
        let mut before = 0.0;
        for (b, ratio) in b.iter_mut().zip(&self.ratio) {
            let eliminated = *b + before;
            *b = eliminated;
            before = ratio * eliminated;
        }
        let mut after = 0.0;
        let factors = self.inverse.iter().zip(&self.ratio);
        for (b, (inverse, ratio)) in b.iter_mut().zip(factors).rev() {
            after = *b * inverse + ratio * after;
            *b = after;
        }
    }
}
