//! Observed orders on a damped, driven oscillator with a known solution.

use stickslip_time::{
    BackwardEuler, GeneralizedAlpha, Motion, Newmark, QuasiStatic, RateScheme, Sdirk2,
};

/// One stage of `m u'' + d u' + k u = force` with the force of the new time.
fn stage(scheme: &dyn RateScheme, dt: f64, from: Motion, mdk: [f64; 3], force: f64) -> Motion {
    let (formula, [mass, damping, stiffness]) = (scheme.update_formula(dt), mdk);
    let (u, a) = (
        formula.displacement.of_old(from),
        formula.acceleration.of_old(from),
    );
    let resistance = mass * formula.acceleration.new_velocity
        + damping
        + stiffness * formula.displacement.new_velocity;
    formula.motion(from, (force - mass * a - stiffness * u) / resistance)
}

/// Largest displacement error on [0, 2] of `m u'' + 0.4 u' + 3 u = f`, `u = cos 2t`.
fn error(scheme: &dyn RateScheme, mass: f64, steps: usize) -> f64 {
    let dt = 2.0 / steps as f64;
    let mut motion = Motion {
        displacement: 1.0,
        acceleration: -4.0,
        ..Motion::default()
    };
    let mut worst = 0.0_f64;
    for n in 1..=steps {
        let t = n as f64 * dt;
        let (cos, sin) = ((2.0 * t).cos(), (2.0 * t).sin());
        let force = -4.0 * mass * cos - 0.8 * sin + 3.0 * cos;
        motion = stage(scheme, dt, motion, [mass, 0.4, 3.0], force);
        worst = worst.max((motion.displacement - cos).abs());
    }
    worst
}

fn order(scheme: &dyn RateScheme, mass: f64) -> f64 {
    (error(scheme, mass, 400) / error(scheme, mass, 800)).log2()
}

#[test]
fn newmark_is_of_second_order() {
    let newmark = Newmark::AVERAGE_ACCELERATION;
    assert!((order(&newmark, 1.0) - 2.0).abs() < 0.05);
    assert!((order(&QuasiStatic(newmark), 0.0) - 2.0).abs() < 0.05);
}

#[test]
fn generalised_alpha_is_of_second_order() {
    for spectral_radius in [0.0, 0.3, 0.8, 1.0] {
        let order = order(&GeneralizedAlpha { spectral_radius }, 1.0);
        assert!((order - 2.0).abs() < 0.05, "{spectral_radius}: {order}");
    }
    let newmark = error(&Newmark::AVERAGE_ACCELERATION, 1.0, 400);
    let undamped = GeneralizedAlpha {
        spectral_radius: 1.0,
    };
    assert!(error(&undamped, 1.0, 400) < 2.0 * newmark);
}

/// Steps of three sizes in turn do not cost an order.
#[test]
fn generalised_alpha_keeps_its_order_while_steps_change() {
    let scheme = GeneralizedAlpha {
        spectral_radius: 0.5,
    };
    // u'' + u = 0 from u = 1, to t = 2.
    let error = |rounds: usize| {
        let mut motion = Motion {
            displacement: 1.0,
            acceleration: -1.0,
            ..Motion::default()
        };
        let unit = 2.0 / (7 * rounds) as f64;
        for dt in (0..rounds).flat_map(|_| [unit, 4.0 * unit, 2.0 * unit]) {
            motion = stage(&scheme, dt, motion, [1.0, 0.0, 1.0], 0.0);
        }
        (motion.displacement - 2_f64.cos()).abs()
    };
    let order = (error(100) / error(200)).log2();
    assert!((order - 2.0).abs() < 0.1, "{order}");
}

/// Largest displacement in steps 2^k to 2^(k+1) of an oscillator far from resolved, for each k.
fn unresolved_amplitudes(scheme: &dyn RateScheme, doublings: u32) -> Vec<f64> {
    let square = 1e12;
    let mut motion = Motion {
        displacement: 1.0,
        acceleration: -square,
        ..Motion::default()
    };
    let mut amplitude = |steps: u32| {
        (0..steps)
            .map(|_| {
                motion = stage(scheme, 1.0, motion, [1.0, 0.0, square], 0.0);
                motion.displacement.abs()
            })
            .fold(0.0, f64::max)
    };
    (0..doublings).map(|k| amplitude(1 << k)).collect()
}

