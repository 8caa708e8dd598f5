//! The viscosities of a scene, and those whose force lags in explicit steps.

use nalgebra::SVector;
use stickslip_solvers::Operator;

use super::Scene;
use crate::numerics::NUMERICS;
use crate::sums::all_directions;

/// The viscosities that couple vertices, of a scene with a diagonal mass: an explicit step takes their force at its mean
/// velocity, which is known before the new velocity, so that its matrix stays diagonal.
#[derive(Clone)]
pub(crate) struct Lagged<Op> {
    /// Their places among all.
    places: Vec<usize>,
    /// The sum of the others, if there are any.
    pub(crate) prompt: Option<Op>,
}

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Whether the scene has inertia or damping, with which a sufficiently short step has a unique solution.
    pub(crate) fn is_resisted(&self) -> bool {
        self.mass.is_some() || !self.viscosity.is_empty()
    }

    /// Adds the viscosities, which have equal size, and stores the summands.
    pub(crate) fn sum_viscosities(&mut self) {
        self.lagged = self.find_lagged();
        if self.viscosity.len() > 1 {
            let terms: Vec<_> = self.viscosity.iter().map(|term| (1.0, term)).collect();
            let sum = Op::combination(&terms);
            self.viscosities = std::mem::replace(&mut self.viscosity, vec![sum]);
        }
    }

    fn find_lagged(&self) -> Option<Lagged<Op>> {
        let (mass, ranks) = (self.mass.as_ref()?, self.stiffness.ranks());
        if self.viscosity.is_empty() || ranks.any(first_coupled(mass).is_some()) {
            return None;
        }
        let couples = |n: &usize| ranks.any(first_coupled(&self.viscosity[*n]).is_some());
        let (places, prompt): (Vec<_>, Vec<_>) = (0..self.viscosity.len()).partition(couples);
        let terms: Vec<_> = prompt.iter().map(|&n| (1.0, &self.viscosity[n])).collect();
        let prompt = (!terms.is_empty()).then(|| Op::combination(&terms));
        (!places.is_empty()).then_some(Lagged { places, prompt })
    }

    /// The viscosities one by one.
    pub(super) fn summands(&self) -> &[Op] {
        if self.viscosities.is_empty() {
            &self.viscosity
        } else {
            &self.viscosities
        }
    }

    /// The viscosity that is part of the matrix of a step.
    pub(crate) fn prompt_viscosity(&self, implicit: bool) -> Option<&Op> {
        match &self.lagged {
            Some(lagged) if !implicit => lagged.prompt.as_ref(),
            _ => self.viscosity.first(),
        }
    }

    /// The viscosities whose force lags in explicit steps.
    pub(crate) fn lagged_viscosities(&self) -> impl Iterator<Item = &Op> {
        let places = self.lagged.iter().flat_map(|lagged| &lagged.places);
        places.map(|&n| &self.summands()[n])
    }

    /// Whether viscosity number `n` is one of them.
    pub(super) fn is_lagged(&self, n: usize) -> bool {
        let mut lagged = self.lagged.iter();
        lagged.any(|lagged| lagged.places.contains(&n))
    }
}

/// The first vertex at which the product of a matrix differs from that of its diagonal block.
pub(crate) fn first_coupled<Op: Operator<C>, const C: usize>(matrix: &Op) -> Option<usize> {
    let size = matrix.vertex_count();
    let mut field = vec![SVector::zeros(); size];
    all_directions(&mut field, &vec![[false; C]; size]);
    let mut product = vec![SVector::zeros(); size];
    matrix.multiply_add(1.0, &field, &mut product);
    let own = |vertex: usize| matrix.diagonal_block(vertex);
    let scale = (0..size).fold(0.0, |scale: f64, vertex| scale.max(own(vertex).amax()));
    (0..size).find(|&vertex| {
        let coupled = (product[vertex] - own(vertex) * field[vertex]).amax();
        coupled > NUMERICS.rounding * scale
    })
}
