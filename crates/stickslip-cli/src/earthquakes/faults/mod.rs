//! Earthquake cycles on faults of a file: bent, branched or several.

mod arguments;
mod friction;
mod record;

use std::fs::File;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use serde_json::json;
use stickslip::bie::{FaultGeometry, Mode, SegmentFault, Segments};
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1::{MEDIUM, PLATE_RATE};
use stickslip::record::EventCatalogue;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene};

pub use arguments::FaultFile;

use super::bp3::POISSON_RATIO;
use super::{Arguments, Failed, YEAR, state_for};
use crate::progress::Progress;
use friction::Strengths;
use record::Record;

/// The slip rate at which an event begins [m/s]; it ends at a tenth of it.
const EVENT: f64 = 1e-2;

/// The files of a run.
const FILES: [&str; 5] = [
    "events.csv",
    "history.csv",
    "cells.csv",
    "slip_rate_map.png",
    "summary.json",
];

/// Takes the steps, and writes and prints the results.
pub(super) fn run(arguments: &Arguments, path: &Path) -> Result<(), Failed> {
    let settings = &arguments.fault_file;
    let fault = fault(arguments, path)?;
    let cells = fault.cells();
    let strengths = Strengths::new(settings, cells)?;
    say!("{}", told(cells))?;
    let rate = settings.plate_rate.unwrap_or(PLATE_RATE);
    let mut motion = RungeKutta::new(scene(&fault, &strengths, rate)?)?;
    let output = arguments.files.create("earthquakes", &FILES)?;
    let mut record = Record::new(cells, arguments.end(), EVENT);
    let limits = [EVENT, 0.1 * EVENT];
    let mut catalogue =
        EventCatalogue::new(&motion.snapshot(), 0, limits, MEDIUM.shear_modulus, 100)?;
    let (clock, mut progress, end) = (Instant::now(), Progress::default(), arguments.end());
    let report = motion.run(&arguments.steps(), |at| {
        record.see(&at);
        catalogue.record(&at);
        progress.show(at.time / end, || {
            let (years, rate) = (at.time / YEAR, at.max_slip_rate());
            format!("{years:.2} years, step {}, {rate:.1e} m/s", at.step)
        });
        ControlFlow::<()>::Continue(())
    })?;
    drop(progress);
    let seconds = clock.elapsed().as_secs_f64();
    // One under way at the end has no arrest.
    let under_way = catalogue.under_way(&motion.snapshot());
    output.events(FILES[0], catalogue.events().iter().chain(&under_way))?;
    record.write(&output, &fault, &strengths, [FILES[1], FILES[2], FILES[3]])?;
    let summary = json!({
        "faults": cells.fault_count(),
        "cells": cells.count(),
        "mode": if settings.antiplane { "antiplane" } else { "plane strain" },
        "largest_bend_degrees": cells.quality().largest_bend,
        "plate_rate": rate,
        "tolerance": arguments.adaptive,
        "event_times_years": record.events().years(),
        "peak_log10_slip_rate": record.events().each(|event| event.peak),
        "mean_slip_per_event": record.events().each(|event| event.mean_slip),
        "largest_slip": record.largest_slip(),
        "normal_stress_range": record.normal_stress_range(),
        "steps": record.steps(),
        "rejected": report.rejected + report.failed,
        "seconds": seconds,
    });
    output.json(FILES[4], &summary)?;
    record.say()?;
    say!(
        "{} cells, {} steps, {} taken back, {seconds:.1} s; {}",
        cells.count(),
        record.steps(),
        report.rejected + report.failed,
        output.told(&FILES)
    )
}

/// The faults of a table, in cells.
fn fault(arguments: &Arguments, path: &Path) -> Result<SegmentFault, Failed> {
    let name = path.display();
    let file = File::open(path).map_err(|cause| format!("cannot read {name}: {cause}"))?;
    let wrong = |error| Failed::from(format!("{name}: {error}"));
    let lines = Segments::from_csv(file).map_err(wrong)?;
    let cells = lines.divided(arguments.cell()).map_err(wrong)?;
    let mode = if arguments.fault_file.antiplane {
        Mode::Antiplane
    } else {
        Mode::InPlane {
            poisson_ratio: POISSON_RATIO,
        }
    };
    let fault = SegmentFault::half_space(cells, MEDIUM, mode).map_err(wrong)?;
    Ok(fault.with_sense(arguments.sense()))
}

/// What the cells are like, in a line: their extent tells kilometres from metres.
fn told(cells: &Segments) -> String {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for end in (0..cells.count()).flat_map(|cell| cells.ends(cell)) {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(end[k]), high[k].max(end[k]));
        }
    }
    let quality = cells.quality();
    let bend = quality
        .largest_bend_between
        .map_or_else(String::new, |[cell, _]| {
            let bend = quality.largest_bend;
            format!(", largest bend {bend:.2} degrees behind cell {cell}")
        });
    let number = cells.fault_count();
    let faults = if number == 1 { "fault" } else { "faults" };
    let ([x0, z0], [x1, z1]) = (low, high);
    format!(
        "{} cells on {number} {faults}, x from {x0:.1} m to {x1:.1} m, z from {z0:.1} m to {z1:.1} m{bend}",
        cells.count(),
    )
}

/// The scene of faults that start at the plate rate, under the least ratio of shear to normal stress at which a cell slides
/// steadily.
fn scene(
    fault: &SegmentFault,
    strengths: &Strengths,
    rate: f64,
) -> Result<Scene<<SegmentFault as FaultGeometry<1>>::Kernel, 1>, Failed> {
    let Strengths {
        laws,
        normal_stress,
    } = strengths;
    let ratio = strengths.steady_ratio(rate);
    let radiated = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * rate;
    let shear = normal_stress
        .iter()
        .map(|sigma| Vector1::new(ratio * sigma + radiated));
    let states = laws.iter().map(|law| LogTheta(state_for(law, ratio, rate)));
    let evolutions = laws.iter().map(|law| Dieterich {
        slip_distance: law.slip_distance,
    });
    let part = BoundaryPart::from(FaultGeometry::cells(fault));
    let contact = Contact::per_vertex(part, laws.iter().copied(), normal_stress.clone())
        .with_state_per_vertex(evolutions, states.collect::<Vec<_>>())
        .with_shear_stress(shear.collect::<Vec<_>>());
    let plate = Vector1::new(rate);
    Ok(Scene::of_fault(fault, plate)?
        .with_contact(contact)
        .with_velocity(vec![plate; laws.len()]))
}
