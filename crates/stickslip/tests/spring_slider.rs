//! The spring slider of `problems`: published values, linear stability, limits that have a closed
//! form, and the parts of a scene that need no mesh: cohesion, viscosity, normal stress in time.

use std::f64::consts::SQRT_2;

use nalgebra::{Complex, SMatrix, Vector1};
use stickslip::friction::{DieterichRuina, FrictionLaw, RegularizedDieterichRuina, Tresca};
use stickslip::problems::{
    AGING, FRICTION, LoadPath, NORMAL_STRESS, SpringScene, SpringSlider, steady_state,
};
use stickslip::state::{
    Dieterich, Discontinuous, LogTheta, Ruina, StateError, StateLaw, StateVariable, Theta,
};
use stickslip::{
    Adaptive, BackwardEuler, ErrorControl, Monolithic, Newmark, Patch, Point, RateScheme,
    RungeKutta, Scene, SceneError, Sdirk2, Simulation, StateUpdate, StepError, Stepper,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const SLIP_DISTANCE: f64 = 1e-5;
const RUINA: Ruina = Ruina {
    slip_distance: SLIP_DISTANCE,
};

/// The implicit method of second order: Newmark's scheme, the state at the midpoint rate.
fn implicit<L, S>(
    scene: SpringScene<L, S>,
) -> Result<Simulation<SMatrix<f64, 1, 1>, L, S, Newmark, 1>, SceneError>
where
    L: FrictionLaw + Clone + 'static,
    S: StateLaw + Clone + 'static,
    L::State: From<S::State>,
{
    Ok(Simulation::new(scene, Newmark::default(), Point)?
        .with_coupling(Monolithic::default())
        .with_state_update(StateUpdate::Midpoint))
}

/// The coefficient of friction that the spring carries.
fn spring_force(slider: &SpringSlider, at: &stickslip::Snapshot<'_, 1>) -> f64 {
    let stretch = slider.load.position(at.time) - at.displacement[0][0];
    slider.stiffness * stretch / slider.normal_stress
}

/// The velocity step from 1 to 10 um/s at 10 s that is published.
fn stepped(stiffness: f64) -> SpringSlider {
    SpringSlider {
        stiffness,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-6).then(10.0, 1e-5),
    }
}

const STEPPED: DieterichRuina = DieterichRuina {
    a: 0.005,
    b: 0.01,
    ..FRICTION
};

/// The largest distance to the published coefficients at 11, 12, ... 17 s, and the coefficient at 100 s.
fn velocity_step(steps_a_second: usize) -> Result<(f64, f64), Box<dyn std::error::Error>> {
    const PUBLISHED: [f64; 7] = [
        0.60720485, 0.60186637, 0.5840091, 0.58563096, 0.58899543, 0.58998186, 0.58879751,
    ];
    let slider = stepped(1e9);
    let mut block = implicit(slider.steady(STEPPED, AGING, 1e-6)?)?;
    let (mut worst, mut last) = (0_f64, f64::NAN);
    let dt = 1.0 / steps_a_second as f64;
    block.run(100 * steps_a_second, dt, &mut |at| {
        last = spring_force(&slider, &at);
        let second = at.step / steps_a_second;
        if at.step.is_multiple_of(steps_a_second) && (11..=17).contains(&second) {
            worst = worst.max((last - PUBLISHED[second - 11]).abs());
        }
    })?;
    Ok((worst, last))
}

/// Against another code, which integrates stress and state adaptively; eight digits are published.
#[test]
fn a_velocity_step_gives_the_published_values() -> Outcome {
    let (coarse, _) = velocity_step(200)?;
    assert!(coarse < 5e-7, "{coarse:e}");
    let (fine, last) = velocity_step(4000)?;
    assert!(fine < 5e-9, "{fine:e}");
    let steady = 0.6 + (STEPPED.a - STEPPED.b) * 10f64.ln();
    assert!((last - steady).abs() < 1e-11, "{last}, {steady}");
    Ok(())
}

/// The slider of the stability analysis: 2e-4 m/s, the parameters of the elastic slider.
fn oscillator(share: f64, mass: f64, damping: f64) -> SpringSlider {
    let critical =
        SpringSlider::critical_stiffness(NORMAL_STRESS, FRICTION.a, FRICTION.b, SLIP_DISTANCE);
    SpringSlider {
        stiffness: share * critical,
        normal_stress: NORMAL_STRESS,
        mass,
        damping,
        load: LoadPath::steady(RATE),
    }
}

