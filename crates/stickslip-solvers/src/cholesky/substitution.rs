//! The two triangular solves with the interior columns of the factor.
//!
//! Each reads every entry of the factor once and dominates the cost of a solve.

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

use pulp::{Arch, Simd, WithSimd};

#[cfg(feature = "condensed")]
use crate::several_vectors::Row;
use crate::simd::{product, products, subtract};

/// Columns per pass over the entries below them.
const WIDTH: usize = 4;

/// The interior columns of a supernodal factor.
pub(crate) struct Interior<'a> {
    pub(crate) symbolic: &'a SymbolicSupernodalCholesky<usize>,
    pub(crate) factor: &'a [f64],
    /// The number of interior columns.
    pub(crate) columns: usize,
}

/// The longest column of a supernode: the length of `work` in the functions below.
pub(crate) fn tallest(symbolic: &SymbolicSupernodalCholesky<usize>) -> usize {
    (0..symbolic.n_supernodes())
        .map(|s| height(symbolic, s))
        .max()
        .unwrap_or(0)
}

fn height(symbolic: &SymbolicSupernodalCholesky<usize>, s: usize) -> usize {
    let own = symbolic.supernode_end()[s] - symbolic.supernode_begin()[s];
    own + symbolic.supernode(s).pattern().len()
}

/// The interior columns of one supernode.
pub(crate) struct Panel<'a> {
    begin: usize,
    /// The contiguous rows.
    own: usize,
    /// The other rows.
    below: &'a [usize],
    height: usize,
    /// The interior columns.
    pub(super) columns: usize,
    entries: &'a [f64],
}

impl<'a> Interior<'a> {
    fn panel(&self, s: usize) -> Panel<'a> {
        let begin = self.symbolic.supernode_begin()[s];
        let own = self.symbolic.supernode_end()[s] - begin;
        let below = self.symbolic.supernode(s).pattern();
        let height = own + below.len();
        let columns = own.min(self.columns - begin);
        Panel {
            begin,
            own,
            below,
            height,
            columns,
            entries: &self.factor[self.symbolic.col_ptr_for_val()[s]..][..columns * height],
        }
    }

    /// The number of supernodes with interior columns.
    fn panels(&self) -> usize {
        let begins = self.symbolic.supernode_begin();
        begins.partition_point(|&begin| begin < self.columns)
    }

    // Not generic: compiled here, and not again wherever they are called.

    /// `x_I <- L11^-1 x_I`, then `x_F <- x_F - L21 x_I`.
    pub(crate) fn forward(&self, x: &mut [f64], work: &mut [f64]) {
        self.pass_forward(x, work);
    }

    /// `x_I <- L11^-T (x_I - L21^T x_F)`.
    pub(crate) fn backward(&self, x: &mut [f64], work: &mut [f64]) {
        self.pass_backward(x, work);
    }

    /// [`forward`](Self::forward) for several right-hand sides.
    #[cfg(feature = "condensed")]
    pub(crate) fn forward_abreast(&self, x: &mut [Row], work: &mut [Row]) {
        self.pass_forward(x, work);
    }

    /// [`backward`](Self::backward) for several right-hand sides.
    #[cfg(feature = "condensed")]
    pub(crate) fn backward_abreast(&self, x: &mut [Row], work: &mut [Row]) {
        self.pass_backward(x, work);
    }

    fn pass_forward<T: Entry>(&self, x: &mut [T], work: &mut [T]) {
        Arch::new().dispatch(Forward {
            factor: self,
            x,
            work,
        });
    }

    fn pass_backward<T: Entry>(&self, x: &mut [T], work: &mut [T]) {
        Arch::new().dispatch(Backward {
            factor: self,
            x,
            work,
        });
    }
}

/// A row of the right-hand sides: a number, or one number per right-hand side.
pub(super) trait Entry: Copy {
    const ZERO: Self;

    fn add(&mut self, other: Self);

