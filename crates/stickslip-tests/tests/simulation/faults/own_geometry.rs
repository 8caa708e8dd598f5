//! A fault that is written outside of the crates runs as those inside.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, Vector1};
use proptest::prelude::*;
use stickslip::bie::{Cells, Fault, FaultCells, FaultGeometry, Medium, Mode};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, DenseNewton, GeneralizedAlpha, RungeKutta, Scene};
use stickslip::{Simulation, Steps};

use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3464.0,
};
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-3,
};

/// Antiplane slip with a period, mode by mode: `mu abs(k)/2`.
struct Periodic {
    count: usize,
    length: f64,
}

impl FaultGeometry<1> for Periodic {
    type Kernel = DMatrix<f64>;

    fn cells(&self) -> FaultCells {
        let center = |k: usize| [self.length * (k as f64 + 0.5), 0.0, 0.0];
        FaultCells {
            centers: (0..self.count).map(center).collect(),
            areas: vec![self.length; self.count],
            dimension: 1,
            identity: None,
        }
    }

    fn stiffness(&self) -> DMatrix<f64> {
        let count = self.count as f64;
        DMatrix::from_fn(self.count, self.count, |i, j| {
            let apart = i as f64 - j as f64;
            let modes = (0..self.count).map(|n| {
                let wave = n.min(self.count - n) as f64 * TAU / (count * self.length);
                0.5 * ROCK.shear_modulus * wave * (TAU * n as f64 * apart / count).cos()
            });
            self.length * modes.sum::<f64>() / count
        })
    }

    fn radiation_damping(&self) -> DMatrix<f64> {
        let damping = 0.5 * ROCK.shear_modulus / ROCK.shear_wave_speed * self.length;
        DMatrix::from_diagonal_element(self.count, self.count, damping)
    }
}

/// The scene of a fault with a bump of shear stress.
fn scene<G: FaultGeometry<1>>(fault: &G, bump: f64) -> Outcome<Scene<G::Kernel, 1>> {
    let cells = fault.cells();
    let middle = 0.5 * cells.areas.iter().sum::<f64>();
    let shear: Vec<_> = (cells.centers.iter())
        .map(|[x, ..]| {
            let near = (-((x - middle) / (0.2 * middle)).powi(2)).exp();
            Vector1::new(30e6 + bump * near)
        })
        .collect();
    let contact = Contact::new(BoundaryPart::from(cells), LAW, 50e6)
        .with_state(
            Dieterich {
                slip_distance: 1e-3,
            },
            LogTheta(7.0),
        )
        .with_shear_stress(shear);
    Ok(Scene::of_fault(fault, Vector1::new(0.0))?.with_contact(contact))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// By explicit steps, and by implicit ones with the shipped matrix as a dense one.
    #[test]
    fn a_fault_of_ones_own_slips_as_the_shipped_one(
        count in 5_usize..24, length in 1.0..50.0_f64, bump in 1e6..4e6_f64,
    ) {
        let checked = || -> Outcome {
            let cells = Cells::new([0.0, count as f64 * length], count)?;
            let shipped = Fault::periodic(cells, ROCK, Mode::Antiplane)?;
            let own = Periodic { count, length };
            let steps = Steps::adaptive(1e-8).until(100.0);
            let mut a = RungeKutta::new(scene(&own, bump)?)?;
            let mut b = RungeKutta::new(scene(&shipped, bump)?)?;
            a.run(&steps, |_| ())?;
            b.run(&steps, |_| ())?;
            let scheme = GeneralizedAlpha::default();
            let mut c = Simulation::new(scene(&own, bump)?, scheme, DenseNewton::new())?;
            // An event amplifies the errors of the steps before it.
            c.run(&Steps::adaptive(1e-7).until(100.0), |_| ())?;
            let [a, b, c] = [a.snapshot(), b.snapshot(), c.snapshot()].map(|at| at.displacement.to_vec());
            let largest = b.iter().map(|u| u[0].abs()).fold(0.0, f64::max);
            assert!(largest > 1e-7, "{largest:e}");
            for (k, b) in b.iter().enumerate() {
                assert!((a[k] - b).amax() < 1e-6 * largest, "{k}: {} {b}", a[k]);
                assert!((c[k] - b).amax() < 1e-3 * largest, "{k}: {} {b}", c[k]);
            }
            Ok(())
        };
        checked().map_err(|error| TestCaseError::fail(error.to_string()))?;
    }
}
