//! Velocity problems of one implicit time step whose minimiser is known, because the load is made
//! for it: `r = B v + grad Phi(v)` for a chosen `v`.

pub(crate) mod coulomb;
mod problem;

use std::ops::Range;

use nalgebra::DMatrix;
use proptest::strategy::{Just, Union};
use proptest::test_runner::Config as ProptestConfig;
use stickslip_fem::{Elastic, FemError, P1, antiplane as shear_stiffness, elasticity, mass};
use stickslip_friction::DieterichRuina;
use stickslip_solvers::{BlockMatrix, NonsmoothSolver, SolveError, Stopping};

pub(crate) use problem::Problem;

pub(crate) type Fallible = Result<(), Box<dyn std::error::Error>>;

/// The parameters of the paper's slider.
pub(crate) const LAW: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};
pub(crate) const NORMAL_STRESS: f64 = 49_050.0;
pub(crate) const DENSITY: f64 = 5e3;
pub(crate) const ELASTIC: Elastic = Elastic {
    young_modulus: 5e7,
    poisson_ratio: 0.3,
};
pub(crate) const TIME_STEP: f64 = 1.5e-3;

/// The law's formula, written anew.
pub(crate) fn coefficient(slip_rate: f64, alpha: f64) -> f64 {
    let aging = alpha + (LAW.reference_velocity / LAW.slip_distance).ln();
    let rate = (slip_rate / LAW.reference_velocity).ln();
    (LAW.reference_friction + LAW.a * rate + LAW.b * aging).max(0.0)
}

/// The regime of the frictional boundary at the minimiser.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Regime {
    /// Old contacts that creep at 1e-30 to 1e-20 m/s.
    Stick,
    /// Young contacts that slide at about 1e-3 m/s.
    Slip,
    /// Vertices of both kinds, in turn.
    Mixed,
    /// Steady creep at rates between 1e-13 and 1e-4 m/s: curvatures of all sizes.
    Creep,
    /// Contacts so young that rates of 1e-3 m/s lie on both sides of the cut-off: there friction
    /// sets in all at once, and a model of second order misses it.
    Fresh,
}

pub(crate) const REGIMES: [Regime; 5] = [
    Regime::Stick,
    Regime::Slip,
    Regime::Mixed,
    Regime::Creep,
    Regime::Fresh,
];

/// So many random cases, unless `PROPTEST_CASES` asks for another number.
pub(crate) fn cases(cases: u32) -> ProptestConfig {
    let asked = ProptestConfig::default();
    if std::env::var_os("PROPTEST_CASES").is_some() {
        return asked;
    }
    ProptestConfig { cases, ..asked }
}

/// Refinements of a random problem, each half as often as the one before: a problem costs four times as much and more.
pub(crate) fn levels(range: Range<usize>) -> Union<Just<usize>> {
    let last = range.end - 1;
    Union::new_weighted(
        range
            .map(|level| (1 << (last - level), Just(level)))
            .collect(),
    )
}

/// Reproducible numbers (splitmix64).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    /// Uniform in [-1, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (self.next() + 1.0)
    }

    /// Of either sign, the logarithm of the modulus uniform.
    pub(crate) fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        let modulus = self.between(low.ln(), high.ln()).exp();
        modulus.copysign(self.next())
    }
}

/// Without and with one iteration, a solver that needs more says so and has not climbed.
pub(crate) fn gives_up<const C: usize>(
    problem: &Problem<C>,
    solver: &mut impl NonsmoothSolver<BlockMatrix<C>, C>,
    tolerance: f64,
) -> Fallible {
    let energy = problem.energy();
    solver.prepare(&energy)?;
    for max_iterations in [0, 1] {
        let stopping = Stopping {
            max_iterations,
            ..problem.stopping(tolerance)
        };
        let mut v = problem.at_rest();
        let before = energy.value(&v);
        let answer = solver.minimize(&energy, &stopping, &mut v);
        let Err(SolveError::NotConverged {
            iterations,
            tolerance: missed,
            ..
        }) = answer
        else {
            panic!("{answer:?}");
        };
        assert_eq!((iterations, missed), (max_iterations, tolerance));
        assert!(energy.value(&v) <= before);
    }
    Ok(())
}

/// All entries of a sparse operator.
pub(crate) fn dense<const C: usize>(operator: &BlockMatrix<C>) -> DMatrix<f64> {
    let size = C * operator.rows();
    let mut matrix = DMatrix::zeros(size, size);
    for (&block, (i, j)) in operator.iter() {
        let (i, j) = (i as usize, j as usize);
        matrix
            .fixed_view_mut::<C, C>(C * i, C * j)
            .copy_from(&block);
    }
    matrix
}

/// The paper's slider: plane strain, one slip component.
pub(crate) fn slider(level: usize, regime: Regime, seed: u64) -> Result<Problem<2>, FemError> {
    slider_on(&P1::grid([5.0, 1.0], [5, 1])?.refined(level)?, regime, seed)
}

/// The slider on a mesh of the strip that is 1 m high.
pub(crate) fn slider_on(space: &P1<2>, regime: Regime, seed: u64) -> Result<Problem<2>, FemError> {
    let operators = (elasticity(space, &ELASTIC)?, mass(space, DENSITY)?);
    let sides = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
    Problem::new(space, operators, sides, [false, true], regime, seed)
}

/// The same body in antiplane shear: a scalar field.
pub(crate) fn antiplane(level: usize, regime: Regime, seed: u64) -> Result<Problem<1>, FemError> {
    let space = P1::grid([5.0, 1.0], [5, 1])?.refined(level)?;
    let (_, shear) = ELASTIC.lame()?;
    let operators = (shear_stiffness(&space, shear)?, mass(&space, DENSITY)?);
    let sides = (space.trace(|x| x[1] == 1.0)?, space.trace(|x| x[1] == 0.0)?);
    Problem::new(&space, operators, sides, [false], regime, seed)
}

/// A solid block with two slip components.
pub(crate) fn block(level: usize, regime: Regime, seed: u64) -> Result<Problem<3>, FemError> {
    block_on(
        &P1::grid([2.0, 1.0, 1.0], [2, 1, 1])?.refined(level)?,
        regime,
        seed,
    )
}

/// The block on a mesh of a body that is 1 m high.
pub(crate) fn block_on(space: &P1<3>, regime: Regime, seed: u64) -> Result<Problem<3>, FemError> {
    let operators = (elasticity(space, &ELASTIC)?, mass(space, DENSITY)?);
    let sides = (space.trace(|x| x[2] == 1.0)?, space.trace(|x| x[2] == 0.0)?);
    Problem::new(space, operators, sides, [false, false, true], regime, seed)
}
