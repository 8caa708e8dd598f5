//! Shear zones of the tests.

use stickslip_fields::{FaultField, PerVertex, PoreFluid, ShearHeating, ShearZone};

/// The volumetric heat capacity [J/(m^3 K)].
pub(crate) const HEAT_CAPACITY: f64 = 2.7e6;
/// The pressurization coefficient [Pa/K].
pub(crate) const COEFFICIENT: f64 = 1e5;
/// The initial temperature \[K\].
pub(crate) const INITIAL: f64 = 483.15;

pub(crate) fn zone(
    half_width: impl Into<PerVertex>,
    diffusivity: impl Into<PerVertex>,
) -> ShearZone {
    ShearZone {
        half_width: half_width.into(),
        volumetric_heat_capacity: HEAT_CAPACITY.into(),
        thermal_diffusivity: diffusivity.into(),
        initial_temperature: INITIAL.into(),
    }
}

pub(crate) fn fluid(diffusivity: impl Into<PerVertex>) -> PoreFluid {
    PoreFluid {
        hydraulic_diffusivity: diffusivity.into(),
        pressurization_coefficient: COEFFICIENT.into(),
    }
}

/// A field of one vertex at a time.
pub(crate) struct Point<F> {
    pub(crate) field: F,
    pub(crate) memory: Vec<f64>,
}

impl<F: FaultField> Point<F> {
    pub(crate) fn new(field: F) -> Self {
        let memory = field.sizes().memory;
        Self { field, memory }
    }

    pub(crate) fn advance(&mut self, source: [f64; 2], dt: f64) {
        let from = self.memory.clone();
        let [begin, end] = source.map(|source| [source]);
        (self.field)
            .advance(&from, [&begin, &end], dt, &mut self.memory)
            .expect("the field advances");
    }

    pub(crate) fn pressure(&self) -> f64 {
        let mut pressure = [0.0];
        self.field.pressure(&self.memory, &mut pressure);
        pressure[0]
    }

    /// The pressure after a step.
    pub(crate) fn pressure_after(&self, source: [f64; 2], dt: f64) -> f64 {
        let (mut pressure, mut scratch) = ([0.0], self.memory.clone());
        let [begin, end] = source.map(|source| [source]);
        (self.field)
            .pressure_after(
                &self.memory,
                [&begin, &end],
                dt,
                &mut pressure,
                &mut scratch,
            )
            .expect("the field advances");
        pressure[0]
    }

    /// The rise of the temperature \[K\].
    pub(crate) fn heating(&self) -> f64 {
        let mut temperature = [0.0];
        self.field.read(0, &self.memory, &mut temperature);
        temperature[0] - INITIAL
    }
}

/// Heating alone, at one vertex.
pub(crate) fn heated(half_width: f64, diffusivity: f64, modes: usize) -> Point<ShearHeating> {
    let heating = ShearHeating::new(1, zone(half_width, diffusivity)).expect("the zone is legal");
    Point::new(heating.with_modes(modes).expect("the modes are legal"))
}
