//! The command line of a fit.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use stickslip::lab::{Evolution, Loss, Parameter, Trend};

use crate::cli::{finite, non_negative, positive};
use crate::output::Files;
use crate::table::Format;

/// Fit a, b, L, mu0 and the stiffness to measured friction: velocity steps and holds, without a guess. Writes fits.csv,
/// summary.json, and fit-N.csv and fit-N.png for each file and window.
#[derive(Debug, Clone, Parser)]
#[command(name = "fit")]
pub struct Arguments {
    /// Tables with a row per sample, as instruments and spreadsheets write them; separators, decimal commas, encodings,
    /// preambles, units and comments are found
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// The columns, by names or numbers from 1 on: TIME,DISPLACEMENT,FRICTION, or TIME,FRICTION with --steps, or
    /// DISPLACEMENT,FRICTION with --steps-at
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// How tables are read.
    #[command(flatten)]
    pub format: Format,
    /// The velocity of the load point [m/s] from each time [s] on, such as 0:1e-6,100:1e-5,150:0; the first one is the
    /// initial velocity
    #[arg(long, value_name = "TIME:VELOCITY,..", value_delimiter = ',', value_parser = pair, conflicts_with = "steps_at")]
    pub steps: Vec<(f64, f64)>,
    /// The same from each displacement of the load point [m] on
    #[arg(long, value_name = "DISPLACEMENT:VELOCITY,..", value_delimiter = ',', value_parser = pair)]
    pub steps_at: Vec<(f64, f64)>,
    /// The unit of the column of displacements [m]
    #[arg(long, value_name = "METRES", default_value_t = 1.0, value_parser = positive)]
    pub displacement_unit: f64,
    /// The resolution of measured displacements [m]: the history of the load point meets each to within it [default: the
    /// least-squares polygon with as few corners as the noise of the displacements defends]
    #[arg(long, value_name = "METRES", value_parser = non_negative)]
    pub resolution: Option<f64>,
    /// The velocity of the load point before the first sample of measured displacements [m/s] [default: that of the slide
    /// up to the first step]
    #[arg(long, value_name = "VELOCITY", value_parser = positive)]
    pub initial_velocity: Option<f64>,
    /// The state law, or one per state
    #[arg(long, value_delimiter = ',', default_value = "aging")]
    pub law: Vec<Law>,
    /// The number of states [default: one per --law]
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=2))]
    pub states: Option<u8>,
    /// Fit all files and windows at once: they share a, b and L of each state and parameters of state laws; each has its own
    /// stiffness, mu0, trend, step offset and beginning, and counts by its noise
    #[arg(long)]
    pub joint: bool,
    /// The stiffness over the normal stress [1/m], or free; or one per file
    #[arg(long, default_value = "free", value_delimiter = ',', value_parser = stiffness)]
    pub stiffness: Vec<Stiffness>,
    /// The reference velocity V0 [m/s] [default: that of the load point at the first sample]
    #[arg(long, value_name = "VELOCITY", value_parser = positive)]
    pub reference_velocity: Option<f64>,
    /// Fit the samples between these times [s] alone; repeatable
    #[arg(long, value_name = "FROM:TO", value_parser = window)]
    pub window: Vec<(f64, f64)>,
    /// Fit a linear trend, too
    #[arg(long)]
    pub detrend: Option<Detrend>,
    /// The column of weights
    #[arg(long, value_name = "COLUMN")]
    pub weights: Option<String>,
    /// Fit the stress and the state at the first sample; else the block slides steadily there
    #[arg(long)]
    pub free_initial_state: bool,
    /// The loss of residuals: their squares, or that of Huber, which bounds the influence of spikes
    #[arg(long, default_value = "squares")]
    pub loss: LossName,
    /// Fit the time [s] by which all velocity steps are later than --steps or the displacements say, too
    #[arg(long)]
    pub step_offset: bool,
    /// Fit a parameter of a state law, too: Vc1 or Vc2 of kato-tullis, c1 or c2 of nagata; repeatable
    #[arg(long, value_name = "NAME", value_parser = parameter)]
    pub free: Vec<Parameter>,
    /// Fix a parameter, such as a=0.01; repeatable. Parameters are a, b1, b2, L1, L2, k, mu0, trend, step_offset,
    /// Vc1, Vc2, c1, c2, initial_stress, initial_state1 and initial_state2; b, L, Vc and c are those of the first state
    #[arg(long, value_name = "NAME=VALUE", value_parser = fixed)]
    pub fix: Vec<(Parameter, f64)>,
    /// Keep a parameter between two values, such as L1=1e-6:1e-4; repeatable. Parameters are a, b1, b2, L1, L2, k, mu0,
    /// trend, step_offset, Vc1, Vc2, c1, c2, initial_stress, initial_state1 and initial_state2
    #[arg(long, value_name = "NAME=LOW:HIGH", value_parser = bounds)]
    pub bounds: Vec<(Parameter, f64, f64)>,
    /// Start from a value of a parameter, such as L1=5e-5; the other starts are computed from the curve; repeatable
    #[arg(long, value_name = "NAME=VALUE", value_parser = fixed)]
    pub guess: Vec<(Parameter, f64)>,
    /// Write the peaks of slide-hold-slide and the healing rate to holds.csv, too
    #[arg(long)]
    pub holds: bool,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub output: Files,
}

