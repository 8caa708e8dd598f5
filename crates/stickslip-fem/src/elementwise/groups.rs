//! Cells in groups that fit into the cache, with the vertices of each group numbered by themselves.

use std::ops::Range;

use nalgebra::SVector;

use super::chains::{CHAIN, Chains, Places};
use super::kernel::Corners;
use super::lanes::{Row, row};
use crate::Mesh;
use crate::numbering::{bounding_box, ranks};

/// The most vertices of a part of the body that makes a group, beside those on its border.
const PART: usize = 2048;

/// The most vertices of a group, borders included: its corners are 16-bit numbers.
const MOST: usize = 1 << 16;

/// The cells of a mesh in groups.
#[derive(Debug)]
pub(super) struct Groups {
    /// The first vertex of each group in `vertices`, and the number of all.
    pub(super) starts: Vec<usize>,
    /// The first row of each group in `cells`, and the number of all.
    pub(super) rows: Vec<usize>,
    /// The first of each group in `chains`, and the number of all.
    pub(super) chained: Vec<usize>,
    /// The number of cells in the last row of each group.
    pub(super) live: Vec<usize>,
    /// The level of local steps of each group, not decreasing.
    pub(super) level: Vec<usize>,
    /// The vertices of the groups, increasing within one.
    pub(super) vertices: Vec<u32>,
    /// Their positions \[m\].
    pub(super) positions: Vec<Row>,
    /// The vertices of chains, by fours.
    pub(super) chains: Vec<Corners<6>>,
    /// The corners of the other cells, by fours; the last four of a group repeat its last cell.
    pub(super) singles: Vec<Corners<4>>,
    /// The corners of a cell.
    corners_of_cell: usize,
    /// The number of each cell among the cells of the mesh, in rows of four: those of the chains of a group, as many rows for four
    /// chains as a chain has cells, and then its other cells.
    pub(super) cells: Vec<[u32; 4]>,
}

impl Groups {
    /// The groups of a mesh, level by level: cells of one part of its vertices, by the first of their corners.
    pub(super) fn of<const D: usize>(mesh: &Mesh<D>, level: impl Fn(u32) -> u8) -> Self {
        let order = parts(mesh.vertices());
        let rank = ranks(&order);
        let first = |cell: u32| {
            let corners = mesh.cell(cell as usize).iter();
            corners.map(|&p| rank[p as usize]).min().unwrap_or_default()
        };
        let part = |cell: u32| first(cell) / PART as u32;
        let mut cells: Vec<((u8, u32), u32)> = (0..mesh.cell_count() as u32)
            .map(|cell| ((level(cell), part(cell)), cell))
            .collect();
        cells.sort_unstable();
        let mut groups = Self {
            starts: vec![0],
            rows: vec![0],
            chained: vec![0],
            live: Vec::new(),
            level: Vec::new(),
            vertices: Vec::new(),
            positions: Vec::new(),
            chains: Vec::with_capacity(cells.len() / (4 * CHAIN)),
            singles: Vec::new(),
            cells: Vec::with_capacity(cells.len().div_ceil(4)),
            corners_of_cell: D + 1,
        };
        let mut places = vec![u32::MAX; mesh.vertex_count()];
        for part in cells.chunk_by(|a, b| a.0 == b.0) {
            let level = usize::from(part[0].0.0);
            let mut cells: Vec<u32> = part.iter().map(|&(_, cell)| cell).collect();
            cells.sort_by_cached_key(|&cell| lowest(mesh, cell));
            // So many cells have at most so many vertices.
            for cells in cells.chunks(MOST / (D + 1)) {
                groups.push(mesh, cells, &mut places);
                groups.level.push(level);
            }
        }
        groups
    }

    /// Adds a group; `places` is memory of one number per vertex.
    fn push<const D: usize>(&mut self, mesh: &Mesh<D>, cells: &[u32], places: &mut [u32]) {
        let begin = self.vertices.len();
        let all = cells.iter().flat_map(|&cell| mesh.cell(cell as usize));
        self.vertices.extend(all);
        self.vertices[begin..].sort_unstable();
        let mut vertices = self.vertices.split_off(begin);
        vertices.dedup();
        for (place, &vertex) in (0..).zip(&vertices) {
            places[vertex as usize] = place;
        }
        let position = |&p: &u32| {
            let x = &mesh.vertices()[p as usize];
            row(std::array::from_fn(|c| if c < D { x[c] } else { 0.0 }))
        };
        self.positions.extend(vertices.iter().map(position));
        self.vertices.extend(vertices);
        let corners: Vec<Places> = cells
            .iter()
            .map(|&cell| {
                let mut corners = Places::default();
                for (corner, &p) in corners.iter_mut().zip(mesh.cell(cell as usize)) {
                    *corner = places[p as usize] as u16;
                }
                corners
            })
            .collect();
        self.push_cells(cells, &corners);
        self.starts.push(self.vertices.len());
    }

