//! The cells of a plane in space.

use nalgebra::Vector3;

use super::fault::Space;
use super::system::Axes;
use crate::surface::{Loop, Rock};
use crate::{KernelError, PlaneFault};

impl<const C: usize> PlaneFault<C> {
    pub(crate) fn is_periodic(&self) -> bool {
        matches!(self.space, Space::Whole { periodic } if periodic.contains(&true))
    }

    pub(crate) fn elastic_rock(&self) -> Result<Rock, KernelError> {
        let has_surface = matches!(self.space, Space::Half { .. });
        Rock::new(self.rock.shear_modulus, self.poisson_ratio, has_surface)
    }

    /// Along strike, horizontally to the left and up; in a whole space the plane is level.
    pub(crate) fn own_axes(&self) -> Axes {
        Axes::own(self.dip().unwrap_or(0.0))
    }

    /// The directions of slip.
    pub(crate) fn slips(&self, axes: &Axes) -> [Vector3<f64>; C] {
        let directions = self.directions;
        directions.map(|[along, up]| axes.strike * along + axes.up_dip * up)
    }

    /// The cells with their directions of slip, counterclockwise as seen from the hanging wall.
    pub(crate) fn patches(&self, axes: &Axes) -> Vec<(Loop<4>, [Vector3<f64>; C])> {
        let (along, down) = (self.cells.along_strike(), self.cells.down_dip());
        let ends = |cells: &crate::Cells, cell: usize| {
            let [begin, end] = cells.ends();
            let edge = |k: usize| begin + (end - begin) * (k as f64 / cells.count() as f64);
            [edge(cell), edge(cell + 1)]
        };
        let slips = self.slips(axes);
        let patch = |cell: usize| {
            let [column, row] = self.cells.column_and_row(cell);
            let ([left, right], [top, bottom]) = (ends(along, column), ends(down, row));
            let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
            (Loop::new(corners.map(|corner| axes.point(corner))), slips)
        };
        (0..self.cells.count()).map(patch).collect()
    }
}
