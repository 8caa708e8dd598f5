//! A grid of the free surface.

use std::path::Path;

use super::file::write_whole;
use super::vtu::{Field, Grid, Kind, Shape};
use crate::FileError;
use crate::SceneError;
use crate::record::check::{positive, require};

/// A rectangular grid of points of the free surface, as a VTU file with vectors at its points: displacement due to slip on
/// a fault, before and after an event.
///
/// ```
/// # #[cfg(feature = "bie")] {
/// use stickslip::bie::{Cells, Medium, PlaneFault, Receivers, Rectangles};
/// use stickslip::nalgebra::Vector1;
/// use stickslip::record::SurfaceGrid;
///
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Rectangles::new(Cells::new([-10e3, 10e3], 10)?, Cells::new([0.0, 10e3], 5)?);
/// let fault = PlaneFault::half_space(cells, 60.0, rock, 0.25)?.with_rake(90.0)?;
/// // No point is on the trace, y = 0.
/// let grid = SurfaceGrid::new([-20e3, -21.5e3], 1e3, [41, 44])?;
/// let moved = Receivers::new(&fault, &grid.points())?.displacement(&vec![Vector1::new(1.0); 50])?;
/// let path = std::env::temp_dir().join("stickslip-surface-example.vtu");
/// grid.write(&path, &[("displacement", &moved)])?;
/// # std::fs::remove_file(&path)?;
/// # }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("InSAR", "surface displacement", "ParaView"))]
pub struct SurfaceGrid {
    begin: [f64; 2],
    spacing: f64,
    counts: [usize; 2],
}

impl SurfaceGrid {
    /// From its first point `[x, y]`, the distance of neighbours \[m\], and the numbers of points along `x` and `y`.
    ///
    /// # Errors
    /// [`SceneError::Value`] for a first point that is not finite, a distance that is not positive and finite, and less than
    /// two points along an axis.
    pub fn new(begin: [f64; 2], spacing: f64, counts: [usize; 2]) -> Result<Self, SceneError> {
        for value in begin {
            require(
                "first point of a grid [m]",
                "finite",
                value,
                value.is_finite(),
            )?;
        }
        positive("distance of points of a grid [m]", spacing)?;
        for count in counts {
            require(
                "number of points along an axis",
                "at least 2",
                count as f64,
                count >= 2,
            )?;
        }
        Ok(Self {
            begin,
            spacing,
            counts,
        })
    }

    /// The points `[x, y, 0]` \[m\], those along `x` first.
    pub fn points(&self) -> Vec<[f64; 3]> {
        let [columns, rows] = self.counts;
        let place = |axis: usize, k: usize| self.begin[axis] + k as f64 * self.spacing;
        let row = |j: usize| (0..columns).map(move |i| [place(0, i), place(1, j), 0.0]);
        (0..rows).flat_map(row).collect()
    }

    /// Writes vectors at the points, by name.
    ///
    /// # Errors
    /// [`SceneError::Length`] for another number of vectors than points, [`FileError::Write`] for a file that cannot be
    /// written.
    pub fn write(
        &self,
        path: impl AsRef<Path>,
        fields: &[(&'static str, &[[f64; 3]])],
    ) -> Result<(), FileError> {
        let points = self.points();
        for &(what, vectors) in fields {
            let (expected, found) = (points.len(), vectors.len());
            if expected != found {
                let error = SceneError::Length {
                    what,
                    expected,
                    found,
                };
                return Err(error.into());
            }
        }
        let [columns, rows] = self.counts;
        let square = |i: usize, j: usize| {
            let corner = j * columns + i;
            let corners = [corner, corner + 1, corner + columns + 1, corner + columns];
            let [a, b, c, d] = corners.map(|k| k as i64);
            [a, b, c, a, c, d]
        };
        let squares = (1..rows).flat_map(|j| (1..columns).map(move |i| square(i - 1, j - 1)));
        let fields = fields.iter().map(|&(name, vectors)| Field {
            name,
            kind: Kind::Vectors,
            values: vectors.as_flattened().to_vec(),
        });
        let grid = Grid {
            points: points.as_flattened().to_vec(),
            corners: squares.flatten().collect(),
            shape: Shape::Triangle,
            at_points: fields.collect(),
            at_cells: Vec::new(),
        };
        write_whole(path.as_ref(), |file| grid.write(file))
    }
}
