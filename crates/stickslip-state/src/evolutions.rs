//! The rates of many states at once.

/// The rates of the states of many nodes, for the passes of explicit methods: what
/// [`StateLaw::evolutions`](crate::StateLaw::evolutions) prepares from the laws of the nodes.
///
/// ```
/// use stickslip_state::{Dieterich, Evolutions, LogTheta, StateLaw};
///
/// let laws = [Dieterich { slip_distance: 8e-3 }];
/// let many = Dieterich::evolutions(&laws).expect("it has passes of its own");
/// let mut rates = [0.0; 2];
/// many.evolutions(0, &[LogTheta(3.0); 2], &[1e-9, 1e-3], &mut rates);
/// let each = laws[0].evolution(LogTheta(3.0), 1e-3);
/// assert!((rates[1] - each).abs() < 1e-15);
/// ```
pub trait Evolutions<S>: Send + Sync {
    /// `alpha'` of the nodes from the `first` on, by their states and slip rates `V >= 0` [m/s], to rounding as
    /// [`StateLaw::evolution`](crate::StateLaw::evolution) of each.
    fn evolutions(&self, first: usize, states: &[S], slip_rates: &[f64], rates: &mut [f64]);
}
