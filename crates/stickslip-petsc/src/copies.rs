//! Copies of vertices at one place: the sides of faults.

use std::collections::HashMap;

use nalgebra::SVector;
use stickslip::fem::{Mesh, P1, Prolongation};

use crate::Error;

/// The bits of a position, and the label of the copy there: the same in all processes.
pub(crate) type Place<const D: usize> = ([u64; D], u64);

/// A mesh whose vertices at one place have different labels.
///
/// On the coarsest mesh, which all processes have, copies are counted in the order of their numbers, from 0. Refinement
/// gives a vertex on an edge a label that follows from those of its ends: edges that coincide differ in these.
#[derive(Debug, Clone)]
pub(crate) struct Labelled<const D: usize> {
    pub(crate) mesh: Mesh<D>,
    pub(crate) labels: Vec<u64>,
}

impl<const D: usize> Labelled<D> {
    /// Labels the copies of a mesh by their order.
    pub(crate) fn new(mesh: Mesh<D>) -> Self {
        let mut copies: HashMap<[u64; D], u64> = HashMap::new();
        let labels = mesh.vertices().iter().map(|x| {
            let count = copies.entry(key(x)).or_default();
            *count += 1;
            *count - 1
        });
        let labels = labels.collect();
        Self { mesh, labels }
    }

    /// The mesh refined once, and the interpolation to it.
    pub(crate) fn refined(self) -> Result<(Self, Option<Prolongation>), Error> {
        let places = self.places();
        let finer = P1::new(self.mesh).refined(1)?;
        let prolongation = finer.transfers().1.last().cloned();
        let parents = |vertex: usize| prolongation.as_ref()?.outer_view(vertex);
        let labels = (0..finer.vertex_count()).map(|vertex| {
            let row = parents(vertex);
            let parents = row.iter().flat_map(|row| row.indices());
            mixed(parents.map(|&parent| places[parent as usize]))
        });
        let labels = labels.collect();
        let mesh = finer.mesh().clone();
        Ok((Self { mesh, labels }, prolongation))
    }

    /// The cells of which some are kept, and which vertices are left.
    pub(crate) fn restricted(
        &self,
        keep: impl Fn(usize) -> bool,
    ) -> Result<(Self, Vec<usize>), Error> {
        let mesh = self.mesh.restricted(&keep)?;
        let cells = (0..self.mesh.cell_count()).filter(|&cell| keep(cell));
        let corners = cells.flat_map(|cell| self.mesh.cell(cell));
        let mut vertices: Vec<usize> = corners.map(|&p| p as usize).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let labels = vertices.iter().map(|&p| self.labels[p]).collect();
        Ok((Self { mesh, labels }, vertices))
    }

    /// The places of the vertices.
    pub(crate) fn places(&self) -> Vec<Place<D>> {
        let labels = self.labels.iter().copied();
        self.mesh.vertices().iter().map(key).zip(labels).collect()
    }

    /// The vertices at places with several copies, together; none in a mesh that is not split.
    pub(crate) fn copies(&self) -> Vec<Vec<u32>> {
        if self.labels.iter().all(|&label| label == 0) {
            return Vec::new();
        }
        let mut at: HashMap<[u64; D], Vec<u32>> = HashMap::new();
        for (vertex, x) in (0..).zip(self.mesh.vertices()) {
            at.entry(key(x)).or_default().push(vertex);
        }
        at.into_values().filter(|all| all.len() > 1).collect()
    }
}

/// The bits of a position.
pub(crate) fn key<const D: usize>(x: &SVector<f64, D>) -> [u64; D] {
    // Zero has two signs.
    std::array::from_fn(|c| (x[c] + 0.0).to_bits())
}

/// A label by the places of the parents: that of a vertex that stays, 0 between vertices without copies, else a number
/// that no other edge between their positions has, but for one case in 2^64.
fn mixed<const D: usize>(parents: impl Iterator<Item = Place<D>>) -> u64 {
    let mut parents: Vec<Place<D>> = parents.collect();
    parents.sort_unstable();
    match parents[..] {
        [(_, own)] => own,
        _ if parents.iter().all(|&(_, label)| label == 0) => 0,
        _ => word_of(parents.iter().map(|&(_, label)| label)),
    }
}

/// A word of several. Source: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
pub(crate) fn word_of(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0x9e37_79b9_7f4a_7c15, |hash: u64, word| {
        let mut z = (hash ^ word).wrapping_add(0x9e37_79b9_7f4a_7c15);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    })
}
