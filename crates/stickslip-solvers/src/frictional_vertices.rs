//! The frictional vertices along a pass through a body.

/// A pass through all vertices in increasing order that meets the frictional ones, which increase, too.
#[derive(Debug, Clone)]
pub(crate) struct FrictionalVertices<'a> {
    vertices: &'a [usize],
    next: usize,
}

impl<'a> FrictionalVertices<'a> {
    /// A pass that begins before the first vertex.
    pub(crate) fn along(vertices: &'a [usize]) -> Self {
        Self { vertices, next: 0 }
    }

    /// The position of `vertex` among the frictional ones, if it is one. Vertices must not decrease from one call to
    /// the next.
    #[inline(always)]
    pub(crate) fn at(&mut self, vertex: usize) -> Option<usize> {
        while self.vertices.get(self.next).is_some_and(|&v| v < vertex) {
            self.next += 1;
        }
        (self.vertices.get(self.next) == Some(&vertex)).then_some(self.next)
    }
}

#[cfg(test)]
mod tests {
    use super::FrictionalVertices;

    #[test]
    fn a_walk_finds_what_a_search_finds() {
        for vertices in [&[][..], &[0], &[4], &[1, 2, 5], &[0, 3, 4, 9]] {
            for stride in 1..4 {
                let mut walk = FrictionalVertices::along(vertices);
                for vertex in (0..8).step_by(stride).flat_map(|vertex| [vertex; 2]) {
                    assert_eq!(walk.at(vertex), vertices.binary_search(&vertex).ok());
                }
            }
        }
    }
}
