//! The order of elimination: fill-reducing for the interior, the frictional vertices last.

#[cfg(feature = "dissection")]
mod dissection;
#[cfg(any(feature = "dissection", test))]
mod fill;
mod minimum_degree;
#[cfg(test)]
mod tests;

use crate::SolveError;
use crate::block_matrix::Graph;

#[cfg(feature = "dissection")]
use dissection::improved;
use minimum_degree::minimum_degree;

/// The elimination order of all vertices with `components` unknowns each.
///
/// The graph is that of vertices, not of components: the components of one vertex have the same neighbours and end up
/// in one supernode. The order is that of minimum degree. The feature `dissection` tries nested dissection where it may
/// be worth its time, and takes it if its factor is smaller.
pub(crate) fn elimination_order(
    graph: &Graph<'_>,
    frictional: &[usize],
    components: usize,
) -> Result<Vec<u32>, SolveError> {
    improved(
        graph,
        frictional,
        components,
        minimum_degree(graph, frictional)?,
    )
}

/// Minimum degree stays without the feature.
#[cfg(not(feature = "dissection"))]
fn improved(
    _: &Graph<'_>,
    _: &[usize],
    _: usize,
    by_degree: Vec<u32>,
) -> Result<Vec<u32>, SolveError> {
    Ok(by_degree)
}

/// A mask of the frictional vertices.
fn marked(graph: &Graph<'_>, frictional: &[usize]) -> Vec<bool> {
    let mut last = vec![false; graph.starts.len() - 1];
    for &vertex in frictional {
        last[vertex] = true;
    }
    last
}
