//! Operators, loads, traces and constraints: the identities they must satisfy, and bad parameters.

use crate::common::solve;
use approx::assert_relative_eq;
use nalgebra::{Matrix2, SMatrix, SVector, Vector1, Vector2, Vector3};
use stickslip_fem::{
    BlockMatrix, Constraints, Elastic, FemError, P1, antiplane, body_force, elasticity, h1_error,
    l2_error, mass, traction,
};

const STEEL: Elastic = Elastic {
    young_modulus: 2.1,
    poisson_ratio: 0.29,
};
use crate::{empty, illegal, not_positive};

fn spaces_2d() -> [P1<2>; 2] {
    [
        P1::new(crate::common::irregular_2d()).refined(2).unwrap(),
        P1::mirrored_grid([5.0, 1.0], [10, 3]).unwrap(),
    ]
}

fn spaces_3d() -> [P1<3>; 2] {
    [
        P1::new(crate::common::irregular_3d()).refined(2).unwrap(),
        P1::grid([1.0, 2.0, 0.5], [3, 4, 2]).unwrap(),
    ]
}

fn apply<const C: usize>(matrix: &BlockMatrix<C>, u: &[SVector<f64, C>]) -> Vec<SVector<f64, C>> {
    matrix
        .outer_iterator()
        .map(|row| row.iter().map(|(q, block)| block * u[q]).sum())
        .collect()
}

fn size<const C: usize>(field: &[SVector<f64, C>]) -> f64 {
    field.iter().map(|u| u.amax()).fold(0.0, f64::max)
}

fn check_structure<const C: usize>(matrix: &BlockMatrix<C>) {
    for (p, row) in matrix.outer_iterator().enumerate() {
        assert!(row.indices().is_sorted());
        assert!(row.get(p).is_some());
        for (q, block) in row.iter() {
            assert_eq!(
                matrix.get(q, p).map(SMatrix::transpose).as_ref(),
                Some(block),
                "({p}, {q})"
            );
        }
    }
}

fn unit<const D: usize>(i: usize) -> SVector<f64, D> {
    SVector::from_fn(|k, _| f64::from(i == k))
}

/// Translations and x -> S x with S skew.
fn check_stiffness<const D: usize>(space: &P1<D>) {
    let stiffness = elasticity(space, &STEEL).unwrap();
    check_structure(&stiffness);
    for i in 0..D {
        let shift = space.interpolate(|_| unit::<D>(i));
        assert!(size(&apply(&stiffness, &shift)) < 1e-12);
        for j in 0..i {
            let rotation = space.interpolate(|x| unit::<D>(i) * x[j] - unit(j) * x[i]);
            assert!(size(&apply(&stiffness, &rotation)) < 1e-12);
        }
    }
    let scalar = antiplane(space, 3.0).unwrap();
    check_structure(&scalar);
    assert!(size(&apply(&scalar, &space.interpolate(|_| Vector1::new(1.0)))) < 1e-12);
}

#[test]
fn stiffness_is_symmetric_and_ignores_rigid_motions() {
    spaces_2d().iter().for_each(check_stiffness);
    spaces_3d().iter().for_each(check_stiffness);
}

/// The energy of a homogeneous strain is (lambda tr(eps)^2 / 2 + mu eps : eps) times the volume.
fn check_energy<const D: usize>(space: &P1<D>) {
    let slope = SMatrix::<f64, D, D>::from_fn(|i, j| 0.3 + 0.7 * i as f64 - 0.45 * (j * j) as f64);
    let u = space.interpolate(|x| slope * x);
    let force = apply(&elasticity(space, &STEEL).unwrap(), &u);
    let energy: f64 = u.iter().zip(&force).map(|(u, f)| 0.5 * u.dot(f)).sum();
    let (lambda, mu) = STEEL.lame().unwrap();
    let strain = 0.5 * (slope + slope.transpose());
    let volume: f64 = (0..space.mesh().cell_count())
        .map(|cell| space.mesh().volume(cell))
        .sum();
    assert_relative_eq!(
        energy,
        volume * (0.5 * lambda * strain.trace().powi(2) + mu * strain.norm_squared()),
        max_relative = 1e-12
    );
}

#[test]
fn homogeneous_strains_have_their_energy() {
    spaces_2d().iter().for_each(check_energy);
    spaces_3d().iter().for_each(check_energy);
}

