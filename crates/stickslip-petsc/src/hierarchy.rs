//! The coarser meshes below the one that is solved on, for multigrid.

use std::ffi::c_int;

use nalgebra::SMatrix;
use stickslip::fem::Prolongation;

use crate::basis::{SharedBasis, add};
use crate::copies::{Labelled, Place};
use crate::numbering::global_numbers;
use crate::{Error, World};

/// The part of a mesh in a process: places of its vertices, and their parents on the coarser mesh.
#[derive(Debug)]
pub(crate) struct Level<const D: usize> {
    pub(crate) places: Vec<Place<D>>,
    /// For each vertex those of the mesh before, with their weights; none on the first mesh that is divided.
    pub(crate) parents: Vec<Vec<(u32, f64)>>,
}

impl<const D: usize> Level<D> {
    /// Of a mesh that was cut out of a refined one, whose vertices `kept` are left.
    pub(crate) fn new(
        mesh: &Labelled<D>,
        kept: &[usize],
        from_before: Option<&Prolongation>,
    ) -> Self {
        let parents = from_before.map_or(Vec::new(), |prolongation| {
            let rows = kept.iter().filter_map(|&old| prolongation.outer_view(old));
            rows.map(|row| row.iter().map(|(p, &weight)| (p as u32, weight)).collect())
                .collect()
        });
        Self {
            places: mesh.places(),
            parents,
        }
    }
}

/// The interpolation to the vertices that a process owns, from those of the next coarser mesh.
#[derive(Debug)]
pub(crate) struct Interpolation {
    /// The coarse vertices of this process by the fine ones at their places, and the global number of the first.
    pub(crate) copies: Vec<c_int>,
    pub(crate) first: usize,
    /// For each fine vertex its share of the two lists below.
    pub(crate) starts: Vec<c_int>,
    /// Global numbers of coarse vertices.
    pub(crate) parents: Vec<c_int>,
    pub(crate) weights: Vec<f64>,
}

/// An interpolation by components, as PETSc takes it.
pub(crate) struct Transfer {
    pub(crate) copies: Vec<c_int>,
    pub(crate) first: usize,
    /// For each component of each fine vertex its share of the two lists below.
    pub(crate) starts: Vec<c_int>,
    /// Global numbers of components of coarse vertices.
    pub(crate) columns: Vec<c_int>,
    pub(crate) weights: Vec<f64>,
}

impl Interpolation {
    /// The interpolation between levels with these bases, the finer one first: `T_f^-1 P T_c`.
    pub(crate) fn by_components<const C: usize>(
        &self,
        bases: Option<[&SharedBasis<C>; 2]>,
    ) -> Transfer {
        let mut transfer = Transfer {
            copies: self.copies.clone(),
            first: self.first,
            starts: vec![0],
            columns: Vec::new(),
            weights: Vec::new(),
        };
        for vertex in 0..self.starts.len() - 1 {
            let row = self.row(vertex, bases);
            for r in 0..C {
                for (parent, block) in &row {
                    for c in (0..C).filter(|&c| block[(r, c)] != 0.0) {
                        transfer.columns.push(C as c_int * parent + c as c_int);
                        transfer.weights.push(block[(r, c)]);
                    }
                }
                transfer.starts.push(transfer.columns.len() as c_int);
            }
        }
        transfer
    }

    /// The parents of a vertex, and their weights.
    fn parents_of(&self, vertex: usize) -> impl Iterator<Item = (c_int, f64)> {
        let range = self.starts[vertex] as usize..self.starts[vertex + 1] as usize;
        let parents = self.parents[range.clone()].iter().copied();
        parents.zip(self.weights[range].iter().copied())
    }

    /// The row of blocks of a vertex.
    fn row<const C: usize>(
        &self,
        vertex: usize,
        bases: Option<[&SharedBasis<C>; 2]>,
    ) -> Vec<(c_int, SMatrix<f64, C, C>)> {
        let weighted = |(parent, weight)| (parent, SMatrix::identity() * weight);
        let Some([fine, coarse]) = bases else {
            return self.parents_of(vertex).map(weighted).collect();
        };
        let mut row: Vec<(c_int, SMatrix<f64, C, C>)> = Vec::new();
        let alone = [(vertex, SMatrix::identity())];
        for (copy, left) in (fine.inverse.get(&vertex)).map_or(&alone[..], |all| all) {
            for (parent, weight) in self.parents_of(*copy) {
                match coarse.row(parent as u64) {
                    None => add(&mut row, parent, left * weight),
                    Some(right) => {
                        for (unknown, right) in right {
                            add(&mut row, *unknown as c_int, left * right * weight);
                        }
                    }
                }
            }
        }
        row
    }
}

/// Interpolations, finest first, below the `owned` vertices of the last level. Who owns a vertex owns it on all levels.
pub(crate) fn interpolations<const D: usize>(
    world: World,
    levels: &[Level<D>],
    mut owned: Vec<u32>,
) -> Result<Vec<Interpolation>, Error> {
    let mut interpolations = Vec::new();
    for pair in levels.windows(2).rev() {
        let [coarse, fine] = pair else { continue };
        let of = |&vertex: &u32| &fine.parents[vertex as usize];
        // A vertex with one parent is at its place.
        let copies = (0..)
            .zip(&owned)
            .filter(|(_, vertex)| of(vertex).len() == 1);
        let (copies, kept): (Vec<c_int>, Vec<u32>) =
            copies.map(|(k, vertex)| (k, of(vertex)[0].0)).unzip();
        let mut wanted: Vec<u32> = owned.iter().flat_map(of).map(|&(p, _)| p).collect();
        wanted.sort_unstable();
        wanted.dedup();
        let (firsts, found) = global_numbers(world, &coarse.places, &kept, &wanted)?;
        let number = |p: &u32| wanted.binary_search(p).map_or(-1, |k| found[k] as c_int);
        let entries = owned.iter().flat_map(of);
        let ends = owned.iter().scan(0, |end, vertex| {
            *end += of(vertex).len() as c_int;
            Some(*end)
        });
        interpolations.push(Interpolation {
            copies,
            first: firsts[world.rank()] as usize,
            starts: std::iter::once(0).chain(ends).collect(),
            parents: entries.clone().map(|(p, _)| number(p)).collect(),
            weights: entries.map(|&(_, weight)| weight).collect(),
        });
        owned = kept;
    }
    Ok(interpolations)
}
