//! The record of a run on a mesh of Gmsh, and its report.

use serde_json::json;
use stickslip::fem::{Elastic, P1, stress};
use stickslip::integrate::RunReport;
use stickslip::nalgebra::SVector;
use stickslip::problems::pipping_slider::END;
use stickslip::{Simulation, StepFailure, Steps};

use super::Arguments;
use super::faults::Fault;
use crate::cli::{Problem, expect};
use crate::output::number;
use crate::plot::{self, DARK, Panel};
use crate::probes::Probes;
use crate::progress::Progress;
use crate::slider::RECORDING;

const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// A run: its history at a vertex, its end, and the contacts there.
pub(super) struct Run<const D: usize> {
    probes: Probes<D, 5>,
    end: Result<RunReport, StepFailure>,
    /// The largest number of iterations for the normal stress in a step, and the largest contraction of these.
    iterations: usize,
    contraction: f64,
    /// The largest strain at the end, and the middle of its cell \[m\].
    strain: (f64, SVector<f64, D>),
    /// Positions and slips, positions and normal stresses of the vertices of each contact.
    contacts: Vec<[Vec<Vec<f64>>; 3]>,
}

/// Takes the steps, and records the vertex of the first contact nearest to a position, along a direction: time,
/// displacement, velocity, state, and the largest slip rate anywhere. Between two sides of a fault displacement and
/// velocity are slip and slip rate.
pub(super) fn take<const D: usize>(
    arguments: &Arguments,
    simulation: &mut Simulation<D>,
    (space, faults): (&P1<D>, &[Fault<D>]),
    place: SVector<f64, D>,
    direction: SVector<f64, D>,
) -> Result<Run<D>, Problem> {
    let inside = faults[0].minus.is_some();
    let distance = |place: &SVector<f64, D>, point: [f64; 3]| {
        (SVector::from_fn(|c, _| point[c]) - place).norm()
    };
    let mut probes = Probes::new(&simulation.snapshot(), [place], distance, move |at, k| {
        let contact = at.contact(0);
        let vertex = contact.vertex(k);
        let (displacement, velocity) = if inside {
            (contact.slip_vector(k), contact.slip_velocity(k))
        } else {
            (at.displacement[vertex], at.velocity[vertex])
        };
        let (displacement, rate) = (displacement.dot(&direction), velocity.dot(&direction));
        let largest = at.max_slip_rate();
        [at.time, displacement, rate, contact.state(k), largest]
    });
    let plan = Steps::constant(END / arguments.steps() as f64);
    let (mut iterations, mut contraction) = (0, 0.0_f64);
    let (last, mut progress) = (arguments.end(), Progress::default());
    let bar = (&mut progress, last);
    let end = probes.run(simulation, &plan.until(last), bar, |at| {
        iterations = iterations.max(at.report.reaction_iterations);
        contraction = contraction.max(at.report.contraction);
    });
    let at = simulation.snapshot();
    let contacts = faults.iter().enumerate();
    Ok(Run {
        strain: largest_strain(space, at.displacement)?,
        contacts: contacts.map(|(k, fault)| fault.rows(&at, k)).collect(),
        probes,
        end,
        iterations,
        contraction,
    })
}

/// The largest component of the strain of a displacement, and the middle of its cell \[m\]: the stress of a material of
/// unit modulus without lateral contraction.
fn largest_strain<const D: usize>(
    space: &P1<D>,
    displacement: &[SVector<f64, D>],
) -> Result<(f64, SVector<f64, D>), Problem> {
    let unit = Elastic {
        young_modulus: 1.0,
        poisson_ratio: 0.0,
    };
    let strains = stress(space, &unit, displacement)?;
    let largest = (strains.iter().map(|strain| strain.amax()).enumerate())
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default();
    let mesh = space.mesh();
    let corners = mesh.cells().nth(largest.0).unwrap_or_default();
    let places = corners.iter().map(|&p| mesh.vertices()[p as usize]);
    Ok((largest.1, places.sum::<SVector<f64, D>>() / (D + 1) as f64))
}

/// The strain above which linear elasticity is warned of.
const SMALL: f64 = 0.1;

/// Warns of a strain for which linear elasticity is no model, with the numbers that it can come from.
fn warn_of_strain<const D: usize>(
    arguments: &Arguments,
    space: &P1<D>,
    (strain, place): (f64, SVector<f64, D>),
) {
    if strain <= SMALL {
        return;
    }
    let vertices = space.mesh().vertices();
    let end = |pick: fn(f64, f64) -> f64, from: f64| {
        let start = SVector::<f64, D>::repeat(from);
        (vertices.iter()).fold(start, |end, x| end.zip_map(x, pick))
    };
    let size = end(f64::max, f64::NEG_INFINITY) - end(f64::min, f64::INFINITY);
    note!(
        "warning: the largest strain is {strain:.3}, at {:.4?} m, and linear elasticity is for small ones: Young's modulus \
         is {:e} Pa (--young-modulus), the mesh extends over {:.4?} m; is it in kilometres?",
        place.as_slice(),
        arguments.elastic().young_modulus,
        size.as_slice()
    );
}

