//! Linear stability of steady sliding with dilatancy and drainage.

use nalgebra::{Matrix1, Vector1};
use stickslip::fields::{Diffusion, Dilatancy, Hydraulics, LeakOff, Line};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};

use crate::Outcome;

const LENGTH: f64 = 8e-3;
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: LENGTH,
};
const NORMAL_STRESS: f64 = 50e6;
const VELOCITY: f64 = 1e-6;
/// The storage [1/Pa].
const STORAGE: f64 = 5e-10;

/// `c L/V`, and the critical stiffness [Pa/m] for `eps/beta` of .2 and .1 MPa: the zero of the real part of the cubic
/// `K^2 V^2 (x + c) + K V (B c + (x + c)(B + A c + E) - A x c) + B c (B + A c + E)`, with `x = V/L`, `A = a sigma`,
/// `B = (a - b) sigma x`, `E = f eps/beta x` (P. Segall, J. Rice, J. Geophys. Res. 100 (1995)).
const CRITICAL: [(f64, [f64; 2]); 6] = [
    (1e-3, [1.62500577e7, 2.37500197e7]),
    (1e-2, [1.62558186e7, 2.37519792e7]),
    (1e-1, [1.68352507e7, 2.39466128e7]),
    (1.0, [2.71965828e7, 2.90018796e7]),
    (10.0, [3.11772743e7, 3.12131680e7]),
    (100.0, [3.12492519e7, 3.12496255e7]),
];

/// A patch that drains through a membrane.
fn drained(coefficient: f64, drainage_time: f64) -> Outcome<Diffusion> {
    let zone = Hydraulics {
        permeability: 0.0.into(),
        viscosity: 1e-3.into(),
        storage: STORAGE.into(),
        thickness: 1.0.into(),
    };
    let dilatancy = Dilatancy {
        coefficient,
        reference_velocity: VELOCITY,
        slip_distance: LENGTH,
        initial_change: 0.0,
    };
    let leak_off = LeakOff {
        drainage_time: drainage_time.into(),
        far_pressure: 0.0.into(),
    };
    Ok(Diffusion::new(Line::uniform([0.0, 1.0], 1)?, &zone)?
        .with_dilatancy(dilatancy)?
        .with_leak_off(&leak_off)?)
}

/// The growth of the swings of `ln V` from one window of 500 `L/V` to one 1000 later, from a start by `away` off.
fn growth(stiffness: f64, field: Diffusion, away: f64) -> Outcome<f64> {
    let state = LogTheta((LENGTH / VELOCITY).ln());
    let steady = LAW.coefficient(VELOCITY * (1.0 + away), state);
    let contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL_STRESS)
        .with_state(
            Dieterich {
                slip_distance: LENGTH,
            },
            state,
        )
        .with_shear_stress(Vector1::new(steady * NORMAL_STRESS))
        .with_field(field);
    let scene = Scene::new(Matrix1::new(stiffness))
        .with_contact(contact)
        .with_load_history(move |time, load| load[0][0] = stiffness * VELOCITY * time);
    let mut patch = RungeKutta::new(scene)?;
    let unit = LENGTH / VELOCITY;
    let mut swings = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    patch.run(&Steps::adaptive(1e-9).until(2000.0 * unit), |at| {
        let rate = (at.contact(0).slip_rate(0) / VELOCITY).ln();
        for (window, [low, high]) in swings.iter_mut().enumerate() {
            let begin = (500 + 1000 * window) as f64 * unit;
            if at.time > begin && at.time < begin + 500.0 * unit {
                (*low, *high) = (low.min(rate), high.max(rate));
            }
        }
    })?;
    let [before, after] = swings.map(|[low, high]| high - low);
    Ok(after / before)
}

#[test]
fn the_critical_stiffness_is_that_of_linear_theory() -> Outcome {
    for (drainage, critical) in CRITICAL {
        for (share, critical) in [2e5, 1e5].into_iter().zip(critical) {
            let time = LENGTH / VELOCITY / drainage;
            let field = || drained(share * STORAGE, time);
            let [soft, stiff] = [0.999, 1.001].map(|factor| factor * critical);
            let [grows, decays] = [
                growth(soft, field()?, 1e-4)?,
                growth(stiff, field()?, 1e-4)?,
            ];
            assert!(
                grows > 1.0 && decays < 1.0,
                "{drainage} {share}: {grows} {decays}"
            );
        }
    }
    Ok(())
}

/// Steady sliding at any slip rate has the porosity `eps ln(V/V_0)`, at which it stays.
#[test]
fn a_start_at_the_steady_porosity_is_steady() -> Outcome {
    let field = drained(1e-4, 1e4)?;
    let stiffness = 2.0 * CRITICAL[5].1[0];
    let state = LogTheta((LENGTH / VELOCITY).ln());
    let steady = LAW.coefficient(VELOCITY, state);
    let contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL_STRESS)
        .with_state(
            Dieterich {
                slip_distance: LENGTH,
            },
            state,
        )
        .with_shear_stress(Vector1::new(steady * NORMAL_STRESS))
        .with_field(field.with_dilatancy(Dilatancy {
            coefficient: 1e-4,
            reference_velocity: 1e-9,
            slip_distance: LENGTH,
            initial_change: 1e-4 * (VELOCITY / 1e-9).ln(),
        })?);
    let scene = Scene::new(Matrix1::new(stiffness))
        .with_contact(contact)
        .with_load_history(move |time, load| load[0][0] = stiffness * VELOCITY * time);
    let mut patch = RungeKutta::new(scene)?;
    patch.run(&Steps::adaptive(1e-8).until(1e5), |at| {
        let contact = at.contact(0);
        assert!((contact.slip_rate(0) / VELOCITY - 1.0).abs() < 1e-9);
        assert!(contact.pore_pressure(0).abs() < 1e-3);
    })?;
    Ok(())
}
