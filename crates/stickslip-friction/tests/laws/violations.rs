//! The checks name what a broken law or potential breaks.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{
    ConvexPotential, DieterichRuina, FrictionError, FrictionLaw, FrictionViolation, Interval,
    LocalModel, Radial, RegularizedDieterichRuina, check_convex_potential, check_friction_law,
    sample_friction_law,
};
use stickslip_state::LogTheta;

/// The fault of a broken law.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Parameter,
    Negative,
    NotANumber,
    Infinite,
    Weakening,
    WeakensAbove,
    SlopeSign,
    SlopeNan,
    SlopeFactor,
    SlopePerLogarithm,
    TogetherCoefficient,
    TogetherSlope,
    StateSlopeSign,
    StateSlopeFactor,
    StateSlopeNan,
    StateSlopeMissing,
    Offset,
    Concave,
    PotentialNan,
    PotentialFactor,
    PotentialWithoutCutOff,
    PotentialLinear,
    PotentialZero,
    TogetherSlopeSign,
    Creeps,
    AlwaysCreeps,
    SlipRateFactor,
    SlipRateNan,
    IgnoresFriction,
    IgnoresViscosity,
}

struct Broken<T>(T, Fault);

impl<T: FrictionLaw<State = LogTheta>> FrictionLaw for Broken<T> {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let mu = self.0.coefficient(slip_rate, state);
        match self.1 {
            Fault::Negative => mu - 0.1,
            Fault::NotANumber if slip_rate == 0.0 => f64::NAN,
            Fault::Infinite if slip_rate > 1e8 => f64::INFINITY,
            Fault::Weakening => 1.0 / (1.0 + mu),
            Fault::WeakensAbove if slip_rate > 1.0 => mu - 0.02 * slip_rate.ln(),
            _ => mu,
        }
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let slope = self.0.coefficient_rate_slope(slip_rate, state);
        match self.1 {
            Fault::SlopeSign => -slope,
            Fault::SlopeNan if slip_rate == 0.0 => f64::NAN,
            Fault::SlopeFactor => 1.01 * slope,
            Fault::SlopePerLogarithm => slope * slip_rate,
            _ => slope,
        }
    }

    fn coefficient_and_rate_slope(&self, slip_rate: f64, state: LogTheta) -> (f64, f64) {
        let mu = self.coefficient(slip_rate, state);
        let slope = self.coefficient_rate_slope(slip_rate, state);
        match self.1 {
            Fault::TogetherCoefficient => (mu + 1e-9, slope),
            Fault::TogetherSlope => (mu, slope * (1.0 + 1e-9)),
            Fault::TogetherSlopeSign => (mu, -slope),
            _ => (mu, slope),
        }
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let potential = self.0.potential(slip_rate, state);
        match self.1 {
            Fault::Offset => potential + 1e-9,
            Fault::Concave => slip_rate.sqrt(),
            Fault::PotentialNan if slip_rate > 0.0 => f64::NAN,
            Fault::PotentialZero => 0.0,
            Fault::PotentialFactor => 1.0001 * potential,
            Fault::PotentialWithoutCutOff => potential + 1e-3 * slip_rate,
            Fault::PotentialLinear => slip_rate * self.0.coefficient(slip_rate, state),
            _ => potential,
        }
    }

    fn coefficient_state_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let slope = self.0.coefficient_state_slope(slip_rate, state);
        match self.1 {
            Fault::StateSlopeSign => -slope,
            Fault::StateSlopeFactor => 1.01 * slope,
            Fault::StateSlopeNan => f64::NAN,
            Fault::StateSlopeMissing => 0.0,
            _ => slope,
        }
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, state: LogTheta) -> f64 {
        let rate = self.0.slip_rate(viscosity, drive, state);
        match self.1 {
            Fault::Creeps if rate == 0.0 => 1e-200 * drive,
            Fault::AlwaysCreeps => rate + 1e-30,
            Fault::SlipRateFactor => rate * (1.0 + 1e-11),
            Fault::SlipRateNan if rate > 0.0 => f64::NAN,
            Fault::IgnoresFriction => drive / viscosity,
            Fault::IgnoresViscosity => self.0.slip_rate(1e-12, drive, state),
            _ => rate,
        }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        match self.1 {
            Fault::Parameter => FrictionError::check_positive("a", f64::NAN),
            _ => self.0.validate(),
        }
    }
}

