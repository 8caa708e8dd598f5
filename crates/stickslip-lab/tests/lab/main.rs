//! Curves and fits of laboratory experiments, against an integration of their own and known parameters.

mod coverage;
mod curves;
mod errors;
mod evolution_fits;
mod evolutions;
mod fits;
mod gauges;
mod guesses;
mod identifiability;
mod interrupts;
mod joint;
mod laws;
mod loads;
mod measured;
mod offsets;
mod optimum;
mod oracle;
mod properties;
mod refusals;
mod transients;
mod units;

use std::error::Error;

use stickslip_friction::DieterichRuina;
use stickslip_lab::{LoadHistory, Parameters, StateParameters};

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// `K/sigma_n` [1/m].
const STIFFNESS: f64 = 1500.0;

fn one_state() -> Parameters {
    let friction = DieterichRuina {
        a: 0.009,
        b: 0.012,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1.2e-5,
    };
    Parameters::one_state(&friction, STIFFNESS)
}

fn two_states() -> Parameters {
    Parameters {
        states: vec![
            StateParameters::steady(0.008, 5e-6),
            StateParameters::steady(0.004, 8e-5),
        ],
        ..one_state()
    }
}

/// Steps up, down and up, and holds of 30 s and 300 s.
fn sequence() -> Outcome<LoadHistory> {
    Ok(LoadHistory::new(
        1e-6,
        &[
            (50.0, 1e-5),
            (90.0, 3e-6),
            (220.0, 3e-5),
            (235.0, 0.0),
            (265.0, 1e-5),
            (305.0, 0.0),
            (605.0, 1e-5),
        ],
    )?)
}

/// A thousand samples of the sequence, denser where the load point is fast.
fn times() -> Vec<f64> {
    let piece = |from: f64, to: f64, count: usize| {
        (0..count).map(move |n| from + (to - from) * n as f64 / count as f64)
    };
    let pieces = [
        (0.0, 50.0, 50),
        (50.0, 90.0, 200),
        (90.0, 220.0, 150),
        (220.0, 235.0, 150),
        (235.0, 265.0, 60),
        (265.0, 305.0, 170),
        (305.0, 605.0, 50),
        (605.0, 650.0, 170),
    ];
    pieces
        .into_iter()
        .flat_map(|(from, to, count)| piece(from, to, count))
        .collect()
}

/// Normally distributed numbers, from a seed.
struct Noise(u64);

impl Noise {
    fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xD1B5_4A32_D192_ED03)
    }

    /// Uniform in (0, 1), by splitmix64.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        ((z >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// By the method of Box and Muller.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }

    fn added_to(mut self, friction: &[f64], deviation: f64) -> Vec<f64> {
        friction
            .iter()
            .map(|mu| mu + deviation * self.normal())
            .collect()
    }
}
