//! The sides of faults: which one slip belongs to.

use nalgebra::Complex;

use super::Segments;

/// The share of a fault's length below which it is level, or vertical, as a whole.
const NONE: f64 = 1e-6;

/// The side of a fault that slips, and the direction of its slip.
///
/// The normal of a fault points up, in the mean of all cells, that of a vertical one towards `x`; up dip is a quarter of a
/// turn from it, in the plane upwards. A closed fault has its normals to the left of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    /// 1 if normals point to the left of the cells' direction from begin to end, else -1.
    left: f64,
    /// 1 if the normal points towards `x`, in the mean, else -1.
    right: f64,
}

impl Side {
    /// That of each cell.
    pub(super) fn of_cells(segments: &Segments) -> Vec<Self> {
        let faults = 0..segments.fault_count();
        let of_fault = |fault| {
            let side = Self::of_fault(segments, fault);
            segments.cells_of(fault).map(move |_| side)
        };
        faults.flat_map(of_fault).collect()
    }

    fn of_fault(segments: &Segments, fault: usize) -> Self {
        let cells = segments.cells_of(fault);
        let length: f64 = cells.clone().map(|cell| segments.length(cell)).sum();
        let (begin, end) = (
            segments.ends(cells.start)[0],
            segments.ends(cells.end - 1)[1],
        );
        // Sums of the left normals times length.
        let (up, along) = (end[0] - begin[0], begin[1] - end[1]);
        let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
        let [level, vertical] = [along, up].map(|part| part.abs() <= NONE * length);
        let left = match (level, vertical) {
            (true, true) => 1.0,
            (false, true) => sign(along),
            _ => sign(up),
        };
        let right = if level { 1.0 } else { sign(left * along) };
        Self { left, right }
    }

    /// The jump from the right to the left of a cell due to slip by 1 up dip, for its direction.
    pub(super) fn in_plane_jump(self, direction: Complex<f64>) -> Complex<f64> {
        direction * -self.right
    }

    /// The same for antiplane slip by 1.
    pub(super) fn antiplane_jump(self) -> f64 {
        self.left * self.right
    }

    /// The unit vectors normal to a cell and up dip, for its direction.
    pub(super) fn axes(self, direction: Complex<f64>) -> [Complex<f64>; 2] {
        let up = direction * (-self.right * self.left);
        [Complex::new(0.0, self.left) * direction, up]
    }

    /// The slip due to a jump by 1 along `x` that the side towards `x` makes.
    pub(super) fn right(self) -> f64 {
        self.right
    }
}
