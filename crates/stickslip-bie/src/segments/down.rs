//! Faults by their dip.

use super::{Segments, SegmentsError};
use crate::KernelError;
use crate::error::positive;
use crate::plane::cos_sin;

/// The largest number of cells of segments.
const MOST: usize = 1_000_000;

/// A fault by its dip: straight pieces, one after the other down dip, and bends between them.
///
/// Dips are in degrees from the direction of `x` down, from 0 to 180: 90 is vertical, and above 90 the fault dips towards
/// negative `x`. A sharp bend is no model for a normal stress that follows slip, because it grows as 1/h there: bends
/// are to be [spread](Self::spread) over many cells.
///
/// ```
/// use stickslip_bie::{DipProfile, Segments};
///
/// let listric = DipProfile::new([(60.0, 20e3), (30.0, 20e3)]).spread(4e3);
/// assert_eq!(listric.dip(20e3), 45.0);
/// let cells = Segments::down(listric, 100.0)?;
/// // 30 degrees over 40 cells.
/// assert!((cells.quality().largest_bend - 0.75).abs() < 1e-9);
/// # Ok::<(), stickslip_bie::SegmentsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DipProfile {
    /// Dip in degrees and length of each piece.
    pieces: Vec<(f64, f64)>,
    spread: f64,
    from: [f64; 2],
}

impl DipProfile {
    /// Pieces of a dip in degrees and a length \[m\], down dip from the origin.
    pub fn new(pieces: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self {
            pieces: pieces.into_iter().collect(),
            spread: 0.0,
            from: [0.0; 2],
        }
    }

    /// Spreads each bend over a length \[m\], half of it on either side: the dip is linear in the distance there.
    #[must_use]
    pub fn spread(self, length: f64) -> Self {
        Self {
            spread: length,
            ..self
        }
    }

    /// The same from another first point `[x, z]` \[m\].
    #[must_use]
    pub fn starting_at(self, from: [f64; 2]) -> Self {
        Self { from, ..self }
    }

    /// The whole length down dip \[m\].
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(|(_, length)| length).sum()
    }

    /// The dip in degrees at a distance from the first point \[m\].
    pub fn dip(&self, distance: f64) -> f64 {
        let mut dip = self.pieces.first().map_or(f64::NAN, |(dip, _)| *dip);
        let mut begin = 0.0;
        for pair in self.pieces.windows(2) {
            begin += pair[0].1;
            let share = if self.spread > 0.0 {
                ((distance - begin) / self.spread + 0.5).clamp(0.0, 1.0)
            } else {
                f64::from(u8::from(distance >= begin))
            };
            dip += share * (pair[1].0 - pair[0].0);
        }
        dip
    }

    fn check(&self) -> Result<(), SegmentsError> {
        if self.pieces.is_empty() {
            let what = "number of pieces down dip";
            return Err(KernelError::new(what, "at least", 0.0).bound(1.0).into());
        }
        for (piece, &(dip, length)) in self.pieces.iter().enumerate() {
            check_dip("dip [degrees] of piece", dip).map_err(|error| error.of_cell(piece))?;
            positive("length [m] of piece", length).map_err(|error| error.of_cell(piece))?;
        }
        if !(self.spread >= 0.0 && self.spread.is_finite()) {
            let error =
                KernelError::new("length [m] of a bend", "finite, and at least", self.spread);
            return Err(error.bound(0.0).into());
        }
        let last = self.pieces.len() - 1;
        for (piece, &(_, length)) in self.pieces.iter().enumerate() {
            // One bend takes half of its length from each piece: an inner piece has two of them.
            let most = if piece == 0 || piece == last {
                2.0
            } else {
                1.0
            } * length;
            if last > 0 && self.spread > most * (1.0 + 1e-9) {
                return Err(SegmentsError::Spread {
                    bend: piece.min(last - 1),
                    length: self.spread,
                    most,
                });
            }
        }
        Ok(())
    }
}

