//! Impact: what a step with inertia does where gaps close and open.

use nalgebra::SVector;

use super::ContactSet;
use super::gap::Gap;
use crate::numerics::NUMERICS;
use crate::{ContactState, StepError, StepState};

impl Gap {
    /// A component into the opposite side.
    fn towards<const C: usize>(&self, field: &[SVector<f64, C>], vertex: usize) -> f64 {
        self.outward * field[vertex][self.axis]
    }
}

impl<const C: usize> ContactSet<C> {
    /// The vertices that can open, each with its gap.
    fn gaps(&self) -> impl Iterator<Item = (usize, &Gap)> {
        let sites = self.vertices.iter().zip(&self.sites);
        sites.filter_map(|(&vertex, site)| Some((vertex, site.gap.as_ref()?)))
    }

    /// Whether the accelerations of a state are free of impulses: each vertex that can open is open, or rests closed,
    /// its normal velocity and acceleration zero.
    pub(crate) fn is_settled(&self, state: &StepState<C>) -> bool {
        self.gaps().all(|(vertex, gap)| {
            let rests = |field: &[SVector<f64, C>]| {
                field.get(vertex).is_none_or(|own| own[gap.axis] == 0.0)
            };
            gap.towards(&state.displacement, vertex) < 0.0
                || rests(&state.velocity) && rests(&state.acceleration)
        })
    }

    /// Whether contact persists `from` a step's start to the motion of a step, whose displacements are still to change by `c_u v`
    /// \[s\]: each vertex that can open stays open or closed.
    pub(crate) fn persists(&self, from: &StepState<C>, end: &StepState<C>, c_u: f64) -> bool {
        self.gaps().all(|(vertex, gap)| {
            let velocity = gap.towards(&end.velocity, vertex);
            let closed = velocity >= gap.bound;
            if gap.towards(&from.displacement, vertex) < 0.0 {
                !closed && gap.towards(&end.displacement, vertex) + c_u * velocity < 0.0
            } else {
                closed
            }
        })
    }

    /// Moves vertices that an explicit scheme predicts beyond the opposite side onto it; returns whether there was any.
    pub(crate) fn land(&self, displacement: &mut [SVector<f64, C>]) -> bool {
        let mut impact = false;
        for (vertex, gap) in self.gaps() {
            if gap.towards(displacement, vertex) > 0.0 {
                displacement[vertex][gap.axis] = 0.0;
                impact = true;
            }
        }
        impact
    }

    /// Sets the bounds of normal velocities, for displacements that change by `c_u v` \[s\] from a prediction. By
    /// `position` a gap closes at the velocity that takes it to zero; else a closed one at zero, and one that the velocity
    /// of the last step keeps open has no bound.
    pub(crate) fn bound_gaps(
        &mut self,
        (predicted, c_u): (&[SVector<f64, C>], f64),
        last: &[SVector<f64, C>],
        position: bool,
    ) {
        for k in 0..self.sites.len() {
            let Some(mut gap) = self.sites[k].gap else {
                continue;
            };
            let vertex = self.vertices[k];
            let into = gap.towards(predicted, vertex);
            gap.bound = if position {
                -into / c_u
            } else if into + c_u * gap.towards(last, vertex) < 0.0 {
                f64::INFINITY
            } else {
                0.0
            };
            self.sites[k].gap = Some(gap);
        }
        self.join_gaps();
    }

    /// Refuses rates that pass the bounds of gaps by more than rounding, before these are closed: displacements are still to
    /// change by `c_u v` \[s\], those of an explicit step by the next one of `dt` \[s\].
    pub(crate) fn check_openings(
        &self,
        end: &StepState<C>,
        c_u: f64,
        dt: f64,
    ) -> Result<(), StepError> {
        let time = if c_u > 0.0 { c_u } else { dt };
        for (vertex, gap) in self.gaps() {
            let beyond = time * (gap.towards(&end.velocity, vertex) - gap.bound);
            let fastest = end.velocity[vertex].amax().max(gap.bound.abs());
            let moved = end.displacement[vertex].amax().max(time * fastest);
            if beyond > NUMERICS.rounding * moved {
                return Err(StepError::Penetration {
                    vertex,
                    opening: -beyond,
                });
            }
        }
        Ok(())
    }

    /// Removes what rounding leaves of closed gaps; without inertia their normal motion ends, too.
    pub(crate) fn close_gaps(&self, end: &mut StepState<C>, inertia: bool) {
        for (vertex, gap) in self.gaps() {
            let (axis, velocity) = (gap.axis, gap.towards(&end.velocity, vertex));
            let open = velocity < gap.bound;
            if open && gap.towards(&end.displacement, vertex) < 0.0 {
                continue;
            }
            end.displacement[vertex][axis] = 0.0;
            if !inertia {
                let left = if open { velocity.min(0.0) } else { 0.0 };
                end.velocity[vertex][axis] = gap.outward * left;
            }
        }
    }

    /// Adds the loads of an accepted step that are no reactions: tractions beside friction, and the given normal stress of
    /// vertices that can open.
    pub(crate) fn add_loads_of(&self, states: &[ContactState<C>], load: &mut [SVector<f64, C>]) {
        for (contact, state) in self.contacts.iter().zip(states) {
            contact.add_tractions(|k| state.total_normal_stress(k), true, load);
            let Some(body) = &contact.body else {
                continue;
            };
            for (k, &vertex) in contact.part.vertices.iter().enumerate() {
                if let Some((axis, outward)) = contact.opening_axis(k) {
                    load[vertex][axis] += outward * contact.part.weights[k] * body.beside[k];
                }
            }
        }
    }

    /// Shows the normal stresses in force at the start where contacts can open: those in balance with accelerations.
    pub(crate) fn start_open(&self, states: &mut [ContactState<C>]) {
        for (contact, state) in self.contacts.iter().zip(states) {
            if contact.opening.is_some() {
                state.normal_stress.copy_from_slice(&contact.normal_stress);
                (state.earlier_normal_stress).copy_from_slice(&contact.normal_stress);
                let body = contact.body.as_ref();
                if let Some(body) = body.filter(|body| !body.unrelaxed.is_empty()) {
                    state.relaxed_stress.copy_from_slice(&body.trial);
                    state.body_stress.copy_from_slice(&body.unrelaxed);
                }
            }
        }
    }
}
