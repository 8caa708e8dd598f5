//! Whether a step has a single solution, known before it is taken.

use stickslip_tnnmg::Operator;

use super::{Clock, Simulation};
use crate::StepError;
use crate::contact::StateStep;

/// How well the body resists the weakening of friction in the next step, see [`Simulation::convexity`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convexity {
    /// The velocity problem with the state eliminated is convex, so that the step has one solution.
    pub convex: bool,
    /// The frictional vertex at which `weakening` is the largest share of `resistance`.
    pub vertex: usize,
    /// Minus the least slope of the frictional force there, its state following, 0 where it does not weaken [N s/m].
    pub weakening: f64,
    /// The slip rate at which it is [m/s].
    pub slip_rate: f64,
    /// The least diagonal entry of the operator `B` there [N s/m]: above what the body resists.
    pub resistance: f64,
    /// The largest `b/a` of the contacts, `dmu/dln(theta)` over `dmu/dln(V)`; 0 without a state.
    pub effect_ratio: f64,
}

impl<Op: Operator<C>, const C: usize> Simulation<Op, C> {
    /// Whether a step of `dt` \[s\] from here is one convex problem for slip rates up to `max_slip_rate` [m/s]. Takes no
    /// step.
    ///
    /// With `m_k` the steepest weakening of the frictional force at vertex `k` over these slip rates, its state
    /// following by the step's own [`StateUpdate`](crate::StateUpdate), the problem is convex, and has at most one
    /// solution with such slip rates, if
    ///
    /// ```text
    /// B - diag(m_k),   B = c_a M + C + c_u A,   m_k = -min over V of w_k abs(sigma_n) dmu(V, S(V))/dV
    /// ```
    ///
    /// is positive definite, which conjugate gradients find out. This is sufficient and not necessary: friction weakens
    /// as steeply at some slip rate only, and not at all vertices at once. `weakening > resistance` at one vertex is enough
    /// for it to fail. The slope is sampled at slip rates 6 % apart, down to 1e-24 of the largest, and its
    /// minimum refined. It depends on the states that the step starts from: ask again when they have changed, after an event
    /// for instance. Of a scheme of several stages the first is looked at.
    ///
    /// For Dieterich's law `m_k` is below `b c w abs(sigma_n)/L` from any state, with `c = dt` by backward Euler and
    /// `c = dt/2` at the midpoint rate.
    ///
    /// ```
    /// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
    /// use stickslip::{Newmark, Point, Simulation};
    ///
    /// // Softer than b sigma_n/L = 1.5e9 Pa/m, so that only inertia makes a step convex.
    /// let load = LoadPath::steady(1e-6);
    /// let slider = SpringSlider { stiffness: 1e8, normal_stress: 1e6, mass: 1e5, damping: 0.0, load };
    /// let scene = slider.steady(FRICTION, AGING, 1e-6)?;
    /// let mut block = Simulation::new(scene, Newmark::default(), Point)?;
    /// let mut dt = 1.0;
    /// while !block.convexity(dt, 1.0)?.convex {
    ///     dt /= 2.0;
    /// }
    /// // 2 m/dt + K dt/2 > b sigma_n/L dt/2
    /// let limit = (4.0 * 1e5 / (1.5e9 - 1e8_f64)).sqrt();
    /// assert!(dt > 0.5 * limit && dt < 1.1 * limit);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`StepError::StepSize`] for a step that is not positive and finite, [`StepError::Control`] for such a slip rate, and what the
    /// normal stress of the new time is refused for.
    pub fn convexity(&mut self, dt: f64, max_slip_rate: f64) -> Result<Convexity, StepError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::StepSize { dt });
        }
        if !(max_slip_rate > 0.0 && max_slip_rate.is_finite()) {
            return Err(StepError::Control {
                what: "largest slip rate",
                value: max_slip_rate,
            });
        }
        let stage = self.method.scheme.facts().stages[0];
        let begin = self.state.clock.time();
        let next: Clock = self.state.clock.after(dt);
        let time = begin + stage.end * (next.time() - begin);
        let step = StateStep {
            dt: stage.share * dt,
            update: self.method.update_of_a_stage(),
        };
        self.trial.balanced = None;
        let begun = (self.contacts).begin(step, time, &self.state.contacts, &self.state.velocity);
        let convexity = begun.map(|()| self.look(step.dt, max_slip_rate));
        self.contacts.set_normal_stress(&self.state.contacts);
        convexity
    }

    /// The same for a stage of `dt` that has begun.
    fn look(&mut self, dt: f64, max_slip_rate: f64) -> Convexity {
        let effect_ratio = self.contacts.effect_ratio(max_slip_rate);
        let mut found = Convexity {
            convex: true,
            vertex: self.contacts.vertices.first().copied().unwrap_or(0),
            weakening: 0.0,
            slip_rate: 0.0,
            resistance: f64::INFINITY,
            effect_ratio,
        };
        let Some(mut following) = self.following.take() else {
            return found;
        };
        let rule = self.method.scheme.rule(dt);
        let factors = (
            rule.displacement.new_velocity,
            rule.acceleration.new_velocity,
        );
        let fixed = &self.constraints.fixed;
        self.contacts.eliminate(true);
        let mut share = f64::NEG_INFINITY;
        for (k, &vertex) in self.contacts.vertices.iter().enumerate() {
            let (slope, slip_rate) = self.contacts.steepest(k, max_slip_rate);
            following.slopes[k] = slope;
            let block = self.operators.block(&self.scene, factors, vertex);
            let free = (0..C).filter(|&c| !fixed[vertex][c]);
            let resistance = free.map(|c| block[(c, c)]).fold(f64::INFINITY, f64::min);
            if -slope / resistance > share || slope.is_nan() {
                share = -slope / resistance;
                (found.vertex, found.weakening) = (vertex, 0.0 - slope);
                (found.slip_rate, found.resistance) = (slip_rate, resistance);
            }
        }
        self.contacts.eliminate(false);
        let slopes = (self.contacts.vertices.as_slice(), &*following.slopes);
        let definite = &mut following.definite;
        found.convex = following.slopes.iter().all(|&slope| slope == 0.0)
            || (self.operators).stands(definite, &self.scene, factors, slopes, fixed);
        self.following = Some(following);
        found
    }
}
