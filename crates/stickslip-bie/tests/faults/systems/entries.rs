//! Entries against the stress of rectangles.

use nalgebra::{Matrix3, Vector1, Vector3};
use stickslip_bie::{Cells, FaultSystem, PlaneFault, Rectangles};
use stickslip_solvers::Matrix;

use super::{at, dense, dense_normal, plane, planes};
use crate::planes::cells;
use crate::{MEDIUM, Outcome};

/// Along strike, to the left and up, as columns, by components to the east, to the north and up.
fn turned(strike: f64) -> Matrix3<f64> {
    let (sin, cos) = strike.to_radians().sin_cos();
    Matrix3::from_columns(&[
        Vector3::new(sin, cos, 0.0),
        Vector3::new(-cos, sin, 0.0),
        Vector3::z(),
    ])
}

/// The strike, the direction up dip and the normal of a plane, in its own axes.
fn axes(dip: f64) -> [Vector3<f64>; 3] {
    let (sin, cos) = dip.to_radians().sin_cos();
    [
        Vector3::x(),
        Vector3::new(0.0, cos, sin),
        Vector3::new(0.0, -sin, cos),
    ]
}

/// All entries, by a chain of its own from slip to traction.
fn check(system: &FaultSystem) -> Outcome {
    let (matrix, normal) = (dense(&system.stiffness()), dense_normal(system));
    let largest = matrix.amax();
    let count = system.vertex_count();
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let [[to, _], [from, cell]] = [i, j].map(|vertex| system.plane_and_cell(vertex));
        if to == from {
            continue;
        }
        let (receiver, source) = (system.placements()[to], system.placements()[from]);
        let [east, north] = source.origin;
        let frame = turned(source.strike);
        let local =
            frame.tr_mul(&(Vector3::from(system.center(i)) - Vector3::new(east, north, 0.0)));
        let patch = (system.planes()[from].dislocation(cell)).ok_or("no rectangle")?;
        let dip = system.planes()[to].dip().ok_or("no dip")?;
        let [strike, up, out] = axes(dip).map(|axis| turned(receiver.strike) * axis);
        for (component, slip) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let stress = frame * patch.stress(slip, local.into()) * frame.transpose();
            let traction = stress * out;
            for (c, axis) in [strike, up].iter().enumerate() {
                let exact = -traction.dot(axis) * system.area(i);
                let error = (matrix[(2 * i + c, 2 * j + component)] - exact).abs() / largest;
                assert!(error < 1e-12, "{i} {j} {c} {component}: {error:e}");
            }
            let error = (normal[(i, 2 * j + component)] + traction.dot(&out)).abs();
            let error = error * system.area(i) / largest;
            assert!(error < 1e-12, "{i} {j} {component}: normal {error:e}");
        }
    }
    Ok(())
}

#[test]
fn entries_are_stresses_of_cells() -> Outcome {
    check(&FaultSystem::new(planes(0.0)?)?)?;
    check(&FaultSystem::new(planes(77.0)?)?)?;
    // Centres behind planes, beside them and on the extensions of the edges of their cells.
    for dip in [90.0, 60.0] {
        let small = plane(cells([3, 2], [100.0, 100.0], 250.0)?, dip)?;
        let large = plane(cells([2, 3], [300.0, 200.0], 0.0)?, dip)?;
        let places = [[0.0, 2000.0], [0.0, -700.0], [0.0, 650.0]];
        for (place, origin) in places.into_iter().enumerate() {
            if place == 2 {
                let aside = [700.0, 150.0];
                check(&FaultSystem::new([
                    (large.clone(), at(0.0, [0.0; 2])),
                    (small.clone(), at(0.0, aside)),
                ])?)?;
            }
            check(&FaultSystem::new([
                (large.clone(), at(0.0, [0.0; 2])),
                (small.clone(), at(0.0, origin)),
            ])?)?;
        }
    }
    Ok(())
}

/// Slip along strike of a vertical plane clamps a parallel one where it moves rock towards it.
#[test]
fn parallel_planes_change_their_normal_stress() -> Outcome {
    let one = || -> Result<PlaneFault<1>, _> {
        plane(cells([6, 3], [500.0, 500.0], 0.0)?, 90.0)?.with_rake(0.0)
    };
    let system = FaultSystem::new([
        (one()?, at(90.0, [0.0, 0.0])),
        (one()?, at(90.0, [0.0, 700.0])),
    ])?;
    let normal = system.normal_stiffness();
    let mut slip = vec![Vector1::zeros(); 36];
    slip[7] = Vector1::new(2.0);
    let mut stress = vec![0.0; 36];
    normal.multiply_add(1.0, &slip, &mut stress);
    // Strike to the east: its axes are those of the surface.
    let patch = (system.planes()[0].dislocation(7)).ok_or("no rectangle")?;
    for vertex in 0..36 {
        let [x, y, z] = system.center(vertex);
        let exact = match vertex {
            0..18 => 0.0,
            _ => -patch.stress([2.0, 0.0], [x, y, z])[(1, 1)],
        };
        let error = (stress[vertex] - exact).abs() / (MEDIUM.shear_modulus / 500.0);
        assert!(error < 1e-13, "{vertex}: {error:e}");
    }
    // Left-lateral slip takes the far side to the west: it clamps the second plane there.
    let [west, east] = [0, 2].map(|column| stress[18 + 6 + column]);
    assert!(west * east < 0.0, "{west:e} {east:e}");
    Ok(())
}

/// The fields of a dislocation decay with the cube of the distance.
#[test]
fn far_planes_do_not_interact() -> Outcome {
    let of = |distance: f64| -> Outcome<f64> {
        // Deep, about the centre of one cell.
        let (along, down) = (
            Cells::new([-50.0, 50.0], 1)?,
            Cells::new([1e5, 100_100.0], 1)?,
        );
        let one = || plane(Rectangles::new(along, down), 90.0);
        let system = FaultSystem::new([
            (one()?, at(0.0, [0.0, 0.0])),
            (one()?, at(40.0, [0.6 * distance, 0.8 * distance])),
        ])?;
        let matrix = dense(&system.stiffness());
        Ok(matrix.view((2, 0), (2, 2)).amax() / matrix.amax())
    };
    let (near, far, farther) = (of(2e3)?, of(4e3)?, of(8e3)?);
    for ratio in [near / far, far / farther] {
        assert!((ratio / 8.0 - 1.0).abs() < 0.01, "{ratio}");
    }
    assert!(farther < 1e-6, "{farther:e}");
    Ok(())
}

/// What creeps with the plates is not stressed, and the load is that of back slip.
#[test]
fn plates_load_all_planes() -> Outcome {
    let system = FaultSystem::new(super::raked(planes(10.0)?, 30.0)?)?;
    let rates = [1e-9, -2e-9, 0.0].map(Vector1::new);
    let (mut load, time) = (vec![Vector1::zeros(); system.vertex_count()], 1e8);
    system.plate_loading(&rates)?(time, &mut load);
    let mut moved = vec![Vector1::zeros(); system.vertex_count()];
    for (plane, rate) in rates.iter().enumerate() {
        moved[system.vertices(plane)].fill(rate * time);
    }
    let largest = load.iter().map(|load| load[0].abs()).fold(0.0, f64::max);
    // The third plane is stressed by the others alone.
    assert!(load[system.vertices(2)].iter().all(|load| load[0] != 0.0));
    system.stiffness().multiply_add(-1.0, &moved, &mut load);
    assert!(load.iter().all(|load| load[0].abs() < 1e-13 * largest));
    Ok(())
}
