//! Friction that weakens with the slip rate is counted, whether it has a state or not.

use nalgebra::SMatrix;
use stickslip::friction::{FrictionLaw, Tresca};
use stickslip::{BoundaryPart, Contact, Newmark, Point, Scene, Simulation, Steps};

use crate::Outcome;

/// `mu = 0.6 - 0.1 V/(V + 1 mm/s)`.
#[derive(Debug, Clone, Copy)]
struct Weakening;

impl FrictionLaw for Weakening {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        0.6 - 0.1 * slip_rate / (slip_rate + 1e-3)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        -0.1 * 1e-3 / (slip_rate + 1e-3).powi(2)
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        0.5 * slip_rate + 0.1 * 1e-3 * (slip_rate / 1e-3).ln_1p()
    }
}

/// Pulled with a force that grows from 0.5 to 0.7 of the normal force, against damping that makes each step convex:
/// it begins to slide at 0.6.
fn pulled<L: FrictionLaw<State = ()> + 'static>(
    contact: Contact<L, (), 1>,
) -> Outcome<Simulation<1>> {
    let scene = Scene::new(SMatrix::<f64, 1, 1>::new(1e3))
        .with_viscosity(SMatrix::<f64, 1, 1>::new(1e9))
        .with_contact(contact)
        .with_load_history(|time, load| load[0][0] = 1e6 * (0.5 + 0.2 * time));
    Ok(Simulation::new(scene, Newmark::default(), Point)?)
}

/// A law that weakens is refused unless it is unchecked, and then counted in every step that slides. One that does not
/// weaken is not.
#[test]
fn a_law_without_state_is_counted_where_it_weakens() -> Outcome {
    let part = || BoundaryPart::point(1.0);
    assert!(pulled(Contact::new(part(), Weakening, 1e6)).is_err());
    let mut weakening = pulled(Contact::new(part(), Weakening, 1e6).unchecked())?;
    let (mut sliding, mut counted, mut peak) = (0, 0, 0.0_f64);
    weakening.run(&Steps::constant(0.01).count(100), |at| {
        sliding += usize::from(at.max_slip_rate() > 0.0);
        counted += usize::from(at.report.weakening_nodes > 0);
        peak = peak.max(at.max_slip_rate());
    })?;
    assert!(peak > 1e-5);
    assert_eq!(counted, sliding);
    // To rounding of the load at 0.6 of the normal force.
    assert!((50..=51).contains(&sliding), "{sliding}");
    let coulomb = Contact::new(part(), Tresca { coefficient: 0.6 }, 1e6);
    let mut steady = pulled(coulomb.unchecked())?;
    steady.run(&Steps::constant(0.01).count(100), |at| {
        assert_eq!(at.report.weakening_nodes, 0);
    })?;
    Ok(())
}
