//! Every number that decides something in a step or a run, with its source or the measurement behind it.

/// The numbers that decide in `step`, `contact` and `integrate`.
pub(crate) struct Numerics {
    /// Slopes of friction are sampled once in this factor of the slip rate: a direct effect changes by it in between.
    /// Slip rates wider apart by 4 on both sides refused 6825 of 7000 spring sliders' steps that are solved rightly.
    pub(crate) slope_spacing: f64,
    /// A certificate is looked for with weakening larger by this factor, to serve for the steps to come as well; then
    /// without it.
    pub(crate) certificate_margin: f64,
    /// Without inertia, the factor by which the rate of a step that resolves its decay may fall: the trapezoidal rule
    /// multiplies it by 1/3 where the step is the time of the decay.
    pub(crate) resolved_ratio: f64,
    /// The spectral radius where nothing resists a rate, and the trapezoidal rule alternates for ever: events of the paper's
    /// slider within 3 ms of those without damping.
    pub(crate) damped_radius: f64,
    /// The share of a velocity's norm below which rounding decides, whatever the tolerance.
    pub(crate) relative: f64,
    /// Iterations of a solver: 8113 multigrid cycles were seen on nearly incompressible cells.
    pub(crate) max_iterations: usize,
    /// The share of the tolerance to which the last velocity problems of a fixed point are solved...
    pub(crate) final_share: f64,
    /// ...and that of the expected change for those before: iteration counts are those of exact solves.
    pub(crate) forcing: f64,
    /// The answer of the velocity to what a relaxed state still lacks, in tolerances, above which a fixed point goes on:
    /// about 2 where the iterates are a geometric series.
    pub(crate) unsettled: f64,
    /// The velocity problems of a fixed point that are usually enough; only a step that takes more pays for knowing its
    /// rounding errors.
    pub(crate) patience: usize,
    /// The share that rounding may leave of a sum over a body: of the change of a velocity in an iteration (without it 15
    /// of 15 423 extreme cases do not end at the paper's tolerance), of what a viscosity that couples no vertices couples.
    pub(crate) rounding: f64,
    /// The shares of the way that Aitken's rule may choose.
    pub(crate) shares: [f64; 2],
    /// Newton's method for one slip rate squares a relative step of this size below rounding.
    pub(crate) last_step: f64,
    /// Evaluations of a scalar equation: a bracket of all positive numbers halves to rounding in 75.
    pub(crate) evaluations: usize,
    /// Slip rates, from creep to slip, at which the dependence of friction on the rate is looked for [m/s].
    pub(crate) sample_rates: [f64; 4],
    /// Steps of Lanczos' method, enough for ten digits of the largest eigenvalue of a mesh.
    pub(crate) lanczos_steps: usize,
    /// Where the largest eigenvalue has come to rest.
    pub(crate) eigenvalue_change: f64,
    /// The time over which prescribed velocities are differentiated where no step size is known yet, as a share of the
    /// time, or of 1 s before that: about the square root of rounding, at which the errors of a difference and of its
    /// rounding balance for data that change within that time.
    pub(crate) difference: f64,
    /// The part of the distance to a stop that rounding may take.
    pub(crate) slack: f64,
    /// The smallest substep over the step: ten halvings.
    pub(crate) smallest_substep: f64,
    /// The share of the tolerance at which a step aims (K. Gustafsson, ACM TOMS 20 (1994)).
    pub(crate) safety: f64,
    /// The same for a step that grows to twice the size at once.
    pub(crate) safety_of_twice: f64,
    /// The largest and the smallest ratio of successive steps.
    pub(crate) growth: f64,
    /// See there.
    pub(crate) shrink: f64,
    /// The size after a step that failed.
    pub(crate) after_failure: f64,
}

/// The numbers in use.
pub(crate) const NUMERICS: Numerics = Numerics {
    slope_spacing: 1.5,
    certificate_margin: 1.5,
    resolved_ratio: 3.0,
    damped_radius: 0.8,
    relative: 1e-14,
    max_iterations: 20_000,
    final_share: 0.05,
    forcing: 3e-3,
    unsettled: 4.0,
    patience: 8,
    rounding: 1e-12,
    shares: [0.05, 4.0],
    last_step: 1e-9,
    evaluations: 200,
    sample_rates: [1e-15, 1e-9, 1e-5, 0.1],
    lanczos_steps: 120,
    eigenvalue_change: 1e-10,
    difference: 1e-7,
    slack: 1e-9,
    smallest_substep: 1.0 / 1024.0,
    safety: 0.8,
    safety_of_twice: 0.5,
    growth: 4.0,
    shrink: 0.1,
    after_failure: 0.25,
};
