//! The spring slider: one vertex, all laws, all ways to couple rate and state.

use nalgebra::{SMatrix, SVector};
use stickslip::friction::{
    DieterichRuina, FrictionLaw, Nodal, RegularizedDieterichRuina, StateDependentTresca,
};
use stickslip::problems::{LoadPath, SpringSlider};
use stickslip::state::{Dieterich, Discontinuous, LogTheta, Ruina, StateLaw, StateVariable, Theta};
use stickslip::{
    Adaptive, Failure, FixedPoint, Monolithic, Newmark, Point, RungeKutta, SceneError, Simulation,
    StateUpdate, Stepper,
};

use crate::case::{Case, Outcome, Verdict};
use crate::check::{Equations, Moment, march};

const SECTION: &str = "spring slider";
const STEPS: usize = 20;

/// Everything that is a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Setup {
    pub(crate) dt: f64,
    pub(crate) slip_rate: f64,
    pub(crate) alpha: f64,
    pub(crate) slip_distance: f64,
    pub(crate) a: f64,
    /// `b/a`.
    pub(crate) ratio: f64,
    pub(crate) normal_stress: f64,
    pub(crate) mass: f64,
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
    /// Of the load point.
    pub(crate) velocity: f64,
}

/// The numbers of the paper's slider, per area.
pub(crate) const PAPER: Setup = Setup {
    dt: 1.5e-3,
    slip_rate: 1e-6,
    alpha: -10.0,
    slip_distance: 1e-5,
    a: 1e-2,
    ratio: 1.5,
    normal_stress: 49_050.0,
    mass: 5e3,
    stiffness: 5e7,
    damping: 0.0,
    velocity: 2e-4,
};

const DT: [f64; 7] = [1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6];
const SLIP_RATE: [f64; 8] = [0.0, 5e-324, 1e-300, 1e-20, 1e-10, 1.0, 1e5, 1e10];
const ALPHA: [f64; 8] = [-800.0, -300.0, -100.0, -10.0, 10.0, 100.0, 300.0, 800.0];
const SLIP_DISTANCE: [f64; 6] = [1e-12, 1e-9, 1e-7, 1e-5, 1e-2, 1.0];
const A: [f64; 4] = [1e-6, 1e-4, 1e-2, 1.0];
const RATIO: [f64; 6] = [0.0, 0.5, 1.5, 2.0, 5.0, 150.0];
const NORMAL_STRESS: [f64; 4] = [0.0, 1.0, 49_050.0, 1e12];
const MASS: [f64; 5] = [0.0, 5e-3, 5.0, 5e6, 5e9];
const STIFFNESS: [f64; 5] = [1.0, 1e3, 5e7, 1e9, 1e12];

/// How rate and state are coupled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    FixedPoint,
    Monolithic,
}

/// The couplings and state updates.
pub(crate) const METHODS: [(Method, StateUpdate, &str); 4] = [
    (
        Method::FixedPoint,
        StateUpdate::BackwardEuler,
        "fixed point",
    ),
    (
        Method::FixedPoint,
        StateUpdate::Midpoint,
        "fixed point, midpoint",
    ),
    (Method::Monolithic, StateUpdate::BackwardEuler, "monolithic"),
    (
        Method::Monolithic,
        StateUpdate::Midpoint,
        "monolithic, midpoint",
    ),
];

/// The three friction laws that read a state.
pub(crate) fn friction(
    a: f64,
    ratio: f64,
    slip_distance: f64,
) -> (
    DieterichRuina,
    RegularizedDieterichRuina,
    StateDependentTresca,
) {
    let (b, reference_friction, reference_velocity) = (ratio * a, 0.6, 1e-6);
    (
        DieterichRuina {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        },
        RegularizedDieterichRuina {
            a,
            b,
            reference_friction,
            reference_velocity,
            slip_distance,
        },
        StateDependentTresca {
            reference_friction,
            b,
            reference_velocity,
            slip_distance,
        },
    )
}

