//! Quasi-dynamic friction of many cells.

use super::ManyCellsError;
use super::block::{Block, CELLS, Shared};
use super::pass::Pass;
use crate::{FrictionError, FrictionLaw, RegularizedDieterichRuina};

/// The variable that holds the state of a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CellState {
    /// `alpha = ln(theta/1 s)`.
    LogTheta,
    /// `psi = mu0 + b ln(V0 theta/L)`, for `b > 0`.
    Psi,
}

/// The law by which the state of a cell evolves, `alpha = ln theta`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EvolutionLaw {
    /// Dieterich's aging law, `alpha' = exp(-alpha) - V/L`.
    #[doc(alias = "Dieterich")]
    Aging,
    /// Ruina's slip law, `alpha' = -(V/L) (alpha + ln(V/L))`.
    #[doc(alias = "Ruina")]
    Slip,
}

/// Regularised rate- and state-dependent friction with radiation damping on many cells: slip rates and rates of state
/// for given tractions, the right-hand side of a quasi-dynamic earthquake cycle.
///
/// On each cell the traction `tau` balances friction and radiation damping,
///
/// ```text
/// tau = a sigma asinh( V/(2 V0) exp(psi/a) ) + eta V,        psi = mu0 + b ln(V0 theta/L)
/// s + c sinh(s) = t,   t = tau/(a sigma),   c/2 = (eta V0/(a sigma)) exp(-psi/a),   V = (a sigma/eta) c sinh(s)
/// ```
///
/// which has one solution, odd in `tau`. It is found for several cells at a time by a guess and two steps of third
/// order, without a branch: with the feature `simd` in the widest registers of the processor, with the same bits in
/// registers of any width.
///
/// The error of `ln V` is that of one rounding of `t` and of `ln c`, `1.1e-16 (t + abs(ln(c/2)))`, for `s > 3`, and below
/// 1e-13 elsewhere. Slip rates below some `1e-308 a sigma/eta` are 0. [`RegularizedDieterichRuina`] is the law of one
/// cell, for solvers.
///
/// ```
/// use stickslip_friction::{
///     EvolutionLaw, FrictionLaw, QuasiDynamicFriction, RegularizedDieterichRuina, CellState,
/// };
/// use stickslip_state::LogTheta;
///
/// let law = RegularizedDieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 8e-3,
/// };
/// let eta = 32.04e9 / (2.0 * 3464.0);
/// let (variable, evolution) = (CellState::LogTheta, EvolutionLaw::Aging);
/// let friction = QuasiDynamicFriction::new(&[law; 100], eta, variable, evolution, 1e5)?;
/// // Steady sliding at 1 mm/s under 50 MPa.
/// let (rate, alpha) = (1e-3, (8e-3_f64 / 1e-3).ln());
/// let tau = 50e6 * law.coefficient(rate, LogTheta(alpha)) + eta * rate;
/// let (mut slip_rate, mut state_rate) = ([0.0; 100], [0.0; 100]);
/// friction.rates(&[tau; 100], &[50e6; 100], &[alpha; 100], &mut slip_rate, &mut state_rate);
/// assert!((slip_rate[99] / rate - 1.0).abs() < 1e-13 && state_rate[99].abs() < 1e-13);
/// # Ok::<(), stickslip_friction::ManyCellsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias(
    "SIMD",
    "RSF",
    "rate-and-state",
    "radiation damping",
    "aging law",
    "slip law"
))]
pub struct QuasiDynamicFriction {
    blocks: Vec<Block>,
    count: usize,
    shared: Shared,
    evolution: EvolutionLaw,
}

impl QuasiDynamicFriction {
    /// The number of cells that are computed together: fewer cost as much.
    pub const BLOCK: usize = CELLS;

    /// Friction by one law per cell, with the radiation damping `eta = mu/(2 c_s)` [Pa s/m].
    ///
    /// Normal stresses below `least_normal_stress` \[Pa\] count as that: the equation needs `sigma > 0`.
    ///
    /// # Errors
    /// [`ManyCellsError`] for parameters of a law out of their ranges, `b = 0` with the state as `psi`, and for a damping
    /// or a least normal stress that is not finite and positive.
    pub fn new(
        laws: &[RegularizedDieterichRuina],
        damping: f64,
        variable: CellState,
        evolution: EvolutionLaw,
        least_normal_stress: f64,
    ) -> Result<Self, ManyCellsError> {
        FrictionError::check_positive("damping", damping)?;
        FrictionError::check_positive("least_normal_stress", least_normal_stress)?;
        for (cell, law) in laws.iter().enumerate() {
            let mut legal = law.validate();
            if variable == CellState::Psi {
                legal = legal.and_then(|()| FrictionError::check_positive("b", law.b));
            }
            legal.map_err(|source| ManyCellsError {
                cell: Some(cell),
                source,
            })?;
        }
        let blocks = laws.chunks(CELLS);
        Ok(Self {
            blocks: blocks
                .map(|laws| Block::new(laws, damping, variable))
                .collect(),
            count: laws.len(),
            shared: Shared {
                damping,
                least_normal_stress,
            },
            evolution,
        })
    }

