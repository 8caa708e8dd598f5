//! Small problems with known minimisers: a grid with nested coarser ones, friction on one side.

use nalgebra::{SMatrix, SVector};
use stickslip_friction::{DieterichRuina, Radial, Tresca};
use stickslip_state::LogTheta;

use crate::{BlockMatrix, Energy, Matrix, Prolongation, Stopping};

use super::sample::SamplePotential;

/// Cells of the finest grid, powers of two: coarsened twice.
const CELLS: [usize; 2] = [8, 4];

/// The kinds of friction in the check of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SampleFriction {
    /// Coulomb friction, sticking and sliding vertices in turn.
    Tresca,
    /// Rate- and state-dependent friction, creeping at 1e-25 m/s and sliding at 1e-3 in turn.
    DieterichRuina,
    /// Kinks away from rest, on and off them in turn.
    Kinked,
}

/// An energy and the field that minimises it: `r = B v + g` for a chosen `v` and subgradient `g`.
pub(super) struct Sample<const C: usize> {
    pub(super) operator: BlockMatrix<C>,
    pub(super) load: Vec<SVector<f64, C>>,
    pub(super) potentials: Vec<SamplePotential>,
    pub(super) vertices: Vec<usize>,
    pub(super) fixed: Vec<[bool; C]>,
    pub(super) exact: Vec<SVector<f64, C>>,
}

/// Reproducible numbers in [-1, 1), of a linear congruential generator.
pub(super) struct Numbers(pub(super) u64);

impl Numbers {
    pub(super) fn next(&mut self) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn vertex(i: usize, j: usize, cells: [usize; 2]) -> usize {
    j * (cells[0] + 1) + i
}

/// Bilinear interpolation between the nested grids, coarsest first.
pub(super) fn transfers() -> Vec<Prolongation> {
    let mut transfers = Vec::new();
    let mut coarse = CELLS.map(|cells| cells / 4);
    for _ in 0..2 {
        let fine = coarse.map(|cells| 2 * cells);
        let parents = |i: usize| {
            if i.is_multiple_of(2) {
                vec![(i / 2, 1.0)]
            } else {
                vec![(i / 2, 0.5), (i / 2 + 1, 0.5)]
            }
        };
        let (mut starts, mut columns, mut weights) = (vec![0_u32], Vec::new(), Vec::new());
        for j in 0..=fine[1] {
            for i in 0..=fine[0] {
                for (q, in_y) in parents(j) {
                    for (p, in_x) in parents(i) {
                        columns.push(vertex(p, q, coarse) as u32);
                        weights.push(in_x * in_y);
                    }
                }
                starts.push(columns.len() as u32);
            }
        }
        let count = |cells: [usize; 2]| (cells[0] + 1) * (cells[1] + 1);
        let shape = (count(fine), count(coarse));
        transfers.push(Prolongation::new(shape, starts, columns, weights));
        coarse = fine;
    }
    transfers
}

/// Springs between neighbours, stiffer along than across, and a mass at every vertex.
fn operator<const C: usize>(stiffness: f64, mass: f64) -> BlockMatrix<C> {
    let (mut starts, mut columns, mut blocks) = (vec![0_u32], Vec::new(), Vec::new());
    for j in 0..=CELLS[1] {
        for i in 0..=CELLS[0] {
            let begin = columns.len();
            let mut diagonal = SMatrix::identity() * mass;
            let mut place = None;
            for q in j.saturating_sub(1)..=(j + 1).min(CELLS[1]) {
                for p in i.saturating_sub(1)..=(i + 1).min(CELLS[0]) {
                    columns.push(vertex(p, q, CELLS) as u32);
                    if (p, q) == (i, j) {
                        place = Some(blocks.len());
                        blocks.push(SMatrix::zeros());
                        continue;
                    }
                    let along = [
                        p as f64 - i as f64,
                        q as f64 - j as f64,
                        0.5 * (p as f64 - i as f64),
                    ];
                    let along = SVector::<f64, C>::from_fn(|c, _| along[c % 3]);
                    let spring = (SMatrix::identity() + along * along.transpose()) * stiffness;
                    diagonal += spring;
                    blocks.push(-spring);
                }
            }
            if let Some(place) = place {
                blocks[place] = diagonal;
            }
            debug_assert!(columns[begin..].is_sorted());
            starts.push(columns.len() as u32);
        }
    }
    let size = starts.len() - 1;
    BlockMatrix::new((size, size), starts, columns, blocks)
}

impl<const C: usize> Sample<C> {
    pub(super) fn new(friction: SampleFriction, mass: f64, seed: u64) -> Self {
        let operator = operator::<C>(1e5, mass);
        let mut numbers = Numbers(seed);
        let mut exact: Vec<_> = (0..operator.rows())
            .map(|_| SVector::<f64, C>::from_fn(|_, _| 1e-3 * (1.0 + 0.5 * numbers.next())))
            .collect();
        let mut fixed = vec![[false; C]; exact.len()];
        for i in 0..=CELLS[0] {
            // Driven on top; at the bottom, with more components than one, the last is held.
            fixed[vertex(i, CELLS[1], CELLS)] = [true; C];
            if C > 1 {
                fixed[i][C - 1] = true;
            }
        }
        let vertices: Vec<usize> = (0..=CELLS[0]).collect();
        let mut potentials = Vec::new();
        let mut subgradients = Vec::new();
        for &p in &vertices {
            let rests = p % 2 == 0;
            let force = 200.0 * (1.5 + numbers.next());
            let resting = match friction {
                SampleFriction::Tresca => 0.0,
                SampleFriction::DieterichRuina => 1e-25,
                SampleFriction::Kinked => KINK,
            };
            for c in 0..C {
                if fixed[p][c] {
                    exact[p][c] = 0.0;
                } else if rests {
                    exact[p][c] = resting;
                }
            }
            let potential = match friction {
                SampleFriction::Tresca => {
                    let law = Tresca { coefficient: 0.6 };
                    SamplePotential::Tresca(Radial {
                        law,
                        force,
                        state: (),
                    })
                }
                SampleFriction::DieterichRuina => SamplePotential::DieterichRuina(Radial {
                    law: LAW,
                    force,
                    state: LogTheta(if rests { 2.0 } else { -4.6 }),
                }),
                SampleFriction::Kinked => SamplePotential::Kinked { force, place: KINK },
            };
            let inside = SVector::from_fn(|_, _| 0.5 * numbers.next());
            subgradients.push(potential.subgradient(&exact[p], &inside));
            potentials.push(potential);
        }
        let mut load = vec![SVector::zeros(); exact.len()];
        operator.multiply_add(1.0, &exact, &mut load);
        for (&p, g) in vertices.iter().zip(&subgradients) {
            load[p] += g;
        }
        Self {
            operator,
            load,
            potentials,
            vertices,
            fixed,
            exact,
        }
    }