/// The state laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Law {
    /// Dieterich's law
    #[value(alias = "dieterich")]
    Aging,
    /// Ruina's law
    #[value(alias = "ruina")]
    Slip,
    /// The law of Perrin, Rice and Zheng: aging with a square
    PerrinRiceZheng,
    /// The composite law of Kato and Tullis: aging below Vc, 1e-8 m/s unless it is fitted or fixed, slip above
    KatoTullis,
    /// Nagata's law: aging weakened by the rate of stress, with c = 2 unless it is fitted or fixed
    Nagata,
}

impl Law {
    /// The law of a fit.
    pub fn evolution(self) -> Evolution<'static> {
        match self {
            Self::Aging => Evolution::Aging,
            Self::Slip => Evolution::Slip,
            Self::PerrinRiceZheng => Evolution::PerrinRiceZheng,
            Self::KatoTullis => Evolution::KatoTullis,
            Self::Nagata => Evolution::Nagata,
        }
    }
}

/// The losses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LossName {
    /// Squares
    Squares,
    /// Squares up to 1.345 standard deviations, beyond them lines
    Huber,
}

impl LossName {
    /// The loss of a fit.
    pub fn loss(self) -> Loss {
        match self {
            Self::Squares => Loss::Squares,
            Self::Huber => Loss::Huber,
        }
    }
}

/// The trends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Detrend {
    /// Linear in time
    Time,
    /// Linear in the displacement of the load point
    Displacement,
}

impl Detrend {
    /// The trend of a fit.
    pub fn trend(self) -> Trend {
        match self {
            Self::Time => Trend::Time,
            Self::Displacement => Trend::Displacement,
        }
    }
}

/// A stiffness over the normal stress [1/m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stiffness {
    /// Fitted.
    Free,
    /// Known.
    Fixed(f64),
}

fn stiffness(text: &str) -> Result<Stiffness, String> {
    if text == "free" {
        return Ok(Stiffness::Free);
    }
    positive(text)
        .map(Stiffness::Fixed)
        .map_err(|_| "must be `free` or a positive number".into())
}

/// Two finite numbers with a colon between.
fn pair(text: &str) -> Result<(f64, f64), String> {
    let (one, other) = text
        .split_once(':')
        .ok_or("must be two numbers with `:` between")?;
    Ok((finite(one.trim())?, finite(other.trim())?))
}

fn window(text: &str) -> Result<(f64, f64), String> {
    let (from, to) = pair(text)?;
    let ordered = (from < to).then_some((from, to));
    ordered.ok_or_else(|| "must end after it starts".into())
}

fn named(text: &str) -> Result<(Parameter, &str), String> {
    let (name, value) = text.split_once('=').ok_or("must be NAME=VALUE")?;
    Ok((parameter(name)?, value))
}

fn parameter(name: &str) -> Result<Parameter, String> {
    let parameter = name.parse::<Parameter>();
    parameter.map_err(|error| error.to_string())
}

/// A value of a parameter, positive for a, L, k, Vc and c.
fn of_sign(parameter: Parameter, value: f64) -> Result<f64, String> {
    use Parameter::{A, AgingVelocity, SlipDistance, Stiffness, StressWeight};
    let positive = matches!(
        parameter,
        A | Stiffness | SlipDistance(_) | AgingVelocity(_) | StressWeight(_)
    );
    if positive && value <= 0.0 {
        return Err(format!("{parameter} must be positive"));
    }
    Ok(value)
}

fn fixed(text: &str) -> Result<(Parameter, f64), String> {
    let (parameter, value) = named(text)?;
    Ok((parameter, of_sign(parameter, finite(value)?)?))
}

fn bounds(text: &str) -> Result<(Parameter, f64, f64), String> {
    let (parameter, value) = named(text)?;
    let (low, high) = pair(value)?;
    if low > high {
        return Err("must be LOW:HIGH, the low one first".into());
    }
    Ok((parameter, of_sign(parameter, low)?, high))
}
