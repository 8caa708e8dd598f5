//! The faults: TPV101, TPV103 with strong rate weakening, and TPV105 with thermal pressurization, in terms of half the
//! slip.

use stickslip::fem::Trace;
use stickslip::fields::{PoreFluid, ShearZone, ThermalError, ThermalPressurization};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina, StrongRateWeakening};
use stickslip::nalgebra::Vector2;
use stickslip::state::{LogTheta, Psi};
use stickslip::{Contact, Operator, Scene};

/// The law of the fault, with its benchmark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Law {
    /// Rate and state with the aging law: TPV101.
    Aging,
    /// Strong rate weakening by flash heating: TPV103.
    StrongWeakening,
    /// The same with thermal pressurization: TPV105.
    Pressurized,
}

impl Law {
    /// Normal stress; under thermal pressurization less the initial pore pressure \[Pa\].
    pub fn normal(self) -> f64 {
        match self {
            Self::Aging | Self::StrongWeakening => 120e6,
            Self::Pressurized => 45e6,
        }
    }

    /// Initial shear stress \[Pa\].
    pub fn shear(self) -> f64 {
        match self {
            Self::Aging => 75e6,
            Self::StrongWeakening => 40e6,
            Self::Pressurized => 0.41 * self.normal(),
        }
    }

    /// The initial velocity of a half [m/s].
    pub fn initial_rate(self) -> f64 {
        match self {
            Self::Aging => 0.5e-12,
            Self::StrongWeakening | Self::Pressurized => 0.5e-16,
        }
    }

    /// The fully grown shear stress perturbation that nucleates the rupture, at a position \[Pa\].
    pub fn nucleation(self, x: f64) -> f64 {
        let (amplitude, radius) = match self {
            Self::Aging => (25e6, 3e3),
            Self::StrongWeakening => (45e6, 3e3),
            Self::Pressurized => (50e6, 1.5e3),
        };
        if x.abs() < radius {
            amplitude * (x * x / (x * x - radius * radius)).exp()
        } else {
            0.0
        }
    }

    /// The length at the front over which friction weakens, in an infinite fault at rest whose sides resist slip by
    /// `G^ = G/(1 - nu)` \[Pa\], with its name \[m\]: `L_b = G^ L/(b sigma_n)`, and under strong rate weakening
    /// `G^ L/((f_p - f_w) sigma_n)`, with `f_p` the friction of the initial state at 1 m/s, without thermal pressurization.
    pub fn weakening_length(self, stiffness: f64) -> (&'static str, f64) {
        // Slip distances are half of those across the fault.
        if self == Self::Aging {
            let law = aging_of(1.0);
            let length = 2.0 * stiffness * law.slip_distance / (law.b * self.normal());
            return ("length L_b", length);
        }
        let law = flash(0.0);
        let drop = law.coefficient(0.5, start(self, &law)) - law.weakened_friction;
        let length = 2.0 * stiffness * law.slip_distance / (drop * self.normal());
        ("length of flash weakening", length)
    }

    /// A scene with the fault.
    ///
    /// # Errors
    /// Parameters of the shear zone out of range: none of these.
    pub fn on<Op: Operator<2>>(
        self,
        scene: Scene<Op, 2>,
        fault: &Trace<2>,
    ) -> Result<Scene<Op, 2>, ThermalError> {
        let (normal, stress) = (self.normal(), Vector2::new(self.shear(), 0.0));
        if self == Self::Aging {
            let evolution = aging(0.0).aging();
            let contact = Contact::per_vertex(fault, fault.map(|x| aging(x[0])), normal)
                .with_state(evolution, fault.map(|x| LogTheta(initial(x[0]))));
            return Ok(scene.with_contact(contact.with_free_normal().with_shear_stress(stress)));
        }
        let laws = fault.map(|x| flash(x[0]));
        let states = fault.map(|x| start(self, &flash(x[0])));
        let evolutions: Vec<_> = laws.iter().map(StrongRateWeakening::evolution).collect();
        let mut contact = Contact::per_vertex(fault, laws, normal)
            .with_state_per_vertex(evolutions, states)
            .with_free_normal()
            .with_shear_stress(stress);
        if self == Self::Pressurized {
            let drainage = fault.map(|x| drainage_of(taper(x[0])));
            contact = contact.with_field(heated(drainage)?);
        }
        Ok(scene.with_contact(contact))
    }
}

