//! The checks accept every law that keeps the contract and name what a broken one breaks.

use crate::common::PerrinRiceZheng;
use stickslip_state::{
    Dieterich, Discontinuous, LogTheta, Ruina, SlipWeakening, StateError, StateLaw,
    StateLawViolation, Theta, TimeWeakening, Weakening, check_state_law, sample_state_law,
};

fn log_states(values: &[f64]) -> Vec<LogTheta> {
    values.iter().copied().map(LogTheta).collect()
}

#[test]
fn our_laws_conform() {
    let ordinary = log_states(&[-20.0, -10.0, -1.0, 0.0, 1e-9, 2.0, 20.0]);
    let extreme = log_states(&[-800.0, -300.0, -40.0, 40.0, 300.0, 800.0]);
    for slip_distance in [1e-12, 1e-5, 1e-2, 1.0] {
        for states in [&ordinary, &extreme] {
            check_state_law(&Dieterich { slip_distance }, states).expect("Dieterich");
            check_state_law(&Ruina { slip_distance }, states).expect("Ruina");
        }
    }
    let times: Vec<Theta> = [0.0, 1e-12, 1e-5, 1.0, 1e3, 1e12].map(Theta).into();
    check_state_law(&Discontinuous, &times).expect("Discontinuous");
    let weakened: Vec<Weakening> = [0.0, 1e-12, 0.3, 1.0, 1e6].map(Weakening).into();
    let waiting: Vec<Weakening> = [-1e9, -3.0, 0.0, 0.5, 1e3].map(Weakening).into();
    for scale in [1e-12, 1e-5, 0.4, 1e3] {
        let slip = SlipWeakening {
            slip_distance: scale,
        };
        check_state_law(&slip, &weakened).expect("slip weakening");
        for time in [1e-6, 1.0, 1e9] {
            check_state_law(&slip.healing(time), &weakened).expect("healing");
        }
        check_state_law(&TimeWeakening { duration: scale }, &waiting).expect("time weakening");
    }
    check_state_law(&(), &[()]).expect("()");
}

#[test]
fn laws_behind_pointers_conform() {
    let law: Box<dyn StateLaw<State = LogTheta>> = Box::new(Dieterich {
        slip_distance: 1e-5,
    });
    check_state_law(&law, &log_states(&[-10.0, 0.0, 10.0])).expect("Dieterich");
    check_state_law(&*law, &log_states(&[-10.0, 0.0, 10.0])).expect("Dieterich");
    // The closed forms come through, to the last bit.
    let direct = Dieterich {
        slip_distance: 1e-5,
    };
    let (from, to) = (LogTheta(1.0), LogTheta(0.7));
    assert_eq!(
        law.advance_rate_slope(from, to, 1e-5, 0.3),
        direct.advance_rate_slope(from, to, 1e-5, 0.3)
    );
    assert_eq!(
        law.advance_at_constant_rate_rate_slope(from, to, 1e-5, 0.3),
        direct.advance_at_constant_rate_rate_slope(from, to, 1e-5, 0.3)
    );
    assert_eq!(
        law.advance_at_constant_rate(from, 1e-5, 0.3),
        direct.advance_at_constant_rate(from, 1e-5, 0.3)
    );
    let boxed: Box<dyn StateLaw<State = Theta>> = Box::new(Discontinuous);
    assert!(boxed.validate_state(Theta(-1.0)).is_err());
    assert_eq!(boxed.validate_state(Theta(0.0)), Ok(()));
}

#[test]
fn a_user_law_without_closed_forms_conforms() {
    for slip_distance in [1e-6, 1e-5, 1e-2] {
        let times = [1e-5, 1.0, 1e3].map(Theta);
        check_state_law(&PerrinRiceZheng { slip_distance }, &times).expect("Perrin, Rice, Zheng");
    }
}

/// The difference of a broken law from Dieterich's or Ruina's.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Parameter,
    NanAtRest,
    Unstable,
    SlopeSign,
    SlopeFactor,
    Explicit,
    WrongDecay,
    Infinite,
    Refuses,
    AcceptsNegative,
    MovesInNoTime,
    Reverses,
    StepSlopeSign,
    StepSlopeFactor,
    StepSlopeNan,
    ExactIsEuler,
    ExactForgetsHealing,
    ExactFactor,
    ExactOverflows,
    RateSlopeFactor,
}

struct Broken<T>(T, Fault);

impl<T: StateLaw<State = LogTheta>> StateLaw for Broken<T> {
    type State = LogTheta;