/// The paper's setup with one number of every list after the other in its place.
fn one_at_a_time() -> Vec<(String, Setup)> {
    let mut all = vec![("none".to_string(), PAPER)];
    type Field = fn(&mut Setup) -> &mut f64;
    let lists: [(&str, &str, Field, &[f64]); 9] = [
        ("tau", "s", |s| &mut s.dt, &DT),
        ("V(0)", "m/s", |s| &mut s.slip_rate, &SLIP_RATE),
        ("alpha(0)", "", |s| &mut s.alpha, &ALPHA),
        ("L", "m", |s| &mut s.slip_distance, &SLIP_DISTANCE),
        ("a", "", |s| &mut s.a, &A),
        ("b/a", "", |s| &mut s.ratio, &RATIO),
        ("sigma_n", "Pa", |s| &mut s.normal_stress, &NORMAL_STRESS),
        ("m", "kg/m^2", |s| &mut s.mass, &MASS),
        ("K", "Pa/m", |s| &mut s.stiffness, &STIFFNESS),
    ];
    for (name, unit, field, values) in lists {
        for &value in values {
            let mut setup = PAPER;
            *field(&mut setup) = value;
            all.push((
                format!("{name} = {value:e} {unit}").trim_end().to_string(),
                setup,
            ));
        }
    }
    all
}

/// Pseudorandom numbers, always the same (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom
/// number generators", OOPSLA 2014).
pub(crate) struct Draws(pub(crate) u64);

impl Draws {
    fn of(&mut self, values: &[f64]) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        values[((z ^ (z >> 31)) % values.len() as u64) as usize]
    }

    fn setup(&mut self) -> Setup {
        Setup {
            dt: self.of(&DT),
            slip_rate: self.of(&SLIP_RATE),
            alpha: self.of(&ALPHA),
            slip_distance: self.of(&SLIP_DISTANCE),
            a: self.of(&A),
            ratio: self.of(&RATIO),
            normal_stress: self.of(&NORMAL_STRESS),
            mass: self.of(&MASS),
            stiffness: self.of(&STIFFNESS),
            damping: self.of(&[0.0, 5e6]),
            velocity: self.of(&[0.0, 1e-9, 2e-4, 1.0]),
        }
    }
}

pub(crate) fn cases(quick: bool) -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, setup) in one_at_a_time() {
        add(&mut cases, &name, "", setup, quick);
    }
    let mut draws = Draws(1);
    for n in 0..if quick { 20 } else { 300 } {
        add(
            &mut cases,
            "all at once",
            &format!("draw {n}, "),
            draws.setup(),
            quick,
        );
    }
    explicit(&mut cases, quick);
    cases
}

/// All laws and methods for a setup.
fn add(cases: &mut Vec<Case>, name: &str, prefix: &str, setup: Setup, quick: bool) {
    for (method, update, label) in METHODS {
        let (cut_off, regularised, with_state) =
            friction(setup.a, setup.ratio, setup.slip_distance);
        let slip_distance = setup.slip_distance;
        let (alpha, theta) = (LogTheta(setup.alpha), Theta(setup.alpha.exp()));
        macro_rules! case {
            ($member:expr, $friction:expr, $law:expr, $initial:expr) => {
                let run = move || step(&setup, method, update, $friction, $law, $initial);
                cases.push(Case::new(
                    SECTION,
                    name,
                    label,
                    format!("{prefix}{}", $member),
                    run,
                ));
            };
        }
        case!(
            "Dieterich, cut off",
            cut_off,
            Dieterich { slip_distance },
            alpha
        );
        case!("Ruina, cut off", cut_off, Ruina { slip_distance }, alpha);
        case!("discontinuous, cut off", cut_off, Discontinuous, theta);
        if !quick {
            case!(
                "Dieterich, regularised",
                regularised,
                Dieterich { slip_distance },
                alpha
            );
            case!(
                "Ruina, regularised",
                regularised,
                Ruina { slip_distance },
                alpha
            );
            case!(
                "discontinuous, regularised",
                regularised,
                Discontinuous,
                theta
            );
            case!(
                "Dieterich, Tresca with state",
                with_state,
                Dieterich { slip_distance },
                alpha
            );
            case!(
                "Ruina, Tresca with state",
                with_state,
                Ruina { slip_distance },
                alpha
            );
            case!(
                "discontinuous, Tresca with state",
                with_state,
                Discontinuous,
                theta
            );
        }
    }
}

