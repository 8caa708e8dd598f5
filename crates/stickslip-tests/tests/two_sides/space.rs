//! A square fault inside a cube, under a stress with shear on it.

use nalgebra::{Matrix3, SVector, Vector3};
use stickslip::fem::{Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    BlockMatrix, BoundaryPart, Components, Condensed, Contact, GeneralizedAlpha, NonsmoothSolver,
    NormalStress, Scene, Simulation, Tnnmg,
};

use crate::{ELASTIC, Outcome, largest};

type Body = Simulation<3>;

/// The cube after a step in which the stress grows from zero, with a fault of a coefficient or none.
fn cube(coefficient: Option<f64>, multigrid: bool) -> Outcome<(P1<3>, Body)> {
    let grid = Mesh::<3>::grid([4.0; 3], [4; 3])?;
    let points = grid.vertices().iter().map(|x| x - Vector3::repeat(2.0));
    let mut mesh = Mesh::new(points.collect(), grid.cells().flatten().copied().collect())?;
    if coefficient.is_some() {
        let on = |x: &Vector3<f64>| x[2] == 0.0 && x[0].abs() <= 1.0 && x[1].abs() <= 1.0;
        mesh = mesh.with_surface_where("fault", on)?.split("fault")?;
    }
    let space = P1::new(mesh).refined(1)?;
    let stress = Matrix3::new(-1.0, 0.1, 0.5, 0.1, -1.2, 0.2, 0.5, 0.2, -1.0);
    let mut load = vec![Vector3::zeros(); space.vertex_count()];
    for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        let side = space.trace(|x| x[axis] == 2.0 * sign)?;
        let traction = stress.column(axis) * sign;
        for (&p, weight) in side.vertices().iter().zip(side.weights()) {
            load[p] += traction * *weight;
        }
    }
    let at = |point: [f64; 3]| -> Outcome<BoundaryPart> {
        Ok(BoundaryPart {
            vertices: vec![space.vertex_at(point).ok_or("no vertex")?],
            dimension: 3,
            ..BoundaryPart::point(1.0)
        })
    };
    let mut scene = Scene::new(elasticity(&space, &ELASTIC)?)
        .with_load_history(move |time, sum| {
            for (sum, load) in sum.iter_mut().zip(&load) {
                *sum += load * time;
            }
        })
        .fix(at([-2.0; 3])?, Components::ALL)
        .fix(at([2.0, -2.0, -2.0])?, [false, true, true])
        .fix(at([-2.0, 2.0, -2.0])?, [false, false, true]);
    if let Some(coefficient) = coefficient {
        let [plus, minus] = ["fault+", "fault-"].map(|side| space.part(side));
        let law = Tresca { coefficient };
        let from_body = NormalStress::from_body(0.0);
        scene = scene.with_contact(Contact::between(&plus?, &minus?, law, from_body));
    }
    let solver: Box<dyn NonsmoothSolver<BlockMatrix<3>, 3>> = if multigrid {
        Box::new(Tnnmg::new(space.transfers()))
    } else {
        Box::new(Condensed::new())
    };
    let mut body = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
    body.step(1.0)?;
    Ok((space, body))
}

/// Locked it is not there, and both solvers find one slip, along the shear stress: its direction stays within the
/// asymmetry of the tetrahedra.
#[test]
fn a_fault_in_space_slips_along_the_shear_stress() -> Outcome {
    let ((whole, uncut), (cut, locked)) = (cube(None, false)?, cube(Some(1e3), false)?);
    let uncut = uncut.snapshot();
    let scale = largest(uncut.displacement.iter().copied());
    for (x, u) in cut
        .mesh()
        .vertices()
        .iter()
        .zip(locked.snapshot().displacement)
    {
        let vertex = whole.vertex_at((*x).into()).ok_or("no vertex")?;
        assert!((u - uncut.displacement[vertex]).amax() < 1e-12 * scale);
    }
    let runs = [cube(Some(0.2), false)?.1, cube(Some(0.2), true)?.1];
    let [one, other] = [0, 1].map(|k| runs[k].snapshot().contact(0));
    let slips = |k: usize| -> SVector<f64, 3> { one.slip_vector(k) };
    let largest_slip = largest((0..one.len()).map(slips));
    let mut total = Vector3::zeros();
    for k in 0..one.len() {
        assert!((slips(k) - other.slip_vector(k)).amax() < 1e-7 * largest_slip);
        assert_eq!(slips(k)[2], 0.0);
        total += slips(k) * one.weight(k);
    }
    let shear = Vector3::new(0.5, 0.2, 0.0);
    assert!(total.normalize().dot(&shear.normalize()) > 0.995, "{total}");
    Ok(())
}
