//! The laws and the local problems: their contracts at extreme parameters, and the forces left
//! over.

use nalgebra::{SMatrix, SVector};
use stickslip::friction::{
    ConvexPotential, FrictionLaw, Radial, Tresca, check_convex_potential, check_friction_law,
};
use stickslip::state::{
    Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, StateVariable, Theta, check_state_law,
};
use stickslip_cli::laws::Law;

use crate::case::{Case, IntoControlFlow, Outcome};
use crate::method::{AnyFriction, FRICTIONS};
use crate::setup::{PAPER, Setup};

/// The part of the report.
pub(crate) const SECTION: &str = "laws and local problems";

/// Slip rates \[m/s\].
const SLIP_RATES: [f64; 12] = [
    0.0, 5e-324, 1e-310, 1e-300, 1e-100, 1e-20, 1e-12, 1e-6, 1e-2, 1.0, 1e5, 1e10,
];
/// Initial states `ln(theta / 1 s)`.
const ALPHAS: [f64; 9] = [-800.0, -300.0, -50.0, -10.0, 0.0, 10.0, 50.0, 300.0, 800.0];
/// Initial states `theta` \[s\].
const THETAS: [f64; 8] = [0.0, 1.7e-300, 1.7e-20, 1.7e-4, 1.7, 1.7e6, 1.7e20, 1.7e300];

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    state_laws(&mut cases, quick);
    friction_laws(&mut cases, quick);
    local_problems(&mut cases);
    cases
}

fn state_laws(cases: &mut Vec<Case>, quick: bool) {
    let mut add =
        |extreme: String, law: &str, check: Box<dyn FnOnce() -> IntoControlFlow + Send>| {
            cases.push(Case::new(
                SECTION,
                extreme,
                "steps of the state",
                law,
                check,
            ));
        };
    let lengths: &[f64] = if quick {
        &[1e-12, 1.0]
    } else {
        &[1e-12, 1e-9, 1e-5, 1e-2, 1.0]
    };
    let states = ALPHAS.map(LogTheta);
    for &slip_distance in lengths {
        let label = format!("L = {slip_distance:e} m");
        let aging = move || state_law(&Dieterich { slip_distance }, &states);
        let slip = move || state_law(&Ruina { slip_distance }, &states);
        add(label.clone(), "Dieterich", Box::new(aging));
        add(label, "Ruina", Box::new(slip));
    }
    let discontinuous = || state_law(&Discontinuous, &THETAS.map(Theta));
    let label = "theta from 0 to 1e300 s".to_string();
    add(label, "discontinuous", Box::new(discontinuous));
}

fn friction_laws(cases: &mut Vec<Case>, quick: bool) {
    let direct: &[f64] = if quick {
        &[1e-6, 1e-2]
    } else {
        &[1e-6, 1e-4, 1e-2, 1.0]
    };
    for &a in direct {
        for ratio in [0.0, 0.5, 1.5, 2.0, 5.0, 150.0] {
            for slip_distance in [1e-12, 1e-5, 1.0] {
                let label = format!("a = {a:e}, b/a = {ratio}");
                let setup = Setup {
                    a,
                    ratio,
                    slip_distance,
                    ..PAPER
                };
                for (friction, name) in FRICTIONS {
                    let member = format!("{name}, L = {slip_distance:e} m");
                    cases.push(Case::new(SECTION, &label, "friction", member, move || {
                        friction_law(&setup.laws(Law::Dieterich, friction).friction())
                    }));
                }
            }
        }
    }
    let label = "coefficient 0, 0.6, 1e12";
    cases.push(Case::new(SECTION, label, "friction", "Tresca", tresca));
}

fn local_problems(cases: &mut Vec<Case>) {
    for force in [0.0, 1.0, 1e12] {
        for alpha in ALPHAS {
            let label = format!("normal force {force:e} N");
            for (friction, name) in FRICTIONS {
                let member = format!("{name}, alpha = {alpha}");
                let law = PAPER.laws(Law::Dieterich, friction).friction();
                cases.push(Case::new(
                    SECTION,
                    &label,
                    "local problems",
                    member,
                    move || local(law, force, alpha),
                ));
            }
        }
    }
}

fn tresca() -> IntoControlFlow {
    for coefficient in [0.0, 0.6, 1e12] {
        if let Err(violation) = check_friction_law(&Tresca { coefficient }, &[()]) {
            return IntoControlFlow::new(Outcome::Defect, violation);
        }
    }
    IntoControlFlow::of_residual(0.0)
}