/// The hydraulic diffusivity of TPV105 where so much of the fault weakens [m^2/s].
pub fn drainage_of(share: f64) -> f64 {
    4e-4 + (1.0 - share)
}

/// The shear zone of TPV105, of vertices with these hydraulic diffusivities [m^2/s].
///
/// # Errors
/// None of these parameters is out of range.
pub fn heated(drainage: Vec<f64>) -> Result<ThermalPressurization, ThermalError> {
    let zone = ShearZone {
        half_width: 0.02.into(),
        // Heat comes from the whole slip rate, twice that of the body: half the capacity has the same temperature.
        volumetric_heat_capacity: (0.5 * 2.7e6).into(),
        thermal_diffusivity: 1e-6.into(),
        initial_temperature: 483.15.into(),
    };
    let vertices = drainage.len();
    let fluid = PoreFluid {
        hydraulic_diffusivity: drainage.into(),
        pressurization_coefficient: 1e5.into(),
    };
    ThermalPressurization::new(vertices, zone, fluid)
}

/// 1 on the velocity-weakening fault, 0 beyond, smooth between: 15 km and 3 km wide.
fn taper(x: f64) -> f64 {
    smooth(x, 15e3)
}

/// 1 up to a distance, 0 from 3 km beyond it, smooth between.
pub fn smooth(x: f64, inner: f64) -> f64 {
    let width = 3e3;
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
    aging_of(taper(x))
}

/// The friction law of TPV101 where so much of the fault weakens.
pub fn aging_of(share: f64) -> RegularizedDieterichRuina {
    RegularizedDieterichRuina {
        a: 0.008 + 0.008 * (1.0 - share),
        b: 0.012,
        reference_friction: 0.6,
        reference_velocity: 0.5e-6,
        slip_distance: 0.01,
    }
}

/// The state at a position, `ln(theta / 1 s)`, for which friction balances the initial shear stress at the initial slip
/// rate.
fn initial(x: f64) -> f64 {
    initial_of(&aging(x))
}

/// The same of a law.
pub fn initial_of(law: &RegularizedDieterichRuina) -> f64 {
    let coefficient = Law::Aging.shear() / Law::Aging.normal();
    let psi = (law.in_psi()).state_of_friction(coefficient, Law::Aging.initial_rate());
    let LogTheta(alpha) = law.aging_in_psi().log_theta(psi);
    alpha
}

/// The friction law of TPV103 and TPV105 at a position \[m\].
fn flash(x: f64) -> StrongRateWeakening {
    flash_of(taper(x))
}

/// The friction law of TPV103, TPV104 and TPV105 where so much of the fault weakens.
pub fn flash_of(share: f64) -> StrongRateWeakening {
    let beyond = 1.0 - share;
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

/// The state for which friction balances the initial shear stress.
pub fn start(law: Law, friction: &StrongRateWeakening) -> Psi {
    friction.state_of_friction(law.shear() / law.normal(), law.initial_rate())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the published states and their friction.
    #[test]
    fn the_faults_start_in_balance() {
        assert!((initial(0.0) - 1.606_238_999_213_454e9_f64.ln()).abs() < 1e-12);
        let strong = Law::StrongWeakening;
        assert!((start(strong, &flash(0.0)).0 - 0.563_591_842_633).abs() < 1e-11);
        assert!((start(strong, &flash(20e3)).0 - 0.793_850_351_932).abs() < 1e-11);
        for x in [0.0, 15.5e3, 17e3, 20e3] {
            let (law, ratio) = (aging(x), 0.5 * Law::Aging.initial_rate());
            let state = (law.reference_velocity * initial(x).exp() / law.slip_distance).ln();
            let argument = ratio / law.reference_velocity
                * ((law.reference_friction + law.b * state) / law.a).exp();
            let shear = law.a * argument.asinh() * Law::Aging.normal();
            assert!((shear / Law::Aging.shear() - 1.0).abs() < 1e-12, "{x}");
            for strong in [Law::StrongWeakening, Law::Pressurized] {
                let friction =
                    flash(x).coefficient(strong.initial_rate(), start(strong, &flash(x)));
                let shear = friction * strong.normal();
                assert!((shear / strong.shear() - 1.0).abs() < 1e-12, "{x}");
            }
        }
    }
}