    /// `x <- L^-1 x` with the columns of a supernode on their own rows; updates the rows below.
    fn forward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [Self]);

    /// The transpose of [`forward`](Self::forward).
    fn backward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [Self]);
}

struct Forward<'a, T> {
    factor: &'a Interior<'a>,
    x: &'a mut [T],
    work: &'a mut [T],
}

impl<T: Entry> WithSimd for Forward<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factor, x, work } = self;
        for s in 0..factor.panels() {
            let panel = factor.panel(s);
            let work = &mut work[..panel.height];
            let own = &mut x[panel.begin..][..panel.own];
            work[..panel.own].copy_from_slice(own);
            work[panel.own..].fill(T::ZERO);
            T::forward(simd, &panel, work);
            own.copy_from_slice(&work[..panel.own]);
            for (&row, &value) in panel.below.iter().zip(&work[panel.own..]) {
                x[row].add(value);
            }
        }
    }
}

struct Backward<'a, T> {
    factor: &'a Interior<'a>,
    x: &'a mut [T],
    work: &'a mut [T],
}

impl<T: Entry> WithSimd for Backward<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { factor, x, work } = self;
        for s in (0..factor.panels()).rev() {
            let panel = factor.panel(s);
            let work = &mut work[..panel.height];
            work[..panel.own].copy_from_slice(&x[panel.begin..][..panel.own]);
            for (value, &row) in work[panel.own..].iter_mut().zip(panel.below) {
                *value = x[row];
            }
            T::backward(simd, &panel, work);
            x[panel.begin..][..panel.columns].copy_from_slice(&work[..panel.columns]);
        }
    }
}

impl Panel<'_> {
    #[inline(always)]
    pub(super) fn column(&self, j: usize) -> &[f64] {
        &self.entries[j * self.height..][..self.height]
    }
}

impl Entry for f64 {
    const ZERO: f64 = 0.0;

    #[inline(always)]
    fn add(&mut self, other: f64) {
        *self += other;
    }

    #[inline(always)]
    fn forward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [f64]) {
        let mut j = 0;
        while j + WIDTH <= panel.columns {
            let columns: [&[f64]; WIDTH] = std::array::from_fn(|k| panel.column(j + k));
            for k in 0..WIDTH {
                x[j + k] /= columns[k][j + k];
                for i in k + 1..WIDTH {
                    x[j + i] -= columns[k][j + i] * x[j + k];
                }
            }
            let known: [f64; WIDTH] = std::array::from_fn(|k| x[j + k]);
            let below = columns.map(|column| &column[j + WIDTH..]);
            subtract(simd, below, known, &mut x[j + WIDTH..]);
            j += WIDTH;
        }
        for j in j..panel.columns {
            let column = panel.column(j);
            x[j] /= column[j];
            let known = x[j];
            subtract(simd, [&column[j + 1..]], [known], &mut x[j + 1..]);
        }
    }

    #[inline(always)]
    fn backward<S: Simd>(simd: S, panel: &Panel<'_>, x: &mut [f64]) {
        let whole = panel.columns - panel.columns % WIDTH;
        for j in (whole..panel.columns).rev() {
            let column = panel.column(j);
            let sum = product(simd, &column[j + 1..], &x[j + 1..]);
            x[j] = (x[j] - sum) / column[j];
        }
        for j in (0..whole).step_by(WIDTH).rev() {
            let columns: [&[f64]; WIDTH] = std::array::from_fn(|k| panel.column(j + k));
            let below = columns.map(|column| &column[j + WIDTH..]);
            let sums = products(simd, below, &x[j + WIDTH..]);
            for k in (0..WIDTH).rev() {
                let mut value = x[j + k] - sums[k];
                for i in k + 1..WIDTH {
                    value -= columns[k][j + i] * x[j + i];
                }
                x[j + k] = value / columns[k][j + k];
            }
        }
    }
}
