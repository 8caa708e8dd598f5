//! The command line of the spring slider: presets, and a flag for each of their numbers.

use std::num::NonZeroUsize;

use crate::cli::{Problem, count, non_negative, positive};
use crate::laws::{Friction, Law, Laws};
use crate::output::Files;
use clap::{Parser, ValueEnum};
use serde::Serialize;
use stickslip::Steps;
use stickslip::friction::DieterichRuina;
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};

/// A block of 1 m^2 on a rigid surface, pulled by a spring. Writes history.csv, history.png and summary.json. All
/// numbers are in SI units; those of the preset are the defaults.
#[derive(Debug, Clone, PartialEq, Parser)]
#[command(name = "spring_slider")]
pub struct Arguments {
    /// The experiment
    #[arg(
        value_name = "PRESET",
        default_value = "velocity-step",
        conflicts_with = "preset_flag"
    )]
    preset: Preset,
    /// The experiment, as a flag
    #[arg(long = "preset", value_name = "PRESET")]
    preset_flag: Option<Preset>,
    /// The state law
    #[arg(long, default_value = "dieterich")]
    pub law: Law,
    /// The friction law [default: dieterich-ruina; tresca with --law none]
    #[arg(long)]
    friction: Option<Friction>,
    /// The coefficient a of the direct effect
    #[arg(long, value_parser = positive)]
    a: Option<f64>,
    /// The coefficient b of the evolution effect
    #[arg(long, value_parser = non_negative)]
    b: Option<f64>,
    /// The characteristic slip distance [m]
    #[arg(long, default_value_t = 1e-5, value_parser = positive)]
    slip_distance: f64,
    /// The reference velocity [m/s]
    #[arg(long, default_value_t = 1e-6, value_parser = positive)]
    reference_velocity: f64,
    /// The coefficient of friction at the reference velocity
    #[arg(long, default_value_t = 0.6, value_parser = non_negative)]
    reference_friction: f64,
    /// The stiffness of the spring [Pa/m]
    #[arg(long, value_parser = positive)]
    stiffness: Option<f64>,
    /// The normal stress [Pa]
    #[arg(long, default_value_t = 1e6, value_parser = non_negative)]
    normal_stress: f64,
    /// The mass per area [kg/m^2]; 0 is quasi-static
    #[arg(long, default_value_t = 0.0, value_parser = non_negative)]
    mass: f64,
    /// The damping [Pa s/m], such as radiation damping, G/(2 c_s)
    #[arg(long, value_parser = non_negative)]
    damping: Option<f64>,
    /// The initial velocity of the load point [m/s]
    #[arg(long, value_parser = positive)]
    load_velocity: Option<f64>,
    /// The velocity of the load point from --step-at on [m/s]
    #[arg(long, value_name = "VELOCITY", value_parser = non_negative)]
    step_to: Option<f64>,
    /// The time of the velocity step of the load point [s]
    #[arg(long, value_name = "TIME", value_parser = non_negative)]
    step_at: Option<f64>,
    /// The begin and the end of a hold of the load point [s]
    #[arg(long, value_name = "START,END", value_parser = interval)]
    hold: Option<(f64, f64)>,
    /// The slip rate at time zero [m/s] [default: the load velocity]
    #[arg(long, value_parser = non_negative)]
    initial_slip_rate: Option<f64>,
    /// The state at time zero [s] [default: that of steady sliding at the load velocity]
    #[arg(long, value_parser = positive)]
    pub initial_theta: Option<f64>,
    /// A constant time step [s] of Newmark's method instead of steps that adapt
    #[arg(long, value_parser = positive, conflicts_with_all = ["tolerance", "max_step"])]
    dt: Option<f64>,
    /// The largest step that adapts [s] [default: a 2000th of the run, with which curves are smooth and extremes are met]
    #[arg(long, value_name = "TIME", value_parser = positive)]
    max_step: Option<f64>,
    /// The local error of ln V and of the state in a step that adapts
    #[arg(long, default_value_t = 1e-6, value_parser = positive)]
    pub tolerance: f64,
    /// The end [s]
    #[arg(long, value_parser = positive)]
    until: Option<f64>,
    /// Write every K-th step to history.csv; the last one always is [default: as many as make 20000 to 40000 rows, all of
    /// fewer]
    #[arg(long, value_name = "K", value_parser = count)]
    pub every: Option<NonZeroUsize>,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// The experiments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// The load point becomes ten times faster: a = 0.005, b = 0.01, K = 1e9 Pa/m, 1 to 10 um/s
    VelocityStep,
    /// The load point rests for 100 s: a = 0.01, b = 0.015, K = 1e9 Pa/m, 10 um/s
    SlideHoldSlide,
    /// The spring has half the critical stiffness: a = 0.01, b = 0.015, damping 5e6 Pa s/m, 1 um/s
    StickSlip,
}

