//! The lift to vectors: convexity, local models and exact minimisation.

use crate::common::{SLIDER, cases, decades};
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{ConvexPotential, FrictionLaw, Radial, Tresca};
use stickslip_state::LogTheta;

fn at_cutoff(ln_cutoff_rate: f64) -> LogTheta {
    let strength = (SLIDER.reference_velocity.ln() - ln_cutoff_rate) * SLIDER.a;
    LogTheta((strength - 0.6) / SLIDER.b - 0.1f64.ln())
}

pub(crate) fn vector<const C: usize>() -> impl Strategy<Value = SVector<f64, C>> {
    prop::array::uniform::<_, C>(-1.0..1.0f64).prop_map(SVector::from)
}

/// The norm, also of vectors whose squares underflow.
fn length<const C: usize>(v: &SVector<f64, C>) -> f64 {
    match v.amax() {
        0.0 => 0.0,
        largest => largest * (v / largest).norm(),
    }
}

/// Some orthogonal matrix: a product of reflections.
pub(crate) fn orthogonal<const C: usize>() -> impl Strategy<Value = SMatrix<f64, C, C>> {
    (vector::<C>(), vector::<C>()).prop_map(|(x, y)| {
        let reflection = |n: SVector<f64, C>| match n.norm_squared() {
            0.0 => SMatrix::identity(),
            square => SMatrix::identity() - n * n.transpose() * (2.0 / square),
        };
        reflection(x) * reflection(y)
    })
}

/// Symmetric and positive definite, condition number up to 1e6.
pub(crate) fn block<const C: usize>() -> impl Strategy<Value = SMatrix<f64, C, C>> {
    (
        orthogonal::<C>(),
        prop::array::uniform::<_, C>(decades(-3.0..3.0)),
        decades(-6.0..9.0),
    )
        .prop_map(|(q, lambda, scale)| {
            let s = q * SMatrix::from_diagonal(&SVector::from(lambda)) * q.transpose() * scale;
            (s + s.transpose()) * 0.5
        })
}

/// The minimiser from the equation for the speed, bisected, each evaluation one linear solve with
/// `S + k mu(V)/V I`; no eigenvalues.
fn naive<L: FrictionLaw, const C: usize>(
    potential: &Radial<L>,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> SVector<f64, C> {
    let friction = |speed: f64| potential.force * potential.law.coefficient(speed, potential.state);
    if force.norm() <= friction(0.0) {
        return SVector::zeros();
    }
    let solve = |speed: f64| {
        let matrix = block + SMatrix::identity() * (friction(speed) / speed);
        matrix
            .cholesky()
            .map_or(SVector::repeat(f64::NAN), |factor| factor.solve(force))
    };
    let (mut low, mut high) = (-692.0f64, 100.0f64);
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if length(&solve(middle.exp())) > middle.exp() {
            low = middle
        } else {
            high = middle
        }
    }
    solve(low.exp())
}

/// `S v - g` against the subdifferential, in units of the forces that meet; `NaN`-safe.
fn violation<L: FrictionLaw, const C: usize>(
    potential: &Radial<L>,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
    v: &SVector<f64, C>,
) -> f64 {
    let friction = potential.force * potential.law.coefficient(length(v), potential.state);
    let residual = block * v - force;
    let size = force.norm() + block.norm() * v.norm();
    if length(v) == 0.0 {
        (residual.norm() - friction).max(0.0) / size
    } else {
        (residual + v / length(v) * friction).norm() / size
    }
}

/// Optimality, an independent minimiser, and symmetries.
pub(crate) fn check_minimize<L: FrictionLaw, const C: usize>(
    potential: &Radial<L>,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
    q: &SMatrix<f64, C, C>,
    log_size: f64,
) -> Result<(), TestCaseError> {
    if force.norm() == 0.0 {
        prop_assert_eq!(potential.minimize(block, force), *force);
        return Ok(());
    }
    let v = potential.minimize(block, force);
    // What a rounding of ln V does to friction, in units of the force.
    let rounding = 1e-15 * (10.0 + potential.force / force.norm() * SLIDER.a * log_size);
    let error = violation(potential, block, force, &v);
    prop_assert!(error <= rounding, "{error:e} {rounding:e} at {v:e}");
    let tolerance = (1e-15 * log_size + 1e-9 + 1e6 * rounding) * length(&v);
    // Below, mu/V overflows.
    let other = if length(&v) < 1e-300 {
        v
    } else {
        naive(potential, block, force)
    };
    prop_assert!(length(&(v - other)) <= tolerance, "{v:e} {other:e}");
    let turned = potential.minimize(&(q * block * q.transpose()), &(q * force));
    prop_assert!(length(&(q * v - turned)) <= tolerance, "{v:e} {turned:e}");
    prop_assert_eq!(potential.minimize(block, &-force), -v);
    Ok(())
}

