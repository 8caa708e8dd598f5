//! Passes over all vertices, one slab after the other.

use std::ops::Range;

use nalgebra::SVector;

use super::{Inverses, Sweep};
use crate::block_matrix::Rows;
use crate::frictional_vertices::FrictionalVertices;
use crate::{BlockMatrix, Energy};

/// The fields that a sweep updates, from vertex `first` on.
pub(super) struct Part<'a, const C: usize> {
    pub(super) first: usize,
    pub(super) v: &'a mut [SVector<f64, C>],
    pub(super) moved: &'a mut [SVector<f64, C>],
}

impl<const C: usize> Sweep<C> {
    /// One pass over all vertices, in the order of the slabs; the energy does not grow. `moved` becomes the values
    /// before minus those after.
    pub(crate) fn forward(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        slabs.for_wide((&mut *v, &mut *moved), |k, first, (v, moved)| {
            let part = Part { first, v, moved };
            self.pass((energy, inverses), slabs.wide(k), part, |_, _| ());
        });
        if slabs.is_whole() {
            return;
        }
        slabs.for_narrow((v, moved), |k, first, (v, moved)| {
            let part = Part { first, v, moved };
            self.pass((energy, inverses), slabs.narrow(k), part, |_, _| ());
        });
    }

    /// [`forward`](Self::forward) in the reverse order: from the last vertex to the first.
    pub(crate) fn backward(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        v: &mut [SVector<f64, C>],
        moved: &mut [SVector<f64, C>],
    ) {
        let slabs = &self.slabs;
        if !slabs.is_whole() {
            slabs.for_narrow((&mut *v, &mut *moved), |k, first, (v, moved)| {
                self.pass_back(
                    (energy, inverses),
                    slabs.narrow(k),
                    Part { first, v, moved },
                );
            });
        }
        slabs.for_wide((v, moved), |k, first, (v, moved)| {
            self.pass_back((energy, inverses), slabs.wide(k), Part { first, v, moved });
        });
    }

    /// One pass over some rows; `then` is called after each row with its change.
    #[inline(always)]
    pub(super) fn pass<'a>(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        range: Range<usize>,
        part: Part<'a, C>,
        mut then: impl FnMut(usize, &[SVector<f64, C>]),
    ) -> &'a [SVector<f64, C>] {
        let Part { first, v, moved } = part;
        let rows = Rows::of(energy.operator);
        let begin = (energy.vertices).partition_point(|&vertex| vertex < range.start);
        let mut frictional = FrictionalVertices::along(&energy.vertices[begin..]);
        for i in range {
            let position = frictional.at(i).map(|position| begin + position);
            let new = self.renewed((energy, inverses), &rows, (i, position), first, v);
            moved[i - first] = v[i - first] - new;
            v[i - first] = new;
            then(i, moved);
        }
        moved
    }

    /// One pass over some rows from the last to the first.
    fn pass_back(
        &self,
        (energy, inverses): (&Energy<'_, BlockMatrix<C>, C>, Inverses<'_, C>),
        range: Range<usize>,
        Part { first, v, moved }: Part<'_, C>,
    ) {
        let rows = Rows::of(energy.operator);
        for i in range.rev() {
            let position = energy.vertices.binary_search(&i).ok();
            let new = self.renewed((energy, inverses), &rows, (i, position), first, v);
            moved[i - first] = v[i - first] - new;
            v[i - first] = new;
        }
    }
}
