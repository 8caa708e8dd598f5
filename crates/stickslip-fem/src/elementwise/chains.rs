//! Chains of cells: each shares a face with the next one.

/// The cells of a chain.
pub(super) const CHAIN: usize = 3;

/// The corners of a cell, by places among the vertices of its group.
pub(super) type Places = [u16; 4];

/// Cells in chains, and those that are left.
///
/// A chain of `d`-dimensional cells has `CHAIN + d` vertices, numbered such that cell `c` has the vertices `c..=c + d`. A vertex of
/// the chain is read and added to once, in place of once a cell.
#[derive(Debug, Default)]
pub(super) struct Chains {
    /// The cells of each chain, and its vertices.
    pub(super) chains: Vec<([u16; CHAIN], [u16; 6])>,
    /// The cells that are in no chain.
    pub(super) singles: Vec<u16>,
}

/// No neighbour.
const NONE: u16 = u16::MAX;

impl Chains {
    /// Chains of cells with `corners` corners each: the next free cell makes the one whose cells have the fewest other free
    /// neighbours, which would be left.
    pub(super) fn of(cells: &[Places], corners: usize) -> Self {
        let neighbours = neighbours(cells, corners);
        let mut free = vec![true; cells.len()];
        let mut found = Self::default();
        for cell in 0..cells.len() as u16 {
            if !free[usize::from(cell)] {
                continue;
            }
            let open = |a: u16| {
                let all = neighbours[usize::from(a)].into_iter();
                all.filter(|&b| b != NONE && free[usize::from(b)])
            };
            let at_end = open(cell).flat_map(|b| {
                let behind = open(b).filter(|&c| c != cell);
                behind.map(move |c| [cell, b, c])
            });
            let amid = open(cell).flat_map(|a| {
                let behind = open(cell).filter(move |&c| c > a);
                behind.map(move |c| [a, cell, c])
            });
            let left = |chain: &[u16; CHAIN]| chain.iter().map(|&a| open(a).count()).sum::<usize>();
            let Some(chain) = at_end.chain(amid).min_by_key(left) else {
                continue;
            };
            for cell in chain {
                free[usize::from(cell)] = false;
            }
            found.chains.push((chain, vertices(chain, cells, corners)));
        }
        found.singles = (0..cells.len() as u16)
            .filter(|&cell| free[usize::from(cell)])
            .collect();
        found
    }
}

/// The vertices of a chain.
fn vertices([first, middle, last]: [u16; CHAIN], cells: &[Places], corners: usize) -> [u16; 6] {
    let of = |cell: u16| &cells[usize::from(cell)][..corners];
    let only = |cell: u16, other: u16| {
        of(cell)
            .iter()
            .copied()
            .filter(move |p| !of(other).contains(p))
    };
    let shared = of(middle)
        .iter()
        .copied()
        .filter(|p| of(first).contains(p) && of(last).contains(p));
    let order = only(first, middle)
        .chain(only(middle, last))
        .chain(shared)
        .chain(only(middle, first))
        .chain(only(last, middle));
    let mut vertices = [0; 6];
    for (vertex, place) in vertices.iter_mut().zip(order) {
        *vertex = place;
    }
    vertices
}

/// The cells behind the faces of each cell, as far as two cells share a face.
fn neighbours(cells: &[Places], corners: usize) -> Vec<[u16; 4]> {
    // Numbers that sort fast: the corners of a face, and the cell.
    let mut faces = Vec::with_capacity(corners * cells.len());
    for (cell, places) in (0..).zip(cells) {
        let mut sorted = *places;
        sorted[..corners].sort_unstable();
        for opposite in 0..corners {
            let face = (0..corners).filter(|&k| k != opposite);
            let face = face.fold(0, |key, k| key << 16 | u64::from(sorted[k]));
            faces.push(face << 16 | cell);
        }
    }
    faces.sort_unstable();
    let mut neighbours = vec![[NONE; 4]; cells.len()];
    for pair in faces.chunk_by(|a, b| a >> 16 == b >> 16) {
        if let &[a, b] = pair {
            let (a, b) = (a as u16, b as u16);
            for (a, b) in [(a, b), (b, a)] {
                let mut all = neighbours[usize::from(a)].iter_mut();
                if let Some(place) = all.find(|place| **place == NONE) {
                    *place = b;
                }
            }
        }
    }
    neighbours
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::P1;
    use crate::elementwise::chains::{Chains, Places};

    /// Some cells of a grid, with corners as places.
    fn some<const D: usize>(cells: [usize; D], chosen: &[bool]) -> Vec<Places> {
        let space = P1::grid([1.0; D], cells).expect("a grid");
        let mesh = space.mesh();
        let cells = (0..mesh.cell_count()).zip(chosen.iter().cycle());
        let cells = cells.filter(|(_, chosen)| **chosen).map(|(cell, _)| {
            let mut places = Places::default();
            for (place, &p) in places.iter_mut().zip(mesh.cell(cell)) {
                *place = p as u16;
            }
            places
        });
        cells.collect()
    }

    /// Each cell is in one chain or by itself, a chain has the corners of its cells, and no chain is left.
    fn check(cells: &[Places], dimension: usize) -> Result<(), TestCaseError> {
        let corners = dimension + 1;
        let found = Chains::of(cells, corners);
        let chained = found.chains.iter().flat_map(|(cells, _)| *cells);
        let mut all: Vec<u16> = chained.chain(found.singles.iter().copied()).collect();
        all.sort_unstable();
        prop_assert!(all.into_iter().eq(0..cells.len() as u16));
        let sorted = |places: &[u16]| {
            let mut places = places.to_vec();
            places.sort_unstable();
            places
        };
        for (chain, vertices) in &found.chains {
            for (c, &cell) in chain.iter().enumerate() {
                let own = &cells[usize::from(cell)][..corners];
                prop_assert_eq!(sorted(&vertices[c..c + corners]), sorted(own));
            }
        }
        let left: Vec<Places> = found
            .singles
            .iter()
            .map(|&cell| cells[usize::from(cell)])
            .collect();
        prop_assert!(Chains::of(&left, corners).chains.is_empty());
        Ok(())
    }

    proptest! {
        #[test]
        fn chains_of_any_cells(chosen in prop::collection::vec(any::<bool>(), 1..200)) {
            check(&some([7, 5], &chosen), 2)?;
            check(&some([4, 3, 3], &chosen), 3)?;
        }
    }

    /// In a grid one cell of twenty at most is in no chain.
    #[test]
    fn most_cells_of_a_grid_are_in_chains() {
        for (cells, dimension) in [(some([40, 40], &[true]), 2), (some([12; 3], &[true]), 3)] {
            let left = Chains::of(&cells, dimension + 1).singles.len();
            assert!(20 * left <= cells.len(), "{left} of {}", cells.len());
        }
    }
}
