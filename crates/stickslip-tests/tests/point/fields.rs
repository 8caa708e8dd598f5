//! Fields on a fault: one that is written here, beside equations solved here.

use nalgebra::{Matrix1, Vector1};
use stickslip::fields::{FaultField, FaultRates, FieldError, FieldSizes, GivenPressure};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::integrate::StepReport;
use stickslip::state::{Dieterich, LogTheta, StateLaw};
use stickslip::{
    BoundaryPart, Contact, GeneralizedAlpha, Point, RungeKutta, Scene, SceneError, Simulation,
    StepState, Steps,
};

use crate::Outcome;

const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.015,
    b: 0.010,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-4,
};
const AGING: Dieterich = Dieterich {
    slip_distance: 1e-4,
};
const NORMAL_STRESS: f64 = 1e6;
const STIFFNESS: f64 = 2e8;
const DAMPING: f64 = 5e6;
const VELOCITY: f64 = 1e-4;
const END: f64 = 8.0;

/// The pressure of a drained layer, `p' = C V - p/t_d`.
#[derive(Clone, Copy)]
struct Drained {
    rise: f64,
    time: f64,
}

const DRAINED: Drained = Drained {
    rise: 3e8,
    time: 5.0,
};

impl FaultField for Drained {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: 1,
            memory: vec![0.0],
            sources: 1,
        }
    }

    fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
        source[0] = self.rise * at.slip_rate[0];
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
        to[0] = from[0] * (-z).exp() + dt * (first * begin[0] + second * (end[0] - begin[0]));
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        pressure[0] += memory[0];
    }
}

/// A block at `V_0`, whose load grows tenfold faster.
fn scene(fields: Vec<Box<dyn FnOnce(Block) -> Block>>) -> Scene<Matrix1<f64>, 1> {
    let steady = LogTheta((LAW.slip_distance / 1e-6).ln());
    let mut contact = Contact::new(BoundaryPart::point(1.0), LAW, NORMAL_STRESS)
        .with_state(AGING, steady)
        .with_shear_stress(Vector1::new(0.6 * NORMAL_STRESS));
    for field in fields {
        contact = field(contact);
    }
    Scene::new(Matrix1::new(STIFFNESS))
        .with_viscosity(Matrix1::new(DAMPING))
        .with_contact(contact)
        .with_load_history(|time, load| load[0][0] = STIFFNESS * VELOCITY * time)
}

type Block = Contact<RegularizedDieterichRuina, Dieterich, 1>;

fn drained() -> Scene<Matrix1<f64>, 1> {
    scene(vec![Box::new(|contact: Block| contact.with_field(DRAINED))])
}

