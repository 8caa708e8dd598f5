//! Velocity steps and the parameters behind them, against an integration of its own.

use stickslip::friction::DieterichRuina;
use stickslip::lab::LabError;
use stickslip::problems::spring_slider::FRICTION;
use stickslip::problems::velocity_step::VelocityStep;
use stickslip::state::{LogTheta, StateLaw};

use crate::Outcome;

const STEP: VelocityStep = VelocityStep {
    stiffness: 1e10,
    normal_stress: 5e6,
    before: 1e-6,
    after: 1e-5,
};

/// Friction every micrometre up to 200 of them, from 20 before the step on, by the classical Runge-Kutta method in
/// `mu` and `alpha = ln theta`, both as functions of the displacement of the load point:
///
/// ```text
/// dmu/dx = (K / sigma_n) (1 - V/V_l),   dalpha/dx = g(alpha, V)/V_l,
/// V = V0 exp((mu - mu0 - b ln(V0 theta/L)) / a)
/// ```
///
/// Slip adapts to the spring over `a sigma_n/K = 5 um`, the state over `L = 10 um`: with 200 steps a micrometre the
/// error of a step is `(1/1000)^5/120`, and that of all 4e4 below 1e-11 of a change by less than 0.03.
fn oracle(
    step: &VelocityStep,
    law: &DieterichRuina,
    evolution: impl StateLaw<State = LogTheta>,
) -> Vec<(f64, f64)> {
    let slope = |(mu, alpha): (f64, f64)| {
        let age = alpha + (law.reference_velocity / law.slip_distance).ln();
        let excess = (mu - law.reference_friction - law.b * age) / law.a;
        let rate = law.reference_velocity * excess.exp();
        let stretch = step.stiffness / step.normal_stress * (1.0 - rate / step.after);
        (
            stretch,
            evolution.evolution(LogTheta(alpha), rate) / step.after,
        )
    };
    let faster = |(mu, alpha): (f64, f64), (dmu, dalpha): (f64, f64), h: f64| {
        (mu + h * dmu, alpha + h * dalpha)
    };
    let (per_sample, h) = (200, 1e-6 / 200.0);
    let start = law.steady_coefficient(step.before);
    let mut at = (start, (law.slip_distance / step.before).ln());
    let mut curve: Vec<_> = (-20..=0).map(|n| (f64::from(n) * 1e-6, start)).collect();
    for n in 1..=200 {
        for _ in 0..per_sample {
            let k1 = slope(at);
            let k2 = slope(faster(at, k1, 0.5 * h));
            let k3 = slope(faster(at, k2, 0.5 * h));
            let k4 = slope(faster(at, k3, h));
            let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
            at = faster(
                at,
                (mean(k1.0, k2.0, k3.0, k4.0), mean(k1.1, k2.1, k3.1, k4.1)),
                h,
            );
        }
        curve.push((f64::from(n) * 1e-6, at.0));
    }
    curve
}

fn displacements(curve: &[(f64, f64)]) -> Vec<f64> {
    curve.iter().map(|&(x, _)| x).collect()
}

fn twice_off() -> DieterichRuina {
    DieterichRuina {
        a: 2.0 * FRICTION.a,
        b: 0.5 * FRICTION.b,
        slip_distance: 2.0 * FRICTION.slip_distance,
        reference_friction: 0.5,
        ..FRICTION
    }
}

/// Steps have a local error of 1e-10 in `ln V` and the state, some hundred of them, and the spring forgets: less than
/// `(a + b) 1e-8` in all.
#[test]
fn a_curve_is_the_solution() -> Outcome {
    let down = VelocityStep {
        before: 1e-5,
        after: 1e-6,
        ..STEP
    };
    for step in [STEP, down] {
        for (exact, curve) in [
            {
                let exact = oracle(&step, &FRICTION, FRICTION.aging());
                let curve = step.curve(&FRICTION, DieterichRuina::aging, displacements(&exact))?;
                (exact, curve)
            },
            {
                let exact = oracle(&step, &FRICTION, FRICTION.slip());
                let curve = step.curve(&FRICTION, DieterichRuina::slip, displacements(&exact))?;
                (exact, curve)
            },
        ] {
            for (exact, found) in exact.iter().zip(&curve) {
                assert!((exact.1 - found.1).abs() < 2.5e-10, "{exact:?}, {found:?}");
            }
        }
    }
    Ok(())
}