    pub(super) fn energy(&self) -> Energy<'_, BlockMatrix<C>, C> {
        Energy {
            operator: &self.operator,
            load: &self.load,
            potentials: &self.potentials,
            vertices: &self.vertices,
            fixed: &self.fixed,
        }
    }

    /// A stop at `1e-9` of the solution, in the norm of the operator.
    pub(super) fn stopping(&self) -> Stopping<'_, BlockMatrix<C>> {
        Stopping {
            norm: &self.operator,
            tolerance: 1e-9 * self.operator.norm(&self.exact),
            relative: 1e-14,
            equivalence: 1.0,
            max_iterations: 100_000,
        }
    }

    /// The data on fixed components, and on the others numbers of up to `size`.
    pub(super) fn start(&self, size: f64, seed: u64) -> Vec<SVector<f64, C>> {
        let mut numbers = Numbers(seed);
        let with_data = |(exact, fixed): (&SVector<f64, C>, &[bool; C])| {
            SVector::from_fn(|c, _| {
                if fixed[c] {
                    exact[c]
                } else {
                    size * numbers.next()
                }
            })
        };
        self.exact.iter().zip(&self.fixed).map(with_data).collect()
    }

    pub(super) fn distance(&self, v: &[SVector<f64, C>], w: &[SVector<f64, C>]) -> f64 {
        let difference: Vec<_> = v.iter().zip(w).map(|(v, w)| v - w).collect();
        self.operator.norm(&difference)
    }
}

/// The position of the kinks of the kinked potentials [m/s].
const KINK: f64 = 7e-4;

const LAW: DieterichRuina = DieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 1e-5,
};
