//! The nodes of elements by positions in the list instead of numbers.

use super::contents::Contents;
use super::cursor::Cursor;
use crate::{FileItem, ReadError};

impl Contents {
    /// Replaces the numbers of nodes in all elements by their positions. Each node belongs to an element.
    pub(super) fn resolve(&mut self, cursor: &Cursor<'_>) -> Result<(), ReadError> {
        let places = self.places(cursor)?;
        let mut used = vec![false; self.nodes.len()];
        for block in &mut self.blocks {
            let corners = block.kind.corners();
            for element in &mut block.elements {
                for node in &mut element.nodes[..corners] {
                    let Some(place) = places.get(*node) else {
                        return Err(ReadError::Unknown {
                            item: FileItem::new("node", *node, None),
                            element: element.tag,
                            at: cursor.place(element.offset),
                        });
                    };
                    used[place] = true;
                    *node = place as u64;
                }
            }
        }
        if let Some(node) = self
            .nodes
            .iter()
            .zip(used)
            .find(|(_, used)| !used)
            .map(|(node, _)| node)
        {
            return Err(ReadError::Node {
                node: node.tag,
                requirement: "an element",
                at: cursor.place(node.offset),
            });
        }
        Ok(())
    }

    /// Numbers and positions, sorted.
    fn places(&self, cursor: &Cursor<'_>) -> Result<Places, ReadError> {
        for node in &self.nodes {
            if !node.point.iter().all(|x| x.is_finite()) {
                return Err(ReadError::Node {
                    node: node.tag,
                    requirement: "finite coordinates",
                    at: cursor.place(node.offset),
                });
            }
        }
        let mut sorted: Vec<(u64, usize)> = (self.nodes.iter().enumerate())
            .map(|(place, node)| (node.tag, place))
            .collect();
        sorted.sort_unstable();
        if let Some(same) = sorted.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            let node = &self.nodes[same[1].1];
            return Err(ReadError::Repeated {
                item: FileItem::new("node", node.tag, None),
                at: cursor.place(node.offset),
            });
        }
        Ok(Places(sorted))
    }
}

struct Places(Vec<(u64, usize)>);

impl Places {
    /// The position of a number; found at once if numbers have no gaps, as in Gmsh's files.
    fn get(&self, tag: u64) -> Option<usize> {
        let sorted = &self.0;
        let guess = tag.checked_sub(sorted.first()?.0)?;
        match sorted.get(usize::try_from(guess).ok()?) {
            Some(&(found, place)) if found == tag => Some(place),
            _ => {
                let k = sorted.binary_search_by_key(&tag, |&(tag, _)| tag).ok()?;
                Some(sorted[k].1)
            }
        }
    }
}
