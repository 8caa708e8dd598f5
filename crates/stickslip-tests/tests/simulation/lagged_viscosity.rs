//! Explicit steps lag viscosities that couple vertices: the step limit, the decay of a mode, and the energy that they take.

use nalgebra::{DMatrix, DVector, Vector2};
use stickslip::fem::{
    Assembled, Elastic, Impedance, P1, Viscous, antiplane, dashpot, elasticity_by_cell,
    lumped_mass, lumped_mass_by_cell, viscosity_by_cell,
};
use stickslip::record::EnergyLedger;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Diagonal, Matrix, Operator, Scene, Simulation,
    StepError, Steps,
};

use crate::Outcome;

/// Pseudorandom numbers from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// From `1/factor` to `factor`.
    fn scale(&mut self, factor: f64) -> f64 {
        factor.powf(2.0 * self.next() - 1.0)
    }
}

/// A body of random materials whose lower side is fixed and whose upper side absorbs waves.
struct Body {
    space: P1<2>,
    matrices: [Assembled<2>; 4],
}

impl Body {
    /// With a viscous time of the fastest wave through a cell, times a random factor, in some of the cells.
    fn new(random: &mut Random, damping: f64) -> Outcome<Self> {
        let space = P1::grid([4.0, 2.0], [4, 2])?;
        let count = space.mesh().cell_count();
        let moduli: Vec<f64> = (0..count).map(|_| random.scale(4.0)).collect();
        let densities: Vec<f64> = (0..count).map(|_| random.scale(2.0)).collect();
        let share: Vec<f64> = (0..count).map(|_| random.next()).collect();
        let top = space.trace(|x| x[1] == 2.0)?;
        let impedance = Impedance::of(&elastic(1.0), 1.0)?;
        let matrices = [
            elasticity_by_cell(&space, |_, cell| elastic(moduli[cell]))?,
            lumped_mass_by_cell(&space, |_, cell| densities[cell])?,
            viscosity_by_cell(&space, |_, cell| {
                let time = damping * share[cell] * (densities[cell] / moduli[cell]).sqrt();
                Viscous {
                    shear_viscosity: time * moduli[cell],
                    bulk_viscosity: 2.0 * time * moduli[cell],
                }
            })?,
            dashpot(&space, &top, |_| impedance)?,
        ];
        Ok(Self { space, matrices })
    }

    fn simulation(&self) -> Outcome<Simulation<2>> {
        let [stiffness, mass, viscosity, dashpot] = self.matrices.clone();
        let size = self.space.vertex_count();
        let mut random = Random(7);
        let scene = Scene::new(stiffness)
            .with_mass(mass)
            .with_viscosity(dashpot)
            .with_viscosity(viscosity)
            .fix(&self.space.trace(|x| x[1] == 0.0)?, Components::ALL)
            .with_displacement(self.free(|| Vector2::new(random.next(), random.next())))
            .with_velocity(vec![Vector2::zeros(); size]);
        Ok(Simulation::new(scene, CentralDifferences, Diagonal::new())?)
    }

    /// A field that vanishes on the lower side.
    fn free(&self, mut value: impl FnMut() -> Vector2<f64>) -> Vec<Vector2<f64>> {
        let points = self.space.mesh().vertices().iter();
        points
            .map(|x| value() * f64::from(u8::from(x[1] > 0.0)))
            .collect()
    }

    /// Stiffness, viscosity and dashpots of the free components, scaled by the mass.
    fn scaled(&self) -> [DMatrix<f64>; 3] {
        let points = self.space.mesh().vertices();
        let free: Vec<(usize, usize)> = (0..points.len())
            .filter(|&i| points[i][1] > 0.0)
            .flat_map(|i| [(i, 0), (i, 1)])
            .collect();
        let [stiffness, mass, viscosity, dashpot] = &self.matrices;
        let entry = |matrix: &Assembled<2>, (i, a): (usize, usize), (j, b): (usize, usize)| {
            matrix.get(i, j).map_or(0.0, |block| block[(a, b)])
        };
        [stiffness, viscosity, dashpot].map(|matrix| {
            DMatrix::from_fn(free.len(), free.len(), |r, c| {
                let weights = [free[r], free[c]].map(|at| entry(mass, at, at));
                entry(matrix, free[r], free[c]) / (weights[0] * weights[1]).sqrt()
            })
        })
    }
}

