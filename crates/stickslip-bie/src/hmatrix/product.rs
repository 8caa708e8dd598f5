//! Products with a hierarchical matrix, in two phases: coefficients of far blocks, then rows of leaves.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::HMatrix;
use super::far::FarBlock;
use super::strip::Strip;
use crate::plane::parts::{Schedule, for_each, schedule};

/// The most parts of a phase.
const PARTS: usize = 64;

/// The memory of a product.
#[derive(Debug, Clone)]
pub struct HMatrixScratch {
    /// Columns by position of the source.
    x: Vec<f64>,
    coefficients: Vec<Coefficients>,
    rows: Vec<Rows>,
    /// Whether far blocks and strips are needed.
    needed: [Vec<bool>; 2],
}

/// Coefficients of some far blocks.
#[derive(Debug, Clone)]
struct Coefficients {
    blocks: Range<usize>,
    values: Vec<f64>,
}

/// Rows of some strips.
#[derive(Debug, Clone)]
struct Rows {
    strips: Range<usize>,
    values: Vec<f64>,
}

/// Where the coefficients of a far block are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    part: usize,
    first: usize,
}

/// Parts of about as many numbers each, and the place of each block.
pub(super) fn parts_of_blocks(blocks: &[FarBlock]) -> (Vec<Range<usize>>, Vec<Place>) {
    let parts = balanced(blocks.iter().map(|block| block.right.len()));
    let mut places = Vec::with_capacity(blocks.len());
    for (part, range) in parts.iter().enumerate() {
        let mut first = 0;
        for block in &blocks[range.clone()] {
            places.push(Place { part, first });
            first += block.rank;
        }
    }
    (parts, places)
}

/// Parts of about as many numbers each.
pub(super) fn parts_of_strips(strips: &[Strip]) -> Vec<Range<usize>> {
    balanced(strips.iter().map(Strip::len))
}

/// Divides weights into at most [`PARTS`] ranges of about the same sum.
fn balanced(weights: impl Iterator<Item = usize> + Clone) -> Vec<Range<usize>> {
    let share = weights.clone().sum::<usize>().div_ceil(PARTS).max(1);
    let (mut parts, mut begin, mut sum, mut count) = (Vec::new(), 0, 0, 0);
    for weight in weights {
        sum += weight;
        count += 1;
        if sum >= share * (parts.len() + 1) {
            parts.push(begin..count);
            begin = count;
        }
    }
    if begin < count {
        parts.push(begin..count);
    }
    parts
}

impl HMatrix {
    /// The memory of a product.
    pub fn scratch(&self) -> HMatrixScratch {
        let coefficients = self.parts[0].iter().map(|blocks| Coefficients {
            blocks: blocks.clone(),
            values: vec![0.0; self.blocks[blocks.clone()].iter().map(|b| b.rank).sum()],
        });
        let rows = self.parts[1].iter().map(|strips| Rows {
            strips: strips.clone(),
            values: vec![0.0; self.shape[0] * self.receivers_of(strips).len()],
        });
        HMatrixScratch {
            x: vec![0.0; self.shape[1] * self.sources.cells.len()],
            coefficients: coefficients.collect(),
            rows: rows.collect(),
            needed: [vec![true; self.blocks.len()], vec![true; self.strips.len()]],
        }
    }

    /// The positions of receivers of some strips, at least one.
    fn receivers_of(&self, strips: &Range<usize>) -> Range<usize> {
        self.strips[strips.start].receivers.start..self.strips[strips.end - 1].receivers.end
    }

