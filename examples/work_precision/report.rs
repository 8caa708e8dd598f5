//! The report: what was measured, and what is concluded.

use std::fmt::Write;
use std::path::Path;

use stickslip::Measurement;

use crate::common::cli::Problem;
use crate::conclusions::conclusions;
use crate::study::{Effort, Reached, Study};
use crate::waves::{self, Waves};

/// Writes the report, and its pictures to the folder `images` next to its own.
pub(crate) fn write(
    file: &Path,
    studies: &[Study],
    waves: &[Waves],
    own: &[Measurement],
    effort: Effort,
) -> Result<(), Problem> {
    let folder = file.parent().unwrap_or(Path::new("."));
    let images = folder.join("../images");
    for path in [folder, &images] {
        std::fs::create_dir_all(path)
            .map_err(|error| format!("cannot create folder {}: {error}", path.display()))?;
    }
    let mut text = introduction(effort)?;
    text += &conclusions(studies, waves)?;
    for study in studies {
        study.draw(&images.join(study.picture()))?;
        text += &section(study)?;
    }
    if !waves.is_empty() {
        text += &waves::table(waves)?;
    }
    text += &own_scene(own)?;
    std::fs::write(file, text)
        .map_err(|error| format!("cannot write {}: {error}", file.display()).into())
}

fn introduction(effort: Effort) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    writeln!(
        text,
        "# Error against run time\n\n\
         Written by `cargo run --release --example work_precision -- --report \
         docs/reports/work-precision.md`.\n\n\
         Each method solves a scene at several step sizes or tolerances. Its error is the distance of \
         one number, mostly the time of the first event, from a reference; its time is the whole run, \
         assembly and factorisation included, the median of {}, on two cores shared with other work. \
         Ratios matter, not seconds. Where not stated otherwise the velocity problems are solved by \
         `Condensed` and the steps are constant.\n",
        effort.runs
    )?;
    Ok(text)
}

fn section(study: &Study) -> Result<String, std::fmt::Error> {
    let mut text = format!(
        "## {}\n\n{}.\n\n![{}](../images/{})\n\n",
        capital(study.name),
        capital(&study.title),
        study.error,
        study.picture()
    );
    write!(
        text,
        "Run time in seconds to reach an {}:\n\n| method |",
        study.error
    )?;
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
    writeln!(
        text,
        "\n`<`: the error of the cheapest setting is smaller already. `-`: not reached by the settings \
         measured:\n\n| method | step \\[s\\] or tolerance: error, run time \\[s\\] |\n| --- | --- |"
    )?;
    for method in study.methods() {
        let cells: Vec<String> = study
            .of(method)
            .map(|m| match &m.failure {
                Some(failure) => format!("{:.2e}: {failure}", m.setting),
                None => format!("{:.2e}: {:.1e}, {}", m.setting, m.error, rounded(m.seconds)),
            })
            .collect();
        writeln!(text, "| {method} | {} |", cells.join("; "))?;
    }
    writeln!(text)?;
    Ok(text)
}

fn own_scene(own: &[Measurement]) -> Result<String, std::fmt::Error> {
    let source = include_str!("own_scene.rs");
    let body = source
        .find("pub(crate) fn")
        .map_or(source, |k| &source[k..]);
    let mut text = format!(
        "## A scene of your own\n\n\
         A body, its reference and two methods; this function is part of the program that wrote this \
         page.\n\n```rust,ignore\n{body}```\n\n\
         | method | step \\[s\\] | error of the displacement of a corner \\[m\\] | run time \\[s\\] |\n\
         | --- | ---: | ---: | ---: |\n"
    );
    for m in own {
        let seconds = rounded(m.seconds);
        writeln!(
            text,
            "| {} | {:.0e} | {:.1e} | {seconds} |",
            m.method, m.setting, m.error
        )?;
    }
    Ok(text)
}

/// Two digits: times on a shared machine have no more.
pub(crate) fn rounded(seconds: f64) -> String {
    if seconds < 1e-2 {
        format!("{seconds:.1e}")
    } else {
        let decimals = (1.0 - seconds.log10().floor()).max(0.0) as usize;
        format!("{seconds:.decimals$}")
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}