fn state_law<S: StateLaw>(law: &S, states: &[S::State]) -> IntoControlFlow {
    match check_state_law(law, states) {
        Ok(()) => IntoControlFlow::of_residual(0.0),
        Err(violation) => IntoControlFlow::new(Outcome::Defect, violation),
    }
}

fn friction_law(law: &AnyFriction) -> IntoControlFlow {
    match check_friction_law(law, &ALPHAS.map(LogTheta)) {
        Ok(()) => IntoControlFlow::of_residual(0.0),
        Err(violation) => IntoControlFlow::new(Outcome::Defect, violation),
    }
}

/// The contract of the vector problem, and the forces left over at all speeds and stiffnesses.
fn local(law: AnyFriction, force: f64, alpha: f64) -> IntoControlFlow {
    let potential = Radial {
        law,
        force,
        state: LogTheta(alpha),
    };
    let pull = if force > 0.0 { 0.6 * force } else { 1.0 };
    // That check knows nothing of the terms inside: where a coefficient near 0 is the difference of
    // logarithms of hundreds, it takes their roundings for errors.
    let speeds: &[f64] = if alpha.abs() < 300.0 {
        &[1e-20, 1e-6, 1.0]
    } else {
        &[]
    };
    for &speed in speeds {
        let checked = check_convex_potential::<_, 1>(&potential, speed, pull)
            .and_then(|()| check_convex_potential::<_, 2>(&potential, speed, pull))
            .and_then(|()| check_convex_potential::<_, 3>(&potential, speed, pull));
        if let Err(violation) = checked {
            return IntoControlFlow::new(Outcome::Defect, violation);
        }
    }
    let mut worst: f64 = 0.0;
    for stiffness in [1e-12, 1e-6, 1.0, 1e6, 1e12, 1e20] {
        let block = SMatrix::<f64, 2, 2>::new(3.0, 1.0, 1.0, 2.0) * stiffness;
        for rate in SLIP_RATES {
            // The force that makes it slide at this rate, and half of it.
            let direction = SVector::from([0.6, 0.8]);
            let balance = block * direction * rate
                + direction * (force * potential.law.coefficient(rate, potential.state));
            for force in [balance, balance * 0.5] {
                let v = potential.minimize(&block, &force);
                let share = roundings(&potential, &block, &force, &v) / 4.0;
                if share.is_nan() || share > worst {
                    worst = share;
                }
            }
        }
    }
    IntoControlFlow::of_residual(worst)
}

/// The force left over, in roundings of the terms that meet.
fn roundings(
    potential: &Radial<AnyFriction>,
    block: &SMatrix<f64, 2, 2>,
    force: &SVector<f64, 2>,
    v: &SVector<f64, 2>,
) -> f64 {
    // Not through squares, which underflow.
    let length = |v: &SVector<f64, 2>| v[0].hypot(v[1]);
    let (speed, law, state) = (length(v), &potential.law, potential.state);
    if !speed.is_finite() {
        return f64::INFINITY;
    }
    let friction = |speed: f64| potential.force * law.coefficient(speed, state);
    let left = block * v - force;
    // On a kink the terms are those just above.
    let above = speed.max(f64::MIN_POSITIVE) * (1.0 + 1e-9);
    let slope = law.coefficient_rate_slope(above, state).min(f64::MAX);
    let by_rate = slope * above * (above.ln().abs() + 30.0);
    let by_state = law.coefficient_state_slope(above, state) * state.value().abs();
    let size = length(force)
        + block.norm() * speed
        + friction(speed)
        + potential.force * (by_rate + by_state);
    // Speeds below the normal numbers are spaced by the smallest, and so are their directions; a
    // coefficient below the normal numbers is none.
    let turning = friction(speed) / speed.max(f64::MIN_POSITIVE);
    let smallest = f64::from_bits(1) * (block.norm() + potential.force * slope + turning + 1.0)
        + f64::MIN_POSITIVE * potential.force;
    let unit = f64::EPSILON * size + smallest;
    if speed == 0.0 {
        let least = friction(f64::MIN_POSITIVE) + block.norm() * f64::MIN_POSITIVE;
        return (length(&left) - least).max(0.0) / unit;
    }
    length(&(left + v / speed * friction(speed))) / unit
}