/// Backwards, and with points that repeat.
#[test]
fn points_are_taken_in_any_order() -> Outcome {
    let sorted = [-1e-6, 0.0, 2e-6, 5e-6, 5e-6, 3e-5];
    let there = STEP.curve(&FRICTION, DieterichRuina::aging, sorted)?;
    let mut back = STEP.curve(&FRICTION, DieterichRuina::aging, sorted.into_iter().rev())?;
    back.reverse();
    assert_eq!(there, back);
    assert_eq!(there[3], there[4]);
    Ok(())
}

/// The relative errors of `a`, `b`, `L`, and the error of `mu0`.
fn errors(found: &DieterichRuina) -> [f64; 4] {
    [
        found.a / FRICTION.a - 1.0,
        found.b / FRICTION.b - 1.0,
        found.slip_distance / FRICTION.slip_distance - 1.0,
        found.reference_friction - FRICTION.reference_friction,
    ]
}

#[test]
fn known_parameters_are_found_from_twice_and_half_of_them() -> Outcome {
    let data = oracle(&STEP, &FRICTION, FRICTION.aging());
    let aging = STEP.fit(&data, &twice_off(), DieterichRuina::aging)?;
    let data = oracle(&STEP, &FRICTION, FRICTION.slip());
    let slip = STEP.fit(&data, &twice_off(), DieterichRuina::slip)?;
    for fit in [aging, slip] {
        assert!(
            errors(&fit.friction).iter().all(|error| error.abs() < 1e-6),
            "{fit:?}"
        );
    }
    Ok(())
}

/// Noise with a uniform distribution in `[-1e-4, 1e-4]`, by the generator of Knuth and Lewis.
fn noisy(data: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut seed = 1u32;
    let noise = std::iter::from_fn(|| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        Some(1e-4 * (f64::from(seed) / f64::from(u32::MAX) * 2.0 - 1.0))
    });
    (data.iter().zip(noise))
        .map(|(&(x, mu), noise)| (x, mu + noise))
        .collect()
}

/// With the covariance `s^2 (J^T J)^-1` of the true parameters, found here from the oracle, no parameter is off by more
/// than 4 standard deviations, `s = 1e-4/3^(1/2)`. The variance of the square of uniform noise is 4/5 of `s^4`, so that
/// what is left of the data is `s` up to 4 times `s (1/5n)^(1/2)`.
#[test]
fn noise_spreads_parameters_as_its_covariance_says() -> Outcome {
    let data = oracle(&STEP, &FRICTION, FRICTION.aging());
    let fit = STEP.fit(&noisy(&data), &twice_off(), DieterichRuina::aging)?;
    let s = 1e-4 / 3f64.sqrt();
    let by = |change: &dyn Fn(&mut DieterichRuina, f64)| {
        let at = |h| {
            let mut law = FRICTION;
            change(&mut law, h);
            oracle(&STEP, &law, law.aging())
        };
        let (more, less) = (at(1e-3), at(-1e-3));
        let change = |(more, less): (&(f64, f64), &(f64, f64))| (more.1 - less.1) / 2e-3;
        more.iter().zip(&less).map(change).collect::<Vec<_>>()
    };
    let columns = [
        by(&|law, h| law.a *= h.exp()),
        by(&|law, h| law.b *= h.exp()),
        by(&|law, h| law.slip_distance *= h.exp()),
        by(&|law, h| law.reference_friction += h),
    ];
    let normal = nalgebra::SMatrix::<f64, 4, 4>::from_fn(|i, j| {
        columns[i].iter().zip(&columns[j]).map(|(x, y)| x * y).sum()
    });
    let inverse = normal.try_inverse().ok_or("singular")?;
    let spread = |relative: f64| (relative / (5.0 * data.len() as f64)).sqrt();
    for (k, error) in errors(&fit.friction).into_iter().enumerate() {
        let expected = s * inverse[(k, k)].sqrt();
        assert!(error.abs() < 4.0 * expected, "{k}: {error:e}, {expected:e}");
    }
    assert!(
        (fit.deviation / s - 1.0).abs() < 4.0 * spread(1.0),
        "{fit:?}"
    );
    Ok(())
}

