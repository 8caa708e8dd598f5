//! BP6-QD-A and BP6-QD-S: fluid injection into a fault in a whole space, with the aging law and the slip law.

mod report;

use std::f64::consts::PI;

use stickslip::Contact;
use stickslip::bie::{Cells, Fault, Medium, Mode};
use stickslip::fields::{
    Diffusion, DiffusionError, GivenPressure, Hydraulics, Line, RateHistory, Well,
};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector1;
use stickslip::state::{Dieterich, LogTheta, Ruina, StateLaw};

use super::antiplane::antiplane;
use super::fluid::Pressure;
use super::{Arguments, DAY, Failed, Problem, state_for};

/// The medium around the fault.
pub const MEDIUM: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
/// Normal stress without fluid \[Pa\].
pub const NORMAL: f64 = 50e6;
/// The initial slip rate [m/s].
pub const INITIAL_RATE: f64 = 1e-12;
/// The characteristic slip distance \[m\].
pub const SLIP_DISTANCE: f64 = 4e-3;
/// Initial shear stress carried by friction \[Pa\].
const BORNE: f64 = 29.2e6;

/// The injection: flux [m/s], compressibility [1/Pa], porosity, diffusivity [m^2/s], and its end \[s\].
const FLUX: f64 = 1.25e-6;
const COMPRESSIBILITY: f64 = 1e-8;
const POROSITY: f64 = 0.1;
const DIFFUSIVITY: f64 = 0.1;
/// The viscosity of the fluid [Pa s], and the thickness of the zone \[m\], on which slip does not depend.
const VISCOSITY: f64 = 1e-3;
const THICKNESS: f64 = 1.0;
const SHUT: f64 = 100.0 * DAY;

/// The friction law.
pub fn law() -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: 0.007,
        b: 0.005,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: SLIP_DISTANCE,
    }
}

/// The initial shear stress \[Pa\].
pub fn shear() -> f64 {
    BORNE + 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * INITIAL_RATE
}

/// The initial state, `ln(theta / 1 s)`.
pub fn state() -> f64 {
    state_for(&law(), BORNE / NORMAL, INITIAL_RATE)
}

/// The pore pressure at a distance from the injection point \[m\] at a time \[s\].
pub fn pressure(z: f64, time: f64) -> f64 {
    let scale = FLUX / (COMPRESSIBILITY * POROSITY * DIFFUSIVITY.sqrt());
    scale * (spread(z, time) - spread(z, time - SHUT))
}

/// `sqrt(t) (exp(-x^2)/sqrt(pi) - x erfc(x))` with `x = abs(z)/sqrt(4 alpha t)`.
fn spread(z: f64, time: f64) -> f64 {
    if time <= 0.0 {
        return 0.0;
    }
    let x = z.abs() / (4.0 * DIFFUSIVITY * time).sqrt();
    // Beyond, it is below rounding of what it is at 0.
    if x > 6.5 {
        return 0.0;
    }
    time.sqrt() * ((-x * x).exp() / PI.sqrt() - x * libm::erfc(x))
}

/// Diffusion along the cells, with injection at 0: in the cell there, or half of it in both cells beside.
fn diffusion(cells: &Cells) -> Result<Diffusion, DiffusionError> {
    let storage = COMPRESSIBILITY * POROSITY;
    let zone = Hydraulics {
        permeability: (DIFFUSIVITY * VISCOSITY * storage).into(),
        viscosity: VISCOSITY.into(),
        storage: storage.into(),
        thickness: THICKNESS.into(),
    };
    let line = Line::uniform(cells.ends(), cells.count())?;
    let half = 0.5 * cells.length();
    let places: &[f64] = if cells.count().is_multiple_of(2) {
        &[-half, half]
    } else {
        &[0.0]
    };
    let rate = FLUX * THICKNESS / places.len() as f64;
    let rates = RateHistory::constant_between(&[(0.0, rate), (SHUT, 0.0)])?;
    let wells = places.iter().map(|&place| Well::new(place, rates.clone()));
    let sealed = Diffusion::new(line, &zone)?;
    wells.into_iter().try_fold(sealed, Diffusion::with_well)
}

/// Takes the steps, writes and prints the results, and checks them. Friction is uniform; the pore pressure of the fluid
/// diffuses along the fault and reduces its normal stress.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    match arguments.problem {
        Problem::Bp6s => run_with(
            arguments,
            Ruina {
                slip_distance: SLIP_DISTANCE,
            },
        ),
        _ => run_with(
            arguments,
            Dieterich {
                slip_distance: SLIP_DISTANCE,
            },
        ),
    }
}

fn run_with<S>(arguments: &Arguments, evolution: S) -> Result<(), Failed>
where
    S: StateLaw<State = LogTheta> + 'static,
{
    let cells = arguments.cells([-20e3, 20e3])?;
    let fault = Fault::whole_space(cells, MEDIUM, Mode::Antiplane)?;
    let friction = Contact::new(&fault, law(), NORMAL)
        .with_state(evolution, LogTheta(state()))
        .with_shear_stress(Vector1::new(shear()));
    let friction = match arguments.fluid.pressure() {
        Pressure::Solver => friction.with_field(diffusion(&cells)?),
        Pressure::ClosedForm => {
            let at = move |time, p: &mut [f64]| {
                for (cell, p) in p.iter_mut().enumerate() {
                    *p += pressure(cells.center(cell), time);
                }
            };
            friction.with_field(GivenPressure::new(cells.count(), 0.0, at))
        }
    };
    let mut motion = antiplane(arguments, &fault, friction, [INITIAL_RATE, 0.0])?;
    report::run(arguments, &fault, &mut *motion)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fault_starts_as_published() {
        let log = state() / std::f64::consts::LN_10;
        assert!((log - 10.612_317_650).abs() < 1e-9, "{log}");
    }

    /// Checks values of the published formula; z \[m\], t \[s\], p \[Pa\].
    #[test]
    fn the_fluid_spreads_as_published() {
        for [z, time, published] in [
            [0.0, 86_400.0, 6.555_290_583_6e5],
            [0.0, 9.504e6, 4.802_281_869_5e6],
            [500.0, 4.32e6, 2.165_191_121_9e6],
            [1000.0, 6.3072e7, 1.205_236_196_9e6],
        ] {
            let found = pressure(z, time);
            assert!(
                (found / published - 1.0).abs() < 1e-9,
                "{z} {time}: {found}"
            );
        }
    }
}
