//! Slip of the cells of a fault, at one time or at several.

use super::per_cell::Layout;
use crate::bodies::PerVertex;
use crate::errors::{Bare, argument};
use pyo3::prelude::*;

/// Finite slips of all cells, the components of one cell after the other, time by time.
pub(super) struct Slips {
    numbers: Vec<f64>,
    /// The numbers of a time.
    row: usize,
    /// The number of times of an array with an axis for them.
    pub(super) times: Option<usize>,
}

impl Slips {
    /// One number per cell, with two components a pair; an array of the shape of the fault; several of them. With one
    /// component also one number for all cells.
    pub(super) fn checked(
        name: &str,
        given: PerVertex,
        cells: Layout,
        components: usize,
    ) -> PyResult<Self> {
        let row = cells.count * components;
        let (numbers, shape) = match given {
            PerVertex::Uniform(slip) if components == 1 => (vec![slip; row], vec![row]),
            PerVertex::Uniform(slip) => (vec![slip], Vec::new()),
            PerVertex::Each(slips) => {
                let shape = vec![slips.len()];
                (slips, shape)
            }
            PerVertex::Shaped(slips, shape) => (slips, shape),
        };
        let is_of_cells = |shape: &[usize]| {
            let shape = match shape {
                [cells @ .., 2] if components == 2 => cells,
                _ if components == 2 => return false,
                cells => cells,
            };
            shape == [cells.count] || cells.shape.is_some_and(|own| shape == own)
        };
        let times = match &shape[..] {
            own if is_of_cells(own) => None,
            [times, own @ ..] if is_of_cells(own) => Some(*times),
            _ => {
                let pair = if components == 2 { " of pairs" } else { "" };
                let requirement = format!(
                    "an array{pair} with one for each of {} cells, or several of them",
                    cells.count
                );
                let given = Bare(format!("of the shape {shape:?}"));
                return Err(argument(name, &requirement, given));
            }
        };
        if let Some(n) = numbers.iter().position(|x| !x.is_finite()) {
            let name = format!("{name}, cell {},", n % row / components);
            return Err(argument(&name, "finite", numbers[n]));
        }
        Ok(Self {
            numbers,
            row,
            times,
        })
    }

    /// Those of each time.
    pub(super) fn each(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.row)
    }
}
