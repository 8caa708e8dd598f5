//! Laws that experiments are fitted with, in a spring slider.

use stickslip::friction::{DieterichRuina, FrictionLaw, TwoStates};
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringScene, SpringSlider};
use stickslip::state::{Dieterich, KatoTullis, LogTheta, PerrinRiceZheng, Reads, Ruina, StateLaw};
use stickslip::{
    BoundaryPart, Contact, Monolithic, Newmark, Point, RungeKutta, Scene, SceneError, Simulation,
    Snapshot, Steps,
};

use crate::Outcome;

/// The slip rates before and after a velocity step [m/s].
const RATES: [f64; 2] = [1e-6, 1e-5];
const STIFFNESS: f64 = 1e10;
const DAMPING: f64 = 5e6;
const NORMAL_STRESS: f64 = 1e6;

const COMPOSITE: KatoTullis = KatoTullis {
    slip_distance: FRICTION.slip_distance,
    aging_velocity: 1e-8,
};
const PERRIN: PerrinRiceZheng = PerrinRiceZheng {
    slip_distance: FRICTION.slip_distance,
};
/// Friction that compares contacts with `2L/V0`, the age of steady ones by the law above.
const OF_PERRIN: DieterichRuina = DieterichRuina {
    slip_distance: 2.0 * FRICTION.slip_distance,
    ..FRICTION
};

/// A block that slides steadily at the first rate and is pulled at the second.
fn stepped<L, S>(friction: L, law: S) -> Result<SpringScene, SceneError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let slider = SpringSlider {
        stiffness: STIFFNESS,
        normal_stress: NORMAL_STRESS,
        mass: 0.0,
        damping: DAMPING,
        load: LoadPath::steady(RATES[1]),
    };
    slider.steady(friction, law, RATES[0])
}

/// Slip in units of the slip distance, the logarithm of the slip rate, and the state.
fn numbers(at: Snapshot<'_, 1>) -> [f64; 3] {
    let contact = at.contact(0);
    [
        at.displacement[0][0] / FRICTION.slip_distance,
        contact.slip_rate(0).ln(),
        contact.state(0),
    ]
}

/// Ends where steady friction says, and the implicit method goes to the explicit one's limit with its order.
fn check<L, S>(friction: L, law: S) -> Outcome
where
    L: FrictionLaw + Copy + 'static,
    S: StateLaw + Copy + 'static,
    L::State: Reads<S::State>,
{
    let mut block = RungeKutta::new(stepped(friction, law)?)?;
    let before = block.snapshot().contact(0).coefficient(0);
    assert!((before - FRICTION.steady_coefficient(RATES[0])).abs() < 1e-12);
    block.run(&Steps::adaptive(1e-12).until(1.0), |_| ())?;
    let limit = numbers(block.snapshot());
    block.run(&Steps::adaptive(1e-8).until(200.0), |_| ())?;
    let steady = block.snapshot().contact(0).coefficient(0);
    assert!(
        (steady - FRICTION.steady_coefficient(RATES[1])).abs() < 1e-8,
        "{steady}"
    );

    let mut errors = Vec::new();
    for steps in [400, 800, 1600] {
        let mut block = Simulation::new(stepped(friction, law)?, Newmark::default(), Point)?
            .with_coupling(Monolithic::without_fallback())
            .with_absolute_tolerance(1e-14)?;
        block.run(&Steps::constant(1.0 / steps as f64).count(steps), |_| ())?;
        let end = numbers(block.snapshot());
        let distances = end.iter().zip(limit).map(|(a, b)| (a - b).abs());
        errors.push(distances.fold(0.0, f64::max));
    }
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{errors:?}");
    }
    Ok(())
}

#[test]
fn perrin_rice_and_zheng() -> Outcome {
    check(OF_PERRIN, PERRIN)
}

#[test]
fn kato_and_tullis() -> Outcome {
    check(FRICTION, COMPOSITE)
}

#[test]
fn nagata() -> Outcome {
    let (friction, law) = FRICTION.weakened_by_stress(2.0);
    check(friction, law)
}

const TWO: TwoStates = TwoStates {
    a: FRICTION.a,
    b: [0.012, 0.004],
    reference_friction: FRICTION.reference_friction,
    reference_velocity: FRICTION.reference_velocity,
    slip_distance: [1e-5, 1e-4],
};

/// The velocity step of a block with two states, which begin steady.
fn stepped_with_two<S: StateLaw<State = LogTheta> + 'static>(
    friction: TwoStates,
    laws: [S; 2],
) -> Result<Simulation<1>, SceneError> {
    let steady = friction
        .slip_distance
        .map(|l| LogTheta((l / RATES[0]).ln()));
    let pull = NORMAL_STRESS * friction.steady_coefficient(RATES[0]) + DAMPING * RATES[0];
    let mut scene = Scene::new(nalgebra::SMatrix::<f64, 1, 1>::new(STIFFNESS))
        .with_viscosity(nalgebra::SMatrix::<f64, 1, 1>::new(DAMPING))
        .with_load_history(|time, load| load[0][0] = STIFFNESS * RATES[1] * time)
        .with_displacement(vec![nalgebra::SVector::from([-pull / STIFFNESS])])
        .with_velocity(vec![nalgebra::SVector::from([RATES[0]])]);
    for ((part, law), state) in friction.parts().into_iter().zip(laws).zip(steady) {
        let contact = Contact::new(BoundaryPart::point(1.0), part, NORMAL_STRESS);
        scene = scene.with_contact(contact.with_state(law, state));
    }
    Simulation::new(scene, Newmark::default(), Point)?.with_absolute_tolerance(1e-14)
}

