//! Which frictional vertices are held where accelerations are found anew.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_tnnmg::Operator;

use super::StepState;
use super::acceleration::Accelerations;
use crate::contact::ContactSet;

/// Why accelerations are found anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Moment {
    /// Before a step: those of the body jump. Vertices are held that friction stops within the step.
    Jump,
    /// Before a step: some ring. Vertices are held that friction lets creep.
    Ringing,
    /// After a step in which friction stopped a vertex for good: forces balance as they are.
    End,
}

/// The share of the inertia force by which friction changes within a step that friction decides.
const STIFF: f64 = 0.5;

/// The change of a rate within a step, by its acceleration, over the rate itself, that is no motion any more.
const SWING: f64 = 4.0;

impl<const C: usize> Accelerations<C> {
    /// Finds the vertices that friction lets creep and whose accelerations ring; whether there are any.
    ///
    /// Friction that stops a vertex within a step leaves it an acceleration that a scheme without damping turns round in
    /// every step: it would make quite another rate of the rate, which does not change. The one before follows from the
    /// average acceleration, `a_o + a = 2 (v - v_o)/dt`. Whether friction can hold the vertex, the forces tell. A rate
    /// that the solver leaves `open` at a vertex [m/s] is none that rings.
    pub(super) fn find_ringing<Op: Operator<C>>(
        &mut self,
        mass: &Op,
        contacts: &ContactSet<C>,
        state: &StepState<C>,
        open: impl Fn(usize) -> f64,
    ) -> bool {
        let dt = state.last_step;
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            let (v, a) = (&state.velocity[vertex], &state.acceleration[vertex]);
            let slip = |field: &SVector<f64, C>| contacts.slip_velocity(k, field);
            let earlier = contacts.earlier_velocity(k, &state.contacts);
            let rings = earlier.is_some_and(|earlier| {
                let (now, before) = (slip(a), slip(&((v - earlier) * (2.0 / dt) - a)));
                let change = dt * modulus(&now).min(modulus(&before));
                let rates = [modulus(&slip(v)), modulus(&slip(earlier))];
                rates[0] > 0.0
                    && now.dot(&before) < 0.0
                    && change > SWING * rates[0].max(rates[1])
                    && change > open(vertex)
            });
            self.swings[k] = if rings { dt * modulus(&slip(a)) } else { 0.0 };
        }
        self.sliding.fill(false);
        mass.any(self.swings.iter().any(|&swing| swing > 0.0))
    }

    /// Friction holds the frictional vertex number `k`, or lets it go.
    pub(super) fn hold(
        &mut self,
        contacts: &ContactSet<C>,
        fixed: &[[bool; C]],
        k: usize,
        held: bool,
    ) {
        let vertex = contacts.vertices[k];
        self.held[k] = held;
        self.known[vertex] = fixed[vertex];
        if held {
            contacts.mark_slip(k, &mut self.known[vertex]);
        }
    }

    /// Lets go what is pulled by more than friction can hold, and holds what friction stops within the step; whether
    /// there was any.
    pub(super) fn hold_and_let_go<Op: Operator<C>>(
        &mut self,
        mass: &Op,
        fixed: &[[bool; C]],
        contacts: &ContactSet<C>,
        state: &StepState<C>,
        (dt, moment): (f64, Moment),
    ) -> bool {
        let mut changed = false;
        mass.products_at(&contacts.vertices, &state.acceleration, &mut self.products);
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            let slip = contacts.slip_velocity(k, &state.velocity[vertex]);
            let rate = modulus(&slip);
            let inertia = mass.diagonal_block(vertex).diagonal().max();
            if self.held[k] && rate == 0.0 {
                let left = self.force[vertex] - self.products[k];
                let mut pull = contacts.slip_velocity(k, &left);
                for c in (0..C).filter(|&c| fixed[vertex][c]) {
                    pull[c] = 0.0;
                }
                let size = modulus(&pull);
                if size > contacts.friction(k, dt * size / inertia) {
                    self.force[vertex] -= (pull / size) * contacts.friction(k, 0.0);
                    self.hold(contacts, fixed, k, false);
                    changed = true;
                }
            } else if self.held[k] && self.swings[k] > 0.0 {
                // Friction was taken off the force: what is left has to be within what it would rise by, or fall by
                // and turn round.
                let left = contacts.slip_velocity(k, &(self.force[vertex] - self.products[k]));
                let now = contacts.friction(k, rate);
                let range = if left.dot(&slip) >= 0.0 {
                    contacts.friction(k, rate + self.swings[k]) - now
                } else {
                    contacts.friction(k, self.swings[k]) + now
                };
                if modulus(&left) > range {
                    self.hold(contacts, fixed, k, false);
                    (self.sliding[k], changed) = (true, true);
                }
            } else if moment == Moment::Ringing && rate > 0.0 && !self.held[k] && !self.sliding[k] {
                // What was held no longer moves its neighbours, which may creep, too.
                let swing = dt * modulus(&contacts.slip_velocity(k, &state.acceleration[vertex]));
                if swing > SWING * rate {
                    self.swings[k] = swing;
                    self.hold(contacts, fixed, k, true);
                    changed = true;
                }
            } else if moment == Moment::Jump && rate > 0.0 && !self.held[k] {
                let growth = state.acceleration[vertex].dot(&(slip / rate));
                let next = (rate + dt * growth).max(0.0);
                let change = contacts.friction(k, next) - contacts.friction(k, rate);
                if change.abs() > STIFF * (inertia * growth).abs() {
                    self.hold(contacts, fixed, k, true);
                    changed = true;
                }
            }
        }
        mass.any(changed)
    }
}
