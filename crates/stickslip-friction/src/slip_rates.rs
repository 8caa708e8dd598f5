//! The local problems of many nodes at once.

/// The slip rates of many nodes in balance with their forces, for the passes of explicit methods: what
/// [`FrictionLaw::slip_rates`](crate::FrictionLaw::slip_rates) prepares from the laws of the nodes.
///
/// ```
/// use stickslip_friction::{FrictionLaw, RegularizedDieterichRuina, SlipRates};
/// use stickslip_state::LogTheta;
///
/// let law = RegularizedDieterichRuina {
///     a: 0.010,
///     b: 0.015,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 8e-3,
/// };
/// let many = RegularizedDieterichRuina::slip_rates(&[law]).expect("it has passes of its own");
/// // Radiation damping over the normal stress, and shear stress over it.
/// let (viscosity, state) = (4.6e6 / 50e6, LogTheta(8.0));
/// let mut rates = [0.0; 2];
/// many.slip_rates(0, [&[viscosity; 2], &[0.6, 0.7]], &[state; 2], &mut rates);
/// assert!((rates[1] / law.slip_rate(viscosity, 0.7, state) - 1.0).abs() < 1e-12);
/// ```
pub trait SlipRates<S>: Send + Sync {
    /// The `V` with `viscosity V + mu(V, alpha) = drive` of the nodes from the `first` on, for `viscosity > 0` \[s/m\] and
    /// `drive >= 0`, as accurate as [`FrictionLaw::slip_rate`](crate::FrictionLaw::slip_rate) is to be.
    fn slip_rates(&self, first: usize, problem: [&[f64]; 2], states: &[S], slip_rates: &mut [f64]);

    /// `dmu/dV` \[s/m\] and `dmu/dalpha` of the nodes from the `first` on, at `V > 0`; any value at rest.
    fn slopes(&self, first: usize, slip_rates: &[f64], states: &[S], slopes: [&mut [f64]; 2]);
}
