//! What a simulation of a point claims, tested; only checkpoints need a feature of the crate.

mod adaptive;
mod bridging;
#[cfg(feature = "serde")]
mod checkpoint;
mod continuation;
mod contracts;
mod convexity;
mod fitted_laws;
mod normal_stress_effect;
mod runs;
mod spring;
mod spring_slider;
mod tension;
mod velocity_step;
mod weakening;

/// What a test returns that builds scenes and takes steps.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;
