//! Accelerations that agree with the forces: at the start, behind a kink of the boundary data, where a vertex
//! comes to rest or creeps on.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_time::Rule;
use stickslip_tnnmg::{ConjugateGradients, LinearSolver, Operator};

use super::holding::Moment;
use super::reduction::agreed;
use super::{Simulation, StepState, Tolerance};
use crate::StepError;
use crate::contact::ContactSet;
use crate::scene::{Constraints, Loads, Prescribed, Scene};

/// What it takes to solve `M a = l - C v - A u - friction`, and the accelerations of what is moved.
pub(crate) struct Accelerations<const C: usize> {
    solver: ConjugateGradients<C>,
    /// The components whose acceleration is known: those of the scene, and those that friction holds.
    pub(super) known: Vec<[bool; C]>,
    pub(super) force: Vec<SVector<f64, C>>,
    scratch: Vec<SVector<f64, C>>,
    /// One a frictional vertex: friction holds it, or stops it within the step.
    pub(super) held: Vec<bool>,
    /// One a frictional vertex: by how much its acceleration, which rings, would change its rate \[m/s\]; zero where it
    /// does not.
    pub(super) swings: Vec<f64>,
    /// Friction cannot hold what seemed to ring.
    pub(super) sliding: Vec<bool>,
    /// Products with the mass matrix at the frictional vertices.
    pub(super) products: Vec<SVector<f64, C>>,
    /// The accelerations of each moved part at the beginning and at the end of a step [m/s^2].
    moved: Vec<[SVector<f64, C>; 2]>,
    /// The scene gave the acceleration of the start.
    given: bool,
    /// The accelerations that were there before a step found others at its beginning.
    before: Vec<SVector<f64, C>>,
    /// What it found, less those.
    renewal: Vec<SVector<f64, C>>,
    /// The last step found accelerations at its beginning, or at its end.
    pub(super) anew: [bool; 2],
    /// The present step has found others at its beginning than there were.
    renewed: bool,
}

/// A change of a moved part's acceleration at one time, over the larger of the two, that is a kink and no error
/// of the differences, which falls with the square of the step.
const KINK: f64 = 0.1;
/// The difference of the accelerations in the halves of a step, over the sum of both, up to which they are alike; a velocity
/// that begins with the square of time has half of it...
const UNLIKE: f64 = 0.5;
/// ...and that of the second one and of where the first one leads, up to which it does; with the third power it is half.
const ASTRAY: f64 = 0.75;
/// The share of a velocity that changes within a step below which that is rounding.
const NOISE: f64 = 1e-10;
/// Rounds of holding and letting go.
const ROUNDS: usize = 8;
/// The share of the body's shortest time over which velocities are differentiated before there is a step.
const RESOLUTION: f64 = 1e-3;

/// Whether the velocity of a moved part jumps within a step with these accelerations in its halves: they are not alike, and
/// the first one does not lead from that of the last step to the second one.
fn jumps<const C: usize>(
    part: &Prescribed<C>,
    state: &StepState<C>,
    halves: [SVector<f64, C>; 2],
) -> bool {
    let Some(&vertex) = part.part.vertices.first() else {
        return false;
    };
    let [(first, components), (second, _)] = halves.map(|half| part.at(0, &half));
    (0..C).filter(|&c| components[c]).any(|c| {
        let (before, first, second) = (state.acceleration[vertex][c], first[c], second[c]);
        let size = first.abs() + second.abs();
        let led = 3.0 * first - 2.0 * before;
        (second - first).abs() > UNLIKE * size && (second - led).abs() > ASTRAY * size
    })
}

/// About the time in which the fastest wave crosses a cell \[s\]: the least of `sqrt(m/k)` by the diagonals.
fn shortest_time<Op: Operator<C>, const C: usize>(stiffness: &Op, mass: &Op::Mass) -> f64 {
    let times = (0..stiffness.vertex_count()).flat_map(|i| {
        let (stiffness, mass) = (stiffness.diagonal_block(i), mass.diagonal_block(i));
        (0..C).map(move |c| (mass[(c, c)] / stiffness[(c, c)]).sqrt())
    });
    let shortest = times
        .filter(|time| *time > 0.0)
        .fold(f64::INFINITY, f64::min);
    let shortest = if stiffness.is_partial() {
        stiffness.largest(shortest.recip()).recip()
    } else {
        shortest
    };
    if shortest.is_finite() { shortest } else { 1.0 }
}

