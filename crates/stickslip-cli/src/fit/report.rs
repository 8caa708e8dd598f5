//! Fits as tables, pictures and JSON.

use serde_json::{Value, json};
use stickslip::lab::{Errors, Estimate, Fitted, Healing, LabError, Parameter};

use super::settings::{Job, Unread};
use crate::cli::Problem;
use crate::output::{Cell, Output, number};
use crate::plot::{self, DARK, PALE, Panel};

pub(super) const TABLE: &str = "fits.csv";
pub(super) const SUMMARY: &str = "summary.json";
pub(super) const HOLDS: &str = "holds.csv";

/// The parameters with columns in the batch table, in this order.
fn parameters(fits: &[Result<Fitted, LabError>]) -> Vec<Parameter> {
    let estimates = fits.iter().flatten().flat_map(|fitted| &fitted.estimates);
    let mut found = Vec::new();
    for estimate in estimates {
        if !found.contains(&estimate.parameter) {
            found.push(estimate.parameter);
        }
    }
    found
}

/// Writes the batch table: a row per file and window, and one per file that cannot be fitted.
pub(super) fn table(
    output: &Output,
    jobs: &[Job],
    fits: &[Result<Fitted, LabError>],
    unread: &[Unread],
) -> Result<(), Problem> {
    let parameters = parameters(fits);
    let mut columns = String::from("file,from,to,samples,laws");
    for parameter in &parameters {
        columns += &format!(",{parameter},{parameter}_error");
    }
    columns += ",a_minus_b,a_minus_b_error,rms,aic,interrupted,warnings,error";
    let rows = jobs.iter().zip(fits).map(|(job, fit)| {
        let times = job.record.times();
        let (from, to) = job.window.unwrap_or((times[0], times[times.len() - 1]));
        let mut row: Vec<Cell> = vec![
            job.file.as_str().into(),
            number(from),
            number(to),
            times.len().to_string().into(),
        ];
        match fit {
            Ok(fitted) => {
                row.push(fitted.laws.join("+").into());
                for &parameter in &parameters {
                    row.push(number(fitted.value(parameter)));
                    row.push(number(fitted.standard_error(parameter)));
                }
                let (difference, error) = fitted.a_minus_b;
                row.extend([difference, error, fitted.rms, fitted.aic].map(number));
                let warnings = fitted.warnings.iter().map(ToString::to_string);
                let warnings: Vec<_> = job.note().into_iter().chain(warnings).collect();
                row.push(fitted.interrupted.to_string().into());
                row.extend([warnings.join("; "), String::new()].map(Cell::from));
            }
            Err(error) => {
                row.push("".into());
                row.extend(vec![number(f64::NAN); 2 * parameters.len() + 4]);
                let interrupted = *error == LabError::Interrupted;
                row.push(interrupted.to_string().into());
                row.extend([String::new(), error.to_string()].map(Cell::from));
            }
        }
        row
    });
    let others = unread.iter().map(|unread| {
        let mut row: Vec<Cell> = ["NaN", "NaN", "0", ""].map(Cell::from).into();
        row.insert(0, unread.file.as_str().into());
        row.extend(vec![number(f64::NAN); 2 * parameters.len() + 4]);
        row.extend(["false", "", unread.error.as_str()].map(Cell::from));
        row
    });
    output.table(TABLE, &columns, rows.chain(others))
}

