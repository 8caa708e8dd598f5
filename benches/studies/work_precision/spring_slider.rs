//! A block on a spring: stick-slip, and a velocity step.

use stickslip::integrate::Stepper;
use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider, steady_state};
use stickslip::work_precision::{Measurement, WorkPrecision};
use stickslip::{
    BackwardEuler, ErrorControl, Newmark, Point, Run, RungeKutta, Sdirk2, Simulation, StateUpdate,
    Steps,
};
use stickslip_cli::cli::Problem;

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

/// A setting: the size of constant steps, or the tolerance of adaptive ones.
#[derive(Clone, Copy)]
enum Division {
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
    fn end(&self, way: Way, division: Division, setting: f64) -> Result<f64, Problem> {
        let steps = match division {
            Division::Constant => {
                Steps::constant(setting).count((self.until / setting).round() as usize)
            }
            Division::Adaptive(control) => Steps::adaptive(setting)
                .with_error_control(control)
                .stopping_at(self.slider.load.kinks())
                .until(self.until),
        };
        let mut block = self.stepper(way)?;
        block.run(&steps, |_| ())?;
        Ok(block.snapshot().velocity[0][0].ln())
    }

    /// The reference and the errors of all methods.
    fn compare(
        &self,
        effort: Effort,
        methods: &[(&str, Way, Division, &[f64])],
    ) -> Result<(f64, Vec<Measurement>), Problem> {
        let doubled = Division::Adaptive(ErrorControl::default());
        let reference = self.end(Way::RungeKutta, doubled, 1e-12)?;
        let mut table = WorkPrecision::against(reference).with_runs(effort.runs);
        for &(name, way, division, settings) in methods {
            table = table.method(name, effort.settings(settings), |setting| {
                self.end(way, division, setting)
            });
        }
        Ok((reference, table.finish()))
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
    let doubled = Division::Adaptive(ErrorControl::default());
    let levels = |levels| Division::Adaptive(ErrorControl::extrapolated(levels));
    let all = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
    let (reference, measurements) = block.compare(
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
            (
                "backward Euler, extrapolated(4)",
                Way::BackwardEuler,
                levels(4),
                &all,
            ),
            (
                "backward Euler, extrapolated(6)",
                Way::BackwardEuler,
                levels(6),
                &all,
            ),
            ("Sdirk2, doubled", Way::Sdirk2, doubled, &all[..5]),
            ("Sdirk2, extrapolated(2)", Way::Sdirk2, levels(2), &all[..6]),
        ],
    )?;
    Ok(Study {
        name: "spring-slider",
        reference: format!("ln(V / 1 m/s) = {reference:.10} at 1200 s"),
        error: "error of ln V at 1200 s",
        targets: vec![1e-2, 1e-4, 1e-6],
        measurements,
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
    let adaptive = Division::Adaptive(ErrorControl::default());
    let steps = [1e-1, 5e-2, 2e-2, 1e-2, 5e-3, 2e-3];
    let tolerances = [1e-3, 1e-5, 1e-7, 1e-9];
    let constant = Division::Constant;
    let (reference, measurements) = block.compare(
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
        reference: format!("ln(V / 1 m/s) = {reference:.10} at 2 s"),
        error: "error of ln V at 2 s",
        targets: vec![1e-2, 1e-4, 1e-6],
        measurements,
    })
}