/// Whether a scheme goes on with the acceleration of the last step.
pub(super) fn is_used(rule: &Rule) -> bool {
    let used = |weights: &stickslip_time::Weights| weights.acceleration != 0.0;
    used(&rule.displacement) || used(&rule.acceleration)
}

/// Whether a scheme turns accelerations round in every step, those of what does not move included. Others damp them.
fn is_undamped(rule: &Rule) -> bool {
    rule.acceleration.acceleration <= -1.0
}

impl<const C: usize> Accelerations<C> {
    /// Takes all memory; none for a mass that is not definite, with which accelerations are left to the scheme.
    pub(super) fn new<Op: Operator<C>>(
        scene: &Scene<Op, C>,
        constraints: &Constraints<C>,
        loads: &Loads<C>,
        sites: usize,
        given: bool,
    ) -> Option<Self> {
        let mass = scene.mass.as_ref()?;
        let known = constraints.fixed.clone();
        let mut solver = ConjugateGradients::default();
        LinearSolver::<Op::Mass, C>::prepare(&mut solver, mass, &known).ok()?;
        let size = known.len();
        Some(Self {
            solver,
            known,
            force: vec![SVector::zeros(); size],
            scratch: loads.scratch(size),
            held: vec![false; sites],
            swings: vec![0.0; sites],
            sliding: vec![false; sites],
            products: vec![SVector::zeros(); sites],
            moved: vec![[SVector::zeros(); 2]; constraints.moved.len()],
            given,
            before: vec![SVector::zeros(); size],
            renewal: vec![SVector::zeros(); size],
            anew: [false; 2],
            renewed: false,
        })
    }

    /// `M` times what the last step that found accelerations at its beginning added to them, at a vertex \[N\].
    pub(super) fn renewal_at<Op: Operator<C>>(&self, mass: &Op, vertex: usize) -> SVector<f64, C> {
        mass.product_at(vertex, &self.renewal)
    }

    /// The accelerations of what is moved, from differences of the velocity within a step alone, so that a kink
    /// at its ends does no harm: `a_o + a = 2 (v - v_o)/dt`, as in the average acceleration. Of a velocity that jumps within
    /// the step those of its two halves.
    fn differentiate(
        &mut self,
        constraints: &Constraints<C>,
        state: &StepState<C>,
        begin: f64,
        dt: f64,
    ) -> Result<(), StepError> {
        for (part, accelerations) in constraints.moved.iter().zip(&mut self.moved) {
            let at = |time: f64| part.velocity_at(time);
            let (first, last) = (at(begin)?, at(begin + dt)?);
            // Data may have a gap that a step passes over.
            let middle = at(begin + 0.5 * dt).unwrap_or((first + last) * 0.5);
            let halves = [(middle - first) * (2.0 / dt), (last - middle) * (2.0 / dt)];
            *accelerations = if jumps(part, state, halves) {
                halves
            } else {
                [
                    (middle * 4.0 - first * 3.0 - last) / dt,
                    (first - middle * 4.0 + last * 3.0) / dt,
                ]
            };
        }
        Ok(())
    }

    /// Whether the acceleration of something moved jumps where a step begins.
    fn is_kink(&self, constraints: &Constraints<C>, state: &StepState<C>, dt: f64) -> bool {
        let mut parts = constraints.moved.iter().zip(&self.moved);
        parts.any(|(part, [begin, _])| {
            let Some(&vertex) = part.part.vertices.first() else {
                return false;
            };
            let (begin, components) = part.at(0, begin);
            (0..C).filter(|&c| components[c]).any(|c| {
                let (old, new) = (state.acceleration[vertex][c], begin[c]);
                let noise = NOISE * state.velocity[vertex][c].abs() / dt;
                (new - old).abs() > (KINK * old.abs().max(new.abs())).max(noise)
            })
        })
    }

