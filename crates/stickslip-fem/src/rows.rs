//! The rows of an operator in parts that are assembled in parallel, with the feature `rayon` in several threads.

use std::ops::Range;

/// Smallest number of rows of a part: enough work for a thread.
const PART: usize = 2048;

/// Calls `work(rows, values)` for parts of the rows with their values; those of row `p` begin at `starts[p]`.
///
/// A part changes only its own rows: values do not depend on the cuts, and these may depend on the threads.
pub(crate) fn for_rows<T: Send>(
    starts: &[u32],
    values: &mut [T],
    work: &(impl Fn(Range<u32>, &mut [T]) + Sync),
) {
    let rows = starts.len() - 1;
    let parts = (rows / PART).clamp(1, most_parts());
    some(parts, 0..rows as u32, starts, values, work);
}

/// The largest number of parts that pays: several per thread, in case one is delayed.
fn most_parts() -> usize {
    #[cfg(feature = "rayon")]
    match rayon::current_num_threads() {
        0 | 1 => 1,
        threads => 2 * threads,
    }
    #[cfg(not(feature = "rayon"))]
    1
}

fn some<T: Send>(
    parts: usize,
    rows: Range<u32>,
    starts: &[u32],
    values: &mut [T],
    work: &(impl Fn(Range<u32>, &mut [T]) + Sync),
) {
    if parts == 1 {
        return work(rows, values);
    }
    let half = parts / 2;
    let cut = rows.start + (rows.len() * half / parts) as u32;
    let first = starts[rows.start as usize];
    let (before, behind) = values.split_at_mut((starts[cut as usize] - first) as usize);
    join(
        || some(half, rows.start..cut, starts, before, work),
        || some(parts - half, cut..rows.end, starts, behind, work),
    );
}

#[cfg(feature = "rayon")]
use rayon::join;

#[cfg(not(feature = "rayon"))]
fn join(a: impl FnOnce(), b: impl FnOnce()) {
    a();
    b();
}
