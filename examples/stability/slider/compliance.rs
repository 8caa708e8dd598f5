//! How far a force moves a body.

use std::collections::BTreeMap;
use std::sync::Mutex;

use nalgebra::DMatrix;
use stickslip::BlockMatrix;

use super::Refusal;
use super::body::Body;

impl Body {
    /// [`compliance`] of the norm of this body, which many cases share.
    pub(crate) fn compliance(
        &self,
        norm: &BlockMatrix<2>,
        fixed: &[[bool; 2]],
    ) -> Result<f64, Refusal> {
        static KNOWN: Mutex<BTreeMap<String, f64>> = Mutex::new(BTreeMap::new());
        let key = format!(
            "{:?} {:?} {} {:?} {:?}",
            self.size, self.cells, self.refinements, self.elastic, self.density
        );
        let known = || KNOWN.lock().map_err(|_| "a case panicked");
        if let Some(&value) = known()?.get(&key) {
            return Ok(value);
        }
        let value = compliance(norm, fixed)?;
        known()?.insert(key, value);
        Ok(value)
    }
}

/// The largest diagonal entry of the inverse on the free components.
///
/// With the matrix scaled to a unit diagonal first, which keeps it as well conditioned as it can be.
fn compliance(matrix: &BlockMatrix<2>, fixed: &[[bool; 2]]) -> Result<f64, Refusal> {
    let free: Vec<(usize, usize)> = (0..fixed.len())
        .flat_map(|i| (0..2).map(move |c| (i, c)))
        .filter(|&(i, c)| !fixed[i][c])
        .collect();
    let mut place = vec![[usize::MAX; 2]; fixed.len()];
    for (n, &(i, c)) in free.iter().enumerate() {
        place[i][c] = n;
    }
    let mut dense = DMatrix::<f64>::zeros(free.len(), free.len());
    for (block, (i, j)) in matrix {
        for (r, c) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (row, column) = (place[i as usize][r], place[j as usize][c]);
            if row != usize::MAX && column != usize::MAX {
                dense[(row, column)] = block[(r, c)];
            }
        }
    }
    let scale: Vec<f64> = dense.diagonal().iter().map(|d| d.sqrt().recip()).collect();
    for (i, row) in scale.iter().enumerate() {
        for (j, column) in scale.iter().enumerate() {
            dense[(i, j)] *= row * column;
        }
    }
    let factor = dense
        .cholesky()
        .ok_or("the norm is not positive definite in rounding")?;
    let inverse = factor
        .l()
        .solve_lower_triangular(&DMatrix::identity(free.len(), free.len()));
    let inverse = inverse.ok_or("the norm is singular")?;
    let entries = inverse.column_iter().zip(&scale);
    Ok(entries
        .map(|(column, s)| column.norm_squared() * s * s)
        .fold(0.0, f64::max))
}
