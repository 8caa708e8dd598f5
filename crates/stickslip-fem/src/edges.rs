//! The edges of a mesh: for each vertex its neighbours of larger index.

use crate::Mesh;

/// Edge number k joins a vertex to `upper[k]`; edges are sorted by their smaller, then larger vertex.
pub(crate) struct Edges {
    offsets: Vec<usize>,
    upper: Vec<u32>,
}

impl Edges {
    /// Buckets by smaller vertex, each sorted without repetitions: linear in the number of cells.
    pub(crate) fn of<const D: usize>(mesh: &Mesh<D>) -> Self {
        let mut offsets = vec![0; mesh.vertex_count() + 1];
        for_each_edge(mesh, |low, _| offsets[low + 1] += 1);
        for p in 1..offsets.len() {
            offsets[p] += offsets[p - 1];
        }
        let mut upper = vec![0; offsets[mesh.vertex_count()]];
        let mut next = offsets.clone();
        for_each_edge(mesh, |low, high| {
            upper[next[low]] = high;
            next[low] += 1;
        });
        let mut kept = 0;
        let mut start = 0;
        for p in 0..mesh.vertex_count() {
            let end = offsets[p + 1];
            upper[start..end].sort_unstable();
            offsets[p] = kept;
            for k in start..end {
                if k == start || upper[k] != upper[k - 1] {
                    // kept <= k: nothing still to be compared is overwritten.
                    upper[kept] = upper[k];
                    kept += 1;
                }
            }
            start = end;
        }
        offsets[mesh.vertex_count()] = kept;
        upper.truncate(kept);
        Self { offsets, upper }
    }

    pub(crate) fn count(&self) -> usize {
        self.upper.len()
    }

    /// The neighbours of p of larger index, sorted.
    pub(crate) fn above(&self, p: usize) -> &[u32] {
        &self.upper[self.offsets[p]..self.offsets[p + 1]]
    }

    /// The number of the edge between p and q, which must exist.
    pub(crate) fn find(&self, p: u32, q: u32) -> usize {
        let (low, high) = (p.min(q), p.max(q));
        self.offsets[low as usize] + self.above(low as usize).partition_point(|&r| r < high)
    }

    /// All edges as (smaller, larger) vertex, in the order of their numbers.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (u32, u32)> {
        (0..self.offsets.len() as u32 - 1)
            .flat_map(|p| self.above(p as usize).iter().map(move |&q| (p, q)))
    }
}

fn for_each_edge<const D: usize>(mesh: &Mesh<D>, mut visit: impl FnMut(usize, u32)) {
    for cell in mesh.cells() {
        for (i, &p) in cell.iter().enumerate() {
            for &q in &cell[i + 1..] {
                visit(p.min(q) as usize, p.max(q));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GridDiagonal;

    #[test]
    fn edges_are_unique_sorted_and_found() {
        let mesh = Mesh::<2>::grid([3.0, 2.0], [3, 2], GridDiagonal::Rising).expect("valid grid");
        let edges = Edges::of(&mesh);
        // Euler: vertices - edges + triangles = 1.
        assert_eq!(edges.count(), mesh.vertex_count() + mesh.cell_count() - 1);
        let list: Vec<_> = edges.iter().collect();
        assert!(list.windows(2).all(|pair| pair[0] < pair[1]));
        for (k, &(p, q)) in list.iter().enumerate() {
            assert_eq!((edges.find(p, q), edges.find(q, p)), (k, k));
        }
    }
}
