//! The record of an injection, and its report.

use std::time::Instant;

use serde_json::{Value, json};
use stickslip::integrate::{RunReport, Stepper};
use stickslip::record::EventCatalogue;
use stickslip::{Run, Snapshot, Steps};

use super::fault::Grid;
use super::fronts::Fronts;
use super::wells::Place;
use super::{Arguments, Failed, pictures};
use crate::earthquakes::space_time::SpaceTime;
use crate::earthquakes::watch::{self, Watch};
use crate::output::{Output, number};
use crate::progress::Progress;

const FILES: [&str; 9] = [
    "fronts.csv",
    "stations.csv",
    "cells.csv",
    "events.csv",
    "fronts.png",
    "stations.png",
    "pressure.png",
    "slip.png",
    "summary.json",
];

/// The record of a run.
pub(super) struct Record<'a> {
    arguments: &'a Arguments,
    grid: &'a Grid,
    wells: &'a [Place],
    stations: Vec<Watch>,
    pub(super) fronts: Vec<Fronts>,
    /// Pore pressure and slip along strike through the first well.
    pub(super) maps: [SpaceTime; 2],
    events: EventCatalogue<1>,
    /// The largest number of cells without enough normal stress.
    least: usize,
}

impl<'a> Record<'a> {
    pub(super) fn new(
        arguments: &'a Arguments,
        grid: &'a Grid,
        wells: &'a [Place],
        at: &Snapshot<'_, 1>,
    ) -> Result<Self, Failed> {
        let places = wells.iter().map(|well| well.at);
        let places = places.chain(arguments.output.stations.iter().copied());
        let stations: Result<Vec<Watch>, Failed> = places
            .map(|place| Ok(Watch::new(grid.station(place)?, grid.name(place), &[])))
            .collect();
        let line = grid.along_strike(wells.first().map_or(0.0, |well| well.at[1]));
        let rate = arguments.output.seismic_rate;
        let modulus = arguments.geometry.shear_modulus;
        let mut record = Self {
            arguments,
            grid,
            wells,
            stations: stations?,
            fronts: Vec::new(),
            maps: [0, 1].map(|_| SpaceTime::new(&line, arguments.time.end)),
            events: EventCatalogue::new(at, 0, [rate, 0.1 * rate], modulus, 100)?,
            least: 0,
        };
        record.see(at);
        Ok(record)
    }

    fn see(&mut self, at: &Snapshot<'_, 1>) {
        let contact = at.contact(0);
        self.stations.iter_mut().for_each(|station| station.see(at));
        let creep = self.arguments.friction.creep();
        let fronts = Fronts::new(
            self.grid,
            &self.arguments.output,
            (at.time, creep),
            &contact,
        );
        self.fronts.push(fronts);
        let [pressure, slip] = &mut self.maps;
        pressure.record_of(at.time, |k| contact.pore_pressure(k));
        slip.record_of(at.time, |k| contact.slip(k));
        self.least = self.least.max(at.report.at_least_normal_stress);
    }

    /// Takes the steps, and writes and prints the results.
    pub(super) fn run(&mut self, steps: &Steps, motion: &mut dyn Stepper<1>) -> Result<(), Failed> {
        let output = self.arguments.files.create("injection", &FILES)?;
        let (clock, mut progress) = (Instant::now(), Progress::default());
        let end = self.arguments.time.end;
        let report = motion.run(steps, |at| {
            progress.at(at.time, end, at.max_slip_rate());
            self.see(&at);
            self.events.record(&at);
        })?;
        drop(progress);
        let seconds = clock.elapsed().as_secs_f64();
        self.write(&output, &motion.snapshot())?;
        output.json(FILES[8], &self.summary(&report, seconds))?;
        self.say(&report, seconds)?;
        say!("{}", output.told(&FILES))?;
        Ok(())
    }

