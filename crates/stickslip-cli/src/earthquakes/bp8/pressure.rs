//! The published pore pressure of BP8 with a Gaussian source, and its check.

use stickslip::ContactView;
use stickslip::bie::{Cells, Rectangles};

use super::super::Failed;
use super::HOUR;
use crate::cli::expect;

/// The times \[s\].
pub(super) const TIMES: [f64; 4] = [100.0 * HOUR, 200.0 * HOUR, 240.0 * HOUR, 720.0 * HOUR];
/// The pressures then at both places \[MPa\], by quadrature of the heat kernel with its images: no fluid passes the sides.
const EXACT: [[f64; 2]; 4] = [
    [13.056_152, 2.571_104],
    [3.202_374, 2.305_918],
    [2.591_537, 2.085_874],
    [1.691_367, 1.689_432],
];
/// The places along strike and down dip \[m\].
const PLACES: [[f64; 2]; 2] = [[0.0, 0.0], [200.0, 0.0]];
/// The number of points of an interpolation along a direction.
const ORDER: usize = 6;

/// The pressure at both places \[MPa\], by interpolation of fifth degree: linear interpolation between cells of 10 m is off
/// by half a percent at the centre. No number for fewer than six cells.
pub(super) fn at_places<const C: usize>(
    cells: &Rectangles,
    contact: &ContactView<'_, C>,
) -> [f64; 2] {
    PLACES.map(|[x, y]| {
        let (Some(along), Some(down)) = (
            weights(cells.along_strike(), x),
            weights(cells.down_dip(), y),
        ) else {
            return f64::NAN;
        };
        let pairs = down
            .iter()
            .flat_map(|row| along.map(|column| (column, *row)));
        let terms = pairs.map(|((column, along), (row, down))| {
            along * down * contact.pore_pressure(cells.index([column, row]))
        });
        1e-6 * terms.sum::<f64>()
    })
}

/// The cells around a position, with their weights.
fn weights(cells: &Cells, x: f64) -> Option<[(usize, f64); ORDER]> {
    let last = cells.count().checked_sub(ORDER)?;
    let place = (x - cells.center(0)) / cells.length();
    let first = (place.floor() as usize).saturating_sub(2).min(last);
    Some(std::array::from_fn(|i| {
        let at = |n: usize| (first + n) as f64;
        let others = (0..ORDER).filter(|&n| n != i);
        (
            first + i,
            others.map(|n| (place - at(n)) / (at(i) - at(n))).product(),
        )
    }))
}

/// Checks the pressures to 1e-4.
pub(super) fn check(found: &[[f64; 2]]) -> Result<(), Failed> {
    for ((found, exact), time) in found.iter().zip(EXACT).zip(TIMES) {
        for ((found, exact), [x, y]) in found.iter().zip(exact).zip(PLACES) {
            let what = format!(
                "pore pressure at ({x}, {y}) m after {} h [MPa]",
                time / HOUR
            );
            expect(&what, *found, exact, 1e-4 * exact)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Interpolation is exact for a polynomial of fifth degree.
    #[test]
    fn interpolation_is_of_fifth_degree() -> Result<(), Failed> {
        let cells = Cells::new([-4.0, 4.0], 8)?;
        let of = |x: f64| 1.0 - 2.0 * x + 0.1 * x.powi(3) + 0.02 * x.powi(5);
        for x in [-3.9, -1.3, 0.0, 0.5, 3.2] {
            let weights = weights(&cells, x).ok_or("too few cells")?;
            let sum: f64 = weights.iter().map(|&(k, w)| w * of(cells.center(k))).sum();
            assert!((sum - of(x)).abs() < 1e-10, "{x}: {sum}");
        }
        Ok(())
    }
}
