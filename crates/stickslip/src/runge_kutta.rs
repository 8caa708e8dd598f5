//! Rate and state as an ordinary differential equation: an explicit Runge-Kutta method of order 5.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{ConvexPotential, FrictionLaw};
use stickslip_state::{StateLaw, StateVariable};

use crate::accepted::Accepted;
use crate::checks::{check, check_explicit};
use crate::interface::conversion_slope;
use crate::local_error::difference;
use crate::prediction::fill_load;
use crate::scene::Scene;
use crate::{
    ErrorControl, Failure, InterfaceLaw, InterfacePotential, SceneError, Snapshot, StepError,
    StepReport, Stepper,
};

/// A scene of one vertex without inertia, integrated as the differential equation
///
/// ```text
/// u' = v(u, alpha, t),   alpha' = g(alpha, abs(v)),   where  C v + friction(v, alpha) = l(t) - A u
/// ```
///
/// by the method of Dormand and Prince of order 5 with its error estimate of order 4 (J. Dormand,
/// P. Prince, J. Comput. Appl. Math. 6 (1980)). The slip rate is the closed form of the local
/// problem; nothing is iterated. With [`Adaptive`](crate::Adaptive) this was measured to be the
/// fastest way through the earthquake cycles of a spring slider at any accuracy; an implicit
/// [`Simulation`](crate::Simulation) is the choice for fixed steps, inertia and stiff states.
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{Adaptive, RungeKutta, Stepper};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let slider = SpringSlider {
///     stiffness: 2.5e8,
///     normal_stress: 1e6,
///     mass: 0.0,
///     damping: 5e6,
///     load: LoadPath::steady(1e-6),
/// };
/// let mut cycle = RungeKutta::new(slider.steady(FRICTION, AGING, 1.1e-6)?)?;
/// let mut peak: f64 = 0.0;
/// let report = Adaptive::new(1e-5).run(&mut cycle, 600.0, &mut |at| {
///     peak = peak.max(at.max_slip_rate());
/// })?;
/// assert!(peak > 1e-3 && report.accepted < 500);
/// # Ok(())
/// # }
/// ```
pub struct RungeKutta<L: FrictionLaw, S: StateLaw, const C: usize>
where
    L::State: From<S::State>,
{
    scene: Scene<SMatrix<f64, C, C>, L, S, C>,
    viscosity: SMatrix<f64, C, C>,
    potential: InterfacePotential<L, S>,
    now: Accepted<S::State, C>,
    last: Accepted<S::State, C>,
    /// `(u', alpha')` at the stages of the last step. The last of them is the first of the next.
    slopes: [(SVector<f64, C>, f64); STAGES],
    accepted: bool,
}

const STAGES: usize = 7;
/// The times of the stages, and the weights of the slopes before each; the last row is the step.
const NODES: [f64; STAGES] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const WEIGHTS: [[f64; STAGES - 1]; STAGES] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// The weights of the step minus those of the embedded method of order 4.
const ERROR: [f64; STAGES] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

impl<L, S, const C: usize> RungeKutta<L, S, C>
where
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
{
    /// Checks the scene and computes its first slip rate.
    ///
    /// # Errors
    /// [`SceneError`]; [`SceneError::Explicit`] for a scene with mass, without friction, or with held
    /// or moved components.
    pub fn new(scene: Scene<SMatrix<f64, C, C>, L, S, C>) -> Result<Self, SceneError> {
        check(&scene)?;
        check_explicit(&scene)?;
        let state = *scene.state.initial.at(0);
        let zero = || vec![SVector::zeros()];
        let displacement = if scene.initial.displacement.is_empty() {
            zero()
        } else {
            scene.initial.displacement.clone()
        };
        let weight = scene.friction.patch.as_ref().map_or(0.0, |p| p.weights[0]);
        let now = Accepted {
            clock: crate::clock::Clock::default(),
            displacement,
            velocity: zero(),
            acceleration: Vec::new(),
            carried: Vec::new(),
            states: vec![state],
            earlier: Vec::new(),
            last_step: 0.0,
            report: StepReport::default(),
        };
        let mut integrator = Self {
            viscosity: scene.viscosity.unwrap_or_else(SMatrix::zeros),
            potential: InterfaceLaw::potential_of(&scene, 0, weight, state),
            last: now.clone(),
            now,
            slopes: [(SVector::zeros(), 0.0); STAGES],
            accepted: false,
            scene,
        };
        let (u, state) = (integrator.now.displacement[0], state.value());
        let start = integrator.slope(0.0, u, state);
        integrator.slopes[0] = start.map_err(|_| SceneError::Explicit {
            requirement: "a finite slip rate at time zero",
        })?;
        integrator.now.velocity[0] = integrator.slopes[0].0;
        Ok(integrator)
    }

    /// `(v, g)` at a time, displacement and state.
    fn slope(
        &mut self,
        time: f64,
        u: SVector<f64, C>,
        state: f64,
    ) -> Result<(SVector<f64, C>, f64), StepError> {
        let mut force = [SVector::zeros()];
        fill_load(&self.scene.load, time, &mut force);
        let drive = force[0] - self.scene.stiffness * u;
        let law = &mut self.potential.law;
        if let Some(history) = &self.scene.friction.stress_history {
            let mut stress = [*self.scene.friction.normal_stress.at(0)];
            history(time, &mut stress);
            law.normal_stress = stress[0].abs();
        }
        law.state = S::State::from_value(state);
        let v: SVector<f64, C> = self.potential.minimize(&self.viscosity, &drive);
        let slip_rate = v.norm();
        let evolution = self
            .scene
            .state
            .law
            .at(0)
            .evolution(S::State::from_value(state), slip_rate);
        // A maximum with zero, as in Tresca's law, forgets what is not a number.
        let given = drive.norm() + self.potential.law.normal_stress;
        if given.is_finite() && slip_rate.is_finite() && evolution.is_finite() {
            Ok((v, evolution))
        } else {
            Err(StepError::Stage {
                time,
                slip_rate,
                state,
                evolution,
            })
        }
    }

    /// One step; returns the differences of displacement and state to the method of order 4.
    fn advance(&mut self, dt: f64) -> Result<(SVector<f64, C>, f64), Failure> {
        let next = self.now.clock.after(dt);
        let failure = |cause| Failure {
            step: next.step,
            time: next.time(),
            cause,
        };
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(failure(StepError::StepSize { dt }));
        }
        let (time, u, state) = (
            self.now.clock.time(),
            self.now.displacement[0],
            self.now.states[0].value(),
        );
        if std::mem::take(&mut self.accepted) {
            self.slopes[0] = self.slopes[STAGES - 1];
        }
        let (mut to, mut to_state) = (u, state);
        for stage in 1..STAGES {
            (to, to_state) = (u, state);
            for (weight, slope) in WEIGHTS[stage][..stage].iter().zip(&self.slopes) {
                to += slope.0 * (weight * dt);
                to_state += slope.1 * (weight * dt);
            }
            let at = if stage + 1 < STAGES {
                time + NODES[stage] * dt
            } else {
                next.time()
            };
            self.slopes[stage] = self.slope(at, to, to_state).map_err(failure)?;
        }
        let (mut error, mut state_error) = (SVector::zeros(), 0.0);
        for (weight, slope) in ERROR.iter().zip(&self.slopes) {
            error += slope.0 * (weight * dt);
            state_error += slope.1 * (weight * dt);
        }
        self.last.copy_from(&self.now);
        self.now.clock = next;
        self.now.displacement[0] = to;
        self.now.states[0] = S::State::from_value(to_state);
        self.now.velocity[0] = self.slopes[STAGES - 1].0;
        self.now.report = StepReport {
            coupling_iterations: STAGES - 1,
            solver_iterations: STAGES - 1,
            ..StepReport::default()
        };
        self.accepted = true;
        Ok((error, state_error))
    }
}

