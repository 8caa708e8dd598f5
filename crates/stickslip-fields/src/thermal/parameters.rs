//! Parameters of shear zones.

use std::f64::consts::TAU;

use stickslip_core::lanes::Parameter;

use super::ThermalError;
use crate::PerVertex;

/// The shear zone of a fault, in which friction heats the rock.
///
/// Heat is produced as a Gaussian across the fault, of standard deviation `w`, the half width. A layer of thickness `h` of
/// the same peak has `h = sqrt(2 pi) w`.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearZone {
    /// The half width `w` \[m\], above 0; 1e-5 m for slip on a plane.
    pub half_width: PerVertex,
    /// The volumetric heat capacity `rho c` [J/(m^3 K)], above 0.
    pub volumetric_heat_capacity: PerVertex,
    /// The thermal diffusivity `alpha_th` [m^2/s], at least 0; 0 is adiabatic.
    pub thermal_diffusivity: PerVertex,
    /// The initial temperature `T_0` \[K\], above 0.
    pub initial_temperature: PerVertex,
}

/// The pore fluid of a shear zone, which heat pressurizes.
#[derive(Debug, Clone, PartialEq)]
pub struct PoreFluid {
    /// The hydraulic diffusivity `alpha_hy` [m^2/s], at least 0; 0 is undrained.
    pub hydraulic_diffusivity: PerVertex,
    /// The pressurization coefficient `Lambda` [Pa/K], the change of pressure with temperature without drainage; at least
    /// 0.
    #[doc(alias = "undrained thermal pressurization factor")]
    pub pressurization_coefficient: PerVertex,
}

/// The name and the range of a parameter.
struct Range {
    what: &'static str,
    unit: &'static str,
    requirement: &'static str,
    advice: &'static str,
    /// Whether 0 is legal.
    zero: bool,
}

impl Range {
    fn check(&self, vertices: usize, values: &PerVertex) -> Result<(), ThermalError> {
        let values = match values {
            PerVertex::Uniform(value) => std::slice::from_ref(value),
            PerVertex::Each(values) if values.len() == vertices => values,
            PerVertex::Each(values) => {
                return Err(ThermalError::Count {
                    what: self.what,
                    values: values.len(),
                    vertices,
                });
            }
        };
        let is_legal =
            |value: f64| value.is_finite() && (value > 0.0 || (self.zero && value == 0.0));
        match values.iter().position(|value| !is_legal(*value)) {
            None => Ok(()),
            Some(vertex) => Err(ThermalError::Value {
                what: self.what,
                unit: self.unit,
                vertex,
                value: values[vertex],
                requirement: self.requirement,
                advice: self.advice,
            }),
        }
    }
}

const POSITIVE: &str = "finite and above 0";
const AT_LEAST_0: &str = "finite and at least 0";

impl ShearZone {
    /// `1/(w sqrt(2 pi))`, the largest value of the Gaussian [1/m].
    pub(super) fn peak(&self, vertex: usize) -> f64 {
        1.0 / (self.half_width.at(vertex) * TAU.sqrt())
    }

    pub(super) fn check(&self, vertices: usize) -> Result<(), ThermalError> {
        if vertices == 0 {
            return Err(ThermalError::NoVertices);
        }
        let half_width = Range {
            what: "half width",
            unit: "m",
            requirement: POSITIVE,
            advice: "use a half width of 1e-5 m for a plane",
            zero: false,
        };
        half_width.check(vertices, &self.half_width)?;
        let heat_capacity = Range {
            what: "volumetric heat capacity",
            unit: "J/(m^3 K)",
            requirement: POSITIVE,
            advice: "rock has about 2.7e6 J/(m^3 K)",
            zero: false,
        };
        heat_capacity.check(vertices, &self.volumetric_heat_capacity)?;
        let diffusivity = Range {
            what: "thermal diffusivity",
            unit: "m^2/s",
            requirement: AT_LEAST_0,
            advice: "rock has about 1e-6 m^2/s, and 0 is adiabatic",
            zero: true,
        };
        diffusivity.check(vertices, &self.thermal_diffusivity)?;
        let temperature = Range {
            what: "initial temperature",
            unit: "K",
            requirement: POSITIVE,
            advice: "pass kelvins, 273.15 more than degrees Celsius",
            zero: false,
        };
        temperature.check(vertices, &self.initial_temperature)
    }
}

impl PoreFluid {
    pub(super) fn check(&self, vertices: usize) -> Result<(), ThermalError> {
        let diffusivity = Range {
            what: "hydraulic diffusivity",
            unit: "m^2/s",
            requirement: AT_LEAST_0,
            advice: "gouge has 1e-6 to 1e-2 m^2/s, and 0 is undrained",
            zero: true,
        };
        diffusivity.check(vertices, &self.hydraulic_diffusivity)?;
        let coefficient = Range {
            what: "pressurization coefficient",
            unit: "Pa/K",
            requirement: AT_LEAST_0,
            advice: "gouge has 1e5 to 1e6 Pa/K; leave the fluid out by `ShearHeating`",
            zero: true,
        };
        coefficient.check(vertices, &self.pressurization_coefficient)
    }
}

/// A number of each vertex, or one of all if they are equal.
pub(super) fn parameter(vertices: usize, value: impl Fn(usize) -> f64) -> (Parameter, bool) {
    let first = value(0);
    let is_uniform = (0..vertices).all(|k| value(k) == first);
    let parameter = if is_uniform {
        Parameter::new([first].into_iter())
    } else {
        Parameter::new((0..vertices).map(value))
    };
    (parameter, is_uniform)
}
