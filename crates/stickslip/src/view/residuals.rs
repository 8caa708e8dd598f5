//! The residuals of a step's equations.

use nalgebra::SVector;
use stickslip_friction::modulus;

use super::{Snapshot, StepView};
use crate::laws::StateStep;
use crate::step::{Problem, Span, Workspace, weights_after};
use crate::sums::largest;
use crate::{Simulation, StepState};

/// The residuals of the last step, each with the largest of its terms.
///
/// Compare the residual force \[N\] with rounding, `1e-16` of `force_terms`, and with the tolerance of the coupling: it
/// limits the error of the velocity, and through it those of friction and inertia. Displacement and acceleration follow
/// from the velocity up to rounding.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Residuals {
    /// `l - M a - C v - A u` less friction, on free components; at rest, the excess over the strength \[N\].
    pub force: f64,
    /// The largest sum of the moduli of these terms at a vertex \[N\].
    pub force_terms: f64,
    /// The residual of the displacement in the scheme's update formula \[m\].
    pub displacement: f64,
    /// The residual of the acceleration in the scheme's update formula [m/s^2].
    pub acceleration: f64,
    /// The residual of the state in the state law's step, in its own variable.
    pub state: f64,
}

/// See [`Simulation::residuals`].
pub(crate) fn residuals<const C: usize>(
    simulation: &Simulation<C>,
    from: &StepState<C>,
) -> Residuals {
    let (p, now) = (&simulation.problem, &simulation.state);
    let mut residuals = Residuals::default();
    (residuals.force, residuals.force_terms) = force_residual(simulation);
    let scheme = &p.method.scheme;
    if scheme.properties().stages.len() > 1 || now.report.damped {
        let unknown = f64::NAN;
        (residuals.displacement, residuals.acceleration) = (unknown, unknown);
        residuals.state = unknown;
        return residuals;
    }
    let formula = scheme.update_formula(now.last_step);
    // A step from a stop begins with other velocities and accelerations than the last one ended with.
    let from_stop =
        Span::new(&from.clock, now.last_step, &p.stops).is_ok_and(|span| span.from_right.is_some());
    for i in 0..now.velocity.len() {
        for c in 0..C {
            let (old, v) = (from.motion(i, c), now.velocity[i][c]);
            let weights = if p.constraints.fixed[i][c] {
                &formula.prescribed
            } else {
                &formula.displacement
            };
            let u = weights.of(old, v) - now.displacement[i][c];
            residuals.displacement = largest([residuals.displacement, u.abs()].into_iter());
            if let Some(a) = now.acceleration.get(i) {
                let a = formula.acceleration.of(old, v) - a[c];
                residuals.acceleration = largest([residuals.acceleration, a.abs()].into_iter());
            }
        }
    }
    if from_stop {
        (residuals.displacement, residuals.acceleration) = (f64::NAN, f64::NAN);
    }
    residuals.state = state_residual(p, &simulation.work, from, now);
    residuals
}

/// The largest residual force, and the largest sum of moduli at a vertex.
fn force_residual<const C: usize>(simulation: &Simulation<C>) -> (f64, f64) {
    let (p, now) = (&simulation.problem, &simulation.state);
    let mut left = simulation.applied_load().to_vec();
    let size = left.len();
    let mut terms: Vec<f64> = left.iter().map(|load| load.amax()).collect();
    let mut product = vec![SVector::zeros(); size];
    let mut subtract = |product: &mut [SVector<f64, C>]| {
        for ((left, terms), product) in left.iter_mut().zip(&mut terms).zip(product) {
            *left -= &*product;
            *terms += product.amax();
            *product = SVector::zeros();
        }
    };
    let weights = weights_after(now.clock.step());
    let (stiffness, u) = (p.matrices.stiffness(), &now.displacement);
    stiffness.multiply_add_levels(&weights, 1.0, u, &mut product);
    subtract(&mut product);
    if let Some(mass) = p.matrices.mass() {
        mass.multiply_add(1.0, &now.acceleration, &mut product);
        subtract(&mut product);
    }
    if let Some(viscosity) = p.matrices.viscosity() {
        viscosity.multiply_add_levels(&weights, 1.0, &now.velocity, &mut product);
        subtract(&mut product);
    }
    let lag = simulation.lag();
    if lag > 0.0 {
        for viscosity in p.matrices.lagged_viscosities() {
            viscosity.multiply_add_levels(&weights, -lag, &now.acceleration, &mut product);
        }
        subtract(&mut product);
    }
    let mut strengths = vec![0.0; size];
    for contact in Snapshot::new(now, simulation).contacts() {
        for k in 0..contact.len() {
            let vertex = contact.vertex(k);
            let strength = contact.strength(k) * contact.weight(k);
            terms[vertex] += strength;
            left[vertex] -= contact.sliding_traction(k) * contact.weight(k);
            if contact.slip_rate(k) == 0.0 {
                strengths[vertex] += strength;
            }
        }
    }
    let excess = (0..size).map(|i| {
        let fixed = |c: usize| simulation.is_fixed(i, c);
        let free = SVector::<f64, C>::from_fn(|c, _| if fixed(c) { 0.0 } else { left[i][c] });
        let size = modulus(&free);
        if size.is_nan() {
            size
        } else {
            (size - strengths[i]).max(0.0)
        }
    });
    (largest(excess), largest(terms.iter().copied()))
}

/// The largest difference of a state from the law's own step.
fn state_residual<const C: usize>(
    p: &Problem<C>,
    w: &Workspace<C>,
    from: &StepState<C>,
    now: &StepState<C>,
) -> f64 {
    let formula = p.method.scheme.update_formula(now.last_step);
    let (update, inertia) = (p.method.update_of(&*p.method.scheme), p.matrices.has_mass());
    let step = StateStep::new(now.last_step, update, &formula, inertia);
    let contacts = w.contacts.contacts.iter().zip(&from.contacts);
    let pairs = contacts.zip(&now.contacts);
    largest(pairs.flat_map(|((contact, from_contact), at)| {
        (0..at.states.len()).map(move |k| {
            let rate = contact.slip_rate(k, &now.velocity);
            let vertex = contact.part.vertices[k];
            let taken_over = SVector::<f64, C>::from_fn(|c, _| {
                step.taken_over(&formula, from.motion(vertex, c), inertia)
            });
            let taken_over = modulus(&contact.tangential(k, &taken_over));
            let start = (from_contact.states[k], taken_over);
            let stress = [from_contact.normal_stress[k], at.normal_stress[k]];
            let advanced = contact.advanced(k, step, start, rate, stress);
            advanced.map_or(f64::NAN, |state| (state - at.states[k]).abs())
        })
    }))
}