const RATE: f64 = 2e-4;

/// The complex growth rate [1/s] of a small disturbance of steady sliding, measured.
///
/// A sum of `exp(s t)` and its conjugate satisfies `x(t + h) = p x(t) - q x(t - h)`, where `exp(s h)`
/// solves `z^2 = p z - q`. With `h` a quarter of a period, least squares over 2 s to 5 s give both.
fn growth(slider: &SpringSlider, dt: f64) -> Result<Complex<f64>, Box<dyn std::error::Error>> {
    let rate = RATE * (1.0 + 1e-6);
    let scene = slider.scene(FRICTION, AGING, rate, steady_state(&AGING, RATE)?)?;
    let mut block = implicit(scene)?;
    let mut signal = Vec::new();
    block.run((5.0 / dt).round() as usize, dt, &mut |at| {
        if at.time > 2.0 {
            signal.push((at.velocity[0][0] / RATE).ln());
        }
    })?;
    let stride = (0.1 / dt).round() as usize;
    let (mut xx, mut xy, mut yy, mut xz, mut yz) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for i in 2 * stride..signal.len() {
        let (x, y, z) = (signal[i - stride], -signal[i - 2 * stride], signal[i]);
        xx += x * x;
        xy += x * y;
        yy += y * y;
        xz += x * z;
        yz += y * z;
    }
    let determinant = xx * yy - xy * xy;
    let (p, q) = (
        (xz * yy - yz * xy) / determinant,
        (xx * yz - xy * xz) / determinant,
    );
    let largest = signal.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    assert!(largest < 1e-3, "not a small disturbance");
    let root = 0.5 * (Complex::new(p, 0.0) + Complex::new(p * p - 4.0 * q, 0.0).sqrt());
    Ok(root.ln() / (stride as f64 * dt))
}

/// The growth rate by linear stability, for `m u'' + eta u' + tau = K (x - u)`:
///
/// ```text
/// m V/L s^2 + m s^3 + (eta + a sigma/V) s^2 + [K + (eta + a sigma/V) V/L - b sigma/L] s + K V/L = 0
/// ```
///
/// from `delta alpha = -(s/L)/(s + V/L) delta u`; by Newton's method from a root of the quasi-static
/// problem.
fn predicted(slider: &SpringSlider) -> Complex<f64> {
    let slip = RATE / SLIP_DISTANCE;
    let direct = slider.damping + FRICTION.a * slider.normal_stress / RATE;
    let linear =
        slider.stiffness + direct * slip - FRICTION.b * slider.normal_stress / SLIP_DISTANCE;
    let (cubic, square, constant) = (
        slider.mass,
        slider.mass * slip + direct,
        slider.stiffness * slip,
    );
    let mut s = Complex::new(0.0, 10.0 * SQRT_2);
    for _ in 0..50 {
        let value = ((s * cubic + square) * s + linear) * s + constant;
        let slope = (s * (3.0 * cubic) + 2.0 * square) * s + linear;
        s -= value / slope;
    }
    s
}

/// The real part changes sign at `(b - a) sigma/L`, where the imaginary one is `sqrt((b - a)/a) V/L`.
#[test]
fn oscillations_grow_below_the_critical_stiffness() -> Outcome {
    for (share, expected) in [
        (0.8, 1.0),
        (0.95, 0.25),
        (1.0, 0.0),
        (1.05, -0.25),
        (1.2, -1.0),
    ] {
        let slider = oscillator(share, 0.0, 0.0);
        let rate = growth(&slider, 1e-3)?;
        let tolerance = f64::max(0.01 * f64::abs(expected), 0.0025);
        assert!((rate.re - expected).abs() < tolerance, "{share}: {rate}");
        assert!((predicted(&slider).re - expected).abs() < 1e-12);
        if share == 1.0 {
            assert!((rate.im - 14.142).abs() < 0.01 * 14.142, "{rate}");
        }
    }
    Ok(())
}

