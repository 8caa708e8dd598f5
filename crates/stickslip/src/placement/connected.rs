//! The vertices of a scene, linked and turned.

use stickslip_solvers::Basis;

use super::axes::Axes;
use super::connect::{Parts, connect};
use super::constraints::Constraints;
use crate::SceneError;

/// The local axes and links of a scene, and its Dirichlet conditions.
pub(crate) struct Connected<const C: usize> {
    pub(crate) axes: Axes<C>,
    pub(crate) basis: Basis<C>,
    pub(crate) constraints: Constraints<C>,
}

impl<const C: usize> Connected<C> {
    /// Links and turns the vertices of the parts, whose conditions become the constraints.
    pub(crate) fn new(
        parts: Parts<'_, C>,
        size: usize,
        partial: bool,
        stiffness: impl Fn(usize) -> f64,
    ) -> Result<Self, SceneError> {
        let Parts {
            contacts,
            prescribed,
            periodic,
        } = parts;
        let parts = Parts {
            contacts: &mut *contacts,
            prescribed: &mut *prescribed,
            periodic,
        };
        let connections = connect(parts, size, partial, stiffness)?;
        let axes = Axes::new(prescribed, contacts, size)?;
        let basis = Basis {
            axes: axes.frames.clone(),
            links: connections.links,
        };
        let mut constraints = Constraints::new(std::mem::take(prescribed), &basis, size)?;
        for (vertex, condition) in connections.tied {
            constraints.tie(vertex, condition);
        }
        Ok(Self {
            axes,
            basis,
            constraints,
        })
    }
}