    /// Solves for the accelerations of a state, those of fixed components being known. Within a step of `dt`
    /// friction may stop a vertex; none is in sight where that is zero.
    fn solve<Op: Operator<C>>(
        &mut self,
        scene: &Scene<Op, C>,
        (constraints, loads): (&Constraints<C>, &Loads<C>),
        contacts: &mut ContactSet<C>,
        state: &mut StepState<C>,
        (time, dt): (f64, f64),
        moment: Moment,
    ) -> Result<(), StepError> {
        let Some(mass) = &scene.mass else {
            return Ok(());
        };
        loads.fill(time, &mut self.force, &mut self.scratch);
        let force = &mut self.force;
        contacts.add_tractions(true, force);
        (scene.stiffness).multiply_add(-1.0, &state.displacement, force);
        for viscosity in &scene.viscosity {
            viscosity.multiply_add(-1.0, &state.velocity, force);
        }
        agreed(mass, super::motion::check_finite("load", force))?;
        contacts.use_states(&state.contacts);
        let fixed = &constraints.fixed;
        self.known.copy_from_slice(fixed);
        for (k, &vertex) in contacts.vertices.iter().enumerate() {
            let slip = contacts.slip_velocity(k, &state.velocity[vertex]);
            let rate = modulus(&slip);
            if rate > 0.0 {
                self.force[vertex] -= (slip / rate) * contacts.friction(k, rate);
            }
            self.hold(contacts, fixed, k, rate == 0.0 || self.swings[k] > 0.0);
        }
        for _ in 0..ROUNDS {
            for ((a, known), fixed) in state.acceleration.iter_mut().zip(&self.known).zip(fixed) {
                // Conjugate gradients from zero: from anywhere near the solution rounding would be all there is.
                *a = SVector::from_fn(|c, _| if known[c] && fixed[c] { a[c] } else { 0.0 });
            }
            self.solver.prepare(mass, &self.known)?;
            (self.solver).solve(mass, &self.force, &mut state.acceleration)?;
            if !self.hold_and_let_go(mass, fixed, contacts, state, (dt, moment)) {
                break;
            }
        }
        agreed(
            mass,
            super::motion::check_finite("acceleration", &state.acceleration),
        )
    }
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// The accelerations of the start, unless they were given.
    pub(super) fn start_acceleration(&mut self) -> Result<(), StepError> {
        match (&self.accelerations, &self.scene.mass) {
            (Some(accelerations), Some(mass)) if !accelerations.given => {
                let resolution = RESOLUTION * shortest_time(&self.scene.stiffness, mass);
                self.renew_acceleration(resolution, 0.0, Moment::Jump)
            }
            _ => Ok(()),
        }
    }

    /// Before a step: the accelerations of what is moved, and of everything else where those jump or what friction has
    /// stopped would ring.
    pub(super) fn begin_acceleration(&mut self, rule: &Rule, dt: f64) -> Result<(), StepError> {
        let Some(accelerations) = self.accelerations.as_mut().filter(|_| is_used(rule)) else {
            return Ok(());
        };
        accelerations.anew = [false; 2];
        let state = &self.state;
        accelerations.differentiate(&self.constraints, state, state.clock.time(), dt)?;
        let first = state.clock.step() == 0 && !accelerations.given;
        let kink = accelerations.is_kink(&self.constraints, state, dt);
        let jumps = first || self.operators.step.any(kink);
        let (mass, contacts) = (self.scene.mass.as_ref(), &self.contacts);
        let (operators, tolerance) = (&self.operators, self.method.tolerance);
        let open = |vertex| match tolerance {
            Tolerance::Absolute(tolerance) => operators.velocity_of(tolerance, vertex),
            _ => 0.0,
        };
        let rings = !jumps
            && is_undamped(rule)
            && mass.is_some_and(|mass| accelerations.find_ringing(mass, contacts, state, open));
        if jumps || rings {
            accelerations.anew[0] = true;
            let moment = if jumps { Moment::Jump } else { Moment::Ringing };
            let renewed = self.renew_acceleration(dt, dt, moment);
            if let Some(accelerations) = &mut self.accelerations {
                accelerations.swings.fill(0.0);
            }
            return renewed;
        }
        Ok(())
    }

    /// Before a step: the accelerations that are there are those to go back to.
    pub(super) fn keep_acceleration(&mut self) {
        if let Some(accelerations) = &mut self.accelerations {
            accelerations.renewed = false;
        }
    }

