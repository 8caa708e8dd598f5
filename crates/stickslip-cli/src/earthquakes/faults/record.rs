//! The record of faults of a file.

use stickslip::Snapshot;
use stickslip::bie::Triangles;

use super::super::events::Events;
use super::super::space_time::SpaceTime;
use super::super::{Failed, YEAR, pictures};
use super::friction::Strengths;
use super::layout::Layout;
use super::surface::SurfaceRecord;
use crate::output::{Output, number};

/// What is seen of a run.
pub(super) struct Record<'a> {
    events: Events,
    /// Slip rates along each polyline.
    rates: Vec<SpaceTime>,
    /// What pictures of triangles need.
    surface: Option<SurfaceRecord<'a>>,
    /// Time, the largest slip rate, and the least and the largest normal stress.
    rows: Vec<[f64; 4]>,
    /// The slip of each cell so far \[m\].
    slip: Vec<f64>,
    steps: usize,
}

impl<'a> Record<'a> {
    /// A record on polylines, of events from a slip rate on [m/s], until a time \[s\].
    pub(super) fn of_lines(cells: &Layout, end: f64, event: f64) -> Self {
        let lines = cells.lines.iter().map(|line| SpaceTime::new(line, end));
        Self {
            events: Events::new(event, cells.count()),
            rates: lines.collect(),
            surface: None,
            rows: Vec::new(),
            slip: vec![0.0; cells.count()],
            steps: 0,
        }
    }

    /// A record on triangles, of events from a slip rate on [m/s].
    pub(super) fn of_surface(cells: &Layout, triangles: &'a Triangles, event: f64) -> Self {
        Self {
            surface: Some(SurfaceRecord::new(triangles, event)),
            ..Self::of_lines(cells, 0.0, event)
        }
    }

    pub(super) fn see(&mut self, at: &Snapshot<'_, 1>) {
        self.steps += 1;
        let contact = at.contact(0);
        self.events.record(at.time, &contact);
        for rates in &mut self.rates {
            rates.record(at.time, &contact);
        }
        if let Some(surface) = &mut self.surface {
            surface.see(at);
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..contact.len() {
            let stress = contact.normal_stress(k);
            (low, high) = (low.min(stress), high.max(stress));
            self.slip[k] = contact.slip(k);
        }
        self.rows
            .push([at.time, contact.max_slip_rate(), low, high]);
    }

    pub(super) fn events(&self) -> &Events {
        &self.events
    }

    /// The largest slip anywhere \[m\].
    pub(super) fn largest_slip(&self) -> f64 {
        self.slip.iter().copied().fold(0.0, f64::max)
    }

    /// The least and the largest normal stress of the run \[Pa\].
    pub(super) fn normal_stress_range(&self) -> [f64; 2] {
        let wider = |[low, high]: [f64; 2], row: &[f64; 4]| [low.min(row[2]), high.max(row[3])];
        self.rows
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], wider)
    }

    pub(super) fn steps(&self) -> usize {
        self.steps
    }

    /// Writes the history and the cells.
    pub(super) fn write(
        &self,
        output: &Output,
        cells: &Layout,
        strengths: &Strengths,
        [history, cells_file]: [&str; 2],
    ) -> Result<(), Failed> {
        let columns = "time,max_slip_rate,least_normal_stress,largest_normal_stress";
        output.table(
            history,
            columns,
            self.rows.iter().map(|row| row.map(number)),
        )?;
        let rows = (0..cells.count()).map(|cell| {
            let ([x, y, z], law) = (cells.centers[cell], strengths.laws[cell]);
            let numbers = [
                cells.faults[cell] as f64,
                x,
                y,
                z,
                cells.sizes[cell],
                cells.downward[cell],
                cells.bends[cell],
                law.a,
                law.b,
                law.slip_distance,
                strengths.normal_stress[cell],
                self.slip[cell],
            ];
            numbers.map(number)
        });
        let columns = "fault,x,y,z,size,downward,bend,a,b,slip_distance,normal_stress,slip";
        output.table(cells_file, columns, rows)
    }

    /// Draws slip rates, and of triangles the slip of events.
    pub(super) fn draw(self, output: &Output, names: &[&str]) -> Result<(), Failed> {
        match (self.surface, names) {
            (Some(surface), [rates, slip]) => surface.draw(&output.path(rates), &output.path(slip)),
            (None, [map]) => draw_lines(&self.rates, output, map),
            _ => Ok(()),
        }
    }

    /// Prints the events.
    pub(super) fn say(&self) -> Result<(), Failed> {
        say!(
            "{:>12} {:>14} {:>12}",
            "event years",
            "mean slip [m]",
            "log10 V"
        )?;
        for event in self.events.all() {
            let (years, slip, peak) = (event.onset / YEAR, event.mean_slip, event.peak);
            say!("{years:>12.3} {slip:>14.4} {peak:>12.3}")?;
        }
        Ok(())
    }
}

/// Draws slip rates along each polyline.
fn draw_lines(rates: &[SpaceTime], output: &Output, map: &str) -> Result<(), Failed> {
    let names: Vec<String> = (0..rates.len())
        .map(|fault| format!("fault {fault}: distance [km]"))
        .collect();
    let lines: Vec<(&str, &SpaceTime)> = names.iter().map(String::as_str).zip(rates).collect();
    pictures::lines(&output.path(map), &lines)
}
