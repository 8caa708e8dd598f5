//! BP8-QD: fluid injection into a plane in a whole space, spread as a Gaussian (GS) or by a well (PW).

mod pressure;
mod report;

use stickslip::bie::{Medium, PlaneFault, Rectangles};
use stickslip::fields::{
    Diffusion, DiffusionError, GaussianSource, Hydraulics, Plane, RateHistory, Well,
};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::SVector;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene};

use super::fluid::Source;
use super::{Arguments, Failed, state_for};

/// The medium around the fault.
pub const MEDIUM: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
/// Poisson's ratio.
pub const POISSON_RATIO: f64 = 0.25;
/// Normal stress without fluid \[Pa\].
pub const NORMAL: f64 = 25e6;
/// The initial shear stress along the initial slip rate \[Pa\].
pub const SHEAR: f64 = 14.6e6;
/// The initial slip rate along strike and down dip [m/s].
pub const INITIAL_RATE: [f64; 2] = [1e-12, 1e-20];
/// The fault reaches so far from its centre along strike and down dip \[m\]; beyond there is no slip.
pub const HALF: f64 = 400.0;
/// The state law.
pub const AGING: Dieterich = Dieterich {
    slip_distance: 0.5e-3,
};

/// The injection: rate [m^3/s], its end \[s\], and the standard deviation of its Gaussian \[m\].
const RATE: f64 = 3e-3;
const SHUT: f64 = 100.0 * HOUR;
const DEVIATION: f64 = 50.0;
/// The well: storage [m^3/Pa] and radius \[m\].
const BORE: [f64; 2] = [1e-7, 0.05];
/// An hour \[s\].
const HOUR: f64 = 3600.0;

/// The friction law.
pub fn law() -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: 0.016,
        b: 0.010,
        reference_friction: 0.6,
        reference_velocity: 1e-6,
        slip_distance: AGING.slip_distance,
    }
}

/// The initial state, `ln(theta / 1 s)`: with it friction and radiation damping balance the shear stress at the initial
/// slip rate.
pub fn state() -> f64 {
    let [along, down] = INITIAL_RATE;
    let rate = f64::hypot(along, down);
    let damping = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed * rate;
    state_for(&law(), (SHEAR - damping) / NORMAL, rate)
}

/// The hydraulic properties: diffusivity .05 m^2/s.
fn zone() -> Hydraulics {
    Hydraulics {
        permeability: 5e-14.into(),
        viscosity: 1e-3.into(),
        storage: (1e-8 * 0.1).into(),
        thickness: 1.0.into(),
    }
}

/// Diffusion on `refinement` times `refinement` cells in each cell of the fault, which sees the pressure in its middle. The
/// well is in the cell that holds the centre, or beside it.
fn diffusion(
    cells: &Rectangles,
    refinement: usize,
    source: Source,
) -> Result<Diffusion, DiffusionError> {
    let counts = [cells.along_strike().count(), cells.down_dip().count()];
    let fine = counts.map(|count| count * refinement);
    let half = refinement / 2;
    let middle = |cell: usize| {
        let [column, row] = [cell % counts[0], cell / counts[0]].map(|n| n * refinement + half);
        row * fine[0] + column
    };
    let ends = [cells.along_strike().ends(), cells.down_dip().ends()];
    let middles: Vec<usize> = (0..cells.count()).map(middle).collect();
    let sealed = Diffusion::new(Plane::new(ends, fine)?, &zone())?.with_vertices(&middles)?;
    let rates = RateHistory::constant_between(&[(0.0, RATE), (SHUT, 0.0)])?;
    let (centre, [storage, radius]) = ([0.0, 0.0], BORE);
    match source {
        // Its pressure is smooth on the scale of cells.
        Source::Gaussian => sealed
            .with_fourth_order()?
            .with_gaussian_source(GaussianSource::new(centre, DEVIATION, rates)),
        Source::Well => sealed.with_well(Well::new(centre, rates).with_bore(storage, radius)),
    }
}

/// Takes the steps, writes and prints the results, and checks the pore pressure of the Gaussian source.
pub(super) fn run(arguments: &Arguments) -> Result<(), Failed> {
    let along = arguments.cells([-HALF, HALF])?;
    let fault = PlaneFault::whole_space(Rectangles::new(along, along), MEDIUM, POISSON_RATIO)?;
    match arguments.components {
        Some(1) => run_on(arguments, &fault.with_rake(0.0)?),
        _ => run_on(arguments, &fault),
    }
}

fn run_on<const C: usize>(arguments: &Arguments, fault: &PlaneFault<C>) -> Result<(), Failed> {
    let (cells, fluid) = (fault.cells(), &arguments.fluid);
    let [along, down] = INITIAL_RATE;
    let speed = f64::hypot(along, down);
    // The second component is up dip.
    let rate = SVector::<f64, C>::from_fn(|c, _| [along, -down][c]);
    let field = diffusion(cells, fluid.refinement(), fluid.source())?;
    let mut contact = Contact::new(fault, law(), NORMAL)
        .with_state(AGING, LogTheta(state()))
        .with_shear_stress(rate * (SHEAR / speed))
        .with_field(field);
    if let Some(least) = fluid.least_normal_stress {
        contact = contact.with_least_normal_stress(least);
    }
    if fluid.allow_opening {
        contact = contact.allow_opening();
    }
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact)
        .with_velocity(vec![rate; cells.count()]);
    report::run(arguments, fault, RungeKutta::new(scene)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fault_starts_as_published() {
        let theta = state().exp();
        assert!((theta / 4.0188e11 - 1.0).abs() < 2e-5, "{theta:e}");
    }
}
