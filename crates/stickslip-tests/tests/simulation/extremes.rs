//! Extreme parameters: a step is solved, refused or reported, and a failed one leaves no trace.

use proptest::prelude::*;
use stickslip::friction::{DieterichRuina, FrictionLaw, StateDependentTresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS, PippingSlider};
use stickslip::problems::spring_slider::{LoadPath, SpringSlider};
use stickslip::state::{
    Dieterich, Discontinuous, LogTheta, Reads, Ruina, StateError, StateLaw, StateVariable, Theta,
};
use stickslip::{
    Contact, FixedPoint, Monolithic, Newmark, Point, SceneError, Simulation, StepError,
    StepFailure, StepState, Tnnmg,
};

use crate::Outcome;
use crate::common::bits;

type Spring = Simulation<1>;

/// A spring slider at rest in its load, at `slip_rate`.
fn slider(stiffness: f64, normal_stress: f64, mass: f64, velocity: f64) -> SpringSlider {
    SpringSlider {
        stiffness,
        normal_stress,
        mass,
        damping: 0.0,
        load: LoadPath::steady(velocity),
    }
}

fn spring<L, S>(
    slider: &SpringSlider,
    (friction, law, initial): (L, S, S::State),
    slip_rate: f64,
    monolithic: bool,
) -> Result<Spring, SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let mut scene = slider.scene(friction, law, slip_rate, initial)?;
    if slider.mass == 0.0 {
        // What rounding makes of tiny stresses is no rate near the one given.
        scene = scene.with_balanced_rates();
    }
    let simulation = Simulation::new(scene, Newmark::default(), Point)?;
    let simulation = simulation.with_tolerance(1e-13)?;
    Ok(if monolithic {
        simulation.with_coupling(Monolithic::default())
    } else {
        simulation.with_coupling(FixedPoint::default())
    })
}

/// All that the next step depends on, the motion as bits.
fn all(spring: &Spring) -> (Vec<u64>, StepState<1>) {
    (bits(&spring.snapshot()), spring.state().clone())
}

/// Up to `steps` steps. One that fails must leave no trace; a tenth of it, and so on, is then tried.
fn march(
    spring: &mut Spring,
    steps: usize,
    dt: f64,
    mut check: impl FnMut(&Spring) -> Result<(), TestCaseError>,
) -> Result<Option<StepFailure>, TestCaseError> {
    for _ in 0..steps {
        let before = all(spring);
        match spring.step(dt) {
            Ok(_) => check(spring)?,
            Err(failure) => {
                prop_assert_eq!(all(spring), before.clone());
                prop_assert!(!failure.to_string().contains('\n'));
                for power in 1..=3 {
                    if spring.step(dt * 0.1_f64.powi(power)).is_ok() {
                        check(spring)?;
                        break;
                    }
                    prop_assert_eq!(all(spring), before.clone());
                }
                return Ok(Some(failure));
            }
        }
    }
    Ok(None)
}

fn decades(range: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    range.prop_map(|exponent| 10f64.powf(exponent))
}

/// A spring slider, its law and its start.
#[derive(Debug, Clone, Copy)]
struct Extreme {
    dt: f64,
    stiffness: f64,
    mass: f64,
    normal_stress: f64,
    velocity: f64,
    slip_rate: f64,
    alpha: f64,
    slip_distance: f64,
    a: f64,
    ratio: f64,
    ruina: bool,
    closed: bool,
    monolithic: bool,
}

