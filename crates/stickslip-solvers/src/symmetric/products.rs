//! Products with a packed symmetric operator, in the widest registers.

use nalgebra::SVector;
use pulp::{Simd, WithSimd};

use super::{BLOCK, Symmetric, TILE};
use crate::packed_symmetric::WIDTH;

pub(super) struct Product<'a, const C: usize> {
    pub(super) operator: &'a Symmetric<C>,
    pub(super) scale: f64,
    pub(super) x: &'a [SVector<f64, C>],
    pub(super) y: &'a mut [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Product<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            operator,
            scale,
            x,
            y,
        } = self;
        let panels = &operator.panels;
        for column in (0..panels.rows()).step_by(BLOCK) {
            let (mut values, mut sums) = ([0.0; BLOCK], [0.0; BLOCK]);
            let values = operator.gather(column, x, &mut values);
            let sums = &mut sums[..values.len()];
            panels.add_product(simd, column, values, sums);
            for row in (column + BLOCK..panels.rows()).step_by(BLOCK) {
                let (mut below, mut image) = ([0.0; BLOCK], [0.0; BLOCK]);
                let below = operator.gather(row, x, &mut below);
                let image = &mut image[..below.len()];
                panels.add_product_below(simd, (column, values, sums), (row, below, image));
                operator.scatter(row, scale, image, y);
            }
            operator.scatter(column, scale, sums, y);
        }
    }
}

pub(super) struct Products<'a, const C: usize> {
    pub(super) operator: &'a Symmetric<C>,
    pub(super) vertices: &'a [usize],
    pub(super) x: &'a [SVector<f64, C>],
    pub(super) products: &'a mut [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Products<'_, C> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            operator,
            vertices,
            x,
            products,
        } = self;
        // Rows increase with vertices: a tile is multiplied once.
        let (mut known, mut sums) = (usize::MAX, [0.0; TILE]);
        for (product, &vertex) in products.iter_mut().zip(vertices) {
            *product = SVector::zeros();
            for (c, row) in operator.unknowns.free(vertex) {
                if row / TILE != known {
                    known = row / TILE;
                    sums = operator.row_products(simd, known, x);
                }
                product[c] = sums[row % TILE];
            }
        }
    }
}

pub(super) struct Quadratic<'a, const C: usize> {
    pub(super) operator: &'a Symmetric<C>,
    pub(super) x: &'a [SVector<f64, C>],
}

impl<const C: usize> WithSimd for Quadratic<'_, C> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { operator, x } = self;
        let panels = &operator.panels;
        let mut half = 0.0;
        for column in (0..panels.rows()).step_by(BLOCK) {
            let mut values = [0.0; BLOCK];
            let values = operator.gather(column, x, &mut values);
            for row in (column..panels.rows()).step_by(BLOCK) {
                let mut below = [0.0; BLOCK];
                let below = operator.gather(row, x, &mut below);
                for (four, panel) in values.chunks_exact(WIDTH).zip(column / WIDTH..) {
                    let products = panels.products(simd, panel, (row, below));
                    for k in 0..WIDTH {
                        half += four[k] * products[k];
                    }
                }
            }
        }
        2.0 * half
    }
}