fn check_laws<const C: usize>(
    block: SMatrix<f64, C, C>,
    force: SVector<f64, C>,
    k: f64,
    ln_cutoff: f64,
    q: SMatrix<f64, C, C>,
) -> Result<(), TestCaseError> {
    let tresca = Radial {
        law: Tresca { coefficient: 0.6 },
        force: k,
        state: (),
    };
    check_minimize(&tresca, &block, &force, &q, 100.0)?;
    check_minimize(
        &Radial {
            force: 0.0,
            ..tresca
        },
        &block,
        &force,
        &q,
        100.0,
    )?;
    let rate_and_state = Radial {
        law: SLIDER,
        force: k,
        state: at_cutoff(ln_cutoff),
    };
    check_minimize(&rate_and_state, &block, &force, &q, 100.0 + ln_cutoff.abs())
}

fn check_convex<L: FrictionLaw, const C: usize>(
    potential: &Radial<L>,
    v: SVector<f64, C>,
    w: SVector<f64, C>,
    kink: f64,
) -> Result<(), TestCaseError> {
    let d = w - v;
    let (at_v, at_w) = (potential.value(&v), potential.value(&w));
    let slopes = potential.slope_along(&v, &d);
    let rounding = 1e-12 * (at_v + at_w) + 1e-300;
    prop_assert!(slopes.lower <= slopes.upper);
    prop_assert!(at_v + slopes.upper <= at_w + rounding);
    let middle = potential.value(&((v + w) * 0.5));
    prop_assert!(middle <= 0.5 * (at_v + at_w) + rounding);
    let model = potential.local_model(&v);
    prop_assert!(model.smooth[0]);
    let projected = model.gradient.dot(&d);
    prop_assert!((projected - slopes.upper).abs() <= 1e-14 * model.gradient.norm() * d.norm());
    let step = d * (1e-4 * v.norm() / d.norm());
    let change = model.hessian * step;
    let difference = (potential.local_model(&(v + step)).gradient
        - potential.local_model(&(v - step)).gradient)
        * 0.5;
    let tolerance = 1e-6 * model.hessian.norm() * step.norm() + 1e-13 * model.gradient.norm();
    let near_kink = (v.norm() / kink - 1.0).abs() < 1e-3;
    prop_assert!(
        near_kink || (change - difference).norm() <= tolerance,
        "{change:e} {difference:e}"
    );
    prop_assert_eq!(model.hessian, model.hessian.transpose());
    Ok(())
}

fn check_convex_laws<const C: usize>(
    v: SVector<f64, C>,
    w: SVector<f64, C>,
    ln_cutoff: f64,
) -> Result<(), TestCaseError> {
    let rate_and_state = Radial {
        law: SLIDER,
        force: 3.0,
        state: at_cutoff(ln_cutoff),
    };
    check_convex(&rate_and_state, v, w, ln_cutoff.exp())?;
    check_convex(
        &Radial {
            law: Tresca { coefficient: 0.6 },
            force: 3.0,
            state: (),
        },
        v,
        w,
        0.0,
    )
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn minimizes_in_one_dimension(
        s in block::<1>(), g in vector::<1>(), k in decades(-3.0..2.0), ln_cutoff in -1000.0..30.0, q in orthogonal::<1>(),
    ) { check_laws(s, g, k, ln_cutoff, q)?; }

    #[test]
    fn minimizes_in_two_dimensions(
        s in block::<2>(), g in vector::<2>(), k in decades(-3.0..2.0), ln_cutoff in -1000.0..30.0, q in orthogonal::<2>(),
    ) { check_laws(s, g, k, ln_cutoff, q)?; }

    #[test]
    fn minimizes_in_three_dimensions(
        s in block::<3>(), g in vector::<3>(), k in decades(-3.0..2.0), ln_cutoff in -1000.0..30.0, q in orthogonal::<3>(),
    ) { check_laws(s, g, k, ln_cutoff, q)?; }

    #[test]
    fn potentials_are_convex(
        v in vector::<3>(), w in vector::<3>(), scale in decades(-20.0..0.0), ln_cutoff in -1000.0..30.0,
    ) {
        let v = v * scale;
        check_convex_laws(v, w, ln_cutoff)?;
        check_convex_laws(v.fixed_rows::<2>(0).into_owned(), w.fixed_rows::<2>(0).into_owned(), ln_cutoff)?;
        check_convex_laws(v.fixed_rows::<1>(0).into_owned(), w.fixed_rows::<1>(0).into_owned(), ln_cutoff)?;
    }

    /// A third component held at zero changes nothing.
    #[test]
    fn held_components_are_invisible(
        s in block::<2>(), g in vector::<2>(), k in decades(-3.0..2.0), ln_cutoff in -1000.0..30.0,
    ) {
        let potential = Radial { law: SLIDER, force: k, state: at_cutoff(ln_cutoff) };
        let v = potential.minimize(&s, &g);
        let mut block = SMatrix::<f64, 3, 3>::identity();
        block.fixed_view_mut::<2, 2>(0, 0).copy_from(&s);
        let w = potential.minimize(&block, &SVector::from([g[0], g[1], 0.0]));
        prop_assert_eq!([w[0], w[1], w[2]], [v[0], v[1], 0.0]);
        // One tangential component in the plane is the scalar problem.
        let block = SMatrix::<f64, 2, 2>::new(s[(0, 0)], 0.0, 0.0, 1.0);
        let w = potential.minimize(&block, &SVector::from([g[0], 0.0]));
        let x = potential.minimize(&SMatrix::from([[s[(0, 0)]]]), &SVector::from([g[0]]));
        prop_assert_eq!([w[0], w[1]], [x[0], 0.0]);
    }
}