impl Extreme {
    /// The force that is left without friction is friction: at the slip rate found and the state found,
    /// for a velocity that is known up to ten tolerances, or ten of the smallest numbers.
    fn is_solved_or_reports(&self) -> Result<(), TestCaseError> {
        let &Self {
            dt,
            stiffness,
            mass,
            normal_stress,
            velocity,
            slip_rate,
            alpha,
            slip_distance,
            a,
            ratio,
            ruina,
            closed,
            monolithic,
        } = self;
        let friction = DieterichRuina {
            a,
            b: ratio * a,
            slip_distance,
            ..FRICTION
        };
        let body = slider(stiffness, normal_stress, mass, velocity);
        let law: AnyLaw = if ruina {
            Box::new(Ruina { slip_distance })
        } else {
            Box::new(Dieterich { slip_distance })
        };
        let law: AnyLaw = if closed {
            law
        } else {
            Box::new(WithoutClosedForm(law))
        };
        let made = spring(
            &body,
            (friction, law, LogTheta(alpha)),
            slip_rate,
            monolithic,
        );
        let Ok(mut simulation) = made else {
            return Err(TestCaseError::fail("refused"));
        };
        let slip_rate = simulation.snapshot().velocity[0][0].abs();
        prop_assert!(slip_rate.is_finite());
        march(&mut simulation, 5, dt, |spring| {
            let at = spring.snapshot();
            let (u, v, state) = (
                at.displacement[0][0],
                at.velocity[0][0],
                at.contact(0).state(0),
            );
            let acceleration = at.acceleration.first().map_or(0.0, |a| a[0]);
            // A step that failed was taken smaller.
            let dt = spring.state().last_step;
            let resistance = 0.5 * dt * stiffness + 2.0 / dt * mass;
            prop_assert!([u, v, state, acceleration].iter().all(|x| x.is_finite()));
            let (speed, load) = (v.abs(), stiffness * velocity * at.time);
            let left = load - stiffness * u - mass * acceleration;
            let known = (1e-13 * normal_stress / resistance).max(1e-12 * speed);
            let near = 10.0 * known.max(SMALLEST);
            let strength = |rate: f64| normal_stress * friction.coefficient(rate, LogTheta(state));
            // The state follows the rate, and may lag by as much as it answers to the uncertainty.
            // The aging law moves by less than dV/V, the slip law by dt dV/L of its way to the steady state besides.
            let way = if ruina {
                alpha.abs() + state.abs()
            } else {
                0.0
            };
            let slipped = dt * near / slip_distance;
            let answer = slipped.min(near / speed.max(near) + 1e3 * near) + slipped.min(1.0) * way;
            let lag = normal_stress * ratio * a * answer;
            let terms = load.abs()
                + stiffness * (u.abs() + dt * speed.max(slip_rate))
                + strength(speed + near)
                + mass
                    * (acceleration.abs()
                        + 4.0 / dt * (speed + slip_rate + dt * acceleration.abs()))
                + normal_stress * (a * 800.0 + ratio * a * state.abs());
            // The smallest numbers are rounded to themselves.
            let slack = f64::MIN_POSITIVE
                + 1e-12 * terms
                + (stiffness * dt + mass * 2.0 / dt) * near
                + 10.0 * lag;
            if speed > near {
                let along = left * v.signum();
                prop_assert!(
                    strength(speed - near) - slack <= along
                        && along <= strength(speed + near) + slack,
                    "{left:e} against {:e} at {v:e}, slack {slack:e}",
                    strength(speed)
                );
            } else {
                // What friction stops for good has no acceleration: friction may rise to that of the slip rate that the
                // force would reach within the step.
                let reached = if mass > 0.0 && acceleration == 0.0 {
                    dt * left.abs() / mass
                } else {
                    0.0
                };
                let strongest = strength((speed + near).max(reached));
                prop_assert!(
                    left.abs() <= strongest + slack,
                    "{left:e} at {v:e}, slack {slack:e}"
                );
            }
            Ok(())
        })?;
        Ok(())
    }
}

/// The smallest positive number: a velocity is not rounded to less.
const SMALLEST: f64 = f64::MIN_POSITIVE * f64::EPSILON;

