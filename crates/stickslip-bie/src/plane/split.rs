//! One matrix of rows per mode along strike, as the part of a whole space and an image part of low rank.

use std::fmt;
use std::sync::Arc;

use pulp::{Arch, Simd, WithSimd};
use realfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use super::mode_matrices::{ModeMatrices, padded};
use super::ranks::Ranks;
use crate::convolution::fast_length;

/// The matrices of the modes along strike, each as `T(i - j) + sum_k u_k(i) v_k(j)`: the rows of a whole space differ in
/// their distance alone, and are multiplied by transforms down dip; what the free surface adds is smooth.
pub(crate) struct Split {
    rows: usize,
    /// The multiplications of a complex number by a real one in a product.
    multiplications: usize,
    /// The transforms down dip, of twice the number of rows; none if there is no part of a whole space.
    transforms: Option<[Arc<dyn Fft<f64>>; 2]>,
    pub(super) blocks: Vec<Block>,
}

/// The matrices between two components.
pub(crate) struct Block {
    pub(super) components: [usize; 2],
    pub(super) odd: bool,
    /// Spectra `[mode][difference of rows]`, from the least on; empty without a part of a whole space.
    differences: Vec<f64>,
    /// Spectra by mode, then wave number down dip, normalised by the transform length: real, since a block is even or odd in both
    /// differences at once.
    spectra: Vec<f64>,
    images: Ranks,
}

/// The memory of the products of a mode.
#[derive(Debug, Clone, Default)]
pub(crate) struct Memory {
    /// Spectra of each slipping component, then of one force.
    waves: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// Real and imaginary parts of the pairs of a mode.
    parts: Vec<f64>,
    pairs: Vec<Complex<f64>>,
}

impl Split {
    /// Splits matrices of image parts and of differences of rows, if products then take fewer multiplications than with
    /// their sum.
    pub(super) fn new(
        images: &[ModeMatrices],
        differences: &[Vec<f64>],
        [modes, rows]: [usize; 2],
        largest: f64,
    ) -> Option<Self> {
        let has_whole = differences.iter().any(|values| !values.is_empty());
        let length = fast_length(2 * rows - 1);
        let components = |place: usize| {
            let of = images.iter().map(|block| block.components[place]);
            of.max().map_or(0, |most| most + 1)
        };
        // In multiplications of a complex number by a real one. A transform has log2(length)/2 products of complex
        // numbers for each place.
        let transform = length * length.next_power_of_two().ilog2() as usize;
        let of_whole = if has_whole {
            (components(0) + components(1)) * transform + images.len() * length
        } else {
            0
        };
        let dense = modes * images.len() * rows * padded(rows);
        let mut most = dense.checked_sub(modes * of_whole)?;
        let mut ranks = Vec::new();
        for block in images {
            let image = Ranks::of(block, [modes, rows], largest, most)?;
            most -= image.multiplications();
            ranks.push(image);
        }
        let transforms = has_whole.then(|| {
            let mut planner = FftPlanner::new();
            [
                planner.plan_fft_forward(length),
                planner.plan_fft_inverse(length),
            ]
        });
        let blocks = images.iter().zip(differences).zip(ranks);
        let blocks = blocks.map(|((block, differences), images)| Block {
            components: block.components,
            odd: block.odd,
            differences: differences.clone(),
            spectra: match &transforms {
                Some([forward, _]) if !differences.is_empty() => {
                    spectra(&**forward, differences, rows, block.odd)
                }
                _ => Vec::new(),
            },
            images,
        });
        Some(Self {
            rows,
            multiplications: dense - most,
            blocks: blocks.collect(),
            transforms,
        })
    }

    /// The multiplications of a complex number by a real one in the products of all modes.
    pub(super) fn multiplications(&self) -> usize {
        self.multiplications
    }

    fn length(&self) -> usize {
        self.transforms.as_ref().map_or(0, |[fft, _]| fft.len())
    }

    /// The number between two rows at a mode.
    pub(super) fn get(&self, block: usize, mode: usize, receiver: usize, source: usize) -> f64 {
        let block = &self.blocks[block];
        let each = 2 * self.rows - 1;
        let whole = (block.differences).get(mode * each + receiver + self.rows - 1 - source);
        whole.map_or(0.0, |value| *value) + block.images.get(mode, receiver, source)
    }

