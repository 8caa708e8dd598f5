//! A view of an accepted step.

use nalgebra::SVector;

use super::{ContactView, StepView};
use crate::{
    BoundaryCondition, BoundaryPart, MeshMismatch, Place, SceneError, StepReport, StepState,
};

/// A view of an accepted step: fields, contacts, reactions.
#[derive(Clone, Copy)]
pub struct Snapshot<'a, const C: usize> {
    /// The step number; 0 is the initial state.
    pub step: usize,
    /// The time \[s\].
    pub time: f64,
    /// `u`, one vector per vertex \[m\].
    pub displacement: &'a [SVector<f64, C>],
    /// `v`, one vector per vertex [m/s].
    pub velocity: &'a [SVector<f64, C>],
    /// `a`, one vector per vertex [m/s^2]; empty for a scene without mass.
    pub acceleration: &'a [SVector<f64, C>],
    /// The cost of the step.
    pub report: StepReport,
    state: &'a StepState<C>,
    source: &'a dyn StepView<C>,
}

impl<'a, const C: usize> Snapshot<'a, C> {
    pub(crate) fn new(state: &'a StepState<C>, source: &'a dyn StepView<C>) -> Self {
        let seen = source.fields();
        let (displacement, velocity, acceleration) = if seen.basis().is_empty() {
            (&state.displacement, &state.velocity, &state.acceleration)
        } else {
            (&seen.displacement, &seen.velocity, &seen.acceleration)
        };
        Self {
            step: state.clock.step(),
            time: state.clock.time(),
            displacement,
            velocity,
            acceleration,
            report: state.report,
            state,
            source,
        }
    }

    /// The state that the next step depends on, to be stored or written to a file.
    pub fn state(&self) -> &'a StepState<C> {
        self.state
    }

    /// The number of contacts.
    pub fn contact_count(&self) -> usize {
        self.state.contacts.len()
    }

    /// Contact number `index`, in the order in which contacts were added to the scene.
    ///
    /// # Panics
    /// If there are fewer contacts: `contacts().nth(index)` is `None` then.
    pub fn contact(&self, index: usize) -> ContactView<'a, C> {
        ContactView::new(self.state, self.source, index)
    }

    /// All contacts.
    pub fn contacts(&self) -> impl Iterator<Item = ContactView<'a, C>> {
        let (state, source) = (self.state, self.source);
        (0..state.contacts.len()).map(move |index| ContactView::new(state, source, index))
    }

    /// The place of a vertex of the body in the first contact that has it.
    pub(crate) fn place_of(&self, vertex: usize) -> Option<Place> {
        let all = self.source.contacts();
        let bend = || all.clamping().and_then(|clamping| clamping.bend(vertex));
        let contacts = all.contacts.iter().enumerate();
        let mut places = contacts.filter_map(|(index, contact)| {
            let number = contact.position_of(vertex)?;
            Some(Place {
                bend: bend(),
                ..Place::of(&contact.part, index, number)
            })
        });
        places.next()
    }

    /// The times at which what is known of fields on contacts jumps \[s\]; no step of a run crosses them.
    pub(crate) fn field_stops(&self) -> Vec<f64> {
        let contacts = self.source.contacts().contacts.iter();
        let fields = contacts.filter_map(|contact| contact.fields.as_ref());
        fields.flat_map(|fields| fields.stops()).collect()
    }

    /// The largest slip rate of all contacts [m/s]; 0 without contacts.
    pub fn max_slip_rate(&self) -> f64 {
        let contacts = self.source.contacts().contacts.iter();
        let of_each = contacts.map(|contact| contact.max_slip_rate(&self.state.velocity));
        of_each.fold(0.0, f64::max)
    }

    /// The reaction of a Dirichlet condition at a vertex \[N\]: the force on its prescribed components, zero for the
    /// others. The normal force of a bilateral contact is one of them; on a fault between two sides the plus side has the
    /// opposite one of the minus side. At a vertex of a periodic boundary it is the force across the boundary; those of both
    /// sides add to zero.
    ///
    /// # Errors
    /// [`SceneError::Index`] for a vertex that the body does not have.
    pub fn reaction_at(&self, vertex: usize) -> Result<SVector<f64, C>, SceneError> {
        SceneError::check_index("vertex", vertex, self.velocity.len())?;
        Ok(self.reaction_of(vertex))
    }

    fn reaction_of(&self, vertex: usize) -> SVector<f64, C> {
        let own = self.held_at(vertex, |_| true);
        let constraints = self.source.constraints();
        let prescribed = (0..C).any(|c| constraints.role(vertex, c).is_some());
        let counts = |copy: usize, c: usize| {
            let role = constraints.role(copy, c);
            !prescribed || !matches!(role, Some(BoundaryCondition::Contact(_)))
        };
        own - self.across(vertex, &counts)
    }

    /// The forces on jumps that act on the copies of a vertex, not on the vertex itself.
    fn across(&self, vertex: usize, counts: &dyn Fn(usize, usize) -> bool) -> SVector<f64, C> {
        let links = &self.source.fields().basis().links;
        let jumps = links.iter().filter(|link| link.bases.contains(&vertex));
        let forces = jumps.map(|link| {
            let held = self.held_at(link.vertex, |c| counts(link.vertex, c));
            let force = held - self.across(link.vertex, counts);
            if link.reversed { -force } else { force }
        });
        forces.sum()
    }

    /// The forces of the fixed components of a vertex that count, in coordinates.
    fn held_at(&self, vertex: usize, counts: impl Fn(usize) -> bool) -> SVector<f64, C> {
        let holds = |c: usize| self.source.is_fixed(vertex, c) && counts(c);
        if !(0..C).any(holds) {
            return SVector::zeros();
        }
        let reaction = self.sliding_force(vertex) - self.source.unbalanced(vertex);
        let held = SVector::from_fn(|c, _| if holds(c) { reaction[c] } else { 0.0 });
        self.source.to_coordinates(vertex, held)
    }

    /// The strength of all contacts at a vertex in the direction of slip, zero at rest \[N\]; in its local frame.
    pub(crate) fn sliding_force(&self, vertex: usize) -> SVector<f64, C> {
        let mut force = SVector::zeros();
        for contact in self.contacts() {
            if let Some(k) = contact.position_of(vertex) {
                force += contact.sliding_traction(k) * contact.weight(k);
            }
        }
        force
    }

    /// The source of the snapshot.
    pub(crate) fn source(&self) -> &'a dyn StepView<C> {
        self.source
    }

    /// The reaction of a fixed or driven part \[N\], the sum over its vertices.
    ///
    /// # Errors
    /// [`SceneError::Mesh`] for a part of another mesh, [`SceneError`] for vertices that do not exist.
    pub fn reaction(&self, part: impl Into<BoundaryPart>) -> Result<SVector<f64, C>, SceneError> {
        let part = part.into();
        MeshMismatch::check("part of a reaction", self.source.mesh(), part.mesh)?;
        part.check("part of a reaction", self.velocity.len(), false)?;
        Ok(part
            .vertices
            .iter()
            .map(|&vertex| self.reaction_of(vertex))
            .sum())
    }
}
