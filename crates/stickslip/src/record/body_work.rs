//! The work of viscosity and of loads that depend on time, over the whole body.

use nalgebra::SVector;

use super::ledger::mean;
use crate::Snapshot;

/// Fields of the whole body, for viscosity and time-dependent loads.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct BodyWork<const C: usize> {
    displacement: Vec<SVector<f64, C>>,
    velocity: Vec<SVector<f64, C>>,
    /// The velocity that lagged viscosities have seen; empty without them.
    lagged: Vec<SVector<f64, C>>,
    load: Vec<SVector<f64, C>>,
    pub(super) force: Vec<SVector<f64, C>>,
    scratch: Vec<SVector<f64, C>>,
    pub(super) is_viscous: bool,
    is_loaded: bool,
}

impl<const C: usize> BodyWork<C> {
    /// The fields; none if the scene has neither viscosity nor time-dependent loads.
    pub(super) fn new(at: &Snapshot<'_, C>) -> Option<Self> {
        let source = at.source();
        let size = at.state().displacement.len();
        let zeros = || vec![SVector::zeros(); size];
        let is_viscous = source
            .matrices()
            .add_viscous_force(&at.state().velocity, &mut zeros());
        let mut contacts = source.contacts().contacts.iter();
        let is_loaded = source.loads().vary() || contacts.any(|contact| contact.loads());
        let mut body = Self {
            displacement: at.state().displacement.to_vec(),
            velocity: at.state().velocity.to_vec(),
            lagged: if source.matrices().any_lags() {
                seen(at).collect()
            } else {
                Vec::new()
            },
            load: zeros(),
            force: zeros(),
            scratch: source.loads().scratch(size),
            is_viscous,
            is_loaded,
        };
        if is_loaded {
            body.fill(at);
            std::mem::swap(&mut body.load, &mut body.force);
        }
        (is_viscous || is_loaded).then_some(body)
    }

    /// Evaluates the time-dependent loads and those of contacts.
    fn fill(&mut self, at: &Snapshot<'_, C>) {
        let source = at.source();
        let loads = source.loads();
        loads.fill(source.data_time(), &mut self.force, &mut self.scratch);
        loads.take_constant(&mut self.force);
        let (state, contacts) = (at.state(), source.contacts());
        if state.acceleration.is_empty() {
            contacts.add_tractions_of(&state.contacts, &mut self.force);
        } else {
            // With inertia reactions take energy in an impact, which is left over.
            contacts.add_loads_of(&state.contacts, &mut self.force);
        }
    }

    /// The energy dissipated by viscosity and the work of these loads in the step shown \[J\]; adds the dissipation of
    /// each viscosity to `viscosities`.
    pub(super) fn work(
        &mut self,
        at: &Snapshot<'_, C>,
        share: f64,
        viscosities: &mut [f64],
    ) -> [f64; 2] {
        let mut work = [0.0; 2];
        if self.is_viscous && !self.lagged.is_empty() {
            work[0] = self.lagged_work(at, viscosities);
        } else if self.is_viscous {
            for (old, new) in self.velocity.iter_mut().zip(&at.state().velocity) {
                *old = mean(*old, *new, share);
            }
            self.force.fill(SVector::zeros());
            (at.source().matrices()).add_viscous_force(&self.velocity, &mut self.force);
            work[0] = self.along(at);
            if let [viscosity] = viscosities {
                *viscosity += work[0];
            } else {
                for (n, viscosity) in viscosities.iter_mut().enumerate() {
                    self.force.fill(SVector::zeros());
                    at.source()
                        .matrices()
                        .add_viscous_force_of(n, &self.velocity, &mut self.force);
                    *viscosity += self.along(at);
                }
            }
            self.velocity.copy_from_slice(&at.state().velocity);
        }
        if self.is_loaded {
            self.fill(at);
            std::mem::swap(&mut self.load, &mut self.force);
            for (old, new) in self.force.iter_mut().zip(&self.load) {
                *old = mean(*old, *new, share);
            }
            work[1] = self.along(at);
        }
        self.displacement.copy_from_slice(&at.state().displacement);
        work
    }

    /// The energy dissipated by viscosities of which some lag, each with the velocities that it has seen.
    fn lagged_work(&mut self, at: &Snapshot<'_, C>, viscosities: &mut [f64]) -> f64 {
        for (old, new) in self.velocity.iter_mut().zip(&at.state().velocity) {
            *old = (*old + new) * 0.5;
        }
        for (old, new) in self.lagged.iter_mut().zip(seen(at)) {
            *old = (*old + new) * 0.5;
        }
        let matrices = at.source().matrices();
        let mut sum = 0.0;
        for (n, viscosity) in viscosities.iter_mut().enumerate() {
            let velocity = if matrices.lagged().contains(&n) {
                &self.lagged
            } else {
                &self.velocity
            };
            self.force.fill(SVector::zeros());
            matrices.add_viscous_force_of(n, velocity, &mut self.force);
            let work = self.along(at);
            *viscosity += work;
            sum += work;
        }
        self.velocity.copy_from_slice(&at.state().velocity);
        for (old, new) in self.lagged.iter_mut().zip(seen(at)) {
            *old = new;
        }
        sum
    }

    /// The work of `force` in the step shown \[J\].
    fn along(&self, at: &Snapshot<'_, C>) -> f64 {
        let ways = at.state().displacement.iter().zip(&self.displacement);
        let works = ways.zip(&self.force);
        works
            .map(|((new, old), force)| (new - old).dot(force))
            .sum()
    }
}

/// The velocity that lagged viscosities have seen in the step shown [m/s].
fn seen<'a, const C: usize>(
    at: &Snapshot<'a, C>,
) -> impl Iterator<Item = SVector<f64, C>> + use<'a, C> {
    let (state, lag) = (at.state(), at.source().lag());
    let motion = state.velocity.iter().zip(&state.acceleration);
    motion.map(move |(v, a)| v - a * lag)
}