/// The slip, the state and the pressure by the classical method of order 4, with slip rates by bisection.
fn reference(steps: usize) -> [f64; 3] {
    let rates = |time: f64, [u, alpha, p]: [f64; 3]| -> [f64; 3] {
        let drive = 0.6 * NORMAL_STRESS + STIFFNESS * (VELOCITY * time - u);
        let excess = |v: f64| {
            DAMPING * v + (NORMAL_STRESS - p) * LAW.coefficient(v, LogTheta(alpha)) - drive
        };
        let [mut low, mut high] = [1e-30_f64.ln(), 1.0_f64.ln()];
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if excess(middle.exp()) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let v = low.exp();
        let p_rate = DRAINED.rise * v - p / DRAINED.time;
        [v, AGING.evolution(LogTheta(alpha), v), p_rate]
    };
    let dt = END / steps as f64;
    let mut y = [0.0, (LAW.slip_distance / 1e-6).ln(), 0.0];
    let along =
        |y: [f64; 3], k: [f64; 3], h: f64| -> [f64; 3] { std::array::from_fn(|i| y[i] + h * k[i]) };
    for n in 0..steps {
        let t = n as f64 * dt;
        let k1 = rates(t, y);
        let k2 = rates(t + 0.5 * dt, along(y, k1, 0.5 * dt));
        let k3 = rates(t + 0.5 * dt, along(y, k2, 0.5 * dt));
        let k4 = rates(t + dt, along(y, k3, dt));
        y = std::array::from_fn(|i| y[i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    y
}

fn numbers(state: &StepState<1>) -> [f64; 3] {
    let contact = &state.contacts[0];
    [
        state.displacement[0][0],
        contact.states[0],
        contact.pore_pressure[0],
    ]
}

/// The largest of the errors, each as a share of what it is of.
fn error(found: [f64; 3], expected: [f64; 3]) -> f64 {
    let scales = [expected[0], 1.0, expected[2]];
    let shares = (0..3).map(|i| ((found[i] - expected[i]) / scales[i]).abs());
    shares.fold(0.0, f64::max)
}

#[test]
fn both_steppers_are_of_second_order_at_least() -> Outcome {
    let expected = reference(20_000);
    assert!(expected[2] > 0.1 * NORMAL_STRESS, "{expected:?}");
    assert!(error(reference(10_000), expected) < 1e-9);
    let (mut implicit, mut explicit) = (Vec::new(), Vec::new());
    for count in [200.0, 400.0, 800.0] {
        let steps = Steps::constant(END / count).until(END);
        let mut simulation = Simulation::new(drained(), GeneralizedAlpha::default(), Point)?;
        let report = simulation.run(&steps, |_| ())?;
        assert_eq!(report.accepted, count as usize);
        implicit.push(error(numbers(simulation.state()), expected));
        let steps = Steps::constant(END / (4.0 * count)).until(END);
        let mut integrator = RungeKutta::new(drained())?;
        integrator.run(&steps, |_| ())?;
        explicit.push(error(numbers(integrator.snapshot().state()), expected));
    }
    for (errors, order) in [(&implicit, 1.8), (&explicit, 1.8)] {
        let orders: Vec<f64> = errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect();
        assert!(
            orders.iter().all(|&found| found > order),
            "{errors:?} {orders:?}"
        );
    }
    assert!(
        implicit[2] < 1e-3 && explicit[2] < 1e-5,
        "{implicit:?} {explicit:?}"
    );
    Ok(())
}

#[test]
fn the_error_follows_the_tolerance() -> Outcome {
    let expected = reference(20_000);
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let steps = Steps::adaptive(tolerance).until(END);
        let mut integrator = RungeKutta::new(drained())?;
        let report = integrator.run(&steps, |_| ())?;
        let explicit = error(numbers(integrator.snapshot().state()), expected);
        assert!(
            explicit < 30.0 * tolerance,
            "{tolerance}: {explicit:e}, {report:?}"
        );
    }
    let mut simulation = Simulation::new(drained(), GeneralizedAlpha::default(), Point)?;
    simulation.run(&Steps::adaptive(1e-5).until(END), |_| ())?;
    let implicit = error(numbers(simulation.state()), expected);
    assert!(implicit < 1e-3, "{implicit:e}");
    Ok(())
}

#[test]
fn a_run_goes_on_with_the_same_bits() -> Outcome {
    let (first, rest) = (
        Steps::adaptive(1e-6).until(0.5 * END),
        Steps::adaptive(1e-6).until(END),
    );
    let mut whole = RungeKutta::new(drained())?;
    whole.run(&first, |_| ())?;
    let kept = whole.snapshot().state().clone();
    whole.run(&rest, |_| ())?;
    let mut again = RungeKutta::new(drained())?;
    stickslip::integrate::Stepper::restore(&mut again, &kept)?;
    again.run(&rest, |_| ())?;
    assert_eq!(again.snapshot().state(), whole.snapshot().state());
    let made = || Simulation::new(drained(), GeneralizedAlpha::default(), Point);
    let (mut whole, mut again) = (made()?, made()?);
    whole.run(&first, |_| ())?;
    again.restore(whole.state())?;
    whole.run(&rest, |_| ())?;
    again.run(&rest, |_| ())?;
    assert_eq!(again.state(), whole.state());
    Ok(())
}

/// A pressure in closed form is a normal stress history, and two pressures add.
#[test]
fn given_pressures_add_to_a_normal_stress_history() -> Outcome {
    let given = |share: f64| -> Box<dyn FnOnce(Block) -> Block> {
        Box::new(move |contact: Block| {
            contact.with_field(GivenPressure::new(
                1,
                0.0,
                move |time, pressure: &mut [f64]| {
                    pressure[0] += share * 4e4 * time;
                },
            ))
        })
    };
    let history: Box<dyn FnOnce(Block) -> Block> = Box::new(|contact: Block| {
        contact.with_normal_stress_history(|time, stress| stress[0] = NORMAL_STRESS - 4e4 * time)
    });
    let steps = Steps::adaptive(1e-7).until(END);
    let mut with_fields = RungeKutta::new(scene(vec![given(0.25), given(0.75)]))?;
    let mut with_history = RungeKutta::new(scene(vec![history]))?;
    with_fields.run(&steps, |_| ())?;
    with_history.run(&steps, |_| ())?;
    let [a, b] = [&with_fields, &with_history].map(|own| own.snapshot().displacement[0][0]);
    assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    let at = with_fields.snapshot();
    let contact = at.contact(0);
    assert!((contact.pore_pressure(0) - 4e4 * END).abs() < 1e-6);
    assert!((contact.normal_stress(0) - NORMAL_STRESS).abs() < 1e-6);
    assert!((contact.effective_normal_stress(0) - NORMAL_STRESS + 4e4 * END).abs() < 1e-6);
    let mut implicit =
        Simulation::new(scene(vec![given(1.0)]), GeneralizedAlpha::default(), Point)?;
    implicit.run(&Steps::adaptive(1e-6).until(END), |_| ())?;
    let c = implicit.snapshot().displacement[0][0];
    assert!((c / b - 1.0).abs() < 1e-4, "{c} {b}");
    Ok(())
}

/// A pressure beyond the normal stress is a tension with its number, and a field of other vertices is refused.
#[test]
fn what_a_fault_cannot_bear_is_refused() -> Outcome {
    let risen: Box<dyn FnOnce(Block) -> Block> = Box::new(|contact: Block| {
        contact.with_field(GivenPressure::new(1, 0.0, |time, pressure: &mut [f64]| {
            pressure[0] += 5e5 * time;
        }))
    });
    let mut block = RungeKutta::new(scene(vec![risen]))?;
    let failure = block.run(&Steps::adaptive(1e-6).until(END), |_| ()).err();
    let failure = failure.ok_or("a tension was accepted")?.to_string();
    assert!(
        failure.contains("tension") || failure.contains("normal stress"),
        "{failure}"
    );
    let other: Box<dyn FnOnce(Block) -> Block> = Box::new(|contact: Block| {
        contact.with_field(GivenPressure::new(2, 0.0, |_, _: &mut [f64]| ()))
    });
    let refused = RungeKutta::new(scene(vec![other])).err();
    let length = SceneError::Length {
        what: "field on a contact",
        expected: 1,
        found: 2,
    };
    assert_eq!(refused, Some(length));
    Ok(())
}

/// Limits of the normal stress hold, and are counted, without a field, too, in both kinds of steps.
#[test]
fn limits_of_the_normal_stress_are_counted() -> Outcome {
    let of = |sign: f64, change: fn(Block, f64) -> Block| {
        let limit = (1.0 + 0.1 * sign) * NORMAL_STRESS;
        let given = move |time: f64| NORMAL_STRESS + sign * 5e4 * time;
        let limited: Box<dyn FnOnce(Block) -> Block> = Box::new(move |contact: Block| {
            let contact =
                contact.with_normal_stress_history(move |time, stress| stress[0] = given(time));
            change(contact, limit)
        });
        let borne = move |time: f64| {
            if sign < 0.0 {
                given(time).max(limit)
            } else {
                given(time).min(limit)
            }
        };
        (limited, borne, limit)
    };
    let steps = Steps::constant(END / 400.0).until(END);
    for (sign, change) in [
        (
            -1.0,
            Block::with_least_normal_stress as fn(Block, f64) -> Block,
        ),
        (1.0, Block::with_largest_normal_stress),
    ] {
        let (limited, borne, limit) = of(sign, change);
        let held: Box<dyn FnOnce(Block) -> Block> = Box::new(move |contact: Block| {
            contact.with_normal_stress_history(move |time, stress| stress[0] = borne(time))
        });
        let counted = |at: &StepReport| {
            if sign < 0.0 {
                [at.at_least_normal_stress, at.at_largest_normal_stress]
            } else {
                [at.at_largest_normal_stress, at.at_least_normal_stress]
            }
        };
        let expected = |time: f64| [usize::from(borne(time) == limit), 0];
        let (mut explicit, mut other) = (
            RungeKutta::new(scene(vec![limited]))?,
            RungeKutta::new(scene(vec![held]))?,
        );
        explicit.run(&steps, |at| {
            assert_eq!(counted(&at.report), expected(at.time));
            assert_eq!(at.contact(0).effective_normal_stress(0), borne(at.time));
        })?;
        assert_eq!(expected(END), [1, 0]);
        other.run(&steps, |_| ())?;
        let [a, b] = [&explicit, &other].map(|own| own.snapshot().displacement[0]);
        assert_eq!(a, b);
        let (limited, ..) = of(sign, change);
        let mut implicit =
            Simulation::new(scene(vec![limited]), GeneralizedAlpha::default(), Point)?;
        implicit.run(&steps, |at| {
            assert_eq!(counted(&at.report), expected(at.time))
        })?;
    }
    // A cap below the floor is none.
    let crossed: Box<dyn FnOnce(Block) -> Block> = Box::new(|contact: Block| {
        contact
            .with_least_normal_stress(2e6)
            .with_largest_normal_stress(1e6)
    });
    let refused = RungeKutta::new(scene(vec![crossed])).err();
    assert!(
        matches!(refused, Some(SceneError::Value { value: 1e6, .. })),
        "{refused:?}"
    );
    Ok(())
}
