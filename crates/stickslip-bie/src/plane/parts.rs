//! Parts of a product, in threads if the feature `rayon` is on. Parts are independent, so that bits depend neither on
//! their order nor on threads.

/// The most multiplications that are not worth the threads: from within them, where a call takes about a microsecond, and
/// from outside, where it takes some 80.
#[cfg(feature = "rayon")]
const CALLS: [usize; 2] = [1 << 16, 1 << 21];

/// The order and the place of the work on parts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Schedule {
    pub(crate) in_threads: bool,
    /// Begins with the last part.
    pub(crate) backwards: bool,
}

/// Works in the threads if so many multiplications are worth it, else in this one; passes on which.
pub(crate) fn schedule(multiplications: usize, work: impl FnOnce(bool) + Send) {
    #[cfg(feature = "rayon")]
    if rayon::current_num_threads() > 1 {
        if rayon::current_thread_index().is_some() {
            work(multiplications > CALLS[0]);
            return;
        }
        if multiplications > CALLS[1] {
            // One call from outside for all that follows.
            rayon::scope(|_| work(true));
            return;
        }
    }
    let _ = multiplications;
    work(false);
}

/// Works on each part.
pub(crate) fn for_each<T: Send>(
    parts: &mut [T],
    schedule: Schedule,
    work: &(impl Fn(&mut T) + Sync),
) {
    let Schedule {
        in_threads,
        backwards,
    } = schedule;
    #[cfg(feature = "rayon")]
    if in_threads {
        let most = parts.len().div_ceil(rayon::current_num_threads());
        in_shares(parts, most, backwards, work);
        return;
    }
    let _ = in_threads;
    one_after_the_other(parts, backwards, work);
}

/// Each thread has the same parts in every product, and finds them in its cache.
#[cfg(feature = "rayon")]
fn in_shares<T: Send>(
    parts: &mut [T],
    most: usize,
    backwards: bool,
    work: &(impl Fn(&mut T) + Sync),
) {
    if parts.len() <= most {
        one_after_the_other(parts, backwards, work);
        return;
    }
    let shares = parts.len().div_ceil(most);
    let (first, second) = parts.split_at_mut(shares / 2 * most);
    rayon::join(
        || in_shares(first, most, backwards, work),
        || in_shares(second, most, backwards, work),
    );
}

fn one_after_the_other<T>(parts: &mut [T], backwards: bool, work: &impl Fn(&mut T)) {
    if backwards {
        parts.iter_mut().rev().for_each(work);
    } else {
        parts.iter_mut().for_each(work);
    }
}