fn slider(setup: &Setup) -> SpringSlider {
    SpringSlider {
        stiffness: setup.stiffness,
        normal_stress: setup.normal_stress,
        mass: setup.mass,
        damping: setup.damping,
        load: LoadPath::steady(setup.velocity),
    }
}

pub(crate) fn simulation<L, S>(
    setup: &Setup,
    (method, update): (Method, StateUpdate),
    friction: L,
    law: S,
    initial: S::State,
) -> Result<Simulation<SMatrix<f64, 1, 1>, L, S, Newmark, 1>, SceneError>
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let scene = slider(setup).scene(friction, law, setup.slip_rate, initial)?;
    let simulation = Simulation::new(scene, Newmark::default(), Point)?.with_state_update(update);
    Ok(match method {
        Method::FixedPoint => simulation.with_coupling(FixedPoint::default()),
        Method::Monolithic => simulation.with_coupling(Monolithic::default()),
    })
}

pub(crate) fn equations<L: FrictionLaw, S: StateLaw>(
    setup: &Setup,
    update: StateUpdate,
    friction: L,
    law: S,
) -> Equations<SMatrix<f64, 1, 1>, L, S, 1> {
    let matrix = |value: f64| SMatrix::<f64, 1, 1>::new(value);
    let some = |value: f64| (value > 0.0).then(|| matrix(value));
    let (stiffness, velocity) = (setup.stiffness, setup.velocity);
    let norm = setup.stiffness + setup.mass;
    Equations {
        stiffness: matrix(stiffness),
        mass: some(setup.mass),
        viscosity: some(setup.damping),
        moduli: [some(stiffness), some(setup.mass), some(setup.damping)],
        load: Box::new(move |time| vec![SVector::from([stiffness * velocity * time])]),
        friction: Nodal::Uniform(friction),
        law: Nodal::Uniform(law),
        normal_stress: Nodal::Uniform(setup.normal_stress),
        vertices: vec![0],
        weights: vec![1.0],
        fixed: vec![[false]],
        update,
        tolerance: 1e-10,
        norm: matrix(norm),
        compliance: norm.recip(),
    }
}

fn step<L, S>(
    setup: &Setup,
    method: Method,
    update: StateUpdate,
    friction: L,
    law: S,
    initial: S::State,
) -> Verdict
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let mut simulation = match simulation(setup, (method, update), friction, law, initial) {
        Ok(simulation) => simulation,
        Err(error) => return Verdict::refused(error),
    };
    let equations = equations(setup, update, friction, law);
    march(&mut simulation, STEPS, setup.dt, &|from, to, dt| {
        equations.check(from, to, dt)
    })
}

/// Adaptive explicit integration where there is no mass.
fn explicit(cases: &mut Vec<Case>, quick: bool) {
    let setups = one_at_a_time()
        .into_iter()
        .filter(|(name, _)| !name.starts_with("m ="));
    for (name, setup) in setups {
        for damping in [0.0, 5e6] {
            let setup = Setup {
                mass: 0.0,
                damping,
                ..setup
            };
            let (cut_off, regularised, _) = friction(setup.a, setup.ratio, setup.slip_distance);
            let slip_distance = setup.slip_distance;
            let alpha = LogTheta(setup.alpha);
            let label = "explicit, adaptive";
            let member = |laws: &str| format!("{laws}, damping {damping:e} Pa s/m");
            cases.push(Case::new(
                SECTION,
                &name,
                label,
                member("Dieterich, cut off"),
                move || adapt(&setup, cut_off, Dieterich { slip_distance }, alpha),
            ));
            if !quick {
                cases.push(Case::new(
                    SECTION,
                    &name,
                    label,
                    member("Ruina, cut off"),
                    move || adapt(&setup, cut_off, Ruina { slip_distance }, alpha),
                ));
                cases.push(Case::new(
                    SECTION,
                    &name,
                    label,
                    member("Ruina, regularised"),
                    move || adapt(&setup, regularised, Ruina { slip_distance }, alpha),
                ));
            }
        }
    }
}

