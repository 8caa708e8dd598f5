//! The dense interaction of the cells of a surface.

use std::fmt;

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd, WithSimd};
#[cfg(feature = "rayon")]
use rayon::prelude::*;
use stickslip_core::compiled;

use super::Triangles;
use super::elements::Elements;
use crate::plane::dot;

/// The share of the largest shear stress below which normal stress is rounding.
const ROUNDING: f64 = 1e-12;

/// Numbers of each cell due to slip of all cells: `C` forces that resist slip [N/m], and its compression [Pa/m].
///
/// A row has its columns by cell, then component of slip.
pub(crate) struct Dense<const C: usize> {
    count: usize,
    shear: Vec<f64>,
    normal: Vec<f64>,
    /// Whether slip changes no normal stress, up to rounding.
    pub(crate) is_planar: bool,
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Memory {
    /// The numbers of the last product of compressions.
    pub(crate) fn values(&self) -> &[f64] {
        &self.y
    }
}

/// The bytes of the numbers of so many cells.
pub(crate) fn bytes<const C: usize>(count: usize) -> f64 {
    (size_of::<f64>() * C * (C + 1)) as f64 * (count as f64).powi(2)
}

compiled! {
    /// All pairs, and the correction of shear if there is one.
    pub(crate) fn assemble<C in 1, 2>(
        elements: &Elements<C>,
        cells: &Triangles,
        is_corrected: bool,
    ) -> Dense<C> {
        let count = elements.count();
        let width = C * count;
        let mut found = Dense {
            count,
            shear: vec![0.0; C * C * count * count],
            normal: vec![0.0; C * count * count],
            is_planar: false,
        };
        let work = |(i, (rows, row)): (usize, (&mut [f64], &mut [f64]))| {
            let area = elements.areas[i];
            for j in 0..count {
                let (shear, compression) = elements.pair(i, j);
                for c in 0..C {
                    row[C * j + c] = compression[c];
                    for r in 0..C {
                        rows[r * width + C * j + c] = -area * shear[(r, c)];
                    }
                }
            }
            if is_corrected {
                for (j, block) in elements.correction(cells, i) {
                    for (r, c) in (0..C).flat_map(|r| (0..C).map(move |c| (r, c))) {
                        rows[r * width + C * j + c] -= area * block[(r, c)];
                    }
                }
            }
        };
        #[cfg(feature = "rayon")]
        (found.shear.par_chunks_exact_mut(C * width))
            .zip(found.normal.par_chunks_exact_mut(width))
            .enumerate()
            .for_each(work);
        #[cfg(not(feature = "rayon"))]
        (found.shear.chunks_exact_mut(C * width))
            .zip(found.normal.chunks_exact_mut(width))
            .enumerate()
            .for_each(work);
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let of_cell = |i: usize| {
            let shear = &found.shear[C * width * i..C * width * (i + 1)];
            let normal = &found.normal[width * i..width * (i + 1)];
            largest(normal) * elements.areas[i] <= ROUNDING * largest(shear)
        };
        found.is_planar = (0..count).all(of_cell);
        found
    }
}

impl<const C: usize> fmt::Debug for Dense<C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Dense({} cells)", self.count)
    }
}

impl<const C: usize> Dense<C> {
    pub(crate) fn memory(&self) -> Memory {
        Memory {
            x: vec![0.0; C * self.count],
            y: vec![0.0; C * self.count],
        }
    }

    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// The force at cell `i` per slip of cell `j`.
    pub(crate) fn force(&self, i: usize, j: usize) -> SMatrix<f64, C, C> {
        let width = C * self.count;
        SMatrix::from_fn(|r, c| self.shear[(C * i + r) * width + C * j + c])
    }

    /// The compression of cell `i` per slip of cell `j`.
    pub(crate) fn compression(&self, i: usize, j: usize) -> SVector<f64, C> {
        let row = &self.normal[C * self.count * i..];
        SVector::from_fn(|c, _| row[C * j + c])
    }

    /// Passes on the forces at some cells, by their place among them. Allocates nothing.
    pub(crate) fn forces(
        &self,
        cells: impl Iterator<Item = usize>,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, C>),
    ) {
        let Memory { x: numbers, y } = memory;
        set(numbers, x);
        let rows = cells.flat_map(|cell| (0..C).map(move |c| C * cell + c));
        let count = Arch::new().dispatch(Product {
            values: &self.shear,
            rows,
            x: numbers,
            y,
        });
        for (place, y) in y[..count].chunks_exact(C).enumerate() {
            show(place, SVector::from_fn(|c, _| y[c]));
        }
    }

    /// Computes the compressions of all cells, [`Memory::values`]. Allocates nothing.
    pub(crate) fn compressions(&self, memory: &mut Memory, x: &[SVector<f64, C>]) {
        let Memory { x: numbers, y } = memory;
        set(numbers, x);
        Arch::new().dispatch(Product {
            values: &self.normal,
            rows: 0..self.count,
            x: numbers,
            y,
        });
    }
}

fn set<const C: usize>(numbers: &mut [f64], x: &[SVector<f64, C>]) {
    for (numbers, x) in numbers.chunks_exact_mut(C).zip(x) {
        numbers.copy_from_slice(x.as_slice());
    }
}

/// Sums of rows; their number.
struct Product<'a, I> {
    values: &'a [f64],
    rows: I,
    x: &'a [f64],
    y: &'a mut [f64],
}

impl<I: Iterator<Item = usize>> WithSimd for Product<'_, I> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        let width = self.x.len();
        let mut count = 0;
        for (row, y) in self.rows.zip(self.y) {
            *y = dot(&self.values[row * width..][..width], self.x);
            count += 1;
        }
        count
    }
}
