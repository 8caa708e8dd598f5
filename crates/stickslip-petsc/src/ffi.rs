//! The calls of the shim: all that is unsafe. What they are given is checked here, once.

use std::ffi::{c_int, c_void};
use std::marker::PhantomData;
use std::ptr::NonNull;

use nalgebra::{SMatrix, SVector};

use crate::Error;
use crate::hierarchy::Transfer;

#[repr(C)]
struct RawMultigrid {
    _private: [u8; 0],
    _not_send: PhantomData<*mut u8>,
}

unsafe extern "C" {
    fn ss_begin(rank: *mut c_int, size: *mut c_int) -> c_int;
    fn ss_end() -> c_int;
    fn ss_abort(code: c_int);
    fn ss_sum(x: *mut f64, n: c_int) -> c_int;
    fn ss_max(x: *mut f64, n: c_int) -> c_int;
    fn ss_counts(send: *const c_int, receive: *mut c_int) -> c_int;
    fn ss_all_to_all(
        send_counts: *const c_int,
        send: *const u64,
        send_starts: *const c_int,
        receive_counts: *const c_int,
        receive: *mut u64,
        receive_starts: *const c_int,
    ) -> c_int;
    fn ss_request_size() -> usize;
    fn ss_exchange(
        n: c_int,
        ranks: *const c_int,
        send_counts: *const c_int,
        send: *const f64,
        receive_counts: *const c_int,
        receive: *mut f64,
        requests: *mut c_void,
    ) -> c_int;
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

fn checked(call: &'static str, code: c_int) -> Result<(), Error> {
    if code == 0 {
        Ok(())
    } else {
        Err(Error::Library { call, code })
    }
}

fn length(n: usize) -> Result<c_int, Error> {
    c_int::try_from(n).map_err(|_| Error::TooLarge { size: n })
}

/// Initialises MPI and PETSc; the rank of this process and how many there are.
pub(crate) fn begin() -> Result<(usize, usize), Error> {
    let (mut rank, mut size) = (0, 0);
    // SAFETY: both point to numbers that live on.
    checked("PetscInitialize", unsafe { ss_begin(&mut rank, &mut size) })?;
    Ok((rank as usize, size as usize))
}

/// Ends PETSc and MPI.
pub(crate) fn end() -> Result<(), Error> {
    // SAFETY: no arguments.
    checked("PetscFinalize", unsafe { ss_end() })
}

/// Ends all processes.
pub(crate) fn abort() {
    // SAFETY: no pointers.
    unsafe { ss_abort(1) }
}

/// Replaces each number by its sum over all processes.
pub(crate) fn sum(x: &mut [f64]) -> Result<(), Error> {
    // SAFETY: `x` is as long as it says.
    checked("MPI_Allreduce", unsafe {
        ss_sum(x.as_mut_ptr(), length(x.len())?)
    })
}

/// Replaces each number by the largest of all processes.
pub(crate) fn max(x: &mut [f64]) -> Result<(), Error> {
    // SAFETY: `x` is as long as it says.
    checked("MPI_Allreduce", unsafe {
        ss_max(x.as_mut_ptr(), length(x.len())?)
    })
}

/// Sends one list to each process, and returns the lists received.
pub(crate) fn all_to_all(lists: &[Vec<u64>]) -> Result<Vec<Vec<u64>>, Error> {
    let counts = lists.iter().map(|list| length(list.len()));
    let send_counts = counts.collect::<Result<Vec<_>, _>>()?;
    let mut receive_counts = vec![0; lists.len()];
    // SAFETY: both have one number a process, `lists` being one a process (`World::all_to_all`).
    checked("MPI_Alltoall", unsafe {
        ss_counts(send_counts.as_ptr(), receive_counts.as_mut_ptr())
    })?;
    let starts = |counts: &[c_int]| -> Result<(Vec<c_int>, usize), Error> {
        let mut end = 0_usize;
        let starts = counts.iter().map(|&count| {
            let start = length(end);
            end += count as usize;
            start
        });
        let starts = starts.collect::<Result<_, _>>()?;
        Ok((starts, end))
    };
    let (send_starts, _) = starts(&send_counts)?;
    let (receive_starts, total) = starts(&receive_counts)?;
    let send = lists.concat();
    let mut receive = vec![0; total];
    // SAFETY: counts and starts stay within `send` and `receive`, as they were made.
    checked("MPI_Alltoallv", unsafe {
        ss_all_to_all(
            send_counts.as_ptr(),
            send.as_ptr(),
            send_starts.as_ptr(),
            receive_counts.as_ptr(),
            receive.as_mut_ptr(),
            receive_starts.as_ptr(),
        )
    })?;
    let mut rest = receive.as_slice();
    Ok(receive_counts
        .iter()
        .map(|&count| {
            let (list, after) = rest.split_at(count as usize);
            rest = after;
            list.to_vec()
        })
        .collect())
}

/// With whom this process exchanges how many numbers, and room for that.
#[derive(Debug)]
pub(crate) struct Exchange {
    ranks: Vec<c_int>,
    send_counts: Vec<c_int>,
    receive_counts: Vec<c_int>,
    requests: Vec<u64>,
}

impl Exchange {
    /// For neighbours by rank, with how many numbers go to and come from each.
    pub(crate) fn new(neighbours: &[(usize, usize, usize)]) -> Result<Self, Error> {
        let each = |of: fn(&(usize, usize, usize)) -> usize| {
            let lengths = neighbours.iter().map(|neighbour| length(of(neighbour)));
            lengths.collect::<Result<Vec<_>, _>>()
        };
        // SAFETY: no arguments.
        let bytes = 2 * neighbours.len() * unsafe { ss_request_size() };
        Ok(Self {
            ranks: each(|neighbour| neighbour.0)?,
            send_counts: each(|neighbour| neighbour.1)?,
            receive_counts: each(|neighbour| neighbour.2)?,
            requests: vec![0; bytes.div_ceil(8)],
        })
    }

    /// Sends and receives, neighbour after neighbour.
    pub(crate) fn run(&mut self, send: &[f64], receive: &mut [f64]) -> Result<(), Error> {
        let total = |counts: &[c_int]| counts.iter().map(|&count| count as usize).sum::<usize>();
        assert_eq!(total(&self.send_counts), send.len());
        assert_eq!(total(&self.receive_counts), receive.len());
        let neighbours = length(self.ranks.len())?;
        // SAFETY: the lengths are those of the counts, and there is room for two requests a neighbour.
        checked("MPI_Waitall", unsafe {
            ss_exchange(
                neighbours,
                self.ranks.as_ptr(),
                self.send_counts.as_ptr(),
                send.as_ptr(),
                self.receive_counts.as_ptr(),
                receive.as_mut_ptr(),
                self.requests.as_mut_ptr().cast(),
            )
        })
    }
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
