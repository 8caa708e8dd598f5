//! Steps with several solutions: the one that continues the last step, followed from the smallest step to the whole.

use nalgebra::SVector;
use stickslip_friction::modulus;
use stickslip_tnnmg::{Operator, SolveError};

use super::definite::Definite;
use super::{CouplingReport, Simulation, StepMaps, Trial};
use crate::StepError;
use crate::contact::ContactSet;
use crate::scene::Scene;

/// What it takes to follow a solution.
pub(crate) struct Following<const C: usize> {
    /// The velocities at the last two step sizes reached, the last one first.
    reached: [Vec<SVector<f64, C>>; 2],
    /// Where they lead to.
    expected: Vec<SVector<f64, C>>,
    /// By how much friction weakens at each frictional vertex [N s/m].
    pub(super) slopes: Vec<f64>,
    /// The slopes that the body is known to stand over a whole step [N s/m], with these factors of its operator.
    stood: Vec<f64>,
    factors: Option<(f64, f64)>,
    pub(super) definite: Definite<C>,
    /// What is no unknown where frictional vertices are held; empty if each of them rests or slides, but never either.
    held: Vec<[bool; C]>,
}

impl<const C: usize> Following<C> {
    /// For a scene with these contacts, and these components that are no unknowns.
    pub(super) fn new<Op: Operator<C>>(
        scene: &Scene<Op, C>,
        contacts: &ContactSet<C>,
        fixed: &[[bool; C]],
    ) -> Self {
        let mut held = Vec::new();
        if scene.stiffness.any(contacts.may_rest_or_slide()) {
            held.extend_from_slice(fixed);
            for (k, &vertex) in contacts.vertices.iter().enumerate() {
                contacts.mark_slip(k, &mut held[vertex]);
            }
        }
        let zeros = || vec![SVector::zeros(); scene.stiffness.vertex_count()];
        Self {
            reached: [zeros(), zeros()],
            expected: zeros(),
            slopes: vec![0.0; contacts.vertices.len()],
            stood: vec![0.0; contacts.vertices.len()],
            factors: None,
            definite: Definite::new(&scene.stiffness),
            held,
        }
    }
}

/// The part of the step that is tried first.
const FIRST: f64 = 0.5;
/// A part that fails is tried again in this share of it; after one that does not, the next is larger.
const SHRINK: f64 = 0.25;
const GROW: f64 = 2.0;
/// What a part that adds little to what is reached makes of it, at most.
const SHORT: f64 = 1.3;
/// The part of the step, and of what is reached of it, below which the solution ends.
const SMALLEST: [f64; 2] = [1e-14, 1e-6];
/// By how much more friction may weaken where the body is tested for the steps to come as well.
const SPARE: f64 = 1.5;
/// Velocity problems that following a solution may take.
const MOST: usize = 500;

