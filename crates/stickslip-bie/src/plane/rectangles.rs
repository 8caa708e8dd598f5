//! Rectangular cells of a plane.

use stickslip_solvers::MeshId;

use crate::{Cells, KernelError, Section};

/// Equal rectangular cells of a plane: cells along strike times cells down dip, with constant slip on each.
///
/// Positions are `[x, y]` \[m\]: `x` along strike, `y` down dip. In a half space `y` is the distance from the free
/// surface along the plane, and the depth is `y sin(dip)`. Cells along strike are numbered first.
///
/// ```
/// use stickslip_bie::{Cells, Rectangles};
///
/// let cells = Rectangles::new(Cells::new([-50e3, 50e3], 100)?, Cells::new([0.0, 40e3], 40)?);
/// assert_eq!((cells.count(), cells.area()), (4000, 1e6));
/// assert_eq!(cells.center(101), [-48.5e3, 1.5e3]);
/// // The seismogenic part as a contact of its own.
/// let seismogenic = cells.section(|[x, y]| x.abs() < 30e3 && (2e3..14e3).contains(&y))?;
/// assert_eq!(seismogenic.vertices().len(), 60 * 12);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangles {
    along_strike: Cells,
    down_dip: Cells,
}

impl Rectangles {
    /// The cells between the ends of both.
    pub fn new(along_strike: Cells, down_dip: Cells) -> Self {
        Self {
            along_strike,
            down_dip,
        }
    }

    /// The columns: the cells along strike.
    pub fn along_strike(&self) -> &Cells {
        &self.along_strike
    }

    /// The rows: the cells down dip.
    pub fn down_dip(&self) -> &Cells {
        &self.down_dip
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.along_strike.count() * self.down_dip.count()
    }

    /// The area of a cell [m^2].
    pub fn area(&self) -> f64 {
        self.along_strike.length() * self.down_dip.length()
    }

    /// The index of the cell of a column and a row.
    pub fn index(&self, [column, row]: [usize; 2]) -> usize {
        row * self.along_strike.count() + column
    }

    /// The column and the row of a cell.
    pub fn column_and_row(&self, cell: usize) -> [usize; 2] {
        let columns = self.along_strike.count();
        [cell % columns, cell / columns]
    }

    /// The middle of a cell \[m\].
    pub fn center(&self, cell: usize) -> [f64; 2] {
        let [column, row] = self.column_and_row(cell);
        [self.along_strike.center(column), self.down_dip.center(row)]
    }

    /// The value of a function of position \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 2]) -> T) -> Vec<T> {
        let centers = (0..self.count()).map(|cell| self.center(cell));
        centers.map(value).collect()
    }

    /// All cells.
    pub fn all(&self) -> Section<Self> {
        Section::new(*self, (0..self.count()).collect())
    }

    /// The cells whose centres \[m\] are inside.
    ///
    /// # Errors
    /// [`KernelError`] if no centre is inside.
    pub fn section(
        &self,
        mut inside: impl FnMut([f64; 2]) -> bool,
    ) -> Result<Section<Self>, KernelError> {
        let cells = 0..self.count();
        let vertices: Vec<_> = cells.filter(|&cell| inside(self.center(cell))).collect();
        if vertices.is_empty() {
            let what = "number of cells of a section";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        }
        Ok(Section::new(*self, vertices))
    }

    /// The identity by which parts of a scene are matched: the number of cells, and the [fingerprint](Self::fingerprint).
    pub fn identity(&self) -> MeshId {
        MeshId {
            vertices: self.count(),
            elements: None,
            fingerprint: self.fingerprint(),
        }
    }

    /// A fingerprint that other cells do not have, as far as 64 bits allow.
    pub fn fingerprint(&self) -> u64 {
        let [strike, dip] = [self.along_strike, self.down_dip].map(|cells| cells.fingerprint());
        // Not symmetric: the cells of a plane that is turned are others. The multiplier is that of `Cells`.
        (strike.rotate_left(23) ^ dip).wrapping_mul(0x0000_0100_0000_01b3)
    }
}

impl Section<Rectangles> {
    /// The value of a function of position \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 2]) -> T) -> Vec<T> {
        let cells = self.vertices().iter();
        let centers = cells.map(|&cell| self.cells().center(cell));
        centers.map(value).collect()
    }
}
