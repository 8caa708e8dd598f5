//! Whether a step is one: what is left of its equations, beside what may be left.

use nalgebra::SVector;
use stickslip::friction::modulus;
use stickslip::{LinearSolver, Operator, Residuals, Simulation, StepState};

use crate::accuracy::{Accuracy, Entries, add_friction_range, frictional, typed};
use crate::case::Refusal;

/// Roundings of the terms of an equation that its residual may have.
pub(crate) const ROUNDINGS: f64 = 64.0;
/// Those of displacement, acceleration and state, which take a few operations each.
const FEW_ROUNDINGS: f64 = 16.0;

/// The equations of a scene, and what may be left of them.
pub(crate) struct Check<Op, const C: usize> {
    /// The load at a time, one vector a vertex \[N\].
    load: Box<dyn Fn(f64) -> Vec<SVector<f64, C>>>,
    accuracy: Accuracy<Op>,
    /// The largest rows of `A`, `M` and `C`.
    rows: [f64; 3],
}

impl<Op: Operator<C> + Entries, const C: usize> Check<Op, C> {
    /// Of a simulation with the tolerance of the paper, under this load.
    pub(crate) fn of(
        simulation: &Simulation<C>,
        load: impl Fn(f64) -> Vec<SVector<f64, C>> + 'static,
        solver: &mut dyn LinearSolver<Op, C>,
    ) -> Result<Self, Refusal> {
        let mass = simulation.mass().map(typed::<Op::Mass, C>).transpose()?;
        let mass = mass.map(|mass| Op::combination_with(&[], Some((1.0, mass))));
        let viscosity = simulation.viscosity().map(typed).transpose()?;
        let row = |operator: Option<&Op>| operator.map_or(0.0, Entries::largest_row);
        Ok(Self {
            load: Box::new(load),
            accuracy: Accuracy::of(simulation, solver)?,
            rows: [
                row(Some(typed(simulation.stiffness())?)),
                row(mass.as_ref()),
                row(viscosity),
            ],
        })
    }

    /// The same for another absolute tolerance of the coupling.
    pub(crate) fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.accuracy.tolerance = tolerance;
        self
    }

    /// The admissible error of a component of the velocity after the last step [m/s].
    pub(crate) fn deviation(&self, simulation: &Simulation<C>, from: &StepState<C>) -> f64 {
        self.accuracy.deviation([from, simulation.state()])
    }

    /// The residual of the last step's forces over its bound, or the defect.
    ///
    /// The library's own residuals are held against those of this program, vertex by vertex.
    pub(crate) fn step(
        &self,
        simulation: &mut Simulation<C>,
        from: &StepState<C>,
    ) -> Result<f64, String> {
        let now = simulation.state().clone();
        let step = now.clock.step();
        if !is_finite(&now) {
            return Err(format!("step {step}: a result that is not finite"));
        }
        let mut residuals = simulation.residuals(from);
        if now.report.damped {
            // Of two half steps forces alone are known.
            (residuals.displacement, residuals.state) = (0.0, 0.0);
            residuals.acceleration = 0.0;
        }
        let terms = Terms::of(from, &now);
        terms.check(&residuals, step)?;
        let rounding = ROUNDINGS * f64::EPSILON * self.force_terms(&terms, &residuals);
        let left = self.forces_left(simulation);
        let largest = left.iter().copied().fold(0.0, f64::max);
        if (largest - residuals.force).abs() > rounding {
            let by_library = residuals.force;
            return Err(format!(
                "step {step}: residual {largest:e} N, by the library {by_library:e} N"
            ));
        }
        let deviation = self.deviation(simulation, from);
        let operator: &Op = typed(simulation.operator()).map_err(|error| error.to_string())?;
        let everywhere = rounding + deviation * operator.largest_row();
        let mut allowed = vec![everywhere; left.len()];
        add_friction_range(simulation, from, deviation, &mut allowed)?;
        worst_share(&left, &allowed).map_err(|text| format!("step {step}: {text}"))
    }

    /// A bound of the moduli that meet in the balance of forces \[N\].
    fn force_terms(&self, terms: &Terms, residuals: &Residuals) -> f64 {
        let [stiffness, mass, viscosity] = self.rows;
        stiffness * terms.displacement
            + mass * terms.acceleration
            + viscosity * terms.velocity
            + residuals.force_terms
    }

    /// `l - M a - C v - A u` less friction, on free components \[N\]; at rest, what exceeds the
    /// strength.
    fn forces_left(&self, simulation: &Simulation<C>) -> Vec<f64> {
        let at = simulation.snapshot();
        let mut left = (self.load)(at.time);
        (simulation.stiffness()).multiply_add(-1.0, at.displacement, &mut left);
        if let Some(mass) = simulation.mass() {
            mass.multiply_add(-1.0, at.acceleration, &mut left);
        }
        if let Some(viscosity) = simulation.viscosity() {
            viscosity.multiply_add(-1.0, at.velocity, &mut left);
        }
        let mut held = vec![0.0; left.len()];
        for (vertex, strength, velocity) in frictional(at) {
            match modulus(&velocity) {
                0.0 => held[vertex] += strength,
                rate => left[vertex] -= velocity / rate * strength,
            }
        }
        for (left, fixed) in left.iter_mut().zip(simulation.fixed()) {
            for c in (0..C).filter(|&c| fixed[c]) {
                left[c] = 0.0;
            }
        }
        let excess = left.iter().zip(held);
        excess
            .map(|(left, held)| (modulus(left) - held).max(0.0))
            .collect()
    }
}

