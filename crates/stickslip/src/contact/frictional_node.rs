//! The frictional vertices in a solver: at each, the potentials of all contacts that meet there.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{ConvexPotential, FrictionLaw, Interval, LocalModel, Radial, Sliding};
use stickslip_solvers::Potentials;

use super::balance::balance;
use super::gap::Gap;
use super::{ContactSet, DiscreteContact};

/// A vertex with friction and a free tangential component.
#[derive(Debug, Clone)]
pub(crate) struct FrictionalNode<const C: usize> {
    /// Its range in the contributions of [`ContactSet`].
    pub(crate) shares: Range<usize>,
    pub(crate) slides: [bool; C],
    /// The velocity is the slip velocity: components normal to the contacts are fixed at zero, tangential ones are
    /// free.
    pub(crate) plain: bool,
    /// The prescribed part of the slip velocity [m/s].
    pub(crate) prescribed: SVector<f64, C>,
    /// The vertex can open.
    pub(crate) gap: Option<Gap>,
}

/// The place of a vertex in one of its contacts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contribution {
    pub(crate) contact: u32,
    pub(crate) place: u32,
}

/// The frictional force at a node as a function of its slip rate: the sum over its contacts of `w (c + abs(sigma_n)
/// mu(V))` \[N\].
struct NodeLaw<'a, const C: usize> {
    contacts: &'a [DiscreteContact<C>],
    shares: &'a [Contribution],
}

impl<const C: usize> NodeLaw<'_, C> {
    #[inline]
    fn parts(&self) -> impl Iterator<Item = (&DiscreteContact<C>, usize)> {
        self.shares
            .iter()
            .map(|share| (&self.contacts[share.contact as usize], share.place as usize))
    }

    /// The slip rate under one contact alone.
    #[inline]
    fn alone(contact: &DiscreteContact<C>, place: usize, viscosity: f64, drive: f64) -> f64 {
        let [normal, cohesive] = contact.forces[place];
        let pull = drive - cohesive;
        if pull <= 0.0 {
            return 0.0;
        }
        let (scaled_viscosity, scaled_pull) = (viscosity / normal, pull / normal);
        if scaled_viscosity.is_finite() && scaled_pull.is_finite() {
            (contact.trial).slip_rate(place, scaled_viscosity, scaled_pull)
        } else {
            // No normal stress, or one too small to matter.
            pull / viscosity
        }
    }
}

/// The force replaces the coefficient; the states are included.
impl<const C: usize> FrictionLaw for NodeLaw<'_, C> {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        self.parts()
            .map(|(contact, place)| {
                let [normal, cohesive] = contact.forces[place];
                let (coefficient, _) = contact.trial.coefficient_and_rate_slope(place, slip_rate);
                cohesive + normal * coefficient
            })
            .sum()
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        self.coefficient_and_rate_slope(slip_rate, ()).1
    }

    #[inline]
    fn coefficient_and_rate_slope(&self, slip_rate: f64, (): ()) -> (f64, f64) {
        let (mut force, mut stiffness) = (0.0, 0.0);
        for (contact, place) in self.parts() {
            let [normal, cohesive] = contact.forces[place];
            let (coefficient, slope) = contact.trial.coefficient_and_rate_slope(place, slip_rate);
            force += cohesive + normal * coefficient;
            // 0 times an infinite slope is no curvature.
            stiffness += if normal > 0.0 { normal * slope } else { 0.0 };
        }
        (force, stiffness)
    }

    fn coefficient_state_slope(&self, _: f64, (): ()) -> f64 {
        0.0
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        self.parts()
            .map(|(contact, place)| {
                let [normal, cohesive] = contact.forces[place];
                cohesive * slip_rate + normal * contact.trial.potential(place, slip_rate)
            })
            .sum()
    }

    #[inline]
    fn slip_rate(&self, viscosity: f64, drive: f64, (): ()) -> f64 {
        if let [share] = self.shares {
            let contact = &self.contacts[share.contact as usize];
            return Self::alone(contact, share.place as usize, viscosity, drive);
        }
        // Each contact bounds the rate that all of them allow.
        let bounds = self
            .parts()
            .map(|(contact, place)| Self::alone(contact, place, viscosity, drive));
        let guess = bounds.fold(f64::INFINITY, f64::min);
        balance(viscosity, drive, guess, |rate| {
            self.coefficient_and_rate_slope(rate, ())
        })
    }
}