/// Writes and prints the results; fails if the run did.
pub(super) fn report<const D: usize>(
    arguments: &Arguments,
    space: &P1<D>,
    faults: &[Fault<D>],
    run: Run<D>,
) -> Result<(), Problem> {
    warn_of_strain(arguments, space, run.strain);
    let (probes, iterations, contraction) = (run.probes, run.iterations, run.contraction);
    let output = arguments
        .files
        .create("gmsh", &[HISTORY, PICTURE, SUMMARY])?;
    let (probe, cost) = (&probes.each[0], probes.cost);
    let rows = probe.rows.iter().map(|row| row.map(number));
    output.table(
        HISTORY,
        "time,displacement,velocity,alpha,max_slip_rate",
        rows,
    )?;
    plot::draw(
        &output.path(PICTURE),
        &[
            Panel::new("time [s]", "displacement [mm]").with("", DARK, 3, probe.curve(1, 1e3)),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 3, probe.curve(2, 1.0)),
        ],
    )?;
    let mut parts = Vec::new();
    for (name, faces) in space.mesh().parts() {
        let area = space.part(name)?.measure();
        parts.push(json!({ "name": name, "faces": faces.len(), "area": area }));
    }
    let mut contacts = Vec::new();
    for (fault, [rows, ..]) in faults.iter().zip(&run.contacts) {
        let (sides, count) = (1 + usize::from(fault.minus.is_some()), rows.len());
        contacts.push(json!({ "name": fault.name, "sides": sides, "vertices": count }));
    }
    let [slip, normal_stress, opening] = [0, 1, 2].map(|column| {
        run.contacts
            .iter()
            .flat_map(move |of| &of[column])
            .collect::<Vec<_>>()
    });
    let onset = (RECORDING.slip, RECORDING.slip);
    let (slips, anywhere) = (
        probe.times(onset, |row| row[2]),
        probe.times(onset, |row| row[4]),
    );
    let events = probe.times(RECORDING.event, |row| row[2]);
    let (cells, vertices) = (space.mesh().cell_count(), space.vertex_count());
    let milliseconds = probes.milliseconds_per_step();
    let failure = run.end.as_ref().err().map(ToString::to_string);
    let (first, [time, slid, ..]) = (slips.first(), probe.last());
    let place = space.mesh().vertices()[probe.vertex];
    output.json(
        SUMMARY,
        &json!({
            "dimension": D,
            "vertices": vertices,
            "cells": cells,
            "parts": parts,
            "contacts": contacts,
            "solver": arguments.solver,
            "probe": place.as_slice(),
            "steps": cost.steps,
            "bridged_steps": run.end.as_ref().map_or(0, |report| report.substepped),
            "time_end": time,
            "first_slip_time": anywhere.first(),
            "first_slip_time_at_probe": first,
            "event_times": events,
            "displacement_end": slid,
            "largest_strain": run.strain.0,
            "peak_slip_rate": cost.peak_slip_rate,
            "solver_iterations_per_step": cost.per_step(cost.solver_iterations),
            "milliseconds_per_step": milliseconds,
            "reaction_iterations": iterations,
            "contraction": contraction,
            "slip": slip,
            "normal_stress": normal_stress,
            "opening": opening,
            "failure": failure,
        }),
    )?;
    say!(
        "{vertices} vertices, {cells} cells in {D} dimensions, {} steps to t = {:.5} s",
        cost.steps,
        time
    )?;
    let slipped =
        |first: Option<&f64>| first.map_or("none".to_owned(), |time| format!("{time:.6} s"));
    say!(
        "first slip of the contacts: {}, at x = {:.4?} m: {}; {} events there at t = {:.5?} s",
        slipped(anywhere.first()),
        place.as_slice(),
        slipped(first),
        events.len(),
        events
    )?;
    say!(
        "displacement there {:.6e} m, largest slip rate {:.4e} m/s; {milliseconds:.3} ms a step",
        slid,
        cost.peak_slip_rate
    )?;
    say!("{}", output.told(&[HISTORY, PICTURE, SUMMARY]))?;
    run.end?;
    match first {
        // Of the mesh shipped: the paper's body of cells like these, converged in time.
        Some(&time) if arguments.is_default() => expect("first slip", time, 10.0107, 3e-3),
        _ => Ok(()),
    }
}
