//! Fits of rate- and state-dependent friction to measured velocity steps and holds.
//!
//! ```text
//! stickslip fit steps.csv --columns time,friction --steps 0:1e-6,100:1e-5,150:1e-6 --stiffness 1500
//! stickslip fit run.csv --law slip --states 2 --window 0:600 --window 600:1200 --detrend displacement
//! ```

use stickslip::lab::Healing;

use super::Arguments;
use super::report::{HOLDS, SUMMARY, TABLE, curve, healing, summary, table};
use super::settings::Job;
use crate::cli::Problem;
use crate::output::Output;

/// Fits all files and windows.
///
/// # Errors
/// In one line: a wrong setting or table, a fit that fails, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let laws = arguments.laws()?;
    let jobs = arguments.jobs()?;
    let fit = arguments.fit(&laws);
    for job in &jobs {
        (fit.validate(&job.record, &job.load))
            .map_err(|error| format!("{}: {error}", job.name()))?;
    }
    let holds = if arguments.holds {
        let of = |job: &Job| -> Result<(String, Healing), Problem> {
            let healing = Healing::of(&job.record, &job.load);
            Ok((
                job.name(),
                healing.map_err(|error| format!("{}: {error}", job.name()))?,
            ))
        };
        jobs.iter().map(of).collect::<Result<Vec<_>, _>>()?
    } else {
        Vec::new()
    };
    let output = Output::create(&arguments.out, &[TABLE, SUMMARY])?;
    let fits: Vec<_> = jobs
        .iter()
        .map(|job| fit.run(&job.record, &job.load))
        .collect();
    for (number, (job, fitted)) in jobs.iter().zip(&fits).enumerate() {
        if let Ok(fitted) = fitted {
            if jobs.len() > 1 {
                println!("\n{}. {}", number + 1, job.name());
            }
            println!("{fitted}");
            curve(&output, &format!("fit-{}", number + 1), job, fitted)?;
        }
    }
    table(&output, &jobs, &fits)?;
    let summaries = jobs.iter().zip(&fits).map(|(job, fit)| summary(job, fit));
    output.json(SUMMARY, &summaries.collect::<Vec<_>>())?;
    let mut written = vec![TABLE, SUMMARY, "fit-N.csv", "fit-N.png"];
    if arguments.holds {
        println!();
        healing(&output, &holds)?;
        written.push(HOLDS);
    }
    println!("{} in {}", written.join(", "), output.folder().display());
    let failed: Vec<_> = (jobs.iter().zip(&fits))
        .filter_map(|(job, fit)| Some((job.name(), fit.as_ref().err()?)))
        .collect();
    let count = fits.len();
    match &failed[..] {
        [] => Ok(()),
        [(name, error)] if count == 1 => Err(format!("{name}: {error}").into()),
        [(name, error), ..] => Err(format!(
            "{} of {count} fits failed, first {name}: {error}",
            failed.len()
        )
        .into()),
    }
}
