//! Rate- and state-dependent friction with a soft cut-off.

use stickslip::friction::{DieterichRuina, FrictionError, FrictionLaw};
use stickslip::state::LogTheta;

/// `mu = a ln(1 + V/Vm)`, positive and smooth where Dieterich's and Ruina's law `a ln(V/Vm)` is cut
/// off. It lies above that law by `a ln 2` at `V = Vm` and by less than `a Vm/V` beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SoftCutoff(pub(crate) DieterichRuina);

impl SoftCutoff {
    /// `ln(V/Vm)`. `Vm` itself underflows for old contacts; rates below the normal numbers count as
    /// the smallest of these.
    fn excess(&self, slip_rate: f64, state: LogTheta) -> f64 {
        slip_rate.max(f64::MIN_POSITIVE).ln() - self.0.ln_cutoff_rate(state)
    }
}

impl FrictionLaw for SoftCutoff {
    type State = LogTheta;

    // ln(1 + exp(t)), whose exponential must not overflow.
    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let t = self.excess(slip_rate, state);
        self.0.a * (t.max(0.0) + (-t.abs()).exp().ln_1p())
    }

    // a / (V + Vm)
    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.a / (slip_rate + self.0.ln_cutoff_rate(state).exp())
    }

    // a V ((1 + 1/y) ln(1 + y) - 1) with y = V/Vm: cancels where y is small, y/2 - y^2/6 there.
    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        let y = self.excess(slip_rate, state).exp();
        let mean = self.coefficient(slip_rate, state) * (1.0 + y.recip()) - self.0.a;
        slip_rate
            * if y > 1e-5 {
                mean
            } else {
                self.0.a * y * (0.5 - y / 6.0)
            }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        self.0.validate()
    }
}
