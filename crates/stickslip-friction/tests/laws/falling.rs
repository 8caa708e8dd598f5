//! Friction that falls with the slip rate, lifted to vectors: rest and slip may both balance a force.

use nalgebra::{Matrix3, SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{ConvexPotential, FrictionLaw, Radial};

use crate::common::{cases, decades};
use crate::radial::{block, check_minimize, orthogonal, vector};

/// `0.6 - 0.3 V/(V + V1)`, which falls by up to `0.3/V1`.
#[derive(Clone, Copy, Debug)]
struct Falling {
    rate: f64,
}

impl FrictionLaw for Falling {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        0.6 - 0.3 * slip_rate / (slip_rate + self.rate)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        -0.3 * self.rate / (slip_rate + self.rate).powi(2)
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        0.3 * slip_rate + 0.3 * self.rate * (slip_rate / self.rate).ln_1p()
    }
}

/// Friction that falls with the speed, by less than the block resists.
fn check_falling<const C: usize>(
    block: SMatrix<f64, C, C>,
    direction: SVector<f64, C>,
    (k, ratio, margin): (f64, f64, f64),
    q: SMatrix<f64, C, C>,
) -> Result<(), TestCaseError> {
    // At most the smallest eigenvalue.
    let softest = block
        .try_inverse()
        .map_or(f64::NAN, |inverse| inverse.norm().recip());
    let falling = Radial {
        law: Falling {
            rate: margin * 0.3 * k / softest,
        },
        force: k,
        state: (),
    };
    check_minimize(&falling, &block, &(direction * (k * ratio)), &q, 100.0)
}

/// [`Falling`], where slip that goes on is the law's choice beside rest: the fastest slip there is.
#[derive(Clone, Copy, Debug)]
struct SlidingOn(Falling);

impl FrictionLaw for SlidingOn {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        self.0.coefficient(slip_rate, ())
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        self.0.coefficient_rate_slope(slip_rate, ())
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        self.0.potential(slip_rate, ())
    }

    /// The larger root of `(viscosity V + 0.3 - drive)(V + V1) + 0.3 V1`.
    fn slip_rate(&self, viscosity: f64, drive: f64, (): ()) -> f64 {
        let minus_half = 0.5 * (drive - 0.3 - viscosity * self.0.rate);
        let constant = (0.6 - drive) * self.0.rate * viscosity;
        let square = minus_half * minus_half - constant;
        if square < 0.0 || constant > 0.0 && minus_half < 0.0 {
            return 0.0;
        }
        // Both ways, so that nothing cancels.
        if minus_half >= 0.0 {
            (minus_half + square.sqrt()) / viscosity
        } else {
            constant / (minus_half - square.sqrt()) / viscosity
        }
    }
}

/// Friction that falls by more than the block resists: where it slides the forces balance, and it slides where it could
/// against the whole stiffness.
fn check_sliding_on<const C: usize>(
    block: SMatrix<f64, C, C>,
    direction: SVector<f64, C>,
    (k, ratio, margin): (f64, f64, f64),
) -> Result<(), TestCaseError> {
    let law = SlidingOn(Falling {
        rate: margin * k / block.norm(),
    });
    let potential = Radial {
        law,
        force: k,
        state: (),
    };
    let force = direction * (k * ratio);
    let pull = force.norm();
    let slip = potential.minimize(&block, &force);
    if slip.norm() > 0.0 {
        let friction = slip * (k * law.coefficient(slip.norm(), ()) / slip.norm());
        let left = (block * slip + friction - force).norm();
        prop_assert!(left <= 1e-8 * pull, "{left:e} of {pull:e}");
    } else {
        prop_assert!(pull <= 0.6 * k);
        prop_assert_eq!(law.slip_rate(block.trace() / k, pull / k, ()), 0.0);
    }
    Ok(())
}

