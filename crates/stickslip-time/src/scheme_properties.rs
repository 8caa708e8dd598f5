//! What is known of a scheme.

/// A part of a step: the scheme itself over `share dt`, from `old + lead (now - old)`, to `old + end dt`.
///
/// `old` is where the step began and `now` what the stage before made of it; the first stage starts at
/// `old`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// The length of the stage over that of the step.
    pub share: f64,
    /// Where the stage starts.
    pub lead: f64,
    /// The time it leads to, as a share of the step.
    pub end: f64,
}

/// What is known of a scheme; [`check_rate_scheme`](crate::check_rate_scheme) finds out whether it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SchemeProperties {
    /// The order in time.
    pub order: usize,
    /// The order for a displacement without inertia, of which only the trapezoidal rule and schemes of
    /// several stages have more than one.
    pub quasi_static_order: usize,
    /// Whether a step back leads to where a step forth began, so that the error has even powers of the step
    /// only.
    pub symmetric: bool,
    /// The largest `omega dt` for which oscillations of the angular frequency `omega` stay bounded, `None`
    /// for a scheme that is stable for every step.
    pub stability_limit: Option<f64>,
    /// Whether the new velocity moves the displacement of the same step, so that the stiffness is a part of
    /// the operator.
    pub implicit: bool,
    /// Whether a number a component is carried on beside the motion.
    pub has_algorithmic: bool,
    /// The parts of a step, in order; the last one ends it.
    pub stages: &'static [Stage],
}

impl SchemeProperties {
    /// One stage, of first order, stable for every step.
    pub const FIRST_ORDER: Self = Self {
        order: 1,
        quasi_static_order: 1,
        symmetric: false,
        stability_limit: None,
        implicit: true,
        has_algorithmic: false,
        stages: &[Stage {
            share: 1.0,
            lead: 0.0,
            end: 1.0,
        }],
    };
}