    /// Solves for all accelerations behind the time at which the state stands, where they jump or ring.
    fn renew_acceleration(
        &mut self,
        difference: f64,
        dt: f64,
        moment: Moment,
    ) -> Result<(), StepError> {
        let Some(mut accelerations) = self.accelerations.take() else {
            return Ok(());
        };
        let (constraints, state) = (&self.constraints, &mut self.state);
        let time = state.clock.time();
        accelerations.renewed = true;
        (accelerations.before).copy_from_slice(&state.acceleration);
        let solved = accelerations
            .differentiate(constraints, state, time, difference)
            .and_then(|()| {
                for &vertex in &constraints.held {
                    for c in (0..C).filter(|&c| constraints.fixed[vertex][c]) {
                        state.acceleration[vertex][c] = 0.0;
                    }
                }
                for (part, [begin, _]) in constraints.moved.iter().zip(&accelerations.moved) {
                    part.set(begin, &mut state.acceleration);
                }
                let (data, contacts) = ((constraints, &self.loads), &mut self.contacts);
                accelerations.solve(&self.scene, data, contacts, state, (time, dt), moment)
            });
        let found = self.state.acceleration.iter().zip(&accelerations.before);
        for (renewal, (new, old)) in accelerations.renewal.iter_mut().zip(found) {
            *renewal = new - old;
        }
        self.accelerations = Some(accelerations);
        solved
    }

    /// After a step that failed: back to the accelerations of the last accepted one.
    pub(super) fn restore_acceleration(&mut self) {
        if let Some(accelerations) = &mut self.accelerations
            && accelerations.renewed
        {
            (self.state.acceleration).copy_from_slice(&accelerations.before);
        }
    }

    /// In a step: `a^` where something is moved, so that `a` is the derivative of what moves it.
    pub(super) fn move_accelerations(&mut self, rule: &Rule) {
        let Some(accelerations) = self.accelerations.as_ref().filter(|_| is_used(rule)) else {
            return;
        };
        let (c_a, trial) = (rule.acceleration.new_velocity, &mut self.trial);
        for (part, [_, end]) in self.constraints.moved.iter().zip(&accelerations.moved) {
            for (position, &vertex) in part.part.vertices.iter().enumerate() {
                let (end, components) = part.at(position, end);
                for c in (0..C).filter(|&c| components[c]) {
                    trial.acceleration[vertex][c] = end[c] - c_a * trial.velocity[vertex][c];
                }
            }
        }
    }

    /// After a step of `dt` to `time`: a vertex that friction has brought to rest has no acceleration any more, and that
    /// which stopped it would ring on from step to step.
    pub(super) fn settle_acceleration(&mut self, rule: &Rule, time: f64, dt: f64) {
        let Some(mut accelerations) = self.accelerations.take_if(|_| is_used(rule)) else {
            return;
        };
        let (contacts, state, trial) = (&mut self.contacts, &mut self.state, &mut self.trial);
        let mut sites = contacts.vertices.iter().enumerate();
        // What was accepted has left the old velocity behind.
        let stopped = sites.any(|(k, &vertex)| {
            let rate = |v: &[SVector<f64, C>]| modulus(&contacts.slip_velocity(k, &v[vertex]));
            rate(&state.velocity) == 0.0 && rate(&trial.velocity) > 0.0
        });
        if self.operators.step.any(stopped) {
            accelerations.anew[1] = true;
            trial.acceleration.copy_from_slice(&state.acceleration);
            let data = (&self.constraints, &self.loads);
            let moment = Moment::End;
            let solved =
                accelerations.solve(&self.scene, data, contacts, state, (time, dt), moment);
            if solved.is_ok() {
                // What a scheme carries beside the acceleration of what friction holds is as little as that.
                let components = accelerations.known.iter().zip(&self.constraints.fixed);
                for (carried, (known, fixed)) in state.carried.iter_mut().zip(components) {
                    for c in (0..C).filter(|&c| known[c] && !fixed[c]) {
                        carried[c] = 0.0;
                    }
                }
            } else {
                // The scheme's own are right too.
                state.acceleration.copy_from_slice(&trial.acceleration);
            }
            // What is left of a force at a vertex follows.
            for (old, new) in trial.acceleration.iter_mut().zip(&state.acceleration) {
                *old -= new;
            }
            if let Some(mass) = &self.scene.mass {
                mass.multiply_add(1.0, &trial.acceleration, &mut trial.load);
            }
        }
        self.accelerations = Some(accelerations);
    }
}
