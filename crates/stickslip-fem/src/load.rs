use nalgebra::SVector;

use crate::fingerprint::{PART, same_mesh};
use crate::quadrature::rule;
use crate::simplex::combine;
use crate::{FemError, P1, Trace};

/// The load of a force density f [N/m^D]: l_p = integral of f phi_p over the body \[N\], one vector per vertex.
///
/// The quadrature is exact for cubic f and keeps the second order of the displacement in L2.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{P1, body_force};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let weight = body_force(&space, |_| Vector2::new(0.0, -9.81 * 5e3));
/// let total: Vector2<f64> = weight.iter().sum();
/// assert!((total[1] + 9.81 * 5e3 * 5.0).abs() < 1e-9);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
pub fn body_force<const D: usize, const C: usize>(
    space: &P1<D>,
    f: impl Fn(&SVector<f64, D>) -> SVector<f64, C>,
) -> Vec<SVector<f64, C>> {
    integrate(space, &f)
}

/// The same, compiled once for all densities.
fn integrate<const D: usize, const C: usize>(
    space: &P1<D>,
    f: &dyn Fn(&SVector<f64, D>) -> SVector<f64, C>,
) -> Vec<SVector<f64, C>> {
    let mesh = space.mesh();
    let mut load = vec![SVector::zeros(); mesh.vertex_count()];
    for corners in mesh.cells() {
        let cell = mesh.simplex(corners);
        for node in rule(D) {
            let force = f(&cell.at(&node.at)) * (node.weight * cell.volume);
            for (&p, &hat) in corners.iter().zip(&node.at) {
                load[p as usize] += force * hat;
            }
        }
    }
    load
}

/// The load of a surface traction t [Pa, in 2D N/m]: l_p = integral of t phi_p over the trace \[N\], one
/// vector for each vertex of the mesh, zero away from the trace.
///
/// # Errors
///
/// [`FemError::Mesh`] for a trace of another mesh than that of the space.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{P1, traction};
///
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let top = space.trace(|x| x[1] == 1.0)?;
/// let push = traction(&space, &top, |x| Vector2::new(x[0], 0.0))?;
/// let total: Vector2<f64> = push.iter().sum();
/// assert!((total[0] - 12.5).abs() < 1e-13);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[doc(alias = "Neumann")]
pub fn traction<const D: usize, const C: usize>(
    space: &P1<D>,
    trace: &Trace<D>,
    t: impl Fn(&SVector<f64, D>) -> SVector<f64, C>,
) -> Result<Vec<SVector<f64, C>>, FemError> {
    same_mesh(PART, space.mesh().identity(), trace.mesh())?;
    let mut load = vec![SVector::zeros(); space.vertex_count()];
    for (face, area) in trace.faces().iter().zip(trace.areas()) {
        let corners = face.map(|k| trace.points()[k]);
        for node in rule(D - 1) {
            let force = t(&combine(&corners, &node.at)) * (node.weight * area);
            for (&k, &hat) in face.iter().zip(&node.at) {
                load[trace.vertices()[k]] += force * hat;
            }
        }
    }
    Ok(load)
}
