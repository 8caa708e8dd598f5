//! The slider on a mesh of Gmsh: command line and report.

mod run;

pub use run::run;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::{Parser, ValueEnum};
use serde::Serialize;
use serde_json::json;
use stickslip::fem::{P1, Trace};
use stickslip::integrate::RunReport;
use stickslip::nalgebra::SVector;
use stickslip::problems::pipping_slider::END;
use stickslip::{BlockMatrix, Simulation, StepFailure, Steps};

use crate::cli::{Problem, expect, finite, fraction};
use crate::output::{Output, digits};
use crate::plot::{self, DARK, Panel};
use crate::probes::Probes;
use crate::slider::RECORDING;

const MESH: &str = "examples/meshes/slider.msh";
const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The paper's slider on a body of any shape: a mesh of Gmsh with a sliding part and a driven part
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The mesh: triangles in a plane or tetrahedra, with named groups of their boundary
    #[arg(
        long,
        value_name = "FILE",
        default_value = MESH
    )]
    pub mesh: PathBuf,
    /// The sliding group of the boundary
    #[arg(long, value_name = "NAME", default_value = "fault")]
    pub contact: String,
    /// The driven group of the boundary
    #[arg(long, value_name = "NAME", default_value = "top")]
    pub driven: String,
    /// The direction of the drive: its part tangential to the contact counts. The first axis that is not normal by
    /// default
    #[arg(long, value_name = "X,Y[,Z]", value_delimiter = ',', value_parser = finite)]
    pub direction: Vec<f64>,
    /// The position whose nearest vertex of the contact is recorded [m]; the middle of the contact by default
    #[arg(long, value_name = "X,Y[,Z]", value_delimiter = ',', value_parser = finite)]
    pub probe: Vec<f64>,
    /// Uniform refinements of the mesh
    #[arg(long, value_name = "J", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=8))]
    pub refinements: u8,
    /// Time steps in the whole 15 s
    #[arg(long, value_name = "N", default_value = "10000")]
    pub steps: NonZeroUsize,
    /// The share of the 15 s after which to stop
    #[arg(long, value_name = "FRACTION", default_value_t = 1.0, value_parser = fraction)]
    pub until: f64,
    /// The solver of the velocity problems
    #[arg(long, value_enum, default_value_t = Solver::Condensed)]
    pub solver: Solver,
    /// The folder to write to
    #[arg(long, value_name = "DIR", default_value = "out/gmsh")]
    pub out: PathBuf,
}

/// Solvers by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Factorise the body, solve on the contact
    Condensed,
    /// Truncated nonsmooth Newton multigrid
    Tnnmg,
}

impl Arguments {
    /// Whether this is the paper's slider on the mesh shipped.
    fn is_default(&self) -> bool {
        let shipped = self.mesh == Path::new(MESH) && self.refinements == 0;
        let setting = self.contact == "fault" && self.driven == "top" && self.steps.get() == 10_000;
        shipped && setting && self.direction.is_empty() && self.probe.is_empty()
    }

    /// The end of the run \[s\].
    pub fn end(&self) -> f64 {
        self.until * END
    }

    /// The unit vector of the drive, along a contact with this mean normal.
    ///
    /// # Errors
    /// A direction of another dimension, or normal to the contact.
    pub fn along<const D: usize>(
        &self,
        normal: &SVector<f64, D>,
    ) -> Result<SVector<f64, D>, Problem> {
        let unit = |axis: usize| SVector::from_fn(|c, _| f64::from(u8::from(c == axis)));
        let tangential = |x: SVector<f64, D>| x - normal * normal.dot(&x);
        let given = match self.direction.len() {
            0 => (0..D).map(unit).map(tangential).find(|x| x.norm() > 0.5),
            _ => Some(tangential(vector("direction", &self.direction)?)),
        };
        let along = given.unwrap_or_else(SVector::zeros);
        let length = along.norm();
        if length <= 1e-6 * self.direction.iter().fold(0.0, |sum: f64, x| sum.hypot(*x)) {
            return Err("the direction is normal to the contact".into());
        }
        Ok(along / length)
    }

