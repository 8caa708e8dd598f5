//! State laws behind pointers, and the state law `()` without a state.

use crate::{StateError, StateLaw};

macro_rules! forward {
    ($pointer:ty) => {
        impl<T: StateLaw + ?Sized> StateLaw for $pointer {
            type State = T::State;

            fn evolution(&self, state: Self::State, slip_rate: f64) -> f64 {
                (**self).evolution(state, slip_rate)
            }

            fn evolution_state_slope(&self, state: Self::State, slip_rate: f64) -> f64 {
                (**self).evolution_state_slope(state, slip_rate)
            }

            fn advance(
                &self,
                from: Self::State,
                slip_rate: f64,
                dt: f64,
            ) -> Result<Self::State, StateError> {
                (**self).advance(from, slip_rate, dt)
            }

            fn advance_exact(
                &self,
                from: Self::State,
                slip_rate: f64,
                dt: f64,
            ) -> Option<Self::State> {
                (**self).advance_exact(from, slip_rate, dt)
            }

            fn advance_rate_slope(
                &self,
                from: Self::State,
                to: Self::State,
                slip_rate: f64,
                dt: f64,
            ) -> f64 {
                (**self).advance_rate_slope(from, to, slip_rate, dt)
            }

            fn advance_at_constant_rate(
                &self,
                from: Self::State,
                slip_rate: f64,
                dt: f64,
            ) -> Result<Self::State, StateError> {
                (**self).advance_at_constant_rate(from, slip_rate, dt)
            }

            fn advance_at_constant_rate_rate_slope(
                &self,
                from: Self::State,
                to: Self::State,
                slip_rate: f64,
                dt: f64,
            ) -> f64 {
                (**self).advance_at_constant_rate_rate_slope(from, to, slip_rate, dt)
            }

            fn validate_state(&self, state: Self::State) -> Result<(), StateError> {
                (**self).validate_state(state)
            }

            fn validate(&self) -> Result<(), StateError> {
                (**self).validate()
            }
        }
    };
}

forward!(&T);
forward!(Box<T>);

/// No state, for friction that depends on the slip rate alone.
impl StateLaw for () {
    type State = ();

    fn evolution(&self, (): (), _slip_rate: f64) -> f64 {
        0.0
    }

    fn evolution_state_slope(&self, (): (), _slip_rate: f64) -> f64 {
        0.0
    }

    fn advance(&self, (): (), slip_rate: f64, dt: f64) -> Result<(), StateError> {
        StateError::check_step(slip_rate, dt)
    }

    fn advance_exact(&self, (): (), _slip_rate: f64, _dt: f64) -> Option<()> {
        Some(())
    }

    fn advance_rate_slope(&self, (): (), (): (), _slip_rate: f64, _dt: f64) -> f64 {
        0.0
    }

    fn advance_at_constant_rate_rate_slope(
        &self,
        (): (),
        (): (),
        _slip_rate: f64,
        _dt: f64,
    ) -> f64 {
        0.0
    }
}
