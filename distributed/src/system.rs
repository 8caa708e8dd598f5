//! A matrix with its constraints, as PETSc takes it.

use std::ffi::c_int;

use nalgebra::SMatrix;
use stickslip::Operator;

use crate::DistributedMatrix;
use crate::ffi::{Krylov, RowsOf};
use crate::world::or_abort;

/// Copies an operator to PETSc, the rows and columns of fixed components replaced by their diagonal entries, and sets
/// multigrid up for it. A failure of PETSc ends all processes.
pub(crate) fn krylov<const C: usize>(
    operator: &DistributedMatrix<C>,
    fixed: &[[bool; C]],
    vertices: &[usize],
    points: &[f64],
) -> Option<Krylov> {
    let layout = &operator.layout;
    let mut masks: Vec<f64> = (fixed.iter().flatten())
        .map(|&fixed| f64::from(u8::from(fixed)))
        .collect();
    masks.resize(C * (layout.owned + layout.ghosts.len()), 0.0);
    layout.update(C, &mut masks);
    let held = |vertex: usize, c: usize| masks[C * vertex + c] != 0.0;
    let mut values = Vec::with_capacity(C * C * operator.columns.len());
    for i in 0..operator.vertex_count() {
        for (j, block) in operator.row(i) {
            let free = SMatrix::<f64, C, C>::from_fn(|r, c| {
                if (i, r) == (j, c) || !(held(i, r) || held(j, c)) {
                    block[(r, c)]
                } else {
                    0.0
                }
            });
            values.extend_from_slice(free.as_slice());
        }
    }
    let number = |&column: &u32| match (column as usize).checked_sub(layout.owned) {
        None => (layout.first + u64::from(column)) as c_int,
        Some(ghost) => layout.ghosts[ghost] as c_int,
    };
    let columns: Vec<c_int> = operator.columns.iter().map(number).collect();
    let starts: Vec<c_int> = operator
        .starts
        .iter()
        .map(|&start| start as c_int)
        .collect();
    let vertices: Vec<c_int> = vertices.iter().map(|&vertex| vertex as c_int).collect();
    let made = Krylov::new(&RowsOf {
        components: C,
        dimension: points.len() / layout.owned.max(1),
        points,
        starts: &starts,
        columns: &columns,
        first: layout.first as usize,
        values: &values,
        vertices: &vertices,
    });
    or_abort(made)
}
