//! The calls of the shim: all that is unsafe. What they are given is checked here, once.

use std::ffi::{c_int, c_void};
use std::marker::PhantomData;
use std::ptr::NonNull;

use crate::Error;

#[repr(C)]
struct RawKrylov {
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
    fn ss_krylov_new(
        c: c_int,
        owned: c_int,
        dimension: c_int,
        points: *const f64,
        starts: *const c_int,
        columns: *const c_int,
        first: c_int,
        values: *const f64,
        vertices: *const c_int,
        count: c_int,
        out: *mut *mut RawKrylov,
    ) -> c_int;
    fn ss_krylov_free(krylov: *mut RawKrylov) -> c_int;
    fn ss_krylov_linearize(
        krylov: *mut RawKrylov,
        kept: *const f64,
        smooth: *const f64,
        hessians: *const f64,
        inverses: *const f64,
    ) -> c_int;
    fn ss_krylov_solve(
        krylov: *mut RawKrylov,
        load: *const f64,
        x: *mut f64,
        relative: f64,
        absolute: f64,
        most: c_int,
        iterations: *mut c_int,
        error: *mut f64,
    ) -> c_int;
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

/// Sends one list to each process, and returns what each has sent here.
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
pub(crate) struct RowsOf<'a> {
    pub(crate) components: usize,
    pub(crate) dimension: usize,
    /// Coordinates of the vertices, one after the other; rigid-body modes follow from them where `C = D`.
    pub(crate) points: &'a [f64],
    pub(crate) starts: &'a [c_int],
    /// Global numbers of vertices.
    pub(crate) columns: &'a [c_int],
    pub(crate) first: usize,
    /// One block an entry, column-major.
    pub(crate) values: &'a [f64],
    /// The vertices that friction acts on.
    pub(crate) vertices: &'a [c_int],
}

/// PETSc's conjugate gradients for truncated Newton matrices, preconditioned by its multigrid.
#[derive(Debug)]
pub(crate) struct Krylov {
    raw: NonNull<RawKrylov>,
    /// Unknowns of this process, and numbers of blocks at frictional vertices.
    sizes: [usize; 2],
}

// SAFETY: the objects of PETSc belong to no thread. That one thread alone calls PETSc and MPI is what `run` promises:
// it begins them, and a simulation steps in the thread that it is called in.
#[allow(clippy::non_send_fields_in_send_ty)]
unsafe impl Send for Krylov {}

impl Krylov {
    /// Copies the rows, and sets multigrid up for them.
    pub(crate) fn new(rows: &RowsOf<'_>) -> Result<Self, Error> {
        let (c, owned) = (rows.components, rows.starts.len() - 1);
        let blocks = c * c;
        assert_eq!(rows.points.len(), rows.dimension * owned);
        assert_eq!(rows.columns.len(), rows.starts[owned] as usize);
        assert_eq!(rows.values.len(), blocks * rows.columns.len());
        assert!(
            rows.vertices
                .iter()
                .all(|&vertex| (vertex as usize) < owned)
        );
        let mut raw = std::ptr::null_mut();
        // SAFETY: the lengths are those that the shim reads, and `raw` is written.
        checked("KSPCreate", unsafe {
            ss_krylov_new(
                length(c)?,
                length(owned)?,
                length(rows.dimension)?,
                rows.points.as_ptr(),
                rows.starts.as_ptr(),
                rows.columns.as_ptr(),
                length(rows.first)?,
                rows.values.as_ptr(),
                rows.vertices.as_ptr(),
                length(rows.vertices.len())?,
                &mut raw,
            )
        })?;
        let raw = NonNull::new(raw).ok_or(Error::Library {
            call: "calloc",
            code: 0,
        })?;
        let sizes = [c * owned, blocks * rows.vertices.len()];
        Ok(Self { raw, sizes })
    }

    /// Sets which unknowns are kept, at which multigrid acts, and the blocks of Hessians and local inverses.
    pub(crate) fn linearize(
        &mut self,
        [kept, smooth]: [&[f64]; 2],
        [hessians, inverses]: [&[f64]; 2],
    ) -> Result<(), Error> {
        let [unknowns, blocks] = self.sizes;
        assert!([kept, smooth].iter().all(|mask| mask.len() == unknowns));
        assert!([hessians, inverses].iter().all(|list| list.len() == blocks));
        // SAFETY: the lengths are those of the matrix.
        checked("VecGetArray", unsafe {
            ss_krylov_linearize(
                self.raw.as_ptr(),
                kept.as_ptr(),
                smooth.as_ptr(),
                hessians.as_ptr(),
                inverses.as_ptr(),
            )
        })
    }

    /// Solves until the norm of the preconditioned residual is below `absolute`, or that of the load times `relative`;
    /// returns the iterations and that norm, negative after a breakdown.
    pub(crate) fn solve(
        &mut self,
        load: &[f64],
        x: &mut [f64],
        (relative, absolute): (f64, f64),
        most: usize,
    ) -> Result<(usize, f64), Error> {
        assert_eq!([load.len(), x.len()], [self.sizes[0]; 2]);
        let (mut iterations, mut error) = (0, 0.0);
        // SAFETY: load and solution are of the length of the matrix.
        checked("KSPSolve", unsafe {
            ss_krylov_solve(
                self.raw.as_ptr(),
                load.as_ptr(),
                x.as_mut_ptr(),
                relative,
                absolute,
                length(most)?,
                &mut iterations,
                &mut error,
            )
        })?;
        Ok((iterations as usize, error))
    }
}

impl Drop for Krylov {
    fn drop(&mut self) {
        // SAFETY: made by `new`, and given up here.
        unsafe { ss_krylov_free(self.raw.as_ptr()) };
    }
}