impl<P: IntoIterator<Item = (f64, f64)>> From<P> for DipProfile {
    fn from(pieces: P) -> Self {
        Self::new(pieces)
    }
}

impl Segments {
    /// A fault by its dip, in cells of about `length` \[m\]: pieces of a dip in degrees and a length \[m\] down dip from
    /// the origin at the free surface, or a [`DipProfile`].
    ///
    /// With sharp bends the cells of each piece are equal; with bends that are spread all cells are.
    ///
    /// # Errors
    /// [`SegmentsError`] for no pieces, dips that are not from 0 to 180, lengths that are not positive and finite, bends
    /// that are spread beyond the pieces, more than a million cells, and the errors of [`polyline`](Self::polyline).
    pub fn down(profile: impl Into<DipProfile>, length: f64) -> Result<Self, SegmentsError> {
        let profile = profile.into();
        profile.check()?;
        if profile.spread > 0.0 {
            let dip = |distance| profile.dip(distance);
            return Self::by_dip(profile.from, profile.length(), length, dip);
        }
        positive("length [m] of cells", length)?;
        check_count(profile.length() / length)?;
        let mut points = vec![profile.from];
        for &(dip, whole) in &profile.pieces {
            let count = parts(whole, length);
            let (begin, [cos, sin]) = (points[points.len() - 1], cos_sin(dip));
            points.extend((1..=count).map(|k| {
                let distance = whole * k as f64 / count as f64;
                [begin[0] + distance * cos, begin[1] - distance * sin]
            }));
        }
        Self::polyline(&points)
    }

    /// A fault from a point `[x, z]` \[m\] on, of a whole length down dip \[m\], in equal cells of about `cell` \[m\], by
    /// its dip in degrees at the distance of the centre of each cell from that point \[m\]: from 0 to 180, above 90 towards negative `x`.
    ///
    /// ```
    /// use stickslip_bie::Segments;
    ///
    /// // A quarter of a circle of 10 km.
    /// let arc = 10e3 * std::f64::consts::FRAC_PI_2;
    /// let cells = Segments::by_dip([0.0; 2], arc, 100.0, |distance| 90.0 * (1.0 - distance / arc))?;
    /// let [_, [x, z]] = cells.ends(cells.count() - 1);
    /// assert!((x - 10e3).abs() < 1.0 && (z + 10e3).abs() < 1.0);
    /// # Ok::<(), stickslip_bie::SegmentsError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`down`](Self::down).
    pub fn by_dip(
        from: [f64; 2],
        whole: f64,
        cell: f64,
        dip: impl Fn(f64) -> f64,
    ) -> Result<Self, SegmentsError> {
        positive("length [m] down dip", whole)?;
        positive("length [m] of cells", cell)?;
        check_count(whole / cell)?;
        let count = parts(whole, cell);
        let length = whole / count as f64;
        let mut points = vec![from];
        let [mut x, mut z] = from;
        for k in 0..count {
            let dip = dip((k as f64 + 0.5) * length);
            check_dip("dip [degrees] of cell", dip).map_err(|error| error.of_cell(k))?;
            let [cos, sin] = cos_sin(dip);
            (x, z) = (x + length * cos, z - length * sin);
            points.push([x, z]);
        }
        Self::polyline(&points)
    }
}

/// The number of cells of about a length in a whole one.
fn parts(whole: f64, cell: f64) -> usize {
    (whole / cell).round().max(1.0) as usize
}

/// Refuses more cells than memory is for.
pub(super) fn check_count(cells: f64) -> Result<(), SegmentsError> {
    if cells <= MOST as f64 {
        return Ok(());
    }
    Err(SegmentsError::TooManyCells { cells, most: MOST })
}

fn check_dip(what: &'static str, dip: f64) -> Result<(), KernelError> {
    if (0.0..=180.0).contains(&dip) {
        return Ok(());
    }
    Err(KernelError::new(what, "from 0 to", dip).bound(180.0))
}
