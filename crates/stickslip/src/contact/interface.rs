//! What a contact is to the time loop: laws and states, vertex by vertex, whatever their types.

use stickslip_friction::{FrictionLaw, Nodal, Response};
use stickslip_state::{Reads, StateError, StateLaw, StateVariable};

use super::normal_stress_effect::{NormalStressEffect, Unloaded};
use super::state_update::StateStep;
use super::vertex_law::{VertexLaw, VertexState};
use crate::SceneError;

/// Rates of creep and of slip [m/s].
const CREEP: [f64; 4] = [1e-15, 1e-9, 1e-5, 0.1];

/// A state that could not be advanced, at a vertex of the contact.
pub(crate) struct Stuck {
    pub(crate) place: usize,
    pub(crate) slip_rate: f64,
    pub(crate) source: StateError,
}

/// What a contact starts a step from: states and slip rates; normal stresses before and after.
pub(crate) struct Beginning<'a> {
    pub(crate) states: &'a [f64],
    pub(crate) rates: &'a [f64],
    pub(crate) normal_stress: [&'a [f64]; 2],
}

/// The laws of a contact and the states of its vertices in a step. Vertices are counted along the contact.
pub(crate) trait Interface: Send + Sync {
    /// Checks laws and initial states for so many vertices, and takes all memory.
    fn build(&mut self, count: usize) -> Result<(), SceneError>;

    /// Whether there is a state at all.
    fn has_state(&self) -> bool;

    /// Whether friction may weaken with the slip rate, its state following if it has one: without, only where nobody
    /// has looked at the law.
    fn may_weaken(&self) -> bool;

    /// Whether friction depends on the slip rate, its state as it is: it lets what it holds creep.
    fn depends_on_rate(&self) -> bool;

    /// The state in use.
    fn state(&self, k: usize) -> f64;

    /// The state at the start.
    #[cfg(feature = "serde")]
    fn initial_state(&self, k: usize) -> f64;

    /// Freezes another state.
    fn set_state(&mut self, k: usize, state: f64);

    /// Begins a step, with the states frozen.
    fn begin(&mut self, step: StateStep, from: Beginning<'_>) -> Result<(), Unloaded>;

    /// The slip rates near which searches of this step begin: those of its start, unless others are given.
    fn aim(&mut self, rates: &[f64]);

    /// From here on the state follows the slip rate, or is frozen again.
    fn eliminate(&mut self, eliminated: bool);

    /// The states that belong to these slip rates; how far they lie from those in use goes to `changes`.
    fn propose(&mut self, rates: &[f64], changes: &mut [f64]) -> Result<(), Stuck>;

    /// Moves the states in use by the share `relaxation` towards those proposed.
    fn relax(&mut self, relaxation: f64);

    /// The states of the end of the step that belong to two slip rates; none without a state, or where the law
    /// has no answer.
    fn proposals(&self, k: usize, rates: [f64; 2]) -> Option<[f64; 2]>;

    /// `mu(V)` of the step.
    fn coefficient(&self, k: usize, slip_rate: f64) -> f64;

    /// `mu(V)` and its slope.
    fn coefficient_and_rate_slope(&self, k: usize, slip_rate: f64) -> (f64, f64);

    /// Whether `mu`, its state following, falls with the slip rate to which the state in use belongs.
    fn weakens(&self, k: usize, slip_rate: f64) -> bool;

    /// The integral of `mu`.
    fn potential(&self, k: usize, slip_rate: f64) -> f64;

    /// The `V` with `viscosity V + mu(V) = drive`.
    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64) -> f64;

    /// `mu(V, alpha)` and its slopes, outside of any step.
    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response;

    /// `V dmu/dV` and `dmu/dln(theta)`, the direct and the evolution effect, with the state in use; the latter per unit of
    /// what the friction law reads, if that is not `ln(theta)`.
    fn effects(&self, k: usize, slip_rate: f64) -> [f64; 2];

    /// `alpha'`, outside of any step.
    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64;

    /// How far two states are apart, on the scale on which the state matters.
    fn distance(&self, a: f64, b: f64) -> f64;

    /// The state after a step from `(state, rate)` to the slip rate `to`, by the law's own step, while the normal
    /// stress changes from one value to another; not a number where it may not.
    fn advance(
        &self,
        k: usize,
        step: StateStep,
        from: (f64, f64),
        to: f64,
        normal_stress: [f64; 2],
    ) -> Result<f64, StateError>;

    /// How far the state in use is from where the present step begins, on the scale on which it matters.
    fn distance_from_start(&self, k: usize) -> f64;

    /// By how much slip alone would change the state in the present step, at the pace with which that begins: for
    /// Dieterich's law the slip over the slip distance. 0 without a state.
    fn change_by_slip(&self, k: usize, slip_rate: f64) -> f64;

    /// Whether the normal stress changes the state.
    fn follows_normal_stress(&self) -> bool;