/// Radiation damping and inertia, alone and together, move the rate as the characteristic equation
/// says, and the error of the measured rate is of second order in the step.
#[test]
fn damping_and_inertia_change_the_growth_rate() -> Outcome {
    let direct = FRICTION.a * NORMAL_STRESS / RATE;
    for (share, mass, damping) in [
        (0.8, 0.0, 0.1 * direct),
        (0.8, 0.0, 0.02 * direct),
        (0.9, 4e3, 0.0),
        (1.1, 4e3, 0.0),
        (0.8, 2e3, 0.05 * direct),
    ] {
        let slider = oscillator(share, mass, damping);
        let plain = predicted(&oscillator(share, 0.0, 0.0));
        let expected = predicted(&slider);
        let error = |dt| -> Result<f64, Box<dyn std::error::Error>> {
            Ok((growth(&slider, dt)? - expected).norm())
        };
        let (coarse, fine) = (error(2e-3)?, error(1e-3)?);
        assert!((expected - plain).norm() > 0.1, "{expected}, {plain}");
        assert!(fine < 0.01, "{expected}: {fine:e}");
        assert!(
            (3.5..4.5).contains(&(coarse / fine)),
            "{coarse:e}, {fine:e}"
        );
    }
    Ok(())
}

/// A spring so stiff that the block follows the load point: the coefficient jumps by `a ln(V2/V1)`, and
/// settles at `(a - b) ln(V2/V1)` from where it was.
///
/// The spring needs a slip of `d = a sigma ln(10)/K` and some to be loaded, over which the state
/// takes some `b d/L` from the jump.
#[test]
fn a_stiff_spring_shows_the_direct_effect_and_the_steady_one() -> Outcome {
    let stiffness = 1e13;
    let slider = stepped(stiffness);
    let (jump, change) = (STEPPED.a * 10f64.ln(), (STEPPED.a - STEPPED.b) * 10f64.ln());
    let lost = STEPPED.b * jump * 1e6 / stiffness / SLIP_DISTANCE;
    let mut block = Simulation::new(slider.steady(STEPPED, AGING, 1e-6)?, Sdirk2, Point)?
        .with_coupling(Monolithic::default());
    let (mut peak, mut last) = (0_f64, f64::NAN);
    Adaptive::new(1e-6)
        .with_stops(slider.load.kinks())
        .run(&mut block, 60.0, &mut |at| {
            last = spring_force(&slider, &at) - 0.6;
            peak = peak.max(last);
        })?;
    assert!(peak < jump && peak > jump - 5.0 * lost, "{peak}, {jump}");
    assert!((last - change).abs() < 1e-8, "{last}, {change}");
    Ok(())
}

/// Friction after a hold. On a stiff spring the block stands still: by the aging law the state is
/// older by the hold, by the slip law it has not changed.
///
/// While it stands the spring relaxes, by a slip of about `a sigma/K ln(t V/(a sigma/K))`; its share of
/// `L` is what is allowed.
#[test]
fn a_hold_ages_the_contact() -> Outcome {
    let hold = 100.0;
    let slider = SpringSlider {
        stiffness: 1e14,
        normal_stress: 1e6,
        mass: 0.0,
        damping: 0.0,
        load: LoadPath::steady(1e-6)
            .then(10.0, 0.0)
            .then(10.0 + hold, 1e-6),
    };
    let relaxation = FRICTION.a * slider.normal_stress / slider.stiffness;
    let slip = relaxation * (1.0 + hold * 1e-6 / relaxation).ln();
    let until = 10.0 + hold;
    let run = |block: &mut dyn Stepper<1>| -> Result<(f64, f64), Box<dyn std::error::Error>> {
        Adaptive::new(1e-6)
            .with_stops(slider.load.kinks())
            .run(block, until, &mut |_| ())?;
        let at = block.snapshot();
        assert_eq!(at.time, until);
        Ok((at.states.state(0).exp(), at.velocity[0][0]))
    };
    let (aged, rate) = run(&mut RungeKutta::new(slider.steady(FRICTION, AGING, 1e-6)?)?)?;
    let expected = SLIP_DISTANCE / 1e-6 + hold;
    assert!(aged < expected && aged > expected * (1.0 - 2.0 * slip / SLIP_DISTANCE));
    assert!(rate < 1e-3 * 1e-6, "{rate:e}");
    let (held, _) = run(&mut RungeKutta::new(slider.steady(FRICTION, RUINA, 1e-6)?)?)?;
    let fresh = SLIP_DISTANCE / 1e-6;
    // ln(V theta/L) is down to -20 at the end; the state takes its share of that.
    assert!(held > fresh && held < fresh * (1.0 + 20.0 * slip / SLIP_DISTANCE));
    Ok(())
}

