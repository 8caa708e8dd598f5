//! Construction of a level: its pattern, its fixed components and its strip, without values.

use super::{Cut, Level};
use crate::block_matrix::Rows;
use crate::multigrid::couplings::Couplings;
use crate::multigrid::galerkin;
use crate::multigrid::line_smoother::Sets;
use crate::multigrid::transfer::Transfer;
use crate::{BlockMatrix, Frames};

/// Smallest number of rows of a Galerkin product that is worth a thread, and largest number of parts.
const ROWS: usize = 2048;
const PARTS: usize = 16;

impl<const C: usize> Level<C> {
    /// A level of a pattern, with the rows that friction reaches besides the neighbours of frictional vertices.
    fn new(
        matrix: &BlockMatrix<C>,
        (cut, single): (Cut, bool),
        fixed: Vec<[bool; C]>,
        frictional: Vec<u32>,
        reached: impl Iterator<Item = u32>,
    ) -> Self {
        let size = matrix.rows();
        let rows = Rows::of(matrix);
        let around = frictional
            .iter()
            .flat_map(|&i| &rows.columns[rows.range(i as usize)]);
        let mut strip: Vec<u32> = around.copied().chain(reached).collect();
        strip.sort_unstable();
        strip.dedup();
        let slabs = cut(size, rows.bandwidth());
        Self {
            dropped: fixed.clone(),
            fixed,
            hessians: Vec::with_capacity(frictional.len()),
            frictional,
            strip,
            copies: Vec::new(),
            cuts: Vec::new(),
            positions: Vec::new(),
            couplings: Couplings::of(matrix, &slabs, single),
            slabs,
            sets: Sets::default(),
            frames: Frames::default(),
            matrix: None,
        }
    }

    /// The level of the operator itself.
    pub(in crate::multigrid) fn finest(
        operator: &BlockMatrix<C>,
        how: (Cut, bool),
        fixed: &[[bool; C]],
        frictional: &[usize],
        frames: &Frames<C>,
    ) -> Self {
        let frictional = frictional.iter().map(|&i| i as u32).collect();
        let reached = std::iter::empty();
        Self {
            frames: frames.clone(),
            ..Self::new(operator, how, fixed.to_vec(), frictional, reached)
        }
    }

    /// The next coarser level: pattern, fixed components and strip, without values.
    pub(in crate::multigrid) fn coarsened(
        finer: &Self,
        fine: &BlockMatrix<C>,
        how: (Cut, bool),
        transfer: &Transfer,
    ) -> Self {
        let matrix = galerkin::pattern(fine, transfer);
        let mut fixed = vec![[false; C]; matrix.rows()];
        transfer.for_each_copy(|fine, coarse| fixed[coarse] = finer.seen(fine, &finer.fixed[fine]));
        let mut copies = Vec::new();
        transfer.for_each_copy(|fine, coarse| {
            if finer.frictional.binary_search(&(fine as u32)).is_ok() {
                copies.push((coarse as u32, fine as u32));
            }
        });
        let mut frictional: Vec<u32> = copies.iter().map(|&(coarse, _)| coarse).collect();
        frictional.sort_unstable();
        let parents = Rows::of(&transfer.prolongation);
        let above = finer.strip.iter().flat_map(|&i| parents.row(i as usize));
        let reached = above.map(|(coarse, _)| coarse as u32);
        let size = matrix.rows();
        let parts = if cfg!(feature = "rayon") {
            (size / ROWS).clamp(1, PARTS)
        } else {
            1
        };
        Self {
            copies,
            cuts: (0..=parts).map(|k| size * k / parts).collect(),
            positions: vec![0; size * parts],
            ..Self::new(&matrix, how, fixed, frictional, reached)
        }
        .with_matrix(matrix)
    }

    fn with_matrix(mut self, matrix: BlockMatrix<C>) -> Self {
        self.matrix = Some(matrix);
        self
    }
}
