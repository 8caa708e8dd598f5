//! Growth rates of slip between two materials, by rate-and-state friction under the normal stress of the deformation.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector, Vector2};
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity_by_cell};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Components, Condensed, Contact, Newmark, NormalStress, Scene, Simulation, Steps};

use crate::Outcome;

/// The shear moduli above and below, in units of the first; one wave has the length 1 and slips at the rate 1 over L = 1.
const MODULI: [f64; 2] = [1.0, 2.0];
const NU: f64 = 0.25;
const A: f64 = 0.01;
const B: f64 = 0.015;
const F: f64 = 0.6;
/// The height of each side: waves decay to `exp(-2 k H) = 6.5e-9`.
const HEIGHT: f64 = 1.5;

/// `G^` and Dundurs' `beta`: slip `D sin(k x)` takes the shear stress `tau = G^ k D` and changes the normal stress by
/// `-beta tau cos(k x)`.
fn interface() -> [f64; 2] {
    let [upper, lower] = MODULI;
    let beta = 0.5 * (1.0 - 2.0 * NU) * (upper - lower) / ((1.0 - NU) * (upper + lower));
    let compliance = (1.0 - NU) * (1.0 / upper + 1.0 / lower);
    [1.0 / (compliance * (1.0 - beta * beta)), beta]
}

/// The rates of growth of a wave `exp(i k x)` of slip, in units of V/L, at a share of the critical wave number: with
/// the change of the normal stress, `-i beta tau`,
///
/// ```text
/// a P^2 + (a - b + kappa c) P + kappa c = 0,     kappa = G^ k L/sigma,     c = 1 - i f beta
/// ```
fn exact(share: f64) -> [Complex<f64>; 2] {
    let stiffness = Complex::new(1.0, -F * interface()[1]) * (share * (B - A));
    let half = (stiffness + (A - B)) / (2.0 * A);
    let root = (half * half - stiffness / A).sqrt();
    in_order([-half + root, -half - root])
}

fn in_order(mut roots: [Complex<f64>; 2]) -> [Complex<f64>; 2] {
    roots.sort_by(|p, q| p.im.total_cmp(&q.im));
    roots
}

/// Two layers that slide along an interface of `n` cells at the rate 1, but for the state of one wave.
fn growth(share: f64, n: usize) -> Outcome<[Complex<f64>; 2]> {
    let grid = Mesh::<2>::grid([1.0, 2.0], [n, 2 * n], GridDiagonal::Rising)?;
    // Cells that grow with the distance from the interface.
    let stretched = |y: f64| HEIGHT * (3.0 * y).sinh() / 3_f64.sinh();
    let points = (grid.vertices().iter()).map(|x| Vector2::new(x[0], stretched(x[1] - 1.0)));
    let cells = grid.cells().flatten().copied().collect();
    let mesh = Mesh::new(points.collect(), cells)?.with_surface_where("fault", |x| x[1] == 0.0)?;
    let space = P1::new(mesh.split("fault")?);
    let rock = |x: &Vector2<f64>, _| Elastic {
        young_modulus: 2.0 * (1.0 + NU) * MODULI[usize::from(x[1] < 0.0)],
        poisson_ratio: NU,
    };
    let edge = |axis: usize, at: f64| space.trace(move |x| (x[axis] - at).abs() < 1e-9);
    let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);

    let normal_stress = interface()[0] * TAU / (share * (B - A));
    let law = RegularizedDieterichRuina {
        a: A,
        b: B,
        reference_friction: F,
        reference_velocity: 1.0,
        slip_distance: 1.0,
    };
    let states = plus.map(|x| LogTheta(1e-4 * (TAU * x[0]).cos()));
    let contact = Contact::between(&plus, &minus, law, NormalStress::from_body(normal_stress))
        .with_state(Dieterich { slip_distance: 1.0 }, states)
        .with_shear_stress(Vector2::new(F * normal_stress, 0.0));
    let sliding = (space.mesh().vertices().iter().enumerate()).map(|(p, x)| {
        let below = x[1] < 0.0 || minus.vertices().binary_search(&p).is_ok();
        Vector2::new(if below { -0.5 } else { 0.5 }, 0.0)
    });
    let scene = Scene::new(elasticity_by_cell(&space, rock)?)
        .with_periodic(&edge(0, 0.0)?, &edge(0, 1.0)?)
        .prescribe_velocity(&edge(1, HEIGHT)?, Components::ALL, |_| [0.5, 0.0])
        .prescribe_velocity(&edge(1, -HEIGHT)?, Components::ALL, |_| [-0.5, 0.0])
        .with_velocity(sliding.collect())
        .with_balanced_rates()
        .with_contact(contact);
    let mut body = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let mut wave = Vec::new();
    // Two samples a unit of time.
    let every = n / 2;
    body.run(&Steps::constant(1.0 / n as f64).count(16 * every), |at| {
        if at.step % every == 0 {
            let fault = at.contact(0);
            let turn = |k: usize| Complex::new(0.0, -TAU * fault.point(k)[0]).exp();
            let terms = (0..fault.len()).map(|k| turn(k) * fault.slip_rate(k));
            wave.push(terms.sum::<Complex<f64>>() / fault.len() as f64);
        }
    })?;
    roots_of(&wave, 0.5)
}

/// The rates of the two exponentials of which samples consist (Prony): the roots of their linear recurrence.
fn roots_of(samples: &[Complex<f64>], interval: f64) -> Outcome<[Complex<f64>; 2]> {
    let rows = samples.len() - 2;
    let before = DMatrix::from_fn(rows, 2, |k, c| samples[k + c]);
    let after = DVector::from_fn(rows, |k, _| samples[k + 2]);
    let solution = before.svd(true, true).solve(&after, 0.0)?;
    let (product, sum) = (-solution[0], solution[1]);
    let root = (sum * sum / 4.0 - product).sqrt();
    let rates = [sum / 2.0 + root, sum / 2.0 - root].map(|z| z.ln() / interval);
    Ok(in_order(rates))
}

/// The errors of both roots fall with the square of the cells and steps, towards rates that are known to six digits.
#[test]
fn growth_rates_between_two_materials() -> Outcome {
    // Roots of the quadratic by an independent program.
    for (share, independent) in [
        (0.25, Complex::new(0.203981, -0.304388)),
        (0.5, Complex::new(0.144347, -0.492914)),
        (0.9, Complex::new(0.047917, -0.685914)),
    ] {
        let exact = exact(share);
        assert!((exact[0] - independent).norm() < 1e-6, "{exact:?}");
        let [coarse, fine] = [growth(share, 16)?, growth(share, 32)?];
        for k in 0..2 {
            let error = |rate: Complex<f64>| (rate - exact[k]).norm() / exact[k].norm();
            let limit = fine[k] + (fine[k] - coarse[k]) / 3.0;
            let [coarse, fine, limit] = [coarse[k], fine[k], limit].map(error);
            let order = (coarse / fine).log2();
            assert!((order - 2.0).abs() < 0.15, "order {order} at {share}");
            assert!(fine < 0.004, "{fine:e} at {share}");
            // The limit of both by Richardson's extrapolation.
            assert!(limit < 5e-4, "{limit:e} at {share}");
        }
    }
    Ok(())
}