/// `theta' = 1 - (V theta/2L)^2`, Perrin, Rice and Zheng's law.
#[derive(Clone, Copy)]
struct PerrinRiceZheng;

impl StateLaw for PerrinRiceZheng {
    type State = Theta;

    fn evolution(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let x = slip_rate * theta / (2.0 * SLIP_DISTANCE);
        1.0 - x * x.abs()
    }

    fn evolution_slope(&self, Theta(theta): Theta, slip_rate: f64) -> f64 {
        let rate = slip_rate / (2.0 * SLIP_DISTANCE);
        -2.0 * theta.abs() * rate * rate
    }
}

#[test]
fn every_law_has_its_steady_state() -> Outcome {
    for exponent in -15..=2 {
        let rate = 10f64.powi(exponent);
        let near = |value: f64, exact: f64| (value - exact).abs() <= 1e-12 * exact.abs().max(1.0);
        let log = (SLIP_DISTANCE / rate).ln();
        assert!(near(steady_state(&AGING, rate)?.value(), log));
        assert!(near(steady_state(&RUINA, rate)?.value(), log));
        let jump = steady_state(&Discontinuous, rate)?.value() * rate;
        assert!(near(jump, 1.0), "{rate:e}: {jump}");
        let user = steady_state(&PerrinRiceZheng, rate)?.value() * rate / SLIP_DISTANCE;
        assert!(near(user, 2.0), "{rate:e}: {user}");
    }
    for rate in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        for error in [
            steady_state(&AGING, rate).err(),
            steady_state(&Discontinuous, rate).err(),
        ] {
            assert!(
                matches!(error, Some(StateError::NotPositive { .. })),
                "{rate}: {error:?}"
            );
        }
    }
    let law = Dieterich { slip_distance: 0.0 };
    assert!(steady_state(&law, 1e-6).is_err());
    Ok(())
}

/// Simpson's rule is exact on a segment, where the velocity is linear.
#[test]
fn a_load_path_is_the_integral_of_its_velocity() {
    let path = LoadPath::steady(1e-6)
        .then(10.0, 0.0)
        .ramp(17.0, 31.0, 3e-5)
        .then(40.0, -2e-6)
        .ramp(40.0, 45.0, 1e-7);
    let kinks: Vec<f64> = path.kinks().collect();
    assert_eq!(kinks, [10.0, 17.0, 31.0, 40.0, 40.0, 45.0]);
    let mut position = 0.0;
    let mut from = 0.0;
    for to in kinks.iter().copied().chain([100.0]) {
        for part in 0..4 {
            let width = 0.25 * (to - from);
            let left = from + f64::from(part) * width;
            // The velocity is that from the right.
            let end = path.velocity((left + width).next_down());
            position +=
                width / 6.0 * (path.velocity(left) + 4.0 * path.velocity(left + 0.5 * width) + end);
            let given = path.position(left + width);
            assert!(
                (given - position).abs() < 1e-17,
                "{left}: {given:e}, {position:e}"
            );
        }
        from = to;
    }
    assert_eq!(path.velocity(5.0), 1e-6);
    assert_eq!(path.velocity(10.0), 0.0);
    assert_eq!(path.velocity(1e9), 1e-7);
}

/// A disturbed slider above its critical stiffness, after 30 s.
fn settled(
    block: &mut dyn Stepper<1>,
    control: ErrorControl,
) -> Result<[f64; 3], Box<dyn std::error::Error>> {
    Adaptive::new(1e-11)
        .with_error_control(control)
        .with_stops([10.0])
        .run(block, 30.0, &mut |_| ())?;
    let at = block.snapshot();
    Ok([at.velocity[0][0], at.states.state(0), at.displacement[0][0]])
}

