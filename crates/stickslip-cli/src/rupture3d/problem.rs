//! The faults, in terms of half the slip.

use stickslip::fem::{FemError, P1, Trace, traction};
use stickslip::fields::ThermalError;
use stickslip::nalgebra::Vector3;
use stickslip::state::{LogTheta, SlipWeakening, Weakening};
use stickslip::{Contact, Operator, Scene};

use super::Benchmark;
use super::averages::{Patch, averages};
use crate::rupture::{
    Law, PATCH, PATCHES, SHEAR, SLIP_DISTANCE, aging_of, cohesive_zone, drainage_of, flash_of,
    friction, heated, initial_of, smooth, start,
};

/// The density \[kg/m^3\], and the speeds of pressure and shear waves [m/s].
pub(super) const ROCK: [f64; 3] = [2670.0, 6000.0, 3464.0];

impl Benchmark {
    /// The fault of the plane with the same friction, if it has a state of rate and state.
    fn law(self) -> Option<Law> {
        match self {
            Self::Tpv5 => None,
            Self::Tpv101 | Self::Tpv102 => Some(Law::Aging),
            Self::Tpv104 => Some(Law::StrongWeakening),
            Self::Tpv105 => Some(Law::Pressurized),
        }
    }

    /// The normal stress at a depth, less the initial pore pressure \[Pa\].
    fn normal(self, depth: f64) -> f64 {
        match self {
            Self::Tpv105 => (9.8 * 1670.0 * depth).min(Law::Pressurized.normal()),
            _ => Law::Aging.normal(),
        }
    }

    /// The initial velocity of a half [m/s].
    pub(super) fn initial_rate(self) -> f64 {
        self.law().map_or(0.0, Law::initial_rate)
    }

    /// The fully grown shear stress that nucleates the rupture \[Pa\].
    pub(super) fn nucleation(self, [x, depth]: [f64; 2]) -> f64 {
        let [along, down] = self.hypocenter();
        let distance = (x - along).hypot(depth - down);
        self.law().map_or(0.0, |law| law.nucleation(distance))
    }

    /// The share of the friction of a place that weakens, with tapers at the rim.
    fn share(self, [x, depth]: [f64; 2]) -> f64 {
        let down = match self {
            Self::Tpv101 => smooth(depth, 7.5e3),
            Self::Tpv105 => smooth(depth - 9e3, 6e3),
            _ => smooth(depth - 7.5e3, 7.5e3),
        };
        smooth(x, 15e3) * down
    }

    /// The length at the front over which friction weakens, in an infinite fault at rest \[m\].
    pub(super) fn weakening_length(self) -> f64 {
        let [density, c_p, c_s] = ROCK;
        let modulus = density * c_s.powi(2);
        // `1/(1 - nu)` of the wave speeds.
        let stiffness = 2.0 * modulus * (1.0 - (c_s / c_p).powi(2));
        match self.law() {
            None => cohesive_zone(modulus),
            Some(law) => law.weakening_length(stiffness).1,
        }
    }
}

/// The initial stresses of a fault, averages over the areas of its vertices.
pub(super) struct Prestress {
    /// The normal stress \[Pa\].
    pub normal: Vec<f64>,
    /// The shear stress along strike \[Pa\].
    pub shear: Vec<f64>,
    /// The forces that balance the normal stress \[N\].
    pub balance: Vec<Vector3<f64>>,
}

impl Prestress {
    /// That of a benchmark, on a fault whose points have these places.
    pub(super) fn new(
        problem: Benchmark,
        (space, fault): (&P1<3>, &Trace<3>),
        place: impl Fn(&Vector3<f64>) -> [f64; 2],
    ) -> Result<Self, FemError> {
        // The normal stress is there from the start and compresses nothing.
        let balance = traction(space, fault, |x| {
            Vector3::new(0.0, -problem.normal(place(x)[1]), 0.0)
        })?;
        let vertices = fault.vertices().iter().zip(fault.weights());
        let normal: Vec<f64> = vertices.map(|(&p, w)| -balance[p][1] / w).collect();
        let shear = match problem.law() {
            Some(law) => {
                let ratio = law.shear() / law.normal();
                normal.iter().map(|normal| ratio * normal).collect()
            }
            None => {
                // As high as wide.
                let squares = PATCHES.map(|(middle, stress)| Patch {
                    extent: [middle, 7.5e3].map(|x| [x - PATCH, x + PATCH]),
                    value: stress - SHEAR,
                });
                let at = |k: usize| place(&fault.points()[k]);
                let above = averages(fault, at, &squares);
                above.iter().map(|above| SHEAR + above).collect()
            }
        };
        Ok(Self {
            normal,
            shear,
            balance,
        })
    }
}

