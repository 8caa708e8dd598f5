//! Uniform cells along a line, and sections of them.

use stickslip_solvers::MeshId;

use crate::KernelError;

/// The largest relative deviation of a cell's length from the mean.
const EVEN: f64 = 1e-9;
const CELLS: &str = "number of cells";

/// Cells of equal length along a fault, with constant slip on each.
///
/// ```
/// use stickslip_bie::Cells;
///
/// let cells = Cells::new([0.0, 40e3], 400)?;
/// assert_eq!((cells.length(), cells.center(0), cells.center(399)), (100.0, 50.0, 39_950.0));
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cells {
    begin: f64,
    end: f64,
    count: usize,
}

impl Cells {
    /// `count` cells from one end to the other \[m\].
    ///
    /// # Errors
    /// [`KernelError`] for no cells, and for ends that are not finite or do not increase.
    pub fn new([begin, end]: [f64; 2], count: usize) -> Result<Self, KernelError> {
        if count == 0 {
            return Err(KernelError::new(CELLS, "at least", 0.0).bound(1.0));
        }
        let length = (end - begin) / count as f64;
        if !(length > 0.0 && length.is_finite() && begin.is_finite() && end.is_finite()) {
            let requirement = "finite, and at a finite distance beyond the start at";
            return Err(KernelError::new("end of the cells [m]", requirement, end).bound(begin));
        }
        Ok(Self { begin, end, count })
    }

    /// Cells between these edges \[m\], which must be equally spaced.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new); [`KernelError`] for a cell whose length is off the mean by more than 1e-9 of
    /// it.
    pub fn between(edges: &[f64]) -> Result<Self, KernelError> {
        let (Some(&begin), Some(&end)) = (edges.first(), edges.last()) else {
            return Err(KernelError::new(CELLS, "at least", 0.0).bound(1.0));
        };
        let cells = Self::new([begin, end], edges.len() - 1)?;
        let mean = cells.length();
        for (cell, pair) in edges.windows(2).enumerate() {
            let length = pair[1] - pair[0];
            // What is not a number is not even either.
            let even = (length - mean).abs() <= EVEN * mean;
            if !even {
                let uneven = KernelError::new("length [m] of cell", "the mean of all,", length);
                return Err(KernelError {
                    cell: Some(cell),
                    ..uneven.bound(mean)
                });
            }
        }
        Ok(cells)
    }

    /// The number of cells.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The length of a cell \[m\].
    pub fn length(&self) -> f64 {
        (self.end - self.begin) / self.count as f64
    }

    /// The start of the first cell and the end of the last one \[m\].
    pub fn ends(&self) -> [f64; 2] {
        [self.begin, self.end]
    }

    /// The middle of a cell \[m\].
    pub fn center(&self, cell: usize) -> f64 {
        self.begin + (cell as f64 + 0.5) * self.length()
    }

    /// The value of a function of position \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut(f64) -> T) -> Vec<T> {
        (0..self.count)
            .map(|cell| self.center(cell))
            .map(value)
            .collect()
    }

    /// All cells.
    pub fn all(&self) -> Section {
        Section {
            of: *self,
            vertices: (0..self.count).collect(),
        }
    }

    /// The cells whose centres lie from one position to another \[m\], the first included, the second not: sections
    /// with a common end share no cell.
    ///
    /// # Errors
    /// [`KernelError`] if no cell has its centre there.
    pub fn section(&self, [from, to]: [f64; 2]) -> Result<Section, KernelError> {
        let inside = |cell: &usize| (from..to).contains(&self.center(*cell));
        let vertices: Vec<_> = (0..self.count).filter(inside).collect();
        if vertices.is_empty() {
            let requirement = "beyond the centre of a cell that lies at or after";
            return Err(KernelError::new("end of a section [m]", requirement, to).bound(from));
        }
        Ok(Section {
            of: *self,
            vertices,
        })
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
        // FNV-1a over words. Source: G. Fowler, L. Noll, K.-P. Vo, D. Eastlake, IETF draft-eastlake-fnv.
        let words = [self.begin.to_bits(), self.end.to_bits(), self.count as u64];
        words.iter().fold(0xcbf2_9ce4_8422_2325, |hash: u64, word| {
            (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }
}

/// Some cells of a fault as a contact: of a line, or of a plane ([`Rectangles`](crate::Rectangles)).
#[derive(Debug, Clone, PartialEq)]
pub struct Section<G = Cells> {
    of: G,
    vertices: Vec<usize>,
}

impl<G> Section<G> {
    pub(crate) fn new(of: G, vertices: Vec<usize>) -> Self {
        Self { of, vertices }
    }

    /// The cells, increasing: the vertices of the operators.
    pub fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    /// The cells of which they are a section.
    pub fn cells(&self) -> &G {
        &self.of
    }
}

impl Section {
    /// The value of a function of position \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut(f64) -> T) -> Vec<T> {
        let centers = self.vertices.iter().map(|&cell| self.of.center(cell));
        centers.map(value).collect()
    }
}