#[test]
fn what_has_no_fit_is_refused() -> Outcome {
    let fit = |step: &VelocityStep, data: &[(f64, f64)], start: &DieterichRuina| {
        step.fit(data, start, DieterichRuina::aging)
    };
    let data = oracle(&STEP, &FRICTION, FRICTION.aging());
    assert_eq!(
        fit(&STEP, &data[..4], &FRICTION),
        Err(LabError::Value {
            what: "number of points",
            requirement: "at least 5",
            position: 0,
            value: 4.0
        })
    );
    // Nothing but steady sliding before the step.
    assert!(matches!(
        fit(&STEP, &data[..20], &FRICTION),
        Err(LabError::NoVelocityStep { .. })
    ));
    // Softer than critical.
    let soft = VelocityStep {
        stiffness: 1e9,
        ..STEP
    };
    assert!(matches!(
        fit(&soft, &data, &FRICTION),
        Err(LabError::Unstable { .. })
    ));
    let value = |result| match result {
        Err(LabError::Value { what, position, .. }) => Some((what, position)),
        _ => None,
    };
    let mut broken = data.clone();
    broken[7].1 = f64::NAN;
    assert_eq!(
        value(fit(&STEP, &broken, &FRICTION)),
        Some(("friction coefficient", 7))
    );
    broken[7] = (f64::INFINITY, 0.6);
    assert_eq!(
        value(fit(&STEP, &broken, &FRICTION)),
        Some(("displacement", 7))
    );
    let negative = DieterichRuina { a: 0.0, ..FRICTION };
    assert_eq!(value(fit(&STEP, &data, &negative)), Some(("a", 0)));
    let backwards = VelocityStep {
        after: -1e-6,
        ..STEP
    };
    assert_eq!(
        value(fit(&backwards, &data, &FRICTION)),
        Some(("velocity after the step", 0))
    );
    Ok(())
}

/// Data with noise have a minimum to within a part of their standard errors, and no fit is refused for the last digits
/// of it. Of four parameters in a hundred draws, at least 95 in 100 are within three standard errors.
#[test]
fn noise_refuses_no_fit() -> Outcome {
    let truth = DieterichRuina {
        a: 0.008,
        b: 0.012,
        slip_distance: 1.5e-5,
        ..FRICTION
    };
    let guess = DieterichRuina {
        a: 0.012,
        b: 0.015,
        slip_distance: 3e-5,
        reference_friction: 0.55,
        ..truth
    };
    let displacements = (-40..=400).map(|n| 0.5e-6 * f64::from(n));
    let clean = STEP.curve(&truth, DieterichRuina::aging, displacements)?;
    let mut inside = 0;
    for seed in 1..=100_u64 {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let mut noise = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * 2e-3
        };
        let data: Vec<_> = clean.iter().map(|&(x, mu)| (x, mu + noise())).collect();
        let fit = STEP.fit(&data, &guess, DieterichRuina::aging)?;
        let found = fit.friction;
        let errors = [
            (found.a / truth.a).ln(),
            (found.b / truth.b).ln(),
            (found.slip_distance / truth.slip_distance).ln(),
            found.reference_friction - truth.reference_friction,
        ];
        let within = errors.iter().zip(fit.standard_errors);
        inside += within
            .filter(|(error, standard)| error.abs() <= 3.0 * standard)
            .count();
    }
    assert!(inside >= 380, "{inside} of 400");
    Ok(())
}
