//! The numbers of nodes in a file: by vertices of the mesh and back.

/// The numbers ("tags") of the vertices in the file of a mesh, where they are nodes; one per vertex.
///
/// They belong to the mesh as it was read. The vertices of a refined or restricted mesh have other numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeTags {
    tags: Vec<u64>,
    /// Tags with their vertices, increasing.
    sorted: Vec<(u64, usize)>,
}

impl NodeTags {
    pub(super) fn new(tags: Vec<u64>) -> Self {
        let mut sorted: Vec<(u64, usize)> = (tags.iter().copied().enumerate())
            .map(|(vertex, tag)| (tag, vertex))
            .collect();
        sorted.sort_unstable();
        Self { tags, sorted }
    }

    /// The tag of each vertex.
    pub fn tags(&self) -> &[u64] {
        &self.tags
    }

    /// The vertex of a tag; `None` if there is no such node, or it has no cell.
    pub fn vertex(&self, tag: u64) -> Option<usize> {
        let found = self.sorted.binary_search_by_key(&tag, |&(tag, _)| tag);
        found.ok().map(|k| self.sorted[k].1)
    }
}
