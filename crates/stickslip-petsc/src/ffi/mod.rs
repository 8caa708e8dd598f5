//! The calls of the shim: all that is unsafe. What they are given is checked here, once.

mod multigrid;

use std::ffi::{c_int, c_void};

use crate::Error;

pub(crate) use multigrid::{Multigrid, RowsOf};

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