#[test]
fn rates_near_the_end_of_the_range_keep_their_digits() {
    let (block, force) = (
        SMatrix::<f64, 2, 2>::new(3.0, 1.0, 1.0, 2.0),
        SVector::from([0.3, 0.4]),
    );
    // Friction alone balances the force: ln V = ln Vm + abs(g)/(k a), whatever the block.
    for ln_cutoff in [-700.0, -740.0, -755.0, -757.0] {
        let potential = Radial {
            law: SLIDER,
            force: 1.0,
            state: at_cutoff(ln_cutoff),
        };
        let v = potential.minimize(&block, &force);
        let speed = (ln_cutoff + 50.0).exp();
        let want = force * (speed / 0.5);
        assert!((v / speed - want / speed).norm() < 1e-11, "{v:e} {want:e}");
    }
    let potential = Radial {
        law: SLIDER,
        force: 1.0,
        state: at_cutoff(-900.0),
    };
    assert_eq!(
        potential.minimize(&block, &force),
        SVector::from([0.0, 0.0])
    );
}

#[test]
fn rest_is_smooth_where_there_is_no_friction() {
    let rest = SVector::from([0.0, 0.0]);
    let ordinary = Radial {
        law: SLIDER,
        force: 1.0,
        state: at_cutoff(-60.0),
    }
    .local_model(&rest);
    assert_eq!(
        (ordinary.smooth, ordinary.hessian),
        ([true; 2], SMatrix::zeros())
    );
    let old = Radial {
        law: SLIDER,
        force: 1.0,
        state: at_cutoff(-1000.0),
    };
    assert_eq!(old.local_model(&rest).smooth, [false; 2]);
    let slopes = old.slope_along(&rest, &SVector::from([3.0, 4.0]));
    assert!(slopes.upper > 0.0 && slopes.lower == -slopes.upper);
    let tresca = Radial {
        law: Tresca { coefficient: 0.6 },
        force: 1.0,
        state: (),
    };
    assert_eq!(tresca.local_model(&rest).smooth, [false; 2]);
    assert_eq!(
        Radial {
            force: 0.0,
            ..tresca
        }
        .local_model(&rest)
        .smooth,
        [true; 2]
    );
    // A curvature that overflows.
    let slow = Radial {
        law: SLIDER,
        force: 1e5,
        state: at_cutoff(-720.0),
    };
    assert_eq!(slow.local_model(&SVector::from([1e-307])).smooth, [false]);
}

#[test]
fn viscous_laws_are_smooth_at_rest() {
    struct Viscous;
    impl FrictionLaw for Viscous {
        type State = ();
        fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
            slip_rate
        }
        fn coefficient_rate_slope(&self, _: f64, (): ()) -> f64 {
            1.0
        }
        fn potential(&self, slip_rate: f64, (): ()) -> f64 {
            0.5 * slip_rate * slip_rate
        }
    }
    let potential = Radial {
        law: Viscous,
        force: 2.0,
        state: (),
    };
    let model = potential.local_model(&SVector::from([0.0, 0.0]));
    assert_eq!(
        (model.smooth, model.hessian),
        ([true; 2], SMatrix::identity() * 2.0)
    );
    let v = potential.minimize(
        &SMatrix::<f64, 2, 2>::new(3.0, 1.0, 1.0, 2.0),
        &SVector::from([4.0, 1.0]),
    );
    // (S + 2 I) v = g
    let want = SVector::from([15.0, 1.0]) / 19.0;
    assert!((v - want).norm() < 1e-14, "{v} {want}");
}
