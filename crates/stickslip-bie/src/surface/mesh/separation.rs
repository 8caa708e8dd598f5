//! Triangles that cross or are too near to each other.

use nalgebra::Vector3;

use super::super::SurfaceError;
use super::vertices::bounds;

/// The share of the root of the smaller area by which a centroid is away from other triangles at least: stress is
/// singular at their edges.
const APART: f64 = 0.1;
/// The share of a triangle's size below which points are on its plane or edges.
const ROUNDING: f64 = 1e-9;

/// A triangle in space.
struct Triangle {
    corners: [usize; 3],
    points: [Vector3<f64>; 3],
    centroid: Vector3<f64>,
    size: f64,
    bounds: [[f64; 3]; 2],
}

/// Refuses triangles that cross, and centroids near other triangles; vertices and edges may be common.
pub(super) fn check(
    points: &[[f64; 3]],
    triangles: &[[usize; 3]],
    areas: &[f64],
) -> Result<(), SurfaceError> {
    let [low, high] = bounds(points.iter());
    let longest = |&a: &usize, &b: &usize| (high[a] - low[a]).total_cmp(&(high[b] - low[b]));
    let axis = (0..3).max_by(longest).unwrap_or(0);
    let triangles: Vec<_> = (triangles.iter().zip(areas))
        .map(|(&corners, area)| Triangle::new(points, corners, area.sqrt()))
        .collect();
    let begin = |cell: usize| triangles[cell].bounds[0][axis];
    let mut order: Vec<_> = (0..triangles.len()).collect();
    order.sort_by(|&a, &b| begin(a).total_cmp(&begin(b)).then(a.cmp(&b)));
    // Those whose boxes the sweep along the axis has not left.
    let mut active: Vec<usize> = Vec::new();
    for cell in order {
        active.retain(|&other| triangles[other].bounds[1][axis] >= begin(cell));
        for &other in &active {
            let (a, b) = (&triangles[cell], &triangles[other]);
            if a.may_touch(b) {
                a.check_apart(b, [cell, other])?;
                b.check_apart(a, [other, cell])?;
            }
        }
        active.push(cell);
    }
    Ok(())
}

impl Triangle {
    fn new(points: &[[f64; 3]], corners: [usize; 3], size: f64) -> Self {
        let [low, high] = bounds(corners.iter().map(|&corner| &points[corner]));
        let reach = APART * size;
        let points = corners.map(|corner| Vector3::from(points[corner]));
        Self {
            corners,
            points,
            centroid: (points[0] + points[1] + points[2]) / 3.0,
            size,
            bounds: [low.map(|x| x - reach), high.map(|x| x + reach)],
        }
    }

    fn may_touch(&self, other: &Self) -> bool {
        let ([low, high], [from, to]) = (&self.bounds, &other.bounds);
        (0..3).all(|c| low[c] <= to[c] && from[c] <= high[c])
    }

    /// Refuses edges of this triangle through the other, and its centroid near the other.
    fn check_apart(&self, other: &Self, triangles: [usize; 2]) -> Result<(), SurfaceError> {
        let is_shared = |corner: &usize| other.corners.contains(corner);
        for k in 0..3 {
            let ends = [k, (k + 1) % 3];
            if ends.iter().any(|&end| is_shared(&self.corners[end])) {
                continue;
            }
            if let Some(at) = other.pierced(ends.map(|end| self.points[end])) {
                let at = at.into();
                return Err(SurfaceError::Crossing { triangles, at });
            }
        }
        let (weights, nearest) = other.nearest(&self.centroid);
        let shared: f64 = (other.corners.iter().zip(weights))
            .filter(|(corner, _)| self.corners.contains(corner))
            .map(|(_, weight)| weight)
            .sum();
        let distance = (self.centroid - nearest).norm();
        let least = APART * self.size.min(other.size);
        // The centroid is always near to the own edges and corners.
        if shared < 1.0 - ROUNDING && distance < least {
            return Err(SurfaceError::TooNear {
                triangles,
                distance,
                least,
            });
        }
        Ok(())
    }

    /// Where a segment passes through the inside.
    fn pierced(&self, [p, q]: [Vector3<f64>; 2]) -> Option<Vector3<f64>> {
        let [a, b, c] = self.points;
        let normal = (b - a).cross(&(c - a));
        let near = ROUNDING * normal.norm() * self.size;
        let [from, to] = [p, q].map(|end| (end - a).dot(&normal));
        if from.min(to) >= -near || from.max(to) <= near {
            return None;
        }
        let at = p + (q - p) * (from / (from - to));
        let inside = (0..3).all(|k| {
            let (a, b) = (self.points[k], self.points[(k + 1) % 3]);
            (b - a).cross(&(at - a)).dot(&normal) > ROUNDING * normal.norm_squared()
        });
        inside.then_some(at)
    }

    /// The nearest point: its weights of the corners, and itself.
    fn nearest(&self, p: &Vector3<f64>) -> ([f64; 3], Vector3<f64>) {
        let [a, b, c] = self.points;
        let normal = (b - a).cross(&(c - a));
        let weight = |k: usize| {
            let (a, b) = (self.points[(k + 1) % 3], self.points[(k + 2) % 3]);
            (b - a).cross(&(p - a)).dot(&normal) / normal.norm_squared()
        };
        let weights = [0, 1, 2].map(weight);
        if weights.iter().all(|&weight| weight >= 0.0) {
            return (
                weights,
                p - normal * ((p - a).dot(&normal) / normal.norm_squared()),
            );
        }
        // On an edge.
        let on_edge = |k: usize| {
            let (a, b) = (self.points[k], self.points[(k + 1) % 3]);
            let share = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            let mut weights = [0.0; 3];
            weights[k] = 1.0 - share;
            weights[(k + 1) % 3] = share;
            (weights, a + (b - a) * share)
        };
        let distance = |at: &Vector3<f64>| (p - at).norm_squared();
        let mut best = on_edge(0);
        for other in [on_edge(1), on_edge(2)] {
            if distance(&other.1) < distance(&best.1) {
                best = other;
            }
        }
        best
    }
}
