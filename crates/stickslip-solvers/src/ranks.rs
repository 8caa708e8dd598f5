//! The processes that share a body.

use std::fmt;
use std::sync::Arc;

/// Sums and maxima over several processes, which all call them together.
pub trait Collective: Send + Sync {
    /// The sum of a number of each process.
    fn sum(&self, part: f64) -> f64;

    /// The largest of a number of each process, not below zero; NaN where one of them is NaN.
    fn largest(&self, part: f64) -> f64;
}

/// The processes that share the vertices of a body: one, or several with their [`Collective`].
///
/// Sums over the vertices of a body are sums over vertices here and then over ranks; with one process the latter costs
/// nothing.
#[derive(Clone, Default)]
pub struct Ranks(Option<Arc<dyn Collective>>);

impl Ranks {
    /// Several processes.
    pub fn several(collective: impl Collective + 'static) -> Self {
        Self(Some(Arc::new(collective)))
    }

    /// Whether the vertices here are those of one process of several.
    pub fn are_several(&self) -> bool {
        self.0.is_some()
    }

    /// The sum of a number of each process.
    #[inline]
    pub fn sum(&self, part: f64) -> f64 {
        self.0.as_ref().map_or(part, |ranks| ranks.sum(part))
    }

    /// The largest of a number of each process; NaN where one of them is NaN.
    #[inline]
    pub fn largest(&self, part: f64) -> f64 {
        self.0.as_ref().map_or(part, |ranks| ranks.largest(part))
    }

    /// Whether something holds in all processes.
    #[inline]
    pub fn all(&self, holds: bool) -> bool {
        match &self.0 {
            None => holds,
            Some(ranks) => ranks.largest(f64::from(u8::from(!holds))) == 0.0,
        }
    }

    /// Whether something holds in one process at least.
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
