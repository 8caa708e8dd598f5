//! Products of one matrix per mode, by SIMD.

use pulp::{Arch, Simd, WithSimd};
use realfft::num_complex::Complex;

/// Receiving rows whose sums are in registers together, with two sources at a time: 8 sums of 4 numbers.
const PANEL: usize = 8;

/// One real matrix of rows per mode, for the spectrum of an even function, or for the spectrum of an odd one divided by
/// the imaginary unit.
#[derive(Debug, Clone)]
pub(crate) struct ModeMatrices {
    /// The receiving and the slipping component.
    pub(crate) components: [usize; 2],
    pub(crate) odd: bool,
    rows: usize,
    /// By mode, panel of receiving rows, slipping row: in the order of the product.
    values: Vec<Panel>,
}

/// The numbers of the receiving rows of a panel, in one line of the cache.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Panel([f64; PANEL]);

/// The rows of an output, filled up to whole panels.
pub(crate) fn padded(rows: usize) -> usize {
    rows.next_multiple_of(PANEL)
}

impl ModeMatrices {
    /// Zeros.
    pub(crate) fn new(components: [usize; 2], odd: bool, modes: usize, rows: usize) -> Self {
        Self {
            components,
            odd,
            rows,
            values: vec![Panel([0.0; PANEL]); modes * (padded(rows) / PANEL) * rows],
        }
    }

    fn place(&self, mode: usize, receiver: usize, source: usize) -> usize {
        let panels = padded(self.rows) / PANEL;
        (mode * panels + receiver / PANEL) * self.rows + source
    }

    pub(crate) fn get(&self, mode: usize, receiver: usize, source: usize) -> f64 {
        self.values[self.place(mode, receiver, source)].0[receiver % PANEL]
    }

    pub(crate) fn set(&mut self, mode: usize, receiver: usize, source: usize, value: f64) {
        let place = self.place(mode, receiver, source);
        self.values[place].0[receiver % PANEL] = value;
    }

    /// The panels of a mode, one after the other.
    fn of_mode(&self, mode: usize) -> &[Panel] {
        let length = padded(self.rows) / PANEL * self.rows;
        &self.values[mode * length..][..length]
    }
}

/// Products of the modes from `first` on. `x` is by mode, then component, then row; `y` by mode, then component, then
/// row up to whole panels, first the real parts of a component, then the imaginary ones.
pub(crate) struct Product<'a> {
    pub(crate) blocks: &'a [ModeMatrices],
    pub(crate) rows: usize,
    pub(crate) first: usize,
    pub(crate) inputs: usize,
    pub(crate) outputs: usize,
    /// Begins with the last mode.
    pub(crate) backwards: bool,
    pub(crate) x: &'a [Complex<f64>],
    pub(crate) y: &'a mut [f64],
}

impl Product<'_> {
    pub(crate) fn run(self) {
        Arch::new().dispatch(self);
    }
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = 2 * padded(self.rows);
        let (of_x, of_y) = (self.inputs * self.rows, self.outputs * width);
        let count = self.x.len() / of_x;
        for n in 0..count {
            let place = if self.backwards { count - 1 - n } else { n };
            let x = &self.x[place * of_x..][..of_x];
            let y = &mut self.y[place * of_y..][..of_y];
            y.fill(0.0);
            for block in self.blocks {
                let [to, from] = block.components;
                let x = &x[from * self.rows..][..self.rows];
                let (real, imaginary) = y[to * width..][..width].split_at_mut(width / 2);
                let outputs = real.chunks_exact_mut(PANEL);
                let outputs = outputs.zip(imaginary.chunks_exact_mut(PANEL));
                let panels = block.of_mode(self.first + place).chunks_exact(self.rows);
                for (panel, (real, imaginary)) in panels.zip(outputs) {
                    if block.odd {
                        add_panel::<S, true>(simd, panel, x, real, imaginary);
                    } else {
                        add_panel::<S, false>(simd, panel, x, real, imaginary);
                    }
                }
            }
        }
    }
}

/// Adds the products of a panel.
#[inline(always)]
fn add_panel<S: Simd, const ODD: bool>(
    simd: S,
    panel: &[Panel],
    x: &[Complex<f64>],
    real: &mut [f64],
    imaginary: &mut [f64],
) {
    let vectors = PANEL / S::F64_LANES;
    let zero = simd.splat_f64s(0.0);
    let mut sums = [[[zero; PANEL]; 2]; 2];
    let add = |sums: &mut [[_; PANEL]; 2], entries: &Panel, x: Complex<f64>| {
        let (entries, _) = S::as_simd_f64s(&entries.0);
        let (re, im) = factors::<ODD>(x);
        let (re, im) = (simd.splat_f64s(re), simd.splat_f64s(im));
        for n in 0..vectors {
            sums[0][n] = simd.mul_add_e_f64s(entries[n], re, sums[0][n]);
            sums[1][n] = simd.mul_add_e_f64s(entries[n], im, sums[1][n]);
        }
    };
    let (pairs, last) = x.as_chunks::<2>();
    let (panel_pairs, panel_last) = panel.as_chunks::<2>();
    for (x, panel) in pairs.iter().zip(panel_pairs) {
        for source in 0..2 {
            add(&mut sums[source], &panel[source], x[source]);
        }
    }
    for (x, panel) in last.iter().zip(panel_last) {
        add(&mut sums[0], panel, *x);
    }
    for (part, y) in [real, imaginary].into_iter().enumerate() {
        let (y, _) = S::as_mut_simd_f64s(y);
        for n in 0..vectors {
            let sum = simd.add_f64s(sums[0][part][n], sums[1][part][n]);
            y[n] = simd.add_f64s(y[n], sum);
        }
    }
}

/// `x`, or `i x`, as its real and imaginary part.
#[inline(always)]
fn factors<const ODD: bool>(x: Complex<f64>) -> (f64, f64) {
    if ODD { (-x.im, x.re) } else { (x.re, x.im) }
}
