//! Several contacts, contacts that meet something, and what is read of them.

mod bodies;
mod laws;
mod meeting;
mod normal_stress_effect;
mod oblique;
mod surface;
mod tension;

use stickslip::Part;

/// The vertices of a part at points that are wanted, with the weights they have.
fn those(part: &Part, wanted: impl Fn(&[f64; 3]) -> bool) -> Part {
    let kept: Vec<usize> = (0..part.vertices.len())
        .filter(|&k| wanted(&part.points[k]))
        .collect();
    Part {
        vertices: kept.iter().map(|&k| part.vertices[k]).collect(),
        weights: kept.iter().map(|&k| part.weights[k]).collect(),
        points: kept.iter().map(|&k| part.points[k]).collect(),
        normals: kept.iter().map(|&k| part.normals[k]).collect(),
        axes: Vec::new(),
        dimension: part.dimension,
        mesh: part.mesh,
    }
}
