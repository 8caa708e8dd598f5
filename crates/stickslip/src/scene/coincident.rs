//! Contacts on the two walls of an open mesh.

use std::collections::HashMap;

use crate::{BoundaryPart, SceneError};

/// The share of the contacts' extent below which two points coincide: above the rounding of coordinates in files, below
/// the edges of a graded mesh.
const NEAR: f64 = 1e-9;

/// Refuses two coincident vertices of contacts.
pub(crate) fn check_walls<'a>(
    parts: impl Iterator<Item = &'a BoundaryPart>,
) -> Result<(), SceneError> {
    let mut points: Vec<(usize, [f64; 3])> = parts
        .flat_map(|part| {
            part.vertices
                .iter()
                .copied()
                .zip(part.points.iter().copied())
        })
        .filter(|(_, point)| point.iter().all(|x| x.is_finite()))
        .collect();
    // Contacts that share a vertex meet there.
    points.sort_by_key(|&(vertex, _)| vertex);
    points.dedup_by_key(|&mut (vertex, _)| vertex);
    let extent = (0..3).map(|c| {
        let along = || points.iter().map(|(_, point)| point[c]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    });
    let near = NEAR * extent.fold(0.0, f64::max);
    if near == 0.0 {
        return Ok(());
    }
    // By boxes of twice that size, of which a place touches two along each axis.
    let mut boxes: HashMap<[i64; 3], Vec<usize>> = HashMap::with_capacity(points.len());
    for (k, (vertex, point)) in points.iter().enumerate() {
        let scaled = point.map(|x| x / (2.0 * near));
        let side = |c: usize, far: bool| {
            let low = (scaled[c] - 0.5).floor() as i64;
            low + i64::from(far)
        };
        for corner in 0..8_u8 {
            let place = [0, 1, 2].map(|c| side(c, corner >> c & 1 == 1));
            for &other in boxes.get(&place).into_iter().flatten() {
                let apart = (0..3).map(|c| (points[other].1[c] - point[c]).powi(2));
                if apart.sum::<f64>().sqrt() <= near {
                    return Err(SceneError::Coincident {
                        vertices: [points[other].0, *vertex],
                        at: *point,
                    });
                }
            }
        }
        let own = scaled.map(|x| x.floor() as i64);
        boxes.entry(own).or_default().push(k);
    }
    Ok(())
}
