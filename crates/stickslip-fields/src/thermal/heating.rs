//! Heat of friction.

use stickslip_core::lanes::{LANES, Parameter, run};

use super::block::Step;
use super::modes::{DEFAULT, Modes};
use super::parameters::parameter;
use super::passes::{Add, Advance, Heat, Term};
use super::{ShearZone, ThermalError};
use crate::{FaultField, FaultRates, FieldError, FieldSizes, Reading};

/// The temperature of a shear zone that friction heats, without a pore fluid.
///
/// ```text
/// T' = alpha_th d2T/dz2 + tau V g(z)/(rho c),     g(z) = exp(-z^2/(2 w^2))/(w sqrt(2 pi))
/// ```
///
/// with the frictional strength `tau` \[Pa\], the slip rate `V` [m/s] and the parameters of a [`ShearZone`]; `T` is that of
/// its centre. It adds no pressure: friction does not see it.
///
/// ```
/// use stickslip_fields::{FaultField, ShearHeating, ShearZone};
///
/// // 30 MPa and 1 m/s for 1 s, in 2 cm around the centre.
/// let zone = ShearZone {
///     half_width: 0.02.into(),
///     volumetric_heat_capacity: 2.7e6.into(),
///     thermal_diffusivity: 1e-6.into(),
///     initial_temperature: 483.15.into(),
/// };
/// let heating = ShearHeating::new(1, zone)?;
/// let (begin, source) = (heating.sizes().memory, [30e6 / 2.7e6]);
/// let (mut end, mut temperature) = (begin.clone(), [0.0]);
/// heating.advance(&begin, [&source; 2], 1.0, &mut end)?;
/// heating.read(0, &end, &mut temperature);
/// assert!((temperature[0] - 704.508).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("frictional heating", "flash temperature"))]
pub struct ShearHeating {
    vertices: usize,
    zone: ShearZone,
    modes: Modes,
    /// `1/(w sqrt(2 pi))`.
    peak: Parameter,
    initial_temperature: Parameter,
    /// `1/(rho c)`.
    per_heat: Parameter,
}

impl ShearHeating {
    /// The shear zone of a contact of so many vertices, with 24 modes.
    ///
    /// # Errors
    /// [`ThermalError`] for a parameter out of its range, or with a wrong number of values.
    pub fn new(vertices: usize, zone: ShearZone) -> Result<Self, ThermalError> {
        zone.check(vertices)?;
        let modes = Modes::new((vertices, DEFAULT), &zone, |k| {
            zone.thermal_diffusivity.at(k)
        })?;
        let (peak, _) = parameter(vertices, |k| zone.peak(k));
        let (initial_temperature, _) = parameter(vertices, |k| zone.initial_temperature.at(k));
        let (per_heat, _) = parameter(vertices, |k| zone.volumetric_heat_capacity.at(k).recip());
        Ok(Self {
            vertices,
            zone,
            modes,
            peak,
            initial_temperature,
            per_heat,
        })
    }

    /// With so many modes, from 2 to 64.
    ///
    /// # Errors
    /// [`ThermalError::Modes`] for other numbers.
    pub fn with_modes(mut self, modes: usize) -> Result<Self, ThermalError> {
        let diffusivity = |k| self.zone.thermal_diffusivity.at(k);
        self.modes = Modes::new((self.vertices, modes), &self.zone, diffusivity)?;
        Ok(self)
    }

    /// The numbers of the memory.
    pub(super) fn len(&self) -> usize {
        self.vertices * self.modes.count()
    }

    pub(super) fn vertices(&self) -> usize {
        self.vertices
    }

    pub(super) fn zone(&self) -> &ShearZone {
        &self.zone
    }

    pub(super) fn modes(&self) -> &Modes {
        &self.modes
    }
}

impl FaultField for ShearHeating {
    fn sizes(&self) -> FieldSizes {
        FieldSizes {
            vertices: self.vertices,
            memory: vec![0.0; self.len()],
            sources: self.vertices,
        }
    }

    fn source(&self, at: &FaultRates<'_>, _memory: &[f64], source: &mut [f64]) {
        let pass = Heat {
            friction: at.friction,
            slip_rate: at.slip_rate,
            per_heat: &self.per_heat,
            to: source,
        };
        run(self.vertices, pass);
    }

    fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let step = Step::new(&self.modes, source, dt);
        run(self.vertices, Advance { step, from, to });
        Ok(())
    }

    fn pressure(&self, _memory: &[f64], _pressure: &mut [f64]) {}

    fn pressure_after(
        &self,
        _from: &[f64],
        _source: [&[f64]; 2],
        _dt: f64,
        _pressure: &mut [f64],
        _scratch: &mut [f64],
    ) -> Result<(), FieldError> {
        Ok(())
    }

    fn readings(&self) -> &[Reading] {
        &[Reading {
            name: "temperature",
            unit: "K",
        }]
    }

    fn read(&self, _number: usize, memory: &[f64], values: &mut [f64]) {
        for first in (0..self.vertices).step_by(LANES) {
            let (mut spare, count) = (None, LANES.min(self.vertices - first));
            let initial = self.initial_temperature.load(first, &mut spare);
            values[first..first + count].copy_from_slice(&initial[..count]);
        }
        let term = Term {
            modes: &self.modes,
            factor: &self.peak,
            memory,
            step: None,
        };
        let add = Add {
            terms: [term],
            to: values,
        };
        run(self.vertices, add);
    }
}
