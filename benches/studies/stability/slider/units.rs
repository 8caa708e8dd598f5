//! Units other than metre and kilogram.

use stickslip::StepState;

/// The metre and the kilogram in the units of a scene; its second is the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Units {
    pub(super) length: f64,
    pub(super) mass: f64,
}

/// Metres and kilograms.
pub(super) const SI: Units = Units {
    length: 1.0,
    mass: 1.0,
};
/// Kilometres and megatonnes.
pub(super) const KM_MT: Units = Units {
    length: 1e-3,
    mass: 1e-9,
};
/// Powers of two, by which nothing is rounded.
pub(super) const BINARY: Units = Units {
    length: 1.0 / 1024.0,
    mass: 1.0 / (1u64 << 30) as f64,
};

impl Units {
    /// The unit of stress in `dimension` dimensions, in which a plane body has one of 1 m across.
    pub(super) fn stress(self, dimension: i32) -> f64 {
        self.mass * self.length.powi(2 - dimension)
    }

    /// That of density.
    pub(super) fn density(self, dimension: i32) -> f64 {
        self.mass * self.length.powi(-dimension)
    }

    /// That of the norm of velocities, the root of `mass length^2 / time^4` or `time^2`.
    pub(super) fn norm(self) -> f64 {
        self.mass.sqrt() * self.length
    }

    /// Puts what is known in SI units in the place of a state in these.
    pub(super) fn convert<const C: usize>(self, si: &StepState<C>, state: &mut StepState<C>) {
        for (state, si) in [
            (&mut state.displacement, &si.displacement),
            (&mut state.velocity, &si.velocity),
            (&mut state.acceleration, &si.acceleration),
        ] {
            for (state, si) in state.iter_mut().zip(si) {
                *state = si * self.length;
            }
        }
        for (state, si) in state.contacts.iter_mut().zip(&si.contacts) {
            state.states.clone_from(&si.states);
        }
    }
}
