//! The figures of the paper, and two of our own: their runs and their contents.

mod arguments;
mod converged;
mod experiment;
mod histories;
mod iterations;
mod outcome;
mod queue;
mod rupture;
mod take;
mod velocity_step;
mod work;

pub use arguments::{Arguments, Figure};
pub use experiment::{Experiment, Iteration, Law, Scheme};
pub use outcome::Outcome;
pub use queue::Take;

use serde_json::{Map, Value};

use crate::cli::Problem;
use crate::output::Output;

/// The runs and the drawing of a figure.
trait Drawing {
    /// The runs in the figure.
    fn experiments(&self) -> Vec<Experiment>;

    /// Draws the figure from the outcomes of these runs, in their order. Returns the contents of its summary.
    fn draw(&self, output: &Output, outcomes: &[Outcome]) -> Result<Value, Problem>;
}

impl Figure {
    /// The drawing of a single figure.
    fn drawing(self, quick: bool, finest: bool) -> Option<Box<dyn Drawing>> {
        Some(match self {
            Self::VelocityStep => Box::new(velocity_step::VelocityStep),
            Self::Iterations => Box::new(iterations::Iterations::new(quick, finest)),
            Self::Displacement | Self::Velocity | Self::Damped => {
                Box::new(histories::Histories::new(self, quick))
            }
            Self::Rupture => Box::new(rupture::Rupture { quick }),
            Self::Converged => Box::new(converged::Converged { quick }),
            Self::Work => Box::new(work::Work { quick }),
            Self::All => return None,
        })
    }
}

/// Takes the missing runs of the figures, and draws the figures.
///
/// # Errors
/// In one line: a failed run, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    draw(arguments, &take::take)
}

fn draw(arguments: &Arguments, take: &Take<'_>) -> Result<(), Problem> {
    let Arguments { quick, finest, .. } = *arguments;
    let figures = arguments.figures().into_iter();
    let drawings = figures.filter_map(|f| Some((f.name(), f.drawing(quick, finest)?)));
    let drawings: Vec<_> = drawings.collect();
    let mut experiments = Vec::new();
    for experiment in drawings
        .iter()
        .flat_map(|(_, drawing)| drawing.experiments())
    {
        if !experiments.contains(&experiment) {
            experiments.push(experiment);
        }
    }
    let all = arguments.output()?;
    let runs = all.path("runs");
    let outcomes = queue::work_off(&experiments, &runs, arguments.threads(), take)?;
    let mut summaries = Map::new();
    for (name, drawing) in drawings {
        let output = all.within(&name)?;
        let of = |experiment: &Experiment| {
            let k = experiments.iter().position(|other| other == experiment);
            k.map(|k| outcomes[k].clone())
        };
        let shown: Option<Vec<Outcome>> = drawing.experiments().iter().map(of).collect();
        let shown = shown.ok_or("a run is missing")?;
        let summary = drawing.draw(&output, &shown)?;
        output.json("summary.json", &summary)?;
        say!("figure {name} in {}", output.folder().display())?;
        summaries.insert(name, summary);
    }
    // Of one figure its own numbers, of all of them each one's by its name.
    let summary = match summaries.len() {
        1 => summaries
            .into_iter()
            .next()
            .map_or(Value::Null, |one| one.1),
        _ => Value::Object(summaries),
    };
    all.json("summary.json", &summary)
}