impl<const C: usize> ContactSet<C> {
    #[inline]
    fn law(&self, site: &FrictionalNode<C>) -> Radial<NodeLaw<'_, C>> {
        Radial {
            law: NodeLaw {
                contacts: &self.contacts,
                shares: &self.shares[site.shares.clone()],
            },
            force: 1.0,
            state: (),
        }
    }

    /// The frictional force at the frictional vertex number `k`.
    pub(crate) fn law_at(&self, k: usize) -> impl FrictionLaw<State = ()> {
        self.law(&self.sites[k]).law
    }

    /// The contacts at frictional vertex number `k`, and its place in each.
    pub(crate) fn shares_of(&self, k: usize) -> impl Iterator<Item = (&DiscreteContact<C>, usize)> {
        let shares = &self.shares[self.sites[k].shares.clone()];
        shares
            .iter()
            .map(|share| (&self.contacts[share.contact as usize], share.place as usize))
    }

    /// The normal force and cohesion at each frictional vertex, of all contacts there \[N\].
    pub(crate) fn strengths(&self) -> impl Iterator<Item = f64> {
        (0..self.sites.len()).map(|k| self.strength(k))
    }

    /// The same at the frictional vertex number `k`.
    pub(crate) fn strength(&self, k: usize) -> f64 {
        let forces = self
            .shares_of(k)
            .map(|(contact, place)| contact.forces[place]);
        forces.map(|[normal, cohesive]| normal + cohesive).sum()
    }

    /// The same under at least the normal stress that is given, as where a contact is closed.
    pub(crate) fn closed_strength(&self, k: usize) -> f64 {
        let forces = self.shares_of(k).map(|(contact, place)| {
            let [normal, cohesive] = contact.forces[place];
            let given = contact.strength.normal_stress.at(place).abs();
            normal.max(contact.part.weights[place] * given) + cohesive
        });
        forces.sum()
    }

    /// Whether friction at frictional vertex number `k` depends on its slip rate at constant state.
    pub(crate) fn reads_rate(&self, k: usize) -> bool {
        self.shares_of(k).any(|(contact, _)| contact.reads_rate)
    }

    /// The frictional force at the frictional vertex number `k`, of all contacts there \[N\].
    pub(crate) fn friction(&self, k: usize, slip_rate: f64) -> f64 {
        self.law(&self.sites[k]).law.coefficient(slip_rate, ())
    }

    /// The slip velocity at frictional vertex number `k`.
    #[inline]
    pub(crate) fn slip_velocity(&self, k: usize, velocity: &SVector<f64, C>) -> SVector<f64, C> {
        let slides = &self.sites[k].slides;
        SVector::from_fn(|c, _| if slides[c] { velocity[c] } else { 0.0 })
    }

    /// Marks the components in which the frictional vertex number `k` slides.
    pub(crate) fn mark_slip(&self, k: usize, mask: &mut [bool; C]) {
        for c in (0..C).filter(|&c| self.sites[k].slides[c]) {
            mask[c] = true;
        }
    }

    fn sliding(&self, site: &FrictionalNode<C>) -> Sliding<NodeLaw<'_, C>, C> {
        Sliding {
            friction: self.law(site),
            slides: site.slides,
            prescribed: site.prescribed,
        }
    }
}

/// Evaluates an expression of the potential at a frictional vertex, whose type depends on the vertex: one that slides in
/// each component, one with components that do not slide, one that can open.
macro_rules! at_vertex {
    ($set:ident, $k:ident, |$potential:ident| $value:expr) => {{
        let site = &$set.sites[$k];
        if site.plain {
            let $potential = $set.law(site);
            $value
        } else if let Some(gap) = &site.gap {
            let $potential = gap.with($set.sliding(site));
            $value
        } else {
            let $potential = $set.sliding(site);
            $value
        }
    }};
}

impl<const C: usize> Potentials<C> for ContactSet<C> {
    fn len(&self) -> usize {
        self.sites.len()
    }

    fn value(&self, k: usize, v: &SVector<f64, C>) -> f64 {
        at_vertex!(self, k, |potential| potential.value(v))
    }

    fn slope_along(&self, k: usize, v: &SVector<f64, C>, d: &SVector<f64, C>) -> Interval {
        at_vertex!(self, k, |potential| potential.slope_along(v, d))
    }

    fn local_model(&self, k: usize, v: &SVector<f64, C>) -> LocalModel<C> {
        at_vertex!(self, k, |potential| potential.local_model(v))
    }

    fn minimize(
        &self,
        k: usize,
        block: &SMatrix<f64, C, C>,
        force: &SVector<f64, C>,
    ) -> SVector<f64, C> {
        at_vertex!(self, k, |potential| potential.minimize(block, force))
    }

    fn keep_smooth(&self, k: usize, v: &SVector<f64, C>, d: &SVector<f64, C>) -> SVector<f64, C> {
        at_vertex!(self, k, |potential| potential.keep_smooth(v, d))
    }
}