    /// What a change of the normal stress alone makes of a state, and the derivative of that in the state.
    fn moved(&self, k: usize, state: f64, normal_stress: [f64; 2]) -> Result<(f64, f64), Unloaded>;
}

/// A friction law with the state law that feeds it, static for each vertex.
pub(crate) struct RateAndState<L, S: StateLaw> {
    pub(crate) friction: Nodal<L>,
    pub(crate) evolution: Nodal<S>,
    pub(crate) initial: Nodal<S::State>,
    /// Whether laws are sampled before they are used.
    sampled: bool,
    effect: Option<NormalStressEffect<S::State>>,
    vertices: Vec<VertexState<S::State>>,
    step: StateStep,
    eliminated: bool,
}

impl<L, S: StateLaw> RateAndState<L, S> {
    pub(crate) fn new(
        friction: Nodal<L>,
        evolution: Nodal<S>,
        initial: Nodal<S::State>,
        effect: Option<NormalStressEffect<S::State>>,
        sampled: bool,
    ) -> Self {
        Self {
            friction,
            evolution,
            initial,
            sampled,
            effect,
            vertices: Vec::new(),
            step: StateStep {
                dt: 0.0,
                update: super::StateUpdate::default(),
            },
            eliminated: false,
        }
    }

    /// The law of a vertex in the present step.
    #[inline]
    fn at(&self, k: usize) -> VertexLaw<'_, L, S> {
        VertexLaw {
            friction: self.friction.at(k),
            evolution: self.evolution.at(k),
            vertex: &self.vertices[k],
            eliminated: self.eliminated.then_some(self.step),
            shift: self.effect.as_ref().map(|effect| effect.after(k)),
            unchecked: size_of::<S::State>() == 0 && !self.sampled,
        }
    }

    /// The state that belongs to a slip rate at the end of the present step.
    #[inline]
    fn advanced(&self, k: usize, slip_rate: f64) -> Result<S::State, StateError> {
        let (law, vertex) = (self.evolution.at(k), &self.vertices[k]);
        let advanced = self
            .step
            .advance(law, vertex.start, vertex.start_rate, slip_rate)?;
        Ok(match &self.effect {
            Some(effect) => effect.after(k).of(advanced),
            None => advanced,
        })
    }
}

