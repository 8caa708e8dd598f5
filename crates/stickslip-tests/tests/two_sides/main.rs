//! Faults between two deformable sides: one program, a module for each theme.

mod across_a_period;
mod allocation;
mod antiplane;
mod body;
mod cracks;
mod creep;
mod crossing;
mod cycles;
mod explicit;
mod frames;
mod growth;
mod impact;
mod kept_closed;
mod landing;
mod layers;
mod meeting;
mod opening;
mod partly_held;
mod penetration;
mod periodic;
mod pore_pressure;
mod pressure;
mod random_block;
mod reactions;
mod reduction;
mod relaxed_opening;
mod relaxed_stress;
mod ring;
mod segments;
mod space;
mod symmetry;

use nalgebra::{Matrix2, SVector, Vector2};
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    BlockMatrix, BoundaryPart, Components, Condensed, Contact, GeneralizedAlpha, NonsmoothSolver,
    NormalStress, Scene, Simulation, Tnnmg,
};

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

/// A square of 4 m about the origin, of so many cells a side.
fn square(cells: usize) -> Outcome<Mesh<2>> {
    let grid = Mesh::<2>::grid([4.0, 4.0], [cells; 2], GridDiagonal::Rising)?;
    let points = grid.vertices().iter().map(|x| x - Vector2::new(2.0, 2.0));
    Ok(Mesh::new(
        points.collect(),
        grid.cells().flatten().copied().collect(),
    )?)
}

const ELASTIC: Elastic = Elastic {
    young_modulus: 1.0,
    poisson_ratio: 0.25,
};

/// The square, or one that is stretched upwards, under a stress on all its sides, from zero to the whole at 1 s; faults of constant friction under the
/// normal stress of the deformation, or a given one.
fn stressed(
    space: &P1<2>,
    stress: Matrix2<f64>,
    (faults, coefficient): (&[&str], f64),
    normal_stress: &NormalStress,
    multigrid: bool,
) -> Outcome<Simulation<2>> {
    let mut load = vec![SVector::<f64, 2>::zeros(); space.vertex_count()];
    let top = (space.mesh().vertices().iter()).fold(0.0, |top: f64, x| top.max(x[1]));
    for (axis, end) in [(0, 2.0), (0, -2.0), (1, top), (1, -top)] {
        let sign = f64::signum(end);
        let edge = space.trace(|x| x[axis] == end)?;
        let traction = stress.column(axis) * sign;
        for (&p, weight) in edge.vertices().iter().zip(edge.weights()) {
            load[p] += traction * *weight;
        }
    }
    let at = |point: [f64; 2]| -> Outcome<BoundaryPart> {
        let vertex = space.vertex_at(point).ok_or("no vertex")?;
        Ok(BoundaryPart {
            vertices: vec![vertex],
            dimension: 2,
            mesh: BoundaryPart::from(&space.trace(|x| x[1] == top)?).mesh,
            ..BoundaryPart::point(1.0)
        })
    };
    let mut scene = Scene::new(elasticity(space, &ELASTIC)?)
        .fix(at([-2.0, -top])?, Components::ALL)
        .fix(at([2.0, -top])?, Components::Y)
        .with_load_history(move |time, sum| {
            for (sum, load) in sum.iter_mut().zip(&load) {
                *sum += load * time;
            }
        });
    for fault in faults {
        let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{fault}{side}")));
        let contact = Contact::between(
            &plus?,
            &minus?,
            Tresca { coefficient },
            normal_stress.clone(),
        );
        scene = scene.with_contact(contact);
    }
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>> = if multigrid {
        Box::new(Tnnmg::new(space.transfers()))
    } else {
        Box::new(Condensed::new())
    };
    Ok(Simulation::new(scene, GeneralizedAlpha::default(), solver)?)
}
