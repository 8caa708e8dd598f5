//! Several contacts, contacts that meet something, and what is read of them.

mod bodies;
mod laws;
mod meeting;
mod normal_stress_effect;
mod oblique;
mod surface;
mod tension;

use stickslip::BoundaryPart;

/// The vertices of a part at points that are wanted, with the weights they have.
fn those(part: &BoundaryPart, wanted: impl Fn(&[f64; 3]) -> bool) -> BoundaryPart {
    let kept: Vec<usize> = (0..part.vertices.len())
        .filter(|&k| wanted(&part.points[k]))
        .collect();
    BoundaryPart {
        vertices: kept.iter().map(|&k| part.vertices[k]).collect(),
        weights: kept.iter().map(|&k| part.weights[k]).collect(),
        points: kept.iter().map(|&k| part.points[k]).collect(),
        normals: kept.iter().map(|&k| part.normals[k]).collect(),
        axes: Vec::new(),
        opposite: None,
        dimension: part.dimension,
        mesh: part.mesh,
    }
}
