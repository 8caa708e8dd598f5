//! Faults of triangles: their operators, loads and refusals.

use nalgebra::{DMatrix, DVector, Matrix3, SVector, Vector2, Vector3};
use stickslip_bie::{
    FaultGeometry, KernelError, Medium, SurfaceError, SurfaceFault, Triangles,
    TriangularDislocation,
};
use stickslip_solvers::{Matrix, Operator};

use super::meshes::{both, grid};
use crate::{MEDIUM, Outcome};

/// A curved sheet that reaches the surface, with a branch.
fn cells() -> Result<Triangles, SurfaceError> {
    let main = grid([4, 4], |[x, y]| {
        [x, -0.6 * y - 0.05 * x * x, -0.7 * y + 0.03 * y * y]
    });
    let branch = grid([2, 2], |[x, y]| [x + 1.1, 2.0 - y, -2.3 - 0.4 * y]);
    let (points, triangles) = both(main, branch);
    Triangles::new(&points, &triangles)
}

fn fault() -> Result<SurfaceFault, SurfaceError> {
    SurfaceFault::half_space(cells()?, MEDIUM, 0.25)
}

fn slips<const C: usize>(count: usize) -> Vec<SVector<f64, C>> {
    let value = |cell: usize, c: usize| ((7 * cell + 3 * c) as f64).sin();
    (0..count)
        .map(|cell| SVector::from_fn(|c, _| value(cell, c)))
        .collect()
}

/// Without correction the numbers are tractions of triangles at centroids.
#[test]
fn entries_are_those_of_dislocations() -> Outcome {
    let fault = fault()?.without_correction().without_averaging();
    let (dense, normal) = (DMatrix::from(&fault.stiffness()), fault.normal_stiffness());
    let (cells, mu) = (fault.cells(), MEDIUM.shear_modulus);
    for (i, j) in [(0, 0), (0, 1), (5, 17), (30, 4), (35, 35), (39, 2), (2, 39)] {
        let source = TriangularDislocation::half_space(cells.corners(j), mu, 0.25)?;
        let [strike, up_dip, along] = [
            cells.axes(i).strike,
            cells.axes(i).up_dip,
            cells.axes(i).normal,
        ]
        .map(Vector3::from);
        for (c, slip) in [cells.axes(j).strike, cells.axes(j).up_dip]
            .into_iter()
            .enumerate()
        {
            let traction = source.stress(slip, cells.centroid(i)) * along;
            for (r, axis) in [strike, up_dip].into_iter().enumerate() {
                let error = dense[(2 * i + r, 2 * j + c)] + traction.dot(&axis) * cells.area(i);
                assert!(error.abs() < 1e-11 * mu, "{i} {j}: {error:e}");
            }
            let error = normal.block(i, j)[c] + traction.dot(&along);
            assert!(error.abs() < 1e-11 * mu, "{i} {j}: {error:e}");
        }
    }
    Ok(())
}

/// One component is what two have along the rakes.
#[test]
fn rakes_are_directions_of_two_components() -> Outcome {
    let two = fault()?;
    let count = two.cells().count();
    let rakes: Vec<_> = (0..count).map(|cell| 10.0 * cell as f64).collect();
    let one = two.clone().with_rakes(&rakes)?;
    let direction = DMatrix::from_fn(2 * count, count, |row, cell| match row / 2 == cell {
        true if row % 2 == 0 => rakes[cell].to_radians().cos(),
        true => rakes[cell].to_radians().sin(),
        false => 0.0,
    });
    let expected = direction.transpose() * DMatrix::from(&two.stiffness()) * &direction;
    let error = (DMatrix::from(&one.stiffness()) - &expected).amax() / expected.amax();
    assert!(error < 1e-12, "{error:e}");
    let (two, one) = (two.normal_stiffness(), one.normal_stiffness());
    for (i, j) in [(3, 3), (10, 20), (39, 1)] {
        let (sin, cos) = rakes[j].to_radians().sin_cos();
        let error = one.block(i, j)[0] - two.block(i, j).dot(&Vector2::new(cos, sin));
        assert!(error.abs() < 1e-12 * MEDIUM.shear_modulus);
    }
    Ok(())
}

#[test]
fn products_are_those_of_the_matrix() -> Outcome {
    let fault = fault()?;
    let (stiffness, damping) = (fault.stiffness(), fault.radiation_damping());
    let mut sum = Operator::<2>::combination(&[(0.3, &stiffness), (2.0, &damping)]);
    sum.add_to_diagonal(7, &nalgebra::Matrix2::new(1e10, 2e9, 2e9, 5e9));
    let dense = DMatrix::from(&sum);
    let x = slips::<2>(sum.vertex_count());
    let flat = DVector::from_iterator(2 * x.len(), x.iter().flat_map(|x| [x[0], x[1]]));
    let expected = &dense * &flat;
    let mut y = vec![Vector2::zeros(); x.len()];
    sum.multiply_add(1.0, &x, &mut y);
    let vertices = [0, 7, 8, 33];
    let mut some = [Vector2::zeros(); 4];
    sum.products_at(&vertices, &x, &mut some);
    let scale = 1e-13 * expected.amax();
    for (vertex, y) in y.iter().enumerate() {
        for c in 0..2 {
            assert!((y[c] - expected[2 * vertex + c]).abs() < scale);
        }
        let block = dense.fixed_view::<2, 2>(2 * vertex, 2 * vertex);
        assert!((sum.diagonal_block(vertex) - block).amax() < scale);
    }
    for (&vertex, product) in vertices.iter().zip(&some) {
        assert!((product - y[vertex]).amax() < scale);
        assert!((sum.product_at(vertex, &x) - y[vertex]).amax() < scale);
    }
    assert!((sum.quadratic(&x) - flat.dot(&expected)).abs() < 1e-12 * flat.dot(&expected).abs());
    // Without allocation it becomes another combination.
    sum.set_combination(&[(1.0, &stiffness), (0.0, &damping)]);
    let error = (DMatrix::from(&sum) - DMatrix::from(&stiffness)).amax();
    assert!(error < scale);
    let normal = fault.normal_stiffness();
    let mut change = vec![1.0; x.len()];
    normal.multiply_add(0.5, &x, &mut change);
    for i in [0, 13, 39] {
        let row = x.iter().enumerate().map(|(j, x)| normal.block(i, j).dot(x));
        assert!((change[i] - 1.0 - 0.5 * row.sum::<f64>()).abs() < scale);
    }
    Ok(())
}