proptest! {
    #![proptest_config(ProptestConfig { cases: 10000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_spring_slider_is_solved_or_reports(
        dt in decades(-12.0..6.0), stiffness in decades(0.0..12.0), mass in prop_oneof![Just(0.0), decades(-3.0..10.0)],
        normal_stress in prop_oneof![Just(0.0), decades(0.0..12.0)], velocity in prop_oneof![Just(0.0), decades(-9.0..0.0)],
        slip_rate in prop_oneof![Just(0.0), Just(5e-324), Just(1e-300), decades(-20.0..10.0)],
        alpha in prop_oneof![-800.0..800.0f64, -20.0..20.0f64], slip_distance in decades(-12.0..0.0),
        a in decades(-6.0..0.0), ratio in prop::sample::select(vec![0.0, 0.5, 1.5, 2.0, 5.0, 150.0]),
        ruina in any::<bool>(), closed in any::<bool>(), monolithic in any::<bool>(),
    ) {
        Extreme {
            dt, stiffness, mass, normal_stress, velocity, slip_rate, alpha, slip_distance, a, ratio, ruina, closed, monolithic,
        }
        .is_solved_or_reports()?;
    }
}

/// A velocity below the smallest number is rounded to it, and the spring is as far from equilibrium as that.
#[test]
fn a_velocity_is_known_to_the_smallest_number() -> Outcome {
    for monolithic in [false, true] {
        let extreme = Extreme {
            dt: 877625.4550674852,
            stiffness: 522702166016.9391,
            mass: 0.0,
            normal_stress: 0.0,
            velocity: 0.0,
            slip_rate: 5e-324,
            alpha: -543.2060921769839,
            slip_distance: 1.0,
            a: 1.0,
            ratio: 0.5,
            ruina: false,
            closed: false,
            monolithic,
        };
        extreme.is_solved_or_reports().map_err(|e| e.to_string())?;
    }
    Ok(())
}

/// Friction stops the block, and is then pulled by more than friction at rest and less than what it would rise to.
#[test]
fn what_friction_stops_is_held_by_what_it_rises_to() -> Outcome {
    for monolithic in [false, true] {
        let extreme = Extreme {
            dt: 0.005463970416606145,
            stiffness: 2602.6974332999753,
            mass: 0.0056206522844001,
            normal_stress: 4.924200782855141,
            velocity: 0.018662160671896143,
            slip_rate: 1.2278059335177813e-8,
            alpha: 480.36716616771525,
            slip_distance: 1.3104573556312644e-12,
            a: 7.833652026531618e-6,
            ratio: 2.0,
            ruina: false,
            closed: false,
            monolithic,
        };
        extreme.is_solved_or_reports().map_err(|e| e.to_string())?;
    }
    Ok(())
}

/// Slip rates of successive iterations from rest are `4e-24`, `5e-17`, `3e-13`, on to `1.4e-9` m/s: the first changes
/// are below the tolerance.
#[test]
fn a_slip_rate_that_grows_below_the_tolerance_is_no_fixed_point() -> Outcome {
    for monolithic in [false, true] {
        let extreme = Extreme {
            dt: 0.007213343132058205,
            stiffness: 258104970.63577,
            mass: 3150236239.041191,
            normal_stress: 7827675691.554287,
            velocity: 1.0,
            slip_rate: 0.0,
            alpha: -81.11228643750022,
            slip_distance: 1.0,
            a: 0.20475979106563996,
            ratio: 0.5,
            ruina: false,
            closed: false,
            monolithic,
        };
        extreme.is_solved_or_reports().map_err(|e| e.to_string())?;
    }
    Ok(())
}

type AnyLaw = Box<dyn StateLaw<State = LogTheta>>;

/// A law that does not tell its exact solution.
struct WithoutClosedForm(AnyLaw);

impl StateLaw for WithoutClosedForm {
    type State = LogTheta;
    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }
    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate)
    }
    fn advance(&self, from: LogTheta, rate: f64, dt: f64) -> Result<LogTheta, StateError> {
        self.0.advance(from, rate, dt)
    }
    fn advance_rate_slope(&self, from: LogTheta, to: LogTheta, rate: f64, dt: f64) -> f64 {
        self.0.advance_rate_slope(from, to, rate, dt)
    }
}