/// A fit in JSON.
pub(super) fn summary(job: &Job, fit: &Result<Fitted, LabError>) -> Value {
    let fitted = match fit {
        Ok(fitted) => fitted,
        Err(error) => {
            return json!({"file": job.file, "window": job.window, "error": error.to_string()});
        }
    };
    let estimate = |estimate: &Estimate| {
        json!({
            "parameter": estimate.parameter.to_string(),
            "value": estimate.value,
            "standard_error": estimate.standard_error,
        })
    };
    let correlation = fitted.correlation.row_iter().map(|row| {
        let row: Vec<f64> = row.iter().copied().collect();
        row
    });
    let warnings: Vec<_> = fitted.warnings.iter().map(ToString::to_string).collect();
    let spikes = fitted
        .spikes
        .iter()
        .map(|spike| [spike.time, spike.residual]);
    let errors = match fitted.errors {
        Errors::Correlated => "correlated",
        _ => "independent",
    };
    json!({
        "file": job.file,
        "window": job.window,
        "samples": fitted.residuals.len(),
        "dropped_rows": job.dropped,
        "interrupted": fitted.interrupted,
        "laws": fitted.laws,
        "load_point": fitted.load,
        "reference_velocity": fitted.parameters.reference_velocity,
        "stiffness": fitted.parameters.stiffness,
        "parameters": fitted.estimates.iter().map(estimate).collect::<Vec<_>>(),
        "correlation": correlation.collect::<Vec<_>>(),
        "a_minus_b": {"value": fitted.a_minus_b.0, "standard_error": fitted.a_minus_b.1},
        "rms": fitted.rms,
        "deviation": fitted.deviation,
        "aic": fitted.aic,
        "standard_errors": errors,
        "lag_one": fitted.lag_one,
        "effective_samples": fitted.effective_samples,
        "spikes": spikes.collect::<Vec<_>>(),
        "warnings": warnings,
        "integrations": fitted.work.integrations,
    })
}

/// Writes data, model and residuals as a table and a picture, over the displacement of the load point.
pub(super) fn curve(
    output: &Output,
    name: &str,
    job: &Job,
    fitted: &Fitted,
) -> Result<(), Problem> {
    let times = job.record.times();
    let displacements: Vec<f64> = times.iter().map(|&t| job.load.displacement(t)).collect();
    let data = job.record.friction();
    let rows = (0..times.len()).map(|n| {
        let (model, residual) = (fitted.friction[n], fitted.residuals[n]);
        [times[n], displacements[n], data[n], model, residual].map(number)
    });
    let columns = "time,displacement,friction,model,residual";
    output.table(&format!("{name}.csv"), columns, rows)?;
    // Holds have a time and no displacement.
    let holds = job.load.has_hold(times[0], times[times.len() - 1]);
    let (axis, unit, places) = if holds {
        ("time [s]", 1.0, times)
    } else {
        ("load-point displacement [µm]", 1e6, &displacements[..])
    };
    let points = |values: &[f64], factor: f64| -> plot::Points {
        let points = places.iter().zip(values);
        points.map(|(x, y)| (unit * x, factor * y)).collect()
    };
    let panels = [
        Panel::new(axis, "coefficient of friction")
            .with_points("data", PALE, points(data, 1.0))
            .with("fit", DARK, 3, points(&fitted.friction, 1.0)),
        Panel::new(axis, "residual [10⁻³]").with_points("", DARK, points(&fitted.residuals, 1e3)),
    ];
    plot::draw(&output.path(&format!("{name}.png")), &panels)
}

/// Writes the holds.
pub(super) fn write_holds(output: &Output, found: &[(String, Healing)]) -> Result<(), Problem> {
    let rows = found.iter().flat_map(|(file, healing)| {
        healing.holds.iter().map(move |hold| {
            let numbers = [
                hold.start,
                hold.duration,
                hold.level,
                hold.relaxed,
                hold.peak,
                hold.healing(),
            ];
            let mut row: Vec<Cell> = vec![file.as_str().into()];
            row.extend(numbers.map(number));
            row
        })
    });
    output.table(
        HOLDS,
        "file,start,duration,level,relaxed,peak,healing",
        rows,
    )
}

/// Prints the holds and their healing rate.
pub(super) fn print_holds(found: &[(String, Healing)]) -> Result<(), Problem> {
    for (file, healing) in found {
        say!("{file}: {} holds", healing.holds.len())?;
        for hold in &healing.holds {
            say!(
                "  {:10.4e} s: peak {:.5}, healing {:.5}, relaxation {:.5}",
                hold.duration,
                hold.peak,
                hold.healing(),
                hold.relaxation()
            )?;
        }
        // Three holds have an error.
        let error = if healing.standard_error.is_finite() {
            format!(", standard error {:.5}", healing.standard_error)
        } else {
            String::new()
        };
        say!("  healing rate {:.5} per decade{error}", healing.rate)?;
    }
    Ok(())
}