    fn evolution(&self, state: LogTheta, slip_rate: f64) -> f64 {
        match self.1 {
            Fault::NanAtRest if slip_rate == 0.0 => f64::NAN,
            Fault::Unstable if slip_rate > 1e-3 => {
                self.0.evolution(state, slip_rate) + 2e5 * slip_rate * state.0
            }
            _ => self.0.evolution(state, slip_rate),
        }
    }

    fn evolution_state_slope(&self, state: LogTheta, slip_rate: f64) -> f64 {
        let slope = self.0.evolution_state_slope(state, slip_rate);
        match self.1 {
            Fault::SlopeSign => -slope,
            Fault::SlopeFactor => 1.1 * slope,
            _ => slope,
        }
    }

    fn advance(&self, from: LogTheta, slip_rate: f64, dt: f64) -> Result<LogTheta, StateError> {
        let to = match self.1 {
            Fault::AcceptsNegative => self.0.advance(from, slip_rate.abs(), dt)?,
            _ => self.0.advance(from, slip_rate, dt)?,
        };
        Ok(match self.1 {
            Fault::Explicit => LogTheta(from.0 + dt * self.0.evolution(from, slip_rate)),
            Fault::WrongDecay => LogTheta(to.0 + 1e-9 * (to.0 - from.0)),
            Fault::Infinite if slip_rate > 1e5 && dt > 0.0 => LogTheta(f64::NEG_INFINITY),
            Fault::Refuses if slip_rate == 0.0 => {
                return StateError::check("slip rate", "", slip_rate, false).map(|()| to);
            }
            Fault::Reverses if dt > 0.0 => LogTheta(-from.0),
            Fault::MovesInNoTime if dt == 0.0 => LogTheta(from.0 + 1e-15),
            _ => to,
        })
    }

    fn advance_exact(&self, from: LogTheta, slip_rate: f64, dt: f64) -> Option<LogTheta> {
        let to = self.0.advance_exact(from, slip_rate, dt)?;
        Some(match self.1 {
            Fault::ExactIsEuler => self.0.advance(from, slip_rate, dt).ok()?,
            // Composes, but belongs to another equation.
            Fault::ExactForgetsHealing => LogTheta(from.0 - dt * slip_rate / 1e-5),
            Fault::ExactFactor => self.0.advance_exact(from, slip_rate, 1.01 * dt)?,
            Fault::ExactOverflows if dt > 1e3 => LogTheta(f64::NAN),
            _ => to,
        })
    }

    fn advance_rate_slope(&self, from: LogTheta, to: LogTheta, slip_rate: f64, dt: f64) -> f64 {
        let slope = self.0.advance_rate_slope(from, to, slip_rate, dt);
        match self.1 {
            Fault::StepSlopeSign => -slope,
            Fault::StepSlopeFactor => 1.01 * slope,
            Fault::StepSlopeNan if slip_rate == 0.0 => f64::NAN,
            _ => slope,
        }
    }

    fn advance_at_constant_rate_rate_slope(
        &self,
        from: LogTheta,
        to: LogTheta,
        slip_rate: f64,
        dt: f64,
    ) -> f64 {
        let slope = self
            .0
            .advance_at_constant_rate_rate_slope(from, to, slip_rate, dt);
        if self.1 == Fault::RateSlopeFactor {
            0.99 * slope
        } else {
            slope
        }
    }

    fn validate(&self) -> Result<(), StateError> {
        match self.1 {
            Fault::Parameter => StateError::check_positive("slip_distance", -1.0),
            _ => self.0.validate(),
        }
    }
}

fn found<T: StateLaw<State = LogTheta>>(law: T, fault: Fault) -> StateLawViolation {
    let states = log_states(&[-10.0, -3.0, 0.0, 5.0, 12.0]);
    check_state_law(&Broken(law, fault), &states).expect_err("a broken law")
}

macro_rules! rejected {
    ($($fault:ident => $violation:pat),* $(,)?) => {$(
        for violation in [found(Dieterich { slip_distance: 1e-5 }, Fault::$fault), found(Ruina { slip_distance: 1e-5 }, Fault::$fault)] {
            println!("{:?}: {violation}", Fault::$fault);
            assert!(matches!(violation, $violation), "{:?}: {violation}", Fault::$fault);
            assert!(!violation.to_string().is_empty());
        }
    )*};
}

