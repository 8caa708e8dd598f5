//! The processes of a distributed body.

use std::fmt;
use std::sync::Arc;

/// Sums and maxima over several processes; all processes call them together.
pub trait Collective: Send + Sync {
    /// The sum of one number per process.
    fn sum(&self, part: f64) -> f64;

    /// The largest of one number per process, not below zero; NaN if one of them is NaN.
    fn largest(&self, part: f64) -> f64;
}

/// The processes that share the vertices of a body: one, or several with their [`Collective`].
///
/// Sums over the vertices of a body are local sums, followed by sums over ranks. With one process the latter cost
/// nothing.
#[derive(Clone, Default)]
pub struct Ranks(Option<Arc<dyn Collective>>);

impl Ranks {
    /// Several processes.
    pub fn several(collective: impl Collective + 'static) -> Self {
        Self(Some(Arc::new(collective)))
    }

    /// Whether the body is distributed over several processes.
    pub fn are_several(&self) -> bool {
        self.0.is_some()
    }

    /// The sum of one number per process.
    #[inline]
    pub fn sum(&self, part: f64) -> f64 {
        self.0.as_ref().map_or(part, |ranks| ranks.sum(part))
    }

    /// The largest of one number per process; NaN if one of them is NaN.
    #[inline]
    pub fn largest(&self, part: f64) -> f64 {
        self.0.as_ref().map_or(part, |ranks| ranks.largest(part))
    }

    /// Whether a condition holds in all processes.
    #[inline]
    pub fn all(&self, holds: bool) -> bool {
        match &self.0 {
            None => holds,
            Some(ranks) => ranks.largest(f64::from(u8::from(!holds))) == 0.0,
        }
    }

    /// Whether a condition holds in at least one process.
    #[inline]
    pub fn any(&self, holds: bool) -> bool {
        !self.all(!holds)
    }
}

impl fmt::Debug for Ranks {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = if self.are_several() { "several" } else { "one" };
        formatter.debug_tuple("Ranks").field(&name).finish()
    }
}
