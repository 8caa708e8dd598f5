//! The dense matrix of a problem.

use pulp::{Arch, Simd, WithSimd};

use crate::packed_symmetric::PackedSymmetric;

/// A symmetric matrix in two formats: by columns, for its entries, and packed, for products.
#[derive(Debug)]
pub(crate) struct DenseMatrix {
    count: usize,
    columns: Vec<f64>,
    panels: PackedSymmetric,
}

impl DenseMatrix {
    /// Zero, with so many unknowns.
    pub(crate) fn new(count: usize) -> Self {
        Self {
            count,
            columns: vec![0.0; count * count],
            panels: PackedSymmetric::new(count),
        }
    }

    /// The memory for so many unknowns \[byte\].
    pub(crate) fn bytes(count: usize) -> usize {
        let columns = count.saturating_mul(count).saturating_mul(size_of::<f64>());
        columns.saturating_add(PackedSymmetric::bytes(count))
    }

    /// Lets `write` fill all entries, column by column, both triangles.
    pub(crate) fn write<R>(&mut self, write: impl FnOnce(&mut [f64]) -> R) -> R {
        let result = write(&mut self.columns);
        self.panels.take(&self.columns, self.count);
        result
    }

    /// All entries, column by column.
    pub(crate) fn columns(&self) -> &[f64] {
        &self.columns
    }

    /// One column.
    #[inline]
    pub(crate) fn column(&self, j: usize) -> &[f64] {
        &self.columns[j * self.count..][..self.count]
    }

    /// `y += S x`; the vectors are padded with zeros to [`PackedSymmetric::padded`].
    pub(crate) fn add_product(&self, x: &[f64], y: &mut [f64]) {
        let panels = &self.panels;
        Arch::new().dispatch(AddProduct { panels, x, y });
    }
}

struct AddProduct<'a> {
    panels: &'a PackedSymmetric,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl WithSimd for AddProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.panels.add_product(simd, 0, self.x, self.y);
    }
}
