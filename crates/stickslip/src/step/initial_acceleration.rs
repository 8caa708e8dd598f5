//! Initial accelerations in balance with the forces: `M a = l - C v - A u - friction`.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_solvers::{ConjugateGradients, LinearSolver, Matrix};

use super::local_steps::weights_after;
use super::{Problem, Workspace, check_finite};
use crate::contact::ContactSet;
use crate::numerics::NUMERICS;
use crate::scene::Prescribed;
use crate::sums::{agreed, largest};
use crate::{StepError, StepState};

/// Workspace for initial accelerations.
#[derive(Clone)]
pub(crate) struct InitialAcceleration<const C: usize> {
    solver: ConjugateGradients<C>,
    /// The components with a known acceleration: Dirichlet components of the scene, and nodes that friction has
    /// arrested.
    known: Vec<[bool; C]>,
    force: Vec<SVector<f64, C>>,
    /// The forces without contact; empty unless normal stresses come from the body.
    free: Vec<SVector<f64, C>>,
    /// The vertices of these contacts, one after the other, and what accelerates them.
    bearing: Vec<usize>,
    inertia: Vec<SVector<f64, C>>,
    scratch: Vec<SVector<f64, C>>,
    /// Whether friction has arrested the frictional vertex.
    held: Vec<bool>,
    /// Whether it can open, and touches the opposite side at rest.
    closed: Vec<bool>,
    /// Products with the mass matrix at the frictional vertices.
    products: Vec<SVector<f64, C>>,
}

impl<const C: usize> InitialAcceleration<C> {
    /// Allocates all memory; none for a mass that is not positive definite, for which the scheme finds the
    /// accelerations.
    pub(crate) fn new(p: &Problem<C>, contacts: &ContactSet<C>) -> Option<Box<Self>> {
        let mass = p.matrices.mass()?;
        let known = p.constraints.fixed.clone();
        let mut solver = ConjugateGradients::default();
        LinearSolver::<dyn Matrix<C>, C>::prepare(&mut solver, mass, &known).ok()?;
        let (size, sites) = (known.len(), contacts.vertices.len());
        let bearing: Vec<usize> = (contacts.contacts.iter())
            .filter(|contact| contact.reacts())
            .flat_map(|contact| contact.part.vertices.iter().copied())
            .collect();
        // A process may have no vertex of them.
        let any = contacts.contacts.iter().any(|contact| contact.reacts());
        let zeros = |count: usize| vec![SVector::zeros(); count];
        Some(Box::new(Self {
            solver,
            known,
            force: zeros(size),
            free: zeros(if any { size } else { 0 }),
            inertia: zeros(bearing.len()),
            bearing,
            scratch: p.loads.scratch(size),
            held: vec![false; sites],
            closed: vec![false; sites],
            products: zeros(sites),
        }))
    }

    /// Arrests frictional vertex number `k`, or releases it.
    fn hold(&mut self, contacts: &ContactSet<C>, fixed: &[[bool; C]], k: usize, held: bool) {
        let vertex = contacts.vertices[k];
        self.held[k] = held;
        self.known[vertex] = fixed[vertex];
        if held {
            contacts.mark_slip(k, &mut self.known[vertex]);
        }
        if self.closed[k] {
            contacts.mark_normal(k, &mut self.known[vertex]);
        }
    }

