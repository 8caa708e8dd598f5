//! The materials of the cells.

use super::groups::Groups;
use super::kernel::Lame;
use super::lanes::{Numbers, numbers, row};

/// Lamé's parameters of the cells \[Pa\]: one pair, or by fours of cells.
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

    /// Those of one of four cells.
    pub(super) fn of_cell(&self, four: usize, cell: usize) -> (f64, f64) {
        let [lambda, mu] = self.of_four(four).map(numbers);
        (lambda[cell], mu[cell])
    }

    /// Those of four cells.
    #[inline(always)]
    pub(super) fn of_four(&self, four: usize) -> &Lame {
        match self {
            Self::One(one) => one,
            Self::Many(all) => &all[four],
        }
    }
}
