//! Copies of the vertices of a surface: one for each fan of cells that the surface leaves around it.

use super::sheet::Sheet;
use super::union::Union;
use crate::boundary::face;
use crate::forest::Forest;
use crate::surfaces::sorted;
use crate::{FemError, Mesh};

/// The cells with the copies as corners.
pub(super) struct Fans {
    pub(super) cells: Vec<u32>,
    /// The former vertex of each new one.
    pub(super) copied: Vec<u32>,
    /// The places of the vertices opposite to the faces of the former boundary in the list of cells, for faces at the
    /// surface.
    beside: Vec<Option<usize>>,
}

impl Fans {
    pub(super) fn new<const D: usize>(
        mesh: &Mesh<D>,
        union: &Union<D>,
        sheet: &Sheet,
    ) -> Result<Self, FemError> {
        let mut on = vec![false; mesh.vertex_count()];
        for &p in union.faces.iter().flatten() {
            on[p as usize] = true;
        }
        let touched: Vec<usize> = (mesh.cells().enumerate())
            .filter(|(_, corners)| corners.iter().any(|&p| on[p as usize]))
            .map(|(cell, _)| cell)
            .collect();
        let corners = touched
            .iter()
            .flat_map(|&cell| cell * (D + 1)..(cell + 1) * (D + 1));

        // The elements of the forest are the corners of cells, as places in their list.
        let mut forest = Forest::new(mesh.cells.len());
        let mut faces: Vec<([u32; D], usize)> = (corners.clone())
            .map(|place| (sorted(face(&mesh.cells, place)), place))
            .collect();
        faces.sort_unstable();
        let mut outer = Vec::new();
        for shared in faces.chunk_by(|a, b| a.0 == b.0) {
            match shared {
                [(_, a), (_, b)] if union.faces.binary_search(&shared[0].0).is_err() => {
                    for &p in shared[0].0.iter().filter(|&&p| on[p as usize]) {
                        forest.join(corner::<D>(mesh, *a, p), corner::<D>(mesh, *b, p));
                    }
                }
                [only] => outer.push(*only),
                _ => {}
            }
        }
        let beside: Vec<Option<usize>> = (mesh.boundary.iter())
            .map(|&face| {
                let at = outer.binary_search_by_key(&sorted(face), |&(face, _)| face);
                at.ok().map(|at| outer[at].1)
            })
            .collect();

        // The surface stays closed at its tips, and earlier faults at theirs.
        for &(k, p) in &sheet.tips {
            let [plus, minus] = sheet.sides[k];
            forest.join(corner::<D>(mesh, plus, p), corner::<D>(mesh, minus, p));
        }
        for cut in &mesh.surfaces.cuts {
            for twin in &cut.twins {
                if let [Some(plus), Some(minus)] = twin.map(|place| beside[place]) {
                    let face = mesh.boundary[twin[0]];
                    for p in face
                        .into_iter()
                        .filter(|&p| on[p as usize] && cut.minus(p) == p)
                    {
                        forest.join(corner::<D>(mesh, plus, p), corner::<D>(mesh, minus, p));
                    }
                }
            }
        }

        // The fan of the first minus side keeps the number of the vertex, and fans beside which nothing is split do.
        const NONE: u32 = u32::MAX;
        let mut first = vec![NONE; mesh.vertex_count()];
        let mut split = vec![false; mesh.cells.len()];
        for (face, sides) in union.faces.iter().zip(&sheet.sides) {
            for &p in face {
                let [plus, minus] = sides.map(|side| forest.root(corner::<D>(mesh, side, p)));
                (split[plus as usize], split[minus as usize]) = (true, true);
                first[p as usize] = first[p as usize].min(minus);
            }
        }
        let mut cells = mesh.cells.clone();
        let mut copied = Vec::new();
        let mut numbers = vec![NONE; mesh.cells.len()];
        let mut ordered: Vec<(u32, usize)> = (corners.map(|place| (mesh.cells[place], place)))
            .filter(|&(p, _)| on[p as usize])
            .collect();
        ordered.sort_unstable();
        for (p, place) in ordered {
            let root = forest.root(place as u32) as usize;
            if !split[root] || root == first[p as usize] as usize {
                continue;
            }
            if numbers[root] == NONE {
                let count = mesh.vertex_count() + copied.len() + 1;
                if count >= NONE as usize {
                    return Err(FemError::too_many("vertices", count as u64));
                }
                numbers[root] = (count - 1) as u32;
                copied.push(p);
            }
            cells[place] = numbers[root];
        }
        Ok(Self {
            cells,
            copied,
            beside,
        })
    }

    /// The copy of a face as one of its cells has it, in its order; that cell by the place of its opposite vertex.
    pub(super) fn copy<const D: usize>(
        &self,
        mesh: &Mesh<D>,
        face: [u32; D],
        beside: usize,
    ) -> [u32; D] {
        face.map(|p| self.cells[corner::<D>(mesh, beside, p) as usize])
    }

    /// The copy of a face of the former boundary.
    pub(super) fn copy_of_boundary<const D: usize>(
        &self,
        mesh: &Mesh<D>,
        place: usize,
    ) -> [u32; D] {
        let face = mesh.boundary[place];
        self.beside[place].map_or(face, |beside| self.copy(mesh, face, beside))
    }
}

/// The place of a vertex in the cell to which another place belongs.
fn corner<const D: usize>(mesh: &Mesh<D>, beside: usize, vertex: u32) -> u32 {
    let cell = beside / (D + 1);
    let at = mesh.cell(cell).iter().position(|&p| p == vertex);
    debug_assert!(at.is_some());
    (cell * (D + 1) + at.unwrap_or(0)) as u32
}
