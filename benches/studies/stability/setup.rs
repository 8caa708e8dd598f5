//! The numbers of a case: those of the paper, one of them extreme, or all of them drawn.

use stickslip::friction::DieterichRuina;
use stickslip_cli::laws::{Friction, Law, Laws};
use stickslip_studies::Draws;

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

impl Setup {
    /// Laws with these numbers.
    pub(crate) fn laws(&self, law: Law, friction: Friction) -> Laws {
        Laws {
            law,
            friction,
            parameters: DieterichRuina {
                a: self.a,
                b: self.ratio * self.a,
                reference_friction: 0.6,
                reference_velocity: 1e-6,
                slip_distance: self.slip_distance,
            },
        }
    }
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

/// The paper's setup with one number of every list after the other in its place.
pub(crate) fn one_at_a_time() -> Vec<(String, Setup)> {
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

/// All of them drawn.
pub(crate) fn drawn(draws: &mut Draws) -> Setup {
    let mut of = |values: &[f64]| draws.one_of(values);
    Setup {
        dt: of(&DT),
        slip_rate: of(&SLIP_RATE),
        alpha: of(&ALPHA),
        slip_distance: of(&SLIP_DISTANCE),
        a: of(&A),
        ratio: of(&RATIO),
        normal_stress: of(&NORMAL_STRESS),
        mass: of(&MASS),
        stiffness: of(&STIFFNESS),
        damping: of(&[0.0, 5e6]),
        velocity: of(&[0.0, 1e-9, 2e-4, 1.0]),
    }
}