/// Slip that is stable by a margin, at the speed 1 along a direction: it is found, or a faster one.
///
/// With `S + k H` semidefinite and `k (1 - margin)` in its place, `S + H >= margin S`: rounding errors of the forces move the
/// speed by their sum over that.
fn check_stable_slip<const C: usize>(
    block: SMatrix<f64, C, C>,
    along: SVector<f64, C>,
    (rate, margin): (f64, f64),
) -> Result<(), TestCaseError> {
    let law = SlidingOn(Falling { rate });
    let along = along.normalize();
    let (coefficient, slope) = (
        law.coefficient(1.0, ()),
        law.coefficient_rate_slope(1.0, ()),
    );
    let across = SMatrix::identity() - along * along.transpose();
    let hessian = along * along.transpose() * slope + across * coefficient;
    let (mut low, mut high) = (0.0, 2.0 * block.norm() / -slope);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (block + hessian * middle).cholesky().is_some() {
            low = middle;
        } else {
            high = middle;
        }
    }
    let k = low * (1.0 - margin);
    let potential = Radial {
        law,
        force: k,
        state: (),
    };
    let force = block * along + along * (k * coefficient);
    let slip = potential.minimize(&block, &force);
    let terms = block.norm() + k * coefficient;
    let softness = block
        .try_inverse()
        .map_or(f64::NAN, |inverse| inverse.norm());
    let slack = 1e-9 + 1e-13 * terms * softness / margin;
    prop_assert!(slip.norm() >= 1.0 - slack, "{slip} {slack:e}");
    let friction = slip * (k * law.coefficient(slip.norm(), ()) / slip.norm());
    let left = (block * slip + friction - force).norm();
    prop_assert!(left <= 1e-8 * force.norm(), "{left:e} of {force:e}");
    Ok(())
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn minimizes_where_friction_falls(
        plane in block::<2>(), s in block::<3>(), g in vector::<3>(), k in decades(-3.0..2.0), ratio in decades(0.0..3.0),
        margin in decades(0.2..3.0), turn in orthogonal::<2>(), q in orthogonal::<3>(),
    ) {
        check_falling(s, g, (k, ratio, margin), q)?;
        check_falling(plane, g.fixed_rows::<2>(0).into_owned(), (k, ratio, margin), turn)?;
    }

    #[test]
    fn slides_on_where_it_could_rest(
        plane in block::<2>(), s in block::<3>(), g in vector::<3>(), k in decades(-3.0..2.0), ratio in 0.3..1.5,
        margin in decades(-6.0..0.0),
    ) {
        check_sliding_on(s, g, (k, ratio, margin))?;
        check_sliding_on(plane, g.fixed_rows::<2>(0).into_owned(), (k, ratio, margin))?;
    }

    #[test]
    fn stable_slip_is_found(
        plane in block::<2>(), s in block::<3>(), along in vector::<3>(), rate in decades(-3.0..3.0),
        margin in decades(-3.0..-0.3),
    ) {
        check_stable_slip(s, along, (rate, margin))?;
        check_stable_slip(plane, along.fixed_rows::<2>(0).into_owned(), (rate, margin))?;
    }
}

/// Forces far above what friction holds at rest, and friction that falls steeply there: what the law makes of the chords is
/// not where they lead.
#[test]
fn slip_is_found_beyond_a_steep_fall_at_rest() -> Result<(), TestCaseError> {
    let soft = Matrix3::new(
        210.11582192476857,
        7.879057117053534,
        81.5488796904493,
        7.879057117053534,
        334.9669807855138,
        171.38914113050825,
        81.5488796904493,
        171.38914113050825,
        139.409256223717,
    );
    let force = SVector::from([0.660350874540838, -0.47230485171492526, 0.6294079517602585]);
    let numbers = (1.0, 49.67410735721623, 2.3715127370194926);
    check_falling(soft, force, numbers, SMatrix::identity())?;
    let softer = Matrix3::new(
        0.2816461724935794,
        -2.1423292145670283,
        0.8931253715410137,
        -2.1423292145670283,
        23.597918902011127,
        -8.542099887049147,
        0.8931253715410137,
        -8.542099887049147,
        3.328259057588154,
    );
    let force = SVector::from([
        0.22038855201610846,
        -0.004396093526752116,
        0.8436822136062788,
    ]);
    let numbers = (1.0, 35.726327697215204, 2.9519457955535637);
    check_falling(softer, force, numbers, SMatrix::identity())
}
