//! The record of a run on a mesh of Gmsh, and its report.

use serde_json::json;
use stickslip::fem::P1;
use stickslip::integrate::RunReport;
use stickslip::nalgebra::SVector;
use stickslip::problems::pipping_slider::END;
use stickslip::{BlockMatrix, Simulation, StepFailure, Steps};

use super::Arguments;
use super::faults::Fault;
use crate::cli::{Problem, expect};
use crate::output::{Output, digits};
use crate::plot::{self, DARK, Panel};
use crate::probes::Probes;
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
    /// Positions and slips, positions and normal stresses of the vertices of each contact.
    contacts: Vec<[Vec<Vec<f64>>; 3]>,
}

/// Takes the steps, and records the vertex of the first contact nearest to a position, along a direction: time,
/// displacement, velocity, state, and the largest slip rate anywhere. Between two sides of a fault displacement and
/// velocity are slip and slip rate.
pub(super) fn take<const D: usize>(
    arguments: &Arguments,
    simulation: &mut Simulation<BlockMatrix<D>, D>,
    faults: &[Fault<D>],
    place: SVector<f64, D>,
    direction: SVector<f64, D>,
) -> Run<D> {
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
    let end = probes.run(simulation, &plan.until(arguments.end()), |at| {
        iterations = iterations.max(at.report.reaction_iterations);
        contraction = contraction.max(at.report.contraction);
    });
    let at = simulation.snapshot();
    let contacts = faults.iter().enumerate();
    Run {
        contacts: contacts.map(|(k, fault)| fault.rows(&at, k)).collect(),
        probes,
        end,
        iterations,
        contraction,
    }
}

/// Writes and prints the results; fails if the run did.
pub(super) fn report<const D: usize>(
    arguments: &Arguments,
    space: &P1<D>,
    faults: &[Fault<D>],
    run: Run<D>,
) -> Result<(), Problem> {
    let (probes, iterations, contraction) = (run.probes, run.iterations, run.contraction);
    let output = Output::create(&arguments.out, &[HISTORY, PICTURE, SUMMARY])?;
    let (probe, cost) = (&probes.each[0], probes.cost);
    let rows = probe.rows.iter().map(|row| row.map(digits));
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
    let slips = probe.times((RECORDING.slip, RECORDING.slip), |row| row[2]);
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
            "first_slip_time": first,
            "event_times": events,
            "displacement_end": slid,
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
    println!(
        "{vertices} vertices, {cells} cells in {D} dimensions, {} steps to t = {:.5} s",
        cost.steps, time
    );
    let slipped = first.map_or("none".to_owned(), |time| format!("{time:.6} s"));
    println!(
        "first slip at x = {:.4?} m: {slipped}; {} events at t = {:.5?} s",
        place.as_slice(),
        events.len(),
        events
    );
    println!(
        "displacement there {:.6e} m, largest slip rate {:.4e} m/s; {milliseconds:.3} ms a step",
        slid, cost.peak_slip_rate
    );
    println!(
        "{HISTORY}, {PICTURE}, {SUMMARY} in {}",
        output.folder().display()
    );
    run.end?;
    match first {
        // Of the mesh shipped: the paper's body of cells like these, converged in time.
        Some(&time) if arguments.is_default() => expect("first slip", time, 10.0107, 3e-3),
        _ => Ok(()),
    }
}
