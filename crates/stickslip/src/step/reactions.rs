//! Memory of the iteration of rates with what has no energy.

use nalgebra::SVector;

use super::anderson::Anderson;
use super::skew::Skew;
use crate::body::Matrices;
use crate::contact::ContactSet;

/// The reactions of the body.
#[derive(Clone)]
pub(super) struct Bearing<const C: usize> {
    /// The vertices that bear them.
    pub(super) vertices: Vec<usize>,
    /// The products of the operator there.
    pub(super) products: Vec<SVector<f64, C>>,
}

/// Workspace for the iteration of rates with normal stresses and skew forces. Iterates and images hold the former, one per
/// vertex of a contact, before the latter.
#[derive(Clone)]
pub(crate) struct Reactions<const C: usize> {
    pub(super) anderson: Anderson,
    /// None without a normal stress by reactions.
    pub(super) bearing: Option<Bearing<C>>,
    /// The displacement at the end of the stage; none without a normal stress that follows it or fields.
    pub(super) displacement: Option<Vec<SVector<f64, C>>>,
    /// None if the stiffness is symmetric.
    pub(super) skew: Option<Skew<C>>,
    /// The number of normal stresses.
    pub(super) stresses: usize,
    /// The area of each normal stress, 1 for a force.
    pub(super) weights: Vec<f64>,
    pub(super) iterate: Vec<f64>,
    pub(super) image: Vec<f64>,
}

impl<const C: usize> Reactions<C> {
    /// Memory for contacts whose normal stress comes from the deformation, and for a stiffness that is not symmetric; none
    /// without both.
    pub(crate) fn new(matrices: &dyn Matrices<C>, contacts: &ContactSet<C>) -> Option<Box<Self>> {
        let skew = Skew::new(matrices);
        if !contacts.follow_body() && skew.is_none() {
            return None;
        }
        let parts = (contacts.contacts.iter())
            .filter(|contact| contact.body.is_some())
            .map(|contact| &contact.part);
        let mut weights: Vec<f64> = parts
            .clone()
            .flat_map(|part| part.weights.clone())
            .collect();
        let stresses = weights.len();
        weights.resize(stresses + skew.as_ref().map_or(0, Skew::count), 1.0);
        let zeros = || vec![0.0; weights.len()];
        let follows = contacts.clamping().is_some() || contacts.have_fields();
        let size = matrices.stiffness().vertex_count();
        let reacting = contacts.contacts.iter().filter(|own| own.reacts());
        let vertices: Vec<usize> = reacting
            .flat_map(|contact| contact.part.vertices.clone())
            .collect();
        let reacts = contacts.contacts.iter().any(|own| own.reacts());
        Some(Box::new(Self {
            anderson: Anderson::new(weights.len()),
            bearing: reacts.then(|| Bearing {
                products: vec![SVector::zeros(); vertices.len()],
                vertices,
            }),
            displacement: follows.then(|| vec![SVector::zeros(); size]),
            skew,
            stresses,
            iterate: zeros(),
            image: zeros(),
            weights,
        }))
    }
}
