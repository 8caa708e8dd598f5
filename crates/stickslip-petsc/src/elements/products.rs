//! Products with stiffnesses by elements.

use nalgebra::{SMatrix, SVector};
use stickslip::Matrix;
use stickslip::solvers::Ranks;

use super::DistributedElements;

impl<const C: usize> Matrix<C> for DistributedElements<C> {
    fn vertex_count(&self) -> usize {
        self.layout.owned
    }

    fn product_at(&self, i: usize, x: &[SVector<f64, C>]) -> SVector<f64, C> {
        let mut product = SVector::zeros();
        if !self.elements.is_empty() {
            let unknown = |field: &mut [SVector<f64, C>]| {
                field[self.layout.owned..].fill(SVector::repeat(f64::NAN));
            };
            product += self.with_forces(x, unknown, |forces| forces[i]);
        }
        if let Some(matrix) = &self.matrix {
            product += matrix.product_at(i, x);
        }
        product
    }

    fn products_at(
        &self,
        vertices: &[usize],
        x: &[SVector<f64, C>],
        products: &mut [SVector<f64, C>],
    ) {
        match &self.matrix {
            Some(matrix) => matrix.products_at(vertices, x, products),
            None => products.fill(SVector::zeros()),
        }
        if !self.elements.is_empty() {
            let exchange = |field: &mut [_]| self.layout.update(field);
            self.with_forces(x, exchange, |forces| {
                for (product, &i) in products.iter_mut().zip(vertices) {
                    *product += forces[i];
                }
            });
        }
    }

    fn diagonal_block(&self, i: usize) -> SMatrix<f64, C, C> {
        let mut block = SMatrix::zeros();
        if !self.elements.is_empty() {
            let own = [(i, SMatrix::identity())];
            let unknowns = self.unknowns.as_ref();
            let moved = unknowns.and_then(|unknowns| unknowns.moved_by(i));
            let moved = moved.unwrap_or(&own[..]);
            for (row, left) in moved {
                for (column, right) in moved {
                    block += left.tr_mul(&self.block([*row, *column])) * right;
                }
            }
        }
        if let Some(matrix) = &self.matrix {
            block += matrix.diagonal_block(i);
        }
        block
    }

    fn multiply_add(&self, scale: f64, x: &[SVector<f64, C>], y: &mut [SVector<f64, C>]) {
        if !self.elements.is_empty() {
            let exchange = |field: &mut [_]| self.layout.update(field);
            self.with_forces(x, exchange, |forces| {
                for (y, force) in y.iter_mut().zip(forces) {
                    *y += force * scale;
                }
            });
        }
        if let Some(matrix) = &self.matrix {
            matrix.multiply_add(scale, x, y);
        }
    }

    fn quadratic(&self, x: &[SVector<f64, C>]) -> f64 {
        let mut forces = vec![SVector::zeros(); x.len()];
        self.multiply_add(1.0, x, &mut forces);
        let terms = x.iter().zip(&forces);
        let own = terms.map(|(x, force)| x.dot(force)).sum();
        self.layout.ranks.sum(own)
    }

    fn ranks(&self) -> Ranks {
        self.layout.ranks.clone()
    }
}
