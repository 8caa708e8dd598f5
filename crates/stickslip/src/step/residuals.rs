//! Whether a step is one: its equations, evaluated from what it left.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_tnnmg::Operator;

use super::{Simulation, StepState};
use crate::contact::StateStep;
use crate::step::reduction::largest;

/// By how much the last step misses its equations, each beside the largest of its terms.
///
/// What is left of a force \[N\] is compared with rounding, `1e-16` of `force_terms`, and with the tolerance of
/// the coupling, which lets the velocity be wrong by a little and with it friction and inertia. Displacement
/// and acceleration follow from the velocity to rounding.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Residuals {
    /// `l - M a - C v - A u` less friction, on free components; at rest, what exceeds the strength \[N\].
    pub force: f64,
    /// The largest sum of the moduli of these terms at a vertex \[N\].
    pub force_terms: f64,
    /// Of the displacement against the scheme's rule \[m\].
    pub displacement: f64,
    /// Of the acceleration against the scheme's rule [m/s^2].
    pub acceleration: f64,
    /// Of the state against the state law's step, in its own variable.
    pub state: f64,
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Checks the last step, which began at `from`: the balance of forces, the rule of the scheme and the step
    /// of the state laws, all evaluated anew. Of a scheme of several stages forces alone; the others are NaN,
    /// since nothing of what was between the stages is kept. An acceleration that was found anew in the step, at
    /// the start, behind a kink, where a vertex came to rest or where friction had stopped it all but for a creep, follows
    /// no rule and is NaN too.
    ///
    /// ```
    /// # use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
    /// # use stickslip::{Newmark, Point, Simulation, Steps};
    /// # let slider = SpringSlider {
    /// #     stiffness: 1e9, normal_stress: 1e6, mass: 1e3, damping: 0.0, load: LoadPath::steady(1e-5),
    /// # };
    /// # let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    /// let mut simulation = Simulation::new(scene, Newmark::default(), Point)?;
    /// let from = simulation.state().clone();
    /// simulation.step(0.1)?;
    /// let left = simulation.residuals(&from);
    /// assert!(left.force < 1e-12 * left.force_terms && left.state < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn residuals(&self, from: &StepState<C>) -> Residuals {
        let now = &self.state;
        let mut residuals = Residuals::default();
        (residuals.force, residuals.force_terms) = self.force_residual();
        if self.method.scheme.facts().stages.len() > 1 {
            let unknown = f64::NAN;
            (residuals.displacement, residuals.acceleration) = (unknown, unknown);
            residuals.state = unknown;
            return residuals;
        }
        let rule = self.method.scheme.rule(now.last_step);
        let anew = self.accelerations.as_ref().map(|found| found.anew);
        let [begun, settled] = anew.unwrap_or_default();
        let size = now.velocity.len();
        for i in 0..size {
            for c in 0..C {
                let (old, v) = (from.motion(i, c), now.velocity[i][c]);
                let weights = if self.constraints.fixed[i][c] {
                    &rule.prescribed
                } else {
                    &rule.displacement
                };
                let u = weights.of(old, v) - now.displacement[i][c];
                residuals.displacement = largest([residuals.displacement, u.abs()].into_iter());
                let moved = anew.is_some() && self.constraints.fixed[i][c];
                if let Some(a) = now.acceleration.get(i).filter(|_| !moved) {
                    let a = rule.acceleration.of(old, v) - a[c];
                    residuals.acceleration = largest([residuals.acceleration, a.abs()].into_iter());
                }
            }
        }
        if begun || settled {
            residuals.acceleration = f64::NAN;
        }
        if begun && rule.displacement.acceleration != 0.0 {
            residuals.displacement = f64::NAN;
        }
        residuals.state = self.state_residual(from);
        residuals
    }

    /// The largest force left over, and the largest sum of moduli at a vertex.
    fn force_residual(&self) -> (f64, f64) {
        let now = &self.state;
        let size = now.velocity.len();
        let mut left = vec![SVector::zeros(); size];
        self.loads
            .fill(now.clock.time(), &mut left, &mut self.loads.scratch(size));
        self.contacts.add_tractions(true, &mut left);
        let mut terms: Vec<f64> = left.iter().map(|load| load.amax()).collect();
        let mut product = vec![SVector::zeros(); size];
        let mut subtract = |product: &mut [SVector<f64, C>]| {
            for ((left, terms), product) in left.iter_mut().zip(&mut terms).zip(product) {
                *left -= &*product;
                *terms += product.amax();
                *product = SVector::zeros();
            }
        };
        (self.scene.stiffness).multiply_add(1.0, &now.displacement, &mut product);
        subtract(&mut product);
        if let Some(mass) = &self.scene.mass {
            mass.multiply_add(1.0, &now.acceleration, &mut product);
            subtract(&mut product);
        }
        if let Some(viscosity) = self.scene.viscosity.first() {
            viscosity.multiply_add(1.0, &now.velocity, &mut product);
            subtract(&mut product);
        }
        let mut strengths = vec![0.0; size];
        for contact in self.snapshot().contacts() {
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
            let fixed = &self.constraints.fixed[i];
            let free = SVector::<f64, C>::from_fn(|c, _| if fixed[c] { 0.0 } else { left[i][c] });
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
    fn state_residual(&self, from: &StepState<C>) -> f64 {
        let step = StateStep {
            dt: self.state.last_step,
            update: self.method.update_of_a_stage(),
        };
        let contacts = self.contacts.contacts.iter().zip(&from.contacts);
        largest(
            contacts
                .zip(&self.state.contacts)
                .flat_map(|((contact, from_contact), now)| {
                    (0..now.states.len()).map(move |k| {
                        let rate = contact.slip_rate(k, &self.state.velocity);
                        let start = (from_contact.states[k], contact.slip_rate(k, &from.velocity));
                        let stress = [from_contact.normal_stress[k], now.normal_stress[k]];
                        let advanced = contact.interface.advance(k, step, start, rate, stress);
                        advanced.map_or(f64::NAN, |state| (state - now.states[k]).abs())
                    })
                }),
        )
    }
}
