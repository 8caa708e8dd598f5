//! The algebra of stiffnesses by elements beside matrices.

use std::sync::Arc;

use nalgebra::SMatrix;
use stickslip::Operator;
use stickslip::fem::ElementStiffness;
use stickslip::solvers::Basis;

use super::DistributedElements;
use crate::DistributedMatrix;
use crate::layout::Layout;
use crate::unknowns::Unknowns;

impl<const C: usize> Operator<C> for DistributedElements<C> {
    type Mass = DistributedMatrix<C>;

    /// A stiffness by elements is no mass: one of no vertex, which a scene refuses.
    fn into_mass(self) -> DistributedMatrix<C> {
        let matrix = self.matrix.filter(|_| self.elements.is_empty());
        matrix.unwrap_or_else(|| DistributedMatrix::combination(&[]))
    }

    fn combination_with(
        terms: &[(f64, &Self)],
        mass: Option<(f64, &DistributedMatrix<C>)>,
    ) -> Self {
        let matrices = matrices(terms);
        let any = !matrices.is_empty() || mass.is_some();
        let matrix = any.then(|| DistributedMatrix::combination_with(&matrices, mass));
        let with_cells = terms.iter().find(|(_, term)| !term.elements.is_empty());
        let (layout, numbering, unknowns) = match (with_cells, &matrix) {
            (Some((_, term)), _) => {
                let (layout, unknowns) = (term.layout.clone(), term.unknowns.clone());
                (layout, Arc::clone(&term.numbering), unknowns)
            }
            (None, Some(matrix)) => (matrix.layout.clone(), Arc::default(), None),
            // An operator without terms is that of no vertex.
            (None, None) => (Arc::new(Layout::empty()), Arc::default(), None),
        };
        let sum = Self::of(layout, numbering, elements(terms).collect(), matrix);
        Self { unknowns, ..sum }
    }

    fn set_combination_with(
        &mut self,
        terms: &[(f64, &Self)],
        mass: Option<(f64, &DistributedMatrix<C>)>,
    ) {
        self.elements.clear();
        self.elements.extend(elements(terms));
        if let Some(matrix) = &mut self.matrix {
            matrix.set_combination_with(&matrices(terms), mass);
        }
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        if let Some(matrix) = &mut self.matrix {
            matrix.add_to_diagonal(i, block);
        }
    }

    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        if !self.elements.is_empty() && !basis.is_empty() {
            self.unknowns = Some(Arc::new(Unknowns::of(basis)));
        }
        let matrix = self.matrix.as_mut();
        matrix.is_none_or(|matrix| matrix.change_basis(basis))
    }

    fn has_rows() -> bool {
        false
    }

    fn format() -> &'static str {
        "DistributedElements"
    }
}

/// The terms by elements.
fn elements<'a, const C: usize>(
    terms: &'a [(f64, &DistributedElements<C>)],
) -> impl Iterator<Item = (f64, ElementStiffness<C>)> + 'a {
    terms.iter().flat_map(|&(factor, term)| {
        let own = term.elements.iter();
        own.map(move |(own, stiffness)| (factor * own, stiffness.clone()))
    })
}

/// The terms that are matrices.
fn matrices<'a, const C: usize>(
    terms: &'a [(f64, &DistributedElements<C>)],
) -> Vec<(f64, &'a DistributedMatrix<C>)> {
    let terms = terms.iter();
    terms
        .filter_map(|&(factor, term)| term.matrix.as_ref().map(|matrix| (factor, matrix)))
        .collect()
}
