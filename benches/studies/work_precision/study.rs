//! The measurements of one scene, as a table and as a picture.

use std::path::Path;

use serde::Serialize;
use stickslip::work_precision::{Measurement, seconds_to};
use stickslip_cli::cli::Problem;
use stickslip_cli::output::{Output, digits};
use stickslip_cli::plot::{self, Panel, RGBColor};

/// The measurements of one scene.
pub(crate) struct Study {
    /// In the names of files.
    pub(crate) name: &'static str,
    /// The reference for errors.
    pub(crate) reference: String,
    /// The error, with its unit.
    pub(crate) error: &'static str,
    /// Errors to reach, in the unit of the error.
    pub(crate) targets: Vec<f64>,
    pub(crate) measurements: Vec<Measurement>,
}

/// The extent of the measurements.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    pub(crate) quick: bool,
    pub(crate) runs: usize,
}

impl Effort {
    /// The first two settings only, if it has to be quick.
    pub(crate) fn settings(self, all: &[f64]) -> &[f64] {
        if self.quick {
            &all[..all.len().min(2)]
        } else {
            all
        }
    }
}

/// The time in which a method reaches an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Reached {
    /// Between two of its settings.
    In(f64),
    /// Already at its cheapest setting.
    AtMost(f64),
    Never,
}

impl Study {
    /// The methods, in the order of their first measurement.
    pub(crate) fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for m in &self.measurements {
            if !names.contains(&m.method.as_str()) {
                names.push(&m.method);
            }
        }
        names
    }

    /// The measurements of a method.
    pub(crate) fn of(&self, method: &str) -> impl Iterator<Item = &Measurement> {
        self.measurements.iter().filter(move |m| m.method == method)
    }

    pub(crate) fn reached(&self, method: &str, error: f64) -> Reached {
        let results = self.of(method).filter(|m| m.error.is_finite());
        let cheapest = results.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
        match (cheapest, seconds_to(&self.measurements, method, error)) {
            (Some(first), _) if first.error <= error => Reached::AtMost(first.seconds),
            (_, Some(seconds)) => Reached::In(seconds),
            (_, None) => Reached::Never,
        }
    }

    pub(crate) fn table(&self) -> String {
        format!("{}.csv", self.name)
    }

    pub(crate) fn picture(&self) -> String {
        format!("work-precision-{}.png", self.name)
    }

    pub(crate) fn write(&self, output: &Output) -> Result<(), Problem> {
        let columns = "method,setting,error,seconds,failure";
        let rows = self.measurements.iter().map(|m| {
            [
                m.method.clone(),
                digits(m.setting),
                digits(m.error),
                digits(m.seconds),
                m.failure.clone().unwrap_or_default(),
            ]
        });
        output.table(&self.table(), columns, rows)?;
        self.draw(&output.path(&self.picture()))
    }

    pub(crate) fn draw(&self, path: &Path) -> Result<(), Problem> {
        let panel = Panel::new("run time [s]", self.error).both_logarithmic();
        let methods = self.methods().into_iter().enumerate();
        let panel = methods.fold(panel, |panel, (k, label)| {
            let points = self.of(label).map(|m| (m.seconds, m.error));
            panel.with_dots(label, COLORS[k % COLORS.len()], points.collect())
        });
        plot::draw(path, &[panel])
    }

    pub(crate) fn summary(&self) -> Summary<'_> {
        let rows = self.measurements.iter().map(|m| Row {
            method: &m.method,
            setting: m.setting,
            error: m.error,
            seconds: m.seconds,
            failure: m.failure.as_deref(),
        });
        Summary {
            scene: self.name,
            reference: &self.reference,
            error: self.error,
            measurements: rows.collect(),
        }
    }

    pub(crate) fn print(&self) {
        println!("{}: {}, {}", self.name, self.reference, self.error);
        for m in &self.measurements {
            let note = m.failure.as_deref().unwrap_or("");
            println!(
                "  {:<50}{:>11.2e}{:>11.2e}{:>11.2e} s  {note}",
                m.method, m.setting, m.error, m.seconds
            );
        }
    }
}

/// A scene in numbers.
#[derive(Serialize)]
pub(crate) struct Summary<'a> {
    scene: &'a str,
    reference: &'a str,
    error: &'a str,
    measurements: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    method: &'a str,
    setting: f64,
    error: f64,
    seconds: f64,
    failure: Option<&'a str>,
}

const COLORS: [RGBColor; 14] = [
    RGBColor(240, 150, 60),
    RGBColor(190, 90, 20),
    RGBColor(70, 140, 220),
    RGBColor(25, 70, 140),
    RGBColor(20, 160, 150),
    RGBColor(150, 150, 150),
    RGBColor(140, 90, 190),
    RGBColor(200, 40, 60),
    RGBColor(60, 150, 50),
    RGBColor(150, 200, 70),
    RGBColor(220, 110, 180),
    RGBColor(40, 40, 40),
    RGBColor(240, 200, 40),
    RGBColor(120, 70, 40),
];
