//! The order of elimination: fill-reducing for the interior, the frictional vertices last.

mod dissection;
mod fill;
mod minimum_degree;
#[cfg(test)]
mod tests;

use crate::SolveError;
use crate::block_matrix::Graph;

use dissection::nested_dissection;
use fill::Fill;
use minimum_degree::minimum_degree;

/// The multiplications of a factorisation, per entry of the graph, from which nested dissection is tried: it was
/// measured to take the time of half so many.
///
/// In space a cube of ten cells a side takes more, by three components; dissection saves 12 percent of its factor,
/// and 45 at 4e5 unknowns. In the plane a square of 4e5 unknowns takes half of it; there dissection saves 6 percent at
/// best, and adds up to 10.
const WORTHWHILE: f64 = 2e4;

/// All vertices in the order in which they are eliminated, of `components` unknowns each.
///
/// The graph is that of vertices, not of components: the components of one vertex have the same neighbours and end up
/// in one supernode. Of minimum degree and, where it may be worth its time, nested dissection, the order with the
/// smaller factor is taken. Both are counted, so that the same graph has the same order everywhere.
pub(crate) fn elimination_order(
    graph: &Graph<'_>,
    frictional: &[usize],
    components: usize,
) -> Result<Vec<u32>, SolveError> {
    let by_degree = minimum_degree(graph, frictional)?;
    let fill = Fill::of(graph, &by_degree)?;
    if fill.multiplications(components) < WORTHWHILE * graph.columns.len() as f64 {
        return Ok(by_degree);
    }
    let Some(dissected) = nested_dissection(graph, frictional) else {
        return Ok(by_degree);
    };
    let saves = Fill::of(graph, &dissected)?.entries() < fill.entries();
    Ok(if saves { dissected } else { by_degree })
}

/// Which of all vertices are frictional.
fn marked(graph: &Graph<'_>, frictional: &[usize]) -> Vec<bool> {
    let mut last = vec![false; graph.starts.len() - 1];
    for &vertex in frictional {
        last[vertex] = true;
    }
    last
}
