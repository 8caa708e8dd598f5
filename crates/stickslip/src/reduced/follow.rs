//! The interior of a body that follows driven parts.

use nalgebra::SVector;
use stickslip_solvers::{BlockMatrix, Matrix, StaticResponses};

use super::support::Support;
use crate::SceneError;

/// A unit displacement of a driven part, with the interior in equilibrium.
pub(super) fn follow<const C: usize>(
    responses: &mut StaticResponses<C>,
    stiffness: &BlockMatrix<C>,
    unit: &[(usize, SVector<f64, C>)],
) -> Result<Vec<SVector<f64, C>>, SceneError> {
    let size = stiffness.rows();
    let (mut shape, mut forces) = (vec![SVector::zeros(); size], vec![SVector::zeros(); size]);
    for (vertex, value) in unit {
        shape[*vertex] = *value;
    }
    stiffness.multiply_add(-1.0, &shape, &mut forces);
    let at_rest = vec![0.0; responses.owners().len()];
    responses.extend(stiffness, Some(&forces), &at_rest, &mut shape)?;
    Ok(shape)
}

/// Whether an operator acts on the condensed components.
pub(super) fn reaches_inside<const C: usize>(
    operator: &BlockMatrix<C>,
    support: &Support<C>,
    eliminated: &[[bool; C]],
) -> bool {
    let inside =
        |vertex: usize, c: usize| support.place(vertex).is_none() && !eliminated[vertex][c];
    operator.iter().any(|(block, (i, j))| {
        let (i, j) = (i as usize, j as usize);
        let mut entries = (0..C).flat_map(|r| (0..C).map(move |c| (r, c)));
        entries.any(|(r, c)| block[(r, c)] != 0.0 && (inside(i, r) || inside(j, c)))
    })
}
