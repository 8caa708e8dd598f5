//! The neighbours of triangles across edges.

use nalgebra::Vector3;

use super::super::SurfaceError;

/// The neighbour across each edge: that from corner `k` to the next.
pub(crate) type Neighbors = [Option<usize>; 3];

/// Triangles that continue each other across edges. Where more than two meet, the two do that bend least, by less than a
/// right angle; then those that are left.
pub(super) fn neighbors(
    points: &[[f64; 3]],
    triangles: &[[usize; 3]],
) -> Result<Vec<Neighbors>, SurfaceError> {
    let mut sides: Vec<([usize; 2], usize, usize)> = Vec::with_capacity(3 * triangles.len());
    for (cell, corners) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push(([a.min(b), a.max(b)], cell, k));
        }
    }
    sides.sort_unstable();
    check_duplicates(triangles)?;
    let mut found = vec![[None; 3]; triangles.len()];
    for edge in sides.chunk_by(|a, b| a.0 == b.0) {
        let mut left: Vec<_> = edge.iter().map(|&(_, cell, k)| (cell, k)).collect();
        while let Some([i, j]) = straightest(points, triangles, &left) {
            let ((cell, k), (other, l)) = (left[i], left[j]);
            found[cell][k] = Some(other);
            found[other][l] = Some(cell);
            left.remove(j);
            left.remove(i);
        }
    }
    Ok(found)
}

/// The pair of sides of one edge whose triangles bend least.
fn straightest(
    points: &[[f64; 3]],
    triangles: &[[usize; 3]],
    sides: &[(usize, usize)],
) -> Option<[usize; 2]> {
    if sides.len() <= 2 {
        return (sides.len() == 2).then_some([0, 1]);
    }
    let away: Vec<_> = (sides.iter())
        .map(|&(cell, k)| away(points, &triangles[cell], k))
        .collect();
    let mut best = (0.0, None);
    for i in 0..sides.len() {
        for j in i + 1..sides.len() {
            let cos = away[i].dot(&away[j]);
            if cos < best.0 {
                best = (cos, Some([i, j]));
            }
        }
    }
    best.1
}

/// The direction within a triangle away from its edge.
fn away(points: &[[f64; 3]], corners: &[usize; 3], k: usize) -> Vector3<f64> {
    let [a, b, c] = [k, k + 1, k + 2].map(|k| Vector3::from(points[corners[k % 3]]));
    let along = (b - a).normalize();
    let across = c - a;
    (across - along * across.dot(&along)).normalize()
}

fn check_duplicates(triangles: &[[usize; 3]]) -> Result<(), SurfaceError> {
    let mut sorted: Vec<_> = (triangles.iter().enumerate())
        .map(|(cell, &corners)| {
            let mut corners = corners;
            corners.sort_unstable();
            (corners, cell)
        })
        .collect();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        Some(pair) => Err(SurfaceError::Duplicate {
            triangles: [pair[0].1, pair[1].1],
        }),
        None => Ok(()),
    }
}

/// The cells of the same sheet that share a vertex with each cell, itself among them, increasing; as one list, and where
/// each cell's begins.
pub(super) fn around_vertices(
    triangles: &[[usize; 3]],
    sheets: &[usize],
) -> (Vec<usize>, Vec<usize>) {
    let most = triangles.iter().flatten().max().map_or(0, |last| last + 1);
    let mut at_vertices = vec![Vec::new(); most];
    for (cell, corners) in triangles.iter().enumerate() {
        corners.iter().for_each(|&v| at_vertices[v].push(cell));
    }
    let (mut cells, mut starts) = (Vec::new(), vec![0]);
    for (cell, corners) in triangles.iter().enumerate() {
        let touching = corners.iter().flat_map(|&v| at_vertices[v].iter().copied());
        let mut own: Vec<_> = touching
            .filter(|&other| sheets[other] == sheets[cell])
            .collect();
        own.sort_unstable();
        own.dedup();
        cells.extend(own);
        starts.push(cells.len());
    }
    (cells, starts)
}
