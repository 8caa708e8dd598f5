//! PETSc's multigrid.

use std::ffi::c_int;
use std::marker::PhantomData;
use std::ptr::NonNull;

use nalgebra::{SMatrix, SVector};

use super::{checked, length};
use crate::Error;
use crate::hierarchy::Transfer;

#[repr(C)]
struct RawMultigrid {
    _private: [u8; 0],
    _not_send: PhantomData<*mut u8>,
}

unsafe extern "C" {
    fn ss_multigrid_new(
        c: c_int,
        owned: c_int,
        points: *const f64,
        free: *const f64,
        starts: *const c_int,
        columns: *const c_int,
        first: c_int,
        values: *const f64,
        vertices: *const c_int,
        vertex_count: c_int,
        out: *mut *mut RawMultigrid,
    ) -> c_int;
    fn ss_multigrid_coarsen(
        multigrid: *mut RawMultigrid,
        owned: c_int,
        first: c_int,
        copies: *const c_int,
        starts: *const c_int,
        columns: *const c_int,
        weights: *const f64,
    ) -> c_int;
    fn ss_multigrid_finish(multigrid: *mut RawMultigrid) -> c_int;
    fn ss_multigrid_stiffen(multigrid: *mut RawMultigrid, stiffness: *const f64) -> c_int;
    fn ss_multigrid_apply(
        multigrid: *mut RawMultigrid,
        product: c_int,
        input: *const f64,
        output: *mut f64,
    ) -> c_int;
    fn ss_multigrid_free(multigrid: *mut RawMultigrid) -> c_int;
}

/// The rows of this process of a matrix, as PETSc takes them.
pub(crate) struct RowsOf<'a, const C: usize> {
    /// Coordinates of the vertices, one after the other; rigid motions follow from them where `C = D`.
    pub(crate) points: Option<&'a [f64]>,
    /// One where a component is free, zero where it is coupled with no other.
    pub(crate) free: &'a [SVector<f64, C>],
    pub(crate) starts: &'a [c_int],
    /// Global numbers of vertices.
    pub(crate) columns: &'a [c_int],
    pub(crate) first: usize,
    pub(crate) values: &'a [SMatrix<f64, C, C>],
    /// The vertices that friction acts on.
    pub(crate) vertices: &'a [c_int],
}

/// A cycle of PETSc's multigrid, on geometric levels as far as there are some, and algebraic ones below.
#[derive(Debug)]
pub(crate) struct Multigrid<const C: usize> {
    raw: NonNull<RawMultigrid>,
    /// Vertices of this process, and frictional ones among them.
    owned: usize,
    frictional: usize,
}

// SAFETY: the objects of PETSc belong to no thread. That one thread alone calls PETSc and MPI is what `run` promises:
// it begins them, and a simulation steps in the thread that it is called in.
#[allow(clippy::non_send_fields_in_send_ty)]
unsafe impl<const C: usize> Send for Multigrid<C> {}

impl<const C: usize> Multigrid<C> {
    /// Copies the rows, and sets all levels up; transfers are those from the next coarser level, finest first.
    pub(crate) fn new(
        rows: &RowsOf<'_, C>,
        transfers: impl Iterator<Item = Transfer>,
    ) -> Result<Self, Error> {
        let owned = rows.starts.len() - 1;
        assert!(rows.points.is_none_or(|points| points.len() == C * owned));
        assert_eq!(rows.free.len(), owned);
        assert_eq!(rows.columns.len(), rows.starts[owned] as usize);
        assert_eq!(rows.values.len(), rows.columns.len());
        let mut vertices = rows.vertices.iter();
        assert!(vertices.all(|&vertex| (vertex as usize) < owned));
        let mut raw = std::ptr::null_mut();
        // SAFETY: the lengths are those that the shim reads, a block being C * C numbers, and `raw` is written.
        checked("MatSetValues", unsafe {
            ss_multigrid_new(
                length(C)?,
                length(owned)?,
                rows.points.map_or(std::ptr::null(), <[f64]>::as_ptr),
                rows.free.as_ptr().cast(),
                rows.starts.as_ptr(),
                rows.columns.as_ptr(),
                length(rows.first)?,
                rows.values.as_ptr().cast(),
                rows.vertices.as_ptr(),
                length(rows.vertices.len())?,
                &mut raw,
            )
        })?;
        let raw = NonNull::new(raw).ok_or(Error::Library {
            call: "calloc",
            code: 0,
        })?;
        let frictional = rows.vertices.len();
        let multigrid = Self {
            raw,
            owned,
            frictional,
        };
        let mut fine = owned;
        for level in transfers {
            assert_eq!(level.starts.len(), C * fine + 1);
            let entries = level.starts[C * fine] as usize;
            assert_eq!([level.columns.len(), level.weights.len()], [entries; 2]);
            assert!(level.copies.iter().all(|&copy| (copy as usize) < fine));
            fine = level.copies.len();
            // SAFETY: as many rows as the level before has, and lists as long as they say.
            checked("MatPtAP", unsafe {
                ss_multigrid_coarsen(
                    raw.as_ptr(),
                    length(fine)?,
                    length(level.first)?,
                    level.copies.as_ptr(),
                    level.starts.as_ptr(),
                    level.columns.as_ptr(),
                    level.weights.as_ptr(),
                )
            })?;
        }
        // SAFETY: made above.
        checked("PCSetUp", unsafe { ss_multigrid_finish(raw.as_ptr()) })?;
        Ok(multigrid)
    }

    /// Sets the contribution of friction to the diagonal block of each frictional vertex.
    pub(crate) fn stiffen(&mut self, stiffness: &[SVector<f64, C>]) -> Result<(), Error> {
        assert_eq!(stiffness.len(), self.frictional);
        // SAFETY: a vector is C numbers, one for each frictional vertex.
        checked("MatSetValues", unsafe {
            ss_multigrid_stiffen(self.raw.as_ptr(), stiffness.as_ptr().cast())
        })
    }

    /// One cycle from zero, symmetric and positive definite.
    pub(crate) fn apply(
        &mut self,
        residual: &[SVector<f64, C>],
        correction: &mut [SVector<f64, C>],
    ) -> Result<(), Error> {
        self.on_finest(false, residual, correction)
    }

    /// The product with the matrix that the cycle is for: of the operator, stiffened, between free components.
    pub(crate) fn multiply(
        &mut self,
        x: &[SVector<f64, C>],
        product: &mut [SVector<f64, C>],
    ) -> Result<(), Error> {
        self.on_finest(true, x, product)
    }

    fn on_finest(
        &mut self,
        product: bool,
        from: &[SVector<f64, C>],
        to: &mut [SVector<f64, C>],
    ) -> Result<(), Error> {
        assert_eq!([from.len(), to.len()], [self.owned; 2]);
        let call = if product { "MatMult" } else { "PCApply" };
        let (from, to) = (from.as_ptr().cast(), to.as_mut_ptr().cast());
        // SAFETY: a vector is C numbers, and both fields have as many vertices as the finest level.
        checked(call, unsafe {
            ss_multigrid_apply(self.raw.as_ptr(), c_int::from(product), from, to)
        })
    }
}

impl<const C: usize> Drop for Multigrid<C> {
    fn drop(&mut self) {
        // SAFETY: made by `new`, and given up here.
        unsafe { ss_multigrid_free(self.raw.as_ptr()) };
    }
}
