//! Fields on faults of many cells, beside normal stress histories and between steppers.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, DippingFault, Fault, FaultGeometry, Medium, Sense};
use stickslip::fields::{FaultField, FaultRates, FieldError, FieldSizes, GivenPressure};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Contact, DenseNewton, GeneralizedAlpha, RungeKutta, Scene};
use stickslip::{Simulation, Steps};

use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.015,
    b: 0.010,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 0.01,
};
const NORMAL_STRESS: f64 = 50e6;
const COUNT: usize = 80;
const END: f64 = 2e6;

type Block = Contact<RegularizedDieterichRuina, Dieterich, 1>;

/// Injection in the middle of the fault: a pressure that grows and spreads [Pa].
fn injected(time: f64, k: usize) -> f64 {
    let x = (k as f64 + 0.5) / COUNT as f64 - 0.5;
    10e6 * (time / END) * (-(x / 0.15).powi(2)).exp()
}

/// Creep at 1e-9 m/s, in balance.
fn scene<G: FaultGeometry<1>>(
    fault: &G,
    with: impl FnOnce(Block) -> Block,
) -> Outcome<Scene<G::Kernel, 1>> {
    let part = BoundaryPart::from(FaultGeometry::cells(fault));
    let steady = (LAW.a - LAW.b).mul_add((1e-9_f64 / 1e-6).ln(), LAW.reference_friction);
    let contact = Contact::new(part, LAW, NORMAL_STRESS)
        .with_state(
            Dieterich {
                slip_distance: 0.01,
            },
            LogTheta(1e7_f64.ln()),
        )
        .with_shear_stress(Vector1::new(steady * NORMAL_STRESS));
    Ok(Scene::of_fault(fault, Vector1::new(1e-9))?.with_contact(with(contact)))
}

fn explicit<G: FaultGeometry<1>>(
    fault: &G,
    with: impl FnOnce(Block) -> Block,
) -> Outcome<Vec<Vector1<f64>>> {
    let mut motion = RungeKutta::new(scene(fault, with)?)?;
    motion.run(&Steps::adaptive(1e-7).until(END), |_| ())?;
    Ok(motion.snapshot().displacement.to_vec())
}

/// The largest difference as a share of the largest slip.
fn apart(a: &[Vector1<f64>], b: &[Vector1<f64>]) -> f64 {
    let largest = b.iter().map(|slip| slip.amax()).fold(0.0, f64::max);
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).amax());
    differences.fold(0.0, f64::max) / largest
}

fn pressed(contact: Block) -> Block {
    contact.with_field(GivenPressure::new(
        COUNT,
        0.0,
        |time, pressure: &mut [f64]| {
            for (k, pressure) in pressure.iter_mut().enumerate() {
                *pressure += injected(time, k);
            }
        },
    ))
}

fn relieved(contact: Block) -> Block {
    contact.with_normal_stress_history(|time, stress| {
        for (k, stress) in stress.iter_mut().enumerate() {
            *stress = NORMAL_STRESS - injected(time, k);
        }
    })
}

/// On a vertical fault, and on one whose slip changes the normal stress, too.
#[test]
fn a_given_pressure_is_a_normal_stress_history() -> Outcome {
    let vertical = Fault::half_space(Cells::new([0.0, 4e3], COUNT)?, ROCK)?;
    let cells = Cells::new([0.0, 4e3], COUNT)?;
    let dipping = DippingFault::new(cells, ROCK, 0.25, 40.0, Sense::Thrust)?;
    let all = [
        [
            explicit(&vertical, pressed)?,
            explicit(&vertical, relieved)?,
        ],
        [explicit(&dipping, pressed)?, explicit(&dipping, relieved)?],
    ];
    for [with_field, with_history] in &all {
        assert!(
            with_history.iter().any(|slip| slip[0] > 2.5e-3),
            "{with_history:?}"
        );
        let apart = apart(with_field, with_history);
        assert!(apart < 1e-5, "{apart:e}");
    }
    assert!(apart(&all[0][0], &all[1][0]) > 1e-3);
    Ok(())
}

/// Pressure that slip lowers, as dilatancy does, and that drains along the way.
struct Dilatant {
    fall: f64,
    time: f64,
}

impl FaultField for Dilatant {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: COUNT,
            memory: vec![0.0; COUNT],
            sources: COUNT,
        }
    }

    fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
        for (source, rate) in source.iter_mut().zip(at.slip_rate) {
            *source = -self.fall * rate;
        }
    }

    fn advance(
        &self,
        from: &[f64],
        [begin, end]: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let z = dt / self.time;
        let first = if z > 0.0 { -(-z).exp_m1() / z } else { 1.0 };
        let second = if z > 1e-3 {
            (1.0 - first) / z
        } else {
            0.5 - z / 6.0 + z * z / 24.0
        };
        for (k, to) in to.iter_mut().enumerate() {
            let source = first * begin[k] + second * (end[k] - begin[k]);
            *to = from[k] * (-z).exp() + dt * source;
        }
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        for (pressure, memory) in pressure.iter_mut().zip(memory) {
            *pressure += memory;
        }
    }
}

/// With injection beside, by explicit steps and by implicit ones with the dense matrix, on both faults.
#[test]
fn explicit_and_implicit_steps_agree() -> Outcome {
    let with = |contact: Block| {
        pressed(contact).with_field(Dilatant {
            fall: 1e9,
            time: 5e5,
        })
    };
    let cells = Cells::new([0.0, 4e3], COUNT)?;
    let dipping = DippingFault::new(cells, ROCK, 0.25, 40.0, Sense::Thrust)?;
    let expected = explicit(&dipping, with)?;
    let without = explicit(&dipping, pressed)?;
    assert!(apart(&without, &expected) > 1e-2);
    /// The same fault with a dense matrix.
    struct Dense<'a>(&'a DippingFault);
    impl FaultGeometry<1> for Dense<'_> {
        type Kernel = DMatrix<f64>;

        fn cells(&self) -> stickslip::bie::FaultCells {
            FaultGeometry::cells(self.0)
        }

        fn stiffness(&self) -> DMatrix<f64> {
            DMatrix::from(&self.0.stiffness())
        }

        fn radiation_damping(&self) -> DMatrix<f64> {
            DMatrix::from(&self.0.radiation_damping())
        }

        fn normal_stress_change(
            &self,
        ) -> Option<std::sync::Arc<dyn stickslip::NormalStressChange<1>>> {
            self.0.normal_stress_change()
        }
    }
    let scheme = GeneralizedAlpha::default();
    let mut implicit = Simulation::new(scene(&Dense(&dipping), with)?, scheme, DenseNewton::new())?;
    implicit.run(&Steps::adaptive(1e-5).until(END), |_| ())?;
    let found = implicit.snapshot().displacement.to_vec();
    let apart = apart(&found, &expected);
    assert!(apart < 1e-3, "{apart:e}");
    let contact = implicit.snapshot();
    let contact = contact.contact(0);
    let middle = COUNT / 2;
    assert!(contact.pore_pressure(middle) < injected(END, middle) - 1e5);
    Ok(())
}
