//! Whether a step is one: its equations, evaluated from what the simulation shows.

use nalgebra::SVector;
use stickslip::friction::{FrictionLaw, Nodal};
use stickslip::state::{StateLaw, StateVariable};
use stickslip::time::{Motion, RateScheme};
use stickslip::{Newmark, Operator, Snapshot, StateUpdate, Stepper};

use crate::case::{Outcome, Verdict};

/// Roundings of the terms of an equation that its residual may have.
const ROUNDINGS: f64 = 64.0;
/// The velocity is known up to this many tolerances of the coupling: the last change was below one,
/// the state may lag behind it by another, and a relaxed one by twice that.
const TOLERANCES: f64 = 8.0;
/// The change of the velocity that the coupling takes for rounding, over the velocity.
const RELATIVE: f64 = 1e-12;
/// How often a step that failed is tried with a tenth of its size.
const RETRIES: i32 = 3;

/// What a simulation shows after a step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Moment<const C: usize> {
    step: usize,
    time: f64,
    displacement: Vec<SVector<f64, C>>,
    velocity: Vec<SVector<f64, C>>,
    acceleration: Vec<SVector<f64, C>>,
    states: Vec<f64>,
}

impl<const C: usize> Moment<C> {
    pub(crate) fn of(at: &Snapshot<'_, C>) -> Self {
        Self {
            step: at.step,
            time: at.time,
            displacement: at.displacement.to_vec(),
            velocity: at.velocity.to_vec(),
            acceleration: at.acceleration.to_vec(),
            states: (0..at.frictional.len())
                .map(|k| at.states.state(k))
                .collect(),
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let fields = [&self.displacement, &self.velocity, &self.acceleration];
        self.time.is_finite()
            && fields
                .iter()
                .all(|field| field.iter().flatten().all(|x| x.is_finite()))
            && self.states.iter().all(|state| state.is_finite())
    }
}

/// The equations of a scene, apart from the scene.
pub(crate) struct Equations<Op, L, S, const C: usize> {
    pub(crate) stiffness: Op,
    pub(crate) mass: Option<Op>,
    pub(crate) viscosity: Option<Op>,
    /// The operators by the moduli of their entries, in this order.
    pub(crate) moduli: [Option<Op>; 3],
    pub(crate) load: Box<dyn Fn(f64) -> Vec<SVector<f64, C>>>,
    pub(crate) friction: Nodal<L>,
    pub(crate) law: Nodal<S>,
    pub(crate) normal_stress: Nodal<f64>,
    pub(crate) vertices: Vec<usize>,
    pub(crate) weights: Vec<f64>,
    pub(crate) fixed: Vec<[bool; C]>,
    pub(crate) update: StateUpdate,
    pub(crate) tolerance: f64,
    /// `A + M`.
    pub(crate) norm: Op,
    /// The largest diagonal entry of the inverse of `A + M` on the free components.
    pub(crate) compliance: f64,
}

impl<Op, L, S, const C: usize> Equations<Op, L, S, C>
where
    Op: Operator<C>,
    L: FrictionLaw,
    S: StateLaw,
    L::State: From<S::State>,
{
    /// The largest residual of a step as a share of what is allowed, or what is wrong.
    pub(crate) fn check(&self, from: &Moment<C>, to: &Moment<C>, dt: f64) -> Result<f64, String> {
        if !to.is_finite() {
            return Err("a result that is not finite".into());
        }
        let size = to.velocity.len();
        let scheme = Newmark::default();
        let c = scheme.coefficients(dt);
        let (mut left, mut terms) = ((self.load)(to.time), (self.load)(to.time));
        for l in &mut terms {
            *l = l.abs();
        }
        let mut u_terms = vec![SVector::zeros(); size];
        let mut a_terms = vec![SVector::zeros(); size];
        let mut v_terms = vec![SVector::zeros(); size];
        for i in 0..size {
            for k in 0..C {
                let old = Motion {
                    displacement: from.displacement[i][k],
                    velocity: from.velocity[i][k],
                    acceleration: from.acceleration.get(i).map_or(0.0, |a| a[k]),
                    carried: 0.0,
                };
                let v = to.velocity[i][k];
                // u = u_o + dt (v_o + v)/2, a = 2 (v - v_o)/dt - a_o
                let u_sum = old.displacement.abs() + 0.5 * dt * (old.velocity.abs() + v.abs());
                let u = old.displacement + 0.5 * dt * (old.velocity + v);
                if (u - to.displacement[i][k]).abs()
                    > 16.0 * f64::EPSILON * u_sum + f64::MIN_POSITIVE
                {
                    return Err(format!(
                        "displacement {:e} at vertex {i} should be {u:e}",
                        to.displacement[i][k]
                    ));
                }
                u_terms[i][k] = u_sum;
                v_terms[i][k] = v.abs();
                if let Some(a) = to.acceleration.get(i) {
                    let sum = old.acceleration.abs() + 2.0 / dt * (old.velocity.abs() + v.abs());
                    let expected = 2.0 / dt * (v - old.velocity) - old.acceleration;
                    if (expected - a[k]).abs() > 16.0 * f64::EPSILON * sum {
                        return Err(format!(
                            "acceleration {:e} at vertex {i} should be {expected:e}",
                            a[k]
                        ));
                    }
                    a_terms[i][k] = sum;
                }
            }
        }
        // A velocity that is known up to `deviation` leaves B deviation.
        let norm = self
            .norm
            .norm(&to.velocity)
            .max(self.norm.norm(&from.velocity));
        let uncertainty = TOLERANCES * self.tolerance.max(RELATIVE * norm);
        let deviation = uncertainty * self.compliance.sqrt();
        let everywhere = vec![SVector::repeat(deviation); size];
        let mut slack = vec![SVector::zeros(); size];
        let parts = [
            (
                Some(&self.stiffness),
                &to.displacement,
                &u_terms,
                c.displacement,
            ),
            (
                self.mass.as_ref(),
                &to.acceleration,
                &a_terms,
                c.acceleration,
            ),
            (self.viscosity.as_ref(), &to.velocity, &v_terms, 1.0),
        ];
        for ((operator, field, sums, weight), moduli) in parts.into_iter().zip(&self.moduli) {
            if let (Some(operator), Some(moduli)) = (operator, moduli) {
                operator.multiply_add(-1.0, field, &mut left);
                moduli.multiply_add(1.0, sums, &mut terms);
                moduli.multiply_add(weight, &everywhere, &mut slack);
            }
        }
        let mut worst: f64 = 0.0;
        let mut frictional = self.vertices.iter().copied().enumerate().peekable();
        for i in 0..size {
            for k in (0..C).filter(|&k| self.fixed[i][k]) {
                left[i][k] = 0.0;
            }
            let allowed = slack[i].amax() + ROUNDINGS * f64::EPSILON * terms[i].amax();
            let share = match frictional.next_if(|&(_, vertex)| vertex == i) {
                Some((k, _)) => {
                    self.check_state(k, from, to, i, dt)?;
                    self.friction_share(k, (from, to), &left[i], (allowed, deviation), dt)?
                }
                None => share(left[i].norm(), allowed),
            };
            if share.is_nan() || share > 1.0 {
                return Err(format!(
                    "step {}: residual {:.2e} N at vertex {i} at {:.3e} m/s, {share:.2e} times what is allowed",
                    to.step,
                    left[i].norm(),
                    to.velocity[i].norm()
                ));
            }
            worst = worst.max(share);
        }
        Ok(worst)
    }

    /// By how much what is left at a frictional vertex is no friction, as a share of what is allowed.
    ///
    /// Friction may be that of any slip rate within `deviation`, with the state of any other.
    fn friction_share(
        &self,
        k: usize,
        (from, to): (&Moment<C>, &Moment<C>),
        left: &SVector<f64, C>,
        (allowed, deviation): (f64, f64),
        dt: f64,
    ) -> Result<f64, String> {
        let vertex = self.vertices[k];
        let speed = to.velocity[vertex].norm();
        let deviation = deviation + 4.0 * f64::EPSILON * speed + f64::MIN_POSITIVE;
        let force = self.weights[k] * self.normal_stress.at(k).abs();
        let law = self.friction.at(k);
        let friction = |rate: f64, state: f64| {
            force * law.coefficient(rate, S::State::from_value(state).into())
        };
        let state = to.states[k];
        let (slow, fast) = ((speed - deviation).max(0.0), speed + deviation);
        let old = from.velocity[vertex].norm();
        let start = from.states[k];
        let ends = [
            self.advance(k, start, (old, fast), dt)?,
            self.advance(k, start, (old, slow), dt)?,
        ];
        let (young, aged) = (
            state.min(ends[0]).min(ends[1]),
            state.max(ends[0]).max(ends[1]),
        );
        let (low, high) = (
            friction(slow, young).min(friction(slow, aged)),
            friction(fast, aged).max(friction(fast, young)),
        );
        let now = friction(speed, state);
        // What rounding the state and the logarithm of the rate does.
        let variable = S::State::from_value(state).into();
        let by_state = law.coefficient_state_slope(fast, variable).abs() * state.abs();
        let by_rate = fast * law.coefficient_slope(fast, variable) * (fast.ln().abs() + 60.0);
        let rounding = ROUNDINGS * f64::EPSILON * (high + force * (by_state + by_rate));
        let allowed = allowed + rounding;
        if speed <= deviation {
            return Ok(share((left.norm() - high).max(0.0), allowed));
        }
        let along = left.dot(&(to.velocity[vertex] / speed));
        let across = (left - to.velocity[vertex] * (along / speed)).norm();
        let turned = allowed + high * deviation / speed;
        let range = (high - now).max(now - low);
        Ok(share((along - now).abs(), allowed + range).max(share(across, turned)))
    }

    /// The state at the end of a step, by the law's own step.
    fn advance(&self, k: usize, from: f64, (old, new): (f64, f64), dt: f64) -> Result<f64, String> {
        let start = S::State::from_value(from);
        let law = self.law.at(k);
        match self.update {
            StateUpdate::BackwardEuler => law.advance(start, new, dt),
            StateUpdate::Midpoint => law.advance_at_constant_rate(start, 0.5 * old + 0.5 * new, dt),
        }
        .map(StateVariable::value)
        .map_err(|error| error.to_string())
    }

    /// Backward Euler by its equation, the midpoint rule by two steps of half the size.
    fn check_state(
        &self,
        k: usize,
        from: &Moment<C>,
        to: &Moment<C>,
        vertex: usize,
        dt: f64,
    ) -> Result<(), String> {
        let (start, end) = (from.states[k], to.states[k]);
        let (old, new) = (from.velocity[vertex].norm(), to.velocity[vertex].norm());
        let law = self.law.at(k);
        let near = 16.0 * f64::EPSILON * (start.abs() + end.abs() + 1.0);
        let holds = match self.update {
            StateUpdate::BackwardEuler => {
                let residual =
                    |x: f64| x - start - dt * law.evolution(S::State::from_value(x), new);
                residual(end - near) <= 0.0 && residual(end + near) >= 0.0
            }
            StateUpdate::Midpoint => {
                let rate = 0.5 * old + 0.5 * new;
                let half = |x: f64| law.advance_exact(S::State::from_value(x), rate, 0.5 * dt);
                let twice = half(start).and_then(|middle| half(middle.value()));
                twice.is_none_or(|twice| (twice.value() - end).abs() <= 4.0 * near)
            }
        };
        if holds {
            Ok(())
        } else {
            Err(format!(
                "step {}: state {end} at vertex {vertex} does not follow {start} at {new:e} m/s",
                to.step
            ))
        }
    }
}

/// 0 for nothing left, also where nothing is allowed.
fn share(left: f64, allowed: f64) -> f64 {
    if left == 0.0 { 0.0 } else { left / allowed }
}

/// Takes `steps` steps of `dt` [s] and checks each. A step that fails must leave no trace, and smaller
/// ones are tried in its place.
pub(crate) fn march<const C: usize>(
    stepper: &mut dyn Stepper<C>,
    steps: usize,
    dt: f64,
    check: &dyn Fn(&Moment<C>, &Moment<C>, f64) -> Result<f64, String>,
) -> Verdict {
    let mut verdict = Verdict::new(Outcome::Solved, "");
    let mut from = Moment::of(&stepper.snapshot());
    let (mut size, mut retries) = (dt, 0);
    for _ in 0..steps {
        loop {
            match stepper.step(size) {
                Ok(report) => {
                    let to = Moment::of(&stepper.snapshot());
                    match check(&from, &to, size) {
                        Ok(residual) => verdict.residual = verdict.residual.max(residual),
                        Err(text) => {
                            verdict.outcome = Outcome::Defect;
                            verdict.text = text;
                            return verdict;
                        }
                    }
                    let (most, work) = &mut verdict.iterations;
                    *most = report.coupling_iterations.max(*most);
                    *work = report.solver_iterations.max(*work);
                    from = to;
                    if retries > 0 {
                        verdict.resumed = Some(size / dt);
                        return verdict;
                    }
                    break;
                }
                Err(failure) => {
                    let text = failure.to_string();
                    let traced = Moment::of(&stepper.snapshot()) != from;
                    if traced || text.contains('\n') {
                        verdict.outcome = Outcome::Defect;
                        verdict.text = format!("a failed step left its trace: {text}");
                        return verdict;
                    }
                    if retries == 0 {
                        verdict.outcome = Outcome::Reported;
                        verdict.text = text;
                    }
                    retries += 1;
                    if retries > RETRIES {
                        return verdict;
                    }
                    size *= 0.1;
                }
            }
        }
    }
    verdict
}
