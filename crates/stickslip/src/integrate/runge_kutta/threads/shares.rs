//! Cells in equal shares of the threads.

use std::ops::Range;
use std::time::Duration;

use super::awake::{PATIENCE, with_threads_awake};

/// The least number of cells whose steps use threads: two of them took 3 % less time than one for 1440 cells, and 21 % less
/// for 2560.
const LEAST: usize = 1 << 10;

/// The threads of the pool.
#[derive(Clone, Copy)]
pub(in super::super) struct Threads {
    /// How long those are waited for that sleep.
    patience: Duration,
}

impl Threads {
    pub(in super::super) fn new() -> Self {
        Self { patience: PATIENCE }
    }

    /// Works with all threads awake, if there are enough cells.
    pub(in super::super) fn work<R: Send>(
        &mut self,
        cells: usize,
        work: impl FnOnce() -> R + Send,
    ) -> R {
        if cells < LEAST || rayon::current_num_threads() == 1 {
            return work();
        }
        with_threads_awake(&mut self.patience, work)
    }
}

/// The most entries of a share; none outside of the threads, and of too few cells.
fn most(cells: usize) -> Option<usize> {
    let is_worth_it = cells >= LEAST && rayon::current_thread_index().is_some();
    is_worth_it.then(|| cells.div_ceil(rayon::current_num_threads()))
}

/// Where shares of at most `most` entries are parted.
fn middle(cells: usize, most: usize) -> usize {
    cells.div_ceil(most) / 2 * most
}

/// Works on each share of the cells, and joins the results of neighbouring shares in their order.
pub(in super::super) fn in_shares<R: Send>(
    cells: usize,
    work: &(impl Fn(Range<usize>) -> R + Sync),
    join: &(impl Fn(R, R) -> R + Sync),
) -> R {
    match most(cells) {
        Some(most) => in_share(0..cells, most, work, join),
        None => work(0..cells),
    }
}

fn in_share<R: Send>(
    cells: Range<usize>,
    most: usize,
    work: &(impl Fn(Range<usize>) -> R + Sync),
    join: &(impl Fn(R, R) -> R + Sync),
) -> R {
    if cells.len() <= most {
        return work(cells);
    }
    let middle = cells.start + middle(cells.len(), most);
    let (first, second) = rayon::join(
        || in_share(cells.start..middle, most, work, join),
        || in_share(middle..cells.end, most, work, join),
    );
    join(first, second)
}

/// Works on each share of a field, with the number of its first entry.
pub(in super::super) fn on_shares<T: Send>(
    field: &mut [T],
    work: &(impl Fn(usize, &mut [T]) + Sync),
) {
    match most(field.len()) {
        Some(most) => on_share(0, field, most, work),
        None => work(0, field),
    }
}

fn on_share<T: Send>(
    first: usize,
    field: &mut [T],
    most: usize,
    work: &(impl Fn(usize, &mut [T]) + Sync),
) {
    if field.len() <= most {
        return work(first, field);
    }
    let middle = middle(field.len(), most);
    let (left, right) = field.split_at_mut(middle);
    rayon::join(
        || on_share(first, left, most, work),
        || on_share(first + middle, right, most, work),
    );
}

/// Works on each share of two fields of the same size, of which the second may be empty, with the number of the first entry.
pub(in super::super) fn on_two_shares<S: Send, T: Send>(
    first: &mut [S],
    second: &mut [T],
    work: &(impl Fn(usize, &mut [S], &mut [T]) + Sync),
) {
    match most(first.len()) {
        Some(most) => on_two(0, (first, second), most, work),
        None => work(0, first, second),
    }
}

fn on_two<S: Send, T: Send>(
    at: usize,
    (first, second): (&mut [S], &mut [T]),
    most: usize,
    work: &(impl Fn(usize, &mut [S], &mut [T]) + Sync),
) {
    if first.len() <= most {
        return work(at, first, second);
    }
    let middle = middle(first.len(), most);
    let left = first.split_at_mut(middle);
    let right = second.split_at_mut(middle.min(second.len()));
    rayon::join(
        || on_two(at, (left.0, right.0), most, work),
        || on_two(at + middle, (left.1, right.1), most, work),
    );
}
