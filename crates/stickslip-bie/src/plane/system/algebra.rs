//! Combinations of the matrices of several planes, and dense matrices.

use std::ops::Range;

use nalgebra::{DMatrix, SMatrix};
use stickslip_solvers::{Matrix, Operator};

use super::coupling::Coupling;
use super::kernel::{OfSurface, SystemKernel};
use crate::plane::terms::Terms;
use crate::{CellKernel, PlaneKernel};

impl<const C: usize> Operator<C> for SystemKernel<C> {
    type Mass = Self;

    fn into_mass(self) -> Self {
        self
    }

    fn combination_with(terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) -> Self {
        let terms = terms.iter().copied().chain(mass);
        let first = terms.clone().next();
        let count = first.map_or(0, |(_, term)| term.planes.len());
        let planes = (0..count).map(|plane| {
            let of_plane = terms.clone();
            PlaneKernel::sum(of_plane.map(move |(factor, term)| (factor, &term.planes[plane])))
        });
        let mut sum = Self::of_planes(planes.collect());
        sum.mesh = first.and_then(|(_, term)| term.mesh);
        let surfaces = Self::surfaces(terms.clone());
        if surfaces.clone().next().is_some() {
            let mut between = Terms::none();
            between.set_sum(
                surfaces
                    .clone()
                    .map(|(factor, term)| (factor, &term.between)),
            );
            let own = CellKernel::sum(surfaces.map(|(factor, term)| (factor, &term.own)));
            sum.surface = Some(OfSurface { own, between });
        }
        (sum.terms).set_sum(terms.map(|(factor, term)| (factor, &term.terms)));
        sum
    }

    fn set_combination_with(&mut self, terms: &[(f64, &Self)], mass: Option<(f64, &Self)>) {
        let terms = terms.iter().copied().chain(mass);
        for (plane, own) in self.planes.iter_mut().enumerate() {
            let of_plane = terms.clone();
            own.set_sum(of_plane.map(|(factor, term)| (factor, &term.planes[plane])));
        }
        if let Some(OfSurface { own, between }) = &mut self.surface {
            let surfaces = Self::surfaces(terms.clone());
            between.set_sum(
                surfaces
                    .clone()
                    .map(|(factor, term)| (factor, &term.between)),
            );
            own.set_sum(surfaces.map(|(factor, term)| (factor, &term.own)));
        }
        (self.terms).set_sum(terms.map(|(factor, term)| (factor, &term.terms)));
    }

    fn add_to_diagonal(&mut self, i: usize, block: &SMatrix<f64, C, C>) {
        let [plane, cell] = self.plane_and_cell(i);
        match (self.planes.get_mut(plane), &mut self.surface) {
            (Some(plane), _) => plane.add_to_diagonal(cell, block),
            (None, Some(surface)) => surface.own.add_to_diagonal(cell, block),
            (None, None) => {}
        }
    }
}

/// Row and column `C i + c` belong to component `c` of vertex `i`.
impl<const C: usize> From<&SystemKernel<C>> for DMatrix<f64> {
    fn from(kernel: &SystemKernel<C>) -> Self {
        let count = kernel.vertex_count();
        let mut dense = Self::zeros(C * count, C * count);
        for (vertices, plane) in kernel.planes() {
            let (first, size) = (C * vertices.start, C * vertices.len());
            let mut own = dense.view_mut((first, first), (size, size));
            own.copy_from(&Self::from(plane));
        }
        let first = kernel.vertices_of_planes();
        let pairs = |rows: Range<usize>, columns: Range<usize>| {
            rows.flat_map(move |i| columns.clone().map(move |j| (i, j)))
        };
        let mut add = |i: usize, j: usize, value: SMatrix<f64, C, C>| {
            let mut block = dense.fixed_view_mut::<C, C>(C * i, C * j);
            block += value;
        };
        for term in kernel.terms.iter() {
            for (i, j) in pairs(0..first, 0..first) {
                add(i, j, term.interaction.entry(i, j) * term.factor);
            }
        }
        if let Some(OfSurface { own, between }) = &kernel.surface {
            for (i, j) in pairs(first..count, first..count) {
                add(i, j, own.block(i - first, j - first));
            }
            for term in between.iter() {
                for (i, j) in pairs(0..first, first..count) {
                    let Coupling {
                        on_planes,
                        on_surface,
                    } = &*term.interaction;
                    add(i, j, on_planes.force(i, j - first) * term.factor);
                    add(j, i, on_surface.force(j - first, i) * term.factor);
                }
            }
        }
        dense
    }
}
