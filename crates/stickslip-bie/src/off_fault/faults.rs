//! Faults as sources.

use nalgebra::{Complex, Vector3};

use super::{Blocks, Cells, Jump, Lines, Patches, ReceiverError, Segment, Sources};
use crate::segments::Space;
use crate::surface::Loop;
use crate::{
    DippingFault, Fault, FaultSystem, Mode, PlaneFault, SegmentFault, Sense, SurfaceFault,
};

/// A fault with `C` components of slip that moves what is beside it: each of its cells is a source.
///
/// Implement [`sources`](Self::sources) for a fault of one's own by [`Sources::triangles`]. [`Receivers`](crate::Receivers)
/// take it from there.
pub trait OffFault<const C: usize> {
    /// Its cells as sources, in the order of the vertices of its operators, per unit displacement of each vertex.
    ///
    /// # Errors
    /// [`ReceiverError::Periodic`] for a periodic fault.
    fn sources(&self) -> Result<Sources<C>, ReceiverError>;
}

impl OffFault<1> for Fault {
    fn sources(&self) -> Result<Sources<1>, ReceiverError> {
        if self.is_periodic() {
            return Err(ReceiverError::Periodic);
        }
        let (mode, slip) = (self.mode(), 1.0 / self.share_of_slip());
        // Downward: the side of x > 0 is to the left.
        let (jump, direction) = match mode {
            Mode::Antiplane => (Jump::Antiplane(slip), Vector3::y() * slip),
            Mode::InPlane { .. } => {
                let up = Complex::new(0.0, slip);
                (Jump::InPlane(up), Vector3::z() * slip)
            }
        };
        let cells = line(self.cells(), Complex::new(0.0, -1.0), jump);
        let has_surface = self.has_surface();
        let space = Space::new(self.rock(), mode, has_surface);
        let lines = Lines {
            space,
            segments: cells,
        };
        let blocks = Blocks {
            at: Vector3::zeros(),
            normal: Vector3::x(),
            slips: [direction],
        };
        Ok(Sources::new(Cells::Lines(lines), has_surface).of_plane(blocks))
    }
}

impl OffFault<1> for DippingFault {
    fn sources(&self) -> Result<Sources<1>, ReceiverError> {
        let [cos, sin] = crate::plane::cos_sin(self.dip());
        let down = Complex::new(cos, -sin);
        let jump = match self.sense() {
            Sense::Thrust => -down,
            Sense::Normal => down,
        };
        let (rock, poisson_ratio) = self.rock();
        let lines = Lines {
            space: Space::new(rock, Mode::InPlane { poisson_ratio }, true),
            segments: line(self.cells(), down, Jump::InPlane(jump)),
        };
        let blocks = Blocks {
            at: Vector3::zeros(),
            normal: Vector3::new(sin, 0.0, cos),
            slips: [Vector3::new(jump.re, 0.0, jump.im)],
        };
        Ok(Sources::new(Cells::Lines(lines), true).of_plane(blocks))
    }
}

/// The cells of a line from the origin.
fn line(cells: &crate::Cells, direction: Complex<f64>, jump: Jump) -> Vec<Segment> {
    let ([begin, end], count) = (cells.ends(), cells.count());
    let edge = |k: usize| begin + (end - begin) * (k as f64 / count as f64);
    let segment = |k: usize| Segment {
        ends: [direction * edge(k), direction * edge(k + 1)],
        jump,
    };
    (0..count).map(segment).collect()
}

impl OffFault<1> for SegmentFault {
    fn sources(&self) -> Result<Sources<1>, ReceiverError> {
        let (lines, has_surface) = self.lines();
        Ok(Sources::new(Cells::Lines(lines), has_surface))
    }
}

impl<const C: usize> OffFault<C> for PlaneFault<C> {
    fn sources(&self) -> Result<Sources<C>, ReceiverError> {
        if self.is_periodic() {
            return Err(ReceiverError::Periodic);
        }
        let (rock, has_surface) = (self.elastic_rock()?, self.dip().is_some());
        let axes = self.own_axes();
        let blocks = Blocks {
            at: axes.point([0.0, 0.0]),
            normal: axes.normal,
            slips: self.slips(&axes),
        };
        let cells = self.patches(&axes);
        let patches = Patches { rock, cells };
        Ok(Sources::new(Cells::Rectangles(patches), has_surface).of_plane(blocks))
    }
}

impl<const C: usize> OffFault<C> for FaultSystem<C> {
    fn sources(&self) -> Result<Sources<C>, ReceiverError> {
        let planes = self.planes();
        // There is at least one.
        let rock = planes[0].elastic_rock()?;
        let of_plane = |number: usize| planes[number].patches(&self.axes(number));
        let cells = (0..planes.len()).flat_map(of_plane).collect();
        let rectangles = Patches { rock, cells };
        let cells = match self.surface() {
            Some(surface) => Cells::Both(rectangles, triangles(surface)),
            None => Cells::Rectangles(rectangles),
        };
        Ok(Sources::new(cells, true))
    }
}

impl<const C: usize> OffFault<C> for SurfaceFault<C> {
    fn sources(&self) -> Result<Sources<C>, ReceiverError> {
        let cells = Cells::Triangles(triangles(self));
        Ok(Sources::new(cells, self.has_surface()))
    }
}

/// The triangles of a surface, each with its directions of slip.
fn triangles<const C: usize>(fault: &SurfaceFault<C>) -> Patches<C, 3> {
    let cells = fault.cells();
    let patch = |cell: usize| {
        let axes = cells.axes(cell);
        let [strike, up_dip] = [axes.strike, axes.up_dip].map(Vector3::from);
        let directions = fault.directions()[cell];
        let slips = directions.map(|[along, up]| strike * along + up_dip * up);
        (Loop::new(cells.corners(cell).map(Vector3::from)), slips)
    };
    Patches {
        rock: fault.elastic_rock(),
        cells: (0..cells.count()).map(patch).collect(),
    }
}