fn methods_agree<S>(law: S) -> Outcome
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
{
    let slider = SpringSlider {
        damping: 5e6,
        ..stepped(6e8)
    };
    let scene = || slider.steady(FRICTION, law.clone(), 1e-6);
    let control = ErrorControl::default();
    let explicit = settled(&mut RungeKutta::new(scene()?)?, control)?;
    let extrapolated = settled(&mut implicit(scene()?)?, ErrorControl::extrapolated(4))?;
    for (a, b) in explicit.iter().zip(extrapolated) {
        assert!(
            (a - b).abs() < 1e-9 * a.abs(),
            "{explicit:?}, {extrapolated:?}"
        );
    }
    Ok(())
}

/// They share the laws, and nothing of the integration.
#[test]
fn explicit_and_implicit_methods_agree() -> Outcome {
    methods_agree(AGING)?;
    methods_agree(RUINA)
}

/// Above the cut-off the two laws differ by less than `a (Vm/V)^2`, far below rounding here.
#[test]
fn the_regularised_law_gives_the_same_motion() -> Outcome {
    let slider = stepped(1e9);
    let regularised = RegularizedDieterichRuina {
        a: STEPPED.a,
        b: STEPPED.b,
        reference_friction: STEPPED.reference_friction,
        reference_velocity: STEPPED.reference_velocity,
        slip_distance: STEPPED.slip_distance,
    };
    let mut cut = implicit(slider.steady(STEPPED, AGING, 1e-6)?)?;
    let mut smooth = implicit(slider.steady(regularised, AGING, 1e-6)?)?;
    let mut closest = f64::INFINITY;
    for _ in 0..2000 {
        cut.step(1e-2)?;
        smooth.step(1e-2)?;
        let (a, b) = (cut.snapshot(), smooth.snapshot());
        let excess = a.velocity[0][0].ln() - STEPPED.ln_cutoff_rate(LogTheta(a.states.state(0)));
        closest = closest.min(excess);
        let difference = (a.velocity[0][0] / b.velocity[0][0] - 1.0).abs();
        assert!(difference < 1e-11, "{difference:e}");
        assert!((a.states.state(0) - b.states.state(0)).abs() < 1e-11);
    }
    assert!((-2.0 * closest).exp() < 1e-40, "{closest}");
    Ok(())
}

/// The strength is `mu sigma + c`: below it nothing moves, above it the force stays there.
#[test]
fn cohesion_adds_to_the_strength() -> Outcome {
    let (stiffness, pull, stress, cohesion) = (2e6, 1e-3, 1e5, 2.5e4);
    let strength = 0.6 * stress + cohesion;
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
        .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, -stress)
        .with_cohesion(cohesion)
        .with_load_history(move |time, load| load[0][0] = stiffness * pull * time);
    let mut block = Simulation::new(scene, BackwardEuler, Point)?;
    let mut slid = 0;
    for _ in 0..100 {
        block.step(0.7)?;
        let at = block.snapshot();
        let drive = stiffness * pull * at.time;
        let force = drive - stiffness * at.displacement[0][0];
        if drive <= strength {
            assert_eq!(at.velocity[0][0], 0.0);
            assert_eq!(at.displacement[0][0], 0.0);
        } else {
            assert!((force - strength).abs() < 1e-15 * stiffness, "{force}");
            slid += 1;
        }
    }
    // 2000 N/s reach 85 kN at 42.5 s, within the 61st step.
    assert_eq!(slid, 100 - 60);
    Ok(())
}

/// Rate and state under cohesion alone: without normal stress the strength knows neither.
#[test]
fn cohesion_needs_no_normal_stress() -> Outcome {
    let (stiffness, cohesion) = (2e6, 2.5e4);
    for eliminated in [true, false] {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_friction(Patch::point(1.0), FRICTION, 0.0)
            .with_state(AGING, LogTheta(0.0))
            .with_cohesion(cohesion)
            .with_load_history(|time, load| load[0][0] = 2e3 * time);
        let mut block = Simulation::new(scene, BackwardEuler, Point)?;
        if eliminated {
            block = block.with_coupling(Monolithic::without_fallback());
        }
        block.run(50, 0.7, &mut |at| {
            let exact = (2e3 * at.time - cohesion).max(0.0) / stiffness;
            assert!((at.displacement[0][0] - exact).abs() < 1e-15, "{exact:e}");
        })?;
    }
    Ok(())
}

