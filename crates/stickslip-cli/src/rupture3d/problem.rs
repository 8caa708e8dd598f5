//! The faults, in terms of half the slip.

use stickslip::fem::Trace;
use stickslip::nalgebra::Vector3;
use stickslip::state::{LogTheta, SlipWeakening, Weakening};
use stickslip::{Contact, Operator, Scene};

use super::Benchmark;
use crate::rupture::{
    Law, PATCHES, aging_of, cohesive_zone, covered, friction, initial_of, prestress, smooth,
};

impl Benchmark {
    /// Normal stress \[Pa\].
    pub fn normal(self) -> f64 {
        Law::Aging.normal()
    }

    /// The initial velocity of a half [m/s].
    pub fn initial_rate(self) -> f64 {
        match self {
            Self::Tpv5 => 0.0,
            Self::Tpv101 | Self::Tpv102 => Law::Aging.initial_rate(),
        }
    }

    /// The initial shear stress of a vertex, the mean over a square of its spacing about it \[Pa\].
    pub fn shear(self, [x, depth]: [f64; 2], spacing: f64) -> f64 {
        if self != Self::Tpv5 {
            return Law::Aging.shear();
        }
        prestress(&PATCHES, x, spacing, covered(depth - 7.5e3, spacing))
    }

    /// The fully grown shear stress that nucleates the rupture \[Pa\].
    pub fn nucleation(self, [x, depth]: [f64; 2]) -> f64 {
        match self {
            Self::Tpv5 => 0.0,
            Self::Tpv101 | Self::Tpv102 => Law::Aging.nucleation(x.hypot(depth - self.middle())),
        }
    }

    /// The length at the front over which friction weakens, in an infinite fault at rest \[m\]:
    /// `G L/((1 - nu) b sigma_n)`, or `9 pi/32 G D_c/(tau_s - tau_d)` of slip weakening (S. Day et al., J. Geophys. Res. 110
    /// (2005)).
    pub fn weakening_length(self) -> f64 {
        let modulus = 2670.0 * 3464.0_f64.powi(2);
        match self {
            Self::Tpv5 => cohesive_zone(modulus),
            Self::Tpv101 | Self::Tpv102 => {
                // Poisson's ratio of the wave speeds.
                let ratio = (3464.0_f64 / 6000.0).powi(2);
                let poisson_ratio = (1.0 - 2.0 * ratio) / (2.0 - 2.0 * ratio);
                let law = aging_of(1.0);
                2.0 * modulus * law.slip_distance / ((1.0 - poisson_ratio) * law.b * self.normal())
            }
        }
    }

    /// A scene with the fault, whose vertices have a spacing \[m\].
    pub fn on<Op: Operator<3>>(
        self,
        scene: Scene<Op, 3>,
        fault: &Trace<3>,
        place: impl Fn(&Vector3<f64>) -> [f64; 2],
        spacing: f64,
    ) -> Scene<Op, 3> {
        let stress = fault.map(|x| Vector3::new(self.shear(place(x), spacing), 0.0, 0.0));
        let normal = self.normal();
        match self {
            Self::Tpv5 => {
                let slips = |[x, depth]: [f64; 2]| x.abs() <= 15e3 && depth <= 15e3;
                let laws = fault.map(|x| friction(slips(place(x))));
                let contact = Contact::per_vertex(fault, laws, normal)
                    .with_state(SlipWeakening { slip_distance: 0.2 }, Weakening(0.0));
                scene.with_contact(contact.with_free_normal().with_shear_stress(stress))
            }
            Self::Tpv101 | Self::Tpv102 => {
                let law = |x: &Vector3<f64>| {
                    let [along, depth] = place(x);
                    aging_of(smooth(along, 15e3) * smooth(depth - self.middle(), 7.5e3))
                };
                let evolution = law(&Vector3::zeros()).aging();
                let states = fault.map(|x| LogTheta(initial_of(&law(x))));
                let contact = Contact::per_vertex(fault, fault.map(law), normal)
                    .with_state(evolution, states);
                scene.with_contact(contact.with_free_normal().with_shear_stress(stress))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Vertices on an edge have the mean of both sides, and all together the stress of the squares.
    #[test]
    fn jumps_of_stress_are_averaged() {
        let stress = |x: f64, depth: f64| Benchmark::Tpv5.shear([x, depth], 100.0) / 1e6;
        assert_eq!(stress(0.0, 7.5e3), 81.6);
        assert!((stress(1.5e3, 7.5e3) - 75.8).abs() < 1e-9);
        assert!((stress(1.5e3, 9e3) - 72.9).abs() < 1e-9);
        assert_eq!(
            [
                stress(-7.5e3, 7.5e3),
                stress(7.5e3, 7.5e3),
                stress(4e3, 7.5e3)
            ],
            [78.0, 62.0, 70.0]
        );
        let force: f64 = (-30..=30)
            .map(|k| stress(100.0 * f64::from(k), 7.5e3) - 70.0)
            .sum();
        assert!((force - 30.0 * 11.6).abs() < 1e-9);
    }

    /// Friction bears the initial stress at the initial slip rate.
    #[test]
    fn the_fault_starts_in_balance() {
        use stickslip::friction::FrictionLaw;
        for share in [0.0, 0.3, 1.0] {
            let law = aging_of(share);
            let state = LogTheta(initial_of(&law));
            let friction = law.coefficient(Benchmark::Tpv102.initial_rate(), state);
            assert!((friction * 120e6 / 75e6 - 1.0).abs() < 1e-12);
        }
    }
}
