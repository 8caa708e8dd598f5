//! The command line and the report of the slider on a mesh of Gmsh.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Parser, ValueEnum};
use serde::Serialize;
use serde_json::json;
use stickslip::fem::{P1, Trace};
use stickslip::nalgebra::SVector;
use stickslip::problems::END;
use stickslip::{BlockMatrix, RunReport};
use stickslip::{Events, Failure, Simulation, Snapshot, Steps};

use crate::cli::{Problem, expect, finite, fraction};
use crate::output::{Output, digits};
use crate::plot::{self, DARK, Panel};
use crate::slider::RECORDING;

const MESH: &str = "examples/meshes/slider.msh";
const HISTORY: &str = "history.csv";
const PICTURE: &str = "history.png";
const SUMMARY: &str = "summary.json";

/// The paper's slider on a body of any shape: a mesh of Gmsh with a part that slides and a part that is driven
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The mesh: triangles in a plane or tetrahedra, with named groups of their boundary
    #[arg(
        long,
        value_name = "FILE",
        default_value = MESH
    )]
    pub mesh: PathBuf,
    /// The group of the boundary that slides
    #[arg(long, value_name = "NAME", default_value = "fault")]
    pub contact: String,
    /// The group of the boundary that is driven
    #[arg(long, value_name = "NAME", default_value = "top")]
    pub driven: String,
    /// Where to: its part tangential to the contact counts. The first axis that is not normal, unless given
    #[arg(long, value_name = "X,Y[,Z]", value_delimiter = ',', value_parser = finite)]
    pub direction: Vec<f64>,
    /// The place whose nearest vertex of the contact is recorded [m]; the middle of the contact, unless given
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
    /// What solves the velocity problems
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

/// What was recorded of a run.
pub struct Watched {
    rows: Vec<[f64; 5]>,
    slips: Events,
    events: Events,
    vertex: usize,
    peak: f64,
    cycles: usize,
}

impl Arguments {
    /// Whether it is the paper's slider on the mesh shipped.
    fn is_default(&self) -> bool {
        let shipped = self.mesh == Path::new(MESH) && self.refinements == 0;
        let setting = self.contact == "fault" && self.driven == "top" && self.steps.get() == 10_000;
        shipped && setting && self.direction.is_empty() && self.probe.is_empty()
    }

    /// The end of the run \[s\].
    pub fn end(&self) -> f64 {
        self.until * END
    }

    /// The unit vector in which the body is driven, along a contact with this mean normal.
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