fn elastic(modulus: f64) -> Elastic {
    Elastic {
        young_modulus: modulus,
        poisson_ratio: 0.3,
    }
}

/// The largest modulus of a multiplier of a step: with `w` the velocity of half steps,
/// `(1 + tau D/2) w_1 = (1 - tau D/2 - tau C) w_0 - tau K u` and `u_1 = u + tau w_1`.
fn growth([stiffness, viscosity, dashpot]: &[DMatrix<f64>; 3], tau: f64) -> f64 {
    let n = stiffness.nrows();
    let identity = DMatrix::<f64>::identity(n, n);
    let inverse = (&identity + dashpot * (0.5 * tau))
        .try_inverse()
        .unwrap_or_else(|| DMatrix::zeros(n, n));
    let to_rate = &inverse * (&identity - dashpot * (0.5 * tau) - viscosity * tau);
    let to_way = &inverse * stiffness * -tau;
    let mut step = DMatrix::zeros(2 * n, 2 * n);
    step.view_mut((0, 0), (n, n)).copy_from(&to_rate);
    step.view_mut((0, n), (n, n)).copy_from(&to_way);
    step.view_mut((n, 0), (n, n)).copy_from(&(&to_rate * tau));
    step.view_mut((n, n), (n, n))
        .copy_from(&(&identity + &to_way * tau));
    let values = step.complex_eigenvalues();
    values.iter().map(|value| value.norm()).fold(0.0, f64::max)
}

/// For random bodies, from hardly damped ones to those whose limit is that of viscosity alone: below the limit no
/// multiplier of a step is beyond 1, above it one is; and a run below it decays.
#[test]
fn the_step_limit_is_sharp() -> Outcome {
    let mut random = Random(1);
    for (case, damping) in [1e-3, 0.03, 0.1, 0.3, 1.0, 10.0, 0.2, 0.5]
        .into_iter()
        .enumerate()
    {
        let body = Body::new(&mut random, damping)?;
        let mut simulation = body.simulation()?;
        simulation.step(1e-9)?;
        let limit = simulation.step_limit().ok_or("no limit")?;
        let matrices = body.scaled();
        let [below, above] = [0.999_999, 1.000_001].map(|share| growth(&matrices, share * limit));
        assert!(below < 1.0 && above > 1.0, "{case}: {below}, {above}");
        let Err(failure) = simulation.step(1.01 * limit) else {
            return Err("a step beyond the limit was taken".into());
        };
        assert!(matches!(failure.cause, StepError::Unstable { .. }));
        simulation.run(&Steps::constant(0.99 * limit).count(2000), |_| ())?;
        let at = simulation.snapshot();
        assert!(at.displacement.iter().all(|u| u.amax() < 1.0), "{case}");
    }
    Ok(())
}

/// The mode of the highest frequency of a body whose viscosity is `beta A`. With `x = tau omega`, and `c = beta omega^2`,
/// `u_+ = (2 - tau c - x^2) u - (1 - tau c) u_-`: its amplitude falls by `sqrt(1 - tau c)` in each step, to first order
/// what it should be.
#[test]
fn a_mode_decays_by_its_closed_form() -> Outcome {
    let space = P1::grid([3.0, 1.0], [6, 2])?;
    let stiffness = antiplane(&space, 2.0)?;
    let mass: Assembled<1> = lumped_mass(&space, 1.5)?;
    let size = space.vertex_count();
    let weight = |i: usize| mass.get(i, i).map_or(f64::NAN, |block| block[(0, 0)]);
    let matrix = DMatrix::from_fn(size, size, |i, j| {
        stiffness.get(i, j).map_or(0.0, |block| block[(0, 0)]) / (weight(i) * weight(j)).sqrt()
    });
    let modes = matrix.symmetric_eigen();
    let (number, square) = modes.eigenvalues.argmax();
    let mode: DVector<f64> = modes.eigenvectors.column(number).into();
    let shape: Vec<_> = (0..size)
        .map(|i| nalgebra::Vector1::new(mode[i] / weight(i).sqrt()))
        .collect();
    // A fifth of the critical damping.
    let beta = 2.0 * 0.2 / square.sqrt();
    let viscosity = BlockMatrix::combination(&[(beta, &*stiffness)]);
    let decay = beta * square;
    let end = 3.0 / decay;
    let mut errors = Vec::new();
    for count in [400, 800, 1600] {
        let scene = Scene::new(stiffness.clone())
            .with_mass(mass.clone())
            .with_viscosity(viscosity.clone())
            .with_displacement(shape.clone());
        let mut body = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
        let tau = end / f64::from(count);
        let amplitude = |body: &Simulation<1>| -> f64 {
            let u = body.snapshot().displacement;
            (0..size).map(|i| weight(i) * shape[i][0] * u[i][0]).sum()
        };
        let mut before = amplitude(&body);
        body.step(tau)?;
        let mut now = amplitude(&body);
        let factor = 2.0 - tau * decay - tau * tau * square;
        let form = |u: f64, v: f64| u * u - factor * u * v + (1.0 - tau * decay) * v * v;
        for _ in 1..count {
            let last = form(now, before);
            body.step(tau)?;
            (before, now) = (now, amplitude(&body));
            let ratio = form(now, before) / last;
            assert!((ratio / (1.0 - tau * decay) - 1.0).abs() < 1e-9, "{ratio}");
            let residuals = body.residuals(body.state());
            assert!(residuals.force <= 1e-11 * residuals.force_terms);
        }
        // u'' + c u' + omega^2 u = 0 from rest at 1.
        let damped = (square - 0.25 * decay * decay).sqrt();
        let (sine, cosine) = (damped * end).sin_cos();
        let exact = (-0.5 * decay * end).exp() * (cosine + 0.5 * decay / damped * sine);
        errors.push((now - exact).abs());
    }
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((1.8..2.2).contains(&ratio), "{ratio}");
    }
    Ok(())
}

