//! Plane waves leave through dashpots, up to what the mesh reflects.
//!
//! Fields that depend on x alone are piecewise linear in x on every grid, so that the operators, restricted to them, are
//! those of a bar with nodes at a distance h. Its waves exp(i (theta j - omega t)) are known. By the trapezoidal rule
//! with step tau the frequency acts as W = (2 h / (tau c)) tan(omega tau / 2), in units of c / h, and
//!
//! ```text
//! W^2 = 6 (1 - cos theta) / (2 + cos theta)
//! ```
//!
//! At the last node, where a dashpot of the impedance Z = rho c ends the bar, the equation of a wave towards it leaves
//! i omega (Z_h - Z), and that of its reflection -i omega (Z_h + Z), with Z_h = Z sin theta (1 + W^2/6) / W: the share
//! R = (Z_h - Z) / (Z_h + Z) returns.

use nalgebra::{DMatrix, DVector, SVector};
use stickslip_fem::{
    BlockMatrix, Elastic, Impedance, P1, antiplane, antiplane_dashpot, dashpot, elasticity, mass,
};

const MATERIAL: Elastic = Elastic {
    young_modulus: 2.5,
    poisson_ratio: 0.25,
};
const DENSITY: f64 = 2.0;
/// Cells along the bar, of length 1 m.
const CELLS: usize = 128;
/// The width of the pulse exp(-(x / WIDTH)^2) \[m\].
const WIDTH: f64 = 8.0;

/// An operator on fields `u(x) direction`.
fn on_bar<const D: usize, const C: usize>(
    space: &P1<D>,
    operator: &BlockMatrix<C>,
    direction: SVector<f64, C>,
) -> DMatrix<f64> {
    let node = |p: usize| space.mesh().vertices()[p][0].round() as usize;
    let mut bar = DMatrix::zeros(CELLS + 1, CELLS + 1);
    for (p, row) in operator.outer_iterator().enumerate() {
        for (q, block) in row.iter() {
            bar[(node(p), node(q))] += direction.dot(&(block * direction));
        }
    }
    bar
}

/// The largest displacement after a pulse of height 1 m in the middle of the bar has travelled its length.
fn returned([mass, damping, stiffness]: [DMatrix<f64>; 3], speed: f64) -> f64 {
    let middle = CELLS as f64 / 2.0;
    let place = |j: usize| (j as f64 - middle) / WIDTH;
    let mut u = DVector::from_fn(CELLS + 1, |j, _| (-place(j).powi(2)).exp());
    let slope = |j: usize| -2.0 * place(j) / WIDTH * (-place(j).powi(2)).exp();
    let mut v = DVector::from_fn(CELLS + 1, |j, _| -speed * slope(j));
    let tau = 0.5 / speed;
    let factor = (&mass * (2.0 / tau) + &damping + &stiffness * (0.5 * tau))
        .cholesky()
        .unwrap();
    for _ in 0..2 * CELLS {
        let right =
            &mass * (2.0 / tau) * &v - &damping * &v - &stiffness * (&u * 2.0 + &v * (0.5 * tau));
        let next = factor.solve(&right);
        u += (&v + &next) * (0.5 * tau);
        v = next;
    }
    u.amax()
}

/// A bound on [`returned`]: the sum over all waves of the pulse of what each leaves behind.
///
/// The pulse has the spectrum U, and the velocity that d'Alembert's solution has; so waves (1 + theta/W)/2 U set out to
/// the right and (1 - theta/W)/2 U to the left. In the time given those with theta < 0.8 are reflected once and are a
/// quarter of the length from either end, eight widths off what has not been reflected; the others may be anywhere.
fn bound() -> f64 {
    let panels = 20_000;
    let step = std::f64::consts::PI / panels as f64;
    let density = |theta: f64| {
        let cosine = theta.cos();
        let w = (6.0 * (1.0 - cosine) / (2.0 + cosine)).sqrt();
        let impedance = theta.sin() * (1.0 + w * w / 6.0) / w;
        let share = if theta < 0.8 {
            ((impedance - 1.0) / (impedance + 1.0)).abs()
        } else {
            1.0
        };
        let spectrum = WIDTH * std::f64::consts::PI.sqrt() * (-(0.5 * WIDTH * theta).powi(2)).exp();
        share * spectrum * ((1.0 + theta / w).abs() + (1.0 - theta / w).abs()) / 2.0
    };
    let sum: f64 = (0..panels).map(|k| density((k as f64 + 0.5) * step)).sum();
    // Both signs of theta, over 2 pi.
    sum * step / std::f64::consts::PI
}

