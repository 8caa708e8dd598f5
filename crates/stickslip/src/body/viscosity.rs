//! The viscosities of a scene, and those whose force lags in explicit steps.

use nalgebra::SVector;
use stickslip_core::compiled;
use stickslip_solvers::{Matrix, Operator};

use super::formatted::Formatted;
use crate::numerics::NUMERICS;
use crate::sums::all_directions;

/// The viscosities that couple vertices, of a scene with a diagonal mass: an explicit step takes their force at its mean
/// velocity, which is known before the new velocity, so that its matrix stays diagonal.
pub(super) struct Lagged<Op> {
    /// Their places among all.
    pub(super) places: Vec<usize>,
    /// The sum of the others, if there are any.
    pub(super) prompt: Option<Op>,
    /// The relaxation time \[s\] of which they are multiples of the stiffness, if all are by their construction.
    pub(super) relaxation: Option<f64>,
}

impl<Op: Operator<C>, const C: usize> Formatted<Op, C> {
    /// Finds the viscosities that lag.
    pub(super) fn find_lagged(&self) -> Option<Lagged<Op>> {
        let (mass, ranks) = (self.mass.as_ref()?, self.stiffness.ranks());
        if self.viscosities.is_empty() || ranks.any(first_coupled(mass).is_some()) {
            return None;
        }
        let couples = |n: &usize| ranks.any(first_coupled(&self.viscosities[*n]).is_some());
        let (places, prompt): (Vec<_>, Vec<_>) = (0..self.viscosities.len()).partition(couples);
        let terms: Vec<_> = (prompt.iter())
            .map(|&n| (1.0, &self.viscosities[n]))
            .collect();
        let prompt = (!terms.is_empty()).then(|| Op::combination(&terms));
        let multiple = |n: &usize| self.viscosities[*n].multiple_of(&self.stiffness);
        let relaxation = places.iter().map(multiple).sum();
        (!places.is_empty()).then_some(Lagged {
            places,
            prompt,
            relaxation,
        })
    }
}

compiled! {
    /// The first vertex at which the product of a matrix differs from that of its diagonal block.
    pub(crate) fn first_coupled<C>(matrix: &dyn Matrix<C>) -> Option<usize> {
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
}
