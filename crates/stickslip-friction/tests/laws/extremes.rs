//! Local problems at the ends of the range of floating point numbers.

use crate::common::{cases, decades};
use nalgebra::{SMatrix, SVector};
use proptest::prelude::*;
use stickslip_friction::{
    ConvexPotential, DieterichRuina, FrictionLaw, Radial, RegularizedDieterichRuina,
    StateDependentTresca, Tresca,
};
use stickslip_state::LogTheta;

fn speed() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(5e-324),
        Just(1e-300),
        decades(-320.0..-300.0),
        decades(-20.0..10.0)
    ]
}

fn parameters() -> impl Strategy<Value = (DieterichRuina, RegularizedDieterichRuina)> {
    let ratio = prop_oneof![
        Just(0.0),
        Just(0.5),
        Just(1.5),
        Just(2.0),
        Just(5.0),
        Just(150.0)
    ];
    (decades(-6.0..0.0), ratio, decades(-12.0..0.0)).prop_map(|(a, ratio, slip_distance)| {
        let cut_off = DieterichRuina {
            a,
            b: ratio * a,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance,
        };
        let regularized = RegularizedDieterichRuina {
            a,
            b: cut_off.b,
            reference_friction: 0.6,
            reference_velocity: 1e-6,
            slip_distance,
        };
        (cut_off, regularized)
    })
}

fn force() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1.0), Just(1e12), decades(-6.0..12.0)]
}

/// A unit vector.
fn direction<const C: usize>() -> impl Strategy<Value = SVector<f64, C>> {
    prop::array::uniform::<_, C>(-1.0..1.0f64).prop_map(|x| {
        let v = SVector::from(x);
        if v.norm() > 0.0 {
            v / v.norm()
        } else {
            SVector::repeat(1.0)
        }
    })
}

/// Symmetric and positive definite with a norm near 1, condition number up to 1e6.
fn block<const C: usize>() -> impl Strategy<Value = SMatrix<f64, C, C>> {
    (
        direction::<C>(),
        direction::<C>(),
        prop::array::uniform::<_, C>(decades(-6.0..0.0)),
    )
        .prop_map(|(x, y, lambda)| {
            let reflection = |n: SVector<f64, C>| {
                SMatrix::identity() - n * n.transpose() * (2.0 / n.norm_squared())
            };
            let q = reflection(x) * reflection(y);
            let s = q * SMatrix::from_diagonal(&SVector::from(lambda)) * q.transpose();
            (s + s.transpose()) * 0.5
        })
}

/// The norm, also of vectors whose squares underflow.
fn length<const C: usize>(v: &SVector<f64, C>) -> f64 {
    match v.amax() {
        0.0 => 0.0,
        largest => largest * (v / largest).norm(),
    }
}

/// The force left over, in roundings of the terms that meet: the forces, and the terms of friction,
/// in which the state and the logarithm of the speed (over one of a reference) are rounded.
fn roundings<L: FrictionLaw<State = LogTheta>, const C: usize>(
    potential: &Radial<L>,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
    v: &SVector<f64, C>,
) -> f64 {
    let speed = length(v);
    let Radial {
        law,
        force: k,
        state,
    } = potential;
    let (friction, elastic) = (k * law.coefficient(speed, *state), block * v);
    let left = elastic - force;
    let logarithm = speed.max(f64::MIN_POSITIVE).ln().abs() + 30.0;
    // On a kink the terms are those just above.
    let above = speed * (1.0 + 1e-9);
    let by_rate = if speed > 0.0 {
        law.coefficient_rate_slope(above, *state) * speed * logarithm
    } else {
        0.0
    };
    let by_state = law.coefficient_state_slope(above, *state) * state.0.abs();
    let size = length(force) + block.norm() * speed + friction + k * (by_rate + by_state);
    // Subnormal speeds are spaced by the smallest number, which friction at old contacts feels.
    let slope = law.coefficient_rate_slope(above, *state);
    let felt = if slope.is_finite() { k * slope } else { 0.0 };
    let smallest = f64::from_bits(1) * (block.norm() + felt + 1.0);
    if speed == 0.0 {
        // A speed that underflows needs less force than this.
        let least =
            k * law.coefficient(f64::MIN_POSITIVE, *state) + block.norm() * f64::MIN_POSITIVE;
        return (length(&left) - least).max(0.0) / (f64::EPSILON * size + smallest);
    }
    length(&(left + v / speed * friction)) / (f64::EPSILON * size + smallest)
}

/// The roundings of a local problem: one of the drive, the logarithm, the product and the sum for one component. In `C`
/// components each of these is a sum of `C` terms, along eigenvectors that rotations of `C` entries give, there and back.
fn allowed<const C: usize>() -> f64 {
    4.0 * (C * C) as f64
}

