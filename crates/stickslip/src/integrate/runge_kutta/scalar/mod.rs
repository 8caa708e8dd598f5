//! Contacts of many vertices whose local problems are scalar: nothing else slides there, and what resists is isotropic.

mod error;

use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::{SMatrix, SVector};
use stickslip_core::lanes::LANES;
use stickslip_friction::modulus;

use super::threads::{on_shares, on_two_shares};
use crate::contact::{Balanced, ContactSet, DiscreteContact};

pub(super) use error::AtEnd;

/// Slip along the force `f` of each vertex: `eta V + w (c + abs(sigma_n) mu(V, alpha)) = abs(f)`, solved by the laws of the
/// contact for many vertices at once.
pub(super) struct ScalarContact<const C: usize> {
    /// The numbers of the vertices among all frictional ones.
    pub(super) numbers: Vec<usize>,
    /// `eta` [N s/m].
    resistance: Vec<f64>,
    /// The first vertex of the body, if they follow one another.
    first: Option<usize>,
    /// The slip rates of the last stage over the forces [m/(N s)]; of one component the slip rates themselves [m/s].
    mobility: Vec<f64>,
}

impl<const C: usize> ScalarContact<C> {
    /// The vertices of a contact, if their local problems are scalar, by the viscous resistance of all frictional ones.
    pub(super) fn new(
        contact: &DiscreteContact<C>,
        contacts: &ContactSet<C>,
        damping: &[SMatrix<f64, C, C>],
    ) -> Option<Self> {
        let vertices = &contact.part.vertices;
        let slides = contact.slides.iter().all(|slides| *slides == [true; C]);
        // Fewer vertices cost as much as a block of them.
        if vertices.len() < LANES || !slides || contact.trial.is_searched() {
            return None;
        }
        let number = |vertex: &usize| {
            let number = contacts.vertices.binary_search(vertex).ok()?;
            let (site, block) = (&contacts.sites[number], &damping[number]);
            let isotropic = SMatrix::<f64, C, C>::from_diagonal_element(block[(0, 0)]);
            let alone = site.plain && site.shares.len() == 1;
            (alone && *block == isotropic && block[(0, 0)] > 0.0).then_some(number)
        };
        let numbers: Vec<usize> = vertices.iter().map(number).collect::<Option<_>>()?;
        let first = vertices.first().copied();
        let follow = |first: &usize| (*first..).zip(vertices).all(|(next, &own)| next == own);
        Some(Self {
            resistance: numbers.iter().map(|&k| damping[k][(0, 0)]).collect(),
            first: first.filter(follow),
            mobility: vec![0.0; numbers.len()],
            numbers,
        })
    }

    /// The balance with the forces on the vertices of the body, for the fields of the contact.
    pub(super) fn balanced<'a>(&'a self, forces: &'a [SVector<f64, C>]) -> Balanced<'a, C> {
        Balanced {
            forces,
            resistance: &self.resistance,
        }
    }

    /// Sets the velocities in balance with the forces on the vertices of the body, and the rates of the states (none without
    /// states). Where states follow the normal stress, their rates are divided by the derivatives that stand there. Whether
    /// all forces, normal stresses and rates are finite.
    pub(super) fn balance(
        &mut self,
        contact: &DiscreteContact<C>,
        forces: &[SVector<f64, C>],
        velocity: &mut [SVector<f64, C>],
        evolutions: &mut [f64],
    ) -> bool {
        let (resistance, broken) = (&self.resistance, AtomicBool::new(false));
        on_two_shares(
            &mut self.mobility,
            evolutions,
            &|first, mobility, evolutions| {
                let states = evolutions.chunks_mut(LANES);
                let states = states.chain(std::iter::repeat_with(|| &mut [][..]));
                for (block, (mobility, evolutions)) in
                    mobility.chunks_mut(LANES).zip(states).enumerate()
                {
                    let first = first + block * LANES;
                    let resistance = &resistance[first..first + mobility.len()];
                    if !solve(contact, (first, resistance), forces, mobility, evolutions) {
                        broken.store(true, Ordering::Relaxed);
                    }
                }
            },
        );
        let (mobility, vertices) = (&self.mobility, &contact.part.vertices);
        if let Some(start) = self.first {
            let forces = &forces[start..];
            on_shares(
                &mut velocity[start..start + vertices.len()],
                &|first, velocity| {
                    let forces = forces[first..].iter().zip(&mobility[first..]);
                    for (own, (force, mobility)) in velocity.iter_mut().zip(forces) {
                        *own = along(force, *mobility);
                    }
                },
            );
        } else {
            for (&vertex, mobility) in vertices.iter().zip(mobility) {
                velocity[vertex] = along(&forces[vertex], *mobility);
            }
        }
        !broken.into_inner()
    }
}