/// Linear displacements prescribed on the boundary extend linearly.
fn check_patch<const D: usize>(space: &P1<D>) {
    let linear = |x: &SVector<f64, D>| {
        SVector::<f64, D>::from_fn(|i, _| 1.0 + (i as f64 + 0.5) * x[0] - 0.3 * x[(i + 1) % D])
    };
    let exact = space.interpolate(linear);
    let mut held = Constraints::none(space);
    held.fix(&space.trace(|_| true).unwrap(), [true; D])
        .unwrap();
    assert!(held.as_slice().iter().any(|held| !held[0]));
    let start: Vec<_> = exact
        .iter()
        .zip(held.as_slice())
        .map(|(u, held)| if held[0] { *u } else { SVector::zeros() })
        .collect();
    let u = solve(
        &elasticity(space, &STEEL).unwrap(),
        &vec![SVector::zeros(); start.len()],
        &held,
        &start,
    );
    assert!(l2_error(space, &u, linear).unwrap() < 1e-12);
}

#[test]
fn patch_test() {
    spaces_2d().iter().for_each(check_patch);
    spaces_3d().iter().for_each(check_patch);
}

/// (rho u, v) is exact for linear u and v.
fn check_mass<const D: usize>(space: &P1<D>) {
    let volume: f64 = (0..space.mesh().cell_count())
        .map(|cell| space.mesh().volume(cell))
        .sum();
    let operator = mass::<D, 2>(space, 2.5).unwrap();
    check_structure(&operator);
    let total: Matrix2<f64> = operator.data().iter().sum();
    assert_relative_eq!(
        total,
        Matrix2::from_diagonal_element(2.5 * volume),
        epsilon = 1e-12
    );
    let u = space.interpolate(|x| Vector2::new(x[0] - 2.0 * x[1], 1.0));
    let norm = u
        .iter()
        .zip(apply(&operator, &u))
        .map(|(u, m)| u.dot(&m))
        .sum::<f64>()
        / 2.5;
    let distance = l2_error(space, &u, |_| Vector2::zeros()).unwrap();
    assert_relative_eq!(norm, distance.powi(2), max_relative = 1e-12);
}

#[test]
fn mass_sums_to_density_times_volume() {
    spaces_2d().iter().for_each(check_mass);
    spaces_3d().iter().for_each(check_mass);
}

#[test]
fn loads_integrate_their_density() {
    let space = P1::grid([2.0, 1.0, 1.0], [2, 1, 2]).unwrap();
    // The integral of x_0^3 over the box is 4, that of x_0^2 x_1 over its top 4 / 3.
    let against = |load: &[Vector1<f64>]| {
        load.iter()
            .zip(space.mesh().vertices())
            .map(|(l, x)| l[0] * x[0])
            .sum::<f64>()
    };
    assert_relative_eq!(
        against(&body_force(&space, |x| Vector1::new(x[0].powi(2)))),
        4.0,
        max_relative = 1e-13
    );
    let top = space.trace(|x| x[2] == 1.0).unwrap();
    assert_relative_eq!(
        against(&traction(&space, &top, |x| Vector1::new(x[0] * x[1])).unwrap()),
        4.0 / 3.0,
        max_relative = 1e-13
    );
}

#[test]
fn traces_have_the_measure_of_their_part() {
    let space = P1::grid([5.0, 1.0], [5, 1]).unwrap().refined(3).unwrap();
    let bottom = space.trace(|x| x[1] == 0.0).unwrap();
    let mut expected = vec![0.125; 41];
    expected[0] = 0.0625;
    expected[40] = 0.0625;
    assert_eq!(bottom.weights(), expected);
    assert!(bottom.vertices().is_sorted_by(|p, q| p < q));
    assert!(
        bottom
            .points()
            .iter()
            .zip(bottom.vertices())
            .all(|(x, &p)| *x == space.mesh().vertices()[p])
    );
    assert_relative_eq!(
        space.trace(|_| true).unwrap().measure(),
        12.0,
        max_relative = 1e-14
    );

    let space = P1::grid([1.0, 2.0, 3.0], [2, 2, 2])
        .unwrap()
        .refined(1)
        .unwrap();
    let side = space.trace(|x| x[0] == 1.0).unwrap();
    assert_relative_eq!(side.measure(), 6.0, max_relative = 1e-14);
    assert_relative_eq!(
        side.weights().iter().sum::<f64>(),
        6.0,
        max_relative = 1e-14
    );
    assert_relative_eq!(
        space.trace(|_| true).unwrap().measure(),
        22.0,
        max_relative = 1e-14
    );
}