/// The place of a frictional vertex of another process.
const ELSEWHERE: usize = usize::MAX;

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Takes the rates that the coupling found if they continue those of the last step, or are the only ones; else
    /// follows the solution that does. Adds the velocity problems of that to `followed`.
    pub(super) fn single_out(
        &mut self,
        coupled: Result<CouplingReport, StepError>,
        (dt, time): (f64, f64),
        followed: &mut usize,
    ) -> Result<CouplingReport, StepError> {
        let is_followed = match coupled.as_ref().err() {
            failure if self.contacts.have_state() => self.method.coupling.is_followed(failure),
            // Without a state nothing couples: what is not convex is looked into at once.
            None | Some(StepError::Solver(SolveError::NotConvex { .. })) => true,
            Some(_) => false,
        };
        let Some(mut following) = self.following.take_if(|_| is_followed) else {
            return coupled;
        };
        let result = self.follow_if_parted(&mut following, coupled, (dt, time), followed);
        self.following = Some(following);
        result
    }

    fn follow_if_parted(
        &mut self,
        following: &mut Following<C>,
        coupled: Result<CouplingReport, StepError>,
        (dt, time): (f64, f64),
        followed: &mut usize,
    ) -> Result<CouplingReport, StepError> {
        let (report, missed) = match coupled {
            Ok(report) => match self.parted(following, None, dt) {
                None => return Ok(report),
                Some(k) => {
                    if let Some(near) = self.try_near(following, (dt, time), followed)? {
                        let iterations = report.iterations;
                        return Ok(CouplingReport { iterations, ..near });
                    }
                    (report, self.fold(k, following, (0.0, dt)))
                }
            },
            Err(cause) => (CouplingReport::default(), cause),
        };
        if !self.follows {
            return Err(missed);
        }
        let weakening = self.follow(following, (dt, time), missed, followed)?;
        Ok(CouplingReport {
            iterations: report.iterations,
            fell_back: report.fell_back,
            weakening,
        })
    }

    /// Where friction may let a vertex rest or slide under one force, looks for a solution near the last one: from
    /// where the body is in balance with its frictional vertices at their last rates. A solver that moves the body and
    /// them in turns lets them slide meanwhile under forces that are not those of either.
    fn try_near(
        &mut self,
        following: &mut Following<C>,
        (dt, time): (f64, f64),
        followed: &mut usize,
    ) -> Result<Option<CouplingReport>, StepError> {
        if !self.moves_in_turns(following) {
            return Ok(None);
        }
        let rule = self.prepare(dt)?;
        self.predict(&rule, dt, time)?;
        self.balance_body(following);
        let before = self.trial.solver_iterations;
        let coupled = self.couple(dt);
        self.trial.solver_iterations += before;
        let Ok(report) = coupled else {
            return Ok(None);
        };
        *followed += report.iterations;
        Ok((self.parted(following, None, dt).is_none()).then_some(report))
    }

    /// Whether friction may let a vertex rest or slide under one force, and the solver moves body and contact in turns.
    fn moves_in_turns(&mut self, following: &Following<C>) -> bool {
        !following.held.is_empty() && self.solver.frictional().is_none()
    }

    /// Moves the body where it is in balance with its frictional vertices at the rates they have, if it can be.
    fn balance_body(&mut self, following: &mut Following<C>) {
        if !self.moves_in_turns(following) {
            return;
        }
        let Trial { load, velocity, .. } = &mut self.trial;
        (following.definite).balance(&self.operators.step, load, &following.held, velocity);
    }

    /// Follows the solution from the last step on, as the step grows to `dt`. Returns the number of vertices at which
    /// friction weakens.
    fn follow(
        &mut self,
        following: &mut Following<C>,
        (dt, time): (f64, f64),
        missed: StepError,
        followed: &mut usize,
    ) -> Result<usize, StepError> {
        for field in &mut following.reached {
            field.copy_from_slice(&self.state.velocity);
        }
        let (mut reached, mut part, mut last_part) = (0.0, FIRST, f64::INFINITY);
        let mut parted = None;
        loop {
            let next = f64::min(reached + part, 1.0);
            let smallest = if reached == 0.0 {
                SMALLEST[0]
            } else {
                SMALLEST[1] * reached
            };
            if part < smallest || *followed >= MOST {
                let (at, part) = (following, (reached * dt, dt));
                return Err(parted.map_or(missed, |k| self.fold(k, at, part)));
            }
            *followed += 1;
            let lead = (next - reached) / last_part;
            match self.try_part(following, [reached, next], lead, (dt, time))? {
                Ok(weakening) if next == 1.0 => return Ok(weakening),
                Ok(_) => {
                    last_part = next - reached;
                    (reached, part) = (next, GROW * part);
                    following.reached.swap(0, 1);
                    following.reached[0].copy_from_slice(&self.trial.velocity);
                }
                Err(vertex) => {
                    part *= SHRINK;
                    parted = vertex.or(parted);
                }
            }
        }
    }

    /// Solves at once for rate and state of a part of the step, from what is reached, and returns the number of
    /// vertices at which friction weakens. If that leads to no solution or to another one, an error inside: the
    /// number of a frictional vertex at which it is seen, if it is.
    fn try_part(
        &mut self,
        following: &mut Following<C>,
        [reached, next]: [f64; 2],
        lead: f64,
        (whole, time): (f64, f64),
    ) -> Result<Result<usize, Option<usize>>, StepError> {
        let (dt, time) = if next < 1.0 {
            (next * whole, time - (1.0 - next) * whole)
        } else {
            (whole, time)
        };
        let rule = self.prepare(dt)?;
        self.predict(&rule, dt, time)?;
        let [now, before] = &following.reached;
        let known = self.trial.velocity.iter().zip(&self.constraints.fixed);
        let pairs = now.iter().zip(before).zip(known);
        for (expected, ((now, before), (known, fixed))) in following.expected.iter_mut().zip(pairs)
        {
            *expected = SVector::from_fn(|c, _| {
                if fixed[c] {
                    known[c]
                } else {
                    now[c] + (now[c] - before[c]) * lead
                }
            });
        }
        self.trial.velocity.copy_from_slice(&following.expected);
        self.contacts.aim(now);
        self.balance_body(following);
        let tolerance = self.tolerance();
        let (_, mut problem) = self.problem(dt);
        match problem.solve_coupled(tolerance) {
            Ok(()) => {}
            Err(StepError::Solver(SolveError::NotConvex { vertex, .. })) => {
                return Ok(Err(self.contacts.vertices.binary_search(&vertex).ok()));
            }
            Err(_) => return Ok(Err(None)),
        }
        problem.propose_states()?;
        problem.relax_states(1.0);
        let weakening = problem.weakening();
        let parted = self.parted(following, Some(reached * whole), dt);
        Ok(parted.map_or(Ok(weakening), |k| Err(Some(k))))
    }

    /// The frictional vertex, by its number among them, at which the velocity found for a step of `dt` \[s\] may have left
    /// what was followed to a step of `reached` \[s\], or the last step if nothing was.
    ///
    /// It has not where all steps in between have a single solution: inertia falls with the step size, stiffness and the
    /// weakening of friction grow, so that all are convex if this is definite:
    ///
    /// ```text
    /// c_a(dt) M + C + c_u(reached) A + (slopes of friction in a step of `dt`)
    /// ```
    ///
    /// Nor is it taken to have where it is near, after a step in which states remember where they began or vertices rest,
    /// or a part that adds little to what is reached.
    fn parted(
        &mut self,
        following: &mut Following<C>,
        reached: Option<f64>,
        dt: f64,
    ) -> Option<usize> {
        let expected = match reached {
            None => [self.state.velocity.as_slice(); 2],
            Some(_) => [following.reached[0].as_slice(), &following.expected],
        };
        let found = self.trial.velocity.as_slice();
        let may_be_near = reached.is_none_or(|reached| dt <= SHORT * reached);
        let parted = if may_be_near {
            let part = reached.map(|reached| dt / reached - 1.0);
            let parted = self.contacts.parted(expected, found, part);
            if !self.operators.step.any(parted.is_some()) {
                return None;
            }
            parted.unwrap_or(ELSEWHERE)
        } else {
            0
        };
        (self.contacts).weakest(expected, found, &mut following.slopes);
        let rising = following.slopes.iter().all(|&slope| slope == 0.0);
        if self.operators.step.all(rising) {
            return None;
        }
        let rule = |dt| self.method.scheme.rule(dt);
        let part = reached.filter(|&reached| reached > 0.0);
        let c_u = part.map_or(0.0, |reached| rule(reached).displacement.new_velocity);
        let factors = (c_u, rule(dt).acceleration.new_velocity);
        let unique = reached.is_none() && self.stands_easily(following, factors)
            || self.stands(&mut following.definite, factors, &following.slopes);
        (!unique).then_some(parted)
    }

    /// Whether the operator with these factors stands more than the slopes of friction: a step that found so spares those
    /// after it the test.
    fn stands_easily(&mut self, following: &mut Following<C>, factors: (f64, f64)) -> bool {
        let Following {
            slopes,
            stood,
            definite,
            ..
        } = following;
        let are_known = following.factors == Some(factors)
            && slopes
                .iter()
                .zip(&*stood)
                .all(|(slope, stood)| slope >= stood);
        if self.operators.step.all(are_known) {
            return true;
        }
        for (stood, slope) in stood.iter_mut().zip(slopes) {
            *stood = SPARE * *slope;
        }
        let stands = self.stands(definite, factors, stood);
        following.factors = stands.then_some(factors);
        stands
    }

    /// Whether the operator with these factors is definite with these slopes of friction.
    fn stands(&mut self, definite: &mut Definite<C>, factors: (f64, f64), slopes: &[f64]) -> bool {
        let slopes = (self.contacts.vertices.as_slice(), slopes);
        let fixed = &self.constraints.fixed;
        (self.operators).stands(definite, &self.scene, factors, slopes, fixed)
    }

    /// That no solution continues the last step, as seen at a frictional vertex.
    fn fold(&self, k: usize, following: &Following<C>, (reached, dt): (f64, f64)) -> StepError {
        let Some(&vertex) = self.contacts.vertices.get(k) else {
            return StepError::Elsewhere;
        };
        let from = if reached == 0.0 {
            &self.state.velocity
        } else {
            &following.reached[0]
        };
        StepError::Fold {
            vertex,
            slip_rate: modulus(&self.contacts.slip_velocity(k, &from[vertex])),
            reached,
            dt,
            resisted: self.is_resisted(),
        }
    }

    /// Whether the scene has inertia or damping.
    pub(crate) fn is_resisted(&self) -> bool {
        self.scene.mass.is_some() || !self.scene.viscosity.is_empty()
    }
}