    /// Passes on the rows of all receivers of `A x`: `x` gives the columns of a source, `show` takes a receiver and its rows.
    ///
    /// It runs in the threads of `rayon` if the feature is on, with the same bits in any number of them, and allocates nothing.
    /// Scratch is of this matrix.
    pub fn product<'a>(
        &self,
        scratch: &mut HMatrixScratch,
        x: impl Fn(usize) -> &'a [f64],
        mut show: impl FnMut(usize, &[f64]),
    ) {
        scratch
            .needed
            .iter_mut()
            .for_each(|needed| needed.fill(true));
        self.multiply(scratch, x);
        for part in &scratch.rows {
            let positions = self.receivers_of(&part.strips);
            let rows = part.values.chunks_exact(self.shape[0]);
            for (&receiver, rows) in self.receivers.cells[positions].iter().zip(rows) {
                show(receiver, rows);
            }
        }
    }

    /// The rows of some receivers of `A x`, passed on in their order: the same bits as in [`product`](Self::product), at the cost of
    /// the blocks they need.
    pub fn product_at<'a>(
        &self,
        receivers: impl Iterator<Item = usize> + Clone,
        scratch: &mut HMatrixScratch,
        x: impl Fn(usize) -> &'a [f64],
        mut show: impl FnMut(usize, &[f64]),
    ) {
        scratch
            .needed
            .iter_mut()
            .for_each(|needed| needed.fill(false));
        for receiver in receivers.clone() {
            let strip = self.strip_of(self.receivers.positions[receiver]);
            if !std::mem::replace(&mut scratch.needed[1][strip], true) {
                for far in &self.strips[strip].far {
                    scratch.needed[0][far.block] = true;
                }
            }
        }
        self.multiply(scratch, x);
        for receiver in receivers {
            let position = self.receivers.positions[receiver];
            let strip = self.strip_of(position);
            let part = (scratch.rows).partition_point(|part| part.strips.end <= strip);
            let part = &scratch.rows[part];
            let first = self.shape[0] * (position - self.receivers_of(&part.strips).start);
            show(receiver, &part.values[first..first + self.shape[0]]);
        }
    }

    /// Both phases.
    fn multiply<'a>(&self, scratch: &mut HMatrixScratch, x: impl Fn(usize) -> &'a [f64]) {
        let of_source = self.shape[1];
        for (numbers, &source) in scratch
            .x
            .chunks_exact_mut(of_source)
            .zip(&self.sources.cells)
        {
            numbers.copy_from_slice(x(source));
        }
        let HMatrixScratch {
            x,
            coefficients,
            rows,
            needed: [blocks, strips],
        } = scratch;
        schedule(self.numbers, |in_threads| {
            let order = Schedule {
                in_threads,
                backwards: false,
            };
            for_each(coefficients, order, &|part| {
                Arch::new().dispatch(OfBlocks {
                    matrix: self,
                    needed: blocks,
                    x,
                    part,
                });
            });
            for_each(rows, order, &|part| {
                Arch::new().dispatch(OfStrips {
                    matrix: self,
                    needed: strips,
                    x,
                    coefficients,
                    part,
                });
            });
        });
    }
}

/// Coefficients of a part.
struct OfBlocks<'a> {
    matrix: &'a HMatrix,
    needed: &'a [bool],
    x: &'a [f64],
    part: &'a mut Coefficients,
}

impl WithSimd for OfBlocks<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let of_source = self.matrix.shape[1];
        let mut values = self.part.values.as_mut_slice();
        values.fill(0.0);
        for number in self.part.blocks.clone() {
            let block = &self.matrix.blocks[number];
            let (own, rest) = values.split_at_mut(block.rank);
            values = rest;
            if self.needed[number] {
                let columns = of_source * block.sources.start..of_source * block.sources.end;
                block.right.multiply_add(&self.x[columns], own);
            }
        }
    }
}

/// Rows of a part.
struct OfStrips<'a> {
    matrix: &'a HMatrix,
    needed: &'a [bool],
    x: &'a [f64],
    coefficients: &'a [Coefficients],
    part: &'a mut Rows,
}

impl WithSimd for OfStrips<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let [of_receiver, of_source] = self.matrix.shape;
        let mut values = self.part.values.as_mut_slice();
        values.fill(0.0);
        for number in self.part.strips.clone() {
            let strip = &self.matrix.strips[number];
            let (own, rest) = values.split_at_mut(of_receiver * strip.receivers.len());
            values = rest;
            if !self.needed[number] {
                continue;
            }
            for near in &strip.near {
                let columns = of_source * near.sources.start..of_source * near.sources.end;
                near.values.multiply_add(&self.x[columns], own);
            }
            for far in &strip.far {
                let Place { part, first } = self.matrix.places[far.block];
                let coefficients = &self.coefficients[part].values[first..];
                far.left.multiply_add(coefficients, own);
            }
        }
    }
}
