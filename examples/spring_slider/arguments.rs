//! The command line of the spring slider: presets, and a flag for every number in them.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use serde::Serialize;

use crate::common::cli::{non_negative, positive};
use crate::common::state_law::Law;

/// A block of 1 m^2 on a rigid surface, pulled by a spring. Writes history.csv, history.png and
/// summary.json. All numbers are in SI units; what is not given is that of the preset.
#[derive(Debug, Clone, Parser)]
#[command(name = "spring_slider")]
pub(crate) struct Arguments {
    /// The experiment
    #[arg(value_name = "PRESET", default_value = "velocity-step")]
    pub(crate) preset: Preset,
    /// The experiment, as a flag
    #[arg(long = "preset", value_name = "PRESET")]
    pub(crate) preset_flag: Option<Preset>,
    /// How the state evolves
    #[arg(long, default_value = "dieterich")]
    pub(crate) law: Law,
    /// How friction depends on rate and state [default: dieterich-ruina; tresca with --law none]
    #[arg(long)]
    pub(crate) friction: Option<Friction>,
    /// The weight of the rate in the coefficient of friction
    #[arg(long, value_parser = positive)]
    pub(crate) a: Option<f64>,
    /// The weight of the state in the coefficient of friction
    #[arg(long, value_parser = non_negative)]
    pub(crate) b: Option<f64>,
    /// The slip distance over which contacts are renewed [m]
    #[arg(long, default_value_t = 1e-5, value_parser = positive)]
    pub(crate) slip_distance: f64,
    /// The reference velocity [m/s]
    #[arg(long, default_value_t = 1e-6, value_parser = positive)]
    pub(crate) reference_velocity: f64,
    /// The coefficient of friction at the reference velocity
    #[arg(long, default_value_t = 0.6, value_parser = non_negative)]
    pub(crate) reference_friction: f64,
    /// The stiffness of the spring [Pa/m]
    #[arg(long, value_parser = positive)]
    pub(crate) stiffness: Option<f64>,
    /// The normal stress [Pa]
    #[arg(long, default_value_t = 1e6, value_parser = non_negative)]
    pub(crate) normal_stress: f64,
    /// The mass per area [kg/m^2]; 0 is quasi-static
    #[arg(long, default_value_t = 0.0, value_parser = non_negative)]
    pub(crate) mass: f64,
    /// The damping [Pa s/m], such as that by radiation, G/(2 c_s)
    #[arg(long, value_parser = non_negative)]
    pub(crate) damping: Option<f64>,
    /// The velocity of the load point at first [m/s]
    #[arg(long, value_parser = positive)]
    pub(crate) load_velocity: Option<f64>,
    /// The velocity of the load point from --step-at on [m/s]
    #[arg(long, value_name = "VELOCITY", value_parser = non_negative)]
    pub(crate) step_to: Option<f64>,
    /// When the load point changes its velocity [s]
    #[arg(long, value_name = "TIME", value_parser = non_negative)]
    pub(crate) step_at: Option<f64>,
    /// When the load point begins and ends to rest [s]
    #[arg(long, value_name = "START,END", value_parser = interval)]
    pub(crate) hold: Option<(f64, f64)>,
    /// The slip rate at time zero [m/s] [default: the load velocity]
    #[arg(long, value_parser = non_negative)]
    pub(crate) initial_slip_rate: Option<f64>,
    /// The state at time zero [s] [default: that of steady sliding at the load velocity]
    #[arg(long, value_parser = positive)]
    pub(crate) initial_theta: Option<f64>,
    /// A constant time step [s]; without it, and in stick-slip, the step adapts
    #[arg(long, value_parser = positive)]
    pub(crate) dt: Option<f64>,
    /// The local error of ln V and of the state where the step adapts
    #[arg(long, default_value_t = 1e-6, value_parser = positive)]
    pub(crate) tolerance: f64,
    /// The end [s]
    #[arg(long, value_parser = positive)]
    pub(crate) until: Option<f64>,
    /// Write every K-th step to history.csv; the last one always is
    #[arg(long, value_name = "K", default_value = "1")]
    pub(crate) every: NonZeroUsize,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/spring_slider")]
    pub(crate) out: PathBuf,
}

/// The experiments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Preset {
    /// The load point becomes ten times faster: a = 0.005, b = 0.01, K = 1e9 Pa/m, 1 to 10 um/s
    VelocityStep,
    /// The load point rests for 100 s: a = 0.01, b = 0.015, K = 1e9 Pa/m, 10 um/s
    SlideHoldSlide,
    /// The spring has half the critical stiffness: a = 0.01, b = 0.015, damping 5e6 Pa s/m, 1 um/s
    StickSlip,
}

/// The coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Friction {
    /// By rate and state, cut off where it would be negative
    DieterichRuina,
    /// By rate and state, with asinh for the logarithm
    Regularized,
    /// By state alone; constant without one
    Tresca,
}

fn interval(text: &str) -> Result<(f64, f64), String> {
    let (start, end) = text.split_once(',').ok_or("must be START,END")?;
    let (start, end) = (non_negative(start)?, non_negative(end)?);
    if start < end {
        Ok((start, end))
    } else {
        Err("must end after it starts".into())
    }
}
