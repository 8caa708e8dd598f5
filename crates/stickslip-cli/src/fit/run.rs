//! Fits of rate- and state-dependent friction to measured velocity steps and holds.
//!
//! ```text
//! stickslip fit steps.csv --columns time,friction --steps 0:1e-6,100:1e-5,150:1e-6 --stiffness 1500
//! stickslip fit soft.csv stiff.csv --joint --stiffness 900,4000
//! stickslip fit run.csv --law slip --states 2 --window 0:600 --window 600:1200 --detrend displacement
//! ```

use stickslip::lab::Healing;

use super::Arguments;
use super::fits::{Fits, validate};
use super::report::{HOLDS, SUMMARY, TABLE, curve, print_holds, table, write_holds};
use super::settings::Unread;
use crate::cli::Problem;

/// Fits all files and windows.
///
/// # Errors
/// In one line: a wrong setting or table, a fit that fails or is interrupted, a file that cannot be written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let laws = arguments.laws()?;
    let (mut jobs, mut unread) = arguments.jobs()?;
    let fit = arguments.fit(&laws);
    validate(arguments, &fit, &mut jobs, &mut unread)?;
    let mut holds = Vec::new();
    for job in jobs.iter().filter(|_| arguments.holds) {
        match Healing::of(&job.record, &job.load) {
            Ok(healing) => holds.push((job.name(), healing)),
            Err(error) if arguments.files.len() == 1 => {
                return Err(format!("{}: {error}", job.name()).into());
            }
            Err(error) => unread.push(Unread::of(job, &error)),
        }
    }
    if jobs.is_empty() || arguments.files.len() == 1 {
        // Nothing is left to fit, or nothing else was asked for: no folder for an error alone.
        if let Some(first) = unread.first() {
            return Err(first.error.clone().into());
        }
    }
    let output = arguments.output.create("fit", &[TABLE, SUMMARY])?;
    let fits = Fits::new(arguments, &fit, &jobs)?;
    for (number, (job, fitted)) in jobs.iter().zip(&fits.each).enumerate() {
        if let Ok(fitted) = fitted {
            curve(&output, &format!("fit-{}", number + 1), job, fitted)?;
        }
    }
    table(&output, &jobs, &fits.each, &unread)?;
    output.json(SUMMARY, &fits.summary(&jobs, &unread))?;
    let mut written = vec![TABLE, SUMMARY, "fit-N.csv", "fit-N.png"];
    if arguments.holds {
        write_holds(&output, &holds)?;
        written.push(HOLDS);
    }
    fits.print(&jobs)?;
    if arguments.holds {
        say!("")?;
        print_holds(&holds)?;
    }
    say!("{}", output.told(&written))?;
    fits.check_interrupt()?;
    let failed = (jobs.iter().zip(&fits.each))
        .filter_map(|(job, fit)| Some(format!("{}: {}", job.name(), fit.as_ref().err()?)));
    let failed: Vec<String> = failed
        .chain(unread.iter().map(|unread| unread.error.clone()))
        .collect();
    let count = fits.each.len() + unread.len();
    match &failed[..] {
        [] => Ok(()),
        [error] if count == 1 => Err(error.clone().into()),
        [error, ..] => {
            Err(format!("{} of {count} fits failed, first {error}", failed.len()).into())
        }
    }
}
