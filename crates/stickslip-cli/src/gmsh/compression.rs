//! Remote uniaxial compression of a body: tractions on its boundary, and no more fixed components than rigid-body modes.

use stickslip::fem::{BlockMatrix, P1};
use stickslip::nalgebra::SVector;
use stickslip::{BoundaryPart, Scene};

use super::faults::Fault;
use crate::cli::Problem;

/// The faces of the boundary outside of the contacts.
fn outside<'a, const D: usize>(
    space: &'a P1<D>,
    faults: &'a [Fault<D>],
) -> impl Iterator<Item = [usize; D]> + 'a {
    let mesh = space.mesh();
    let side = |fault: &Fault<D>| {
        let sides = ["+", "-"].map(|sign| format!("{}{sign}", fault.name));
        let parts = mesh
            .parts()
            .filter(move |(name, _)| sides.iter().any(|s| s == name));
        parts
            .flat_map(|(_, places)| places.iter().copied())
            .collect::<Vec<usize>>()
    };
    let mut frictional = vec![false; mesh.boundary().len()];
    for place in faults.iter().flat_map(side) {
        frictional[place] = true;
    }
    let faces = mesh.boundary().iter().zip(frictional);
    let faces = faces.filter(|(_, frictional)| !frictional);
    faces.map(|(face, _)| face.map(|p| p as usize))
}

/// The forces on the vertices of the tractions of the stress `-pressure a a^T`, with the unit vector `a`, on the boundary
/// outside of the contacts \[N\].
pub(super) fn forces<const D: usize>(
    space: &P1<D>,
    faults: &[Fault<D>],
    axis: &SVector<f64, D>,
    pressure: f64,
) -> Vec<SVector<f64, D>> {
    let vertices = space.mesh().vertices();
    let mut forces = vec![SVector::zeros(); vertices.len()];
    for face in outside(space, faults) {
        let edge = |k: usize| vertices[face[k]] - vertices[face[0]];
        // The area times the outward normal: the edge turned to its right; half the product of two edges.
        let normal = SVector::from_fn(|c, _| {
            if D == 2 {
                let edge = edge(1);
                if c == 0 { edge[1] } else { -edge[0] }
            } else {
                let (a, b, i, j) = (edge(1), edge(2), (c + 1) % D, (c + 2) % D);
                0.5 * (a[i] * b[j] - a[j] * b[i])
            }
        });
        let force = axis * (-pressure * axis.dot(&normal));
        for p in face {
            forces[p] += force / D as f64;
        }
    }
    forces
}

/// Fixes three (D = 2) or six (D = 3) components of vertices far apart on the boundary, which rigid-body modes need. The
/// tractions balance each other, so that these components hold no force.
///
/// # Errors
/// A boundary that is nothing but contacts.
pub(super) fn without_rigid_modes<const D: usize>(
    scene: Scene<BlockMatrix<D>, D>,
    space: &P1<D>,
    faults: &[Fault<D>],
) -> Result<Scene<BlockMatrix<D>, D>, Problem> {
    let vertices = space.mesh().vertices();
    let mut free = vec![false; vertices.len()];
    for p in outside(space, faults).flatten() {
        free[p] = true;
    }
    for fault in faults {
        let sides = [Some(&fault.part), fault.minus.as_ref()];
        for &p in sides.into_iter().flatten().flat_map(|side| side.vertices()) {
            free[p] = false;
        }
    }
    let farthest = |distance: &dyn Fn(&SVector<f64, D>) -> f64| {
        let free = (0..vertices.len()).filter(|&p| free[p]);
        free.max_by(|&p, &q| distance(&vertices[p]).total_cmp(&distance(&vertices[q])))
    };
    let Some(first) = farthest(&|x| -x.sum()) else {
        return Err("--compression: no vertex of the boundary is outside of the contacts".into());
    };
    let origin = vertices[first];
    let second = farthest(&|x| (x - origin).norm()).unwrap_or(first);
    let line = vertices[second] - origin;
    // A rotation moves the second vertex normal to the line, in the plane and in space; what is left turns around the
    // line, and moves a third vertex normal to the plane of the three.
    let along = line.iamax();
    let mut scene = scene.fix(pin(space, first), [true; D]);
    scene = scene.fix(pin(space, second), std::array::from_fn(|c| c != along));
    if D == 3 {
        let across = |x: &SVector<f64, D>| {
            let x = x - origin;
            let turn = |c: usize| {
                (line[(c + 1) % D] * x[(c + 2) % D]) - line[(c + 2) % D] * x[(c + 1) % D]
            };
            SVector::<f64, D>::from_fn(|c, _| turn(c))
        };
        let third = farthest(&|x| across(x).norm()).unwrap_or(second);
        let turned = across(&vertices[third]).iamax();
        scene = scene.fix(pin(space, third), std::array::from_fn(|c| c == turned));
    }
    Ok(scene)
}

fn pin<const D: usize>(space: &P1<D>, vertex: usize) -> BoundaryPart {
    BoundaryPart::nearest_vertex(space, space.mesh().vertices()[vertex].into())
}
