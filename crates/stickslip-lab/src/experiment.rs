//! A record with its load history, as one of several in a fit.

use crate::load::LoadHistory;
use crate::parameter::Parameter;
use crate::record::Record;

/// A record, the history of its load point, and what is known of its machine.
///
/// ```
/// use stickslip_lab::{Experiment, LoadHistory, Record};
///
/// let record = Record::new(vec![0.0, 1.0, 2.0], vec![0.60, 0.61, 0.60])?;
/// let load = LoadHistory::new(1e-6, &[(0.5, 1e-5)])?;
/// let experiment = Experiment::new(&record, &load).with_stiffness(1500.0);
/// # Ok::<(), stickslip_lab::LabError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Experiment<'a> {
    pub(crate) record: &'a Record,
    pub(crate) load: &'a LoadHistory,
    pub(crate) fixed: Vec<(Parameter, f64)>,
}

impl<'a> Experiment<'a> {
    /// A record and the history of its load point.
    pub fn new(record: &'a Record, load: &'a LoadHistory) -> Self {
        Self {
            record,
            load,
            fixed: Vec::new(),
        }
    }

    /// Fixes `K/sigma_n` > 0 [1/m] of this record.
    #[must_use]
    pub fn with_stiffness(self, stiffness: f64) -> Self {
        self.with_fixed(Parameter::Stiffness, stiffness)
    }

    /// Fixes a parameter of this record: the stiffness, `mu0`, the trend, the step offset or the beginning. It goes before
    /// bounds of the fit.
    #[must_use]
    pub fn with_fixed(mut self, parameter: Parameter, value: f64) -> Self {
        self.fixed.retain(|fixed| fixed.0 != parameter);
        self.fixed.push((parameter, value));
        self
    }
}