const CUT_OFF: DieterichRuina = DieterichRuina {
    a: 0.01,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

const REGULARIZED: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.01,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

fn found<T: FrictionLaw<State = LogTheta>>(law: T, fault: Fault) -> FrictionViolation {
    // At the last one the contact sticks.
    let states = [-10.0, 2.0, 500.0].map(LogTheta);
    check_friction_law(&Broken(law, fault), &states).expect_err("a broken law")
}

macro_rules! rejected {
    ($($fault:ident => $violation:pat),* $(,)?) => {$(
        for violation in [found(CUT_OFF, Fault::$fault), found(REGULARIZED, Fault::$fault)] {
            println!("{:?}: {violation}", Fault::$fault);
            assert!(matches!(violation, $violation), "{:?}: {violation}", Fault::$fault);
        }
    )*};
}

#[test]
fn broken_laws_are_rejected_with_the_right_violation() {
    use FrictionViolation as V;
    rejected! {
        Parameter => V::Refused(FrictionError { what: "a", requirement: "finite and positive", .. }),
        Negative => V::Value { what: "coefficient", .. },
        NotANumber => V::Value { what: "coefficient", slip_rate: 0.0, .. },
        Infinite => V::Value { what: "coefficient", slip_rate: 1e10, .. },
        Weakening => V::CoefficientDecreases { .. },
        WeakensAbove => V::CoefficientDecreases { .. },
        SlopeSign => V::Value { what: "coefficient_rate_slope", .. },
        SlopeNan => V::Value { what: "coefficient_rate_slope", slip_rate: 0.0, .. },
        SlopeFactor => V::Differs { what: "coefficient_rate_slope", requirement: "the difference quotient", .. },
        SlopePerLogarithm => V::Differs { what: "coefficient_rate_slope", requirement: "the difference quotient", .. },
        TogetherCoefficient => V::Differs { what: "coefficient together", requirement: "that alone", .. },
        TogetherSlope => V::Differs { what: "coefficient_rate_slope together", requirement: "that alone", .. },
        StateSlopeSign => V::Differs { what: "coefficient_state_slope", requirement: "the difference quotient", .. },
        StateSlopeFactor => V::Differs { what: "coefficient_state_slope", requirement: "the difference quotient", .. },
        StateSlopeNan => V::Differs { what: "coefficient_state_slope", requirement: "the difference quotient", .. },
        StateSlopeMissing => V::Differs { what: "coefficient_state_slope", requirement: "the difference quotient", .. },
        Offset => V::Value { what: "potential", slip_rate: 0.0, .. },
        Concave => V::Differs { what: "potential", requirement: "at most the chord", .. },
        PotentialNan => V::Differs { what: "potential", requirement: "at most the chord", .. },
        PotentialFactor => V::Differs { what: "potential", requirement: "the integral", .. },
        PotentialWithoutCutOff => V::Differs { what: "potential", requirement: "the integral", .. },
        PotentialLinear => V::Differs { what: "potential", requirement: "the integral", .. },
        Creeps => V::SlipRate { expected: 0.0, .. },
        AlwaysCreeps => V::SlipRate { expected: 0.0, .. } ,
        SlipRateFactor => V::SlipRate { expected: f64::MIN_POSITIVE.., .. },
        SlipRateNan => V::SlipRate { expected: f64::MIN_POSITIVE.., .. },
        IgnoresViscosity => V::SlipRate { expected: f64::MIN_POSITIVE.., .. },
        IgnoresFriction => V::SlipRate { expected: f64::MIN_POSITIVE.., .. },
    }
    // What shows at rates that are met is quoted there, at its worst.
    assert!(matches!(
        found(CUT_OFF, Fault::WeakensAbove),
        V::CoefficientDecreases {
            slower: 1.0,
            faster: 1e2,
            ..
        }
    ));
    assert!(matches!(
        found(CUT_OFF, Fault::SlopeFactor),
        V::Differs {
            what: "coefficient_rate_slope",
            slip_rate: 1e-6,
            ..
        }
    ));
    // An offset is the larger share of the potential the smaller friction is, whatever comes first.
    let law = Broken(CUT_OFF, Fault::PotentialWithoutCutOff);
    assert!(matches!(
        check_friction_law(&law, &[500.0, -10.0, 2.0].map(LogTheta)),
        Err(V::Differs {
            what: "potential",
            requirement: "the integral",
            state: -10.0,
            slip_rate: 1e-6,
            ..
        })
    ));
    let (law, states) = (Broken(CUT_OFF, Fault::None), [-10.0, 2.0, 500.0]);
    assert_eq!(check_friction_law(&law, &states.map(LogTheta)), Ok(()));
    assert!(matches!(
        check_friction_law(&law, &[]),
        Err(V::Refused(FrictionError {
            what: "number of states to check the law at",
            value: 0.0,
            ..
        }))
    ));
}

/// The fault of a broken potential.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Flaw {
    ValueNan,
    Concave,
    Dented,
    WrongWay,
    TooSteep,
    SteepAtRest,
    IntervalNan,
    GradientSign,
    GradientFactor,
    GradientMissing,
    Skew,
    Indefinite,
    HessianNan,
    HessianFactor,
    HessianMissing,
    HessianAcross,
    Short,
    Free,
    Turned,
    AtRest,
    Flipped,
    Stretched,
    NanCorrection,
}