/// Back slip by the projection of one vector: what creeps so is not stressed, nor is what turns with it.
#[test]
fn a_plate_vector_is_projected_onto_cells() -> Outcome {
    let fault = fault()?;
    let vector = [0.4, -0.3, 0.1];
    for (cell, rate) in fault.along(vector).iter().enumerate() {
        let axes = fault.cells().axes(cell);
        let back = Vector3::from(axes.strike) * rate[0] + Vector3::from(axes.up_dip) * rate[1];
        let normal = Vector3::from(axes.normal);
        let expected = Vector3::from(vector) - normal * normal.dot(&Vector3::from(vector));
        assert!((back - expected).amax() < 1e-15);
        let rake = fault.rakes_along(vector)[cell].to_radians();
        assert!((Vector2::new(rake.cos(), rake.sin()) * rate.norm() - rate).amax() < 1e-15);
    }
    // The same numbers by the load.
    let rates = fault.along(vector);
    let mut load = vec![Vector2::zeros(); rates.len()];
    fault.back_slip(&rates)?(2.0, &mut load);
    fault.stiffness().multiply_add(-2.0, &rates, &mut load);
    assert!(load.iter().all(|load| load.amax() < 1e-3));
    Ok(())
}

#[test]
fn a_stress_tensor_is_resolved_on_cells() -> Outcome {
    let fault = fault()?.with_rake(30.0)?;
    let pressure = fault.resolve(&(Matrix3::identity() * -5e6));
    assert!(
        pressure
            .normal
            .iter()
            .all(|normal| (normal - 5e6).abs() < 1e-8)
    );
    assert!(pressure.shear.iter().all(|shear| shear[0].abs() < 1e-8));
    // Vertical planes that strike along x: slip along x by shear stress xy, the normal along -y.
    let (points, triangles) = grid([2, 2], |[x, y]| [x, 0.0, -1.0 - y]);
    let plane = SurfaceFault::whole_space(Triangles::new(&points, &triangles)?, MEDIUM, 0.25)?;
    let stress = Matrix3::new(0.0, 3.0, 0.0, 3.0, -2.0, 0.0, 0.0, 0.0, 0.0);
    let side = -plane.cells().axes(0).normal[1] * plane.cells().axes(0).strike[0];
    let resolved = plane.resolve(&stress);
    assert!(
        resolved
            .shear
            .iter()
            .all(|s| (s - Vector2::new(-3.0 * side, 0.0)).amax() < 1e-15)
    );
    assert!(
        resolved
            .normal
            .iter()
            .all(|normal| (normal - 2.0).abs() < 1e-15)
    );
    assert!(plane.normal_stress_change().is_none());
    Ok(())
}

#[test]
fn faults_that_are_none_are_refused() -> Outcome {
    let refused = |found: Result<SurfaceFault, SurfaceError>| {
        found.map_or_else(|error| error.to_string(), |_| String::new())
    };
    let bad = Medium {
        shear_modulus: -1.0,
        ..MEDIUM
    };
    assert_eq!(
        refused(SurfaceFault::half_space(cells()?, bad, 0.25)),
        "shear modulus must be positive and finite, is -1"
    );
    assert!(
        refused(SurfaceFault::half_space(cells()?, MEDIUM, 0.5)).starts_with("Poisson's ratio")
    );
    assert_eq!(
        refused(SurfaceFault::half_space_within(
            70_000,
            cells()?,
            MEDIUM,
            0.25
        )),
        "the H-matrix takes about 76800 bytes without far blocks, more than the limit of 70000 bytes: raise the limit, or take \
         larger cells"
    );
    let fault = fault()?;
    assert!(fault.clone().with_rake(f64::NAN).is_err());
    assert!(fault.clone().with_rakes(&[0.0; 3]).is_err());
    assert!(fault.section(|_| false).is_err());
    assert!(fault.back_slip(&[Vector2::zeros(); 3]).is_err());
    assert!(fault.radiation_damping_times(-1.0).is_err());
    let upper: Result<_, KernelError> = fault.section(|[_, _, z]| z > -1.0);
    let upper = upper?;
    assert_eq!(upper.vertices().len(), upper.map(|x| x).len());
    assert!(upper.points().iter().all(|point| point[2] > -1.0));
    Ok(())
}
