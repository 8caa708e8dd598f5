//! The memory of diffusion.

use std::ops::Range;

/// The places of the memory: time, volumes through the sides and by leak-off, pressures of cells and of bores, the
/// permeability that slip raised, the change of porosity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Places {
    pub pressure: Range<usize>,
    pub bores: Range<usize>,
    pub excess: Range<usize>,
    pub porosity: Range<usize>,
}

/// The time \[s\].
pub(super) const TIME: usize = 0;
/// The volume that left through the sides.
pub(super) const DRAINED: usize = 1;
/// The volume that leaked off.
pub(super) const LEAKED: usize = 2;

impl Places {
    pub(super) fn new(cells: usize, bores: usize, evolving: bool, dilatant: bool) -> Self {
        let pressure = 3..3 + cells;
        let bores = pressure.end..pressure.end + bores;
        let excess = bores.end..bores.end + usize::from(evolving) * cells;
        let porosity = excess.end..excess.end + usize::from(dilatant) * cells;
        Self {
            pressure,
            bores,
            excess,
            porosity,
        }
    }

    pub(super) fn count(&self) -> usize {
        self.porosity.end
    }
}
