//! A layer in antiplane shear with an exact solution by waves.
//!
//! Its height, density, friction and load are those of the slider of Pipping, Sander and Kornhuber (2015), and its shear
//! modulus is that of its material: the events of both compare.

use stickslip_fem::{P1, Trace, antiplane, mass};
use stickslip_friction::{DieterichRuina, FrictionLaw};
use stickslip_solvers::BlockMatrix;
use stickslip_state::{Dieterich, Reads, StateLaw, StateVariable};

use super::constant_rate::advance_exactly;
use crate::{Components, Scene, SceneError, StepError};

/// The friction law of the base.
pub const FRICTION: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};

/// The aging law of the base.
pub const AGING: Dieterich = Dieterich {
    slip_distance: 1e-5,
};

/// The initial value of `ln(theta / 1 s)`.
pub const INITIAL_LOG_THETA: f64 = -10.0;

/// The normal stress on the base \[Pa\].
pub const NORMAL_STRESS: f64 = 49_050.0;

/// The end of the experiment \[s\].
pub const END: f64 = 15.0;

/// The velocity of the driven side [m/s]: it grows linearly until `END / 4` and stays at `2e-4`.
pub fn load_velocity(time: f64) -> f64 {
    2e-4 * (4.0 * time / END).min(1.0)
}

/// A layer of 1 m with a driven top and a frictional base; the solution does not depend on the position along it.
///
/// With the impedance `Z = rho c_s` and the transit time `T1 = 1 m / c_s`, waves between top and base give the slip
/// rate `V` of the base by one scalar equation per time:
///
/// ```text
/// sigma_n mu(V, alpha) + Z V = 2 Z g'(t),   g'(t) = V_D(t - T1) - V(t - 2 T1) + g'(t - 2 T1)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AntiplaneLayer {
    /// Cells across the height of 1 m.
    pub cells: usize,
    /// Density [kg/m^3].
    pub density: f64,
    /// Shear modulus \[Pa\].
    pub shear_modulus: f64,
}

impl Default for AntiplaneLayer {
    fn default() -> Self {
        Self {
            cells: 64,
            density: 5e3,
            shear_modulus: 5e7 / 2.6,
        }
    }
}

/// The exact solution at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactSample {
    /// Time \[s\].
    pub time: f64,
    /// Slip rate of the base [m/s].
    pub slip_rate: f64,
    /// Displacement of the base \[m\].
    pub displacement: f64,
}

impl AntiplaneLayer {
    /// A strip of square cells across the layer, refined up to twice.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for no cells, or more than indices can count.
    pub fn space(&self) -> Result<P1<2>, SceneError> {
        let levels = self.cells.trailing_zeros().min(2) as usize;
        let coarse = self.cells >> levels;
        let width = 1.0 / coarse.max(1) as f64;
        Ok(P1::grid([width, 1.0], [1, coarse])?.refined(levels)?)
    }

    /// The frictional boundary: the base `y = 0`.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for a mesh of another body.
    pub fn base(space: &P1<2>) -> Result<Trace<2>, SceneError> {
        Ok(space.trace(|x| x[1] == 0.0)?)
    }

    /// The layer with a driven top, without its contact.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for material data out of range.
    pub fn scene(&self, space: &P1<2>) -> Result<Scene<BlockMatrix<1>, 1>, SceneError> {
        let top = space.trace(|x| x[1] == 1.0)?;
        Ok(Scene::new(antiplane(space, self.shear_modulus)?)
            .on(space)
            .with_mass(mass(space, self.density)?)
            .prescribe_velocity(&top, Components::ALL, |time| [load_velocity(time)]))
    }

    /// The exact solution with `transit_steps` time steps in `T1`, each shown to `observe`.
    ///
    /// The state is advanced exactly at the midpoint rate, so the error falls with the square of the step. The advance
    /// is by the closed form of the law, or by extrapolation to about `1e-12` without one.
    ///
    /// # Errors
    /// [`StepError::NotCoupled`] if rate and state do not agree in a step that is too large, and [`StepError::State`]
    /// where the state law has no solution.
    pub fn exact<L, S>(
        &self,
        friction: &L,
        law: &S,
        initial: S::State,
        transit_steps: usize,
        mut observe: impl FnMut(ExactSample),
    ) -> Result<(), StepError>
    where
        L: FrictionLaw,
        S: StateLaw,
        L::State: Reads<S::State>,
    {
        let wave_speed = (self.shear_modulus / self.density).sqrt();
        let viscosity = self.density * wave_speed / NORMAL_STRESS;
        let transit = 1.0 / wave_speed;
        let dt = transit / transit_steps as f64;
        let steps = (END / dt).ceil() as usize;
        // V and g' over the last two transits, the oldest first to be overwritten.
        let mut memory = vec![(0.0, 0.0); 2 * transit_steps];
        let (mut state, mut rate, mut displacement) = (initial, 0.0, 0.0);
        for n in 1..=steps {
            let time = n as f64 * dt;
            let slot = &mut memory[n % (2 * transit_steps)];
            let (old_rate, old_wave) = *slot;
            let wave = load_velocity((time - transit).max(0.0)) - old_rate + old_wave;
            let drive = 2.0 * viscosity * wave;
            let (mut next, mut advanced) = (rate, state);
            let mut change = f64::INFINITY;
            for _ in 0..MAX_ITERATIONS {
                let middle = 0.5 * (next + rate);
                advanced =
                    advance_exactly(law, state, middle, dt).map_err(|source| StepError::State {
                        vertex: 0,
                        slip_rate: middle,
                        source,
                    })?;
                let again = drive.signum()
                    * friction.slip_rate(viscosity, drive.abs(), L::State::read(advanced));
                change = (again - next).abs();
                next = again;
                if change <= 1e-13 * next.abs() {
                    break;
                }
            }
            let tolerance = 1e-9 * next.abs();
            if change.is_nan() || change > tolerance || !advanced.value().is_finite() {
                return Err(StepError::NotCoupled {
                    iterations: MAX_ITERATIONS,
                    change,
                    tolerance,
                });
            }
            displacement += 0.5 * dt * (rate + next);
            (rate, state) = (next, advanced);
            *slot = (rate, wave);
            observe(ExactSample {
                time,
                slip_rate: rate.abs(),
                displacement,
            });
        }
        Ok(())
    }
}

const MAX_ITERATIONS: usize = 100;