/// Two successive velocities of zero are no solution while the state is half way to one with which
/// the block would slide.
#[test]
fn a_fixed_point_between_two_cycles_is_not_accepted() -> Outcome {
    let friction = StateDependentTresca {
        reference_friction: 0.6,
        b: 0.015,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    let law = Ruina {
        slip_distance: 1e-5,
    };
    let body = slider(5e7, NORMAL_STRESS, 0.0, 2e-4);
    for monolithic in [false, true] {
        let parts = (friction, law, LogTheta(-10.0));
        let mut simulation = spring(&body, parts, 1e-6, monolithic)?;
        let result = simulation.step(1.5e-3);
        assert_eq!(result.is_ok(), monolithic);
        if let Err(failure) = result {
            assert!(matches!(failure.cause, StepError::NotCoupled { .. }));
            continue;
        }
        let at = simulation.snapshot();
        let left = 5e7 * (2e-4 * at.time - at.displacement[0][0]);
        let strength = NORMAL_STRESS * friction.coefficient(0.0, LogTheta(at.contact(0).state(0)));
        let slides = at.velocity[0][0] > 0.0;
        assert!(
            (left - strength).abs() < 1e-6 || (!slides && left <= strength),
            "{left} {strength}"
        );
    }
    Ok(())
}

/// The state `theta` eliminated under a law that reads its logarithm: Newton's slope has the factor
/// `1/theta`, without which the last digits are lost.
#[test]
fn an_eliminated_theta_is_balanced_to_rounding() -> Outcome {
    let friction = DieterichRuina {
        a: 1.0,
        b: 5.0,
        slip_distance: 1e-7,
        ..FRICTION
    };
    let body = slider(5e7, 1e12, 5e6, 0.0);
    let initial = Theta((-100.0_f64).exp());
    let mut simulation = spring(&body, (friction, Discontinuous, initial), 1.0, true)?;
    for _ in 0..6 {
        simulation.step(1e-3)?;
        let at = simulation.snapshot();
        let (v, a) = (at.velocity[0][0], at.acceleration[0][0]);
        let state = Theta(at.contact(0).state(0));
        let strength = 1e12 * friction.coefficient(v.abs(), state.into()).copysign(v);
        let left = -5e7 * at.displacement[0][0] - 5e6 * a;
        let terms = 1e12 * (5.0 * state.value().ln().abs() + 14.0) + 5e6 * a.abs();
        assert!(
            (left - strength).abs() <= 1e-13 * terms,
            "{left} {strength} {v}"
        );
    }
    Ok(())
}

/// At 1e10 m/s the tolerance lies below the rounding errors of the velocity.
#[test]
fn a_tolerance_below_rounding_is_not_waited_for() -> Outcome {
    let body = PippingSlider {
        refinements: 2,
        ..PippingSlider::default()
    };
    let space = body.space()?;
    let start = space.interpolate(|x| [if x[1] < 1.0 { 1e10 } else { 0.0 }, 0.0].into());
    let contact = Contact::new(&PippingSlider::bottom(&space)?, FRICTION, NORMAL_STRESS)
        .with_state(AGING, LogTheta(-10.0));
    let scene = body
        .scene(&space)?
        .with_contact(contact)
        .with_velocity(start);
    let solver = Tnnmg::new(space.transfers());
    let mut simulation = Simulation::new(scene, Newmark::default(), solver)?;
    for _ in 0..3 {
        assert!(simulation.step(1.5e-3)?.coupling_iterations < 20);
    }
    Ok(())
}

/// A state out of the range of its law is refused, not carried along.
#[test]
fn states_out_of_range_are_refused() {
    let body = slider(5e7, NORMAL_STRESS, 0.0, 2e-4);
    for theta in [-1.0, f64::NAN, f64::INFINITY] {
        let made = spring(&body, (FRICTION, Discontinuous, Theta(theta)), 1e-6, true);
        assert!(matches!(made.err(), Some(SceneError::State(_))), "{theta}");
    }
}
