//! Local steps of a matrix of one's own: every number of levels that is accepted loses no force, and others are refused.

use nalgebra::{SMatrix, SVector, Vector1};
use proptest::prelude::*;
use stickslip::solvers::{
    Energy, MOST_LEVELS, Matrix, Operator, SolveError, SolveReport, Stopping,
};
use stickslip::{CentralDifferences, NonsmoothSolver, Scene, SceneError, Simulation, Steps};

/// A spring or a damper of one vertex that acts in the last of so many levels.
#[derive(Clone, Copy)]
struct Slow {
    value: f64,
    levels: usize,
}

impl Matrix<1> for Slow {
    fn vertex_count(&self) -> usize {
        1
    }

    fn product_at(&self, _: usize, x: &[SVector<f64, 1>]) -> SVector<f64, 1> {
        x[0] * self.value
    }

    fn diagonal_block(&self, _: usize) -> SMatrix<f64, 1, 1> {
        Vector1::new(self.value)
    }

    fn levels(&self) -> usize {
        self.levels
    }

    fn level_at(&self, _: usize) -> usize {
        self.levels - 1
    }

    fn multiply_add_levels(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, 1>],
        y: &mut [SVector<f64, 1>],
    ) {
        let weight = weights.get(self.levels - 1).copied().unwrap_or_default();
        y[0] += x[0] * (self.value * scale * weight);
    }
}

impl Operator<1> for Slow {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn add_to_diagonal(&mut self, _: usize, block: &SMatrix<f64, 1, 1>) {
        self.value += block[0];
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms = || terms.iter().copied().chain(mass);
        Self {
            value: terms().map(|(factor, term)| factor * term.value).sum(),
            levels: terms().map(|(_, term)| term.levels).max().unwrap_or(1),
        }
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        *self = Self::combination_with(terms, mass);
    }
}

struct One;

impl NonsmoothSolver<Slow, 1> for One {
    fn minimize(
        &mut self,
        energy: &Energy<'_, Slow, 1>,
        _: &Stopping<'_, Slow>,
        v: &mut [SVector<f64, 1>],
    ) -> Result<SolveReport, SolveError> {
        v[0] = energy.load[0] / energy.operator.value;
        Ok(SolveReport::default())
    }
}

/// A mass that is pulled from rest against a spring, with levels of the spring and of a damper if there is one.
fn oscillator(
    [spring, damper]: [Option<usize>; 2],
    [mass, stiffness, pull]: [f64; 3],
) -> Result<Simulation<1>, SceneError> {
    let slow = |value, levels: Option<usize>| Slow {
        value,
        levels: levels.unwrap_or(1),
    };
    let scene = Scene::new(slow(stiffness, spring))
        .with_mass(slow(mass, None))
        .with_displacement(vec![Vector1::new(pull)])
        .with_velocity(vec![Vector1::zeros()]);
    let scene = match damper {
        Some(_) => scene.with_viscosity(slow(0.01, damper)),
        None => scene,
    };
    Simulation::new(scene, CentralDifferences, One)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A cycle is a step of central differences: `u = (1 - (omega h)^2/2) u_0` after `h = 2^(levels - 1) dt`.
    #[test]
    fn a_cycle_is_a_step(
        levels in 1..=MOST_LEVELS,
        mass in 0.1..10.0_f64,
        stiffness in 0.1..10.0_f64,
        pull in prop_oneof![-2.0..-0.5_f64, 0.5..2.0_f64],
        angle in 0.01..1.9_f64,
    ) {
        let mut body = oscillator([Some(levels), None], [mass, stiffness, pull]).expect("levels");
        let steps = 1 << (levels - 1);
        let step = angle / (stiffness / mass).sqrt();
        body.run(&Steps::constant(step / steps as f64).count(steps), |_| ()).expect("stable");
        let expected = pull * (1.0 - 0.5 * angle * angle);
        let found = body.snapshot().displacement[0][0];
        prop_assert!((found - expected).abs() < 1e-9 * pull.abs(), "{found} {expected}");
        let rate = -0.5 * step * stiffness / mass * (pull + expected);
        let found = body.snapshot().velocity[0][0];
        prop_assert!((found - rate).abs() < 1e-9 * (pull / step).abs(), "{found} {rate}");
    }

    #[test]
    fn other_numbers_of_levels_are_refused(
        levels in prop_oneof![Just(0), Just(MOST_LEVELS + 1), MOST_LEVELS + 1..=usize::MAX],
        viscous: bool,
    ) {
        let (all, what) = if viscous {
            ([None, Some(levels)], "viscosity")
        } else {
            ([Some(levels), None], "stiffness")
        };
        let refused = oscillator(all, [1.0; 3]).err();
        prop_assert_eq!(refused, Some(SceneError::Levels { what, levels }));
    }
}