fn check<L: FrictionLaw<State = LogTheta> + Copy, const C: usize>(
    potential: &Radial<L>,
    block: &SMatrix<f64, C, C>,
    force: &SVector<f64, C>,
) -> Result<(), TestCaseError> {
    let v = potential.minimize(block, force);
    prop_assert!(v.iter().all(|x| x.is_finite()), "{v}");
    let error = roundings(potential, block, force, &v);
    prop_assert!(
        error <= allowed::<C>(),
        "{error} roundings at {v:e}, {force:e}"
    );
    Ok(())
}

fn check_finite<L: FrictionLaw + Copy, const C: usize>(
    potential: &Radial<L>,
    v: &SVector<f64, C>,
    d: &SVector<f64, C>,
) -> Result<(), TestCaseError> {
    prop_assert!(potential.value(v).is_finite());
    let slopes = potential.slope_along(v, d);
    prop_assert!(
        slopes.lower.is_finite() && slopes.lower <= slopes.upper && slopes.upper.is_finite()
    );
    let model = potential.local_model(v);
    prop_assert!(model.gradient.iter().all(|x| x.is_finite()), "{:?}", model);
    prop_assert!(model.hessian.iter().all(|x| x.is_finite()), "{:?}", model);
    let kept = potential.keep_smooth(v, d);
    prop_assert!(kept.iter().all(|x| x.is_finite()), "{kept} of {d} at {v}");
    Ok(())
}

fn check_laws<const C: usize>(
    (cut_off, regularized): (DieterichRuina, RegularizedDieterichRuina),
    alpha: f64,
    k: f64,
    block: SMatrix<f64, C, C>,
    (force, v, d): (SVector<f64, C>, SVector<f64, C>, SVector<f64, C>),
) -> Result<(), TestCaseError> {
    let state = LogTheta(alpha);
    let tresca = StateDependentTresca {
        reference_friction: cut_off.reference_friction,
        b: cut_off.b,
        reference_velocity: cut_off.reference_velocity,
        slip_distance: cut_off.slip_distance,
    };
    macro_rules! each {
        ($law:expr) => {
            let potential = Radial {
                law: $law,
                force: k,
                state,
            };
            check(&potential, &block, &force)?;
            check_finite(&potential, &v, &d)?;
            let speed = length(&v);
            let law = $law;
            prop_assert!(law.coefficient(speed, state).is_finite());
            prop_assert!(law.coefficient_state_slope(speed, state).is_finite());
            prop_assert!(law.coefficient_rate_slope(speed, state) >= 0.0);
            prop_assert!(law.potential(speed, state).is_finite());
        };
    }
    each!(cut_off);
    each!(regularized);
    each!(tresca);
    check_finite(
        &Radial {
            law: Tresca { coefficient: 0.6 },
            force: k,
            state: (),
        },
        &v,
        &d,
    )
}

macro_rules! extremes {
    ($($name:ident: $c:literal),*) => {
        proptest! {
            #![proptest_config(cases(20_000))]
            $(#[test]
            fn $name(
                laws in parameters(), alpha in prop_oneof![-800.0..800.0f64, -20.0..20.0f64], k in force(),
                s in block::<$c>(), stiffness in decades(-12.0..20.0),
                g in direction::<$c>(), pull in prop_oneof![decades(-12.0..15.0), decades(-3.0..2.0)],
                relative in any::<bool>(),
                e in direction::<$c>(), d in direction::<$c>(), size in decades(-20.0..10.0), v in speed(),
            ) {
                let pull = if relative && k > 0.0 { pull * k } else { pull };
                check_laws(laws, alpha, k, s * stiffness, (g * pull, e * v, d * size))?;
            })*
        }
    };
}

extremes!(in_one_dimension: 1, in_two_dimensions: 2, in_three_dimensions: 3);

/// A block with a condition number of 1e6, under a force along its stiff axis that it hardly resists.
#[test]
fn a_free_contact_on_an_ill_conditioned_block() -> Result<(), TestCaseError> {
    let law = DieterichRuina {
        a: 0.7071799424703785,
        b: 3.5358997123518927,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1.4466189709111614e-8,
    };
    let s = SMatrix::<f64, 2, 2>::new(
        0.9987286468422399,
        -0.03563334786074617,
        -0.03563334786074617,
        0.001272406479494315,
    );
    let g = SVector::from([-0.9998136181926991, 0.019306187516535456]) * 0.0019354171300572124;
    let potential = Radial {
        law,
        force: 1e12,
        state: LogTheta(-11.796743387059948),
    };
    check(&potential, &(s * 1.3253583258540944e-11), &g)
}
