//! Polylines of segments.

use std::ops::Range;

use stickslip_solvers::MeshId;

use super::{SegmentsError, separation};
use crate::{KernelError, Section};

/// Faults along polylines in a plane: each segment is a cell with constant slip.
///
/// Points are `[x, z]` \[m\], `z` the height above the free surface of a half space: depths are negative. Cells are
/// counted from the first point of the first polyline on.
///
/// Stress is infinite at the ends of cells. The centre of each cell must be at least half of its length away from all
/// other cells, or a tenth from those that share an end with it: a fault may branch off a point of another, with cells of
/// equal length by 20 degrees or more. Cells that cross, that cover each other, or have no length are refused.
/// [`quality`](Self::quality) reports neighbours of unequal length and the largest bend.
///
/// ```
/// use stickslip_bie::Segments;
///
/// // A thrust of 60 degrees in cells of 100 m that flattens to 30 degrees 20 km down dip.
/// let bent = Segments::down([(60.0, 20e3), (30.0, 20e3)], 100.0)?;
/// assert_eq!((bent.count(), bent.quality().largest_bend.round()), (400, 30.0));
///
/// // A thrust, and a branch from 5 m down dip.
/// let thrust: Vec<_> = (0..=10).map(|k| [0.5, -0.75_f64.sqrt()].map(|x| x * f64::from(k))).collect();
/// let branch: Vec<_> = (0..=4).map(|k| [thrust[5][0] + f64::from(k), thrust[5][1]]).collect();
/// let faults = Segments::polylines([thrust, branch])?;
/// assert_eq!((faults.fault_count(), faults.cells_of(1)), (2, 10..14));
/// # Ok::<(), stickslip_bie::SegmentsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias(
    "nonplanar fault",
    "rough fault",
    "listric",
    "polyline",
    "branch",
    "splay",
    "step-over"
))]
pub struct Segments {
    ends: Vec<[[f64; 2]; 2]>,
    faults: Vec<Range<usize>>,
}

impl Segments {
    /// One fault: cells between these points, in a row. A polyline that ends at its first point is closed.
    ///
    /// # Errors
    /// [`SegmentsError`] for less than two points, points that are not finite, cells of no length, and cells that are the
    /// same or cross. Centres of cells may be too near to other cells of a [`SegmentFault`](crate::SegmentFault), which
    /// refuses them, until they are [`divided`](Self::divided).
    pub fn polyline(points: &[[f64; 2]]) -> Result<Self, SegmentsError> {
        Self::polylines([points])
    }

    /// Several faults, also branches that begin at a point of another.
    ///
    /// # Errors
    /// Those of [`polyline`](Self::polyline), and no polyline.
    pub fn polylines(
        polylines: impl IntoIterator<Item = impl AsRef<[[f64; 2]]>>,
    ) -> Result<Self, SegmentsError> {
        let (mut ends, mut faults) = (Vec::new(), Vec::new());
        for (fault, points) in polylines.into_iter().enumerate() {
            let (points, first) = (points.as_ref(), ends.len());
            let infinite = |[x, z]: &[f64; 2]| !(x.is_finite() && z.is_finite());
            if let Some(point) = points.iter().position(infinite) {
                let position = points[point];
                return Err(SegmentsError::NotFinite {
                    fault,
                    point,
                    position,
                });
            }
            if points.len() < 2 {
                let found = points.len();
                return Err(SegmentsError::TooFewPoints { fault, found });
            }
            ends.extend(points.windows(2).map(|pair| [pair[0], pair[1]]));
            faults.push(first..ends.len());
        }
        Self::of_cells(ends, faults)
    }

    /// Checked cells.
    pub(super) fn of_cells(
        ends: Vec<[[f64; 2]; 2]>,
        faults: Vec<Range<usize>>,
    ) -> Result<Self, SegmentsError> {
        if faults.is_empty() {
            return Err(SegmentsError::NoFault);
        }
        let segments = Self { ends, faults };
        separation::check_lines(&segments)?;
        Ok(segments)
    }

    /// These faults and others, whose cells follow.
    ///
    /// # Errors
    /// [`SegmentsError`] for cells that are the same or cross.
    pub fn with(&self, others: &Self) -> Result<Self, SegmentsError> {
        let count = self.count();
        let moved = |cells: &Range<usize>| count + cells.start..count + cells.end;
        let faults = self.faults.iter().cloned();
        let faults = faults.chain(others.faults.iter().map(moved)).collect();
        Self::of_cells([&self.ends[..], &others.ends].concat(), faults)
    }

    /// The same faults with each point `[x, z]` \[m\] at another place.
    ///
    /// # Errors
    /// Those of [`polyline`](Self::polyline).
    pub fn map_points(&self, place: impl Fn([f64; 2]) -> [f64; 2]) -> Result<Self, SegmentsError> {
        let points = |cells: &Range<usize>| {
            let own = &self.ends[cells.clone()];
            let last = own.last().map(|[_, end]| *end);
            let points = own.iter().map(|[begin, _]| *begin).chain(last);
            points.map(&place).collect::<Vec<_>>()
        };
        Self::polylines(self.faults.iter().map(points))
    }

