//! Cells by the process that has them.

use stickslip::fem::Mesh;
use stickslip::nalgebra::SVector;

/// The process of each cell: the mesh is cut across its longest side, again and again, so that each process has as many
/// cells as the others.
pub(crate) fn partition<const D: usize>(mesh: &Mesh<D>, processes: usize) -> Vec<u32> {
    let middles: Vec<SVector<f64, D>> = (mesh.cells())
        .map(|cell| {
            cell.iter()
                .map(|&p| mesh.vertices()[p as usize])
                .sum::<SVector<f64, D>>()
        })
        .collect();
    let mut ranks = vec![0; middles.len()];
    let mut order: Vec<usize> = (0..middles.len()).collect();
    divide(&middles, &mut order, (0, processes), &mut ranks);
    ranks
}

fn divide<const D: usize>(
    middles: &[SVector<f64, D>],
    cells: &mut [usize],
    (first, count): (usize, usize),
    ranks: &mut [u32],
) {
    if count == 1 {
        for &cell in &*cells {
            ranks[cell] = first as u32;
        }
        return;
    }
    let infinite = SVector::<f64, D>::repeat(f64::INFINITY);
    let (low, high) = cells
        .iter()
        .fold((infinite, -infinite), |(low, high), &cell| {
            (low.inf(&middles[cell]), high.sup(&middles[cell]))
        });
    let axis = (high - low).imax();
    // Equal places in the order of the cells, so that every process finds the same.
    cells.sort_by(|&a, &b| {
        middles[a][axis]
            .total_cmp(&middles[b][axis])
            .then(a.cmp(&b))
    });
    let left = count / 2;
    let (near, far) = cells.split_at_mut(cells.len() * left / count);
    divide(middles, near, (first, left), ranks);
    divide(middles, far, (first + left, count - left), ranks);
}