impl<L, S> Interface for RateAndState<L, S>
where
    L: FrictionLaw,
    S: StateLaw,
    L::State: Reads<S::State>,
{
    fn build(&mut self, count: usize) -> Result<(), SceneError> {
        super::check::length("friction law", &self.friction, count)?;
        super::check::length("state law", &self.evolution, count)?;
        super::check::length("initial state", &self.initial, count)?;
        self.vertices.clear();
        for k in 0..count {
            let state = *self.initial.at(k);
            self.friction.at(k).validate()?;
            self.evolution.at(k).validate()?;
            super::check::finite("initial state", k, state.value())?;
            self.evolution.at(k).validate_state(state)?;
            self.vertices.push(VertexState::at_rest(state));
        }
        if let Some(effect) = &mut self.effect {
            effect.build(count)?;
        }
        // A contact has no vertex in some processes of several.
        if self.sampled && count > 0 {
            super::check::laws(&self.friction, &self.evolution, &self.initial)?;
        }
        Ok(())
    }

    fn has_state(&self) -> bool {
        size_of::<S::State>() > 0
    }

    fn may_weaken(&self) -> bool {
        self.has_state() || !self.sampled
    }

    fn depends_on_rate(&self) -> bool {
        let rest = |k| self.coefficient(k, 0.0);
        (0..self.vertices.len()).any(|k| {
            CREEP
                .iter()
                .any(|&rate| self.coefficient(k, rate) != rest(k))
        })
    }

    fn state(&self, k: usize) -> f64 {
        self.vertices[k].state.value()
    }

    #[cfg(feature = "serde")]
    fn initial_state(&self, k: usize) -> f64 {
        self.initial.at(k).value()
    }

    fn set_state(&mut self, k: usize, state: f64) {
        self.vertices[k].state = S::State::from_value(state);
    }

    fn begin(&mut self, step: StateStep, from: Beginning<'_>) -> Result<(), Unloaded> {
        self.step = step;
        self.eliminated = false;
        for (vertex, &state) in self.vertices.iter_mut().zip(from.states) {
            vertex.state = S::State::from_value(state);
            vertex.start = vertex.state;
        }
        for (vertex, &rate) in self.vertices.iter_mut().zip(from.rates) {
            (vertex.start_rate, vertex.aim) = (rate, rate);
        }
        if let Some(effect) = &mut self.effect {
            for (k, vertex) in self.vertices.iter_mut().enumerate() {
                let normal_stress = from.normal_stress.map(|stress| stress[k]);
                vertex.start = effect.begin(k, vertex.start, step.update, normal_stress)?;
            }
        }
        Ok(())
    }

    fn aim(&mut self, rates: &[f64]) {
        for (vertex, &rate) in self.vertices.iter_mut().zip(rates) {
            vertex.aim = rate;
        }
    }

    fn eliminate(&mut self, eliminated: bool) {
        self.eliminated = eliminated && self.has_state();
    }

    fn propose(&mut self, rates: &[f64], changes: &mut [f64]) -> Result<(), Stuck> {
        for (place, (&slip_rate, change)) in rates.iter().zip(changes).enumerate() {
            let proposed = self.advanced(place, slip_rate).map_err(|source| Stuck {
                place,
                slip_rate,
                source,
            })?;
            let vertex = &mut self.vertices[place];
            *change = proposed.value() - vertex.state.value();
            vertex.proposed = proposed;
        }
        Ok(())
    }

    fn proposals(&self, k: usize, rates: [f64; 2]) -> Option<[f64; 2]> {
        if !self.has_state() {
            return None;
        }
        let advanced = |rate| self.advanced(k, rate).map(StateVariable::value).ok();
        Some([advanced(rates[0])?, advanced(rates[1])?])
    }

    fn relax(&mut self, relaxation: f64) {
        for vertex in &mut self.vertices {
            // The whole way must not pass through a rounded difference.
            vertex.state = if relaxation == 1.0 {
                vertex.proposed
            } else {
                let from = vertex.state.value();
                S::State::from_value(from + relaxation * (vertex.proposed.value() - from))
            };
        }
    }

    fn coefficient(&self, k: usize, slip_rate: f64) -> f64 {
        self.at(k).coefficient(slip_rate)
    }

    fn coefficient_and_rate_slope(&self, k: usize, slip_rate: f64) -> (f64, f64) {
        self.at(k).coefficient_and_rate_slope(slip_rate)
    }

    fn weakens(&self, k: usize, slip_rate: f64) -> bool {
        if self.has_state() {
            self.at(k).weakens(self.step, slip_rate)
        } else {
            self.coefficient_and_rate_slope(k, slip_rate).1 < 0.0
        }
    }

    fn potential(&self, k: usize, slip_rate: f64) -> f64 {
        self.at(k).potential(slip_rate)
    }

    fn slip_rate(&self, k: usize, viscosity: f64, drive: f64) -> f64 {
        self.at(k).slip_rate(viscosity, drive)
    }

    fn response(&self, k: usize, slip_rate: f64, state: f64) -> Response {
        let state = S::State::from_value(state);
        let mut response = self
            .friction
            .at(k)
            .response(slip_rate, L::State::read(state));
        response.state_slope *= L::State::slope(state);
        response
    }

    fn effects(&self, k: usize, slip_rate: f64) -> [f64; 2] {
        let read = L::State::read(self.vertices[k].state);
        let response = self.friction.at(k).response(slip_rate, read);
        [slip_rate * response.rate_slope, response.state_slope]
    }

    fn evolution(&self, k: usize, slip_rate: f64, state: f64) -> f64 {
        (self.evolution.at(k)).evolution(S::State::from_value(state), slip_rate)
    }

    fn distance(&self, a: f64, b: f64) -> f64 {
        S::State::from_value(a).distance(S::State::from_value(b))
    }

    fn advance(
        &self,
        k: usize,
        step: StateStep,
        (state, rate): (f64, f64),
        to: f64,
        normal_stress: [f64; 2],
    ) -> Result<f64, StateError> {
        let (law, from) = (self.evolution.at(k), S::State::from_value(state));
        let Some(effect) = &self.effect else {
            return Ok(step.advance(law, from, rate, to)?.value());
        };
        let shift = effect.shift(k, normal_stress).unwrap_or(f64::NAN);
        let [before, after] = step.update.shares().map(|share| effect.by(share * shift));
        let advanced = step.advance(law, before.of(from), rate, to)?;
        Ok(after.of(advanced).value())
    }

    fn distance_from_start(&self, k: usize) -> f64 {
        let VertexState { state, start, .. } = self.vertices[k];
        state.distance(start)
    }

    fn change_by_slip(&self, k: usize, slip_rate: f64) -> f64 {
        let (law, start) = (self.evolution.at(k), self.vertices[k].start);
        self.step.dt * (law.evolution(start, 0.0) - law.evolution(start, slip_rate)).abs()
    }

    fn follows_normal_stress(&self) -> bool {
        self.effect.is_some()
    }

    fn moved(&self, k: usize, state: f64, normal_stress: [f64; 2]) -> Result<(f64, f64), Unloaded> {
        let Some(effect) = &self.effect else {
            return Ok((state, 1.0));
        };
        let shift = effect.by(effect.shift(k, normal_stress)?);
        let state = S::State::from_value(state);
        Ok((shift.of(state).value(), shift.slope(state)))
    }
}
