//! Sums of multiples of shared interactions.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A multiple of an interaction, with the memory of its products.
pub(crate) struct Term<I, M> {
    pub(crate) factor: f64,
    pub(crate) interaction: Arc<I>,
    memory: Mutex<M>,
}

impl<I, M> Term<I, M> {
    /// The memory of products; whatever one that panicked has left there is overwritten.
    pub(crate) fn memory(&self) -> MutexGuard<'_, M> {
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<I, M: Clone> Clone for Term<I, M> {
    fn clone(&self) -> Self {
        Self {
            factor: self.factor,
            interaction: Arc::clone(&self.interaction),
            memory: Mutex::new(self.memory().clone()),
        }
    }
}

/// A sum of multiples of interactions, each of them once.
pub(crate) struct Terms<I, M>(Vec<Term<I, M>>);

impl<I, M: Clone> Clone for Terms<I, M> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<I, M> Terms<I, M> {
    /// No interaction.
    pub(crate) fn none() -> Self {
        Self(Vec::new())
    }

    /// An interaction, with the memory of its products.
    pub(crate) fn of(interaction: Arc<I>, memory: M) -> Self {
        Self(vec![Term {
            factor: 1.0,
            interaction,
            memory: Mutex::new(memory),
        }])
    }

    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Term<I, M>> {
        self.0.iter()
    }

    /// The terms that do not vanish.
    pub(crate) fn present(&self) -> impl Iterator<Item = &Term<I, M>> {
        self.0.iter().filter(|term| term.factor != 0.0)
    }
}

impl<I, M: Clone> Terms<I, M> {
    /// Overwrites itself by the sum of `factor * terms`. Allocates nothing for interactions that it has.
    pub(crate) fn set_sum<'a>(&mut self, all: impl Iterator<Item = (f64, &'a Self)>)
    where
        I: 'a,
        M: 'a,
    {
        self.0.iter_mut().for_each(|term| term.factor = 0.0);
        for (factor, terms) in all {
            for term in &terms.0 {
                let mut own = self.0.iter_mut();
                match own.find(|own| Arc::ptr_eq(&own.interaction, &term.interaction)) {
                    Some(own) => own.factor += factor * term.factor,
                    // Of another pattern: only what makes a combination comes here.
                    None => self.0.push(Term {
                        factor: factor * term.factor,
                        ..term.clone()
                    }),
                }
            }
        }
    }
}