fn check<const D: usize>(size: [f64; D], cells: [usize; D]) {
    let space = P1::grid(size, cells).unwrap();
    let ends = space.trace(|x| x[0] == 0.0 || x[0] == size[0]).unwrap();
    let impedance = Impedance::of(&MATERIAL, DENSITY).unwrap();
    let operators = [
        mass(&space, DENSITY).unwrap(),
        dashpot(&space, &ends, |_| impedance).unwrap(),
        elasticity(&space, &MATERIAL).unwrap(),
    ];
    let bound = bound();
    // Of the order of (h / width)^2 / 24, so that the test tells dashpots from other ends.
    assert!(bound < 1e-3, "{bound:e}");
    for (axis, z) in [
        (0, impedance.normal),
        (1, impedance.tangential),
        (D - 1, impedance.tangential),
    ] {
        let direction = SVector::from_fn(|c, _| if c == axis { 1.0 } else { 0.0 });
        let bar = || {
            operators
                .each_ref()
                .map(|operator| on_bar(&space, operator, direction))
        };
        let absorbed = returned(bar(), z / DENSITY);
        assert!(absorbed < bound, "along {axis}: {absorbed:e}, {bound:e}");
        let mut free = bar();
        free[1].fill(0.0);
        assert!(returned(free, z / DENSITY) > 0.9);
    }
    let (_, mu) = MATERIAL.lame().unwrap();
    let bar = [
        on_bar(
            &space,
            &mass::<D, 1>(&space, DENSITY).unwrap(),
            SVector::from([1.0]),
        ),
        on_bar(
            &space,
            &antiplane_dashpot(&space, &ends, |_| impedance.tangential).unwrap(),
            SVector::from([1.0]),
        ),
        on_bar(
            &space,
            &antiplane(&space, mu).unwrap(),
            SVector::from([1.0]),
        ),
    ];
    let absorbed = returned(bar, impedance.tangential / DENSITY);
    assert!(absorbed < bound, "out of plane: {absorbed:e}, {bound:e}");
}

#[test]
fn waves_leave_through_dashpots() {
    check([CELLS as f64, 2.0], [CELLS, 2]);
    check([CELLS as f64, 1.0, 1.0], [CELLS, 1, 1]);
}

/// On an oblique face the normal and tangential impedances keep their directions.
#[test]
fn dashpots_follow_their_faces() {
    let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]].map(SVector::from);
    let mesh = stickslip_fem::Mesh::new(corners.to_vec(), vec![0, 1, 2]).unwrap();
    let space = P1::new(mesh);
    let slope = space.trace(|x| x[0] + 2.0 * x[1] == 2.0).unwrap();
    let (normal, tangential) = (3.0, 0.5);
    let damping = dashpot(&space, &slope, |_| Impedance { normal, tangential }).unwrap();
    let block = damping.get(1, 1).unwrap();
    let (n, t) = (SVector::from([1.0, 2.0]), SVector::from([2.0, -1.0]));
    let half = 5f64.sqrt() / 2.0;
    assert!((block * n - n * (half * normal)).norm() < 1e-14);
    assert!((block * t - t * (half * tangential)).norm() < 1e-14);
    assert_eq!(damping.get(0, 0), Some(&nalgebra::Matrix2::zeros()));
}
