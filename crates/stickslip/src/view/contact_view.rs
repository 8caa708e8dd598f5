//! A view of a contact after a step.

use nalgebra::SVector;
use stickslip_friction::{Response, modulus};

use super::StepView;
use crate::contact::DiscreteContact;
use crate::{ContactState, SceneError, StepState};

/// A contact at an accepted step. Its vertices are numbered as in its boundary part.
///
/// The number `k` of a vertex is an index into a slice: a method panics unless `k` is below [`len`](Self::len).
/// [`check`](Self::check) refuses such a number, and [`position_of`](Self::position_of) returns none.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::{GeneralizedAlpha, Point, Simulation, Steps};
///
/// let slider = SpringSlider {
///     stiffness: 1e9,
///     normal_stress: 1e6,
///     mass: 0.0,
///     damping: 0.0,
///     load: LoadPath::steady(1e-6),
/// };
/// let mut simulation = Simulation::new(slider.steady(FRICTION, AGING, 1e-6)?, GeneralizedAlpha::default(), Point)?;
/// simulation.run(&Steps::constant(0.1).count(20), |at| {
///     let block = at.contact(0);
///     assert!((block.coefficient(0) - 0.6).abs() < 1e-12);
///     assert!((block.traction(0)[0] - 0.6 * block.normal_stress(0)).abs() < 1e-5);
///     assert!((block.slip(0) - 1e-6 * at.time).abs() < 1e-15);
/// })?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct ContactView<'a, const C: usize> {
    pub(super) contact: &'a DiscreteContact<C>,
    pub(super) at: &'a ContactState<C>,
    state: &'a StepState<C>,
    source: &'a dyn StepView<C>,
}

impl<'a, const C: usize> ContactView<'a, C> {
    pub(super) fn new(state: &'a StepState<C>, source: &'a dyn StepView<C>, index: usize) -> Self {
        Self {
            contact: &source.contacts().contacts[index],
            at: &state.contacts[index],
            state,
            source,
        }
    }

    /// The number of vertices.
    pub fn len(&self) -> usize {
        self.contact.part.vertices.len()
    }

    /// Whether there are no vertices; a contact has at least one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the number `k` if such a vertex exists, for numbers from outside a program.
    ///
    /// # Errors
    /// [`SceneError::Index`].
    pub fn check(&self, k: usize) -> Result<usize, SceneError> {
        SceneError::check_index("vertex of the contact", k, self.len())
    }

