//! Friction of one vertex in one step: traction against slip rate.

use std::cell::Cell;

use stickslip_friction::{FrictionError, FrictionLaw, Radial};
use stickslip_state::{StateLaw, StateVariable};

use crate::scene::Scene;
use crate::state_update::{StateUpdate, StepStart};

/// The frictional traction of a vertex in one time step, as a function of its slip rate alone:
/// `tau(V) = c + abs(sigma_n) mu(V, alpha)` \[Pa\].
///
/// The state is either frozen, which is how a fixed point sees it, or eliminated: a function
/// `alpha(V)` of the slip rate by the step's own state update. A solver meets it inside
/// [`Radial`](stickslip_friction::Radial), whose force is then the area of the vertex.
///
/// Eliminated, the traction need not grow with the slip rate. Its slope is that of the whole,
/// `abs(sigma_n) (dmu/dV + dmu/dalpha dalpha/dV)`, and may be negative.
#[derive(Debug, Clone)]
pub struct InterfaceLaw<L: FrictionLaw, S: StateLaw> {
    pub(crate) friction: L,
    pub(crate) evolution: S,
    /// `c` \[Pa\].
    pub(crate) cohesion: f64,
    /// `abs(sigma_n)` \[Pa\].
    pub(crate) normal_stress: f64,
    /// The state in use, unless it is eliminated.
    pub(crate) state: S::State,
    pub(crate) eliminated: bool,
    /// The state for the slip rate of the last step, once it was asked for: where every search of this
    /// step starts. A start from what was found last would be nearer, but where a step has several
    /// solutions it may follow another one than that which continues the last step.
    pub(crate) guess: Cell<Option<S::State>>,
    pub(crate) start: StepStart<S::State>,
}

/// What the solver of a [`Simulation`](crate::Simulation) minimises at each frictional vertex.
pub type InterfacePotential<L, S> = Radial<InterfaceLaw<L, S>>;

impl<L: FrictionLaw, S: StateLaw> InterfaceLaw<L, S>
where
    L::State: From<S::State>,
{
    /// The potential of a frictional vertex of a scene that is at rest with a state.
    pub(crate) fn potential_of<Op, const C: usize>(
        scene: &Scene<Op, L, S, C>,
        k: usize,
        weight: f64,
        state: S::State,
    ) -> InterfacePotential<L, S>
    where
        L: Clone,
        S: Clone,
    {
        Radial {
            law: Self {
                friction: scene.friction.law.at(k).clone(),
                evolution: scene.state.law.at(k).clone(),
                cohesion: *scene.friction.cohesion.at(k),
                normal_stress: scene.friction.normal_stress.at(k).abs(),
                state,
                eliminated: false,
                guess: Cell::new(None),
                start: StepStart {
                    state,
                    slip_rate: 0.0,
                    dt: 0.0,
                    update: StateUpdate::default(),
                },
            },
            force: weight,
            state: (),
        }
    }

    /// The state at a slip rate; not a number where the law has no answer.
    #[inline]
    fn state_at(&self, slip_rate: f64) -> S::State {
        if self.eliminated {
            let advanced = self.start.advance(&self.evolution, slip_rate);
            advanced.unwrap_or_else(|_| S::State::from_value(f64::NAN))
        } else {
            self.state
        }
    }

    /// Traction and its slope.
    #[inline]
    fn traction(&self, slip_rate: f64) -> (f64, f64) {
        let state = self.state_at(slip_rate);
        let (coefficient, mut slope) =
            (self.friction).coefficient_and_slope(slip_rate, state.into());
        if self.eliminated {
            let sensitivity = self
                .friction
                .coefficient_state_slope(slip_rate, state.into());
            if sensitivity != 0.0 {
                slope += sensitivity
                    * conversion_slope::<S::State, L::State>(state)
                    * self.start.slope(&self.evolution, state, slip_rate);
            }
        }
        // 0 times an infinite slope is no curvature.
        let slope = if self.normal_stress > 0.0 {
            self.normal_stress * slope
        } else {
            0.0
        };
        (self.cohesion + self.normal_stress * coefficient, slope)
    }

    /// The slip rate with `viscosity V + tau(V) = drive` at the given state.
    fn frozen_slip_rate(&self, viscosity: f64, drive: f64, state: S::State) -> f64 {
        let pull = drive - self.cohesion;
        if pull <= 0.0 {
            return 0.0;
        }
        let (scaled_viscosity, scaled_pull) =
            (viscosity / self.normal_stress, pull / self.normal_stress);
        if scaled_viscosity.is_finite() && scaled_pull.is_finite() {
            self.friction
                .slip_rate(scaled_viscosity, scaled_pull, state.into())
        } else {
            // No normal stress, or one too small to matter.
            pull / viscosity
        }
    }

    /// The same with the state a function of the slip rate: Newton's method in `ln V` inside a
    /// bracket, from the slip rate for the state at the last step's.
    ///
    /// Where the left-hand side does not grow throughout, the result is one of the places at which
    /// it passes `drive` from below.
    fn eliminated_slip_rate(&self, viscosity: f64, drive: f64) -> f64 {
        /// Newton's method squares a relative step of this size below rounding.
        const LAST_STEP: f64 = 1e-9;
        const EVALUATIONS: usize = 200;
        let pull = drive - self.cohesion;
        if pull <= 0.0 {
            return 0.0;
        }
        let (mut lower, mut upper) = (0.0, pull / viscosity);
        let guess = self.guess.get().unwrap_or_else(|| {
            let guess = self.state_at(self.start.slip_rate);
            self.guess.set(Some(guess));
            guess
        });
        let mut rate = self.frozen_slip_rate(viscosity, drive, guess).min(upper);
        let sticks = || drive <= self.traction(0.0).0;
        if rate == 0.0 {
            if sticks() {
                return 0.0;
            }
            rate = upper.min(f64::MIN_POSITIVE);
        }
        for _ in 0..EVALUATIONS {
            let (traction, slope) = self.traction(rate);
            let excess = viscosity * rate + traction - drive;
            if excess < 0.0 {
                lower = rate;
            } else if excess > 0.0 {
                upper = rate;
            } else {
                // Balanced, or not a number.
                return if excess == 0.0 { rate } else { f64::NAN };
            }
            let step = -excess / (rate * (viscosity + slope));
            let newton = rate * step.exp();
            let inside = lower < newton && newton < upper;
            if inside && step.abs() <= LAST_STEP && viscosity + slope > 0.0 {
                return newton;
            }
            // A step against the bracket's sense starts where the left-hand side falls.
            let next = if inside && (step < 0.0) == (excess > 0.0) {
                newton
            } else if lower > 0.0 {
                lower.sqrt() * upper.min(f64::MAX).sqrt()
            } else if sticks() {
                return 0.0;
            } else {
                upper.min(f64::MAX).sqrt() * f64::MIN_POSITIVE.sqrt()
            };
            if !(lower < next && next < upper) || (upper - lower) <= 2.0 * f64::EPSILON * upper {
                return if upper <= f64::MIN_POSITIVE {
                    0.0
                } else {
                    upper
                };
            }
            rate = next;
        }
        rate
    }
}

