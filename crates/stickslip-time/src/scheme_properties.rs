//! Properties of a scheme.

/// A stage of a step: the scheme itself over `share dt`, from `old + lead (now - old)`, to `old + end dt`.
///
/// `old` is the start of the step, and `now` the result of the stage before; the first stage starts at `old`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stage {
    /// The length of the stage over that of the step.
    pub share: f64,
    /// The start of the stage.
    pub lead: f64,
    /// The end of the stage, as a share of the step.
    pub end: f64,
}

/// Properties of a scheme, verified by [`check_rate_scheme`](crate::check_rate_scheme).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SchemeProperties {
    /// The order in time.
    pub order: usize,
    /// The order for a displacement without inertia, of which only the trapezoidal rule and schemes of
    /// several stages have more than one.
    pub quasi_static_order: usize,
    /// Whether a step back returns to the start of a step forward: the error then has even powers of the step only.
    pub symmetric: bool,
    /// The largest `omega dt` for which oscillations of the angular frequency `omega` stay bounded, `None`
    /// for a scheme that is stable for every step.
    pub stability_limit: Option<f64>,
    /// Whether the new velocity changes the displacement of the same step: the stiffness is then a part of the
    /// operator.
    pub implicit: bool,
    /// Whether the scheme stores a number per component besides the motion.
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