#[test]
fn normals_of_parts_are_those_of_their_faces() {
    let space = P1::<3>::grid([2.0, 1.0, 3.0], [2, 1, 3])
        .unwrap()
        .refined(1)
        .unwrap();
    let sizes = [2.0, 1.0, 3.0];
    for axis in 0..3 {
        for (side, sign) in [(0.0, -1.0), (sizes[axis], 1.0)] {
            let part = space.trace(|x| x[axis] == side).unwrap();
            let outward = SVector::<f64, 3>::from_fn(|c, _| if c == axis { sign } else { 0.0 });
            assert!(part.normals().iter().all(|&normal| normal == outward));
        }
    }
    // Around an edge the mean, by areas: here the faces next to the edge are of one size.
    let around = space.trace(|x| x[0] == 0.0 || x[2] == 0.0).unwrap();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for (x, normal) in around.points().iter().zip(around.normals()) {
        let on_edge = x[0] == 0.0 && x[2] == 0.0;
        let expected = if on_edge && 0.0 < x[1] && x[1] < 1.0 {
            SVector::from([-half, 0.0, -half])
        } else if x[0] == 0.0 && x[2] > 0.0 {
            SVector::from([-1.0, 0.0, 0.0])
        } else if x[2] == 0.0 && x[0] > 0.0 {
            SVector::from([0.0, 0.0, -1.0])
        } else {
            continue;
        };
        assert!((normal - expected).norm() < 1e-15, "{x}: {normal}");
    }
}

#[test]
fn traces_without_a_face_are_refused() {
    let space = P1::grid([5.0, 1.0], [5, 1]).unwrap().refined(1).unwrap();
    assert_eq!(
        space.trace(|x| x[1] == 0.3).map(|_| ()),
        Err(empty("faces of the boundary that satisfy the predicate"))
    );
    // Single vertices make no face.
    assert_eq!(
        space.trace(|x| x[0] == 5.0 && x[1] == 0.0).map(|_| ()),
        Err(empty("faces of the boundary that satisfy the predicate"))
    );
}

#[test]
fn vertices_are_found_up_to_rounding() {
    let space = P1::grid([0.3, 0.1], [3, 1]).unwrap().refined(2).unwrap();
    let found = space.vertex_at([0.1 + 0.1 / 4.0, 0.1 * 3.0 / 4.0]).unwrap();
    assert_relative_eq!(
        space.mesh().vertices()[found],
        Vector2::new(0.125, 0.075),
        epsilon = 1e-15
    );
    assert_eq!(space.vertex_at([0.126, 0.075]), None);
    assert_eq!(space.vertex_at([f64::NAN, 0.0]), None);
}

#[test]
fn bad_parameters_are_refused() {
    let space = P1::grid([1.0, 1.0], [1, 1]).unwrap();
    let elastic = |young_modulus, poisson_ratio| {
        elasticity(
            &space,
            &Elastic {
                young_modulus,
                poisson_ratio,
            },
        )
        .map(|_| ())
    };
    assert_eq!(
        elastic(0.0, 0.3),
        Err(not_positive("Young's modulus [Pa]", 0.0))
    );
    assert!(matches!(
        elastic(f64::NAN, 0.3),
        Err(FemError::Value {
            what: "Young's modulus [Pa]",
            ..
        })
    ));
    assert_eq!(
        elastic(f64::INFINITY, 0.3),
        Err(not_positive("Young's modulus [Pa]", f64::INFINITY))
    );
    assert_eq!(
        elastic(1.0, 0.5),
        Err(illegal("Poisson\'s ratio", "above -1 and below 1/2", 0.5))
    );
    assert_eq!(
        elastic(1.0, -1.0),
        Err(illegal("Poisson\'s ratio", "above -1 and below 1/2", -1.0))
    );
    assert!(matches!(
        elastic(1.0, f64::NAN),
        Err(FemError::Value {
            what: "Poisson's ratio",
            ..
        })
    ));
    assert_eq!(
        antiplane(&space, -1.0).map(|_| ()),
        Err(not_positive("shear modulus [Pa]", -1.0))
    );
    assert_eq!(
        mass::<2, 2>(&space, 0.0).map(|_| ()),
        Err(not_positive("density [kg/m^D]", 0.0))
    );

    let mismatch = FemError::Length {
        what: "vectors of a field on the mesh",
        expected: 4,
        found: 6,
    };
    let field = vec![Vector3::zeros(); 6];
    assert_eq!(
        l2_error(&space, &field, |_| Vector3::zeros()),
        Err(mismatch.clone())
    );
    assert_eq!(
        h1_error(&space, &field, |_| SMatrix::<f64, 3, 2>::zeros()),
        Err(mismatch)
    );
}

#[test]
fn errors_carry_their_numbers() {
    let message = FemError::DegenerateCell {
        level: None,
        cell: 17,
        volume: -0.5,
    }
    .to_string();
    assert_eq!(message, "cell 17 is inverted or degenerate: volume -0.5");
}