struct Flawed(Radial<DieterichRuina>, Flaw);

impl ConvexPotential<2> for Flawed {
    fn value(&self, v: &SVector<f64, 2>) -> f64 {
        let value = self.0.value(v);
        match self.1 {
            Flaw::ValueNan if v.norm() > 1e3 => f64::NAN,
            Flaw::Concave => -value,
            Flaw::Dented => value * (1.0 + 0.5 * (v[0].abs() / v.norm().max(1e-300))),
            _ => value,
        }
    }

    fn slope_along(&self, v: &SVector<f64, 2>, d: &SVector<f64, 2>) -> Interval {
        let Interval { lower, upper } = self.0.slope_along(v, d);
        match self.1 {
            Flaw::WrongWay => Interval {
                lower: upper + d.norm(),
                upper: lower,
            },
            Flaw::TooSteep => Interval {
                lower: 1.1 * lower,
                upper: 1.1 * upper,
            },
            Flaw::SteepAtRest => Interval {
                lower: lower - d.norm(),
                upper: upper + d.norm(),
            },
            Flaw::IntervalNan => Interval {
                lower,
                upper: f64::NAN,
            },
            _ => Interval { lower, upper },
        }
    }

    fn local_model(&self, v: &SVector<f64, 2>) -> LocalModel<2> {
        let mut model = self.0.local_model(v);
        let size = model.hessian.amax();
        match self.1 {
            Flaw::GradientSign => model.gradient = -model.gradient,
            Flaw::GradientFactor => model.gradient *= 1.0 + 1e-9,
            Flaw::GradientMissing => model.gradient = SVector::zeros(),
            Flaw::Skew => model.hessian[(0, 1)] += 1e-6 * size,
            Flaw::Indefinite => model.hessian -= SMatrix::identity() * (0.1 * size),
            Flaw::HessianNan => model.hessian[(0, 0)] = f64::NAN,
            Flaw::HessianFactor => model.hessian *= 1.1,
            Flaw::HessianMissing => model.hessian = SMatrix::zeros(),
            Flaw::HessianAcross if v.norm() > 0.0 => {
                let e = v / v.norm();
                model.hessian = e * e.transpose() * (e.dot(&(model.hessian * e)));
            }
            _ => {}
        }
        model
    }

