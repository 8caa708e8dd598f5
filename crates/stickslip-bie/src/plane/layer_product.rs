//! Products with a matrix that is known by its modes along strike.

use nalgebra::SVector;
use realfft::num_complex::Complex;

use super::layers::{DownDip, Layers, RowMemory};
use super::mode_matrices::padded;
use super::modes::Product;
use super::parts::{Schedule, for_each, schedule};
use super::split;

/// Rows in a part of the transforms.
const ROWS: usize = 4;

/// Modes in a part: those of a row in one line of the cache.
const MODES: usize = 4;

/// The memory of a product.
#[derive(Clone)]
pub(crate) struct Memory {
    rows: Vec<RowPart>,
    modes: Vec<ModePart>,
    /// The order of the last product. Each product reverses it: it finds in the cache what the last one has read last.
    backwards: bool,
}

/// Some rows of cells.
#[derive(Clone)]
struct RowPart {
    /// The first row and the number of rows.
    first: usize,
    count: usize,
    memory: RowMemory,
    /// Spectra `[component][row][mode]`.
    spectra: Vec<Complex<f64>>,
    /// Products `[component][row][column]`.
    products: Vec<f64>,
}

/// Some modes.
#[derive(Clone)]
struct ModePart {
    first: usize,
    /// Slip `[mode][component][row]`.
    x: Vec<Complex<f64>>,
    /// Stress `[mode][component][row]`, rows up to whole panels: real parts, then imaginary parts.
    y: Vec<f64>,
    /// The memory of split matrices.
    split: Option<split::Memory>,
}

impl Layers {
    /// The multiplications of one mode, on average.
    fn work_of_mode(&self) -> usize {
        match &self.down_dip {
            DownDip::Dense(blocks) => blocks.len() * self.rows * padded(self.rows),
            DownDip::Split(split) => split.multiplications() / self.modes(),
        }
    }

    /// The memory of a product.
    pub(crate) fn memory(&self, outputs: usize, inputs: usize) -> Memory {
        let rows = (0..self.rows).step_by(ROWS).map(|first| {
            let count = ROWS.min(self.rows - first);
            RowPart {
                first,
                count,
                memory: self.row_memory(),
                spectra: vec![Complex::default(); inputs * count * self.modes()],
                products: vec![0.0; outputs * count * self.columns],
            }
        });
        let modes = (0..self.modes()).step_by(MODES).map(|first| {
            let count = MODES.min(self.modes() - first);
            ModePart {
                first,
                x: vec![Complex::default(); count * inputs * self.rows],
                y: vec![0.0; count * outputs * 2 * padded(self.rows)],
                split: match &self.down_dip {
                    DownDip::Dense(_) => None,
                    DownDip::Split(split) => Some(split.memory(inputs)),
                },
            }
        });
        Memory {
            rows: rows.collect(),
            modes: modes.collect(),
            backwards: false,
        }
    }

    /// Passes on `(A x)_i` of each cell. Allocates nothing.
    pub(crate) fn product<const O: usize, const C: usize>(
        &self,
        memory: &mut Memory,
        x: &[SVector<f64, C>],
        mut show: impl FnMut(usize, SVector<f64, O>),
    ) {
        debug_assert_eq!(x.len(), self.columns * self.rows);
        let Memory {
            rows,
            modes,
            backwards,
        } = &mut *memory;
        *backwards = !*backwards;
        schedule(self.modes() * self.work_of_mode(), |in_threads| {
            let order = Schedule {
                in_threads,
                backwards: *backwards,
            };
            for_each(rows, order, &|part| self.transform(x, part));
            for_each(modes, order, &|part| {
                part.gather(rows, self.rows, self.modes(), C);
                self.multiply(part, [C, O], order.backwards);
            });
            for_each(rows, order, &|part| self.transform_back(modes, part, O));
        });
        for part in &memory.rows {
            let begin = part.first * self.columns;
            let count = part.count * self.columns;
            for i in 0..count {
                let value = SVector::from_fn(|c, _| part.products[c * count + i]);
                show(begin + i, value);
            }
        }
    }

    /// Multiplies some modes, of so many inputs and outputs.
    fn multiply(&self, part: &mut ModePart, [inputs, outputs]: [usize; 2], backwards: bool) {
        let (first, rows) = (part.first, self.rows);
        match (&self.down_dip, &mut part.split) {
            (DownDip::Split(split), Some(memory)) => {
                part.y.fill(0.0);
                let each = part.y.chunks_exact_mut(outputs * 2 * padded(rows));
                for (n, (y, x)) in each.zip(part.x.chunks_exact(inputs * rows)).enumerate() {
                    split.add(first + n, x, memory, y);
                }
            }
            (DownDip::Dense(blocks), _) => {
                let product = Product {
                    blocks,
                    rows,
                    first,
                    inputs,
                    outputs,
                    backwards,
                    x: &part.x,
                    y: &mut part.y,
                };
                product.run();
            }
            (DownDip::Split(_), None) => debug_assert!(false, "the memory of another matrix"),
        }
    }

    /// Transforms some rows.
    fn transform<const C: usize>(&self, x: &[SVector<f64, C>], part: &mut RowPart) {
        let RowMemory {
            values, scratch, ..
        } = &mut part.memory;
        let cells = &x[part.first * self.columns..][..part.count * self.columns];
        let spectra = part.spectra.chunks_exact_mut(self.modes());
        let rows = (0..C).flat_map(|c| cells.chunks_exact(self.columns).map(move |row| (c, row)));
        for ((c, cells), modes) in rows.zip(spectra) {
            let (filled, rest) = values.split_at_mut(self.columns);
            for (value, x) in filled.iter_mut().zip(cells) {
                *value = x[c];
            }
            rest.fill(0.0);
            let done = self.forward.process_with_scratch(values, modes, scratch);
            debug_assert!(done.is_ok(), "{done:?}");
        }
    }

    /// Transforms some rows of the products of all modes back.
    fn transform_back(&self, parts: &[ModePart], part: &mut RowPart, outputs: usize) {
        let width = padded(self.rows);
        let RowMemory {
            values,
            modes,
            scratch,
        } = &mut part.memory;
        let products = part.products.chunks_exact_mut(self.columns);
        for (place, cells) in products.enumerate() {
            let (component, row) = (place / part.count, part.first + place % part.count);
            let (real, imaginary) = (
                2 * component * width + row,
                (2 * component + 1) * width + row,
            );
            let mut values_of_modes = modes.iter_mut();
            for part in parts {
                let of_modes = part.y.chunks_exact(outputs * 2 * width);
                for (y, value) in of_modes.zip(&mut values_of_modes) {
                    *value = Complex::new(y[real], y[imaginary]);
                }
            }
            // Real by symmetry; the inverse refuses what rounding might leave.
            modes[0].im = 0.0;
            let last = modes.len() - 1;
            modes[last].im = 0.0;
            let done = self.inverse.process_with_scratch(modes, values, scratch);
            debug_assert!(done.is_ok(), "{done:?}");
            cells.copy_from_slice(&values[..self.columns]);
        }
    }
}

impl ModePart {
    /// Collects the modes of all rows, of which there are so many.
    fn gather(&mut self, parts: &[RowPart], rows: usize, modes: usize, components: usize) {
        let stride = components * rows;
        for part in parts {
            for (place, spectrum) in part.spectra.chunks_exact(modes).enumerate() {
                let (component, row) = (place / part.count, part.first + place % part.count);
                let columns = self.x.chunks_exact_mut(stride);
                for (column, value) in columns.zip(&spectrum[self.first..]) {
                    column[component * rows + row] = *value;
                }
            }
        }
    }
}