fn interval(text: &str) -> Result<(f64, f64), String> {
    let (start, end) = text.split_once(',').ok_or("must be START,END")?;
    let (start, end) = (non_negative(start)?, non_negative(end)?);
    let ordered = (start < end).then_some((start, end));
    ordered.ok_or_else(|| "must end after it starts".into())
}

/// The least number of steps that adapt.
const SAMPLES: f64 = 2000.0;
/// A time and the coefficient of friction in the default setting at that time, a second after the step, as published
/// with another code.
pub(super) const PUBLISHED: (f64, f64) = (11.0, 0.607_204_85);

/// The experiment by the flags and the preset.
pub struct Experiment {
    /// The experiment by name.
    pub preset: Preset,
    /// Friction and state.
    pub laws: Laws,
    /// The block, its spring and the load.
    pub slider: SpringSlider,
    /// The slip rate at the beginning [m/s].
    pub initial_slip_rate: f64,
    /// The step size [s]; adaptive without one.
    pub step_size: Option<f64>,
    /// The local error of ln V and of the state in an adaptive run.
    pub tolerance: f64,
    /// The steps, constant or adaptive.
    pub steps: Steps,
    /// The end \[s\].
    pub until: f64,
}

impl Arguments {
    /// Whether the physics and the steps are those of an empty command line.
    pub fn is_default(&self) -> bool {
        let default = Self::parse_from(["spring_slider"]);
        *self
            == Self {
                until: self.until,
                every: self.every,
                files: self.files.clone(),
                ..default
            }
    }

    /// The experiment of preset and flags.
    pub fn experiment(&self) -> Result<Experiment, Problem> {
        let preset = self.preset_flag.unwrap_or(self.preset);
        let [step, hold, soft] = [
            Preset::VelocityStep,
            Preset::SlideHoldSlide,
            Preset::StickSlip,
        ]
        .map(|other| other == preset);
        let (a, b) = if step { (0.005, 0.01) } else { (0.01, 0.015) };
        let parameters = DieterichRuina {
            a: self.a.unwrap_or(a),
            b: self.b.unwrap_or(b),
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
        };
        let load_velocity = self.load_velocity.unwrap_or(if hold { 1e-5 } else { 1e-6 });
        let mut load = LoadPath::steady(load_velocity);
        let mut until = if soft { 1200.0 } else { 40.0 };
        if step || self.step_to.is_some() || self.step_at.is_some() {
            let time = self.step_at.unwrap_or(10.0);
            load = load.then(time, self.step_to.unwrap_or(10.0 * load_velocity));
            until = f64::max(until, 4.0 * time);
        }
        if let Some((start, end)) = self.hold.or(hold.then_some((20.0, 120.0))) {
            let velocity = load.velocity(end);
            load = load.then(start, 0.0).then(end, velocity);
            until = f64::max(until, end + 40.0);
        }
        let until = self.until.unwrap_or(until);
        let DieterichRuina { a, b, .. } = parameters;
        let critical = (b - a) * self.normal_stress / self.slip_distance;
        let step_size = self.dt;
        if let Some(dt) = step_size.filter(|&dt| dt > until) {
            return Err(
                format!("--dt {dt} is longer than the run of {until} s: see --until").into(),
            );
        }
        let steps = match step_size {
            Some(dt) => Steps::constant(dt).count((until / dt).round().max(1.0) as usize),
            None => Steps::adaptive(self.tolerance)
                .with_max_step(self.max_step.unwrap_or(until / SAMPLES))
                .with_max_steps(2_000_000)
                .stopping_at(load.kinks().chain(self.is_default().then_some(PUBLISHED.0)))
                .until(until),
        };
        // Steady sliding on a soft spring is an equilibrium that nothing would ever leave.
        let disturbance = if soft { 1.01 } else { 1.0 };
        Ok(Experiment {
            preset,
            laws: Laws::new(Some(self.law), self.friction, parameters)?,
            slider: SpringSlider {
                stiffness: self
                    .stiffness
                    .unwrap_or(if soft { 0.5 * critical } else { 1e9 }),
                normal_stress: self.normal_stress,
                mass: self.mass,
                damping: self.damping.unwrap_or(if soft { 5e6 } else { 0.0 }),
                load,
            },
            initial_slip_rate: self
                .initial_slip_rate
                .unwrap_or(disturbance * load_velocity),
            step_size,
            tolerance: self.tolerance,
            steps,
            until,
        })
    }
}
