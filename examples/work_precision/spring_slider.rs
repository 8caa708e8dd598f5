//! A block on a spring: stick-slip, and a velocity step.

use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::{
    Adaptive, BackwardEuler, ErrorControl, Newmark, Point, RungeKutta, Sdirk2, Simulation,
    StateUpdate, Stepper, WorkPrecision,
};

use crate::common::cli::Problem;
use crate::study::{Effort, Study};

/// A block that is pulled at 1 um/s and a little off steady sliding, or leaves it by a step.
struct Block {
    slider: SpringSlider,
    slip_rate: f64,
    until: f64,
}

#[derive(Clone, Copy)]
enum Way {
    RungeKutta,
    Newmark,
    /// With the state of backward Euler, as in the paper.
    Paper,
    BackwardEuler,
    Sdirk2,
}

#[derive(Clone, Copy)]
enum Steps {
    Constant,
    Adaptive(ErrorControl),
}

impl Block {
    fn stepper(&self, way: Way) -> Result<Box<dyn Stepper<1>>, Problem> {
        let state = steady_state(&AGING, 1e-6)?;
        let scene = self.slider.scene(FRICTION, AGING, self.slip_rate, state)?;
        Ok(match way {
            Way::RungeKutta => Box::new(RungeKutta::new(scene)?),
            Way::Newmark => Box::new(Simulation::new(scene, Newmark::default(), Point)?),
            Way::Paper => Box::new(
                Simulation::new(scene, Newmark::default(), Point)?
                    .with_state_update(StateUpdate::BackwardEuler),
            ),
            Way::BackwardEuler => Box::new(
                Simulation::new(scene, BackwardEuler, Point)?
                    .with_state_update(StateUpdate::BackwardEuler),
            ),
            Way::Sdirk2 => Box::new(Simulation::new(scene, Sdirk2, Point)?),
        })
    }

    /// `ln V` in the end, at a step size or tolerance.
    fn end(&self, way: Way, steps: Steps, setting: f64) -> Result<f64, Problem> {
        let mut block = self.stepper(way)?;
        match steps {
            Steps::Constant => {
                let steps = (self.until / setting).round() as usize;
                block.run(steps, setting, &mut |_| ())?;
            }
            Steps::Adaptive(control) => {
                Adaptive::new(setting)
                    .with_error_control(control)
                    .with_stops(self.slider.load.kinks())
                    .run(&mut *block, self.until, &mut |_| ())?;
            }
        }
        Ok(block.snapshot().velocity[0][0].ln())
    }

    fn compare(
        &self,
        effort: Effort,
        methods: &[(&str, Way, Steps, &[f64])],
    ) -> Result<WorkPrecision, Problem> {
        let doubled = Steps::Adaptive(ErrorControl::default());
        let reference = self.end(Way::RungeKutta, doubled, 1e-12)?;
        let mut table = WorkPrecision::against(reference).with_runs(effort.runs);
        for &(name, way, steps, settings) in methods {
            table = table.method(name, effort.settings(settings), |setting| {
                self.end(way, steps, setting)
            });
        }
        Ok(table)
    }
}

/// Stick-slip with three events.
pub(crate) fn stick_slip(effort: Effort) -> Result<Study, Problem> {
    let block = Block {
        slider: SpringSlider {
            stiffness: 2.5e8,
            normal_stress: 1e6,
            mass: 0.0,
            damping: 5e6,
            load: LoadPath::steady(1e-6),
        },
        slip_rate: 1.01e-6,
        until: 1200.0,
    };
    let doubled = Steps::Adaptive(ErrorControl::default());
    let levels = |levels| Steps::Adaptive(ErrorControl::extrapolated(levels));
    let all = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
    let table = block.compare(
        effort,
        &[
            ("Runge-Kutta", Way::RungeKutta, doubled, &all),
            (
                "Newmark, midpoint, doubled",
                Way::Newmark,
                doubled,
                &all[..5],
            ),
            (
                "Newmark, midpoint, extrapolated(2)",
                Way::Newmark,
                levels(2),
                &all[..7],
            ),
            (
                "Newmark, midpoint, extrapolated(3)",
                Way::Newmark,
                levels(3),
                &all,
            ),
            (
                "Newmark, midpoint, extrapolated(4)",
                Way::Newmark,
                levels(4),
                &all,
            ),
            ("Sdirk2, doubled", Way::Sdirk2, doubled, &all[..5]),
            ("Sdirk2, extrapolated(2)", Way::Sdirk2, levels(2), &all[..6]),
        ],
    )?;
    Ok(Study {
        name: "spring-slider",
        title: "stick-slip of a block on a spring, three events".into(),
        error: "error of ln V at 1200 s",
        targets: vec![1e-2, 1e-4, 1e-6],
        measurements: table.finish(),
    })
}

/// A velocity step, in the time in which friction evolves.
pub(crate) fn velocity_step(effort: Effort) -> Result<Study, Problem> {
    let block = Block {
        slider: SpringSlider {
            stiffness: 1e9,
            normal_stress: 1e6,
            mass: 0.0,
            damping: 5e6,
            load: LoadPath::steady(1e-5),
        },
        slip_rate: 1e-6,
        until: 2.0,
    };
    let adaptive = Steps::Adaptive(ErrorControl::default());
    let steps = [1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3];
    let tolerances = [1e-3, 1e-5, 1e-7, 1e-9];
    let constant = Steps::Constant;
    let table = block.compare(
        effort,
        &[
            ("Runge-Kutta", Way::RungeKutta, constant, &steps),
            ("Newmark, midpoint state", Way::Newmark, constant, &steps),
            (
                "Newmark, backward Euler state",
                Way::Paper,
                constant,
                &steps,
            ),
            ("backward Euler", Way::BackwardEuler, constant, &steps),
            ("Sdirk2", Way::Sdirk2, constant, &steps),
            (
                "Runge-Kutta, adaptive",
                Way::RungeKutta,
                adaptive,
                &tolerances,
            ),
            (
                "Newmark, midpoint state, adaptive",
                Way::Newmark,
                adaptive,
                &tolerances[..3],
            ),
        ],
    )?;
    Ok(Study {
        name: "velocity-step",
        title: "a block on a spring 2 s after a velocity step, constant steps".into(),
        error: "error of ln V at 2 s",
        targets: vec![1e-2, 1e-4, 1e-6],
        measurements: table.finish(),
    })
}
