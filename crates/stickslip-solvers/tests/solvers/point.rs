//! A scene of one vertex: the local minimisation is the whole answer, also without the sparse solvers.

use crate::common::cases;
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{DieterichRuina, Radial, Tresca};
use stickslip_solvers::{
    Energy, Matrix, NonsmoothSolver, Operator, Point, SolveError, SolveReport, Stopping,
};
use stickslip_state::LogTheta;

const LAW: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

fn coefficient(slip_rate: f64, alpha: f64) -> f64 {
    let rate = LAW.a * (slip_rate / LAW.reference_velocity).ln();
    let aging = LAW.b * (alpha + (LAW.reference_velocity / LAW.slip_distance).ln());
    (LAW.reference_friction + rate + aging).max(0.0)
}

fn solve<P, const C: usize>(
    operator: &SMatrix<f64, C, C>,
    load: SVector<f64, C>,
    potentials: &[P],
    fixed: [bool; C],
    start: SVector<f64, C>,
) -> Result<(SVector<f64, C>, SolveReport), SolveError>
where
    P: stickslip_friction::ConvexPotential<C>,
{
    let energy = Energy {
        operator,
        load: &[load],
        potentials: &potentials,
        vertices: &[0][..potentials.len()],
        fixed: &[fixed],
    };
    let stopping = Stopping {
        norm: operator,
        tolerance: 1e-12,
        relative: 0.0,
        equivalence: 1.0,
        max_iterations: 1,
    };
    let mut v = [start];
    Point.prepare(&energy)?;
    let report = Point.minimize(&energy, &stopping, &mut v)?;
    Ok((v[0], report))
}

/// `F F^T + I` for a random `F`, scaled.
fn spd<const C: usize>(entries: &[f64], scale: f64) -> SMatrix<f64, C, C> {
    let f = SMatrix::<f64, C, C>::from_fn(|i, j| entries[3 * i + j]);
    (f * f.transpose() + SMatrix::identity()) * scale
}

