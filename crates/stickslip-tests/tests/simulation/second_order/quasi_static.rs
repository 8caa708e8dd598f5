//! Sliders without inertia, against an explicit integration of high order.

use stickslip::problems::spring_slider::{AGING, FRICTION, steady_state};
use stickslip::state::{LogTheta, Ruina, StateLaw};
use stickslip::{
    BackwardEuler, Newmark, Point, RateScheme, RungeKutta, Sdirk2, Simulation, StateUpdate, Steps,
};

use super::{Motion, UNTIL, apart, disturbed, motion};
use crate::Outcome;

const RUINA: Ruina = Ruina {
    slip_distance: 1e-5,
};

/// A law of which only the right-hand side is known.
#[derive(Debug, Clone, Copy)]
struct Hidden<S>(S);

impl<S: StateLaw> StateLaw for Hidden<S> {
    type State = S::State;

    fn evolution(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution(state, slip_rate)
    }

    fn evolution_state_slope(&self, state: S::State, slip_rate: f64) -> f64 {
        self.0.evolution_state_slope(state, slip_rate)
    }
}

/// The ratios of the errors against `exact` for steps that are halved twice from `UNTIL/steps`.
fn ratios<S, R>(
    law: &S,
    scheme: R,
    state_update: StateUpdate,
    steps: usize,
    exact: Motion,
) -> Outcome<[f64; 2]>
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
    R: RateScheme + Clone + 'static,
{
    let error = |steps: usize| -> Outcome<f64> {
        let scene = disturbed(0.0).scene(FRICTION, law.clone(), 3e-6, steady_state(law, 1e-6)?)?;
        let mut block =
            Simulation::new(scene, scheme.clone(), Point)?.with_state_update(state_update);
        block.run(&Steps::constant(UNTIL / steps as f64).count(steps), |_| ())?;
        Ok(apart(motion(block.snapshot()), exact))
    };
    let errors = [error(steps)?, error(2 * steps)?, error(4 * steps)?];
    assert!(errors[0] < 0.1, "{errors:?}");
    Ok([errors[0] / errors[1], errors[1] / errors[2]])
}

fn explicit<S>(law: &S) -> Outcome<Motion>
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
{
    let scene = disturbed(0.0).scene(FRICTION, law.clone(), 3e-6, steady_state(law, 1e-6)?)?;
    let mut block = RungeKutta::new(scene)?;
    block.run(&Steps::adaptive(1e-12).until(UNTIL), |_| ())?;
    Ok(motion(block.snapshot()))
}

fn has_second_order<S>(law: S) -> Outcome
where
    S: StateLaw<State = LogTheta> + Clone + 'static,
{
    let exact = explicit(&law)?;
    for ratio in ratios(&law, Newmark::default(), StateUpdate::Midpoint, 400, exact)? {
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
    }
    // The method of two stages has its own way with the state.
    for ratio in ratios(&law, Sdirk2, StateUpdate::BackwardEuler, 400, exact)? {
        assert!((3.8..4.2).contains(&ratio), "{ratio}");
    }
    Ok(())
}

#[test]
fn the_midpoint_state_has_second_order() -> Outcome {
    has_second_order(AGING)?;
    has_second_order(RUINA)
}

/// Without a closed form the state takes an L-stable rule of second order.
#[test]
fn laws_without_a_closed_form_have_second_order() -> Outcome {
    has_second_order(Hidden(AGING))?;
    has_second_order(Hidden(RUINA))
}

/// Whatever the scheme for the displacement.
#[test]
fn the_backward_euler_state_has_first_order() -> Outcome {
    let exact = explicit(&AGING)?;
    for ratio in ratios(
        &AGING,
        Newmark::default(),
        StateUpdate::BackwardEuler,
        1600,
        exact,
    )? {
        assert!((1.9..2.1).contains(&ratio), "{ratio}");
    }
    for ratio in ratios(&AGING, BackwardEuler, StateUpdate::Midpoint, 1600, exact)? {
        assert!((1.9..2.1).contains(&ratio), "{ratio}");
    }
    Ok(())
}