impl<L, S, const C: usize> Stepper<C> for RungeKutta<L, S, C>
where
    L: FrictionLaw + Clone,
    S: StateLaw + Clone,
    L::State: From<S::State>,
{
    fn step(&mut self, dt: f64) -> Result<StepReport, Failure> {
        self.advance(dt)?;
        Ok(self.now.report)
    }

    /// One step, and its difference to the embedded method of order 4 in the slip rate and the state;
    /// levels and extrapolation do not apply.
    fn step_estimated(&mut self, dt: f64, control: &ErrorControl) -> Result<f64, Failure> {
        let (error, state_error) = self.advance(dt)?;
        let v = self.now.velocity[0];
        // By how much the slip rate follows an error of displacement and state: the local problem,
        // linearised.
        let slip_rate = v.norm();
        let state = self.now.states[0];
        let law = &self.potential.law;
        let weakening = self.potential.force
            * law.normal_stress
            * law
                .friction
                .coefficient_state_slope(slip_rate, state.into())
            * conversion_slope::<S::State, L::State>(state);
        let mut drive = -(self.scene.stiffness * error);
        if slip_rate > 0.0 {
            drive -= v * (weakening * state_error / slip_rate);
        }
        let resistance = self.viscosity + self.potential.local_model(&v).hessian;
        let deviation = match resistance.cholesky() {
            Some(factor) => factor.solve(&drive),
            // It sticks.
            None => SVector::zeros(),
        };
        let other = S::State::from_value(state.value() - state_error);
        let floor = control.slip_rate_floor;
        Ok(difference((v, v - deviation), (state, other), floor))
    }

    fn order(&self) -> usize {
        5
    }

    fn error_order(&self, _control: &ErrorControl) -> usize {
        5
    }

    fn undo(&mut self) {
        self.now.copy_from(&self.last);
        self.accepted = false;
    }

    fn time_left(&self, until: f64) -> f64 {
        self.now.clock.left(until)
    }

    fn snapshot(&self) -> Snapshot<'_, C> {
        Snapshot {
            step: self.now.clock.step,
            time: self.now.clock.time(),
            displacement: &self.now.displacement,
            velocity: &self.now.velocity,
            acceleration: &[],
            frictional: &[0],
            states: &self.now.states,
            report: self.now.report,
        }
    }
}
