//! The product with a field: group by group, then vertex by vertex.

use nalgebra::SVector;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use stickslip_core::compiled;

use super::ElementStiffness;
use super::group_forces::forces_of;
use super::lanes::{Row, row};

/// Vertices of a part of the sums: enough work for a thread.
const PART: usize = 8192;

compiled! {
    /// `y += scale A x`; with weights, the sum over levels of local steps of the weight times their part.
    pub(super) fn add_product<D in 2, 3>(
        stiffness: &ElementStiffness<D>,
        weights: Option<&[f64]>,
        scale: f64,
        x: &[SVector<f64, D>],
        y: &mut [SVector<f64, D>],
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
        forces.resize(groups.vertices.len(), row([0.0; 4]));
        let forces = &mut forces[..places.len()];
        for_groups((stiffness, weights), some, x, forces);
        let (forces, scale): (&[f64], f64) = (cast_slice(forces), scale * stiffness.factor);
        for_vertices(0, y, &|first, y| {
            for (i, y) in (first..).zip(y) {
                // In a step without its cells the vertex is not touched.
                if let Some(sum) = elements.copies.sum::<D>(i, &places, forces) {
                    for c in 0..D {
                        y[c] += scale * sum[c];
                    }
                }
            }
        });
    }
}

/// The forces of some groups at their vertices; `forces` are those of these groups.
fn for_groups<const D: usize>(
    (stiffness, weights): (&ElementStiffness<D>, Option<&[f64]>),
    some: std::ops::Range<usize>,
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

/// `work(first, part)` for parts of the vertices with the number of their first one.
fn for_vertices<const D: usize>(
    first: usize,
    y: &mut [SVector<f64, D>],
    work: &(impl Fn(usize, &mut [SVector<f64, D>]) + Sync),
) {
    if y.len() <= PART {
        return work(first, y);
    }
    let half = y.len() / 2;
    let (before, behind) = y.split_at_mut(half);
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
