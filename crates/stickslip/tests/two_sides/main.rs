//! Faults between two deformable sides: one program, a module for each theme.
#![cfg(all(feature = "fem", feature = "tnnmg", feature = "condensed"))]

mod crossing;
mod symmetry;

use nalgebra::{SVector, Vector2};
use stickslip::fem::{GridDiagonal, Mesh, P1};

/// The result of a test that builds scenes and takes steps.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;

/// The paper's block and its mirror image below it, with the parts `plus` and `minus` on the fault between them.
fn mirrored(refinements: usize) -> Outcome<P1<2>> {
    let upper = Mesh::<2>::grid([5.0, 1.0], [5, 1], GridDiagonal::Rising)?;
    let count = upper.vertex_count() as u32;
    let mut vertices = upper.vertices().to_vec();
    vertices.extend(upper.vertices().iter().map(|x| Vector2::new(x[0], -x[1])));
    let mut cells: Vec<u32> = upper.cells().flatten().copied().collect();
    for cell in upper.cells() {
        // In the order of the mirror image.
        cells.extend([cell[0], cell[2], cell[1]].map(|p| p + count));
    }
    let mesh = Mesh::new(vertices, cells)?;
    let of_side = |below: bool| -> Vec<[u32; 2]> {
        let on = |p: &u32| mesh.vertices()[*p as usize][1] == 0.0 && (*p >= count) == below;
        let faces = mesh.boundary().iter().filter(|face| face.iter().all(on));
        faces.copied().collect()
    };
    let (plus, minus) = (of_side(false), of_side(true));
    let mesh = mesh.with_part("plus", &plus)?.with_part("minus", &minus)?;
    Ok(P1::new(mesh).refined(refinements)?)
}

/// The largest entry of a list of vectors.
fn largest<const C: usize>(vectors: impl Iterator<Item = SVector<f64, C>>) -> f64 {
    vectors.map(|x| x.amax()).fold(0.0, f64::max)
}