#[test]
fn generalised_alpha_damps_the_unresolved_by_its_spectral_radius() {
    for spectral_radius in [0.5, 0.8, 0.95] {
        let amplitudes = unresolved_amplitudes(&GeneralizedAlpha { spectral_radius }, 10);
        // 256 steps lie between the beginnings of the last two stretches; the eigenvalue is threefold,
        // so that a power of up to 2 of the number of steps comes on top.
        let ratio = amplitudes[9] / amplitudes[8];
        let expected = spectral_radius.powi(256);
        assert!(
            (0.9..4.5).contains(&(ratio / expected)),
            "{spectral_radius}: {ratio:e} {expected:e}"
        );
    }
    let undamped = GeneralizedAlpha {
        spectral_radius: 1.0,
    };
    assert!(
        unresolved_amplitudes(&undamped, 12)
            .iter()
            .all(|a| *a < 2.0)
    );
    let gone = GeneralizedAlpha {
        spectral_radius: 0.0,
    };
    assert!(unresolved_amplitudes(&gone, 3)[2] < 1e-9);
}

#[test]
fn backward_euler_is_of_first_order() {
    assert!((order(&BackwardEuler, 1.0) - 1.0).abs() < 0.05);
    assert!((order(&QuasiStatic(BackwardEuler), 0.0) - 1.0).abs() < 0.05);
}

#[test]
fn quasi_static_ignores_mass_and_acceleration() {
    let scheme = QuasiStatic(Newmark::AVERAGE_ACCELERATION);
    let from = Motion {
        displacement: 1.0,
        velocity: 2.0,
        acceleration: 1e9,
        algorithmic: 1e9,
    };
    let to = scheme.update_formula(0.1).motion(from, 3.0);
    assert_eq!((to.acceleration, to.algorithmic), (0.0, 0.0));
    assert_eq!(to.displacement, 1.0 + 0.05 * 2.0 + 0.05 * 3.0);
}

/// Displacement and velocity of `u'' + d u' + u = 0` from `u = 1`, at rest, one backward Euler step on.
fn euler_step(dt: f64, drag: f64, [u, v]: [f64; 2]) -> [f64; 2] {
    let v = (v - dt * u) / (1.0 + dt * drag + dt * dt);
    [u + dt * v, v]
}

/// The same after time `end` by `Sdirk2` with so many steps.
fn by_sdirk2(steps: usize, drag: f64, end: f64) -> [f64; 2] {
    let [one, two] = Sdirk2.properties().stages else {
        panic!("it has two stages");
    };
    assert_eq!(one.share, two.share);
    let part = one.share * end / steps as f64;
    (0..steps).fold([1.0, 0.0], |old, _| {
        let first = euler_step(part, drag, old);
        let from = [0, 1].map(|c| old[c] + two.lead * (first[c] - old[c]));
        euler_step(part, drag, from)
    })
}

/// The same by BDF2, `3/2 y = 2 y_o - y_oo/2 + dt f`, which starts with a step of `Sdirk2`.
fn by_bdf2(steps: usize, drag: f64, end: f64) -> [f64; 2] {
    let dt = end / steps as f64;
    let mut before = [1.0, 0.0];
    let mut now = by_sdirk2(1, drag, dt);
    for _ in 1..steps {
        let from = [0, 1].map(|c| (4.0 * now[c] - before[c]) / 3.0);
        (before, now) = (now, euler_step(2.0 / 3.0 * dt, drag, from));
    }
    now
}

/// Why there is no BDF2. Of a linear problem a step of length `h` leaves `C h^3 y^(3)`, with
/// `3 g^2 - 2 g^3 - 1/6` for two stages and 1/3 for BDF2, whose steps are half as long.
#[test]
fn two_stages_leave_half_the_error_of_bdf2_at_as_many_solves() {
    let g = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
    let expected = 4.0 * (3.0 * g * g - 2.0 * g * g * g - 1.0 / 6.0) / (1.0 / 3.0);
    let end = 10.0;
    for drag in [0.0_f64, 0.2, 1.0] {
        let omega = (1.0 - 0.25 * drag * drag).sqrt();
        let (sin, cos) = (omega * end).sin_cos();
        let exact = (-0.5 * drag * end).exp() * (cos + 0.5 * drag / omega * sin);
        let solves = 4000;
        let ours = (by_sdirk2(solves / 2, drag, end)[0] - exact).abs();
        let bdf2 = (by_bdf2(solves, drag, end)[0] - exact).abs();
        let ratio = ours / bdf2;
        assert!(
            (ratio - expected).abs() < 0.01,
            "{drag}: {ratio} {expected}"
        );
    }
}
