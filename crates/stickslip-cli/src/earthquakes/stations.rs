//! Stations: positions between the cells of a fault.

use stickslip::ContactView;
use stickslip::bie::{Cells, Rectangles};

/// A position between cells, or beyond the outermost centres.
pub(crate) struct Station {
    /// Along strike and down dip \[m\].
    pub(crate) position: [f64; 2],
    /// Cells and their weights.
    cells: Vec<(usize, f64)>,
}

impl Station {
    /// A station on a line.
    pub(crate) fn on_line(cells: &Cells, z: f64) -> Self {
        Self {
            position: [0.0, z],
            cells: neighbours(cells, z).to_vec(),
        }
    }

    /// A station on a plane, along strike and down dip.
    pub(crate) fn on_plane(cells: &Rectangles, [x, y]: [f64; 2]) -> Self {
        let rows = neighbours(cells.down_dip(), y);
        let columns = neighbours(cells.along_strike(), x);
        let pairs = rows
            .iter()
            .flat_map(|row| columns.map(|column| (*row, column)));
        let pairs =
            pairs.map(|((row, down), (column, along))| (cells.index([column, row]), down * along));
        Self {
            position: [x, y],
            cells: pairs.collect(),
        }
    }

    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let terms = self.cells.iter().filter(|(_, weight)| *weight != 0.0);
        terms.map(|&(cell, weight)| weight * value(cell)).sum()
    }

    /// Slip \[m\].
    pub(crate) fn slip<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        self.mean(|k| contact.slip(k))
    }

    /// `log10(V / 1 m/s)`.
    pub(crate) fn log_rate<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        self.mean(|k| contact.slip_rate(k).log10())
    }

    /// The shear stress along the first direction of slip \[Pa\].
    pub(crate) fn stress<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        self.mean(|k| contact.traction(k)[0])
    }

    /// The normal stress \[Pa\].
    pub(crate) fn normal_stress<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        self.mean(|k| contact.normal_stress(k))
    }

    /// The pore pressure \[Pa\].
    pub(crate) fn pore_pressure<const C: usize>(&self, contact: &ContactView<'_, C>) -> f64 {
        self.mean(|k| contact.pore_pressure(k))
    }
}

/// The two cells next to a position, with the weights of linear interpolation.
fn neighbours(cells: &Cells, z: f64) -> [(usize, f64); 2] {
    let last = cells.count() - 1;
    let place = ((z - cells.center(0)) / cells.length()).clamp(0.0, last as f64);
    let first = (place as usize).min(last.saturating_sub(1));
    let share = place - first as f64;
    [(first, 1.0 - share), ((first + 1).min(last), share)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bilinear interpolation is exact for a linear function between centres, and constant beyond them.
    #[test]
    fn interpolation_is_linear() -> Result<(), Box<dyn std::error::Error>> {
        let cells = Rectangles::new(Cells::new([-4.0, 4.0], 8)?, Cells::new([0.0, 5.0], 5)?);
        let value = |[x, y]: [f64; 2]| 3.0 + 2.0 * x - y;
        for (position, seen) in [
            ([0.3, 2.2], [0.3, 2.2]),
            ([-1.5, 0.5], [-1.5, 0.5]),
            ([0.0, 0.0], [0.0, 0.5]),
            ([9.0, 9.0], [3.5, 4.5]),
        ] {
            let mean = Station::on_plane(&cells, position).mean(|k| value(cells.center(k)));
            assert!((mean - value(seen)).abs() < 1e-12, "{position:?} {mean}");
        }
        Ok(())
    }
}
