//! Displacement of the free surface.

use std::ops::ControlFlow;
use std::path::PathBuf;

use stickslip::Snapshot;
use stickslip::bie::{Receivers, Sources};
use stickslip::nalgebra::SVector;
use stickslip::record::{FileError, SurfaceGrid};

use super::super::Failed;

/// The share of a fault's larger side by which the grid reaches beyond it.
const MARGIN: f64 = 0.5;
/// The shares of a spacing by which the grid is moved, so that points are beside traces rather than on them.
const MOVED: [f64; 2] = [0.3713, 0.4127];

/// A grid of the free surface, and the event under way.
pub(super) struct Surface<const C: usize> {
    grid: SurfaceGrid,
    receivers: Receivers<C>,
    /// The velocity of creep beyond the cells [m/s].
    creep: Option<Vec<[f64; 3]>>,
    folder: PathBuf,
    /// The slip rate of events [m/s].
    event: f64,
    /// Slip at the onset of the event under way \[m\].
    before: Option<Vec<SVector<f64, C>>>,
    /// The start of the run \[s\].
    begin: f64,
    count: usize,
    error: Option<Failed>,
}

impl<const C: usize> Surface<C> {
    /// A grid about the extent of the cells along `x` and `y` \[m\].
    pub(super) fn new(
        (sources, plate): (Sources<C>, Option<SVector<f64, C>>),
        (extent, spacing): ([[f64; 2]; 2], f64),
        (folder, event): (PathBuf, f64),
        at: &Snapshot<'_, C>,
    ) -> Result<Self, Failed> {
        let sides = extent.map(|[begin, end]| end - begin);
        let margin = MARGIN * sides[0].max(sides[1]);
        let begin = [0, 1].map(|axis| extent[axis][0] - margin + MOVED[axis] * spacing);
        let counts = sides.map(|side| ((side + 2.0 * margin) / spacing) as usize);
        let grid = SurfaceGrid::new(begin, spacing, counts)?;
        let receivers = Receivers::of_sources(sources, &grid.points())?;
        let creep = plate.map(|rate| receivers.creep(rate)).transpose()?;
        let mut own = Self {
            grid,
            receivers,
            creep,
            folder,
            event,
            before: None,
            begin: at.time,
            count: 0,
            error: None,
        };
        let _ = own.record(at);
        Ok(own)
    }

    pub(super) fn record(&mut self, at: &Snapshot<'_, C>) -> ControlFlow<()> {
        let rate = at.max_slip_rate();
        if self.before.is_none() && rate >= self.event {
            self.before = Some(at.displacement.to_vec());
        } else if rate < 0.1 * self.event
            && let Err(error) = self.write_event(at)
        {
            self.error = Some(error);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// Writes the displacement of the event under way, if there is one.
    fn write_event(&mut self, at: &Snapshot<'_, C>) -> Result<(), Failed> {
        let Some(before) = self.before.take() else {
            return Ok(());
        };
        let slips = at.displacement.iter().zip(before);
        let slips: Vec<_> = slips.map(|(after, before)| after - before).collect();
        let name = format!("surface_event_{:03}.vtu", self.count);
        self.count += 1;
        Ok(self.write(&name, &self.receivers.displacement(&slips)?)?)
    }

    fn write(&self, name: &str, moved: &[[f64; 3]]) -> Result<(), FileError> {
        self.grid
            .write(self.folder.join(name), &[("displacement", moved)])
    }

    /// Writes the event under way, and the displacement since the start of the run.
    pub(super) fn finish(mut self, at: &Snapshot<'_, C>) -> Result<(), Failed> {
        if let Some(error) = self.error {
            return Err(error);
        }
        self.write_event(at)?;
        let mut moved = self.receivers.displacement(at.displacement)?;
        for (moved, creep) in moved.iter_mut().zip(self.creep.iter().flatten()) {
            for (moved, creep) in moved.iter_mut().zip(creep) {
                *moved += creep * (at.time - self.begin);
            }
        }
        Ok(self.write("surface_end.vtu", &moved)?)
    }
}
