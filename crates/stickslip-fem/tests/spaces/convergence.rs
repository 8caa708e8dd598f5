//! Against exact solutions: second order in L2 and first in H1, in every dimension, and the reference
//! displacements of the slider at rest.

use crate::common::{PlaneWaves, solve};
use nalgebra::{SVector, Vector2};
use stickslip_fem::{
    Assembled, Constraints, Elastic, P1, antiplane, body_force, elasticity, h1_error, l2_error,
    traction,
};

type Field<const C: usize> = Vec<SVector<f64, C>>;

/// Errors in L2 and H1 with the exact values prescribed on the whole boundary.
fn errors<const D: usize, const C: usize>(
    space: &P1<D>,
    (stiffness, load): (Assembled<C>, Field<C>),
    exact: &PlaneWaves<D, C>,
) -> [f64; 2] {
    let mut held = Constraints::none(space);
    held.fix(&space.trace(|_| true).unwrap(), [true; C])
        .unwrap();
    let u = solve(
        &stiffness,
        &load,
        &held,
        &space.interpolate(|x| exact.value(x)),
    );
    [
        l2_error(space, &u, |x| exact.value(x)).unwrap(),
        h1_error(space, &u, |x| exact.gradient(x)).unwrap(),
    ]
}

fn elastic<const D: usize>(space: &P1<D>, exact: &PlaneWaves<D, D>) -> (Assembled<D>, Field<D>) {
    let material = Elastic {
        young_modulus: 2.0,
        poisson_ratio: 0.3,
    };
    let (lambda, mu) = material.lame().unwrap();
    let f = |x: &SVector<f64, D>| {
        -(lambda + mu) * exact.gradient_of_divergence(x) - mu * exact.laplacian(x)
    };
    (elasticity(space, &material).unwrap(), body_force(space, f))
}

fn scalar<const D: usize>(space: &P1<D>, exact: &PlaneWaves<D, 1>) -> (Assembled<1>, Field<1>) {
    (
        antiplane(space, 3.0).unwrap(),
        body_force(space, |x| -3.0 * exact.laplacian(x)),
    )
}

/// The orders seen between the last two of a sequence of refinements.
fn assert_orders<const D: usize, const C: usize>(
    name: &str,
    coarse: &P1<D>,
    levels: [usize; 2],
    problem: fn(&P1<D>, &PlaneWaves<D, C>) -> (Assembled<C>, Field<C>),
) {
    let exact = PlaneWaves::new();
    let [before, after] = levels.map(|level| {
        let space = coarse.clone().refined(level).unwrap();
        errors(&space, problem(&space, &exact), &exact)
    });
    let [l2, h1] = [0, 1].map(|norm| (before[norm] / after[norm]).log2());
    println!("{name}: order {l2:.3} in L2, {h1:.3} in H1, errors {after:?}");
    assert!((l2 - 2.0).abs() < 0.1, "{name}: order {l2} in L2");
    assert!((h1 - 1.0).abs() < 0.1, "{name}: order {h1} in H1");
}

#[test]
fn plane_strain() {
    assert_orders(
        "rising",
        &P1::grid([1.0, 1.0], [1, 1]).unwrap(),
        [5, 6],
        elastic,
    );
    assert_orders(
        "falling",
        &P1::mirrored_grid([1.0, 1.0], [1, 1]).unwrap(),
        [5, 6],
        elastic,
    );
    assert_orders(
        "pentagon",
        &P1::new(crate::common::irregular_2d()),
        [4, 5],
        elastic,
    );
}

#[test]
fn elastic_solid() {
    assert_orders(
        "cube",
        &P1::grid([1.0; 3], [1; 3]).unwrap(),
        [3, 4],
        elastic,
    );
    assert_orders(
        "tetrahedron",
        &P1::new(crate::common::irregular_3d()),
        [3, 4],
        elastic,
    );
}

#[test]
fn antiplane_shear_and_diffusion() {
    assert_orders(
        "square",
        &P1::grid([1.0, 1.0], [1, 1]).unwrap(),
        [5, 6],
        scalar,
    );
    assert_orders(
        "pentagon",
        &P1::new(crate::common::irregular_2d()),
        [4, 5],
        scalar,
    );
    assert_orders("cube", &P1::grid([1.0; 3], [1; 3]).unwrap(), [3, 4], scalar);
    assert_orders(
        "tetrahedron",
        &P1::new(crate::common::irregular_3d()),
        [4, 5],
        scalar,
    );
}

/// Tractions on the right and top, exact values on the rest: sigma n of the exact solution is the load.
#[test]
fn traction_boundary() {
    let material = Elastic {
        young_modulus: 2.0,
        poisson_ratio: 0.3,
    };
    let (lambda, mu) = material.lame().unwrap();
    let exact = PlaneWaves::<2, 2>::new();
    let [before, after] = [4, 5].map(|level| {
        let space = P1::grid([1.0, 1.0], [1, 1])
            .unwrap()
            .refined(level)
            .unwrap();
        let (stiffness, mut load) = elastic(&space, &exact);
        for axis in [0, 1] {
            let face = space.trace(|x| x[axis] == 1.0).unwrap();
            let normal = Vector2::ith(axis, 1.0);
            let push = traction(&space, &face, |x| {
                let slope = exact.gradient(x);
                lambda * slope.trace() * normal + mu * (slope + slope.transpose()) * normal
            })
            .unwrap();
            load.iter_mut()
                .zip(push)
                .for_each(|(load, push)| *load += push);
        }
        let mut held = Constraints::none(&space);
        held.fix(&space.trace(|x| x[0] == 0.0).unwrap(), [true; 2])
            .unwrap();
        held.fix(&space.trace(|x| x[1] == 0.0).unwrap(), [true; 2])
            .unwrap();
        let u = solve(
            &stiffness,
            &load,
            &held,
            &space.interpolate(|x| exact.value(x)),
        );
        l2_error(&space, &u, |x| exact.value(x)).unwrap()
    });
    let order = (before / after).log2();
    assert!((order - 2.0).abs() < 0.1, "order {order}");
}

/// u_x at (2.5, 0) of the strip that hangs from its top under gravity and slides freely on its bottom.
fn slider_at_rest(refinements: usize) -> f64 {
    let space = P1::grid([5.0, 1.0], [5, 1])
        .unwrap()
        .refined(refinements)
        .unwrap();
    let stiffness = elasticity(
        &space,
        &Elastic {
            young_modulus: 5e7,
            poisson_ratio: 0.3,
        },
    )
    .unwrap();
    let weight = body_force(&space, |_| Vector2::new(0.0, -9.81 * 5e3));
    let mut held = Constraints::none(&space);
    held.fix(&space.trace(|x| x[1] == 1.0).unwrap(), [true, true])
        .unwrap();
    held.fix(&space.trace(|x| x[1] == 0.0).unwrap(), [false, true])
        .unwrap();
    let u = solve(
        &stiffness,
        &weight,
        &held,
        &vec![Vector2::zeros(); space.vertex_count()],
    );
    u[space.vertex_at([2.5, 0.0]).unwrap()][0]
}

#[test]
fn slider_under_gravity() {
    assert!((slider_at_rest(3) + 1.8178e-7).abs() < 0.5e-11);
    assert!((slider_at_rest(4) + 8.036e-8).abs() < 0.5e-11);
}
