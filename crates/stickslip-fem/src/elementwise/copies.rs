//! The copies of a vertex in groups, and its cells.

use std::ops::Range;

use super::groups::Groups;

/// Lists of numbers, one list a vertex.
#[derive(Debug)]
struct Lists {
    starts: Vec<u32>,
    numbers: Vec<u32>,
}

impl Lists {
    /// Lists of the pairs that `all` hands to its argument, in their order: a vertex and a number of its list.
    fn of(vertices: usize, all: impl Fn(&mut dyn FnMut(u32, u32))) -> Self {
        let mut starts = vec![0; vertices + 1];
        all(&mut |vertex, _| starts[vertex as usize + 1] += 1);
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut numbers = vec![0; starts[vertices] as usize];
        all(&mut |vertex, number| {
            let place = &mut next[vertex as usize];
            numbers[*place as usize] = number;
            *place += 1;
        });
        Self { starts, numbers }
    }

    #[inline(always)]
    fn at(&self, vertex: usize) -> &[u32] {
        &self.numbers[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

/// The places of each vertex.
#[derive(Debug)]
pub(super) struct Copies {
    /// In the vertices of the groups.
    groups: Lists,
    /// In the cells: four times the number of the row, and the number of the cell in it.
    cells: Lists,
}

impl Copies {
    pub(super) fn of(groups: &Groups, vertices: usize) -> Self {
        Self {
            groups: Lists::of(vertices, |add| {
                for (place, &vertex) in (0..).zip(&groups.vertices) {
                    add(vertex, place);
                }
            }),
            cells: Lists::of(vertices, |add| {
                for group in 0..groups.count() {
                    for row in groups.rows[group]..groups.rows[group + 1] {
                        for cell in 0..groups.live(group, row) {
                            for corner in groups.corners_of(group, row, cell) {
                                add(corner, (4 * row + cell) as u32);
                            }
                        }
                    }
                }
            }),
        }
    }

    /// The number of vertices.
    pub(super) fn vertex_count(&self) -> usize {
        self.groups.starts.len() - 1
    }

    /// The sum over the copies of a vertex among some of all, in their order, and none without a copy; `rows` are four numbers
    /// each of these.
    #[inline(always)]
    pub(super) fn sum<const D: usize>(
        &self,
        vertex: usize,
        some: &Range<usize>,
        rows: &[f64],
    ) -> Option<[f64; D]> {
        let places = self.groups.at(vertex).iter().map(|&place| place as usize);
        let mut places = places.filter(|place| some.contains(place)).peekable();
        places.peek()?;
        let mut sum = [0.0; D];
        for place in places {
            let row = &rows[4 * (place - some.start)..][..D];
            for c in 0..D {
                sum[c] += row[c];
            }
        }
        Some(sum)
    }

    /// The cells of a vertex: the number of the row, and of the cell in it.
    pub(super) fn cells(&self, vertex: usize) -> impl Iterator<Item = (usize, usize)> {
        let cells = self.cells.at(vertex).iter();
        cells.map(|&cell| (cell as usize / 4, cell as usize % 4))
    }
}