    /// The vertex number `k` in the numbering of the body.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn vertex(&self, k: usize) -> usize {
        self.contact.part.vertices[k]
    }

    /// The position in the contact of a vertex of the body.
    pub fn position_of(&self, vertex: usize) -> Option<usize> {
        self.contact.position_of(vertex)
    }

    /// The position of vertex number `k` \[m\]; a plane body uses two coordinates, and a point is at the origin.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn point(&self, k: usize) -> [f64; 3] {
        let points = &self.contact.part.points;
        if points.is_empty() {
            assert!(k < self.len(), "vertex {k} of {}", self.len());
            return [0.0; 3];
        }
        points[k]
    }

    /// The number of coordinates of its points: 1 along a planar fault by boundary integrals, 2 in the plane, 3 in
    /// space, 0 if unknown.
    pub fn dimension(&self) -> usize {
        self.contact.part.dimension
    }

    /// The area of vertex number `k`, the integral of its hat function [m^2; m in 2D].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn weight(&self, k: usize) -> f64 {
        self.contact.part.weights[k]
    }

    /// The slip of vertex number `k` since the start, the length of the [slip vector](Self::slip_vector) \[m\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip(&self, k: usize) -> f64 {
        modulus(&self.slip_vector(k))
    }

    /// The length of the path of slip of vertex number `k` \[m\]: the sum over all steps, larger than the
    /// [slip](Self::slip) where the slip velocity turns.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_path(&self, k: usize) -> f64 {
        self.at.slip[k]
    }

    /// The slip vector of vertex number `k` since the start \[m\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_vector(&self, k: usize) -> SVector<f64, C> {
        let moved = self.state.displacement[self.vertex(k)] - self.at.origin[k];
        self.seen(k, self.contact.tangential(k, &moved))
    }

    /// The slip velocity of vertex number `k` [m/s].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_velocity(&self, k: usize) -> SVector<f64, C> {
        self.seen(k, self.own_slip_velocity(k))
    }

    /// The slip velocity in the local frame of the vertex.
    fn own_slip_velocity(&self, k: usize) -> SVector<f64, C> {
        let velocity = &self.state.velocity[self.vertex(k)];
        self.contact.tangential(k, velocity)
    }

    /// Rotates a vector at vertex number `k` from its local frame to coordinates.
    fn seen(&self, k: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        self.source.to_coordinates(self.vertex(k), vector)
    }

    /// The slip rate of vertex number `k` [m/s].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_rate(&self, k: usize) -> f64 {
        self.contact.slip_rate(k, &self.state.velocity)
    }

    /// The largest slip rate [m/s].
    pub fn max_slip_rate(&self) -> f64 {
        self.contact.max_slip_rate(&self.state.velocity)
    }

    /// Whether the contact has a state.
    pub fn has_state(&self) -> bool {
        !self.at.states.is_empty()
    }

    /// The state of vertex number `k`, in the state law's own variable; 0 for a contact without state.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn state(&self, k: usize) -> f64 {
        if !self.has_state() {
            assert!(k < self.len(), "vertex {k} of {}", self.len());
            return 0.0;
        }
        self.at.states[k]
    }

    /// The normal distance of both sides at vertex number `k` \[m\], where the contact is open; 0 where it is closed and
    /// for contacts that keep their sides together, see [`allow_opening`](crate::Contact::allow_opening).
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn opening(&self, k: usize) -> f64 {
        self.contact
            .gap(k, &self.state.displacement[self.vertex(k)])
    }

    /// The coefficient of friction of vertex number `k` at its slip rate and state; at rest an upper bound of the
    /// mobilised friction.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn coefficient(&self, k: usize) -> f64 {
        self.response(k).coefficient
    }

    fn response(&self, k: usize) -> Response {
        let (rate, state) = (self.slip_rate(k), self.state(k));
        let time = self.state.clock.time();
        self.contact.response_at(time, k, rate, state)
    }

    /// The frictional strength of vertex number `k`, `c + mu abs(sigma_n)` \[Pa\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn strength(&self, k: usize) -> f64 {
        self.contact.cohesion(k) + self.coefficient(k) * self.effective_normal_stress(k)
    }

    /// The shear traction of the body on the surface \[Pa\], opposite to that of friction on the body. Where the vertex
    /// slides, it is the strength in the direction of slip. Where it sticks, it is the traction that balances the body,
    /// divided in proportion to strength where contacts meet. The balance is also used where the vertex creeps so
    /// slowly that the slip rate, at the solver's accuracy, determines the strength less accurately than the balance
    /// does.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn traction(&self, k: usize) -> SVector<f64, C> {
        let own = if self.slip_rate(k) > 0.0 && !self.creeps(k) {
            self.sliding_traction(k)
        } else {
            self.balanced_traction(k)
        };
        self.seen(k, own)
    }

    /// The traction that balances the body, divided in proportion to strength, in the local frame of the vertex \[Pa\].
    fn balanced_traction(&self, k: usize) -> SVector<f64, C> {
        let vertex = self.vertex(k);
        let (mut all, own) = (0.0, self.strength(k));
        for index in 0..self.state.contacts.len() {
            let other = Self::new(self.state, self.source, index);
            if let Some(k) = other.position_of(vertex) {
                all += other.strength(k) * other.weight(k);
            }
        }
        let force = self.contact.tangential(k, &self.source.unbalanced(vertex));
        let held = SVector::from_fn(|c, _| {
            if self.source.is_fixed(vertex, c) {
                0.0
            } else {
                force[c]
            }
        });
        if all > 0.0 {
            held * (own / all)
        } else {
            held * 0.0
        }
    }

    /// The shear force of the body on the surface \[N\]: the integral of the traction.
    pub fn force(&self) -> SVector<f64, C> {
        let vertices = 0..self.len();
        vertices.map(|k| self.traction(k) * self.weight(k)).sum()
    }

    /// Whether an error of the slip rate changes friction more than the balance of the body, at a vertex where friction
    /// alone enters the balance.
    fn creeps(&self, k: usize) -> bool {
        let (vertex, area) = (self.vertex(k), self.weight(k));
        let friction = area * self.effective_normal_stress(k) * self.response(k).rate_slope;
        let free = (0..C).all(|c| {
            let along = self
                .contact
                .tangential(k, &SVector::from_fn(|d, _| f64::from(u8::from(c == d))));
            along[c] == 0.0 || !self.source.is_fixed(vertex, c)
        });
        free && friction > self.source.diagonal_stiffness(vertex)
    }

    /// The strength in the direction of slip, zero at rest \[Pa\]; in the local frame of the vertex.
    pub(super) fn sliding_traction(&self, k: usize) -> SVector<f64, C> {
        let velocity = self.own_slip_velocity(k);
        let rate = modulus(&velocity);
        if rate > 0.0 {
            velocity / rate * self.strength(k)
        } else {
            SVector::zeros()
        }
    }
}