/// A normal stress that falls from 1e5 Pa by 2 kPa/s, under a pull that grows by 600 N/s: the
/// block lets go where `600 t = 0.6 (1e5 - 2e3 t)`, at 33.3 s, and balances the force from there on.
#[test]
fn a_falling_normal_stress_lets_the_block_go() -> Outcome {
    let stiffness = 1e6;
    let stress = |time: f64| 1e5 - 2e3 * time;
    let exact = 0.6 * 1e5 / (600.0 + 0.6 * 2e3);
    for steps_a_second in [3_usize, 7, 100] {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(stiffness))
            .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
            .with_normal_stress_history(move |time, stresses| stresses[0] = -stress(time))
            .with_load_history(|time, load| load[0][0] = 600.0 * time);
        let mut block = Simulation::new(scene, BackwardEuler, Point)?;
        let mut first = None;
        block.run(
            40 * steps_a_second,
            1.0 / steps_a_second as f64,
            &mut |at| {
                let force = 600.0 * at.time - stiffness * at.displacement[0][0];
                if at.velocity[0][0] == 0.0 {
                    assert!(at.time <= exact && at.displacement[0][0] == 0.0);
                } else {
                    assert!(at.time > exact);
                    first = first.or(Some(at.step));
                    let imbalance = force - 0.6 * stress(at.time);
                    assert!(imbalance.abs() < 1e-12 * force, "{imbalance:e}");
                }
            },
        )?;
        let expected = (exact * steps_a_second as f64).floor() as usize + 1;
        assert_eq!(first, Some(expected));
    }
    Ok(())
}

/// The history starts from the stress of the scene, and rate and state feel it too: force balance.
#[test]
fn rate_and_state_follow_a_normal_stress_in_time() -> Outcome {
    let slider = SpringSlider {
        damping: 5e6,
        ..stepped(6e8)
    };
    let factor = |time: f64| 1.0 + 0.1 * (0.7 * time).sin();
    let scene = || -> Result<_, SceneError> {
        Ok(slider
            .steady(FRICTION, AGING, 1e-6)?
            .with_normal_stress_history(move |time, stress| stress[0] *= factor(time)))
    };
    let mut block = implicit(scene()?)?;
    block.run(3000, 1e-2, &mut |at| {
        let (rate, state) = (at.velocity[0][0], LogTheta(at.states.state(0)));
        let strength = 1e6 * factor(at.time) * FRICTION.coefficient(rate, state);
        let spring = slider.stiffness * (slider.load.position(at.time) - at.displacement[0][0]);
        let imbalance = spring - strength - slider.damping * rate;
        assert!(imbalance.abs() < 1e-12 * spring, "{imbalance:e}");
    })?;
    let control = ErrorControl::default();
    let explicit = settled(&mut RungeKutta::new(scene()?)?, control)?;
    let extrapolated = settled(&mut implicit(scene()?)?, ErrorControl::extrapolated(4))?;
    for (a, b) in explicit.iter().zip(extrapolated) {
        assert!(
            (a - b).abs() < 1e-9 * a.abs(),
            "{explicit:?}, {extrapolated:?}"
        );
    }
    Ok(())
}

/// A block of mass `m` without a spring, pulled by `F` against friction `mu sigma` and the viscosity `c`:
/// `v = (F - mu sigma)/c (1 - exp(-c t/m))`.
#[test]
fn a_viscous_block_approaches_its_terminal_velocity() -> Outcome {
    let (mass, viscosity, force, stress) = (5e3, 2e4, 9e4, 1e5);
    let terminal = (force - 0.6 * stress) / viscosity;
    let block = || -> Result<_, SceneError> {
        let scene = Scene::new(SMatrix::<f64, 1, 1>::new(0.0))
            .with_mass(SMatrix::<f64, 1, 1>::new(mass))
            .with_viscosity(SMatrix::<f64, 1, 1>::new(viscosity))
            .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, stress)
            .with_load(vec![Vector1::new(force)])
            .with_acceleration(vec![Vector1::new((force - 0.6 * stress) / mass)]);
        Simulation::new(scene, Newmark::default(), Point)
    };
    let error = |steps: usize| -> Result<f64, Box<dyn std::error::Error>> {
        let mut block = block()?;
        let mut worst = 0_f64;
        block.run(steps, 1.0 / steps as f64, &mut |at| {
            let exact = -terminal * f64::exp_m1(-viscosity * at.time / mass);
            worst = worst.max((at.velocity[0][0] - exact).abs());
        })?;
        Ok(worst)
    };
    let (coarse, fine) = (error(100)?, error(200)?);
    assert!(
        (3.9..4.1).contains(&(coarse / fine)),
        "{coarse:e}, {fine:e}"
    );
    let mut block = block()?;
    block.run(1000, 1e-2, &mut |_| ())?;
    let rate = block.snapshot().velocity[0][0];
    assert!(
        (rate - terminal).abs() < 1e-13 * terminal,
        "{rate}, {terminal}"
    );
    Ok(())
}

