//! The factors of the last few operators.

use nalgebra::SMatrix;

use crate::dense::DenseMatrix;

/// A numeric factor and quantities derived from it.
#[derive(Debug)]
pub(super) struct Factor<const C: usize> {
    /// The blocks of its operator; empty if it belongs to none.
    ///
    /// A copy makes the comparison exact and takes a tenth of the factor or less: a step size that returns is
    /// recognised, and one that differs in its last bit is not taken for another.
    blocks: Vec<SMatrix<f64, C, C>>,
    pub(super) entries: Vec<f64>,
    /// `S`
    pub(super) schur: DenseMatrix,
    /// `E^T N E` by columns, with `N` the norm of the cache; empty until needed.
    pub(super) gram: Vec<f64>,
    used: u64,
}

/// Factors by operator; the least recently used is dropped first.
#[derive(Debug)]
pub(super) struct Cache<const C: usize> {
    pub(super) capacity: usize,
    factors: Vec<Factor<C>>,
    /// The blocks of `N`; empty while no change was measured.
    norm: Vec<SMatrix<f64, C, C>>,
    current: Option<usize>,
    clock: u64,
}

impl<const C: usize> Cache<C> {
    pub(super) fn new(capacity: usize) -> Self {
        Self {
            capacity,
            factors: Vec::new(),
            norm: Vec::new(),
            current: None,
            clock: 0,
        }
    }

    /// Drops all factors and frees their memory.
    pub(super) fn clear(&mut self) {
        self.factors.clear();
        self.norm.clear();
        self.current = None;
    }

    /// The factor in use.
    pub(super) fn current(&self) -> Option<&Factor<C>> {
        self.current.map(|k| &self.factors[k])
    }

    /// The factor in use, to be completed.
    pub(super) fn current_mut(&mut self) -> Option<&mut Factor<C>> {
        self.current.map(|k| &mut self.factors[k])
    }

    /// Sets another norm for measured changes, and drops the quantities derived from the last one.
    pub(super) fn measure_by(&mut self, blocks: &[SMatrix<f64, C, C>]) {
        if self.norm != blocks {
            self.norm.clear();
            self.norm.extend_from_slice(blocks);
            for factor in &mut self.factors {
                factor.gram = Vec::new();
            }
        }
    }

    /// Drops the least recently used factors until so many are left, the one in use among them.
    pub(super) fn shrink(&mut self, capacity: usize) {
        while self.factors.len() > capacity.max(1) {
            let ages = self.factors.iter().enumerate();
            let others = ages.filter(|&(k, _)| Some(k) != self.current);
            let Some((oldest, _)) = others.min_by_key(|(_, factor)| factor.used) else {
                return;
            };
            self.factors.remove(oldest);
            self.current = self.current.map(|k| k - usize::from(k > oldest));
        }
    }

    /// Marks no factor as in use.
    pub(super) fn suspend(&mut self) {
        self.current = None;
    }

    /// Puts the factor of an operator in use, if it is cached.
    pub(super) fn find(&mut self, blocks: &[SMatrix<f64, C, C>]) -> bool {
        self.current = (self.factors.iter()).position(|factor| factor.blocks == blocks);
        self.clock += 1;
        if let Some(k) = self.current {
            self.factors[k].used = self.clock;
        }
        self.current.is_some()
    }

    /// A slot for another factor, of at most `capacity`, with so many unknowns left: a new one, or the least recently
    /// used.
    pub(super) fn claim(
        &mut self,
        capacity: usize,
        entries: usize,
        unknowns: usize,
    ) -> &mut Factor<C> {
        self.factors.truncate(capacity.max(1));
        self.current = None;
        let vacant = self.factors.iter().position(|f| f.blocks.is_empty());
        let place = if let Some(vacant) = vacant {
            vacant
        } else if self.factors.len() < capacity {
            self.factors.push(Factor {
                blocks: Vec::new(),
                entries: vec![0.0; entries],
                schur: DenseMatrix::new(unknowns),
                gram: Vec::new(),
                used: 0,
            });
            self.factors.len() - 1
        } else {
            let ages = self.factors.iter().enumerate();
            ages.min_by_key(|(_, factor)| factor.used)
                .map_or(0, |(k, _)| k)
        };
        self.factors[place].blocks.clear();
        self.factors[place].gram.clear();
        self.factors[place].used = 0;
        &mut self.factors[place]
    }

    /// Puts the claimed factor, now filled, in use for an operator.
    pub(super) fn adopt(&mut self, blocks: &[SMatrix<f64, C, C>]) {
        let claimed = self.factors.iter().position(|f| f.blocks.is_empty());
        if let Some(k) = claimed {
            self.factors[k].blocks.extend_from_slice(blocks);
            self.factors[k].used = self.clock;
        }
        self.current = claimed;
    }
}