    /// The vertex of the contact that is recorded.
    ///
    /// # Errors
    /// A place of another dimension.
    pub fn probe<const D: usize>(&self, contact: &Trace<D>) -> Result<usize, Problem> {
        let place = if self.probe.is_empty() {
            let weighted = contact.points().iter().zip(contact.weights());
            weighted.map(|(x, w)| x * *w).sum::<SVector<f64, D>>() / contact.measure()
        } else {
            vector("probe", &self.probe)?
        };
        let distance = |k: &usize| (contact.points()[*k] - place).norm();
        let places = 0..contact.points().len();
        let nearest = places.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        Ok(contact.vertices()[nearest.ok_or("the contact has no vertex")?])
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

/// The mean outward normal of a part, by area; that of its first vertex where it closes on itself.
pub fn mean_normal<const D: usize>(part: &Trace<D>) -> SVector<f64, D> {
    let weighted = part.normals().iter().zip(part.weights());
    let sum: SVector<f64, D> = weighted.map(|(n, w)| n * *w).sum();
    if sum.norm() > 1e-3 * part.measure() {
        sum.normalize()
    } else {
        part.normals()[0]
    }
}

/// Takes the steps, and records the probe: `vertex`, along `direction`.
pub fn take<const D: usize>(
    arguments: &Arguments,
    simulation: &mut Simulation<BlockMatrix<D>, D>,
    vertex: usize,
    direction: &SVector<f64, D>,
) -> (Watched, f64, Result<RunReport, Failure>) {
    let slip = RECORDING.slip;
    let mut watched = Watched {
        rows: Vec::new(),
        slips: Events::new(slip, slip),
        events: Events::new(RECORDING.event.0, RECORDING.event.1),
        vertex,
        peak: 0.0,
        cycles: 0,
    };
    watched.see(&simulation.snapshot(), direction);
    let clock = Instant::now();
    let plan = Steps::constant(END / arguments.steps.get() as f64).bridging();
    let run = simulation.run(&plan.until(arguments.end()), |at| {
        watched.see(&at, direction)
    });
    (watched, clock.elapsed().as_secs_f64(), run)
}

impl Watched {
    fn see<const D: usize>(&mut self, at: &Snapshot<'_, D>, direction: &SVector<f64, D>) {
        let along = |field: &[SVector<f64, D>]| field[self.vertex].dot(direction);
        let (displacement, rate) = (along(at.displacement), along(at.velocity));
        let contact = at.contact(0);
        let state = contact
            .position_of(self.vertex)
            .map_or(f64::NAN, |k| contact.state(k));
        let largest = at.max_slip_rate();
        self.slips.record(at.time, rate);
        self.events.record(at.time, rate);
        self.peak = self.peak.max(largest);
        self.cycles += at.report.solver_iterations;
        self.rows
            .push([at.time, displacement, rate, state, largest]);
    }
}

/// Writes and prints everything; fails where the run did.
pub fn report<const D: usize>(
    arguments: &Arguments,
    space: &P1<D>,
    (watched, seconds, run): (Watched, f64, Result<RunReport, Failure>),
) -> Result<(), Problem> {
    let output = Output::create(&arguments.out, &[HISTORY, PICTURE, SUMMARY])?;
    let rows = watched.rows.iter().map(|row| row.map(digits));
    output.table(
        HISTORY,
        "time,displacement,velocity,alpha,max_slip_rate",
        rows,
    )?;
    let curve = |column: usize, scale: f64| {
        let points = watched.rows.iter().skip(1);
        points.map(|row| (row[0], scale * row[column])).collect()
    };
    plot::draw(
        &output.path(PICTURE),
        &[
            Panel::new("time [s]", "displacement [mm]").with("", DARK, 3, curve(1, 1e3)),
            Panel::new("time [s]", "slip rate [m/s]")
                .logarithmic()
                .with("", DARK, 3, curve(2, 1.0)),
        ],
    )?;
    let mut parts = Vec::new();
    for (name, faces) in space.mesh().parts() {
        let area = space.part(name)?.measure();
        parts.push(json!({ "name": name, "faces": faces.len(), "area": area }));
    }
    let steps = watched.rows.len() - 1;
    let (cells, vertices) = (space.mesh().cell_count(), space.vertex_count());
    let milliseconds = 1e3 * seconds / steps.max(1) as f64;
    let failure = run.as_ref().err().map(ToString::to_string);
    let last = watched.rows[steps];
    let place = space.mesh().vertices()[watched.vertex];
    output.json(
        SUMMARY,
        &json!({
            "dimension": D,
            "vertices": vertices,
            "cells": cells,
            "parts": parts,
            "solver": arguments.solver,
            "probe": place.as_slice(),
            "steps": steps,
            "bridged_steps": run.as_ref().map_or(0, |report| report.bridged),
            "time_end": last[0],
            "first_slip_time": watched.slips.times().first(),
            "event_times": watched.events.times(),
            "displacement_end": last[1],
            "peak_slip_rate": watched.peak,
            "solver_iterations_per_step": watched.cycles as f64 / steps.max(1) as f64,
            "milliseconds_per_step": milliseconds,
            "failure": failure,
        }),
    )?;
    println!(
        "{vertices} vertices, {cells} cells in {D} dimensions, {steps} steps to t = {:.5} s",
        last[0]
    );
    println!(
        "first slip at x = {:.4?} m: {:.6?} s; {} events at t = {:.5?} s",
        place.as_slice(),
        watched.slips.times().first(),
        watched.events.times().len(),
        watched.events.times()
    );
    println!(
        "displacement there {:.6e} m, largest slip rate {:.4e} m/s; {milliseconds:.3} ms a step",
        last[1], watched.peak
    );
    println!(
        "{HISTORY}, {PICTURE}, {SUMMARY} in {}",
        output.folder().display()
    );
    run?;
    match watched.slips.times().first() {
        // Of the mesh shipped: the paper's body of cells like these, converged in time.
        Some(&time) if arguments.is_default() => expect("first slip", time, 10.0107, 3e-3),
        _ => Ok(()),
    }
}
