//! The product with a field: group by group, then vertex by vertex.

use std::mem::take;
use std::ops::Range;

use nalgebra::SVector;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use stickslip_core::compiled;

use super::ElementStiffness;
use super::copies::Copies;
use super::group_forces::forces_of;
use super::lanes::{Row, row};

/// Vertices of a part of the sums: enough work for a thread, and few enough for its cache.
const PART: usize = 2048;

/// `begin(first, y)`: writes a part of the forces \[N\] from the vertex `first` on.
pub type BeginPart<'a, const D: usize> = &'a (dyn Fn(usize, &mut [SVector<f64, D>]) + Sync);
/// `end(first, [y, p, q])`: reads and writes a part of the forces \[N\] and of two more fields from the vertex `first` on.
pub type EndPart<'a, const D: usize> = &'a (dyn Fn(usize, [&mut [SVector<f64, D>]; 3]) + Sync);

compiled! {
    /// `y += scale A x`; with weights, the sum over levels of local steps of the weight times their part.
    pub(super) fn add_product<D in 2, 3>(
        stiffness: &ElementStiffness<D>,
        weights: Option<&[f64]>,
        scale: f64,
        x: &[SVector<f64, D>],
        y: &mut [SVector<f64, D>],
    ) {
        with_sums(stiffness, weights, scale, x, |sums| {
            for_vertices(0, [y], &|first, [y]| sums.add(first, y));
        });
    }

    /// The same part by part, with what precedes and follows each part.
    pub(super) fn add_product_by_parts<D in 2, 3>(
        stiffness: &ElementStiffness<D>,
        weights: &[f64],
        scale: f64,
        x: &[SVector<f64, D>],
        fields: [&mut [SVector<f64, D>]; 3],
        begin: BeginPart<'_, D>,
        end: EndPart<'_, D>,
    ) {
        with_sums(stiffness, Some(weights), scale, x, |sums| {
            for_vertices(0, fields, &|first, [y, p, q]| {
                begin(first, y);
                sums.add(first, y);
                end(first, [y, p, q]);
            });
        });
    }
}

/// The sums over the copies of vertices, of forces that are known.
struct Sums<'a> {
    copies: &'a Copies,
    /// The lowest level of the cells of each vertex, if there are several, and the highest that acts.
    lowest: &'a [u8],
    highest: u8,
    /// The copies that have forces.
    places: Range<usize>,
    forces: &'a [f64],
    scale: f64,
}

impl Sums<'_> {
    /// Adds the forces at a part of the vertices.
    #[inline(always)]
    fn add<const D: usize>(&self, first: usize, y: &mut [SVector<f64, D>]) {
        for (i, y) in (first..).zip(y) {
            if self
                .lowest
                .get(i)
                .is_some_and(|level| *level > self.highest)
            {
                continue;
            }
            // In a step without its cells the vertex is not touched.
            if let Some(sum) = self.copies.sum::<D>(i, &self.places, self.forces) {
                for c in 0..D {
                    y[c] += self.scale * sum[c];
                }
            }
        }
    }
}

/// Computes the forces of the groups with weights, and hands over their sums.
fn with_sums<const D: usize>(
    stiffness: &ElementStiffness<D>,
    weights: Option<&[f64]>,
    scale: f64,
    x: &[SVector<f64, D>],
    work: impl FnOnce(&Sums<'_>),
) {
    let elements = &*stiffness.elements;
    // Two products at a time are for the second of them to find memory.
    let mut shared = elements.forces.try_lock();
    let mut own = Vec::new();
    let forces = match &mut shared {
        Ok(shared) => &mut **shared,
        Err(_) => &mut own,
    };
    let groups = &elements.groups;
    let some = weights.map_or(0..groups.count(), |weights| groups.with(weights));
    let places = groups.starts[some.start]..groups.starts[some.end];
    let highest = some
        .clone()
        .last()
        .map_or(0, |group| groups.level[group] as u8);
    forces.resize(groups.vertices.len(), row([0.0; 4]));
    let forces = &mut forces[..places.len()];
    for_groups((stiffness, weights), some, x, forces);
    work(&Sums {
        copies: &elements.copies,
        lowest: &elements.lowest,
        highest,
        places,
        forces: cast_slice(forces),
        scale: scale * stiffness.factor,
    });
}

/// The forces of some groups at their vertices; `forces` are those of these groups.
fn for_groups<const D: usize>(
    (stiffness, weights): (&ElementStiffness<D>, Option<&[f64]>),
    some: Range<usize>,
    x: &[SVector<f64, D>],
    forces: &mut [Row],
) {
    if some.len() <= 1 {
        for group in some {
            let level = stiffness.elements.groups.level[group];
            let weight = weights.map_or(1.0, |all| all.get(level).copied().unwrap_or(0.0));
            if weight == 0.0 {
                forces.fill(row([0.0; 4]));
                continue;
            }
            let cells = (&stiffness.elements.groups, &*stiffness.lame);
            forces_of(cells, group, x, forces);
            if weight != 1.0 {
                let numbers: &mut [f64] = cast_slice_mut(forces);
                numbers.iter_mut().for_each(|number| *number *= weight);
            }
        }
        return;
    }
    let half = some.start + some.len() / 2;
    let starts = &stiffness.elements.groups.starts;
    let (before, behind) = forces.split_at_mut(starts[half] - starts[some.start]);
    join(
        || for_groups((stiffness, weights), some.start..half, x, before),
        || for_groups((stiffness, weights), half..some.end, x, behind),
    );
}

/// `work(first, parts)` for parts of fields with the number of their first vertex.
fn for_vertices<const D: usize, const K: usize>(
    first: usize,
    fields: [&mut [SVector<f64, D>]; K],
    work: &(impl Fn(usize, [&mut [SVector<f64, D>]; K]) + Sync),
) {
    let vertices = fields[0].len();
    if vertices <= PART {
        return work(first, fields);
    }
    let half = vertices / 2;
    let mut halves = fields.map(|field| field.split_at_mut(half));
    let before = halves.each_mut().map(|(before, _)| take(before));
    let behind = halves.map(|(_, behind)| behind);
    join(
        || for_vertices(first, before, work),
        || for_vertices(first + half, behind, work),
    );
}

/// Runs both, in parallel if there are threads.
#[cfg(feature = "rayon")]
fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    // Alone in its pool, a thread from outside would wait for another one to do its work.
    if rayon::current_num_threads() > 1 {
        rayon::join(a, b);
    } else {
        a();
        b();
    }
}

#[cfg(not(feature = "rayon"))]
fn join(a: impl FnOnce(), b: impl FnOnce()) {
    a();
    b();
}