    fn minimize(&self, block: &SMatrix<f64, 2, 2>, force: &SVector<f64, 2>) -> SVector<f64, 2> {
        let v: SVector<f64, 2> = self.0.minimize(block, force);
        match self.1 {
            Flaw::Short => v * (1.0 - 1e-9),
            Flaw::Free => block.cholesky().map_or(v, |factor| factor.solve(force)),
            Flaw::Turned => force * (v.norm() / force.norm()),
            Flaw::AtRest => SVector::zeros(),
            _ => v,
        }
    }

    fn keep_smooth(&self, v: &SVector<f64, 2>, d: &SVector<f64, 2>) -> SVector<f64, 2> {
        let kept = self.0.keep_smooth(v, d);
        match self.1 {
            Flaw::Flipped => -kept,
            Flaw::Stretched => d * 1.5,
            Flaw::NanCorrection => kept * f64::NAN,
            _ => kept,
        }
    }
}

fn flaw(flaw: Flaw) -> FrictionViolation {
    let potential = Radial {
        law: CUT_OFF,
        force: 100.0,
        state: LogTheta(2.0),
    };
    assert_eq!(
        check_convex_potential::<_, 2>(&potential, 1e-6, 60.0),
        Ok(())
    );
    check_convex_potential::<_, 2>(&Flawed(potential, flaw), 1e-6, 60.0).expect_err("a flaw")
}

#[test]
fn broken_potentials_are_rejected_with_the_right_violation() {
    use FrictionViolation as V;
    macro_rules! rejected {
        ($($flaw:ident => $violation:pat),* $(,)?) => {$(
            let violation = flaw(Flaw::$flaw);
            println!("{:?}: {violation}", Flaw::$flaw);
            assert!(matches!(violation, $violation), "{:?}: {violation}", Flaw::$flaw);
        )*};
    }
    rejected! {
        ValueNan => V::Potential { what: "value", .. },
        Concave => V::NotConvex { requirement: "at most the chord", .. },
        Dented => V::NotConvex { requirement: "at least the tangent", .. },
        WrongWay => V::Potential { what: "lower slope", .. },
        IntervalNan => V::Potential { what: "lower slope", .. },
        TooSteep => V::NotConvex { requirement: "at least the tangent", .. },
        SteepAtRest => V::NotConvex { requirement: "at least the tangent", .. },
        GradientSign => V::Potential { what: "slope of the gradient", .. },
        GradientFactor => V::Potential { what: "slope of the gradient", .. },
        GradientMissing => V::Potential { what: "slope of the gradient", .. },
        Skew => V::Potential { what: "asymmetry of the Hessian", .. },
        Indefinite => V::Potential { what: "eigenvalue of the Hessian", .. },
        HessianNan => V::Potential { what: "asymmetry of the Hessian", .. } | V::Potential { what: "eigenvalue of the Hessian", .. },
        HessianFactor => V::Potential { what: "entry of the Hessian", .. },
        HessianMissing => V::Potential { what: "entry of the Hessian", .. },
        HessianAcross => V::Potential { what: "entry of the Hessian", .. },
        Short => V::Minimizer { what: "force [N] outside of the subdifferential", .. },
        Free => V::Minimizer { what: "force [N] outside of the subdifferential", .. },
        Turned => V::Minimizer { what: "force [N] outside of the subdifferential", .. },
        AtRest => V::Minimizer { what: "force [N] outside of the subdifferential", .. },
        Flipped => V::Potential { what: "component of keep_smooth", .. },
        Stretched => V::Potential { what: "component of keep_smooth", .. },
        NanCorrection => V::Potential { what: "component of keep_smooth", .. },
    }
}

/// Lies about its slopes so that only the energies tell.
struct Liar(Radial<DieterichRuina>, f64);

impl ConvexPotential<1> for Liar {
    fn value(&self, v: &SVector<f64, 1>) -> f64 {
        self.0.value(v)
    }