    /// Adds the cells of a group with their corners among its vertices.
    fn push_cells(&mut self, cells: &[u32], corners: &[Places]) {
        let found = Chains::of(corners, self.corners_of_cell);
        let number = |cell: u16| cells[usize::from(cell)];
        let (fours, others) = found.chains.as_chunks::<4>();
        for four in fours {
            for c in 0..CHAIN {
                self.cells.push(four.map(|(cells, _)| number(cells[c])));
            }
            let vertices = four.map(|(_, vertices)| vertices);
            self.chains
                .push(std::array::from_fn(|k| vertices.map(|all| all[k])));
        }
        let others = others.iter().flat_map(|(cells, _)| *cells);
        let singles: Vec<u16> = others.chain(found.singles).collect();
        for four in singles.chunks(4) {
            let own: [u16; 4] = std::array::from_fn(|l| four[l.min(four.len() - 1)]);
            self.cells.push(own.map(number));
            let corners = own.map(|cell| corners[usize::from(cell)]);
            self.singles
                .push(std::array::from_fn(|k| corners.map(|all| all[k])));
        }
        self.rows.push(self.cells.len());
        self.chained.push(self.chains.len());
        self.live.push(match singles.len() {
            0 => 4,
            many => (many - 1) % 4 + 1,
        });
    }

    /// The number of groups.
    pub(super) fn count(&self) -> usize {
        self.live.len()
    }

    /// The number of levels of local steps.
    pub(super) fn levels(&self) -> usize {
        self.level.last().map_or(1, |last| last + 1)
    }

    /// The groups from the first to the last level with a weight.
    pub(super) fn with(&self, weights: &[f64]) -> Range<usize> {
        let weighs = |level: &usize| weights.get(*level).is_some_and(|weight| *weight != 0.0);
        let begin = self.level.iter().position(weighs);
        let end = self.level.iter().rposition(weighs);
        begin.zip(end).map_or(0..0, |(begin, end)| begin..end + 1)
    }

    /// The lowest level of the cells of each of so many vertices, 0 of none; empty for a single level.
    pub(super) fn lowest_levels(&self, vertices: usize) -> Vec<u8> {
        if self.levels() == 1 {
            return Vec::new();
        }
        let mut lowest = vec![0; vertices];
        // Levels do not decrease: what is written last is the lowest one.
        for group in (0..self.count()).rev() {
            for &vertex in &self.vertices[self.starts[group]..self.starts[group + 1]] {
                lowest[vertex as usize] = self.level[group] as u8;
            }
        }
        lowest
    }

    /// The rows of the cells in chains of a group, and those of its other cells.
    pub(super) fn rows_of(&self, group: usize) -> [Range<usize>; 2] {
        let (begin, end) = (self.rows[group], self.rows[group + 1]);
        let middle = begin + CHAIN * (self.chained[group + 1] - self.chained[group]);
        [begin..middle, middle..end]
    }

    /// The chains of a group, by fours.
    pub(super) fn chains_of(&self, group: usize) -> &[Corners<6>] {
        &self.chains[self.chained[group]..self.chained[group + 1]]
    }

    /// The other cells of a group, by fours.
    pub(super) fn singles_of(&self, group: usize) -> &[Corners<4>] {
        // Those of all groups before this one are the rows that are of no chain.
        let [before, after] = [group, group + 1].map(|g| self.rows[g] - CHAIN * self.chained[g]);
        &self.singles[before..after]
    }

    /// The group of a row of cells.
    pub(super) fn group_of(&self, row: usize) -> usize {
        self.rows.partition_point(|&first| first <= row) - 1
    }

    /// The corners of the cells of a row, by corner: places among the vertices of the group.
    pub(super) fn corners(&self, group: usize, row: usize) -> &[[u16; 4]] {
        let [chained, others] = self.rows_of(group);
        let all = match row.checked_sub(others.start) {
            Some(single) => &self.singles_of(group)[single][..],
            None => {
                let place = row - chained.start;
                &self.chains[self.chained[group] + place / CHAIN][place % CHAIN..]
            }
        };
        &all[..self.corners_of_cell]
    }

    /// The vertices of a cell.
    pub(super) fn corners_of(
        &self,
        group: usize,
        row: usize,
        cell: usize,
    ) -> impl Iterator<Item = u32> {
        let vertices = &self.vertices[self.starts[group]..self.starts[group + 1]];
        let corners = self.corners(group, row).iter();
        corners.map(move |corner| vertices[usize::from(corner[cell])])
    }

    /// The number of cells in a row: 4 but for the last of a group.
    pub(super) fn live(&self, group: usize, row: usize) -> usize {
        if row + 1 == self.rows[group + 1] {
            self.live[group]
        } else {
            4
        }
    }

    /// The number of cells of a group.
    pub(super) fn cell_count(&self, group: usize) -> usize {
        4 * (self.rows[group + 1] - self.rows[group] - 1) + self.live[group]
    }
}

/// The corners of a cell, increasing: by these neighbours in a group are near each other in memory.
fn lowest<const D: usize>(mesh: &Mesh<D>, cell: u32) -> [u32; 4] {
    let mut corners = [u32::MAX; 4];
    corners[..=D].copy_from_slice(mesh.cell(cell as usize));
    corners.sort_unstable();
    corners
}

/// The vertices in compact parts of [`PART`] vertices, by halving along the longest extent.
fn parts<const D: usize>(points: &[SVector<f64, D>]) -> Vec<u32> {
    fn halve<const D: usize>(points: &[SVector<f64, D>], order: &mut [u32]) {
        if order.len() <= PART {
            return;
        }
        let (low, high) = bounding_box(order.iter().map(|&p| &points[p as usize]));
        let axis = (high - low).imax();
        // Whole parts before the cut.
        let half = (order.len().div_ceil(PART) / 2) * PART;
        let key = |p: u32| points[p as usize][axis];
        order.select_nth_unstable_by(half, |&p, &q| {
            key(p).total_cmp(&key(q)).then_with(|| p.cmp(&q))
        });
        let (before, behind) = order.split_at_mut(half);
        halve(points, before);
        halve(points, behind);
    }
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    halve(points, &mut order);
    order
}