    /// The same faults with each cell divided into equal ones of at most `length` \[m\].
    ///
    /// # Errors
    /// [`SegmentsError`] for a length that is not positive and finite, and for more than a million cells.
    pub fn divided(&self, length: f64) -> Result<Self, SegmentsError> {
        crate::error::positive("length [m] of cells", length)?;
        let parts = |cell: usize| (self.length(cell) / length * (1.0 - 1e-12)).ceil().max(1.0);
        super::down::check_count((0..self.count()).map(parts).sum())?;
        let (mut ends, mut faults) = (Vec::new(), Vec::new());
        for cells in &self.faults {
            let first = ends.len();
            for cell in cells.clone() {
                let ([begin, end], parts) = (self.ends[cell], parts(cell) as usize);
                let point = |k: usize| {
                    let share = k as f64 / parts as f64;
                    // Both ends to the bit: neighbours share them.
                    [0, 1].map(|c| begin[c] * (1.0 - share) + end[c] * share)
                };
                ends.extend((0..parts).map(|k| [point(k), point(k + 1)]));
            }
            faults.push(first..ends.len());
        }
        Self::of_cells(ends, faults)
    }

    /// The number of cells of all faults.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// The number of faults.
    pub fn fault_count(&self) -> usize {
        self.faults.len()
    }

    /// The cells of a fault.
    ///
    /// # Panics
    /// For a fault that does not exist.
    pub fn cells_of(&self, fault: usize) -> Range<usize> {
        self.faults[fault].clone()
    }

    /// The fault of a cell.
    pub fn fault_of(&self, cell: usize) -> usize {
        self.faults.partition_point(|cells| cells.end <= cell)
    }

    /// The begin and the end of a cell, `[x, z]` \[m\].
    pub fn ends(&self, cell: usize) -> [[f64; 2]; 2] {
        self.ends[cell]
    }

    pub(super) fn ends_mut(&mut self) -> &mut [[[f64; 2]; 2]] {
        &mut self.ends
    }

    /// The centre of a cell, `[x, z]` \[m\].
    pub fn center(&self, cell: usize) -> [f64; 2] {
        let [a, b] = self.ends[cell];
        [0, 1].map(|c| 0.5 * (a[c] + b[c]))
    }

    /// The length of a cell \[m\].
    pub fn length(&self, cell: usize) -> f64 {
        let [a, b] = self.ends[cell];
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// The distance of the centre of each cell along its fault from its first point \[m\].
    pub fn distances(&self) -> Vec<f64> {
        let of_fault = |cells: Range<usize>| {
            cells.scan(0.0, |end, cell| {
                let length = self.length(cell);
                *end += length;
                Some(*end - 0.5 * length)
            })
        };
        self.faults.iter().cloned().flat_map(of_fault).collect()
    }

    /// The value of a function of position `[x, z]` \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 2]) -> T) -> Vec<T> {
        (0..self.count())
            .map(|cell| self.center(cell))
            .map(value)
            .collect()
    }

    /// The cells whose centres `[x, z]` \[m\] are inside.
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
            let what = "number of cells in a section";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
        }
        Ok(Section::new(self.clone(), vertices))
    }

    /// The cells of a fault as a contact.
    ///
    /// # Errors
    /// [`KernelError`] for a fault that does not exist.
    pub fn section_of(&self, fault: usize) -> Result<Section<Self>, KernelError> {
        let Some(cells) = self.faults.get(fault) else {
            let what = "number of a section's fault";
            let error = KernelError::new(what, "less than", fault as f64);
            return Err(error.bound(self.fault_count() as f64));
        };
        Ok(Section::new(self.clone(), cells.clone().collect()))
    }

    /// The identity by which parts of a scene are matched: the number of cells, and the [fingerprint](Self::fingerprint).
    pub fn identity(&self) -> MeshId {
        MeshId {
            vertices: self.count(),
            elements: None,
            fingerprint: self.fingerprint(),
        }
    }

    /// A fingerprint that other segments do not have, as far as 64 bits allow.
    pub fn fingerprint(&self) -> u64 {
        // FNV-1a over words, as that of `Cells`.
        let coordinates = self.ends.iter().flatten().flatten();
        let lengths = self.faults.iter().map(|cells| cells.len() as u64);
        let words = lengths.chain(coordinates.map(|x| x.to_bits()));
        words.fold(0xcbf2_9ce4_8422_2325, |hash: u64, word| {
            (hash ^ word).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }
}

impl Section<Segments> {
    /// The value of a function of position `[x, z]` \[m\] at the centre of each cell.
    pub fn map<T>(&self, value: impl FnMut([f64; 2]) -> T) -> Vec<T> {
        let centers = self.vertices().iter();
        (centers.map(|&cell| self.cells().center(cell)))
            .map(value)
            .collect()
    }
}
