//! The claims of a simulation of a point; checkpoints and faults of many cells need features of the crate.

mod adaptive;
mod arrests;
#[cfg(feature = "checkpoint")]
mod checkpoint;
mod clamping;
mod clock;
mod contracts;
mod convexity;
mod events;
#[cfg(feature = "bie")]
mod explicit_limits;
mod fitted_laws;
#[cfg(feature = "bie")]
mod follows_slip;
mod forced_rupture;
mod halves;
mod healing;
mod jumps;
#[cfg(feature = "bie")]
mod many_cells;
mod normal_stress_effect;
mod runs;
#[cfg(feature = "bie")]
mod seas;
mod slip_weakening;
#[cfg(feature = "bie")]
mod soft_cells;
mod spring;
mod spring_slider;
mod steady;
mod sticking;
mod substeps;
mod tension;
mod uniqueness;
mod velocity_step;
mod weakening;
mod work_precision;

/// The result of a test that builds scenes and takes steps.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;
