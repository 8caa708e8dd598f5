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

/// All vertices in the order in which they are eliminated, of `components` unknowns each.
///
/// The graph is that of vertices, not of components: the components of one vertex have the same neighbours and end up
/// in one supernode. The order is that of minimum degree. With the feature `dissection` it is that of nested dissection
/// where that may be worth its time and its factor is smaller.
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

/// Minimum degree stays.
#[cfg(not(feature = "dissection"))]
fn improved(
    _: &Graph<'_>,
    _: &[usize],
    _: usize,
    by_degree: Vec<u32>,
) -> Result<Vec<u32>, SolveError> {
    Ok(by_degree)
}

/// Which of all vertices are frictional.
fn marked(graph: &Graph<'_>, frictional: &[usize]) -> Vec<bool> {
    let mut last = vec![false; graph.starts.len() - 1];
    for &vertex in frictional {
        last[vertex] = true;
    }
    last
}