impl Benchmark {
    /// A scene with the fault.
    ///
    /// # Errors
    /// None of these parameters is out of range.
    pub(super) fn on<Op: Operator<3>>(
        self,
        scene: Scene<Op, 3>,
        fault: &Trace<3>,
        place: impl Fn(&Vector3<f64>) -> [f64; 2],
        prestress: &Prestress,
    ) -> Result<Scene<Op, 3>, ThermalError> {
        let normal = prestress.normal.clone();
        let along = |shear: &f64| Vector3::new(*shear, 0.0, 0.0);
        let stress: Vec<_> = prestress.shear.iter().map(along).collect();
        let Some(law) = self.law() else {
            let weakening = SlipWeakening {
                slip_distance: 0.5 * SLIP_DISTANCE,
            };
            let contact =
                Contact::new(fault, friction(true), normal).with_state(weakening, Weakening(0.0));
            return Ok(scene.with_contact(contact.with_free_normal().with_shear_stress(stress)));
        };
        if law == Law::Aging {
            let laws = fault.map(|x| aging_of(self.share(place(x))));
            let states: Vec<_> = laws.iter().map(|law| LogTheta(initial_of(law))).collect();
            let contact =
                Contact::per_vertex(fault, laws, normal).with_state(aging_of(1.0).aging(), states);
            return Ok(scene.with_contact(contact.with_free_normal().with_shear_stress(stress)));
        }
        let laws = fault.map(|x| flash_of(self.share(place(x))));
        let evolutions: Vec<_> = laws.iter().map(|law| law.evolution()).collect();
        let states: Vec<_> = laws.iter().map(|friction| start(law, friction)).collect();
        let mut contact = Contact::per_vertex(fault, laws, normal)
            .with_state_per_vertex(evolutions, states)
            .with_free_normal()
            .with_shear_stress(stress);
        if self.is_heated() {
            // Up to the surface.
            let drainage = fault.map(|x| {
                let [x, depth] = place(x);
                drainage_of(smooth(x, 15e3) * smooth(depth, 15e3))
            });
            contact = contact.with_field(heated(drainage)?);
        }
        Ok(scene.with_contact(contact))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Fault = (Vec<[f64; 2]>, Vec<f64>, Prestress);

    /// Places and weights of the vertices of a fault, and its prestress.
    fn fault(problem: Benchmark) -> Result<Fault, FemError> {
        let space = P1::<3>::grid([20e3, 1e3, 12e3], [40, 1, 24])?;
        let place = |x: &Vector3<f64>| [x[0] - 10e3, x[2]];
        let fault = space.trace(|x| x[1] == 0.0)?;
        let prestress = Prestress::new(problem, (&space, &fault), place)?;
        Ok((fault.map(place), fault.weights().to_vec(), prestress))
    }

    /// Vertices on an edge have a mean of both sides, and all together the force of the squares.
    #[test]
    fn jumps_of_stress_are_averaged() -> Result<(), FemError> {
        let (places, weights, prestress) = fault(Benchmark::Tpv5)?;
        let stress = |x: f64, depth: f64| {
            let found = places.iter().position(|place| *place == [x, depth]);
            found.map_or(f64::NAN, |k| prestress.shear[k])
        };
        let near = |found: f64, expected: f64| (found - expected).abs() < 1e-7;
        assert!(near(stress(0.0, 7.5e3), 81.6e6) && near(stress(4e3, 7.5e3), 70e6));
        assert!(near(stress(-7.5e3, 7.5e3), 78e6) && near(stress(7.5e3, 7.5e3), 62e6));
        assert!(near(stress(1.5e3, 7.5e3), 75.8e6));
        let above = prestress.shear.iter().zip(&weights);
        let force: f64 = above.map(|(shear, w)| (shear - 70e6) * w).sum();
        assert!((force / (9e6 * (11.6e6 + 8e6 - 8e6)) - 1.0).abs() < 1e-12);
        Ok(())
    }

    /// The normal stress of TPV105 grows with depth, and is above 0 at the surface; friction bears the shear stress.
    #[test]
    fn the_faults_start_in_balance() -> Result<(), FemError> {
        use stickslip::friction::FrictionLaw;
        let (places, _, prestress) = fault(Benchmark::Tpv105)?;
        for (([_, depth], normal), shear) in
            places.iter().zip(&prestress.normal).zip(&prestress.shear)
        {
            // No less than at the highest neighbour, 500 m above, or at the mean depth of a triangle below the surface,
            // `(2 z_p + z_q + z_r)/4`; no more than at the largest mean depth.
            let [low, high] = [(depth - 500.0).max(125.0), depth + 250.0];
            let range = [low, high].map(|z| Benchmark::Tpv105.normal(z) * (1.0 + 1e-12));
            assert!(
                *normal > 0.999 * range[0] && *normal <= range[1],
                "{depth} {normal}"
            );
            assert!((shear / normal - 0.41).abs() < 1e-15);
        }
        for share in [0.0, 0.3, 1.0] {
            let law = aging_of(share);
            let state = LogTheta(initial_of(&law));
            let friction = law.coefficient(Benchmark::Tpv102.initial_rate(), state);
            assert!((friction * 120e6 / 75e6 - 1.0).abs() < 1e-12);
            let law = flash_of(share);
            for (problem, ratio) in [(Benchmark::Tpv104, 40.0 / 120.0), (Benchmark::Tpv105, 0.41)] {
                let Some(plane) = problem.law() else { continue };
                let friction = law.coefficient(problem.initial_rate(), start(plane, &law));
                assert!((friction / ratio - 1.0).abs() < 1e-12, "{share}");
            }
        }
        Ok(())
    }

    /// The tapers of TPV105 at the top and at the bottom: 1 from 3 to 15 km, a half in the middle of each.
    #[test]
    fn tapers() {
        let share = |depth| Benchmark::Tpv105.share([0.0, depth]);
        assert_eq!(
            [0.0, 3e3, 9e3, 15e3, 18e3].map(share),
            [0.0, 1.0, 1.0, 1.0, 0.0]
        );
        assert!(
            [1.5e3, 16.5e3]
                .map(share)
                .iter()
                .all(|share| (share - 0.5).abs() < 1e-15)
        );
        assert_eq!(Benchmark::Tpv102.share([0.0, 0.0]), 1.0);
    }
}