    /// The position on the contact whose nearest vertex is recorded \[m\].
    ///
    /// # Errors
    /// A position of another dimension.
    pub fn probe<const D: usize>(&self, contact: &Trace<D>) -> Result<SVector<f64, D>, Problem> {
        if self.probe.is_empty() {
            let weighted = contact.points().iter().zip(contact.weights());
            Ok(weighted.map(|(x, w)| x * *w).sum::<SVector<f64, D>>() / contact.measure())
        } else {
            vector("probe", &self.probe)
        }
    }
}

/// A vector of the mesh's dimension from the command line.
fn vector<const D: usize>(what: &str, given: &[f64]) -> Result<SVector<f64, D>, Problem> {
    let found = given.len();
    if found != D {
        return Err(format!("--{what}: {found} numbers for a mesh of {D} dimensions").into());
    }
    Ok(SVector::from_column_slice(given))
}

/// The mean outward normal of a part, by area; that of its first vertex for a closed part.
pub fn mean_normal<const D: usize>(part: &Trace<D>) -> SVector<f64, D> {
    let weighted = part.normals().iter().zip(part.weights());
    let sum: SVector<f64, D> = weighted.map(|(n, w)| n * *w).sum();
    if sum.norm() > 1e-3 * part.measure() {
        sum.normalize()
    } else {
        part.normals()[0]
    }
}

/// Takes the steps, and records the vertex of the contact nearest to a position, along a direction: time, displacement,
/// velocity, state, and the largest slip rate anywhere.
pub fn take<const D: usize>(
    arguments: &Arguments,
    simulation: &mut Simulation<BlockMatrix<D>, D>,
    place: SVector<f64, D>,
    direction: SVector<f64, D>,
) -> (Probes<D, 5>, Result<RunReport, StepFailure>) {
    let distance = |place: &SVector<f64, D>, point: [f64; 3]| {
        (SVector::from_fn(|c, _| point[c]) - place).norm()
    };
    let mut probes = Probes::new(&simulation.snapshot(), [place], distance, move |at, k| {
        let contact = at.contact(0);
        let along = |field: &[SVector<f64, D>]| field[contact.vertex(k)].dot(&direction);
        let (displacement, rate) = (along(at.displacement), along(at.velocity));
        let largest = at.max_slip_rate();
        [at.time, displacement, rate, contact.state(k), largest]
    });
    let plan = Steps::constant(END / arguments.steps.get() as f64);
    let run = probes.run(simulation, &plan.until(arguments.end()), |_| ());
    (probes, run)
}

/// Writes and prints the results; fails if the run did.
pub fn report<const D: usize>(
    arguments: &Arguments,
    space: &P1<D>,
    (probes, run): (Probes<D, 5>, Result<RunReport, StepFailure>),
) -> Result<(), Problem> {
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
    let slips = probe.times((RECORDING.slip, RECORDING.slip), |row| row[2]);
    let events = probe.times(RECORDING.event, |row| row[2]);
    let (cells, vertices) = (space.mesh().cell_count(), space.vertex_count());
    let milliseconds = probes.milliseconds_per_step();
    let failure = run.as_ref().err().map(ToString::to_string);
    let (first, [time, slid, ..]) = (slips.first(), probe.last());
    let place = space.mesh().vertices()[probe.vertex];
    output.json(
        SUMMARY,
        &json!({
            "dimension": D,
            "vertices": vertices,
            "cells": cells,
            "parts": parts,
            "solver": arguments.solver,
            "probe": place.as_slice(),
            "steps": cost.steps,
            "bridged_steps": run.as_ref().map_or(0, |report| report.substepped),
            "time_end": time,
            "first_slip_time": first,
            "event_times": events,
            "displacement_end": slid,
            "peak_slip_rate": cost.peak_slip_rate,
            "solver_iterations_per_step": cost.per_step(cost.solver_iterations),
            "milliseconds_per_step": milliseconds,
            "failure": failure,
        }),
    )?;
    println!(
        "{vertices} vertices, {cells} cells in {D} dimensions, {} steps to t = {:.5} s",
        cost.steps, time
    );
    println!(
        "first slip at x = {:.4?} m: {:.6?} s; {} events at t = {:.5?} s",
        place.as_slice(),
        first,
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
    run?;
    match first {
        // Of the mesh shipped: the paper's body of cells like these, converged in time.
        Some(&time) if arguments.is_default() => expect("first slip", time, 10.0107, 3e-3),
        _ => Ok(()),
    }
}
