//! Matrices of cells of a dipping plane by their modes along strike.

use std::fmt;
use std::sync::Arc;

use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::mode_matrices::ModeMatrices;
use super::split::Split;
use crate::convolution::fast_length;

/// A matrix of cells whose entries depend on the difference of columns and on both rows. An entry is the sum of a part
/// that is even in the difference of columns, with a real spectrum, and of an odd one, with an imaginary one: a real
/// number per mode and pair of rows and part.
pub(crate) struct Layers {
    pub(super) columns: usize,
    pub(super) rows: usize,
    pub(super) forward: Arc<dyn RealToComplex<f64>>,
    pub(super) inverse: Arc<dyn ComplexToReal<f64>>,
    pub(super) down_dip: DownDip,
}

/// The action of a mode on the rows.
pub(super) enum DownDip {
    /// One matrix per mode and block.
    Dense(Vec<ModeMatrices>),
    /// The same in fewer numbers.
    Split(Split),
}

/// The modes of a block while it is assembled.
pub(crate) struct Assembled {
    /// The part that depends on both rows.
    pub(crate) images: ModeMatrices,
    /// The part that depends on the difference of rows: `[mode][difference]`, from the least on; or empty.
    pub(crate) differences: Vec<f64>,
}

/// The memory of a transform along strike.
#[derive(Clone)]
pub(crate) struct RowMemory {
    pub(crate) values: Vec<f64>,
    pub(crate) modes: Vec<Complex<f64>>,
    pub(crate) scratch: Vec<Complex<f64>>,
}

impl Layers {
    /// Without entries.
    pub(crate) fn new(columns: usize, rows: usize) -> Self {
        let length = fast_length(2 * columns - 1);
        let mut planner = RealFftPlanner::new();
        Self {
            columns,
            rows,
            forward: planner.plan_fft_forward(length),
            inverse: planner.plan_fft_inverse(length),
            down_dip: DownDip::Dense(Vec::new()),
        }
    }

    pub(super) fn modes(&self) -> usize {
        self.forward.len() / 2 + 1
    }

    /// Room for the even or odd entries between components, the receiving one first.
    pub(crate) fn block(&self, components: [usize; 2], odd: bool) -> Assembled {
        Assembled {
            images: ModeMatrices::new(components, odd, self.modes(), self.rows),
            differences: Vec::new(),
        }
    }

    /// The numbers of the modes of even or odd entries by the column of the receiver less that of the source, from 0 on.
    pub(crate) fn modes_of<'a>(
        &self,
        entries: &[f64],
        odd: bool,
        memory: &'a mut RowMemory,
    ) -> impl Iterator<Item = f64> + 'a {
        let length = self.forward.len();
        let mirrored = if odd { -1.0 } else { 1.0 };
        memory.values.fill(0.0);
        for (apart, &entry) in entries.iter().enumerate().take(self.columns) {
            if apart > 0 {
                memory.values[apart] = entry;
                memory.values[length - apart] = mirrored * entry;
            } else if !odd {
                memory.values[0] = entry;
            }
        }
        let RowMemory {
            values,
            modes,
            scratch,
        } = memory;
        let done = self.forward.process_with_scratch(values, modes, scratch);
        debug_assert!(done.is_ok(), "{done:?}");
        let share = (length as f64).recip();
        let numbers = modes.iter();
        numbers.map(move |value| share * if odd { value.im } else { value.re })
    }

    /// Takes the assembled blocks in the format whose products take fewer multiplications.
    pub(crate) fn finish(&mut self, blocks: Vec<Assembled>) {
        let (mut images, mut differences) = (Vec::new(), Vec::new());
        for block in blocks {
            images.push(block.images);
            differences.push(block.differences);
        }
        let largest_image = images.iter().map(ModeMatrices::largest);
        let all = differences.iter().flatten().map(|value| value.abs());
        let largest = all.chain(largest_image).fold(0.0, f64::max);
        let sizes = [self.modes(), self.rows];
        self.down_dip = match Split::new(&images, &differences, sizes, largest) {
            Some(split) => DownDip::Split(split),
            None => {
                for (image, differences) in images.iter_mut().zip(&differences) {
                    image.add_differences(differences);
                }
                let largest = images.iter().map(ModeMatrices::largest);
                let largest = largest.fold(0.0, f64::max);
                // Small numbers in single precision.
                for image in &mut images {
                    image.compress(largest);
                }
                DownDip::Dense(images)
            }
        };
    }

    /// The components and the parity of the blocks, the receiving component first.
    pub(super) fn blocks(&self) -> impl Iterator<Item = ([usize; 2], bool)> {
        let (dense, split) = match &self.down_dip {
            DownDip::Dense(blocks) => (&blocks[..], &[][..]),
            DownDip::Split(split) => (&[][..], &split.blocks[..]),
        };
        let dense = dense.iter().map(|at| (at.components, at.odd));
        dense.chain(split.iter().map(|at| (at.components, at.odd)))
    }

    /// The number of a block between two rows at a mode.
    pub(super) fn get(&self, block: usize, mode: usize, receiver: usize, source: usize) -> f64 {
        match &self.down_dip {
            DownDip::Dense(blocks) => blocks[block].get(mode, receiver, source),
            DownDip::Split(split) => split.get(block, mode, receiver, source),
        }
    }

    pub(crate) fn row_memory(&self) -> RowMemory {
        let (forward, inverse) = (
            self.forward.get_scratch_len(),
            self.inverse.get_scratch_len(),
        );
        RowMemory {
            values: self.forward.make_input_vec(),
            modes: self.forward.make_output_vec(),
            scratch: vec![Complex::default(); forward.max(inverse)],
        }
    }
}

impl fmt::Debug for Layers {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Layers({} x {}", self.columns, self.rows)?;
        if let DownDip::Split(split) = &self.down_dip {
            write!(formatter, ", mean ranks {split:?}")?;
        }
        write!(formatter, ")")
    }
}