/// The ledger counts the viscous force that acts, that of the half step before: what each viscosity takes is the sum of
/// its work, and what central differences leave over is of second order.
#[test]
fn the_ledger_counts_the_force_that_acts() -> Outcome {
    let mut random = Random(3);
    let body = Body::new(&mut random, 0.2)?;
    let mut left_over = Vec::new();
    for count in [200, 400, 800] {
        let mut simulation = body.simulation()?;
        let mut ledger = EnergyLedger::new(&simulation.snapshot());
        let tau = 8.0 / f64::from(count);
        let start = simulation.snapshot().displacement.to_vec();
        let size = start.len();
        let product = |n: usize, velocity: &[Vector2<f64>]| {
            let mut force = vec![Vector2::zeros(); size];
            body.matrices[n].multiply_add(1.0, velocity, &mut force);
            force
        };
        let mut displacement = start;
        let mut forces = [3, 2].map(|n| product(n, simulation.snapshot().velocity));
        let mut works = [0.0; 2];
        simulation.run(&Steps::constant(tau).count(count as usize), |at| {
            ledger.record(&at);
            let way: Vec<_> = (at.displacement.iter().zip(&displacement))
                .map(|(new, old)| new - old)
                .collect();
            let half: Vec<_> = way.iter().map(|way| way / tau).collect();
            let now = [product(3, at.velocity), product(2, &half)];
            for (work, (now, then)) in works.iter_mut().zip(now.iter().zip(&forces)) {
                let forces = now.iter().zip(then);
                let terms = forces.zip(&way);
                *work += terms
                    .map(|((now, then), way)| 0.5 * way.dot(&(now + then)))
                    .sum::<f64>();
            }
            forces = now;
            displacement = at.displacement.to_vec();
        })?;
        let balance = ledger.balance(&simulation.snapshot());
        for (found, expected) in ledger.viscosities().iter().zip(works) {
            assert!((found / expected - 1.0).abs() < 1e-9, "{found}, {expected}");
            assert!(*found > 0.05 * balance.viscosity);
        }
        left_over.push(balance.left_over.abs() / balance.viscosity);
    }
    for pair in left_over.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.5..4.5).contains(&ratio), "{left_over:?}");
    }
    Ok(())
}

/// From a state in the middle of a run the same bits follow.
#[test]
fn a_restored_run_goes_on_with_the_same_bits() -> Outcome {
    let body = Body::new(&mut Random(5), 0.3)?;
    let mut whole = body.simulation()?;
    let steps = Steps::constant(0.02);
    whole.run(&steps.clone().count(50), |_| ())?;
    let middle = whole.state().clone();
    whole.run(&steps.clone().count(50), |_| ())?;
    let mut other = body.simulation()?;
    other.restore(&middle)?;
    other.run(&steps.count(50), |_| ())?;
    assert_eq!(whole.state(), other.state());
    Ok(())
}
