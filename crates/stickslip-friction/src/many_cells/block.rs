//! The parameters of some cells, side by side.

use super::balance::balance;
use super::elementary::{exp, ln};
use super::friction::CellState;
use crate::RegularizedDieterichRuina;

/// Cells in a block: a multiple of the numbers in a register of any width.
pub(super) const CELLS: usize = 64;

/// One number per cell.
pub(super) type Numbers = [f64; CELLS];

/// Law parameters of a block of cells.
///
/// `l = offset - ln(a sigma) - slope state` and `ln theta = log_theta[0] + log_theta[1] state`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Block {
    a: Numbers,
    offset: Numbers,
    slope: Numbers,
    log_theta: [Numbers; 2],
    /// `d state/d ln theta`.
    state_slope: Numbers,
    /// `1/L`.
    per_distance: Numbers,
}

/// Parameters that all cells share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shared {
    /// `eta`.
    pub(super) damping: f64,
    /// The floor of `sigma`.
    pub(super) least_normal_stress: f64,
}

/// The fields at the cells of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fields {
    /// `abs(tau)`.
    pub(super) shear: Numbers,
    pub(super) normal: Numbers,
    pub(super) state: Numbers,
}

impl Block {
    /// A block of at most [`CELLS`] laws, at least one; the last one fills the block.
    pub(super) fn new(
        laws: &[RegularizedDieterichRuina],
        damping: f64,
        variable: CellState,
    ) -> Self {
        let of = |value: &dyn Fn(&RegularizedDieterichRuina) -> f64| -> Numbers {
            std::array::from_fn(|cell| value(&laws[cell.min(laws.len() - 1)]))
        };
        // psi = mu0 + b ln(V0 theta/L) is offset + slope ln theta.
        let scale = |law: &RegularizedDieterichRuina| match variable {
            CellState::LogTheta => [0.0, 1.0],
            CellState::Psi => {
                let steady = (law.reference_velocity / law.slip_distance).ln();
                [-steady - law.reference_friction / law.b, law.b.recip()]
            }
        };
        let offset = |law: &RegularizedDieterichRuina| {
            let rate = (damping * law.reference_velocity).ln();
            match variable {
                CellState::Psi => rate,
                CellState::LogTheta => {
                    let steady = (law.reference_velocity / law.slip_distance).ln();
                    rate - (law.reference_friction + law.b * steady) / law.a
                }
            }
        };
        let in_psi = variable == CellState::Psi;
        Self {
            a: of(&|law| law.a),
            offset: of(&offset),
            slope: of(&|law| if in_psi { law.a.recip() } else { law.b / law.a }),
            log_theta: [of(&|law| scale(law)[0]), of(&|law| scale(law)[1])],
            state_slope: of(&|law| if in_psi { law.b } else { 1.0 }),
            per_distance: of(&|law| law.slip_distance.recip()),
        }
    }

    /// The modulus of the slip rate, and the rate of the state by the slip law or the aging law.
    #[inline(always)]
    pub(super) fn rates<const SLIP_LAW: bool>(
        &self,
        shared: Shared,
        fields: &Fields,
        slip_rate: &mut Numbers,
        state_rate: &mut Numbers,
    ) {
        let per_damping = 1.0 / shared.damping;
        let (mut direct, mut t, mut l) = ([0.0; CELLS], [0.0; CELLS], [0.0; CELLS]);
        for i in 0..CELLS {
            let (normal, least) = (fields.normal[i], shared.least_normal_stress);
            direct[i] = self.a[i] * if normal < least { least } else { normal };
            t[i] = fields.shear[i] / direct[i];
        }
        for i in 0..CELLS {
            l[i] = self.offset[i] - ln(direct[i]) - self.slope[i] * fields.state[i];
        }
        let y = balance(&t, &l);
        for i in 0..CELLS {
            let rate = y[i] * (direct[i] * per_damping);
            let log_theta = self.log_theta[0][i] + self.log_theta[1][i] * fields.state[i];
            let per_time = rate * self.per_distance[i];
            let change = if SLIP_LAW {
                -per_time * (log_theta + ln(per_time))
            } else {
                exp(-log_theta) - per_time
            };
            slip_rate[i] = rate;
            state_rate[i] = self.state_slope[i] * change;
        }
    }
}
