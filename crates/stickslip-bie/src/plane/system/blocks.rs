//! The dense interaction between the cells of different planes.

use std::ops::Range;

use nalgebra::{SMatrix, SVector};
use pulp::{Arch, Simd, WithSimd};

/// Independent sums of one row, in this order at any width of registers.
const LANES: usize = 16;

/// `R` numbers per cell due to `C` components of slip of the cells of all other planes.
///
/// A row has its columns by plane, then component, then cell: those of its own plane are left out, and the others are
/// contiguous before and after it.
#[derive(Debug)]
pub(crate) struct Blocks<const R: usize, const C: usize> {
    /// The vertices of planes.
    planes: Vec<Range<usize>>,
    /// Where the rows of planes begin.
    starts: Vec<usize>,
    values: Vec<f64>,
}

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory<const R: usize> {
    x: Vec<f64>,
    y: Vec<SVector<f64, R>>,
}

impl<const R: usize, const C: usize> Blocks<R, C> {
    /// Zeros.
    pub(crate) fn new(planes: Vec<Range<usize>>) -> Self {
        let count = planes.last().map_or(0, |plane| plane.end);
        let mut starts = Vec::with_capacity(planes.len());
        let mut length = 0;
        for plane in &planes {
            starts.push(length);
            length += R * C * plane.len() * (count - plane.len());
        }
        Self {
            planes,
            starts,
            values: vec![0.0; length],
        }
    }

    fn vertex_count(&self) -> usize {
        self.planes.last().map_or(0, |plane| plane.end)
    }

    fn plane_of(&self, vertex: usize) -> usize {
        self.planes.partition_point(|plane| plane.end <= vertex)
    }

    /// The length of a row of a plane's cells.
    fn width(&self, plane: usize) -> usize {
        C * (self.vertex_count() - self.planes[plane].len())
    }

    /// All rows of a vertex of a plane.
    fn rows(&self, plane: usize, vertex: usize) -> &[f64] {
        let length = R * self.width(plane);
        let cell = vertex - self.planes[plane].start;
        &self.values[self.starts[plane] + cell * length..][..length]
    }

    /// Where the columns of another plane are in a row of a plane's cells.
    fn columns(&self, plane: usize, other: usize) -> Range<usize> {
        let own = &self.planes[plane];
        let Range { start, end } = self.planes[other];
        let skipped = if start >= own.end { own.len() } else { 0 };
        C * (start - skipped)..C * (end - skipped)
    }

    /// The number `row` of a cell due to a component of all cells of another plane.
    pub(crate) fn entries_mut(
        &mut self,
        [plane, cell]: [usize; 2],
        row: usize,
        other: usize,
        component: usize,
    ) -> &mut [f64] {
        let begin = self.starts[plane] + (cell * R + row) * self.width(plane);
        let count = self.planes[other].len();
        let columns = begin + self.columns(plane, other).start + component * count;
        &mut self.values[columns..][..count]
    }

    /// The stress at vertex `i` per slip of vertex `j`; zero on one plane.
    pub(crate) fn entry(&self, i: usize, j: usize) -> SMatrix<f64, R, C> {
        let (plane, other) = (self.plane_of(i), self.plane_of(j));
        if plane == other {
            return SMatrix::zeros();
        }
        let (rows, columns) = (self.rows(plane, i), self.columns(plane, other));
        let Range { start, end } = self.planes[other];
        SMatrix::from_fn(|row, component| {
            let column = columns.start + component * (end - start) + j - start;
            rows[row * self.width(plane) + column]
        })
    }

    pub(crate) fn memory(&self) -> Memory<R> {
        let count = self.vertex_count();
        Memory {
            x: vec![0.0; C * count],
            y: vec![SVector::zeros(); count],
        }
    }

    /// Passes on the sums of some vertices, increasing, by their place among them. Allocates nothing.
    pub(crate) fn product(
        &self,
        vertices: impl Iterator<Item = usize>,
        memory: &mut Memory<R>,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, &SVector<f64, R>),
    ) {
        if self.values.is_empty() {
            return;
        }
        let Memory { x: numbers, y } = memory;
        for plane in &self.planes {
            let of_plane = &mut numbers[C * plane.start..C * plane.end];
            for (component, numbers) in of_plane.chunks_exact_mut(plane.len()).enumerate() {
                for (number, x) in numbers.iter_mut().zip(&x[plane.clone()]) {
                    *number = x[component];
                }
            }
        }
        let count = Arch::new().dispatch(Product {
            blocks: self,
            vertices,
            x: numbers,
            y,
        });
        for (place, y) in y[..count].iter().enumerate() {
            show(place, y);
        }
    }
}

/// Sums of rows; their number.
struct Product<'a, I, const R: usize, const C: usize> {
    blocks: &'a Blocks<R, C>,
    vertices: I,
    x: &'a [f64],
    y: &'a mut [SVector<f64, R>],
}

impl<I: Iterator<Item = usize>, const R: usize, const C: usize> WithSimd for Product<'_, I, R, C> {
    type Output = usize;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> usize {
        let Self { blocks, x, y, .. } = self;
        let (mut count, mut plane) = (0, 0);
        for (vertex, y) in self.vertices.zip(y) {
            while blocks.planes[plane].end <= vertex {
                plane += 1;
            }
            let own = &blocks.planes[plane];
            let (before, after) = (&x[..C * own.start], &x[C * own.end..]);
            let rows = blocks.rows(plane, vertex);
            for (row, y) in rows.chunks_exact(rows.len() / R).zip(y.iter_mut()) {
                let (of_before, of_after) = row.split_at(before.len());
                *y = dot(of_before, before) + dot(of_after, after);
            }
            count += 1;
        }
        count
    }
}

/// The sum of products, the same bits at any width of registers.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    for (lane, (a, b)) in a_rest.iter().zip(b_rest).enumerate() {
        sums[lane] += a * b;
    }
    let mut width = LANES / 2;
    while width > 0 {
        for lane in 0..width {
            sums[lane] += sums[lane + width];
        }
        width /= 2;
    }
    sums[0]
}
