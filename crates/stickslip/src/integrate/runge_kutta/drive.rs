//! The forces of a stage that viscosity and friction balance.

use nalgebra::SVector;

use super::threads::on_shares;
use crate::Clock;
use crate::contact::ContactSet;
use crate::scene::Loads;

/// `l - A u` of the last stage, with the tractions of contacts beside friction.
pub(super) struct Drive<const C: usize> {
    pub(super) forces: Vec<SVector<f64, C>>,
    /// The tractions \[N\], if none changes in time; else empty.
    tractions: Vec<SVector<f64, C>>,
    scratch: Vec<SVector<f64, C>>,
    /// The accepted step whose forces they are.
    pub(super) balanced: Option<Clock>,
}

impl<const C: usize> Drive<C> {
    pub(super) fn new(size: usize, loads: &Loads<C>, contacts: &ContactSet<C>) -> Self {
        Self {
            forces: vec![SVector::zeros(); size],
            tractions: contacts.constant_tractions(size),
            scratch: loads.scratch(size),
            balanced: None,
        }
    }

    /// Finds the forces at a time, beside elastic ones.
    pub(super) fn find(
        &mut self,
        time: f64,
        (loads, contacts): (&Loads<C>, &ContactSet<C>),
        elastic: &[SVector<f64, C>],
    ) {
        loads.fill(time, &mut self.forces, &mut self.scratch);
        if self.tractions.is_empty() {
            contacts.add_tractions(&mut self.forces);
            for (force, elastic) in self.forces.iter_mut().zip(elastic) {
                *force -= elastic;
            }
        } else {
            let tractions = &self.tractions;
            on_shares(&mut self.forces, &|first, forces| {
                let tractions = tractions[first..].iter().zip(&elastic[first..]);
                for (force, (traction, elastic)) in forces.iter_mut().zip(tractions) {
                    *force = *force + traction - elastic;
                }
            });
        }
    }
}
