//! The spectral radius of a step.

use super::RateSchemeViolation;
use super::oscillator::Oscillator;
use crate::{Motion, RateScheme};

pub(super) fn check<R: RateScheme + ?Sized>(
    scheme: &R,
    frequency: f64,
    inertia: bool,
) -> Result<(), RateSchemeViolation> {
    let square = frequency * frequency;
    let free = Oscillator {
        mass: if inertia { 1.0 } else { 0.0 },
        damping: if inertia { 0.0 } else { 1.0 },
        stiffness: if inertia { square } else { frequency },
    };
    // The unknowns are u, v/omega, a/omega^2 and what is carried on over omega^2; a step of length
    // one of each gives a column.
    let step = |unit: usize| {
        let one_of = |k: usize| if k == unit { 1.0 } else { 0.0 };
        let from = Motion {
            displacement: one_of(0),
            velocity: frequency * one_of(1),
            acceleration: square * one_of(2),
            algorithmic: square * one_of(3),
        };
        let to = free.step(scheme, from, 0.0, 1.0, |_| 0.0);
        [
            to.displacement,
            to.velocity / frequency,
            to.acceleration / square,
            to.algorithmic / square,
        ]
    };
    let growth = spectral_radius(std::array::from_fn(step));
    if growth <= 1.0 + RADIUS_ERROR {
        Ok(())
    } else {
        Err(RateSchemeViolation {
            property: "stability",
            quantity: "spectral radius of a step of the oscillator",
            at: Some(("omega dt", frequency)),
            value: growth,
            requirement: "at most",
            bound: Some(1.0),
        })
    }
}

/// The accuracy of [`spectral_radius`], with norms of powers up to 1e40 at radius one.
const RADIUS_ERROR: f64 = 1e-7;

/// `norm(A^n)^(1/n)` with `n = 2^30`, by squaring; the matrix is brought to unit size each time.
fn spectral_radius<const N: usize>(mut matrix: [[f64; N]; N]) -> f64 {
    let mut logarithm = 0.0;
    let mut share = 1.0;
    for _ in 0..30 {
        let size = matrix.iter().flatten().fold(0.0_f64, |s, a| s.max(a.abs()));
        if size == 0.0 {
            return 0.0;
        }
        logarithm += share * size.ln();
        share *= 0.5;
        let unit = matrix.map(|column| column.map(|a| a / size));
        matrix = std::array::from_fn(|j| {
            std::array::from_fn(|i| (0..N).map(|k| unit[k][i] * unit[j][k]).sum())
        });
    }
    logarithm.exp()
}
