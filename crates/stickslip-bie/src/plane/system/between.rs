//! What slip on planes does on a surface, and slip on the surface on planes.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::FaultSystem;
use super::coupling::Coupling;
use super::placement::Axes;
use crate::hmatrix::Extent;
use crate::interaction::{Interaction, Pair, Pairs};
use crate::surface::SurfacePairs;
use crate::{RectangularDislocation, SurfaceError, SurfaceFault};

/// Makes both interactions.
pub(super) fn between<const C: usize>(
    system: &FaultSystem<C>,
    surface: &SurfaceFault<C>,
) -> Coupling<C> {
    let storage = surface.storage();
    Coupling {
        on_planes: Interaction::new(&OnPlanes::new(system, surface), storage),
        on_surface: Interaction::new(&OnSurface::new(system, surface), storage),
    }
}

/// Refuses interactions beyond the limit of memory, each by itself.
pub(super) fn check<const C: usize>(
    system: &FaultSystem<C>,
    surface: &SurfaceFault<C>,
) -> Result<(), SurfaceError> {
    let storage = surface.storage();
    storage.check(&OnPlanes::new(system, surface))?;
    storage.check(&OnSurface::new(system, surface))?;
    Ok(())
}

/// The boxes of the cells of planes.
fn extents<const C: usize>(system: &FaultSystem<C>) -> Vec<Extent> {
    let planes = 0..system.planes().len();
    let cells = planes.flat_map(|plane| {
        let (axes, cells) = (system.axes(plane), system.cells(plane));
        let half = [cells.along_strike(), cells.down_dip()].map(|cells| 0.5 * cells.length());
        cells.map(move |[x, y]| {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            Extent::of_points(
                corners.map(|[a, b]| axes.point([x + a * half[0], y + b * half[1]]).into()),
            )
        })
    });
    cells.collect()
}

/// Planes as receivers.
struct OnPlanes<'a, const C: usize> {
    system: &'a FaultSystem<C>,
    surface: SurfacePairs<'a, C>,
    axes: Vec<Axes>,
}

impl<'a, const C: usize> OnPlanes<'a, C> {
    fn new(system: &'a FaultSystem<C>, surface: &'a SurfaceFault<C>) -> Self {
        let planes = 0..system.planes().len();
        Self {
            system,
            surface: surface.pairs(),
            axes: planes.map(|plane| system.axes(plane)).collect(),
        }
    }
}

impl<const C: usize> Pairs<C> for OnPlanes<'_, C> {
    fn count(&self) -> usize {
        self.system.vertices_of_planes()
    }

    fn extents(&self) -> Vec<Extent> {
        extents(self.system)
    }

    fn source_extents(&self) -> Vec<Extent> {
        self.surface.extents()
    }

    fn size(&self, receiver: usize) -> f64 {
        self.system.area(receiver)
    }

    fn changes_normal_stress(&self) -> bool {
        true
    }

    fn pair(&self, receiver: usize, source: usize) -> Pair<C> {
        let [plane, cell] = self.system.plane_and_cell(receiver);
        let axes = &self.axes[plane];
        let at = axes.point(self.system.cells(plane).center(cell));
        let tractions = self.surface.tractions(source, &at, &axes.normal);
        let along = (self.system.planes()[plane].directions())
            .map(|[strike, dip]| axes.strike * strike + axes.up_dip * dip);
        (
            SMatrix::from_fn(|r, c| tractions[c].dot(&along[r])),
            SVector::from_fn(|c, _| -tractions[c].dot(&axes.normal)),
        )
    }
}

/// The surface as receiver.
struct OnSurface<'a, const C: usize> {
    system: &'a FaultSystem<C>,
    surface: SurfacePairs<'a, C>,
    /// Each cell of planes.
    sources: Vec<Source<C>>,
}

/// A cell of a plane.
struct Source<const C: usize> {
    rectangle: RectangularDislocation,
    slips: [[f64; 2]; C],
    /// From east, north and up to the coordinates of the rectangle.
    turn: Matrix3<f64>,
    origin: Vector3<f64>,
}

impl<'a, const C: usize> OnSurface<'a, C> {
    fn new(system: &'a FaultSystem<C>, surface: &'a SurfaceFault<C>) -> Self {
        let planes = system.planes().iter().enumerate();
        let sources = planes.flat_map(|(number, plane)| {
            let axes = system.axes(number);
            let left = Vector3::new(-axes.strike.y, axes.strike.x, 0.0);
            let rows = [axes.strike, left, Vector3::z()].map(|axis| axis.transpose());
            let cells = 0..plane.cells().count();
            cells.filter_map(move |cell| {
                Some(Source {
                    rectangle: plane.dislocation(cell)?,
                    slips: *plane.directions(),
                    turn: Matrix3::from_rows(&rows),
                    origin: axes.point([0.0; 2]),
                })
            })
        });
        Self {
            system,
            surface: surface.pairs(),
            sources: sources.collect(),
        }
    }
}

impl<const C: usize> Pairs<C> for OnSurface<'_, C> {
    fn count(&self) -> usize {
        self.surface.count()
    }

    fn extents(&self) -> Vec<Extent> {
        self.surface.extents()
    }

    fn source_extents(&self) -> Vec<Extent> {
        extents(self.system)
    }

    fn size(&self, receiver: usize) -> f64 {
        self.surface.size(receiver)
    }

    fn changes_normal_stress(&self) -> bool {
        true
    }

    fn pair(&self, receiver: usize, source: usize) -> Pair<C> {
        let source = &self.sources[source];
        let [at, normal] = self.surface.center_and_normal(receiver);
        let at = source.turn * (at - source.origin);
        let tractions = source.slips.map(|slip| {
            let stress = source.rectangle.stress(slip, at.into());
            source.turn.transpose() * (stress * (source.turn * normal))
        });
        let along = self.surface.slips(receiver);
        (
            SMatrix::from_fn(|r, c| tractions[c].dot(&along[r])),
            SVector::from_fn(|c, _| -tractions[c].dot(&normal)),
        )
    }
}
