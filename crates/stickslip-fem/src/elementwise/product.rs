//! The product with a field: group by group, then vertex by vertex.

use std::cell::RefCell;

use nalgebra::SVector;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use stickslip_core::compiled;

use super::ElementStiffness;
use super::chains::CHAIN;
use super::kernel::add_forces;
use super::lanes::{Arrays, Lanes, Row, row};

/// Vertices of a part of the sums: enough work for a thread.
const PART: usize = 8192;

thread_local! {
    /// The field at the vertices of a group.
    static FIELD: RefCell<Vec<Row>> = const { RefCell::new(Vec::new()) };
}

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
                let sum = elements.copies.sum::<D>(i, &places, forces);
                for c in 0..D {
                    y[c] += scale * sum[c];
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
            forces_of(stiffness, group, x, forces);
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

/// The forces of one group.
fn forces_of<const D: usize>(
    stiffness: &ElementStiffness<D>,
    group: usize,
    x: &[SVector<f64, D>],
    forces: &mut [Row],
) {
    let groups = &stiffness.elements.groups;
    let vertices = &groups.vertices[groups.starts[group]..groups.starts[group + 1]];
    FIELD.with_borrow_mut(|field| {
        field.resize(vertices.len(), row([0.0; 4]));
        // Number by number: rows would go through memory first.
        let numbers: &mut [f64] = cast_slice_mut(field);
        for (own, &p) in numbers.chunks_exact_mut(4).zip(vertices) {
            own[..D].copy_from_slice(x[p as usize].as_slice());
            own[D..].fill(0.0);
        }
        forces.fill(row([0.0; 4]));
        let work = Group {
            stiffness,
            group,
            field,
            forces,
        };
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return simd.vectorize(Wide { simd, work });
        }
        work.run(Arrays);
    });
}

struct Group<'a, const D: usize> {
    stiffness: &'a ElementStiffness<D>,
    group: usize,
    field: &'a [Row],
    forces: &'a mut [Row],
}

impl<const D: usize> Group<'_, D> {
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) {
        let groups = &self.stiffness.elements.groups;
        let (begin, end) = (groups.starts[self.group], groups.starts[self.group + 1]);
        let positions = &groups.positions[begin..end];
        let lame = |row: usize| self.stiffness.lame.of_row(row);
        let [chained, others] = groups.rows_of(self.group);
        let chains = &groups.chains[groups.chained[self.group]..groups.chained[self.group + 1]];
        let Self { field, forces, .. } = self;
        for (corners, row) in chains.iter().zip(chained.step_by(CHAIN)) {
            let lame = [lame(row), lame(row + 1), lame(row + 2)];
            add_forces::<L, D, CHAIN, 6, 4>(lanes, corners, lame, positions, field, forces);
        }
        for (corners, row) in groups.singles_of(self.group).iter().zip(others) {
            let lame = [lame(row)];
            match groups.live(self.group, row) {
                1 => add_forces::<L, D, 1, 4, 1>(lanes, corners, lame, positions, field, forces),
                2 => add_forces::<L, D, 1, 4, 2>(lanes, corners, lame, positions, field, forces),
                3 => add_forces::<L, D, 1, 4, 3>(lanes, corners, lame, positions, field, forces),
                _ => add_forces::<L, D, 1, 4, 4>(lanes, corners, lame, positions, field, forces),
            }
        }
    }
}

/// The work in wide registers: a struct, since closures would not be compiled for them.
#[cfg(target_arch = "x86_64")]
struct Wide<'a, const D: usize> {
    simd: pulp::x86::V3,
    work: Group<'a, D>,
}

#[cfg(target_arch = "x86_64")]
impl<const D: usize> pulp::NullaryFnOnce for Wide<'_, D> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.work.run(self.simd);
    }
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
