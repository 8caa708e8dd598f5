//! All processes of a run.

use std::fmt::Display;
use std::process::ExitCode;
use std::thread::sleep;
use std::time::Duration;

use serde::Serialize;
use serde::de::DeserializeOwned;

use stickslip::solvers::Collective;

use crate::{Error, ffi};

/// The processes of a run, and which of them this one is. All of them call each function together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct World {
    rank: usize,
    size: usize,
}

impl World {
    /// One process that speaks with no other.
    pub(crate) fn alone() -> Self {
        Self { rank: 0, size: 1 }
    }

    /// The number of this process, from 0.
    pub fn rank(self) -> usize {
        self.rank
    }

    /// The number of processes.
    pub fn size(self) -> usize {
        self.size
    }

    /// Whether this is the process that reports.
    pub fn is_first(self) -> bool {
        self.rank == 0
    }

    /// The sum over all processes.
    pub fn sum(self, part: f64) -> f64 {
        let mut all = [part];
        self.sum_each(&mut all);
        all[0]
    }

    /// Each number by its sum over all processes.
    pub fn sum_each(self, parts: &mut [f64]) {
        if self.size > 1 {
            or_abort(ffi::sum(parts));
        }
    }

    /// The maximum over all processes; NaN if one of them is.
    pub fn largest(self, part: f64) -> f64 {
        if self.size == 1 {
            return part;
        }
        let mut all = [
            if part.is_nan() {
                f64::NEG_INFINITY
            } else {
                part
            },
            f64::from(u8::from(part.is_nan())),
        ];
        or_abort(ffi::max(&mut all));
        if all[1] > 0.0 { f64::NAN } else { all[0] }
    }

    /// Whether something holds in all processes.
    pub fn all(self, holds: bool) -> bool {
        self.size == 1 && holds || self.size > 1 && self.largest(f64::from(u8::from(!holds))) == 0.0
    }

    /// Sends one list to each process, and returns the lists received.
    pub(crate) fn all_to_all(self, lists: &[Vec<u64>]) -> Result<Vec<Vec<u64>>, Error> {
        assert_eq!(lists.len(), self.size);
        ffi::all_to_all(lists)
    }

    /// The contributions of all processes, in the first one; nothing in the others.
    pub(crate) fn to_first(self, list: Vec<u64>) -> Result<Vec<Vec<u64>>, Error> {
        let mut lists = vec![Vec::new(); self.size];
        lists[0] = list;
        self.all_to_all(&lists)
    }

    /// The bytes of the first process, whatever those of the others.
    pub(crate) fn broadcast(self, bytes: &[u8]) -> Result<Vec<u8>, Error> {
        let list = if self.is_first() {
            packed(bytes)
        } else {
            Vec::new()
        };
        let lists = self.all_to_all(&vec![list; self.size])?;
        Ok(unpacked(&lists[0]))
    }

    /// The values of all processes in the order of their numbers, in the first one; nothing in the others.
    ///
    /// # Errors
    /// [`Error::Encoding`] for what cannot be sent, [`Error::Elsewhere`] in the other processes then, and failures of
    /// MPI.
    pub fn collect<T: Serialize + DeserializeOwned>(self, part: &T) -> Result<Vec<T>, Error> {
        let encoded = postcard::to_stdvec(part);
        let all = self.all(encoded.is_ok());
        let list = packed(&encoded.map_err(unencoded)?);
        if !all {
            return Err(Error::Elsewhere);
        }
        let lists = self.to_first(list)?;
        let parts = lists.iter().filter(|list| !list.is_empty());
        let parts = parts.map(|list| postcard::from_bytes(&unpacked(list)));
        parts.collect::<Result<_, _>>().map_err(unencoded)
    }

    /// The same number of every process.
    pub(crate) fn gather(self, number: u64) -> Result<Vec<u64>, Error> {
        let lists = self.all_to_all(&vec![vec![number]; self.size])?;
        Ok(lists.into_iter().flatten().collect())
    }
}

/// The number of bytes, then the bytes, eight a word.
fn packed(bytes: &[u8]) -> Vec<u64> {
    let words = bytes.chunks(8).map(|chunk| {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        u64::from_le_bytes(word)
    });
    std::iter::once(bytes.len() as u64).chain(words).collect()
}

fn unpacked(words: &[u64]) -> Vec<u8> {
    let Some((&count, words)) = words.split_first() else {
        return Vec::new();
    };
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    bytes.take(count as usize).collect()
}

/// The time for which a process delays its message: the process with the reason, or the first one, reports before.
const PATIENCE: Duration = Duration::from_secs(2);

/// Runs a program in every process, and ends all of them where it fails in one, with its message.
///
/// Simulations and solvers have to be dropped by `program`, as is everything that it makes and does not leak. They are
/// called from the thread that it runs in.
pub fn run<E: Display>(program: impl FnOnce(World) -> Result<(), E>) -> ExitCode {
    let (rank, size) = match ffi::begin() {
        Ok(found) => found,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::FAILURE;
        }
    };
    let world = World { rank, size };
    if let Err(problem) = program(world) {
        let message = problem.to_string();
        if rank > 0 {
            sleep(PATIENCE);
        }
        if message.contains("another process has failed") {
            sleep(2 * PATIENCE);
        }
        fail(rank, &message);
    }
    match ffi::end() {
        Ok(()) => ExitCode::SUCCESS,
        Err(_) => ExitCode::FAILURE,
    }
}

fn unencoded(source: postcard::Error) -> Error {
    Error::Encoding(Box::new(source))
}

/// Ends all processes with a message.
pub(crate) fn fail(rank: usize, message: &str) {
    eprintln!("error in process {rank}: {message}");
    ffi::abort();
}

/// Ends all processes where MPI itself fails, behind which none of them can be reached.
pub(crate) fn or_abort<T>(result: Result<T, Error>) -> Option<T> {
    result.map_err(|error| fail(0, &error.to_string())).ok()
}

/// The most memory that this process has had so far \[MB\], by Linux; not a number elsewhere.
pub fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse().ok());
    kilobytes.map_or(f64::NAN, |kilobytes: f64| kilobytes / 1024.0)
}

impl Collective for World {
    fn sum(&self, part: f64) -> f64 {
        World::sum(*self, part)
    }

    fn largest(&self, part: f64) -> f64 {
        World::largest(*self, part)
    }
}
