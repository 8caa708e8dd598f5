//! Fields cut into parts for parallel work, with the feature `rayon` in several threads.
//!
//! Cuts depend on sizes alone, and sums are added in the order of the cuts: results are the same bits on any number of
//! threads.

use std::ops::Range;

/// Vertices per part: enough work for a thread.
const PART: usize = 8192;
/// Frictional vertices per part, each with evaluations of laws.
const CONTACT_PART: usize = 512;

/// Data that can be cut in two, given the number of vertices and of parts before the cut.
pub trait Divide: Sized + Send {
    /// The data before and after the cut.
    fn divide(self, vertices: usize, parts: usize) -> (Self, Self);
}

/// No fields: a sum may change nothing.
impl Divide for () {
    fn divide(self, _: usize, _: usize) -> (Self, Self) {
        ((), ())
    }
}

impl<T: Send> Divide for &mut [T] {
    fn divide(self, vertices: usize, _: usize) -> (Self, Self) {
        self.split_at_mut(vertices)
    }
}

impl<A: Divide, B: Divide> Divide for (A, B) {
    fn divide(self, vertices: usize, parts: usize) -> (Self, Self) {
        let (a, b) = (
            self.0.divide(vertices, parts),
            self.1.divide(vertices, parts),
        );
        ((a.0, b.0), (a.1, b.1))
    }
}

impl<A: Divide, B: Divide, T: Divide> Divide for (A, B, T) {
    fn divide(self, vertices: usize, parts: usize) -> (Self, Self) {
        let (a, (b, c)) = (
            self.0.divide(vertices, parts),
            (self.1, self.2).divide(vertices, parts),
        );
        ((a.0, b.0, b.1), (a.1, c.0, c.1))
    }
}

/// Entries with the same number for every part.
#[cfg(feature = "multigrid")]
pub(crate) struct Each<'a, T> {
    pub(crate) entries: &'a mut [T],
    pub(crate) per_part: usize,
}

#[cfg(feature = "multigrid")]
impl<T: Send> Divide for Each<'_, T> {
    fn divide(self, _: usize, parts: usize) -> (Self, Self) {
        let per_part = self.per_part;
        let (before, behind) = self.entries.split_at_mut(parts * per_part);
        let each = |entries| Self { entries, per_part };
        (each(before), each(behind))
    }
}

/// Runs both, in parallel if there are threads.
fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    // Alone in its pool, a thread from outside would wait for another one to do its work.
    #[cfg(feature = "rayon")]
    if rayon::current_num_threads() > 1 {
        return rayon::join(a, b);
    }
    (a(), b())
}

/// Works in a thread of the pool, if so many vertices are cut into parts.
#[cfg(feature = "sparse")]
pub(crate) fn inside<R: Send>(vertices: usize, work: impl FnOnce() -> R + Send) -> R {
    if vertices > PART { enter(work) } else { work() }
}

/// Works in a thread of the pool: nested parallel work is not handed over to the pool each time.
pub(crate) fn enter<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    #[cfg(feature = "rayon")]
    if rayon::current_num_threads() > 1 && rayon::current_thread_index().is_none() {
        return rayon::scope(|_| work());
    }
    work()
}

/// `work(k, fields)` on part `k` of the fields, vertices `cuts[k]..cuts[k + 1]`, for all of them; `fields` begin at
/// vertex `cuts[0]`.
#[cfg(feature = "sparse")]
pub(crate) fn for_each<F: Divide>(cuts: &[usize], fields: F, work: &(impl Fn(usize, F) + Sync)) {
    fn some<F: Divide>(begin: usize, cuts: &[usize], fields: F, work: &(impl Fn(usize, F) + Sync)) {
        let parts = cuts.len() - 1;
        if parts == 1 {
            return work(begin, fields);
        }
        let half = parts / 2;
        let (before, behind) = fields.divide(cuts[half] - cuts[0], half);
        join(
            || some(begin, &cuts[..=half], before, work),
            || some(begin + half, &cuts[half..], behind, work),
        );
    }
    if cuts.len() > 1 {
        some(0, cuts, fields, work);
    }
}

/// `work(vertices, fields)` on parts of the fields with the range of their vertices.
pub fn for_parts<F: Divide>(
    vertices: Range<usize>,
    fields: F,
    work: &(impl Fn(Range<usize>, F) + Sync),
) {
    sum_parts(vertices, fields, &|vertices, fields| {
        work(vertices, fields);
        0.0
    });
}

/// The sum of `work(vertices, fields)` over parts of the fields.
pub fn sum_parts<F: Divide>(
    vertices: Range<usize>,
    fields: F,
    work: &(impl Fn(Range<usize>, F) -> f64 + Sync),
) -> f64 {
    gather(PART, vertices, fields, work, &|a, b| a + b)
}

/// The results of `work(places, fields)` on parts of a contact, whose vertices cost more than others; places are
/// positions among the frictional vertices. `both` combines the results of two neighbouring parts.
pub fn gather_contact<F: Divide, T: Send>(
    places: usize,
    fields: F,
    work: &(impl Fn(Range<usize>, F) -> T + Sync),
    both: &(impl Fn(T, T) -> T + Sync),
) -> T {
    inside_contact(places, || {
        gather(CONTACT_PART, 0..places, fields, work, both)
    })
}

/// `work(places, fields)` on parts of a contact, see [`gather_contact`].
pub fn for_contact<F: Divide>(places: usize, fields: F, work: &(impl Fn(Range<usize>, F) + Sync)) {
    gather_contact(places, fields, work, &|(), ()| ());
}

/// Works in a thread of the pool, if a contact of so many vertices is cut into parts.
pub(crate) fn inside_contact<R: Send>(places: usize, work: impl FnOnce() -> R + Send) -> R {
    if places > CONTACT_PART {
        enter(work)
    } else {
        work()
    }
}

/// The results of `work` on parts of at most so many vertices.
fn gather<F: Divide, T: Send>(
    part: usize,
    vertices: Range<usize>,
    fields: F,
    work: &(impl Fn(Range<usize>, F) -> T + Sync),
    both: &(impl Fn(T, T) -> T + Sync),
) -> T {
    let count = vertices.len();
    if count <= part {
        return work(vertices, fields);
    }
    let half = vertices.start + count / 2;
    let (before, behind) = fields.divide(count / 2, 0);
    let (a, b) = join(
        || gather(part, vertices.start..half, before, work, both),
        || gather(part, half..vertices.end, behind, work, both),
    );
    both(a, b)
}