    /// Beyond the samples of the other checks anything goes.
    fn slope_along(&self, v: &SVector<f64, 1>, d: &SVector<f64, 1>) -> Interval {
        let Interval { lower, upper } = self.0.slope_along(v, d);
        if v[0].abs() > 1e-30 && v[0].abs() < 1e-19 {
            return Interval {
                lower: f64::NEG_INFINITY,
                upper: f64::INFINITY,
            };
        }
        Interval { lower, upper }
    }

    fn local_model(&self, v: &SVector<f64, 1>) -> LocalModel<1> {
        self.0.local_model(v)
    }

    fn minimize(&self, _: &SMatrix<f64, 1, 1>, force: &SVector<f64, 1>) -> SVector<f64, 1> {
        SVector::from([self.1.copysign(force[0])])
    }
}

#[test]
fn energies_are_compared_too() {
    let potential = Radial {
        law: CUT_OFF,
        force: 100.0,
        state: LogTheta(2.0),
    };
    let violation = check_convex_potential(&Liar(potential, 1e-20), 1e-6, 60.0);
    assert!(
        matches!(
            violation,
            Err(FrictionViolation::Minimizer {
                what: "energy [W]",
                ..
            })
        ),
        "{violation:?}"
    );
}

/// `0.6 + 0.05 ln(V/V0)` down to 1e-60 m/s, negative below 6e-12 m/s.
struct Logarithm;

impl FrictionLaw for Logarithm {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        0.6 + 0.05 * (slip_rate.max(1e-60) / 1e-6).ln()
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        0.05 / slip_rate.max(1e-60)
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        0.55 * slip_rate + 0.05 * slip_rate * (slip_rate.max(1e-60) / 1e-6).ln()
    }
}

#[test]
fn a_realistic_slip_rate_is_named_first() {
    let found = sample_friction_law(&Logarithm, &[()]);
    assert!(
        matches!(found, Err(FrictionViolation::Value { what: "coefficient", slip_rate, .. }) if slip_rate == 1e-12),
        "{found:?}"
    );
}

/// The sampling of a law by a scene finds a wrong sign, power or unit of a slope, and a wrong potential, with numbers.
#[test]
fn a_sample_compares_slopes_and_potential_with_the_coefficient() {
    const LAW: DieterichRuina = DieterichRuina {
        a: 0.01,
        b: 0.015,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: 1e-5,
    };
    let sample = |fault| sample_friction_law(&Broken(LAW, fault), &[LogTheta(2.0)]);
    for (fault, what) in [
        (Fault::SlopePerLogarithm, "coefficient_rate_slope"),
        (Fault::StateSlopeSign, "coefficient_state_slope"),
        (Fault::StateSlopeMissing, "coefficient_state_slope"),
        (Fault::PotentialNan, "potential"),
        (Fault::PotentialZero, "potential"),
        (Fault::Concave, "potential"),
        (Fault::TogetherSlopeSign, "coefficient_rate_slope together"),
    ] {
        let found = sample(fault);
        assert!(
            matches!(found, Err(FrictionViolation::Differs { what: quoted, .. }) if quoted == what),
            "{fault:?}: {found:?}"
        );
    }
    // Rough, and no run goes astray by it.
    for fault in [Fault::None, Fault::SlopeFactor, Fault::StateSlopeFactor] {
        assert_eq!(sample(fault), Ok(()));
    }
    // P(V) = 0, where P(V) >= V mu(V/2)/2 = 1e-6 * 0.6 with a small direct effect.
    let Err(FrictionViolation::Differs {
        slip_rate,
        found,
        expected,
        ..
    }) = sample(Fault::PotentialZero)
    else {
        panic!("not refused");
    };
    let bound = 0.5 * slip_rate * LAW.coefficient(0.5 * slip_rate, LogTheta(2.0));
    assert!(
        found == 0.0 && (expected - bound).abs() <= 1e-15 * bound,
        "{expected:e}"
    );
}