/// Newmark's scheme: the change of energy is the way times the mean of the forces at its two ends.
#[test]
fn energy_changes_by_work_friction_and_viscous_loss() -> Outcome {
    let slider = SpringSlider {
        mass: 4e3,
        damping: 3e5,
        ..oscillator(0.7, 0.0, 0.0)
    };
    let rate = 3.0 * RATE;
    let mut block = implicit(slider.scene(FRICTION, AGING, rate, steady_state(&AGING, RATE)?)?)?;
    let mut last: Option<(f64, f64, [f64; 3])> = None;
    let (mut balance, mut supplied, mut viscous) = (0.0, 0.0, 0.0);
    let (mut slowest, mut fastest) = (f64::INFINITY, 0_f64);
    for _ in 0..4000 {
        block.step(5e-4)?;
        let at = block.snapshot();
        let (u, v) = (at.displacement[0][0], at.velocity[0][0]);
        (slowest, fastest) = (slowest.min(v), fastest.max(v));
        let energy = 0.5 * (slider.mass * v * v + slider.stiffness * u * u);
        let forces = [
            slider.stiffness * slider.load.position(at.time),
            slider.normal_stress * FRICTION.coefficient(v, LogTheta(at.states.state(0))),
            slider.damping * v,
        ];
        if let Some((u_old, energy_old, old)) = last {
            let work = |k: usize| 0.5 * (u - u_old) * (forces[k] + old[k]);
            let imbalance = energy - energy_old - work(0) + work(1) + work(2);
            let scale = work(0).abs() + work(1).abs() + work(2).abs() + 1e-3 * energy;
            assert!(imbalance.abs() < 1e-12 * scale, "{imbalance:e}, {scale:e}");
            balance += energy - energy_old + work(1) + work(2);
            supplied += work(0);
            viscous += work(2);
        }
        last = Some((u, energy, forces));
    }
    assert!(fastest > 2.0 * slowest, "{slowest:e}, {fastest:e}");
    assert!(viscous > 1e-4 * supplied, "{viscous:e}, {supplied:e}");
    assert!((balance - supplied).abs() < 1e-12 * supplied.abs());
    Ok(())
}

type Block = SpringScene<Tresca, ()>;

/// A block in order.
fn plain() -> Block {
    Scene::new(SMatrix::<f64, 1, 1>::new(1e6))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(1e3))
        .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
}

fn refused(scene: Block, scheme: impl RateScheme) -> Option<SceneError> {
    Simulation::new(scene, scheme, Point).err()
}

#[test]
fn illegal_parts_are_refused_by_name() -> Outcome {
    for cohesion in [-1.0, f64::NAN, f64::INFINITY] {
        for error in [
            refused(plain().with_cohesion(cohesion), Sdirk2),
            RungeKutta::new(plain().with_cohesion(cohesion)).err(),
        ] {
            let Some(SceneError::Value { what, value, .. }) = error else {
                return Err(format!("{cohesion}: {error:?}").into());
            };
            assert_eq!((what, value.to_bits()), ("cohesion", cohesion.to_bits()));
        }
    }
    let viscosity = SMatrix::<f64, 1, 1>::new(f64::NAN);
    let error = refused(plain().with_viscosity(viscosity), Sdirk2);
    assert!(
        matches!(
            error,
            Some(SceneError::Value {
                what: "viscosity matrix",
                ..
            })
        ),
        "{error:?}"
    );
    let slider = |stiffness, mass, damping| SpringSlider {
        stiffness,
        mass,
        damping,
        ..stepped(1e9)
    };
    for (name, slider) in [
        ("stiffness", slider(0.0, 0.0, 0.0)),
        ("stiffness", slider(f64::NAN, 0.0, 0.0)),
        ("mass", slider(1e9, -1.0, 0.0)),
        ("damping", slider(1e9, 0.0, f64::INFINITY)),
    ] {
        let error = slider.steady(FRICTION, AGING, 1e-6).err();
        assert!(
            matches!(error, Some(SceneError::Value { what, .. }) if what == name),
            "{error:?}"
        );
    }
    let error = stepped(1e9).steady(FRICTION, AGING, 0.0).err();
    assert!(matches!(error, Some(SceneError::State(_))), "{error:?}");
    let error = stepped(1e9)
        .scene(FRICTION, AGING, -1.0, LogTheta(0.0))
        .err();
    assert!(matches!(error, Some(SceneError::Value { .. })), "{error:?}");
    Ok(())
}

