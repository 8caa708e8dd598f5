//! The coarser meshes below the one that is solved on, for multigrid.

use std::ffi::c_int;

use nalgebra::SVector;
use stickslip::fem::{Mesh, Prolongation};

use crate::numbering::global_numbers;
use crate::{Error, World};

/// The part of a mesh in a process: positions of its vertices, and their parents on the coarser mesh.
#[derive(Debug)]
pub(crate) struct Level<const D: usize> {
    pub(crate) places: Vec<SVector<f64, D>>,
    /// For each vertex those of the mesh before, with their weights; none on the first mesh that is divided.
    pub(crate) parents: Vec<Vec<(u32, f64)>>,
}

impl<const D: usize> Level<D> {
    /// Of a mesh that was cut out of a refined one, whose vertices `kept` are left.
    pub(crate) fn new(mesh: &Mesh<D>, kept: &[usize], from_before: Option<&Prolongation>) -> Self {
        let parents = from_before.map_or(Vec::new(), |prolongation| {
            let rows = kept.iter().filter_map(|&old| prolongation.outer_view(old));
            rows.map(|row| row.iter().map(|(p, &weight)| (p as u32, weight)).collect())
                .collect()
        });
        Self {
            places: mesh.vertices().to_vec(),
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