/// Two states of the same law are one.
#[test]
fn two_states_over_the_same_distance_are_one() -> Outcome {
    let same = TwoStates {
        b: [0.009, 0.006],
        slip_distance: [FRICTION.slip_distance; 2],
        ..TWO
    };
    let mut two = stepped_with_two(same, [AGING; 2])?;
    let mut one = Simulation::new(stepped(FRICTION, AGING)?, Newmark::default(), Point)?
        .with_absolute_tolerance(1e-14)?;
    for _ in 0..400 {
        one.step(2.5e-3)?;
        two.step(2.5e-3)?;
        let (one, two) = (one.snapshot(), two.snapshot());
        let difference = (one.velocity[0][0] / two.velocity[0][0]).ln().abs();
        assert!(difference < 1e-10, "{difference:e}");
        let mu = two.contact(0).coefficient(0) + two.contact(1).coefficient(0);
        assert!((mu - one.contact(0).coefficient(0)).abs() < 1e-12);
    }
    Ok(())
}

/// The two equations for the states and the balance of forces, integrated as they stand by the classical
/// Runge-Kutta method: slip, and the logarithms of `theta1` and `theta2`, after one second.
fn integrated(steps: usize) -> [f64; 3] {
    let rate = |time: f64, y: [f64; 3]| {
        let pull = STIFFNESS * (RATES[1] * time - y[0]);
        let old: f64 = (0..2)
            .map(|k| TWO.b[k] * (y[k + 1] + (TWO.reference_velocity / TWO.slip_distance[k]).ln()))
            .sum();
        // The forces grow with the rate.
        let (mut low, mut high) = (-60.0_f64, 0.0_f64);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let faster = middle - TWO.reference_velocity.ln();
            let mu = TWO.reference_friction + TWO.a * faster + old;
            if DAMPING * middle.exp() + NORMAL_STRESS * mu < pull {
                low = middle;
            } else {
                high = middle;
            }
        }
        high.exp()
    };
    let slope = |time: f64, y: [f64; 3]| {
        let v = rate(time, y);
        let ages = |k: usize| (-y[k]).exp() - v / TWO.slip_distance[k - 1];
        [v, ages(1), ages(2)]
    };
    let stretch = NORMAL_STRESS * TWO.steady_coefficient(RATES[0]) + DAMPING * RATES[0];
    let steady = TWO.slip_distance.map(|l| (l / RATES[0]).ln());
    let mut y = [-stretch / STIFFNESS, steady[0], steady[1]];
    let h = 1.0 / steps as f64;
    let along = |y: [f64; 3], h: f64, k: [f64; 3]| [0, 1, 2].map(|i| y[i] + h * k[i]);
    for n in 0..steps {
        let t = h * n as f64;
        let k1 = slope(t, y);
        let k2 = slope(t + 0.5 * h, along(y, 0.5 * h, k1));
        let k3 = slope(t + 0.5 * h, along(y, 0.5 * h, k2));
        let k4 = slope(t + h, along(y, h, k3));
        y = [0, 1, 2].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

#[test]
fn two_states_recover_over_two_distances() -> Outcome {
    let limit = integrated(20_000);
    let laws = TWO
        .slip_distance
        .map(|slip_distance| Dieterich { slip_distance });
    let mut errors = Vec::new();
    for steps in [400, 800, 1600] {
        let mut block = stepped_with_two(TWO, laws)?;
        block.run(&Steps::constant(1.0 / steps as f64).count(steps), |_| ())?;
        let at = block.snapshot();
        let slip = (at.displacement[0][0] - limit[0]).abs() / TWO.slip_distance[0];
        let states = [0, 1].map(|k| (at.contact(k).state(0) - limit[k + 1]).abs());
        errors.push(slip.max(states[0]).max(states[1]));
    }
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{errors:?}");
    }
    // Also by the slip law, and to steady friction in the end.
    let laws = TWO
        .slip_distance
        .map(|slip_distance| Ruina { slip_distance });
    let mut block = stepped_with_two(TWO, laws)?;
    block.run(&Steps::adaptive(1e-6).until(1e3), |_| ())?;
    let at = block.snapshot();
    let mu = at.contact(0).coefficient(0) + at.contact(1).coefficient(0);
    assert!((mu - TWO.steady_coefficient(RATES[1])).abs() < 1e-6, "{mu}");
    Ok(())
}