/// A state from which a law cannot start is refused, as [`StateLaw::validate_state`] says.
#[test]
fn a_negative_theta_is_refused() -> Outcome {
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e6))
        .with_friction(Patch::point(1.0), FRICTION, 1e5)
        .with_state(Discontinuous, Theta(-1.0));
    let error = Simulation::new(scene, BackwardEuler, Point).err();
    assert_eq!(
        error,
        Some(SceneError::State(StateError::NegativeTheta { theta: -1.0 }))
    );
    Ok(())
}

#[test]
fn a_normal_stress_that_is_no_number_fails_the_step() -> Outcome {
    let broken = |time: f64, stress: &mut [f64]| {
        if time > 0.25 {
            stress[0] = f64::NAN;
        }
    };
    let mut block = Simulation::new(plain().with_normal_stress_history(broken), Sdirk2, Point)?;
    block.step(0.2)?;
    let failure = block.step(0.2).err().ok_or("taken")?;
    assert!(
        matches!(
            failure.cause,
            StepError::Data { what: "normal stress", vertex: 0, value } if value.is_nan()
        ),
        "{failure:?}"
    );
    assert_eq!((failure.step, block.snapshot().step), (2, 1));
    assert_eq!(block.snapshot().time, 0.2);
    block.step(0.05)?;

    let mut block = RungeKutta::new(plain().with_normal_stress_history(broken))?;
    block.step(0.2)?;
    let failure = block.step(0.2).err().ok_or("taken")?;
    assert!(
        matches!(failure.cause, StepError::Stage { .. }),
        "{failure:?}"
    );
    assert_eq!((failure.step, block.snapshot().step), (2, 1));
    block.step(0.05)?;
    let always = |_: f64, stress: &mut [f64]| stress[0] = f64::NAN;
    let error = RungeKutta::new(plain().with_normal_stress_history(always)).err();
    assert!(
        matches!(error, Some(SceneError::Explicit { .. })),
        "{error:?}"
    );
    Ok(())
}

#[test]
fn an_explicit_method_says_what_it_cannot_take() -> Outcome {
    let matrix = SMatrix::<f64, 1, 1>::new(1e6);
    let point = Patch::point(1.0);
    for (scene, said) in [
        (plain().with_mass(matrix), "without mass"),
        (Scene::new(matrix), "friction"),
        (plain().in_equilibrium(), "initial displacement"),
        (
            Scene::new(matrix)
                .with_friction(Patch::point(1.0), Tresca { coefficient: 0.6 }, 1e5)
                .hold(
                    Patch {
                        vertices: vec![0],
                        weights: vec![1.0],
                    },
                    [false],
                ),
            "free",
        ),
    ] {
        let error = RungeKutta::new(scene).err().ok_or("accepted")?;
        assert!(matches!(error, SceneError::Explicit { .. }), "{error}");
        assert!(error.to_string().contains(said), "{error}");
    }
    // All its components held is no frictional vertex, for any method.
    let error = RungeKutta::new(plain().hold(point, [true])).err();
    assert!(
        matches!(
            error,
            Some(SceneError::TouchingBoundaries { vertex: 0, .. })
        ),
        "{error:?}"
    );
    let mut block = RungeKutta::new(plain())?;
    for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let failure = block.step(dt).err().ok_or("taken")?;
        assert!(
            matches!(failure.cause, StepError::StepSize { .. }),
            "{failure}"
        );
        let failure = block.step_estimated(dt, &ErrorControl::default()).err();
        assert!(failure.is_some());
    }
    assert_eq!(block.snapshot().step, 0);
    Ok(())
}
