//! The claims of a simulation of a point; checkpoints and faults of many cells need features of the crate.

mod adaptive;
mod arrests;
mod checkpoint;
mod clamping;
mod clock;
mod contracts;
mod convexity;
mod dilatancy;
mod events;
mod explicit_limits;
mod fields;
mod fitted_laws;
mod follows_slip;
mod forced_rupture;
mod friction_cap;
mod halves;
mod healing;
mod jumps;
mod local_problems;
mod many_cells;
mod normal_stress_effect;
mod recurrence;
mod runs;
mod seas;
mod slip_weakening;
mod soft_cells;
mod spring;
mod spring_slider;
mod steady;
mod sticking;
mod strong_weakening;
mod substeps;
mod tension;
mod thermal;
mod uniqueness;
mod velocity_step;
mod weakening;
mod work_precision;

/// The result of a test that builds scenes and takes steps.
type Outcome<T = ()> = Result<T, Box<dyn std::error::Error>>;
