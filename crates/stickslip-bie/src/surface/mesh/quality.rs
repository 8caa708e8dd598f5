//! What a surface of triangles looks like.

use std::fmt;

use nalgebra::Vector3;

use super::Triangles;
use super::vertices::bounds;

/// The share of the longest side below which a height is that of a needle.
const NEEDLE: f64 = 0.05;
/// The ratio of areas of neighbours that is uneven.
const UNEVEN: f64 = 4.0;
/// The bend between neighbours that is sharp \[degrees\].
const SHARP: f64 = 5.0;

/// The size and the shape of triangles: what to look at before a run. Displayed as a line of text, with the box in metres.
///
/// [`Triangles::quality`] makes it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SurfaceQuality {
    /// The number of triangles.
    pub count: usize,
    /// The number of sheets.
    pub sheets: usize,
    /// The sides of the box \[m\].
    pub extent: [f64; 3],
    /// The total area [m^2].
    pub area: f64,
    /// The shortest and the longest side of triangles \[m\].
    pub sides: [f64; 2],
    /// Triangles with a height below a twentieth of their longest side.
    pub needles: Vec<usize>,
    /// Neighbours with areas of a ratio above 4.
    pub uneven: Vec<[usize; 2]>,
    /// The largest bend between neighbours \[degrees\], and where.
    pub largest_bend: Option<(f64, [usize; 2])>,
    /// The number of bends above 5 degrees: the normal stress there grows as the cells get smaller.
    pub sharp_bends: usize,
}

impl Triangles {
    /// The size and the shape of the triangles.
    pub fn quality(&self) -> SurfaceQuality {
        let [low, high] = bounds(self.points.iter());
        let mut found = SurfaceQuality {
            count: self.count(),
            sheets: self.sheet_count(),
            extent: [0, 1, 2].map(|c| high[c] - low[c]),
            area: (0..self.count()).map(|cell| self.area(cell)).sum(),
            sides: [f64::INFINITY, 0.0],
            needles: Vec::new(),
            uneven: Vec::new(),
            largest_bend: None,
            sharp_bends: 0,
        };
        for cell in 0..self.count() {
            let corners = self.corners(cell).map(Vector3::from);
            let side = |k: usize| (corners[(k + 1) % 3] - corners[k]).norm();
            let sides = [0, 1, 2].map(side);
            let longest = sides.into_iter().fold(0.0, f64::max);
            found.sides[0] = sides.into_iter().fold(found.sides[0], f64::min);
            found.sides[1] = found.sides[1].max(longest);
            if 2.0 * self.area(cell) < NEEDLE * longest * longest {
                found.needles.push(cell);
            }
            for &other in self.neighbors(cell).iter().flatten() {
                if cell < other {
                    found.add_pair(self, [cell, other]);
                }
            }
        }
        found
    }

    /// The largest angle of a triangle with those that continue it \[degrees\]: where a surface bends sharply, its normal
    /// stress may vanish by slip.
    pub fn bend_at(&self, cell: usize) -> f64 {
        let others = self.neighbors(cell).iter().flatten();
        let bends = others.map(|&other| self.bend([cell, other]));
        bends.fold(0.0, f64::max)
    }

    /// The angle between two triangles \[degrees\].
    fn bend(&self, pair: [usize; 2]) -> f64 {
        let [own, other] = pair.map(|cell| Vector3::from(self.axes(cell).normal));
        own.cross(&other).norm().atan2(own.dot(&other)).to_degrees()
    }
}

impl SurfaceQuality {
    fn add_pair(&mut self, cells: &Triangles, pair: [usize; 2]) {
        let [own, other] = pair.map(|cell| cells.area(cell));
        if own.max(other) > UNEVEN * own.min(other) {
            self.uneven.push(pair);
        }
        let bend = cells.bend(pair);
        self.sharp_bends += usize::from(bend > SHARP);
        if self.largest_bend.is_none_or(|(largest, _)| bend > largest) {
            self.largest_bend = Some((bend, pair));
        }
    }
}

impl fmt::Display for SurfaceQuality {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.extent;
        let [shortest, longest] = self.sides;
        write!(
            formatter,
            "{} triangles, {} sheets, box {x:.4} m x {y:.4} m x {z:.4} m, area {:.4e} m^2, sides {shortest:.4} to \
             {longest:.4} m, {} needles, {} uneven neighbours",
            self.count,
            self.sheets,
            self.area,
            self.needles.len(),
            self.uneven.len(),
        )?;
        if let Some((bend, [cell, other])) = self.largest_bend {
            write!(
                formatter,
                ", largest bend {bend:.3} degrees (cells {cell}, {other}), {} above 5 degrees",
                self.sharp_bends
            )?;
        }
        Ok(())
    }
}