#[test]
fn broken_laws_are_rejected_with_the_right_violation() {
    use StateLawViolation as V;
    rejected! {
        Parameter => V::Refused(StateError::Value { what: "slip_distance", value: -1.0, .. }),
        NanAtRest => V::EvolutionNotANumber { slip_rate: 0.0, .. },
        Unstable => V::EvolutionIncreases { slip_rate: 1e-3..=130.0, .. },
        SlopeSign => V::Slope { requirement: "at most", bound: 0.0, .. },
        SlopeFactor => V::Slope { requirement: "the difference quotient", .. },
        Explicit => V::Step { property: "backward Euler", .. } | V::Step { property: "state after no time", .. },
        WrongDecay => V::Step { property: "backward Euler", .. },
        Infinite => V::NotFinite { .. },
        Refuses => V::Refused(StateError::Value { what: "slip rate", value: 0.0, .. }),
        AcceptsNegative => V::Accepts { .. },
        MovesInNoTime => V::Step { property: "state after no time", .. },
        Reverses => V::Order { .. },
        StepSlopeSign => V::Step { property: "advance_rate_slope", .. },
        StepSlopeFactor => V::Step { property: "advance_rate_slope", .. },
        StepSlopeNan => V::Step { property: "advance_rate_slope", .. },
        ExactIsEuler => V::Step { property: "composition of exact steps", .. } | V::Step { property: "change by evolution", .. },
        ExactOverflows => V::NotFinite { .. },
        RateSlopeFactor => V::Step { property: "advance_at_constant_rate_rate_slope", .. },
    }
    // The error is a share of the change of the state: it shows over a microsecond, and is worst over long times.
    let aging = Dieterich {
        slip_distance: 1e-5,
    };
    let V::Step {
        property: "backward Euler",
        step,
        ..
    } = found(aging, Fault::WrongDecay)
    else {
        panic!("a wrong decay");
    };
    assert!(
        (1e-6..10.0).contains(&step.slip_rate) && step.dt >= 1.0,
        "{step}"
    );
}

#[test]
fn nothing_is_wrong_with_the_intact_law() {
    let states = log_states(&[-10.0, -3.0, 0.0, 5.0, 12.0]);
    for result in [
        check_state_law(
            &Broken(
                Dieterich {
                    slip_distance: 1e-5,
                },
                Fault::None,
            ),
            &states,
        ),
        check_state_law(
            &Broken(
                Ruina {
                    slip_distance: 1e-5,
                },
                Fault::None,
            ),
            &states,
        ),
    ] {
        assert_eq!(result, Ok(()));
    }
}

#[test]
fn wrong_solutions_are_rejected_although_they_compose() {
    for fault in [Fault::ExactForgetsHealing, Fault::ExactFactor] {
        let law = Dieterich {
            slip_distance: 1e-5,
        };
        let violation = found(law, fault);
        assert!(
            matches!(
                violation,
                StateLawViolation::Step {
                    property: "change by evolution",
                    ..
                } | StateLawViolation::Step {
                    property: "limit of small steps",
                    ..
                }
            ),
            "{violation}"
        );
    }
}

#[test]
fn states_out_of_range_and_missing_states_are_rejected() {
    let refused = |states: &[Theta]| match check_state_law(&Discontinuous, states) {
        Err(StateLawViolation::Refused(StateError::Value { what, value, .. })) => (what, value),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(&[Theta(-1.0)]), ("state theta [s]", -1.0));
    let (what, value) = refused(&[Theta(f64::NAN)]);
    assert!(what == "state" && value.is_nan());
    assert_eq!(refused(&[]), ("number of states to check the law at", 0.0));
}

/// The sampling of a law by a scene finds a slope of the wrong sign or size, with numbers.
#[test]
fn a_sample_compares_the_slope_with_the_evolution() {
    let sample = |fault| {
        let law = Dieterich {
            slip_distance: 1e-5,
        };
        sample_state_law(&Broken(law, fault), &[LogTheta(-3.0)])
    };
    assert_eq!(sample(Fault::None), Ok(()));
    let Err(StateLawViolation::Slope {
        state,
        slope,
        bound,
        ..
    }) = sample(Fault::SlopeSign)
    else {
        panic!("not refused");
    };
    // dg/dalpha = -e^-alpha of the aging law, at any slip rate.
    let exact = -3f64.exp();
    assert_eq!(state, -3.0);
    assert!((slope / exact + 1.0).abs() < 1e-12 && (bound / exact - 1.0).abs() < 1e-6);
}
