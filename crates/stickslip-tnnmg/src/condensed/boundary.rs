//! The condensed problem `min y.Sy/2 - g.y + sum_k phi_k(y_k)` on the frictional vertices: its
//! unknowns, its residual and the sweep over them.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::ConvexPotential;

use crate::block::decouple;

use super::layout::FIXED;
use super::newton::Newton;

/// The fields of the condensed problem; vertices are counted along the boundary.
#[derive(Debug)]
pub(super) struct Boundary<const C: usize> {
    /// The unknown of each component of each vertex, or [`FIXED`].
    pub(super) unknowns: Vec<[u32; C]>,
    /// The vertex and the component of each unknown.
    owners: Vec<(u32, u8)>,
    /// `0, 1, ...`: the vertices, for whoever addresses fields by them.
    pub(super) places: Vec<usize>,
    /// The velocities, fixed components included.
    pub(super) y: Vec<SVector<f64, C>>,
    /// The velocities at the start of an iteration.
    pub(super) start: Vec<SVector<f64, C>>,
    pub(super) direction: Vec<SVector<f64, C>>,
    pub(super) gradients: Vec<SVector<f64, C>>,
    /// The gradients at the end of the direction.
    pub(super) gradients_ahead: Vec<SVector<f64, C>>,
    pub(super) hessians: Vec<SMatrix<f64, C, C>>,
    pub(super) truncated: Vec<[bool; C]>,
    /// `g`.
    pub(super) force: Vec<f64>,
    /// `g - S y`.
    pub(super) residual: Vec<f64>,
    /// Minus the gradient of the energy on the kept unknowns.
    pub(super) descent: Vec<f64>,
    pub(super) correction: Vec<f64>,
    pub(super) newton: Newton,
}

impl<const C: usize> Boundary<C> {
    /// The unknowns are numbered as in the factor, from `first` on; `None` without enough memory.
    pub(super) fn new(positions: impl Iterator<Item = [u32; C]>, first: usize) -> Option<Self> {
        let shift = |p: u32| if p == FIXED { p } else { p - first as u32 };
        let unknowns: Vec<_> = positions.map(|place| place.map(shift)).collect();
        let owners: Vec<(u32, u8)> = (unknowns.iter().enumerate())
            .flat_map(|(k, places)| {
                let free = (0..C).filter(|&c| places[c] != FIXED);
                free.map(move |c| (k as u32, c as u8))
            })
            .collect();
        let (size, count) = (unknowns.len(), owners.len());
        Some(Self {
            places: (0..size).collect(),
            y: vec![SVector::zeros(); size],
            start: vec![SVector::zeros(); size],
            direction: vec![SVector::zeros(); size],
            gradients: vec![SVector::zeros(); size],
            gradients_ahead: vec![SVector::zeros(); size],
            hessians: vec![SMatrix::zeros(); size],
            truncated: vec![[true; C]; size],
            force: vec![0.0; count],
            residual: vec![0.0; count],
            descent: vec![0.0; count],
            correction: vec![0.0; count],
            newton: Newton::new(count)?,
            unknowns,
            owners,
        })
    }

    /// The number of unknowns.
    pub(super) fn count(&self) -> usize {
        self.owners.len()
    }

    /// The vertex and the component of an unknown.
    pub(super) fn owner(&self, unknown: usize) -> (usize, usize) {
        let (k, c) = self.owners[unknown];
        (k as usize, c as usize)
    }

    /// The free components of vertex `k`, with their unknowns.
    pub(super) fn free(&self, k: usize) -> impl Iterator<Item = (usize, usize)> + use<C> {
        let places = self.unknowns[k];
        (0..C).filter_map(move |c| (places[c] != FIXED).then_some((c, places[c] as usize)))
    }

    /// The diagonal block of vertex `k`, with the identity where components are fixed.
    pub(super) fn block(&self, schur: &[f64], k: usize) -> SMatrix<f64, C, C> {
        let count = self.count();
        let mut block = SMatrix::zeros();
        for (r, i) in self.free(k) {
            for (c, j) in self.free(k) {
                block[(r, c)] = schur[j * count + i];
            }
        }
        decouple(&block, &self.unknowns[k].map(|place| place == FIXED))
    }

    /// Computes the residual anew.
    pub(super) fn balance(&mut self, schur: &[f64]) {
        self.residual.copy_from_slice(&self.force);
        for j in 0..self.count() {
            let (k, c) = self.owner(j);
            self.subtract(schur, j, self.y[k][c]);
        }
    }

    /// `residual -= S e_j value`.
    fn subtract(&mut self, schur: &[f64], j: usize, value: f64) {
        if value != 0.0 {
            let column = &schur[j * self.count()..][..self.residual.len()];
            for (residual, entry) in self.residual.iter_mut().zip(column) {
                *residual -= entry * value;
            }
        }
    }

    /// `d . S d` of the direction.
    pub(super) fn energy_square(&self, schur: &[f64]) -> f64 {
        let count = self.count();
        let at = |i: usize| {
            let (k, c) = self.owner(i);
            self.direction[k][c]
        };
        (0..count)
            .filter(|&j| at(j) != 0.0)
            .map(|j| {
                let column = &schur[j * count..][..count];
                let image: f64 = (0..count).map(|i| column[i] * at(i)).sum();
                at(j) * image
            })
            .sum()
    }

    /// Where the energy over vertex `k` alone is minimal.
    pub(super) fn minimizer<P: ConvexPotential<C>>(
        &self,
        schur: &[f64],
        potential: &P,
        k: usize,
    ) -> SVector<f64, C> {
        let block = self.block(schur, k);
        let mut moved = self.y[k];
        let mut force = SVector::zeros();
        for c in (0..C).filter(|&c| self.unknowns[k][c] == FIXED) {
            moved[c] = 0.0;
        }
        let own = block * moved;
        for (c, i) in self.free(k) {
            force[c] = self.residual[i] + own[c];
        }
        let minimizer = potential.minimize(&block, &force);
        SVector::from_fn(|c, _| {
            if self.unknowns[k][c] == FIXED {
                self.y[k][c]
            } else {
                minimizer[c]
            }
        })
    }

    /// Minimises over one vertex after the other.
    pub(super) fn sweep<P: ConvexPotential<C>>(&mut self, schur: &[f64], potentials: &[P]) {
        for (k, potential) in potentials.iter().enumerate() {
            let minimizer = self.minimizer(schur, potential, k);
            let change = minimizer - self.y[k];
            self.y[k] = minimizer;
            for (c, i) in self.free(k) {
                self.subtract(schur, i, change[c]);
            }
        }
    }
}
