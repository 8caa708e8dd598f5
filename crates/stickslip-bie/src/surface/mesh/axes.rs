//! The axes of cells: strike, up dip and normal.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use nalgebra::Vector3;

use super::adjacency::Neighbors;

/// The sine of the dip below which a triangle is horizontal.
const HORIZONTAL: f64 = 1e-12;

/// The axes of a cell, unit vectors: strike `z x n`, up dip `n x strike`, and the normal `n`.
///
/// Slip is that of the side to which the normal points relative to the other. The cell dips to the right of strike. On a
/// sheet that is horizontal or overturned in parts strike goes on from that of its steeper cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellAxes {
    /// Along strike: the direction of left-lateral slip, rake 0.
    pub strike: [f64; 3],
    /// Up dip: the direction of thrust, rake 90.
    pub up_dip: [f64; 3],
    /// The normal, into the hanging wall.
    pub normal: [f64; 3],
}

/// From normals. Strike goes over edges, steep cells first, without a turn by more than a right angle.
pub(super) fn axes(
    normals: &[Vector3<f64>],
    areas: &[f64],
    neighbors: &[Neighbors],
    sheets: &[usize],
) -> Vec<CellAxes> {
    let horizontal: Vec<_> = normals.iter().map(|n| Vector3::z().cross(n)).collect();
    // Positive numbers are ordered as their bits.
    let steep = |cell: usize| horizontal[cell].norm().to_bits();
    let mut strikes: Vec<Option<Vector3<f64>>> = vec![None; normals.len()];
    let sheet_count = sheets.iter().max().map_or(0, |last| last + 1);
    let mut steepest = vec![None; sheet_count];
    for (cell, &sheet) in sheets.iter().enumerate() {
        let best = &mut steepest[sheet];
        if best.is_none_or(|best| steep(cell) > steep(best)) {
            *best = Some(cell);
        }
    }
    let mut along = vec![0.0; sheet_count];
    for first in steepest.into_iter().flatten() {
        let mut heap = BinaryHeap::from([(steep(first), Reverse(first), first)]);
        while let Some((_, Reverse(cell), from)) = heap.pop() {
            if strikes[cell].is_some() {
                continue;
            }
            let strike = strike(&horizontal[cell], &normals[cell], strikes[from]);
            along[sheets[cell]] += areas[cell] * strike.dot(&horizontal[cell]);
            strikes[cell] = Some(strike);
            let next = neighbors[cell].iter().flatten();
            heap.extend(next.map(|&next| (steep(next), Reverse(next), cell)));
        }
    }
    let cells = normals.iter().zip(strikes).zip(sheets);
    cells
        .map(|((normal, strike), &sheet)| {
            let strike = strike.unwrap_or_else(Vector3::x);
            let strike = if along[sheet] < 0.0 { -strike } else { strike };
            CellAxes {
                strike: strike.into(),
                up_dip: normal.cross(&strike).into(),
                normal: (*normal).into(),
            }
        })
        .collect()
}

/// `z x n`, or against it if that goes on from a neighbour's strike.
fn strike(
    horizontal: &Vector3<f64>,
    normal: &Vector3<f64>,
    before: Option<Vector3<f64>>,
) -> Vector3<f64> {
    let size = horizontal.norm();
    if size >= HORIZONTAL {
        let turned = before.is_some_and(|before| before.dot(horizontal) < 0.0);
        return horizontal / if turned { -size } else { size };
    }
    let before = before.unwrap_or_else(Vector3::x);
    (before - normal * before.dot(normal)).normalize()
}
