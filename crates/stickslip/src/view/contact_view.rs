//! What is seen of a contact after a step.

use nalgebra::SVector;
use stickslip_friction::{Response, modulus};

use super::StepView;
use crate::contact::DiscreteContact;
use crate::{ContactState, SceneError, StepState};

/// A contact at an accepted step. Its vertices are counted as in the part it was made of.
///
/// A method that takes the number `k` of a vertex is an index into a slice: it panics unless `k` is below
/// [`len`](Self::len). [`check`](Self::check) refuses such a number, and [`position_of`](Self::position_of) gives
/// none.
///
/// ```
/// use stickslip::problems::{AGING, FRICTION, LoadPath, SpringSlider};
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
    contact: &'a DiscreteContact<C>,
    at: &'a ContactState<C>,
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

    /// Whether there are none; there always are some.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number `k` if there is such a vertex, for numbers from outside of a program.
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

    /// The position of a vertex of the body in the contact.
    pub fn position_of(&self, vertex: usize) -> Option<usize> {
        self.contact.part.vertices.binary_search(&vertex).ok()
    }

    /// Where vertex number `k` lies \[m\]; a plane body uses two coordinates, and a point is at the origin.
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

    /// The coordinates that a point of it uses: 1 along a fault without a mesh, 2 in the plane, 3 in space, 0 where nobody knows.
    pub fn dimension(&self) -> usize {
        self.contact.part.dimension
    }

    /// Its share of the surface [m^2; m in 2D].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn weight(&self, k: usize) -> f64 {
        self.contact.part.weights[k]
    }

    /// The path length of its slip so far \[m\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip(&self, k: usize) -> f64 {
        self.at.slip[k]
    }

    /// Its slip since the start as a vector \[m\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_vector(&self, k: usize) -> SVector<f64, C> {
        let moved = self.state.displacement[self.vertex(k)] - self.at.origin[k];
        self.seen(k, self.contact.tangential(k, &moved))
    }

    /// Its tangential velocity [m/s].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn slip_velocity(&self, k: usize) -> SVector<f64, C> {
        self.seen(k, self.own_slip_velocity(k))
    }

    /// The same in the frame of the vertex.
    fn own_slip_velocity(&self, k: usize) -> SVector<f64, C> {
        let velocity = &self.state.velocity[self.vertex(k)];
        self.contact.tangential(k, velocity)
    }

    /// A vector at the vertex number `k` from its frame to coordinates.
    fn seen(&self, k: usize, vector: SVector<f64, C>) -> SVector<f64, C> {
        self.source.to_coordinates(self.vertex(k), vector)
    }

    /// The modulus of that [m/s].
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

    /// Whether the contact holds a state.
    pub fn has_state(&self) -> bool {
        !self.at.states.is_empty()
    }

    /// Its state, in the state law's own variable; 0 for a contact without one.
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

    /// The normal stress \[Pa\], a pressure; 0 where the contact is open.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn normal_stress(&self, k: usize) -> f64 {
        self.at.normal_stress[k]
    }

    /// The coefficient of friction at its slip rate and state. At rest it bounds what is mobilised.
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn coefficient(&self, k: usize) -> f64 {
        self.response(k).coefficient
    }

    fn response(&self, k: usize) -> Response {
        let (rate, state) = (self.slip_rate(k), self.state(k));
        self.contact.trial.laws().response(k, rate, state)
    }

    /// What friction can bear, `c + mu abs(sigma_n)` \[Pa\].
    ///
    /// # Panics
    /// Unless `k` is below [`len`](Self::len).
    pub fn strength(&self, k: usize) -> f64 {
        self.contact.cohesion(k) + self.coefficient(k) * self.normal_stress(k)
    }

    /// The shear traction that the body exerts on the surface \[Pa\], the opposite of friction's on the body:
    /// where it slides, its strength in the direction of slip; where it sticks, what holds the body in
    /// balance, shared out by strength where contacts meet. Where it creeps so slowly that the slip rate, as the
    /// solver leaves it, says less of the strength than of the balance, that is taken too.
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

    /// What holds the body in balance, shared out by strength, in the frame of the vertex \[Pa\].
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

    /// The shear force that the body exerts on the surface \[N\]: the integral of the traction.
    pub fn force(&self) -> SVector<f64, C> {
        let vertices = 0..self.len();
        vertices.map(|k| self.traction(k) * self.weight(k)).sum()
    }

    /// Whether an error of the slip rate changes friction more than it changes the balance of the body, at a
    /// vertex where the balance is that of friction alone.
    fn creeps(&self, k: usize) -> bool {
        let (vertex, area) = (self.vertex(k), self.weight(k));
        let friction = area * self.normal_stress(k) * self.response(k).rate_slope;
        let free = (0..C).all(|c| {
            let along = self
                .contact
                .tangential(k, &SVector::from_fn(|d, _| f64::from(u8::from(c == d))));
            along[c] == 0.0 || !self.source.is_fixed(vertex, c)
        });
        free && friction > self.source.diagonal_stiffness(vertex)
    }

    /// The strength in the direction of slip, zero at rest \[Pa\]; in the frame of the vertex.
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
