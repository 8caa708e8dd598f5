use nalgebra::{SMatrix, SVector};

use crate::{Elastic, FemError, P1};

/// The Cauchy stress of each cell \[Pa\], in the order of [`Mesh::cells`](crate::Mesh::cells), for a displacement of
/// one vector per vertex \[m\].
///
/// ```text
/// sigma = lambda tr(eps) I + 2 mu eps,   eps = (grad u + grad u^T)/2
/// ```
///
/// It is constant on a cell. In the plane it is the in-plane part; the normal stress of plane strain out of the plane
/// is `nu (sigma_xx + sigma_yy)`. Viscous stress is not included.
///
/// # Errors
///
/// The errors of [`Elastic::lame`], and [`FemError::Length`] for a displacement of another mesh.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{Elastic, P1, stress};
///
/// let space = P1::grid([2.0, 1.0], [2, 1])?;
/// let sheared = space.interpolate(|x| Vector2::new(1e-3 * x[1], 0.0));
/// let elastic = Elastic { young_modulus: 2.5, poisson_ratio: 0.25 }; // mu = 1
/// for sigma in stress(&space, &elastic, &sheared)? {
///     assert!((sigma[(0, 1)] - 1e-3).abs() < 1e-15 && sigma[(0, 1)] == sigma[(1, 0)]);
///     assert!(sigma[(0, 0)].abs() + sigma[(1, 1)].abs() < 1e-15);
/// }
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn stress<const D: usize>(
    space: &P1<D>,
    material: &Elastic,
    displacement: &[SVector<f64, D>],
) -> Result<Vec<SMatrix<f64, D, D>>, FemError> {
    material.lame()?;
    stress_by_cell(space, |_, _| *material, displacement)
}

/// [`stress`] with a material that depends on the cell: by a function of its midpoint \[m\] and index.
///
/// # Errors
///
/// [`FemError::Value`] for the first cell whose material is out of range, and [`FemError::Length`].
pub fn stress_by_cell<const D: usize>(
    space: &P1<D>,
    material: impl Fn(&SVector<f64, D>, usize) -> Elastic,
    displacement: &[SVector<f64, D>],
) -> Result<Vec<SMatrix<f64, D, D>>, FemError> {
    let mesh = space.mesh();
    if displacement.len() != mesh.vertex_count() {
        return Err(FemError::Length {
            what: "vectors of a field on the mesh",
            expected: mesh.vertex_count(),
            found: displacement.len(),
        });
    }
    let of_cell = |(index, corners): (usize, &[u32])| {
        let cell = mesh.simplex(corners);
        let lame = material(&cell.midpoint(), index).lame();
        let (lambda, mu) = lame.map_err(|error| error.in_cell(index))?;
        let mut gradient = SMatrix::<f64, D, D>::zeros();
        for (&p, hat) in corners.iter().zip(&cell.gradients) {
            gradient += displacement[p as usize] * hat.transpose();
        }
        let dilation = SMatrix::identity() * (lambda * gradient.trace());
        Ok(dilation + (gradient + gradient.transpose()) * mu)
    };
    mesh.cells().enumerate().map(of_cell).collect()
}
