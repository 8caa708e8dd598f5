//! The algebra of stiffnesses by elements beside matrices.

use nalgebra::{SMatrix, SVector};
use stickslip_fem::ElementStiffness;

use super::ElementOperator;
use crate::{Basis, BlockMatrix, MassMatrix, Matrix, MatrixDefect, Operator, ProductByParts};

/// Adds a factor times the forces of a field to a field, in the unknowns of the mesh.
type Product<'a, const C: usize> = &'a dyn Fn(f64, &[SVector<f64, C>], &mut [SVector<f64, C>]);

impl<const C: usize> Matrix<C> for ElementOperator<C> {
    fn vertex_count(&self) -> usize {
        let elements = self.elements.first();
        let elements = elements.map(|(_, stiffness)| stiffness.vertex_count());
        let matrix = || self.matrix.as_ref().map(|matrix| matrix.vertex_count());
        elements.or_else(matrix).unwrap_or(0)
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = SVector::zeros();
        for (factor, stiffness) in &self.elements {
            product += *factor
                * match &self.basis {
                    None => stiffness.product_at(i, x),
                    Some(changed) => changed.product_at(stiffness, i, &|p| x[p]),
                };
        }
        if let Some(matrix) = &self.matrix {
            product += matrix.product_at(i, x);
        }
        product
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let mut block = SMatrix::zeros();
        for (factor, stiffness) in &self.elements {
            block += *factor
                * match &self.basis {
                    None => stiffness.diagonal_block(i),
                    Some(changed) => changed.diagonal_block(stiffness, i),
                };
        }
        if let Some(matrix) = &self.matrix {
            block += matrix.diagonal_block(i);
        }
        block
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        for (factor, stiffness) in &self.elements {
            self.add_product(scale * factor, x, y, &|scale, x, y| {
                stiffness.multiply_add(scale, x, y);
            });
        }
        if let Some(matrix) = &self.matrix {
            matrix.multiply_add(scale, x, y);
        }
    }

    fn levels(&self) -> usize {
        let levels = self.elements.iter().map(|(_, own)| own.levels());
        levels.max().unwrap_or(1)
    }

    fn level_at(&self, i: usize) -> usize {
        let stiffnesses = self.elements.iter().map(|(_, stiffness)| stiffness);
        let levels = stiffnesses.map(|stiffness| match &self.basis {
            None => stiffness.level_at(i),
            Some(changed) => changed.level_at(stiffness, i),
        });
        levels.max().unwrap_or(0)
    }

    fn multiply_add_levels(
        &self,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        for (factor, stiffness) in &self.elements {
            self.add_product(scale * factor, x, y, &|scale, x, y| {
                stiffness.multiply_add_levels(weights, scale, x, y);
            });
        }
        if let Some(matrix) = &self.matrix {
            matrix.multiply_add_levels(weights, scale, x, y);
        }
    }

    /// That of a stiffness alone, in the unknowns of the mesh.
    fn by_parts(&self) -> Option<&dyn ProductByParts<C>> {
        match (&self.elements[..], &self.matrix, &self.basis) {
            ([(1.0, stiffness)], None, None) => Some(stiffness),
            _ => None,
        }
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let mut square = 0.0;
        if !self.elements.is_empty() {
            let mut forces = vec![SVector::zeros(); x.len()];
            self.multiply_add(1.0, x, &mut forces);
            square += x
                .iter()
                .zip(&forces)
                .map(|(x, force)| x.dot(force))
                .sum::<f64>();
        } else if let Some(matrix) = &self.matrix {
            square += matrix.quadratic(x);
        }
        square
    }

    fn norm(&self, x: &[SVector<f64, C>]) -> f64 {
        if let Some(matrix) = self.matrix() {
            return matrix.norm(x);
        }
        self.quadratic(x).max(0.0).sqrt()
    }

    fn defect(&self) -> Option<MatrixDefect> {
        self.matrix.as_ref().and_then(|matrix| matrix.defect())
    }
}

impl<const C: usize> ElementOperator<C> {
    /// Adds a product with a stiffness, by its product in the unknowns of the mesh: with factor, field and forces.
    fn add_product(
        &self,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
        product: Product<'_, C>,
    ) {
        let Some(changed) = &self.basis else {
            return product(scale, x, y);
        };
        let mut shared = self.memory.try_lock();
        let mut own = [Vec::new(), Vec::new()];
        let [field, before] = match &mut shared {
            Ok(shared) => &mut **shared,
            Err(_) => &mut own,
        };
        field.clear();
        field.extend_from_slice(x);
        changed.basis.field_to_coordinates(field);
        // At the changed vertices the forces are those of the product alone until they are changed.
        before.clear();
        for p in changed.vertices() {
            before.push(std::mem::replace(&mut y[p], SVector::zeros()));
        }
        product(scale, field, y);
        changed.basis.forces_to_basis(y);
        for (p, before) in changed.vertices().zip(&*before) {
            y[p] += before;
        }
    }
}

impl<const C: usize> Operator<C> for ElementOperator<C> {
    type Mass = MassMatrix<C>;

    /// A stiffness by elements is no mass: one of no vertex, which a scene refuses.
    fn into_mass(self) -> MassMatrix<C> {
        let matrix = self.matrix.filter(|_| self.elements.is_empty());
        matrix.unwrap_or_else(|| BlockMatrix::zero((0, 0))).into()
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &MassMatrix<C>)>) -> Self {
        let matrices = matrices(terms);
        let any = !matrices.is_empty() || mass.is_some();
        let matrix = any.then(|| BlockMatrix::combination_with(&matrices, mass));
        let mut sum = Self::of(elements(terms).collect(), matrix);
        sum.basis = terms.iter().find_map(|(_, term)| term.basis.clone());
        sum
    }

    fn set_combination_with(
        &mut self,
        terms: &[(f64, &Self)],
        mass: Option<(f64, &MassMatrix<C>)>,
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

    fn multiple_of(&self, other: &Self) -> Option<f64> {
        let ([(own, stiffness)], [(factor, another)]) = (&self.elements[..], &other.elements[..])
        else {
            return None;
        };
        let others = [self, other].map(|all| all.matrix.is_some() || all.basis.is_some());
        if others.contains(&true) {
            return None;
        }
        Some(own / factor * stiffness.multiple_of(another)?)
    }

    fn change_basis(&mut self, basis: &Basis<C>) -> bool {
        self.set_basis(basis);
        if let Some(matrix) = &mut self.matrix {
            matrix.change_basis(basis);
        }
        true
    }

    fn has_rows() -> bool {
        false
    }

    fn format() -> &'static str {
        "ElementOperator"
    }
}

/// The terms by elements.
fn elements<'a, const C: usize>(
    terms: &'a [(f64, &ElementOperator<C>)],
) -> impl Iterator<Item = (f64, ElementStiffness<C>)> + 'a {
    terms.iter().flat_map(|&(factor, term)| {
        let own = term.elements.iter();
        own.map(move |(own, stiffness)| (factor * own, stiffness.clone()))
    })
}

/// The terms that are matrices.
fn matrices<'a, const C: usize>(
    terms: &'a [(f64, &ElementOperator<C>)],
) -> Vec<(f64, &'a BlockMatrix<C>)> {
    let terms = terms.iter();
    terms
        .filter_map(|&(factor, term)| term.matrix.as_ref().map(|matrix| (factor, matrix)))
        .collect()
}
