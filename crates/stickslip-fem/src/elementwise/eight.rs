//! Eight chains of cells side by side, in registers of 512 bits.
//!
//! `pulp` has these, too, with a feature that compiles the direct factors for them as well.

use std::arch::x86_64::{
    __m256d, __m512d, _mm256_add_pd, _mm512_castpd256_pd512, _mm512_castpd512_pd256,
    _mm512_extractf64x4_pd, _mm512_insertf64x4, _mm512_permutex2var_pd, _mm512_set_epi64,
    _mm512_setzero_pd, _mm512_unpackhi_pd, _mm512_unpacklo_pd,
};

use fearless_simd::x86::Avx512;
use fearless_simd::{f64x8, kernel, prelude::*};

use super::lanes::{Lanes, Row};

kernel!(
    /// The numbers of two rows.
    #[inline]
    fn both(simd: Avx512, low: __m256d, high: __m256d) -> __m512d {
        _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(low), high)
    }
);

kernel!(
    /// The columns of rows in pairs: row `l` and row `l + 4`.
    #[inline]
    fn columns(simd: Avx512, a: __m512d, b: __m512d, c: __m512d, d: __m512d) -> [__m512d; 3] {
        let (ab, cd) = (_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d));
        let (ab_1, cd_1) = (_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d));
        let even = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
        let odd = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
        [
            _mm512_permutex2var_pd(ab, even, cd),
            _mm512_permutex2var_pd(ab_1, even, cd_1),
            _mm512_permutex2var_pd(ab, odd, cd),
        ]
    }
);

kernel!(
    /// The rows of columns.
    #[inline]
    fn rows(simd: Avx512, x: __m512d, y: __m512d, z: __m512d) -> [[__m256d; 4]; 2] {
        let zero = _mm512_setzero_pd();
        let (a, b) = (_mm512_unpacklo_pd(x, y), _mm512_unpackhi_pd(x, y));
        let (c, d) = (_mm512_unpacklo_pd(z, zero), _mm512_unpackhi_pd(z, zero));
        let even = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
        let odd = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
        let pairs = [
            _mm512_permutex2var_pd(a, even, c),
            _mm512_permutex2var_pd(b, even, d),
            _mm512_permutex2var_pd(a, odd, c),
            _mm512_permutex2var_pd(b, odd, d),
        ];
        [
            pairs.map(|pair| _mm512_castpd512_pd256(pair)),
            pairs.map(|pair| _mm512_extractf64x4_pd::<1>(pair)),
        ]
    }
);

kernel!(
    /// `a + b`.
    #[inline]
    fn add_rows(simd: Avx512, a: __m256d, b: __m256d) -> __m256d {
        _mm256_add_pd(a, b)
    }
);

impl Lanes<2> for Avx512 {
    type Number = f64x8<Self>;

    #[inline(always)]
    fn splat(self, x: f64) -> f64x8<Self> {
        f64x8::splat(self, x)
    }

    #[inline(always)]
    fn load(self, [low, high]: [&Row; 2]) -> f64x8<Self> {
        both(self, *low, *high).simd_into(self)
    }

    #[inline(always)]
    fn add(self, a: f64x8<Self>, b: f64x8<Self>) -> f64x8<Self> {
        a + b
    }

    #[inline(always)]
    fn sub(self, a: f64x8<Self>, b: f64x8<Self>) -> f64x8<Self> {
        a - b
    }

    #[inline(always)]
    fn mul(self, a: f64x8<Self>, b: f64x8<Self>) -> f64x8<Self> {
        a * b
    }

    #[inline(always)]
    fn mul_add(self, a: f64x8<Self>, b: f64x8<Self>, c: f64x8<Self>) -> f64x8<Self> {
        a.mul_add(b, c)
    }

    #[inline(always)]
    fn mul_sub(self, a: f64x8<Self>, b: f64x8<Self>, c: f64x8<Self>) -> f64x8<Self> {
        a.mul_sub(b, c)
    }

    #[inline(always)]
    fn div(self, a: f64x8<Self>, b: f64x8<Self>) -> f64x8<Self> {
        a / b
    }

    #[inline(always)]
    fn abs(self, a: f64x8<Self>) -> f64x8<Self> {
        a.abs()
    }

    #[inline(always)]
    fn columns(self, [low, high]: [[&Row; 4]; 2]) -> [f64x8<Self>; 3] {
        let a = both(self, *low[0], *high[0]);
        let b = both(self, *low[1], *high[1]);
        let c = both(self, *low[2], *high[2]);
        let d = both(self, *low[3], *high[3]);
        let [x, y, z] = columns(self, a, b, c, d);
        [x.simd_into(self), y.simd_into(self), z.simd_into(self)]
    }

    #[inline(always)]
    fn rows(self, [x, y, z]: [f64x8<Self>; 3]) -> [[Row; 4]; 2] {
        rows(self, x.into(), y.into(), z.into())
    }

    #[inline(always)]
    fn add_to(self, sum: &mut Row, row: Row) {
        *sum = add_rows(self, *sum, row);
    }
}
