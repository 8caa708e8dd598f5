//! The forces of one group, in the widest registers that the processor has.

use std::cell::RefCell;

#[cfg(target_arch = "x86_64")]
use fearless_simd::{Level, prelude::*};
use nalgebra::SVector;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

use super::chains::CHAIN;
use super::groups::Groups;
use super::kernel::{Corners, Lame, Site, add_forces};
use super::lame::Materials;
use super::lanes::{Arrays, Lanes, Row, row};

thread_local! {
    /// Positions and field at the vertices of a group.
    static SITES: RefCell<Vec<Site>> = const { RefCell::new(Vec::new()) };
}

/// The forces of a group at its vertices.
pub(super) fn forces_of<const D: usize>(
    (groups, lame): (&Groups, &Materials),
    group: usize,
    x: &[SVector<f64, D>],
    forces: &mut [Row],
) {
    let vertices = &groups.vertices[groups.starts[group]..groups.starts[group + 1]];
    let positions = &groups.positions[groups.starts[group]..groups.starts[group + 1]];
    SITES.with_borrow_mut(|sites| {
        sites.resize(vertices.len(), [row([0.0; 4]); 2]);
        // Number by number: rows would go through memory first. One after the other, the processor fetches them ahead.
        let numbers: &mut [f64] = cast_slice_mut(sites.as_flattened_mut());
        let positions: &[f64] = cast_slice(positions);
        let ends = positions.chunks_exact(4).zip(vertices);
        for (own, (position, &p)) in numbers.chunks_exact_mut(8).zip(ends) {
            own[..4].copy_from_slice(position);
            own[4..4 + D].copy_from_slice(x[p as usize].as_slice());
            own[4 + D..].fill(0.0);
        }
        forces.fill(row([0.0; 4]));
        let work: Group<'_, D> = Group {
            groups,
            lame,
            group,
            sites,
            forces,
        };
        #[cfg(target_arch = "x86_64")]
        if let Some(four) = pulp::x86::V3::try_new() {
            if let Some(eight) = Level::new().as_avx512() {
                return eight.vectorize(
                    #[inline(always)]
                    || work.run_wide(eight, four),
                );
            }
            return four.vectorize(Wide { simd: four, work });
        }
        work.run(Arrays, 0);
    });
}

/// The cells of a group, the vectors and the forces at its vertices.
struct Group<'a, const D: usize> {
    groups: &'a Groups,
    lame: &'a Materials,
    group: usize,
    sites: &'a [Site],
    forces: &'a mut [Row],
}

impl<'a, const D: usize> Group<'a, D> {
    /// Eight chains at a time, and then four.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn run_wide<E: Lanes<2>, L: Lanes<1>>(mut self, eight: E, four: L) {
        let groups = self.groups;
        let [rows, _] = groups.rows_of(self.group);
        let (pairs, _) = groups.chains_of(self.group).as_chunks::<2>();
        for ([a, b], row) in pairs.iter().zip(rows.step_by(2 * CHAIN)) {
            let lame = |k: usize| [self.lame(row + k), self.lame(row + CHAIN + k)];
            let lame = [lame(0), lame(1), lame(2)];
            self.add::<E, CHAIN, 6, 4, 2>(eight, [a, b], lame);
        }
        self.run(four, 2 * pairs.len());
    }

    /// Four chains or cells at a time, without the first chains.
    #[inline(always)]
    fn run<L: Lanes<1>>(mut self, lanes: L, done: usize) {
        let groups = self.groups;
        let [chained, others] = groups.rows_of(self.group);
        let chains = groups
            .chains_of(self.group)
            .iter()
            .zip(chained.step_by(CHAIN));
        for (corners, row) in chains.skip(done) {
            let lame = [[self.lame(row)], [self.lame(row + 1)], [self.lame(row + 2)]];
            self.add::<L, CHAIN, 6, 4, 1>(lanes, [corners], lame);
        }
        for (corners, row) in groups.singles_of(self.group).iter().zip(others) {
            let (corners, lame) = ([corners], [[self.lame(row)]]);
            match groups.live(self.group, row) {
                1 => self.add::<L, 1, 4, 1, 1>(lanes, corners, lame),
                2 => self.add::<L, 1, 4, 2, 1>(lanes, corners, lame),
                3 => self.add::<L, 1, 4, 3, 1>(lanes, corners, lame),
                _ => self.add::<L, 1, 4, 4, 1>(lanes, corners, lame),
            }
        }
    }

    /// Lamé's parameters of a row of cells.
    #[inline(always)]
    fn lame(&self, row: usize) -> &'a Lame {
        self.lame.of_row(row)
    }

    #[inline(always)]
    fn add<L: Lanes<F>, const N: usize, const K: usize, const LIVE: usize, const F: usize>(
        &mut self,
        lanes: L,
        corners: [&Corners<K>; F],
        lame: [[&Lame; F]; N],
    ) {
        add_forces::<L, D, N, K, LIVE, F>(lanes, corners, lame, self.sites, self.forces);
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
        self.work.run(self.simd, 0);
    }
}
