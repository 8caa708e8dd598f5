//! A law of one's own in two experiments, beside one of the library's: a velocity step of a spring slider, and the
//! paper's 2D slider through its first slip.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use serde::Serialize;
use serde_json::json;
use stickslip::friction::FrictionLaw;
use stickslip::problems::{END, FRICTION, LoadPath, NORMAL_STRESS, Slider, SpringSlider};
use stickslip::state::{Reads, StateLaw};
use stickslip::{
    Condensed, Contact, Events, GeneralizedAlpha, RungeKutta, Simulation, Snapshot, Steps,
};

use crate::cli::{self, Problem, expect};
use crate::output::Output;

/// Two laws in a spring slider and in the paper's 2D slider. Writes summary.json.
#[derive(Debug, Clone, Parser)]
pub struct Arguments {
    /// Uniform refinements of the 2D slider's mesh of ten triangles
    #[arg(long, value_name = "J", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=8))]
    refinements: u8,
    /// Time steps in the 2D slider's whole 15 s, of which it runs through 10.5 s
    #[arg(long, value_name = "N", default_value = "10000")]
    steps: NonZeroUsize,
    /// The folder to write to [default: out and the program's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// The slip rates before and after the velocity step [m/s].
const RATES: [f64; 2] = [1e-6, 1e-5];
/// The slip rate of the 2D slider [m/s] that counts as slip.
const SLIP: f64 = 1e-4;
const SUMMARY: &str = "summary.json";

/// What laws make of both experiments.
pub struct Trial {
    name: &'static str,
    velocity_step: VelocityStep,
    slider: Sliding,
}

/// The coefficient of friction in a velocity step.
#[derive(Clone, Copy, Serialize)]
struct VelocityStep {
    before: f64,
    peak: f64,
    /// One second, a slip of about L, after.
    evolving: f64,
    /// After 100 s, in steady sliding again.
    steady: f64,
}

/// The paper's slider until shortly after its first slip: s, m, m/s.
#[derive(Clone, Copy, Serialize)]
struct Sliding {
    first_slip_time: Option<f64>,
    displacement_end: f64,
    peak_slip_rate: f64,
    fallbacks: usize,
    /// Steps that were split into substeps, since their solution may not be unique.
    bridged: usize,
}

/// Compares two laws, one's own first, which have the same steady friction.
pub fn run(name: &str, trials: impl FnOnce(&Arguments) -> Result<[Trial; 2], Problem>) -> ExitCode {
    cli::run(|arguments: &Arguments| {
        let folder = arguments.out.clone();
        let folder = folder.unwrap_or_else(|| ["out", name].iter().collect());
        let output = Output::create(&folder, &[SUMMARY])?;
        let trials = trials(arguments)?;
        let steady_exact = FRICTION.steady_coefficient(RATES[1]);
        let (steps, sliders) = (
            trials.each_ref().map(|t| t.velocity_step),
            trials.each_ref().map(|t| t.slider),
        );
        let summary = json!({
            "laws": trials.each_ref().map(|trial| trial.name),
            // The laws are checked before they are tried.
            "conformance": "passed",
            "steady_exact": steady_exact,
            "velocity_step": steps,
            "slider": sliders,
        });
        output.json(SUMMARY, &summary)?;
        println!("{:<20}{:>24}{:>24}", "", trials[0].name, trials[1].name);
        for experiment in ["velocity_step", "slider"] {
            let [own, known] = [0, 1].map(|k| summary[experiment][k].as_object());
            for (own, known) in own.into_iter().flatten().zip(known.into_iter().flatten()) {
                println!(
                    "{:<20}{:>24}{:>24}",
                    own.0,
                    own.1.to_string(),
                    known.1.to_string()
                );
            }
        }
        println!("{SUMMARY} in {}", output.folder().display());
        for step in steps {
            expect("steady friction", step.steady, steady_exact, 1e-9)?;
        }
        Ok(())
    })
}

impl Trial {
    /// Both experiments by the same laws, the 2D slider from the state `initial`.
    pub fn run<L, S>(
        name: &'static str,
        (friction, law, initial): (L, S, S::State),
        arguments: &Arguments,
    ) -> Result<Self, Problem>
    where
        L: FrictionLaw + Clone + 'static,
        S: StateLaw + Clone + 'static,
        L::State: Reads<S::State>,
    {
        Ok(Self {
            name,
            velocity_step: velocity_step(friction.clone(), law.clone())?,
            slider: slide(friction, law, initial, arguments)?,
        })
    }

    /// When the 2D slider first slips \[s\].
    pub fn first_slip(&self) -> Result<f64, Problem> {
        Ok(self.slider.first_slip_time.ok_or("it never slips")?)
    }
}

/// A block on a stiff spring that slides steadily at the first rate and is pulled at the second.
fn velocity_step<L, S>(friction: L, law: S) -> Result<VelocityStep, Problem>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let slider = SpringSlider {
        stiffness: 1e10,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 5e6,
        load: LoadPath::steady(RATES[1]),
    };
    let mut block = RungeKutta::new(slider.steady(friction, law, RATES[0])?)?;
    let coefficient = |at: Snapshot<'_, 1>| at.contact(0).coefficient(0);
    let before = coefficient(block.snapshot());
    let mut peak = before;
    let mut slide_until = |time| -> Result<f64, Problem> {
        let steps = Steps::adaptive(1e-8).until(time);
        block.run(&steps, |at| peak = peak.max(coefficient(at)))?;
        Ok(coefficient(block.snapshot()))
    };
    let (evolving, steady) = (slide_until(1.0)?, slide_until(100.0)?);
    Ok(VelocityStep {
        before,
        peak,
        evolving,
        steady,
    })
}

fn slide<L, S>(
    friction: L,
    law: S,
    initial: S::State,
    arguments: &Arguments,
) -> Result<Sliding, Problem>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let body = Slider {
        refinements: arguments.refinements.into(),
        ..Slider::default()
    };
    let space = body.space()?;
    let contact = Contact::new(&Slider::bottom(&space)?, friction, NORMAL_STRESS);
    let scene = body
        .scene(&space)?
        .with_contact(contact.with_state(law, initial));
    let mut simulation = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;

    let centre = Slider::centre(&space).ok_or("the mesh has no vertex at (2.5, 0)")?;
    let mut slips = Events::new(SLIP, SLIP);
    let mut cost = stickslip::Statistics::default();
    let steps = arguments.steps.get() as f64;
    let plan = Steps::constant(END / steps).count((0.7 * steps).ceil() as usize);
    let report = simulation.run(&plan, |at| {
        slips.record(at.time, at.velocity[centre].norm());
        cost.record(&at);
    })?;
    Ok(Sliding {
        first_slip_time: slips.times().first().copied(),
        displacement_end: simulation.snapshot().displacement[centre][0],
        peak_slip_rate: cost.peak_slip_rate,
        fallbacks: cost.fallbacks,
        bridged: report.bridged,
    })
}
