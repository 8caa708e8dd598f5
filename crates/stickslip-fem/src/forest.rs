//! Disjoint sets of numbers (union-find).

/// Each set is known by its smallest number.
pub(crate) struct Forest(Vec<u32>);

impl Forest {
    /// So many sets of one number each.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The smallest number of the set of `p`.
    pub(crate) fn root(&mut self, p: u32) -> u32 {
        let mut p = p as usize;
        while self.0[p] as usize != p {
            // Path halving.
            self.0[p] = self.0[self.0[p] as usize];
            p = self.0[p] as usize;
        }
        p as u32
    }

    pub(crate) fn join(&mut self, p: u32, q: u32) {
        let (p, q) = (self.root(p), self.root(q));
        self.0[p.max(q) as usize] = p.min(q);
    }
}
