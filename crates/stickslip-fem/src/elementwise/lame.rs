//! The materials of the cells.

use super::groups::Groups;
use super::kernel::Lame;
use super::lanes::{Numbers, numbers, row};

/// Lamé's parameters of the cells \[Pa\]: one pair, or by rows of four cells.
#[derive(Debug)]
pub(super) enum Materials {
    One(Lame),
    Many(Vec<Lame>),
}

impl Materials {
    pub(super) fn of(groups: &Groups, lame: &dyn Fn(usize) -> (f64, f64)) -> Self {
        let fours = groups.cells.iter().map(|cells| -> [Numbers; 2] {
            let pairs = cells.map(|cell| lame(cell as usize));
            [pairs.map(|pair| pair.0), pairs.map(|pair| pair.1)]
        });
        let first = fours.clone().next().unwrap_or_default();
        let one = first.map(|parameters| [parameters[0]; 4]);
        if fours.clone().all(|four| four == one) {
            Self::One(one.map(row))
        } else {
            Self::Many(fours.map(|four| four.map(row)).collect())
        }
    }

    /// Those of a cell of a row.
    pub(super) fn of_cell(&self, row: usize, cell: usize) -> (f64, f64) {
        let [lambda, mu] = self.of_row(row).map(numbers);
        (lambda[cell], mu[cell])
    }

    /// Those of a row of cells.
    #[inline(always)]
    pub(super) fn of_row(&self, row: usize) -> &Lame {
        match self {
            Self::One(one) => one,
            Self::Many(all) => &all[row],
        }
    }
}