/// The derivative of the state that friction reads in the one that is integrated, where they differ by
/// a central difference.
pub(crate) fn conversion_slope<T: StateVariable, U: StateVariable + From<T>>(state: T) -> f64 {
    const STEP: f64 = 6e-6;
    let x = state.value();
    let converted = |x: f64| U::from(T::from_value(x)).value();
    if converted(x) == x {
        return 1.0;
    }
    let (low, high) = (x - STEP * x.abs(), x + STEP * x.abs());
    (converted(high) - converted(low)) / (high - low)
}

/// The traction in place of a coefficient; the state is inside.
impl<L: FrictionLaw, S: StateLaw> FrictionLaw for InterfaceLaw<L, S>
where
    L::State: From<S::State>,
{
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        let state = self.state_at(slip_rate);
        self.cohesion + self.normal_stress * self.friction.coefficient(slip_rate, state.into())
    }

    fn coefficient_slope(&self, slip_rate: f64, (): ()) -> f64 {
        self.traction(slip_rate).1
    }

    fn coefficient_and_slope(&self, slip_rate: f64, (): ()) -> (f64, f64) {
        self.traction(slip_rate)
    }

    /// With an eliminated state by quadrature: Gauss's rule of three points on 256 panels that
    /// shrink towards rest.
    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        if !self.eliminated {
            let friction = self.friction.potential(slip_rate, self.state.into());
            return self.cohesion * slip_rate + self.normal_stress * friction;
        }
        const PANELS: usize = 256;
        const SHRINK: f64 = 0.75;
        let (mut right, mut sum) = (slip_rate, 0.0);
        for panel in 1..=PANELS {
            let left = if panel < PANELS { right * SHRINK } else { 0.0 };
            let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
            let offset = half * 0.6_f64.sqrt();
            let outer =
                self.coefficient(middle - offset, ()) + self.coefficient(middle + offset, ());
            sum += half * (5.0 * outer + 8.0 * self.coefficient(middle, ())) / 9.0;
            right = left;
        }
        sum
    }

    fn slip_rate(&self, viscosity: f64, drive: f64, (): ()) -> f64 {
        if self.eliminated {
            self.eliminated_slip_rate(viscosity, drive)
        } else {
            self.frozen_slip_rate(viscosity, drive, self.state)
        }
    }

    fn validate(&self) -> Result<(), FrictionError> {
        self.friction.validate()
    }
}
