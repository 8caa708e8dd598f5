//! The viscous resistance of each vertex.

use nalgebra::SMatrix;
use stickslip_solvers::{Matrix, decouple};

use crate::SceneError;
use crate::body::{Matrices, first_coupled};
use crate::contact::ContactSet;
use crate::placement::Constraints;

/// A vertex without friction, and the inverse of its block on the free components.
pub(super) type Smooth<const C: usize> = (usize, SMatrix<f64, C, C>);

/// The blocks of the viscosity at frictional vertices, and those at vertices without friction.
pub(super) fn of_vertices<const C: usize>(
    matrices: &dyn Matrices<C>,
    constraints: &Constraints<C>,
    contacts: &ContactSet<C>,
) -> Result<(Vec<SMatrix<f64, C, C>>, Vec<Smooth<C>>), SceneError> {
    let viscosity = matrices.viscosity();
    if let Some(viscosity) = viscosity {
        check_uncoupled(viscosity)?;
    }
    let block = |vertex: usize| {
        let block = viscosity.map_or(SMatrix::zeros(), |own| own.diagonal_block(vertex));
        decouple(&block, &constraints.fixed[vertex])
    };
    let damping = contacts.vertices.iter().map(|&vertex| block(vertex));
    let damping: Vec<_> = damping.collect();
    let (mut smooth, mut frictional) =
        (Vec::new(), contacts.vertices.iter().enumerate().peekable());
    for vertex in 0..matrices.stiffness().vertex_count() {
        let fixed = &constraints.fixed[vertex];
        let site = frictional.next_if(|(_, at)| **at == vertex);
        let mut resisted = *fixed;
        // Friction of one size whatever the rate is no resistance to it.
        if let Some((k, _)) = site.filter(|&(k, _)| contacts.reads_rate(k)) {
            contacts.mark_slip(k, &mut resisted);
        }
        // On the components that friction does not resist.
        let free = decouple(&block(vertex), &resisted).cholesky();
        let mut inverse = free
            .ok_or(SceneError::Vertex {
                what: "viscosity",
                vertex,
                requirement: UNDAMPED,
            })?
            .inverse();
        if site.is_none() {
            for c in (0..C).filter(|&c| fixed[c]) {
                inverse[(c, c)] = 0.0;
            }
            smooth.push((vertex, inverse));
        }
    }
    Ok((damping, smooth))
}

const UNDAMPED: &str = "positive where friction resists no motion or has no slope in the slip rate, in explicit integration";
const COUPLED: &str = "block diagonal, in explicit integration";

/// Refuses a viscosity whose products differ from those of its diagonal blocks.
fn check_uncoupled<const C: usize>(viscosity: &dyn Matrix<C>) -> Result<(), SceneError> {
    match first_coupled(viscosity) {
        None => Ok(()),
        Some(vertex) => Err(SceneError::Vertex {
            what: "viscosity",
            vertex,
            requirement: COUPLED,
        }),
    }
}
