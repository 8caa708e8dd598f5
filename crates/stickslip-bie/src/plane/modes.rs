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
    /// By mode, panel of receiving rows, slipping row, receiving row in the panel: in the order of the product.
    values: Vec<f64>,
}

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
            values: vec![0.0; modes * padded(rows) * rows],
        }
    }

    fn place(&self, mode: usize, receiver: usize, source: usize) -> usize {
        let panels = padded(self.rows) / PANEL;
        let panel = mode * panels + receiver / PANEL;
        (panel * self.rows + source) * PANEL + receiver % PANEL
    }

    pub(crate) fn get(&self, mode: usize, receiver: usize, source: usize) -> f64 {
        self.values[self.place(mode, receiver, source)]
    }

    pub(crate) fn set(&mut self, mode: usize, receiver: usize, source: usize, value: f64) {
        let place = self.place(mode, receiver, source);
        self.values[place] = value;
    }

    /// The numbers of a mode.
    fn of_mode(&self, mode: usize) -> &[f64] {
        let length = padded(self.rows) * self.rows;
        &self.values[mode * length..][..length]
    }
}

/// Products of the modes from `first` on. `x` is by component, then mode, then row; `y` by component, then mode, then row
/// up to whole panels, first the real parts of a mode, then the imaginary ones. A second component may be empty.
pub(crate) struct Product<'a> {
    pub(crate) blocks: &'a [ModeMatrices],
    pub(crate) rows: usize,
    pub(crate) first: usize,
    pub(crate) x: [&'a [Complex<f64>]; 2],
    pub(crate) y: [&'a mut [f64]; 2],
}

/// The most multiplications of one task, some 40 microseconds of work; and the most that are not worth a call of the
/// threads, which takes some 80 microseconds from outside of them.
#[cfg(feature = "rayon")]
const TASK: [usize; 2] = [1 << 17, 1 << 21];

impl Product<'_> {
    /// In threads, if the feature `rayon` is on: modes are independent, so that bits do not depend on that.
    pub(crate) fn run(self) {
        #[cfg(feature = "rayon")]
        if self.work() > TASK[1] {
            self.run_in_threads();
            return;
        }
        Arch::new().dispatch(self);
    }

    #[cfg(feature = "rayon")]
    fn modes(&self) -> usize {
        self.x[0].len() / self.rows
    }

    #[cfg(feature = "rayon")]
    fn work(&self) -> usize {
        self.modes() * self.blocks.len() * self.rows * padded(self.rows)
    }

    #[cfg(feature = "rayon")]
    fn run_in_threads(self) {
        let modes = self.modes();
        if self.work() <= TASK[0] || modes < 2 {
            Arch::new().dispatch(self);
            return;
        }
        let [begin, end] = self.halves(modes / 2);
        rayon::join(|| begin.run_in_threads(), || end.run_in_threads());
    }

    #[cfg(feature = "rayon")]
    fn halves(self, modes: usize) -> [Self; 2] {
        let (at, width) = (modes * self.rows, 2 * padded(self.rows));
        // The second component may be empty.
        let x = self.x.map(|x| x.split_at(at.min(x.len())));
        let y = self.y.map(|y| {
            let at = (modes * width).min(y.len());
            y.split_at_mut(at)
        });
        let [(y_0, z_0), (y_1, z_1)] = y;
        let begin = Self {
            x: x.map(|(begin, _)| begin),
            y: [y_0, y_1],
            ..self
        };
        let end = Self {
            first: self.first + modes,
            x: x.map(|(_, end)| end),
            y: [z_0, z_1],
            ..self
        };
        [begin, end]
    }
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self {
            blocks,
            rows,
            first,
            x,
            y,
        } = self;
        let width = padded(rows);
        let [y_0, y_1] = y;
        let mut y = [y_0, y_1];
        for y in &mut y {
            y.fill(0.0);
        }
        for block in blocks {
            let [to, from] = block.components;
            let outputs = y[to].chunks_exact_mut(2 * width);
            for (mode, (x, y)) in x[from].chunks_exact(rows).zip(outputs).enumerate() {
                let (real, imaginary) = y.split_at_mut(width);
                let panels = block.of_mode(first + mode).chunks_exact(PANEL * rows);
                let outputs = real.chunks_exact_mut(PANEL);
                let outputs = outputs.zip(imaginary.chunks_exact_mut(PANEL));
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
    panel: &[f64],
    x: &[Complex<f64>],
    real: &mut [f64],
    imaginary: &mut [f64],
) {
    let vectors = PANEL / S::F64_LANES;
    let zero = simd.splat_f64s(0.0);
    let mut sums = [[[zero; PANEL]; 2]; 2];
    let (pairs, last) = x.as_chunks::<2>();
    let (panel_pairs, panel_last) = panel.split_at(2 * PANEL * pairs.len());
    for (x, panel) in pairs.iter().zip(panel_pairs.chunks_exact(2 * PANEL)) {
        let (panel, _) = S::as_simd_f64s(panel);
        for source in 0..2 {
            let (re, im) = factors::<ODD>(x[source]);
            let (re, im) = (simd.splat_f64s(re), simd.splat_f64s(im));
            for n in 0..vectors {
                let entry = panel[source * vectors + n];
                sums[source][0][n] = simd.mul_add_e_f64s(entry, re, sums[source][0][n]);
                sums[source][1][n] = simd.mul_add_e_f64s(entry, im, sums[source][1][n]);
            }
        }
    }
    for (x, panel) in last.iter().zip(panel_last.chunks_exact(PANEL)) {
        let (panel, _) = S::as_simd_f64s(panel);
        let (re, im) = factors::<ODD>(*x);
        let (re, im) = (simd.splat_f64s(re), simd.splat_f64s(im));
        for n in 0..vectors {
            sums[0][0][n] = simd.mul_add_e_f64s(panel[n], re, sums[0][0][n]);
            sums[0][1][n] = simd.mul_add_e_f64s(panel[n], im, sums[0][1][n]);
        }
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
