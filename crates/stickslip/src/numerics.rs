//! All numerical constants that decide in a step or a run, with their source or measurement.

/// The constants of `step`, `contact` and `integrate`.
pub(crate) struct Numerics {
    /// The cosine of 30 degrees: normals that differ by less are those of one smooth surface. With meshes it is theirs.
    pub(crate) smooth: f64,
    /// The sampling ratio of slip rates for slopes of friction: the slope of a direct effect changes by it between two
    /// samples. Slip rates up to a factor of 4 beyond both ends of a step refused 6825 of 7000 correctly solved steps
    /// of spring sliders.
    pub(crate) slope_spacing: f64,
    /// Without inertia, the largest factor by which the rate of a step that resolves its decay falls: the trapezoidal
    /// rule multiplies the rate by 1/3 where the step is the decay time.
    pub(crate) resolved_ratio: f64,
    /// The spectral radius where no friction or viscosity resists a rate and the trapezoidal rule would oscillate:
    /// events of the paper's slider occur within 3 ms of those without damping.
    pub(crate) damped_radius: f64,
    /// The share of a velocity's norm below which rounding dominates, whatever the tolerance.
    pub(crate) relative: f64,
    /// The limit of solver iterations: nearly incompressible cells needed up to 8113 multigrid cycles.
    pub(crate) max_iterations: usize,
    /// The share of the tolerance to which the last velocity problems of a fixed point are solved.
    pub(crate) final_share: f64,
    /// The share of the expected change to which the earlier ones are solved: iteration counts equal those of exact
    /// solves.
    pub(crate) forcing: f64,
    /// The response of the velocity to the remaining change of a relaxed state, in tolerances, above which a fixed
    /// point continues: about 2 where the iterates are a geometric series.
    pub(crate) unsettled: f64,
    /// The usual number of velocity problems of a fixed point; only a step that needs more computes its rounding
    /// errors.
    pub(crate) patience: usize,
    /// The share that rounding leaves of a sum over a body: of the change of a velocity in an iteration (without it 15
    /// of 15 423 extreme cases do not converge to the paper's tolerance), and of the coupling by a viscosity that
    /// couples no vertices.
    pub(crate) rounding: f64,
    /// The range of relaxation factors for Aitken's formula.
    pub(crate) shares: [f64; 2],
    /// The relative step of Newton's method for one slip rate after which its quadratic convergence reaches rounding.
    pub(crate) last_step: f64,
    /// The limit of evaluations of a scalar equation: bisection of all positive numbers reaches rounding in 75.
    pub(crate) evaluations: usize,
    /// Slip rates, from creep to seismic slip, at which the rate dependence of friction is sampled [m/s].
    pub(crate) sample_rates: [f64; 4],
    /// Steps of Lanczos' method, sufficient for ten digits of the largest eigenvalue of a mesh.
    pub(crate) lanczos_steps: usize,
    /// The relative change below which the largest eigenvalue has converged.
    pub(crate) eigenvalue_change: f64,
    /// The same for the largest rate of relaxation, by which constant explicit steps are refused: beyond the limit
    /// by this share an error grows by some millionths per step.
    pub(crate) relaxation_change: f64,
    /// The time increment for differences of prescribed velocities before a step size is known, as a share of the time,
    /// or of 1 s before that: about the square root of rounding. There truncation and rounding errors of the difference
    /// balance for data that change within that time.
    pub(crate) difference: f64,
    /// The share of the distance to a stop that rounding can cause.
    pub(crate) slack: f64,
    /// The smallest substep over the step: ten halvings.
    pub(crate) smallest_substep: f64,
    /// The share of the tolerance that the next step aims at (K. Gustafsson, ACM TOMS 20 (1994)).
    pub(crate) safety: f64,
    /// The same for a step that doubles at once.
    pub(crate) safety_of_twice: f64,
    /// The largest ratio of successive steps.
    pub(crate) growth: f64,
    /// The smallest ratio of successive steps.
    pub(crate) shrink: f64,
}

/// The values in use.
pub(crate) const NUMERICS: Numerics = Numerics {
    smooth: 0.866_025_403_784_438_6,
    slope_spacing: 1.5,
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
    relaxation_change: 1e-6,
    difference: 1e-7,
    slack: 1e-9,
    smallest_substep: 1.0 / 1024.0,
    safety: 0.8,
    safety_of_twice: 0.5,
    growth: 4.0,
    shrink: 0.1,
};

// Meshes cut smooth surfaces by the same angle.
#[cfg(feature = "fem")]
const _: () = assert!(NUMERICS.smooth == stickslip_fem::SMOOTH);
