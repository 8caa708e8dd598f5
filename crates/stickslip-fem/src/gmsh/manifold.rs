//! Groups of faces are surfaces.

use super::contents::{Element, Node};
use super::cursor::Cursor;
use crate::ReadError;

/// Refuses more than two faces at one node (D = 2) or edge (D = 3).
pub(super) fn manifold(
    group: &str,
    faces: &[&Element],
    nodes: &[Node],
    cursor: &Cursor<'_>,
    dimension: usize,
) -> Result<(), ReadError> {
    let mut rims: Vec<([u64; 2], usize)> = Vec::with_capacity(faces.len() * dimension);
    for (k, face) in faces.iter().enumerate() {
        let corners = &face.nodes[..dimension];
        for (i, &node) in corners.iter().enumerate() {
            let next = corners[(i + 1) % dimension];
            let rim = if dimension == 2 {
                [node, node]
            } else {
                [node.min(next), node.max(next)]
            };
            rims.push((rim, k));
        }
    }
    rims.sort_unstable();
    for meeting in rims.chunk_by(|a, b| a.0 == b.0) {
        if meeting.len() > 2 {
            let last = faces[meeting[meeting.len() - 1].1];
            let mut rim = meeting[0].0.map(|place| nodes[place as usize].tag).to_vec();
            rim.dedup();
            return Err(ReadError::NotManifold {
                group: group.to_owned(),
                elements: meeting.iter().map(|&(_, k)| faces[k].tag).collect(),
                nodes: rim,
                at: cursor.place(last.offset),
            });
        }
    }
    Ok(())
}
