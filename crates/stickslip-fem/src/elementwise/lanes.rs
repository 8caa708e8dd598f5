//! Four cells side by side: arithmetic on one number each, and rows of numbers turned into columns.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::__m256d;

#[cfg(target_arch = "x86_64")]
use pulp::x86::V3;

/// Four numbers in memory, such as the vector of a vertex filled up with zeros: aligned as registers are, and moved as one.
#[cfg(target_arch = "x86_64")]
pub(super) type Row = __m256d;
#[cfg(not(target_arch = "x86_64"))]
pub(super) type Row = Numbers;

/// Four numbers.
pub(super) type Numbers = [f64; 4];

/// Numbers as a row.
#[inline(always)]
pub(super) fn row(numbers: Numbers) -> Row {
    pulp::cast(numbers)
}

/// A row as numbers.
#[inline(always)]
pub(super) fn numbers(row: Row) -> Numbers {
    pulp::cast(row)
}

/// Registers of `F` times four numbers.
pub(super) trait Lanes<const F: usize>: Copy {
    /// One number per cell.
    type Number: Copy;

    /// A number for all cells.
    fn splat(self, x: f64) -> Self::Number;
    /// The numbers of rows.
    fn load(self, x: [&Row; F]) -> Self::Number;
    /// `a + b`.
    fn add(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `a - b`.
    fn sub(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `a b`.
    fn mul(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `a b + c`.
    fn mul_add(self, a: Self::Number, b: Self::Number, c: Self::Number) -> Self::Number;
    /// `a b - c`.
    fn mul_sub(self, a: Self::Number, b: Self::Number, c: Self::Number) -> Self::Number;
    /// `a / b`.
    fn div(self, a: Self::Number, b: Self::Number) -> Self::Number;
    /// `|a|`.
    fn abs(self, a: Self::Number) -> Self::Number;
    /// The first three columns of rows.
    fn columns(self, rows: [[&Row; 4]; F]) -> [Self::Number; 3];
    /// The rows of three columns, and zero behind them.
    fn rows(self, columns: [Self::Number; 3]) -> [[Row; 4]; F];
    /// `sum += row`.
    fn add_to(self, sum: &mut Row, row: Row);
}

/// Arrays, on any processor. Nothing is fused.
#[derive(Clone, Copy)]
pub(super) struct Arrays;

#[inline(always)]
fn each(f: impl Fn(usize) -> f64) -> Numbers {
    [f(0), f(1), f(2), f(3)]
}

impl Lanes<1> for Arrays {
    type Number = Numbers;

    #[inline(always)]
    fn splat(self, x: f64) -> Numbers {
        [x; 4]
    }

    #[inline(always)]
    fn load(self, [x]: [&Row; 1]) -> Numbers {
        numbers(*x)
    }

    #[inline(always)]
    fn add(self, a: Numbers, b: Numbers) -> Numbers {
        each(|l| a[l] + b[l])
    }

    #[inline(always)]
    fn sub(self, a: Numbers, b: Numbers) -> Numbers {
        each(|l| a[l] - b[l])
    }

    #[inline(always)]
    fn mul(self, a: Numbers, b: Numbers) -> Numbers {
        each(|l| a[l] * b[l])
    }

    #[inline(always)]
    fn mul_add(self, a: Numbers, b: Numbers, c: Numbers) -> Numbers {
        each(|l| a[l] * b[l] + c[l])
    }

    #[inline(always)]
    fn mul_sub(self, a: Numbers, b: Numbers, c: Numbers) -> Numbers {
        each(|l| a[l] * b[l] - c[l])
    }

    #[inline(always)]
    fn div(self, a: Numbers, b: Numbers) -> Numbers {
        each(|l| a[l] / b[l])
    }

    #[inline(always)]
    fn abs(self, a: Numbers) -> Numbers {
        each(|l| a[l].abs())
    }

    #[inline(always)]
    fn columns(self, [rows]: [[&Row; 4]; 1]) -> [Numbers; 3] {
        let rows = rows.map(|row| numbers(*row));
        [0, 1, 2].map(|c| each(|l| rows[l][c]))
    }

    #[inline(always)]
    fn rows(self, columns: [Numbers; 3]) -> [[Row; 4]; 1] {
        [[0, 1, 2, 3].map(|l| row([columns[0][l], columns[1][l], columns[2][l], 0.0]))]
    }

    #[inline(always)]
    fn add_to(self, sum: &mut Row, added: Row) {
        *sum = row(self.add(numbers(*sum), numbers(added)));
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes<1> for V3 {
    type Number = __m256d;

    #[inline(always)]
    fn splat(self, x: f64) -> __m256d {
        self.avx._mm256_set1_pd(x)
    }

    #[inline(always)]
    fn load(self, [x]: [&Row; 1]) -> __m256d {
        *x
    }

    #[inline(always)]
    fn add(self, a: __m256d, b: __m256d) -> __m256d {
        self.avx._mm256_add_pd(a, b)
    }

    #[inline(always)]
    fn sub(self, a: __m256d, b: __m256d) -> __m256d {
        self.avx._mm256_sub_pd(a, b)
    }

    #[inline(always)]
    fn mul(self, a: __m256d, b: __m256d) -> __m256d {
        self.avx._mm256_mul_pd(a, b)
    }

    #[inline(always)]
    fn mul_add(self, a: __m256d, b: __m256d, c: __m256d) -> __m256d {
        self.fma._mm256_fmadd_pd(a, b, c)
    }

    #[inline(always)]
    fn mul_sub(self, a: __m256d, b: __m256d, c: __m256d) -> __m256d {
        self.fma._mm256_fmsub_pd(a, b, c)
    }

    #[inline(always)]
    fn div(self, a: __m256d, b: __m256d) -> __m256d {
        self.avx._mm256_div_pd(a, b)
    }

    #[inline(always)]
    fn abs(self, a: __m256d) -> __m256d {
        self.avx._mm256_andnot_pd(self.splat(-0.0), a)
    }

    #[inline(always)]
    fn columns(self, [[a, b, c, d]]: [[&Row; 4]; 1]) -> [__m256d; 3] {
        let (a, b, c, d) = (*a, *b, *c, *d);
        let avx = self.avx;
        let (ab, cd) = (avx._mm256_unpacklo_pd(a, b), avx._mm256_unpacklo_pd(c, d));
        let (ab_1, cd_1) = (avx._mm256_unpackhi_pd(a, b), avx._mm256_unpackhi_pd(c, d));
        [
            avx._mm256_permute2f128_pd::<0x20>(ab, cd),
            avx._mm256_permute2f128_pd::<0x20>(ab_1, cd_1),
            avx._mm256_permute2f128_pd::<0x31>(ab, cd),
        ]
    }

    #[inline(always)]
    fn rows(self, [x, y, z]: [__m256d; 3]) -> [[Row; 4]; 1] {
        let (avx, zero) = (self.avx, self.splat(0.0));
        let (a, b) = (avx._mm256_unpacklo_pd(x, y), avx._mm256_unpackhi_pd(x, y));
        let (c, d) = (
            avx._mm256_unpacklo_pd(z, zero),
            avx._mm256_unpackhi_pd(z, zero),
        );
        [[
            avx._mm256_permute2f128_pd::<0x20>(a, c),
            avx._mm256_permute2f128_pd::<0x20>(b, d),
            avx._mm256_permute2f128_pd::<0x31>(a, c),
            avx._mm256_permute2f128_pd::<0x31>(b, d),
        ]]
    }

    #[inline(always)]
    fn add_to(self, sum: &mut Row, row: Row) {
        *sum = self.add(*sum, row);
    }
}