/// The largest share, or the vertex at which more is left than may be.
fn worst_share(left: &[f64], allowed: &[f64]) -> Result<f64, String> {
    let mut worst: f64 = 0.0;
    for (vertex, (left, allowed)) in left.iter().zip(allowed).enumerate() {
        let share = if *left == 0.0 { 0.0 } else { left / allowed };
        if share.is_nan() || share > 1.0 {
            return Err(format!(
                "residual {left:.2e} N at vertex {vertex}, {share:.2e} times what is allowed"
            ));
        }
        worst = worst.max(share);
    }
    Ok(worst)
}

/// The largest sums of moduli in the equations of motion and state of a step.
#[derive(Default)]
struct Terms {
    displacement: f64,
    velocity: f64,
    acceleration: f64,
    state: f64,
}

impl Terms {
    /// With `u = u_o + dt (v_o + v)/2` and `a = 2 (v - v_o)/dt - a_o`.
    fn of<const C: usize>(from: &StepState<C>, now: &StepState<C>) -> Self {
        let dt = now.last_step;
        let mut terms = Self::default();
        for (i, v) in now.velocity.iter().enumerate() {
            let rates = from.velocity[i].abs() + v.abs();
            let displacement = from.displacement[i].abs() + rates * (0.5 * dt);
            terms.velocity = terms.velocity.max(v.amax());
            terms.displacement = terms.displacement.max(displacement.amax());
            if let Some(a) = from.acceleration.get(i) {
                let acceleration = a.abs() + rates * (2.0 / dt);
                terms.acceleration = terms.acceleration.max(acceleration.amax());
            }
        }
        for state in [from, now] {
            let states = state.contacts.iter().flat_map(|contact| &contact.states);
            terms.state += states.fold(0.0, |largest: f64, state| largest.max(state.abs()));
        }
        terms
    }

    /// Displacement, acceleration and state follow from the velocity to rounding.
    fn check(&self, left: &Residuals, step: usize) -> Result<(), String> {
        for (what, left, terms) in [
            ("displacement", left.displacement, self.displacement),
            ("acceleration", left.acceleration, self.acceleration),
            ("state", left.state, self.state),
        ] {
            let allowed = FEW_ROUNDINGS * f64::EPSILON * terms + f64::MIN_POSITIVE;
            if left.is_nan() || left > allowed {
                return Err(format!(
                    "step {step}: {what} off its rule by {left:e}, {allowed:e} allowed"
                ));
            }
        }
        Ok(())
    }
}

/// Whether all that a step starts from is finite.
pub(crate) fn is_finite<const C: usize>(state: &StepState<C>) -> bool {
    let fields = [&state.displacement, &state.velocity, &state.acceleration];
    let mut states = state.contacts.iter().flat_map(|contact| &contact.states);
    state.clock.time().is_finite()
        && (fields.iter()).all(|field| field.iter().flatten().all(|x| x.is_finite()))
        && states.all(|state| state.is_finite())
}
