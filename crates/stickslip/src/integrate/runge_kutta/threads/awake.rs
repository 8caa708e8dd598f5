//! Work in the threads of rayon's pool, which stay awake as long as it lasts.
//!
//! A thread that finds nothing to do falls asleep, and takes some 50 microseconds to wake: as long as all that is
//! computed between two joins of a step of some thousand cells.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use rayon::Yield;

/// The longest wait for a thread to wake. If a worker does not arrive in time, the next wait
/// is halved.
pub(super) const PATIENCE: Duration = Duration::from_micros(200);

/// Works in this thread of the pool, or in one of them if it is called from outside, with the others awake.
pub(super) fn with_threads_awake<R: Send>(
    patience: &mut Duration,
    work: impl FnOnce() -> R + Send,
) -> R {
    let watch = Watch {
        others: rayon::current_num_threads() - 1,
        patience: *patience,
        searching: AtomicUsize::new(0),
        begun: AtomicBool::new(false),
        over: AtomicBool::new(false),
    };
    let (result, came) = watch.offer(watch.others, work);
    *patience = if came { PATIENCE } else { *patience / 2 };
    result
}

/// The state of the work that the threads share.
///
/// The work waits for whom it has given parts of itself. A thread that searched in the middle of such a part would wait
/// for the work, and neither would return; so none begins to search once the work has begun.
struct Watch {
    others: usize,
    patience: Duration,
    searching: AtomicUsize,
    begun: AtomicBool,
    over: AtomicBool,
}

impl Watch {
    /// Offers a search to so many threads and works; whether all of them came.
    fn offer<R: Send>(&self, threads: usize, work: impl FnOnce() -> R + Send) -> (R, bool) {
        if threads > 0 {
            return rayon::join(|| self.offer(threads - 1, work), || self.search()).0;
        }
        let came = self.wait();
        self.begun.store(true, Ordering::Release);
        // After a panic, too.
        let _over = Over(&self.over);
        (work(), came)
    }

    fn wait(&self) -> bool {
        let offered = Instant::now();
        while self.searching.load(Ordering::Relaxed) < self.others {
            if offered.elapsed() > self.patience {
                return false;
            }
            spin_loop();
        }
        true
    }

    /// Takes the parts that the work gives away, until the work is over.
    fn search(&self) {
        if self.begun.load(Ordering::Acquire) {
            return;
        }
        self.searching.fetch_add(1, Ordering::Relaxed);
        while !self.begun.load(Ordering::Acquire) {
            spin_loop();
        }
        while !self.over.load(Ordering::Acquire) {
            if rayon::yield_now() != Some(Yield::Executed) {
                thread::yield_now();
            }
        }
    }
}

struct Over<'a>(&'a AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}