    pub(super) fn memory(&self, inputs: usize) -> Memory {
        let length = self.length();
        let scratch = self.transforms.iter().flatten();
        let scratch = scratch.map(|fft| fft.get_inplace_scratch_len()).max();
        let ranks = self.blocks.iter().map(|block| block.images.largest());
        let rank = ranks.max().unwrap_or(0);
        Memory {
            waves: vec![Complex::default(); (inputs + 1) * length],
            scratch: vec![Complex::default(); scratch.unwrap_or(0)],
            parts: vec![0.0; 2 * padded(rank)],
            pairs: vec![Complex::default(); rank],
        }
    }

    /// Adds the products of a mode to `y`; `x` is by component, then row, `y` by component, then row up to whole panels,
    /// first the real parts of a component, then the imaginary ones.
    pub(super) fn add(&self, mode: usize, x: &[Complex<f64>], memory: &mut Memory, y: &mut [f64]) {
        if let Some(transforms) = &self.transforms {
            self.add_whole(transforms, mode, x, memory, y);
        }
        Arch::new().dispatch(Images {
            of: self,
            mode,
            x,
            memory,
            y,
        });
    }

    fn add_whole(
        &self,
        [forward, inverse]: &[Arc<dyn Fft<f64>>; 2],
        mode: usize,
        x: &[Complex<f64>],
        memory: &mut Memory,
        y: &mut [f64],
    ) {
        let (length, width) = (forward.len(), padded(self.rows));
        let inputs = x.len() / self.rows;
        let (slip, force) = memory.waves.split_at_mut(inputs * length);
        for (waves, x) in slip.chunks_exact_mut(length).zip(x.chunks_exact(self.rows)) {
            waves[..self.rows].copy_from_slice(x);
            waves[self.rows..].fill(Complex::default());
        }
        forward.process_with_scratch(slip, &mut memory.scratch);
        for (to, y) in y.chunks_exact_mut(2 * width).enumerate() {
            force.fill(Complex::default());
            let blocks = self.blocks.iter();
            for block in blocks.filter(|at| at.components[0] == to && !at.spectra.is_empty()) {
                let slip = &slip[block.components[1] * length..][..length];
                let spectrum = &block.spectra[mode * length..][..length];
                for ((force, slip), factor) in force.iter_mut().zip(slip).zip(spectrum) {
                    *force += slip * factor;
                }
            }
            inverse.process_with_scratch(force, &mut memory.scratch);
            let (real, imaginary) = y.split_at_mut(width);
            for ((real, imaginary), force) in
                real.iter_mut().zip(imaginary).zip(&force[..self.rows])
            {
                *real += force.re;
                *imaginary += force.im;
            }
        }
    }
}

/// The image parts of the products of a mode.
struct Images<'a> {
    of: &'a Split,
    mode: usize,
    x: &'a [Complex<f64>],
    memory: &'a mut Memory,
    y: &'a mut [f64],
}

impl WithSimd for Images<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let rows = self.of.rows;
        let width = 2 * padded(rows);
        let Memory { parts, pairs, .. } = self.memory;
        for block in &self.of.blocks {
            let [to, from] = block.components;
            let (x, y) = (
                &self.x[from * rows..][..rows],
                &mut self.y[to * width..][..width],
            );
            let memory = (&mut parts[..], &mut pairs[..]);
            if block.odd {
                (block.images).add::<S, true>(simd, self.mode, x, memory, y);
            } else {
                (block.images).add::<S, false>(simd, self.mode, x, memory, y);
            }
        }
    }
}

/// The spectra of differences of rows. That of an odd block, whose numbers stand for their product with the imaginary
/// unit, is imaginary, and its product real again.
fn spectra(forward: &dyn Fft<f64>, differences: &[f64], rows: usize, odd: bool) -> Vec<f64> {
    let length = forward.len();
    let share = (length as f64).recip();
    let mut spectra = Vec::new();
    let mut waves = vec![Complex::default(); length];
    for differences in differences.chunks_exact(2 * rows - 1) {
        waves.fill(Complex::default());
        for (place, &value) in differences.iter().enumerate() {
            waves[(place + length + 1 - rows) % length] = Complex::new(value, 0.0);
        }
        forward.process(&mut waves);
        let real = waves.iter();
        spectra.extend(real.map(|wave| share * if odd { -wave.im } else { wave.re }));
    }
    spectra
}

impl fmt::Debug for Split {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ranks = self.blocks.iter().map(|block| block.images.mean());
        formatter.debug_list().entries(ranks).finish()
    }
}
