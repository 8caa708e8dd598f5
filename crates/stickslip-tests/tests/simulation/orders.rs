//! Orders in time, seen alone: against the exact solution in time of the same finite elements.

use nalgebra::{DMatrix, SMatrix, Vector1, Vector2};
use stickslip::fem::{Assembled, P1, elasticity, mass};
use stickslip::friction::{FrictionError, FrictionLaw};
use stickslip::time::QuasiStatic;
use stickslip::{
    BackwardEuler, BlockMatrix, BoundaryPart, Components, Contact, GeneralizedAlpha, Newmark,
    Point, RateScheme, Scene, Simulation, Steps, Tnnmg,
};

use crate::Outcome;
use crate::common::{body, distance};

/// A body held at its top, and one of its standing waves `mode cos(frequency t)`.
struct StandingWave {
    space: P1<2>,
    stiffness: Assembled<2>,
    mass: Assembled<2>,
    frequency: f64,
    mode: Vec<Vector2<f64>>,
}

impl StandingWave {
    /// The mode of number `k` of the matrices themselves, so that space has no error.
    fn new(k: usize) -> Outcome<Self> {
        let space = P1::grid([2.0, 1.0], [2, 1])?.refined(1)?;
        let (stiffness, mass) = (elasticity(&space, &body(1).elastic)?, mass(&space, 5e3)?);
        let points = space.mesh().vertices();
        let free: Vec<usize> = (0..points.len()).filter(|&p| points[p][1] < 1.0).collect();
        let dense = |matrix: &BlockMatrix<2>| {
            DMatrix::from_fn(2 * free.len(), 2 * free.len(), |i, j| {
                matrix
                    .get(free[i / 2], free[j / 2])
                    .map_or(0.0, |block| block[(i % 2, j % 2)])
            })
        };
        let factor = dense(&mass).cholesky().ok_or("mass not positive")?.l();
        let inverse = factor.try_inverse().ok_or("factor not invertible")?;
        let eigen = (&inverse * dense(&stiffness) * inverse.transpose()).symmetric_eigen();
        let mut order: Vec<usize> = (0..2 * free.len()).collect();
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let values = inverse.transpose() * eigen.eigenvectors.column(order[k]);
        let largest = values.amax();
        let mut mode = vec![Vector2::zeros(); points.len()];
        for (i, &p) in free.iter().enumerate() {
            mode[p] = Vector2::new(values[2 * i], values[2 * i + 1]) / largest;
        }
        let frequency = eigen.eigenvalues[order[k]].sqrt();
        Ok(Self {
            space,
            stiffness,
            mass,
            frequency,
            mode,
        })
    }

    fn scaled(&self, factor: f64) -> Vec<Vector2<f64>> {
        self.mode.iter().map(|v| v * factor).collect()
    }

    /// Displacement and velocity over frequency after a number of steps of `dt`.
    fn swing(
        &self,
        scheme: impl RateScheme + 'static,
        steps: usize,
        dt: f64,
    ) -> Outcome<[Vec<Vector2<f64>>; 2]> {
        let top = self.space.trace(|x| x[1] == 1.0)?;
        let scene = Scene::new(self.stiffness.clone())
            .with_mass(self.mass.clone())
            .fix(&top, Components::ALL)
            .with_displacement(self.scaled(1.0));
        let solver = Tnnmg::new(self.space.transfers());
        let mut body = Simulation::new(scene, scheme, solver)?.with_absolute_tolerance(1e-12)?;
        body.run(&Steps::constant(dt).count(steps), |_| ())?;
        let at = body.snapshot();
        let velocity = at.velocity.iter().map(|v| v / self.frequency).collect();
        Ok([at.displacement.to_vec(), velocity])
    }

    /// The distance from the exact wave at 1.3 rad, in displacement and velocity.
    fn error(&self, scheme: impl RateScheme + 'static, steps: usize) -> Outcome<[f64; 2]> {
        const ANGLE: f64 = 1.3;
        let dt = ANGLE / self.frequency / steps as f64;
        let [displacement, velocity] = self.swing(scheme, steps, dt)?;
        Ok([
            distance(&displacement, &self.scaled(ANGLE.cos())),
            distance(&velocity, &self.scaled(-ANGLE.sin())),
        ])
    }
}

/// `log2` of the quotients of successive errors.
fn orders(errors: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    errors
        .windows(2)
        .flat_map(|pair| [0, 1].map(|c| (pair[0][c] / pair[1][c]).log2()))
}

#[test]
fn newmark_is_of_second_order() -> Outcome {
    let wave = StandingWave::new(2)?;
    let mut errors = Vec::new();
    for steps in [16, 32, 64, 128] {
        errors.push(wave.error(Newmark::default(), steps)?);
    }
    for order in orders(&errors) {
        assert!((order - 2.0).abs() < 0.05, "{errors:?}");
    }
    Ok(())
}

#[test]
fn generalised_alpha_is_of_second_order_whatever_it_damps() -> Outcome {
    let wave = StandingWave::new(2)?;
    for spectral_radius in [0.0, 0.5, 0.9] {
        let mut errors = Vec::new();
        for steps in [64, 128, 256, 512] {
            errors.push(wave.error(GeneralizedAlpha { spectral_radius }, steps)?);
        }
        for order in orders(&errors) {
            assert!((order - 2.0).abs() < 0.1, "{spectral_radius}: {errors:?}");
        }
    }
    Ok(())
}