proptest! {
    #![proptest_config(cases(1000))]

    /// `s V + k mu(V) = g` for a chosen `V`: the answer is known, and with it the rounding errors
    /// that the logarithms of large quotients leave in it.
    #[test]
    fn one_component_is_exact(
        log_rate in -80.0..2.0_f64, alpha in -12.0..12.0_f64,
        log_stiffness in 0.0..20.0_f64, log_force in 0.0..12.0_f64,
        negative in any::<bool>(),
    ) {
        let (stiffness, force) = (log_stiffness.exp(), log_force.exp());
        let rate = if negative { -log_rate.exp() } else { log_rate.exp() };
        let drive = stiffness * rate.abs() + force * coefficient(rate.abs(), alpha);
        let radial = Radial { law: LAW, force, state: LogTheta(alpha) };
        let (v, report) = solve(
            &SMatrix::from([[stiffness]]),
            SVector::from([drive.copysign(rate)]),
            &[radial], [false], SVector::zeros(),
        )?;
        // Where nothing rubs, V = g/s; else d ln V = dg / (s V + k a), with terms of 100 a in mu.
        let terms = stiffness * rate.abs() + force * (2.0 + 100.0 * LAW.a);
        let resistance = stiffness * rate.abs()
            + if coefficient(rate.abs(), alpha) > 0.0 { force * LAW.a } else { 0.0 };
        let bound = 8.0 * f64::EPSILON * (100.0 + terms / resistance);
        prop_assert!((v[0] / rate - 1.0).abs() <= bound, "{} {rate} {bound:e}", v[0]);
        prop_assert_eq!((report.iterations, report.error), (1, 0.0));
        prop_assert_eq!(report.work(), 1);
    }

    /// Coulomb: `V = (abs(g) - k mu)/s` outside the cone, rest within it.
    #[test]
    fn tresca_is_soft_thresholding(
        stiffness in 0.1..1e6_f64, force in 0.1..1e6_f64, pull in -1e6..1e6_f64,
    ) {
        let radial = Radial { law: Tresca { coefficient: 0.6 }, force, state: () };
        let (v, _) = solve(
            &SMatrix::from([[stiffness]]), SVector::from([pull]),
            &[radial], [false], SVector::zeros(),
        )?;
        let excess = (pull.abs() - 0.6 * force).max(0.0);
        let expected = excess.copysign(pull) / stiffness;
        prop_assert!((v[0] - expected).abs() <= 8.0 * f64::EPSILON * pull.abs() / stiffness);
    }

    /// `S v + k mu(abs(v)) v/abs(v) = g` in three coupled components, for a chosen `v`.
    #[test]
    fn three_components_are_exact(
        entries in prop::collection::vec(-1.0..1.0_f64, 9),
        direction in prop::collection::vec(-1.0..1.0_f64, 3),
        log_rate in -60.0..1.0_f64, alpha in -12.0..12.0_f64,
        log_stiffness in 0.0..16.0_f64, log_force in 0.0..12.0_f64,
    ) {
        let direction = SVector::<f64, 3>::from_row_slice(&direction);
        prop_assume!(direction.norm() > 0.1);
        let v = direction.normalize() * log_rate.exp();
        let force = log_force.exp();
        let operator = spd::<3>(&entries, log_stiffness.exp());
        let radial = Radial { law: LAW, force, state: LogTheta(alpha) };
        let pull = force * coefficient(v.norm(), alpha);
        let load = operator * v + v.normalize() * pull;
        let (found, _) = solve(&operator, load, &[radial], [false; 3], SVector::zeros())?;
        let resistance = operator.norm() * v.norm()
            + if pull > 0.0 { force * LAW.a } else { 0.0 };
        let terms = load.norm() + force * (2.0 + 100.0 * LAW.a);
        let bound = 256.0 * f64::EPSILON * (100.0 + terms / resistance);
        prop_assert!((found - v).norm() <= bound * v.norm(), "{found} {v} {bound:e}");
    }

    /// Fixed components are data: what they pull with goes to the right-hand side.
    #[test]
    fn prescribed_components_stay_and_pull(
        entries in prop::collection::vec(-1.0..1.0_f64, 9), prescribed in -1.0..1.0_f64,
        load in prop::collection::vec(-1.0..1.0_f64, 3),
    ) {
        let operator = spd::<3>(&entries, 2.0);
        let load = SVector::<f64, 3>::from_row_slice(&load);
        let none: [Radial<DieterichRuina>; 0] = [];
        let start = SVector::from([9.0, prescribed, -9.0]);
        let (v, _) = solve(&operator, load, &none, [false, true, false], start)?;
        prop_assert_eq!(v[1], prescribed);
        let residual = operator * v - load;
        prop_assert!(residual[0].abs().max(residual[2].abs()) <= 1e-13);
        // No friction is friction without normal force.
        let radial = Radial { law: LAW, force: 0.0, state: LogTheta(1.0) };
        let start = SVector::from([9.0, 0.0, -9.0]);
        let (smooth, _) = solve(&operator, load, &[radial], [false, true, false], start)?;
        let (linear, _) = solve(&operator, load, &none, [false, true, false], start)?;
        prop_assert!((smooth - linear).norm() <= 1e-13);
    }

    #[test]
    fn one_block_is_an_operator(
        entries in prop::collection::vec(-1.0..1.0_f64, 9), factor in -3.0..3.0_f64,
    ) {
        let (a, b) = (spd::<3>(&entries, 2.0), spd::<3>(&entries[1..].repeat(2), 0.5));
        let mut sum = Operator::combination(&[(factor, &a), (1.0, &b)]);
        prop_assert!((sum - (a * factor + b)).norm() <= 1e-14 * (a.norm() * 3.0 + b.norm()));
        sum.set_combination(&[(0.0, &a), (2.0, &b)]);
        prop_assert_eq!(sum, b * 2.0);
        let x = [SVector::from([1.0, -2.0, 0.5])];
        prop_assert!((Matrix::norm(&a, &x) - (x[0].transpose() * a * x[0])[0].sqrt()).abs() <= 1e-14);
    }
}

#[test]
fn what_is_not_finite_or_definite_is_refused() {
    let radial = Radial {
        law: LAW,
        force: 1.0,
        state: LogTheta(1.0),
    };
    let unit = SMatrix::from([[1.0]]);
    for load in [f64::NAN, f64::INFINITY] {
        let result = solve(
            &unit,
            SVector::from([load]),
            &[radial],
            [false],
            SVector::zeros(),
        );
        assert!(
            matches!(result, Err(SolveError::NotFinite { .. })),
            "{result:?}"
        );
    }
    let none: [Radial<DieterichRuina>; 0] = [];
    let negative = SMatrix::from([[-1.0]]);
    let result = solve(
        &negative,
        SVector::from([1.0]),
        &none,
        [false],
        SVector::zeros(),
    );
    assert_eq!(
        result.map(|_| ()),
        Err(SolveError::IndefiniteBlock { vertex: 0 })
    );
}
