//! Adaptive steps after an event: undamped waves have to be followed.

use std::fmt::{Error, Write};

use stickslip_cli::cli::Problem;
use stickslip_cli::output::{Output, digits};

use crate::method::{ADAPTIVE, SECOND_ORDER};
use crate::question::{Question, StepCount};
use crate::study::Effort;

/// The number of steps until an event, and after it.
#[derive(Debug, Clone)]
pub(crate) struct Waves {
    pub(crate) scene: &'static str,
    pub(crate) method: &'static str,
    pub(crate) tolerance: f64,
    pub(crate) steps: StepCount,
}

/// Runs to `until` by each adaptive method.
pub(crate) fn measure<const C: usize>(
    scene: &'static str,
    question: &Question<'_, C>,
    until: f64,
    effort: Effort,
) -> Result<Vec<Waves>, Problem> {
    let tolerances = if effort.quick {
        &[1e-2][..]
    } else {
        &[1e-2, 1e-3][..]
    };
    let mut all = Vec::new();
    for (method, scheme) in SECOND_ORDER {
        for &tolerance in tolerances {
            let steps = question.count_steps(ADAPTIVE.by(scheme), tolerance, until)?;
            all.push(Waves {
                scene,
                method,
                tolerance,
                steps,
            });
        }
    }
    Ok(all)
}

pub(crate) fn print(all: &[Waves]) {
    for waves in all {
        let StepCount {
            before,
            after,
            rejected,
            ..
        } = waves.steps;
        println!(
            "  {:<16}{:<20}{:>9.0e}: {before} steps to the first event, {after} after it, \
             {rejected} rejected",
            waves.scene, waves.method, waves.tolerance
        );
    }
}

pub(crate) fn write(all: &[Waves], output: &Output) -> Result<(), Problem> {
    let columns = "scene,method,tolerance,steps_before,span_before,steps_after,span_after,\
                   largest_after,rejected";
    let rows = all.iter().map(|waves| {
        let steps = waves.steps;
        [
            waves.scene.into(),
            waves.method.into(),
            digits(waves.tolerance),
            steps.before.to_string(),
            digits(steps.span_before),
            steps.after.to_string(),
            digits(steps.span_after),
            digits(steps.largest_after),
            steps.rejected.to_string(),
        ]
    });
    output.table("steps.csv", columns, rows)
}

/// The table of the report; steps in s.
pub(crate) fn table(all: &[&Waves]) -> Result<String, Error> {
    let mut text = String::from(
        "| scene | scheme | tolerance | steps to the event | mean | steps after it | mean | \
         largest | rejected |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for waves in all {
        let steps = waves.steps;
        writeln!(
            text,
            "| {} | {} | {:.0e} | {} | {:.1e} | {} | {:.1e} | {:.1e} | {} |",
            waves.scene,
            waves.method,
            waves.tolerance,
            steps.before,
            steps.span_before / steps.before as f64,
            steps.after,
            steps.span_after / steps.after as f64,
            steps.largest_after,
            steps.rejected,
        )?;
    }
    Ok(text)
}