/// A run over twenty steps' time, with steps down to a ten thousandth of it.
fn adapt<L, S>(setup: &Setup, friction: L, law: S, initial: S::State) -> Verdict
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: From<S::State>,
{
    let scene = slider(setup).scene(friction, law, setup.slip_rate, initial);
    let mut stepper = match scene.and_then(RungeKutta::new) {
        Ok(stepper) => stepper,
        Err(error) => return Verdict::refused(error),
    };
    let end = STEPS as f64 * setup.dt;
    let mut wrong = None;
    let mut worst: f64 = 0.0;
    let mut observe = |at: stickslip::Snapshot<'_, 1>| {
        let (u, v) = (at.displacement[0][0], at.velocity[0][0]);
        let state = at.states.state(0);
        let rate = v.abs();
        let variable = S::State::from_value(state).into();
        let strength = setup.normal_stress * friction.coefficient(rate, variable);
        let pull = setup.stiffness * setup.velocity * at.time - setup.stiffness * u;
        let left = pull - setup.damping * v;
        let terms = setup.stiffness * (setup.velocity * at.time + u.abs())
            + setup.damping * rate
            + strength
            + setup.normal_stress
                * (friction.coefficient_state_slope(rate, variable).abs() * state.abs()
                    + rate
                        * friction.coefficient_slope(rate, variable).min(f64::MAX)
                        * (rate.max(f64::MIN_POSITIVE).ln().abs() + 60.0));
        let missing = if rate > f64::MIN_POSITIVE {
            (left - strength.copysign(v)).abs()
        } else {
            (left.abs() - setup.normal_stress * friction.coefficient(f64::MIN_POSITIVE, variable))
                .max(0.0)
        };
        let residual = missing / (16.0 * f64::EPSILON * terms + f64::MIN_POSITIVE);
        let finite = u.is_finite() && v.is_finite() && state.is_finite();
        if !(finite && residual <= 1.0) && wrong.is_none() {
            wrong = Some(format!(
                "step {}: v = {v:e}, state {state}, residual {residual:.2e} times what is allowed",
                at.step
            ));
        }
        worst = worst.max(residual);
    };
    let adaptive = Adaptive::new(1e-5).with_step_bounds(1e-4 * end, end);
    let result = adaptive.run(&mut stepper, end, &mut observe);
    let mut verdict = match (wrong, result) {
        (Some(text), _) => Verdict::new(Outcome::Defect, text),
        (None, Ok(report)) => {
            let mut verdict = Verdict::new(Outcome::Solved, "");
            verdict.iterations = (report.accepted + report.rejected + report.failed, 0);
            verdict
        }
        (None, Err(failure)) => go_on(&mut stepper, failure, end),
    };
    verdict.residual = worst;
    verdict
}

/// After a run that gave up: nothing is lost, and a small step may still be taken.
fn go_on<const C: usize>(stepper: &mut dyn Stepper<C>, failure: Failure, end: f64) -> Verdict {
    let mut verdict = Verdict::new(Outcome::Reported, failure);
    let before = Moment::of(&stepper.snapshot());
    for power in [6, 8, 10] {
        let size = end * 10f64.powi(-power);
        let taken = stepper.step(size).is_ok();
        let after = Moment::of(&stepper.snapshot());
        if taken && after.is_finite() {
            verdict.resumed = Some(size / end);
            break;
        }
        if taken || after != before {
            return Verdict::new(
                Outcome::Defect,
                "a failed step left its trace, or no numbers",
            );
        }
    }
    verdict
}