    /// The number of cells.
    pub fn cell_count(&self) -> usize {
        self.count
    }

    /// Slip rates [m/s] and rates of the state [1/s], from shear stress \[Pa\], normal stress (compression positive)
    /// \[Pa\] and state.
    ///
    /// A cell with a NaN, or with an infinite shear stress, has NaN as its rates; other cells do not notice. Without
    /// shear stress the slip rate is 0. Allocates nothing.
    ///
    /// # Panics
    /// If a slice does not have one number per cell.
    pub fn rates(
        &self,
        shear_stress: &[f64],
        normal_stress: &[f64],
        state: &[f64],
        slip_rate: &mut [f64],
        state_rate: &mut [f64],
    ) {
        let (shear_stress, slip_rate) = ([shear_stress], [slip_rate]);
        self.vector_rates(shear_stress, normal_stress, state, slip_rate, state_rate);
    }

    /// [`rates`](Self::rates) with `C` components of shear stress and of slip rate: along the traction, by the law of its
    /// modulus.
    ///
    /// # Panics
    /// If a slice does not have one number per cell.
    pub fn vector_rates<const C: usize>(
        &self,
        shear_stress: [&[f64]; C],
        normal_stress: &[f64],
        state: &[f64],
        slip_rate: [&mut [f64]; C],
        state_rate: &mut [f64],
    ) {
        let pass = self.pass(shear_stress, normal_stress, state, slip_rate, state_rate);
        pass.run();
    }

    fn pass<'a, const C: usize>(
        &'a self,
        shear_stress: [&'a [f64]; C],
        normal_stress: &'a [f64],
        state: &'a [f64],
        slip_rate: [&'a mut [f64]; C],
        state_rate: &'a mut [f64],
    ) -> Pass<'a, C> {
        let lengths = [normal_stress.len(), state.len(), state_rate.len()];
        let all = shear_stress.iter().map(|x| x.len());
        let mut all = all.chain(slip_rate.iter().map(|x| x.len())).chain(lengths);
        assert!(
            all.all(|length| length == self.count),
            "one number per cell, of which there are {}",
            self.count
        );
        Pass {
            blocks: &self.blocks,
            shared: self.shared,
            shear_stress,
            normal_stress,
            state,
            slip_rate,
            state_rate,
            is_slip_law: self.evolution == EvolutionLaw::Slip,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same bits in registers of any width, of two numbers as of one cell after the other.
    #[test]
    fn bits_do_not_depend_on_the_width() -> Result<(), ManyCellsError> {
        const COUNT: usize = 2100;
        let spread = |k: usize, low: f64, high: f64| -> [f64; COUNT] {
            std::array::from_fn(|i| low + (high - low) * ((i * k) % COUNT) as f64 / COUNT as f64)
        };
        let (a, normal, state) = (
            spread(7, 0.005, 0.03),
            spread(11, 1e5, 1e8),
            spread(13, -10.0, 25.0),
        );
        let shear: [f64; COUNT] = std::array::from_fn(|i| normal[i] * spread(17, -1.5, 1.5)[i]);
        let laws = a.map(|a| RegularizedDieterichRuina {
            a,
            b: 0.015,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance: 8e-3,
        });
        for evolution in [EvolutionLaw::Aging, EvolutionLaw::Slip] {
            let new = |laws: &[_]| {
                QuasiDynamicFriction::new(laws, 4.6e6, CellState::LogTheta, evolution, 1e3)
            };
            let friction = new(&laws)?;
            let mut results = [[[0.0; COUNT]; 2]; 4];
            let [widest, compiled, scalar, alone] = &mut results;
            let [v, rate] = widest;
            let pass = friction.pass([&shear], &normal, &state, [v], rate);
            #[cfg(feature = "rayon")]
            pass.run_in_threads();
            #[cfg(not(feature = "rayon"))]
            pass.run();
            let [v, rate] = compiled;
            let pass = friction.pass([&shear], &normal, &state, [v], rate);
            std::hint::black_box(pass).run_as_compiled();
            let [v, rate] = scalar;
            let pass = friction.pass([&shear], &normal, &state, [v], rate);
            #[cfg(feature = "simd")]
            pulp::WithSimd::with_simd(pass, pulp::Scalar);
            #[cfg(not(feature = "simd"))]
            pass.run();
            let [v, rate] = alone;
            for i in 0..COUNT {
                let one = new(&laws[i..=i])?;
                let (own, own_rate) = (&mut v[i..=i], &mut rate[i..=i]);
                one.rates(&shear[i..=i], &normal[i..=i], &state[i..=i], own, own_rate);
            }
            let bits = results.map(|result| result.map(|values| values.map(f64::to_bits)));
            assert!(bits.iter().all(|result| *result == bits[0]));
        }
        Ok(())
    }
}
