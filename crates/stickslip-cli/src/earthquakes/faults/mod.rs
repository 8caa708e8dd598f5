//! Earthquake cycles on faults of a file, of polylines or triangles: bent, branched or several.

mod arguments;
mod friction;
mod layout;
mod record;
mod surface;

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::json;
use stickslip::bie::{FaultGeometry, OffFault};
use stickslip::nalgebra::Vector1;
use stickslip::problems::bp1::{MEDIUM, PLATE_RATE};
use stickslip::record::{EventCatalogue, VtkFaultSeries};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, SceneError, Snapshot};

pub use arguments::FaultFile;

use super::off_fault::{self, OWN, Plan};
use super::{Arguments, Failed, YEAR, state_for};
use crate::progress::Progress;
use friction::Strengths;
use layout::Layout;
use record::Record;

/// The slip rate at which an event begins [m/s]; it ends at a tenth of it.
const EVENT: f64 = 1e-2;

/// The files of a run, and its pictures on lines and on surfaces.
const FILES: [&str; 4] = ["events.csv", "history.csv", "cells.csv", "summary.json"];
const OF_LINES: [&str; 1] = ["slip_rate_map.png"];
const OF_SURFACES: [&str; 2] = ["slip_rate_surface.png", "slip_per_event.png"];

/// The begin of the names of VTU files.
const SERIES: &str = "fault";

/// Takes the steps, and writes and prints the results.
pub(super) fn run(arguments: &Arguments, path: &Path) -> Result<(), Failed> {
    if layout::has_triangles(path) {
        let fault = layout::triangles(arguments, path)?;
        let cells = Layout::of_triangles(fault.cells());
        let record = Record::of_surface(&cells, fault.cells(), EVENT);
        return run_on(arguments, &fault, &cells, record, |at, base| {
            VtkFaultSeries::of_surface(at, 0, &fault, base)
        });
    }
    let fault = layout::segments(arguments, path)?;
    let cells = Layout::of_segments(fault.cells());
    let record = Record::of_lines(&cells, arguments.end(), EVENT);
    run_on(arguments, &fault, &cells, record, |at, base| {
        VtkFaultSeries::of_segments(at, 0, &fault, base)
    })
}

fn run_on(
    arguments: &Arguments,
    fault: &(impl FaultGeometry<1> + OffFault<1>),
    cells: &Layout,
    mut record: Record<'_>,
    series: impl FnOnce(&Snapshot<'_, 1>, PathBuf) -> Result<VtkFaultSeries, SceneError>,
) -> Result<(), Failed> {
    let settings = &arguments.fault_file;
    let strengths = Strengths::new(settings, cells)?;
    say!("{}", cells.told)?;
    let rate = settings.plate_rate.unwrap_or(PLATE_RATE);
    let mut motion = RungeKutta::new(scene(fault, &strengths, rate)?)?;
    let pictures: &[&str] = if cells.lines.is_empty() {
        &OF_SURFACES
    } else {
        &OF_LINES
    };
    let files = [&FILES[..], pictures].concat();
    let output = arguments.files.create("earthquakes", &files)?;
    let mut series = match settings.vtu_every {
        0 => None,
        every => Some(series(&motion.snapshot(), output.path(SERIES))?.every(every)?),
    };
    // Faults of several pieces have no plane that creeps beyond their cells.
    let plan = Plan {
        sources: fault.sources()?,
        plate: None,
        stations: Vec::new(),
        axes: OWN,
        event: EVENT,
        extent: cells.extent(),
    };
    let folder = output.folder();
    let mut off_fault = off_fault::Record::new(arguments, plan, folder, &motion.snapshot())?;
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
        let followed = off_fault.record(&at);
        match &mut series {
            Some(series) if followed.is_continue() => series.record(&at),
            _ => followed,
        }
    })?;
    drop(progress);
    series.map_or(Ok(()), VtkFaultSeries::finish)?;
    off_fault.finish(&motion.snapshot())?;
    let seconds = clock.elapsed().as_secs_f64();
    // One under way at the end has no arrest.
    let under_way = catalogue.under_way(&motion.snapshot());
    output.events(FILES[0], catalogue.events().iter().chain(&under_way))?;
    record.write(&output, cells, &strengths, [FILES[1], FILES[2]])?;
    let summary = json!({
        "faults": cells.fault_count(),
        "cells": cells.count(),
        "largest_bend_degrees": cells.largest_bend,
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
    output.json(FILES[3], &summary)?;
    record.say()?;
    say!(
        "{} cells, {} steps, {} taken back, {seconds:.1} s; {}",
        cells.count(),
        record.steps(),
        report.rejected + report.failed,
        output.told(&files)
    )?;
    record.draw(&output, pictures)
}

/// The scene of faults that start at the plate rate, under the least ratio of shear to normal stress at which a cell slides
/// steadily.
fn scene<G: FaultGeometry<1>>(
    fault: &G,
    strengths: &Strengths,
    rate: f64,
) -> Result<Scene<G::Kernel, 1>, Failed> {
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
