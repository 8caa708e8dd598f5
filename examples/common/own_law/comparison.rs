//! A law of one's own and one of the library's, side by side.

use serde::Serialize;
use stickslip::problems::FRICTION;

use super::Trial;
use super::runs::{Sliding, VelocityStep, steady_coefficient};
use crate::common::cli::Problem;
use crate::common::output::Output;

/// The file that a comparison is written to.
pub(crate) const SUMMARY: &str = "summary.json";

/// Both laws in numbers: s, m, m/s.
#[derive(Serialize)]
pub(crate) struct Comparison {
    /// The names of the laws, one's own first.
    laws: [&'static str; 2],
    /// Whether one's own keeps its contract.
    conformance: &'static str,
    /// The coefficient of friction of steady sliding after the velocity step, exact.
    steady_exact: f64,
    velocity_step: [VelocityStep; 2],
    slider: [Sliding; 2],
}

impl Comparison {
    /// Of a law that keeps its contract, and of one that has the same steady state.
    pub(crate) fn new(own: Trial, known: Trial) -> Self {
        Self {
            laws: [own.name, known.name],
            conformance: "passed",
            steady_exact: steady_coefficient(&FRICTION),
            velocity_step: [own.velocity_step, known.velocity_step],
            slider: [own.slider, known.slider],
        }
    }

    /// Writes the summary and prints it.
    pub(crate) fn report(&self, output: &Output) -> Result<(), Problem> {
        output.json(SUMMARY, self)?;
        self.print();
        println!("{SUMMARY} in {}", output.folder().display());
        Ok(())
    }

    /// Prints both columns and their difference.
    fn print(&self) {
        let [own, known] = self.laws;
        println!("{own}: conformance {}", self.conformance);
        println!("{:<30}{own:>18}{known:>18}{:>12}", "", "difference");
        let (step, slider) = (self.velocity_step, self.slider);
        print_row("mu at 1 um/s", step.map(|x| Some(x.before)));
        print_row("  peak after step to 10 um/s", step.map(|x| Some(x.peak)));
        print_row("  1 s later", step.map(|x| Some(x.evolving)));
        print_row("  steady again", step.map(|x| Some(x.steady)));
        println!("{:<30}{:>18.9}", "  exact", self.steady_exact);
        print_row(
            "2D slider: first slip [s]",
            slider.map(|x| x.first_slip_time),
        );
        print_row(
            "  largest slip rate [m/s]",
            slider.map(|x| Some(x.peak_slip_rate)),
        );
        print_row(
            "  displacement at x0 [m]",
            slider.map(|x| Some(x.displacement_end)),
        );
    }
}

fn print_row(what: &str, values: [Option<f64>; 2]) {
    let [own, known] = values.map(|x| x.map_or("none".into(), |x| format!("{x:.9}")));
    let difference = values[0].zip(values[1]).map(|(own, known)| own - known);
    let difference = difference.map_or(String::new(), |x| format!("{x:+.2e}"));
    println!("{what:<30}{own:>18}{known:>18}{difference:>12}");
}