/// A prescribed velocity with a kink, at which a step ends, leads where its integral does.
#[test]
fn generalised_alpha_follows_a_prescribed_velocity_past_a_kink() -> Outcome {
    let slider = body(1);
    let space = slider.space()?;
    let top = space.trace(|x| x[1] == 1.0)?;
    for spectral_radius in [0.0, 0.8] {
        let scene = Scene::new(elasticity(&space, &slider.elastic)?)
            .with_mass(mass(&space, slider.density)?)
            .prescribe_velocity(&top, Components::ALL, |time: f64| [time.min(1.0), 0.0]);
        let solver = Tnnmg::new(space.transfers());
        let scheme = GeneralizedAlpha { spectral_radius };
        let mut body = Simulation::new(scene, scheme, solver)?;
        body.run(&Steps::constant(0.25).count(8), |_| ())?;
        let moved = body.snapshot().displacement[top.vertices()[0]][0];
        assert!((moved - 1.5).abs() < 1e-14, "{moved}");
    }
    Ok(())
}

#[test]
fn newmark_with_numerical_damping_is_of_first_order() -> Outcome {
    let wave = StandingWave::new(2)?;
    let damped = Newmark {
        beta: 0.3025,
        gamma: 0.6,
    };
    let mut errors = Vec::new();
    for steps in [128, 256, 512] {
        errors.push(wave.error(damped, steps)?);
    }
    for order in orders(&errors) {
        assert!((order - 1.0).abs() < 0.05, "{errors:?}");
    }
    Ok(())
}

#[test]
fn backward_euler_is_of_first_order() -> Outcome {
    let wave = StandingWave::new(2)?;
    let mut errors = Vec::new();
    for steps in [128, 256, 512] {
        errors.push(wave.error(BackwardEuler, steps)?);
    }
    for order in orders(&errors) {
        assert!((order - 1.0).abs() < 0.05, "{errors:?}");
    }
    Ok(())
}

/// A mode stays a mode, and the schemes turn it by known angles and factors: Newmark by
/// `2 atan(w dt/2)` a step, backward Euler `u + i v/w` by the factor `1/(1 + i w dt)`.
#[test]
fn modes_follow_the_closed_forms_of_the_schemes() -> Outcome {
    const STEPS: usize = 100;
    for k in [0, 3, 11] {
        let wave = StandingWave::new(k)?;
        let dt = 0.7 / wave.frequency;
        let angle = STEPS as f64 * 2.0 * 0.35_f64.atan();
        let [displacement, velocity] = wave.swing(Newmark::default(), STEPS, dt)?;
        assert!(distance(&displacement, &wave.scaled(angle.cos())) < 1e-10);
        assert!(distance(&velocity, &wave.scaled(-angle.sin())) < 1e-10);

        let angle = 10.0 * 0.7_f64.atan();
        let factor = (1.0 + 0.7_f64 * 0.7).powf(-5.0);
        let [displacement, velocity] = wave.swing(BackwardEuler, 10, dt)?;
        assert!(distance(&displacement, &wave.scaled(factor * angle.cos())) < 1e-10);
        assert!(distance(&velocity, &wave.scaled(-factor * angle.sin())) < 1e-10);
    }
    Ok(())
}

/// A viscous bed, `mu = V/V1`.
#[derive(Debug, Clone, Copy)]
struct Viscous {
    rate_at_one: f64,
}

impl FrictionLaw for Viscous {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        slip_rate / self.rate_at_one
    }

    fn coefficient_rate_slope(&self, _slip_rate: f64, (): ()) -> f64 {
        1.0 / self.rate_at_one
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        0.5 * slip_rate * slip_rate / self.rate_at_one
    }

    fn validate(&self) -> Result<(), FrictionError> {
        FrictionError::check_positive("rate_at_one", self.rate_at_one)
    }
}

/// A spring on a viscous bed under a growing load: `k u + eta u' = k t`, so that
/// `u = t - s + s exp(-t/s)` with `s = eta/k`.
fn creep(scheme: impl RateScheme + 'static, steps: usize) -> Outcome<[f64; 2]> {
    const STIFFNESS: f64 = 2.0;
    const VISCOSITY: f64 = 0.8;
    const END: f64 = 1.0;
    let friction = Viscous {
        rate_at_one: 1.0 / VISCOSITY,
    };
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(STIFFNESS))
        .with_contact(Contact::new(BoundaryPart::point(1.0), friction, 1.0))
        .with_load_history(|time, load| load[0] = Vector1::new(STIFFNESS * time));
    let mut slider = Simulation::new(scene, scheme, Point)?;
    slider.run(&Steps::constant(END / steps as f64).count(steps), |_| ())?;
    let at = slider.snapshot();
    assert!(at.acceleration.is_empty());
    let scale: f64 = VISCOSITY / STIFFNESS;
    let left = (-END / scale).exp();
    Ok([
        (at.displacement[0][0] - (END - scale + scale * left)).abs(),
        (at.velocity[0][0] - (1.0 - left)).abs(),
    ])
}

#[test]
fn quasi_static_schemes_keep_their_orders() -> Outcome {
    let (mut second, mut first, mut wrapped) = (Vec::new(), Vec::new(), Vec::new());
    for steps in [32, 64, 128, 256] {
        second.push(creep(Newmark::default(), steps)?);
        first.push(creep(BackwardEuler, 4 * steps)?);
        wrapped.push(creep(QuasiStatic(Newmark::default()), steps)?);
    }
    assert!(
        orders(&second).all(|p| (p - 2.0).abs() < 0.05),
        "{second:?}"
    );
    assert!(orders(&first).all(|p| (p - 1.0).abs() < 0.05), "{first:?}");
    assert_eq!(second, wrapped);
    let damped = GeneralizedAlpha {
        spectral_radius: 0.0,
    };
    let mut alpha = Vec::new();
    for steps in [32, 64, 128, 256] {
        alpha.push(creep(damped, steps)?);
    }
    assert!(orders(&alpha).all(|p| (p - 2.0).abs() < 0.1), "{alpha:?}");
    Ok(())
}
