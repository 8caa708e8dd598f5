//! Products and sums of block matrices, compiled here for each number of components.

use nalgebra::{SMatrix, SVector};
use stickslip_core::compiled;

use super::rows::{BlockMatrix, Rows};
use super::sums::{add, on_patterns};
use crate::parts::sum_parts;
use crate::products::{multiply_add, quadratic};
use crate::{Basis, MassMatrix, linked};

compiled! {
    pub(super) fn add_product<C>(
        matrix: &BlockMatrix<C>,
        scale: f64,
        x: &[SVector<f64, C>],
        y: &mut [SVector<f64, C>],
    ) {
        multiply_add(Rows::of(matrix), scale, x, y);
    }

    pub(super) fn square<C>(matrix: &BlockMatrix<C>, x: &[SVector<f64, C>]) -> f64 {
        quadratic(Rows::of(matrix), x)
    }

    pub(super) fn half_norm<C>(matrix: &BlockMatrix<C>, x: &[SVector<f64, C>]) -> f64 {
        let rows = Rows::of(matrix);
        let square = sum_parts(0..x.len(), (), &|part, ()| {
            let mut square = 0.0;
            for i in part {
                let mut sum = SVector::zeros();
                for (j, block) in rows.row(i) {
                    if j >= i {
                        if j == i {
                            sum += block * x[i] * 0.5;
                        }
                        break;
                    }
                    sum += block * x[j];
                }
                square += x[i].dot(&sum);
            }
            square
        });
        if square < 0.0 {
            0.0
        } else {
            (2.0 * square).sqrt()
        }
    }

    pub(super) fn change_basis<C>(matrix: &mut BlockMatrix<C>, basis: &Basis<C>) {
        if !basis.links.is_empty() {
            *matrix = linked::congruent(matrix, &basis.links);
        }
        let frames = &basis.axes;
        let starts: Vec<u32> = matrix.indptr().into_raw_storage().to_vec();
        let columns = matrix.indices().to_vec();
        let values = matrix.data_mut();
        let range = |i: usize| starts[i] as usize..starts[i + 1] as usize;
        for (i, _) in frames.iter() {
            for k in range(i) {
                let j = columns[k] as usize;
                values[k] = frames.block_to_frames((i, j), values[k]);
                if frames.of(j).is_none() {
                    let row = range(j);
                    if let Ok(at) = columns[row.clone()].binary_search(&(i as u32)) {
                        let at = row.start + at;
                        values[at] = frames.block_to_frames((j, i), values[at]);
                    }
                }
            }
        }
    }

    pub(super) fn combination<C>(
        terms: &[(f64, &BlockMatrix<C>)],
        mass: Option<(f64, &MassMatrix<C>)>,
    ) -> BlockMatrix<C> {
        let patterns = terms.iter().map(|(_, term)| Rows::of(term).pattern());
        let mut sum = on_patterns(patterns.chain(mass.map(|(_, mass)| mass.pattern())));
        combine(&mut sum, terms, mass);
        sum
    }

    pub(super) fn combine<C>(
        sum: &mut BlockMatrix<C>,
        terms: &[(f64, &BlockMatrix<C>)],
        mass: Option<(f64, &MassMatrix<C>)>,
    ) {
        sum.data_mut().fill(SMatrix::zeros());
        for (factor, term) in terms {
            add(sum, term, |sum, block| *sum += block * *factor);
        }
        if let Some((factor, mass)) = mass {
            mass.add_to(sum, factor);
        }
    }
}