    fn write(&self, output: &Output, at: &Snapshot<'_, 1>) -> Result<(), Failed> {
        let rows = self.fronts.iter().map(|fronts| {
            let [pressure, slip] = fronts.radii;
            let [highest, farthest, fastest] = fronts.largest;
            [
                fronts.time,
                pressure,
                slip,
                highest,
                farthest,
                fastest,
                fronts.volume,
            ]
            .map(number)
        });
        let columns = "time,pressure_front,slip_front,largest_pore_pressure,largest_slip,\
                       largest_slip_rate,injected_volume";
        output.table(FILES[0], columns, rows)?;
        watch::write(output, [FILES[1], FILES[5]], &self.stations)?;
        let contact = at.contact(0);
        let rows = (0..contact.len()).map(|k| {
            let [x, y] = self.grid.center(k);
            let (stress, normal) = (contact.traction(k)[0], contact.effective_normal_stress(k));
            let (slip, rate) = (contact.slip(k), contact.slip_rate(k));
            [x, y, slip, rate, stress, contact.pore_pressure(k), normal].map(number)
        });
        let columns =
            "strike,down_dip,slip,slip_rate,shear_stress,pore_pressure,effective_normal_stress";
        output.table(FILES[2], columns, rows)?;
        let under_way = self.events.under_way(at);
        output.events(FILES[3], self.events.events().iter().chain(&under_way))?;
        pictures::fronts(output, FILES[4], self)?;
        pictures::maps(output, [FILES[6], FILES[7]], self)
    }

    /// The fronts at the end, the largest slip and the largest rate of all steps.
    fn end(&self) -> ([f64; 2], f64, f64) {
        let radii = self.fronts.last().map_or([0.0; 2], |last| last.radii);
        let largest = |n: usize| {
            let values = self.fronts.iter().map(|fronts| fronts.largest[n]);
            values.fold(0.0, f64::max)
        };
        (radii, largest(1), largest(2))
    }

    fn summary(&self, report: &RunReport, seconds: f64) -> Value {
        let ([pressure, slip], farthest, fastest) = self.end();
        let stations: Vec<Value> = self.stations.iter().map(Watch::summary).collect();
        let largest = self.fronts.iter().map(|fronts| fronts.largest[0]);
        json!({
            "cells": self.grid.count(),
            "cell": self.grid.cell(),
            "wells": self.wells.iter().map(|well| well.at).collect::<Vec<_>>(),
            "injected_volume": self.fronts.last().map(|last| last.volume),
            "pressure_front": pressure,
            "slip_front": slip,
            "largest_slip": farthest,
            "largest_slip_rate": fastest,
            "largest_pore_pressure": largest.fold(0.0, f64::max),
            "seismic": fastest >= self.arguments.output.seismic_rate,
            "events": self.events.events().len(),
            "most_cells_at_least_normal_stress": self.least,
            "stations": stations,
            "steps": report.accepted,
            "rejected": report.rejected + report.failed,
            "seconds": seconds,
        })
    }

    fn say(&self, report: &RunReport, seconds: f64) -> Result<(), Failed> {
        let unit = match self.grid {
            Grid::Line(_) => "m^2",
            Grid::Plane(_) => "m^3",
        };
        for Place { at: [x, y], rates } in self.wells {
            let center = self.grid.center(self.grid.cell_at([*x, *y])?);
            let [place, center] = [[*x, *y], center].map(|at| self.grid.name(at));
            let volume = rates.volume([0.0, self.arguments.time.end]);
            say!("well at {place}, in the cell around {center}: {volume:.6e} {unit}")?;
        }
        let ([pressure, slip], farthest, fastest) = self.end();
        let output = &self.arguments.output;
        let seismic = if fastest >= output.seismic_rate {
            "seismic"
        } else {
            "aseismic"
        };
        say!(
            "fronts at the end: pore pressure {pressure:.1} m ({} of the largest), slip {slip:.1} m ({} of the largest)",
            output.pressure_share,
            output.slip_share
        )?;
        say!(
            "largest slip {farthest:.4e} m, largest slip rate {fastest:.3e} m/s: {seismic} (from {} m/s), {} events",
            output.seismic_rate,
            self.events.events().len()
        )?;
        if self.least > 0 {
            let without = if self.arguments.zone.allow_opening {
                "open"
            } else {
                "at the least normal stress"
            };
            say!("up to {} cells were {without}", self.least)?;
        }
        say!(
            "{} cells, {} steps, {} taken back, {seconds:.1} s",
            self.grid.count(),
            report.accepted,
            report.rejected + report.failed
        )?;
        Ok(())
    }
}
