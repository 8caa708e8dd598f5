//! Nested dissection: a small separator comes last, then the same in each half.

use feral_metis::{CscPattern, metis_order};

use crate::SolveError;
use crate::block_matrix::Graph;

use super::fill::Fill;
use super::marked;

/// The multiplications of a factorisation, per entry of the graph, from which nested dissection is tried. Dissection
/// was measured to take the time of half so many.
///
/// In space a cube of ten cells a side takes more, by three components; dissection saves 12 percent of its factor,
/// and 45 at 4e5 unknowns. In the plane a square of 4e5 unknowns takes half of it; there dissection saves 6 percent at
/// best, and adds up to 10.
const WORTHWHILE: f64 = 2e4;

/// The better of an order and nested dissection, which is tried where it may be worth its time. Both fills are counted,
/// and the same graph has the same order on every machine.
pub(super) fn improved(
    graph: &Graph<'_>,
    frictional: &[usize],
    components: usize,
    order: Vec<u32>,
) -> Result<Vec<u32>, SolveError> {
    let fill = Fill::of(graph, &order)?;
    if fill.multiplications(components) < WORTHWHILE * graph.columns.len() as f64 {
        return Ok(order);
    }
    let Some(dissected) = nested_dissection(graph, frictional) else {
        return Ok(order);
    };
    let saves = Fill::of(graph, &dissected)?.entries() < fill.entries();
    Ok(if saves { dissected } else { order })
}

/// Nested dissection of the graph without the frictional vertices, which follow it.
///
/// The frictional vertices are a separator already. As a clique among the others they were measured to spoil the cuts,
/// up to twice the factor in a flat block. `None` for more than 2^31 entries.
pub(super) fn nested_dissection(graph: &Graph<'_>, frictional: &[usize]) -> Option<Vec<u32>> {
    let last = marked(graph, frictional);
    let mut places = vec![0_i32; last.len()];
    let mut interior = Vec::new();
    for vertex in (0..last.len()).filter(|&vertex| !last[vertex]) {
        places[vertex] = i32::try_from(interior.len()).ok()?;
        interior.push(vertex as u32);
    }
    let (mut starts, mut neighbours) = (vec![0_i32], Vec::new());
    for &vertex in &interior {
        let columns = graph.columns[graph.range(vertex as usize)].iter();
        let inner = columns.filter(|&&other| !last[other as usize]);
        neighbours.extend(inner.map(|&other| places[other as usize]));
        starts.push(i32::try_from(neighbours.len()).ok()?);
    }
    let pattern = CscPattern::new(interior.len(), &starts, &neighbours)?;
    let order = metis_order(&pattern).ok()?;
    let inner = order.iter().map(|&place| interior[place as usize]);
    Some(inner.chain(frictional.iter().map(|&v| v as u32)).collect())
}
