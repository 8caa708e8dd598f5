//! Auxiliary levels below a mesh without coarser ones: some of its vertices, some of these, and so on.
//!
//! Every level is an independent set of the vertices of the level before, corners and edges of the boundary first. The
//! others interpolate linearly between kept vertices around them. There are no coarse cells; coarse vertices are
//! coupled by the Galerkin product. The weights reproduce linear functions and, equal for all components, the
//! rigid-body motions of elasticity, too. A vertex that would have to extrapolate far is kept: the levels follow any
//! grading, curved boundaries and slits. Of vertices that coincide on the sides of a fault all are kept or none.
//!
//! Source of the choice of vertices: M. Adams, "Evaluation of three unstructured multigrid methods on 3D finite element
//! problems in solid mechanics", Int. J. Numer. Meth. Engng. 55 (2002).

mod choice;
mod features;
mod graph;
mod twins;
mod weights;

use crate::edges::Edges;
use crate::{FemError, Mesh, Prolongation};
use choice::Choice;
use features::features;
use graph::Graph;
use twins::Twins;

/// The size of a level that is coarse enough: a factor of its matrix costs less than further levels.
const COARSEST: usize = 100;
/// The largest share of the vertices in a coarser level that is worth it.
const COARSER: f64 = 0.7;

/// The transfers up to a mesh, coarsest first; none if the mesh is as small as a coarsest one.
pub(crate) fn auxiliary_levels<const D: usize>(
    mesh: &Mesh<D>,
) -> Result<Vec<Prolongation>, FemError> {
    let mut transfers = Vec::new();
    let mut points = mesh.vertices().to_vec();
    let mut features = features(mesh);
    let mut graph = Graph::of(points.len(), Edges::of(mesh).iter());
    let mut twins = Twins::of(mesh);
    while points.len() > COARSEST {
        let choice = Choice::among(&points, &features, &graph, &twins);
        let coarse = choice.chosen.len();
        if coarse as f64 > COARSER * points.len() as f64 {
            break;
        }
        transfers.push(prolongation(&choice)?);
        points = pick(&points, &choice.chosen);
        features = pick(&features, &choice.chosen);
        twins = twins.among(&choice.chosen);
        graph = choice.graph;
    }
    transfers.reverse();
    Ok(transfers)
}

fn pick<T: Copy>(all: &[T], chosen: &[u32]) -> Vec<T> {
    chosen.iter().map(|&p| all[p as usize]).collect()
}

fn prolongation(choice: &Choice) -> Result<Prolongation, FemError> {
    let entries = choice.columns.len();
    if u32::try_from(entries).is_err() {
        return Err(FemError::too_many("blocks of a matrix", entries as u64));
    }
    let starts: Vec<u32> = choice.starts.iter().map(|&start| start as u32).collect();
    Ok(Prolongation::new(
        (starts.len() - 1, choice.chosen.len()),
        starts,
        choice.columns.clone(),
        choice.weights.clone(),
    ))
}