/// The slip velocity along a force.
#[inline]
fn along<const C: usize>(force: &SVector<f64, C>, mobility: f64) -> SVector<f64, C> {
    if C == 1 {
        force.map(|force| mobility.copysign(force))
    } else {
        force * mobility
    }
}

/// Solves the local problems of a block of vertices. Whether all numbers are finite.
#[inline]
fn solve<const C: usize>(
    contact: &DiscreteContact<C>,
    (first, resistance): (usize, &[f64]),
    forces: &[SVector<f64, C>],
    mobility: &mut [f64],
    evolutions: &mut [f64],
) -> bool {
    let range = first..first + mobility.len();
    let (mut pull, mut viscosity, mut drive) = ([0.0; LANES], [1.0; LANES], [0.0; LANES]);
    // A maximum with zero, as in Tresca's law, forgets what is not a number.
    let (mut is_finite, mut all) = (true, true);
    let strengths = contact.forces[range.clone()]
        .iter()
        .zip(resistance)
        .enumerate();
    for (i, (&[normal, cohesive], resistance)) in strengths {
        let force = &forces[contact.part.vertices[first + i]];
        pull[i] = modulus(force);
        let per_normal = normal.recip();
        viscosity[i] = resistance * per_normal;
        drive[i] = (pull[i] - cohesive) * per_normal;
        all &= (viscosity[i] <= f64::MAX) & (drive[i] <= f64::MAX) & (drive[i] > 0.0);
        is_finite &= (force.sum() + contact.normal_stress[first + i]).is_finite();
    }
    let count = mobility.len();
    let mut read = [0.0; LANES];
    contact.trial.read_states(first, &mut read[..count]);
    let mut rates = [0.0; LANES];
    let laws = contact.trial.laws();
    if !all {
        // Vertices that cohesion holds rest, and those without normal stress, or nearly, slide against viscosity alone.
        for i in 0..count {
            let [_, cohesive] = contact.forces[first + i];
            let is_regular = viscosity[i] <= f64::MAX && drive[i] <= f64::MAX;
            if pull[i] <= cohesive || !is_regular {
                rates[i] = ((pull[i] - cohesive) / resistance[i]).max(0.0);
                (viscosity[i], drive[i]) = (1.0, 0.0);
            }
        }
    }
    let free = rates;
    let problem = [&viscosity, &drive, &read].map(|own| &own[..count]);
    laws.slip_rates(first, problem, &mut rates[..count]);
    for i in 0..count {
        if free[i] > 0.0 {
            rates[i] = free[i];
        }
        let by_force = C > 1 && rates[i] != 0.0;
        mobility[i] = if by_force {
            rates[i] / pull[i]
        } else {
            rates[i]
        };
        is_finite &= mobility[i].is_finite();
    }
    if !evolutions.is_empty() {
        let follows = contact.trial.follows_normal_stress();
        let mut found = [0.0; LANES];
        let at = [&rates[..count], &contact.trial.states()[range]];
        laws.evolutions(first, at, &mut found[..count]);
        for (own, found) in evolutions.iter_mut().zip(found) {
            *own = if follows { found / *own } else { found };
            is_finite &= found.is_finite();
        }
    }
    is_finite
}
