//! The tables and pictures of the report.

use std::fmt::{Error, Write};

use stickslip::work_precision::observed_order;
use stickslip_cli::cli::Problem;
use stickslip_studies::{Report, Table};

use crate::study::{Reached, Study};
use crate::waves::{self, Waves};

/// The tables of steps before and after an event, with the scenes in each.
pub(crate) const STEPS: [(&str, &[&str]); 2] = [
    ("layer, steps", &["layer"]),
    ("slider, steps", &["slider", "slow slider"]),
];

/// The names of the tables of a scene.
pub(crate) fn names(scene: &str) -> [String; 2] {
    [scene.into(), format!("{scene}, all settings")]
}

/// Replaces the tables, and the pictures in the folder `images` next to that of the report.
pub(crate) fn write(report: &Report, studies: &[Study], waves: &[Waves]) -> Result<(), Problem> {
    let images = report.folder().join("../images");
    std::fs::create_dir_all(&images)
        .map_err(|error| format!("cannot create folder {}: {error}", images.display()))?;
    let mut tables = Vec::new();
    for study in studies {
        study.draw(&images.join(study.picture()))?;
        let texts = [times(study)?, all_settings(study)?];
        let of_study = names(study.name).into_iter().zip(texts);
        tables.extend(of_study.map(|(name, text)| Table { name, text }));
    }
    for (name, scenes) in STEPS {
        let waves = waves.iter().filter(|waves| scenes.contains(&waves.scene));
        let waves: Vec<&Waves> = waves.collect();
        if !waves.is_empty() {
            let (name, text) = (name.into(), waves::table(&waves)?);
            tables.push(Table { name, text });
        }
    }
    report.fill(&tables)
}

/// Run times \[s\] to reach errors.
fn times(study: &Study) -> Result<String, Error> {
    let mut text = String::from("| method |");
    for target in &study.targets {
        write!(text, " {target:.0e} |")?;
    }
    writeln!(text, "\n| --- |{}", " ---: |".repeat(study.targets.len()))?;
    for method in study.methods() {
        write!(text, "| {method} |")?;
        for &target in &study.targets {
            match study.reached(method, target) {
                Reached::In(seconds) => write!(text, " {} |", rounded(seconds))?,
                Reached::AtMost(seconds) => write!(text, " < {} |", rounded(seconds))?,
                Reached::Never => write!(text, " - |")?,
            }
        }
        writeln!(text)?;
    }
    Ok(text)
}

/// The reference, and error and run time of each method at each setting, with its observed order.
fn all_settings(study: &Study) -> Result<String, Error> {
    let mut text = String::from(
        "| method | order | step \\[s\\] or tolerance: error, run time \\[s\\] |\n\
         | --- | ---: | --- |\n",
    );
    writeln!(text, "| reference | | {} |", study.reference)?;
    for method in study.methods() {
        let cells: Vec<String> = study
            .of(method)
            .map(|m| match &m.failure {
                Some(failure) => format!("{:.2e}: {failure}", m.setting),
                None => format!("{:.2e}: {:.1e}, {}", m.setting, m.error, rounded(m.seconds)),
            })
            .collect();
        let order = observed_order(&study.measurements, method);
        let order = order.map_or(String::new(), |order| format!("{order:.1}"));
        writeln!(text, "| {method} | {order} | {} |", cells.join("; "))?;
    }
    Ok(text)
}

/// Two digits: times on a shared machine have no more.
fn rounded(seconds: f64) -> String {
    if seconds < 1e-2 {
        format!("{seconds:.1e}")
    } else {
        let decimals = (1.0 - seconds.log10().floor()).max(0.0) as usize;
        format!("{seconds:.decimals$}")
    }
}
