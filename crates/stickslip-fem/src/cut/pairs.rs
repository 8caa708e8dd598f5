//! The two sides of a fault: twin faces, and pairs of coinciding vertices.

use std::collections::HashMap;

use crate::forest::Forest;
use crate::surfaces::sorted;

/// A fault along which a mesh has been split.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cut {
    pub(crate) name: String,
    /// The vertices of both sides, plus and minus, by those of the plus side. The two are one at the edge of the fault
    /// inside the body. No vertex is in two pairs.
    pub(crate) pairs: Vec<[u32; 2]>,
    /// Positions of the twin faces in the boundary, plus and minus, by those of the plus side.
    pub(crate) twins: Vec<[usize; 2]>,
}

/// A vertex of one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Opposite {
    pub(crate) vertex: u32,
    /// Whether the vertex that has this opposite is on the plus side.
    pub(crate) plus: bool,
}

impl Cut {
    /// The opposite of each vertex of both sides.
    pub(crate) fn opposites(&self) -> HashMap<u32, Opposite> {
        let both = self.pairs.iter().flat_map(|&[plus, minus]| {
            let of = |vertex, plus| Opposite { vertex, plus };
            [(minus, of(plus, false)), (plus, of(minus, true))]
        });
        both.collect()
    }

    /// The vertex of the minus side opposite to one of the plus side.
    pub(crate) fn minus(&self, plus: u32) -> u32 {
        let at = self.pairs.partition_point(|pair| pair[0] < plus);
        self.pairs[at][1]
    }

    /// This cut on a mesh of some of the cells, by the new positions of faces and numbers of vertices: the twins that
    /// are left, and their vertices.
    pub(crate) fn restricted<const D: usize>(
        &self,
        boundary: &[[u32; D]],
        place: impl Fn(usize) -> Option<usize>,
        number: impl Fn(u32) -> u32,
    ) -> Self {
        let twins = self.twins.iter();
        let mut twins: Vec<[usize; 2]> = twins
            .filter_map(|&[plus, minus]| Some([place(plus)?, place(minus)?]))
            .collect();
        twins.sort_unstable();
        let mut on_plus: Vec<u32> = twins.iter().flat_map(|twin| boundary[twin[0]]).collect();
        on_plus.sort_unstable();
        let pairs = self.pairs.iter().map(|pair| pair.map(&number));
        let mut pairs: Vec<[u32; 2]> = pairs
            .filter(|pair| on_plus.binary_search(&pair[0]).is_ok())
            .collect();
        pairs.sort_unstable();
        let name = self.name.clone();
        Self { name, pairs, twins }
    }

    /// This cut on a mesh of children: their boundary with the position of each face's parent, and the pairs of
    /// vertices in any order, repeated or not.
    pub(crate) fn inherited<const D: usize>(
        &self,
        boundary: &[[u32; D]],
        parents: impl Iterator<Item = usize>,
        mut pairs: Vec<[u32; 2]>,
    ) -> Self {
        pairs.sort_unstable();
        pairs.dedup();
        let mut cut = Self {
            name: self.name.clone(),
            pairs,
            twins: Vec::new(),
        };
        let mut sides: HashMap<usize, bool> = HashMap::new();
        for &[plus, minus] in &self.twins {
            sides.extend([(plus, true), (minus, false)]);
        }
        // Each child is known by the vertices of its minus side.
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (place, (&face, parent)) in boundary.iter().zip(parents).enumerate() {
            match sides.get(&parent) {
                Some(true) => above.push((sorted(face.map(|p| cut.minus(p))), place)),
                Some(false) => below.push((sorted(face), place)),
                None => {}
            }
        }
        above.sort_unstable();
        below.sort_unstable();
        debug_assert!(above.iter().map(|a| a.0).eq(below.iter().map(|b| b.0)));
        let twins = above.iter().zip(&below);
        cut.twins = twins.map(|(a, b)| [a.1, b.1]).collect();
        cut.twins.sort_unstable();
        cut
    }
}

/// A vertex in two pairs, with their number, if any; pairs are sorted.
pub(crate) fn twice_paired(pairs: &[[u32; 2]]) -> Option<(u32, usize)> {
    // A vertex at the edge is the only one on both sides: it is counted once.
    let mut ends: Vec<u32> = (pairs.iter())
        .flat_map(|&[plus, minus]| [Some(plus), (minus != plus).then_some(minus)])
        .flatten()
        .collect();
    ends.sort_unstable();
    let mut same = ends.chunk_by(|p, q| p == q);
    let twice = same.find(|same| same.len() > 1);
    twice.map(|same| (same[0], same.len()))
}

/// The smallest vertex that coincides with each vertex by pairs, also of several cuts.
pub(crate) fn coinciding(cuts: &[Cut], vertices: usize) -> Vec<u32> {
    let mut forest = Forest::new(vertices);
    for &[plus, minus] in cuts.iter().flat_map(|cut| &cut.pairs) {
        forest.join(plus, minus);
    }
    (0..vertices as u32).map(|p| forest.root(p)).collect()
}