    /// Releases vertices whose load exceeds the frictional resistance at the slip rate that they would reach in a time
    /// \[s\]; returns whether there was any.
    fn let_go(
        &mut self,
        mass: &dyn Matrix<C>,
        fixed: &[[bool; C]],
        contacts: &ContactSet<C>,
        (acceleration, dt): (&[SVector<f64, C>], f64),
    ) -> bool {
        let mut changed = false;
        mass.products_at(&contacts.vertices, acceleration, &mut self.products);
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            if !self.held[k] {
                continue;
            }
            let left = self.force[vertex] - self.products[k];
            let mut pull = contacts.slip_velocity(k, &left);
            for c in (0..C).filter(|&c| fixed[vertex][c]) {
                pull[c] = 0.0;
            }
            let size = modulus(&pull);
            let inertia = mass.diagonal_block(vertex).diagonal().max();
            if size > contacts.friction(k, dt * size / inertia) {
                self.force[vertex] -= (pull / size) * contacts.friction(k, 0.0);
                self.hold(contacts, fixed, k, false);
                changed = true;
            }
        }
        changed
    }

    /// Solves for the accelerations under the forces without friction, and the friction of the normal stresses in force.
    fn solve(
        &mut self,
        p: &Problem<C>,
        mass: &dyn Matrix<C>,
        contacts: &ContactSet<C>,
        state: &mut StepState<C>,
        dt: f64,
    ) -> Result<(), StepError> {
        let fixed = &p.constraints.fixed;
        self.known.copy_from_slice(fixed);
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            let slip = contacts.slip_velocity(k, &state.velocity[vertex]);
            let rate = modulus(&slip);
            if rate > 0.0 {
                self.force[vertex] -= (slip / rate) * contacts.friction(k, rate);
            }
            self.hold(contacts, fixed, k, rate == 0.0);
        }
        // Each round lets a vertex go.
        loop {
            let components = self.known.iter().zip(fixed);
            for (a, (known, fixed)) in state.acceleration.iter_mut().zip(components) {
                // From zero: from anywhere near the solution rounding would be all there is.
                *a = SVector::from_fn(|c, _| if known[c] && fixed[c] { a[c] } else { 0.0 });
            }
            self.solver.prepare(mass, &self.known)?;
            (self.solver).solve(mass, &self.force, &mut state.acceleration)?;
            let changed = self.let_go(mass, fixed, contacts, (&state.acceleration, dt));
            if !p.ranks.any(changed) {
                break;
            }
        }
        state.algorithmic.fill(SVector::zeros());
        agreed(&p.ranks, check_finite("acceleration", &state.acceleration))
    }

    /// Sets the normal stresses to the reactions at these accelerations, and lets closed vertices go that would be in
    /// tension; returns the largest change of a normal force \[N\].
    fn react(
        &mut self,
        p: &Problem<C>,
        mass: &dyn Matrix<C>,
        contacts: &mut ContactSet<C>,
        acceleration: &[SVector<f64, C>],
    ) -> f64 {
        mass.products_at(&self.bearing, acceleration, &mut self.inertia);
        let (free, closed) = (&self.free, &mut self.closed);
        let mut inertia = self.inertia.iter();
        let mut change = 0.0_f64;
        let ContactSet {
            contacts, vertices, ..
        } = contacts;
        for contact in contacts.iter_mut().filter(|own| own.reacts()) {
            let mut unbalanced = |vertex: usize| match inertia.next() {
                Some(inertia) => free[vertex] - inertia,
                None => free[vertex],
            };
            change = change.max(contact.react_to(&mut unbalanced, |vertex, tension| {
                // A vertex without a free component does not move.
                let Ok(k) = vertices.binary_search(&vertex) else {
                    return true;
                };
                closed[k] &= !tension;
                closed[k]
            }));
        }
        p.ranks.largest(change)
    }
}

impl<const C: usize> Workspace<C> {
    /// Solves for the accelerations of a state at the evaluation time \[s\] of the data. Those of prescribed components
    /// are differences over the following `dt` \[s\]. Without inertia, and with a mass that is not positive definite,
    /// nothing is solved.
    pub(crate) fn find_acceleration(
        &mut self,
        p: &Problem<C>,
        state: &mut StepState<C>,
        (time, dt): (f64, f64),
    ) -> Result<(), StepError> {
        let (Some(mut room), Some(mass)) = (self.acceleration.take(), p.matrices.mass()) else {
            return Ok(());
        };
        let found = differentiate(p, state, (time, dt))
            .and_then(|()| self.solve_acceleration(p, mass, &mut room, state, (time, dt)));
        self.acceleration = Some(room);
        found
    }

    fn solve_acceleration(
        &mut self,
        p: &Problem<C>,
        mass: &dyn Matrix<C>,
        room: &mut InitialAcceleration<C>,
        state: &mut StepState<C>,
        (time, dt): (f64, f64),
    ) -> Result<(), StepError> {
        let contacts = &mut self.contacts;
        contacts.use_states(time, state)?;
        p.loads.fill(time, &mut room.force, &mut room.scratch);
        let loaded = check_finite("load", &room.force);
        agreed(&p.ranks, loaded)?;
        contacts.add_tractions(&mut room.force);
        let weights = weights_after(state.clock.step());
        let (u, v) = (&state.displacement, &state.velocity);
        (p.matrices.stiffness()).multiply_add_levels(&weights, -1.0, u, &mut room.force);
        if let Some(viscosity) = p.matrices.viscosity() {
            viscosity.multiply_add_levels(&weights, -1.0, v, &mut room.force);
        }
        agreed(&p.ranks, check_finite("force", &room.force))?;
        for (k, closed) in room.closed.iter_mut().enumerate() {
            *closed = contacts.rests_closed(k, state);
        }
        if !p.ranks.any(!room.bearing.is_empty()) {
            return room.solve(p, mass, contacts, state, dt);
        }
        room.free.copy_from_slice(&room.force);
        // Friction follows the reactions that hold the accelerations: one and the same force in balance.
        let mut before = f64::INFINITY;
        loop {
            room.force.copy_from_slice(&room.free);
            contacts.add_reactions(&mut room.force);
            room.solve(p, mass, contacts, state, dt)?;
            let change = room.react(p, mass, contacts, &state.acceleration);
            // Contracting until rounding.
            let strength = p.ranks.largest(largest(contacts.strengths()));
            if change >= before || change <= NUMERICS.rounding * strength {
                break;
            }
            before = change;
        }
        Ok(())
    }
}

/// The accelerations of prescribed components after a time: differences of second order.
fn differentiate<const C: usize>(
    p: &Problem<C>,
    state: &mut StepState<C>,
    (time, dt): (f64, f64),
) -> Result<(), StepError> {
    let difference = |part: &Prescribed<C>| {
        let at = |time: f64| part.velocity_at(time);
        let (first, last) = (at(time)?, at(time + dt)?);
        let middle = at(time + 0.5 * dt)?;
        Ok((middle * 4.0 - first * 3.0 - last) / dt)
    };
    p.constraints.set(difference, &mut state.acceleration)
}
