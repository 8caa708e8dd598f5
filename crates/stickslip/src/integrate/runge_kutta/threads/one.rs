//! All cells in one thread.

use std::ops::Range;

/// The thread that calls.
#[derive(Clone, Copy)]
pub(in super::super) struct Threads;

impl Threads {
    pub(in super::super) fn new() -> Self {
        Self
    }

    pub(in super::super) fn work<R>(&mut self, _cells: usize, work: impl FnOnce() -> R) -> R {
        work()
    }
}

pub(in super::super) fn in_shares<R>(
    cells: usize,
    work: &impl Fn(Range<usize>) -> R,
    _join: &impl Fn(R, R) -> R,
) -> R {
    work(0..cells)
}

pub(in super::super) fn on_shares<T>(field: &mut [T], work: &impl Fn(usize, &mut [T])) {
    work(0, field);
}

pub(in super::super) fn on_two_shares<S, T>(
    first: &mut [S],
    second: &mut [T],
    work: &impl Fn(usize, &mut [S], &mut [T]),
) {
    work(0, first, second);
}
