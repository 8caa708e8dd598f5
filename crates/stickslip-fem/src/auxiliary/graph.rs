//! The adjacency graph of the vertices of a level.

/// The neighbours of every vertex, increasing, without itself.
#[derive(Debug)]
pub(super) struct Graph {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Graph {
    /// The graph of some pairs, which may repeat, also in reverse order.
    pub(super) fn of(size: usize, pairs: impl Iterator<Item = (u32, u32)>) -> Self {
        let mut both: Vec<(u32, u32)> = pairs.flat_map(|(p, q)| [(p, q), (q, p)]).collect();
        both.sort_unstable();
        both.dedup();
        let mut starts = vec![0; size + 1];
        for &(p, _) in &both {
            starts[p as usize + 1] += 1;
        }
        for p in 0..size {
            starts[p + 1] += starts[p];
        }
        Self {
            starts,
            neighbours: both.into_iter().map(|(_, q)| q).collect(),
        }
    }

    /// The number of vertices.
    pub(super) fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// The neighbours of a vertex.
    pub(super) fn around(&self, p: usize) -> &[u32] {
        &self.neighbours[self.starts[p]..self.starts[p + 1]]
    }

    /// The graph of groups of vertices, given the group of each: two are neighbours if a vertex of one is a neighbour
    /// of one of the other. Connected groups of a planar graph have a planar graph.
    pub(super) fn contracted(&self, groups: &[u32], count: usize) -> Self {
        let pairs = (0..self.size()).flat_map(|p| {
            let around = self.around(p).iter();
            around.map(move |&q| (groups[p], groups[q as usize]))
        });
        Self::of(count, pairs.filter(|(a, b)| a < b))
    }
}
