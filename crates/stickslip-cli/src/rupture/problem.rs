//! The faults: TPV101, and TPV103 with strong rate weakening, in terms of half the slip.

use clap::ValueEnum;
use stickslip::fem::Trace;
use stickslip::friction::{RegularizedDieterichRuina, StrongRateWeakening};
use stickslip::nalgebra::Vector2;
use stickslip::state::{LogTheta, Psi};
use stickslip::{Contact, Operator, Scene};

/// Normal stress \[Pa\].
pub const NORMAL: f64 = 120e6;

/// The law of the fault, with its benchmark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Law {
    /// Rate and state with the aging law: TPV101
    Aging,
    /// Strong rate weakening by flash heating: TPV103, for cells of 40 m or less
    StrongWeakening,
}

impl Law {
    /// Initial shear stress \[Pa\].
    pub fn shear(self) -> f64 {
        match self {
            Self::Aging => 75e6,
            Self::StrongWeakening => 40e6,
        }
    }

    /// The initial velocity of a half [m/s].
    pub fn initial_rate(self) -> f64 {
        match self {
            Self::Aging => 0.5e-12,
            Self::StrongWeakening => 0.5e-16,
        }
    }

    /// The fully grown shear stress perturbation that nucleates the rupture, at a position \[Pa\].
    pub fn nucleation(self, x: f64) -> f64 {
        let radius = 3e3;
        let amplitude = match self {
            Self::Aging => 25e6,
            Self::StrongWeakening => 45e6,
        };
        if x.abs() < radius {
            amplitude * (x * x / (x * x - radius * radius)).exp()
        } else {
            0.0
        }
    }

    /// A scene with the fault.
    pub fn on<Op: Operator<2>>(self, scene: Scene<Op, 2>, fault: &Trace<2>) -> Scene<Op, 2> {
        let stress = Vector2::new(self.shear(), 0.0);
        match self {
            Self::Aging => {
                let evolution = aging(0.0).aging();
                let contact = Contact::per_vertex(fault, fault.map(|x| aging(x[0])), NORMAL)
                    .with_state(evolution, fault.map(|x| LogTheta(initial(x[0]))));
                scene.with_contact(contact.with_free_normal().with_shear_stress(stress))
            }
            Self::StrongWeakening => {
                let laws = fault.map(|x| flash(x[0]));
                let states = fault.map(|x| start(x[0]));
                let evolutions: Vec<_> = laws.iter().map(StrongRateWeakening::evolution).collect();
                let contact = Contact::per_vertex(fault, laws, NORMAL)
                    .with_state_per_vertex(evolutions, states);
                scene.with_contact(contact.with_free_normal().with_shear_stress(stress))
            }
        }
    }
}

/// 1 on the velocity-weakening fault, 0 beyond, smooth between: 15 km and 3 km wide.
fn taper(x: f64) -> f64 {
    let (inner, width) = (15e3, 3e3);
    let beyond = x.abs() - inner;
    if beyond <= 0.0 {
        1.0
    } else if beyond >= width {
        0.0
    } else {
        0.5 * (1.0 + (width / (beyond - width) + width / beyond).tanh())
    }
}

/// The friction law of TPV101 at a position \[m\].
fn aging(x: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: 0.008 + 0.008 * (1.0 - taper(x)),
        b: 0.012,
        reference_friction: 0.6,
        reference_velocity: 0.5e-6,
        slip_distance: 0.01,
    }
}

/// The state at a position, `ln(theta / 1 s)`, for which friction balances the initial shear stress at the initial slip
/// rate.
fn initial(x: f64) -> f64 {
    let law = aging(x);
    let coefficient = Law::Aging.shear() / NORMAL;
    let psi = (law.in_psi()).state_of_friction(coefficient, Law::Aging.initial_rate());
    let LogTheta(alpha) = law.aging_in_psi().log_theta(psi);
    alpha
}

/// The friction law of TPV103 at a position \[m\].
fn flash(x: f64) -> StrongRateWeakening {
    let beyond = 1.0 - taper(x);
    StrongRateWeakening {
        a: 0.01 + 0.01 * beyond,
        b: 0.014,
        reference_friction: 0.6,
        reference_velocity: 0.5e-6,
        slip_distance: 0.2,
        weakened_friction: 0.2,
        weakening_velocity: 0.5 * (0.1 + 0.9 * beyond),
    }
}

/// The state at a position for which friction balances the initial shear stress.
fn start(x: f64) -> Psi {
    let law = Law::StrongWeakening;
    flash(x).state_of_friction(law.shear() / NORMAL, law.initial_rate())
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip::friction::FrictionLaw;

    /// Checks the published states and their friction.
    #[test]
    fn the_faults_start_in_balance() {
        assert!((initial(0.0) - 1.606_238_999_213_454e9_f64.ln()).abs() < 1e-12);
        assert!((start(0.0).0 - 0.563_591_842_633).abs() < 1e-11);
        assert!((start(20e3).0 - 0.793_850_351_932).abs() < 1e-11);
        for x in [0.0, 15.5e3, 17e3, 20e3] {
            let (law, ratio) = (aging(x), 0.5 * Law::Aging.initial_rate());
            let state = (law.reference_velocity * initial(x).exp() / law.slip_distance).ln();
            let argument = ratio / law.reference_velocity
                * ((law.reference_friction + law.b * state) / law.a).exp();
            let shear = law.a * argument.asinh() * NORMAL;
            assert!((shear / Law::Aging.shear() - 1.0).abs() < 1e-12, "{x}");
            let strong = Law::StrongWeakening;
            let shear = flash(x).coefficient(strong.initial_rate(), start(x)) * NORMAL;
            assert!((shear / strong.shear() - 1.0).abs() < 1e-12, "{x}");
        }
    }
}
