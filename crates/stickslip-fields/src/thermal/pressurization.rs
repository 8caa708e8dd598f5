//! Thermal pressurization.

use stickslip_core::lanes::{Parameter, run};

use super::block::Step;
use super::modes::Modes;
use super::parameters::parameter;
use super::passes::{Add, Advance, Term};
use super::{PoreFluid, ShearHeating, ShearZone, ThermalError};
use crate::{FaultField, FaultRates, FieldError, FieldSizes, Reading};

/// Below this relative difference of diffusivities the pressure loses digits: it is computed at this one.
const LEAST_DIFFERENCE: f64 = 1e-6;

/// Thermal pressurization: friction heats a shear zone, the pore fluid expands and carries a part of the normal stress.
///
/// ```text
/// T' = alpha_th d2T/dz2 + tau V g(z)/(rho c),     p' = alpha_hy d2p/dz2 + Lambda T'
/// g(z) = exp(-z^2/(2 w^2))/(w sqrt(2 pi))
/// ```
///
/// with the frictional strength `tau` \[Pa\], the slip rate `V` [m/s] and the parameters of a [`ShearZone`] and a
/// [`PoreFluid`]; `p` is the change of pressure \[Pa\] at its centre.
///
/// Equal diffusivities are a limit: within 1e-6 of each other they are computed as if 1e-6 apart, which changes the pressure
/// by about as much.
///
/// # Method
/// As Noda and Lapusta (J. Geophys. Res. 115, B12314, 2010) and SeisSol: both fields are sums of modes across the fault, the
/// Fourier modes `k` of the Gaussian, each of which relaxes by itself. With `s = tau V/(rho c)` [K m/s], `lambda_j =
/// (k_j w)^2/2` and the modes `y_j` of heat (`alpha_th`) and of the fluid (`alpha_hy`) \[K m\],
///
/// ```text
/// y_j' = -(2 alpha lambda_j/w^2) y_j + s,     W_j = ln(2) sqrt(lambda_j/pi) exp(-lambda_j)
/// T = T_0 + sum_j W_j y_th,j/(w sqrt(2 pi))
/// p = Lambda/(alpha_hy - alpha_th) sum_j W_j (alpha_hy y_hy,j - alpha_th y_th,j)/(w sqrt(2 pi))
/// ```
///
/// The `lambda_j` are in a row of ratio 2 from 11.2 on downwards, at which the weights sum to 1; what is below the last one is
/// lumped into one mode more. A step is exact for a source that is linear in time, however long it is.
///
/// The response to a pulse, `1/sqrt(2 pi (w^2 + 2 alpha t))`, is wrong by at most 2e-6 of its peak until `2 alpha t/w^2 =`
/// 1e3, 1e4, 1e5 and 1e7 with 19, 22, 24 and 30 modes, and by 1e-4 at all times with 28; beyond its range a sum of modes
/// forgets what it should remember.
///
/// # Cost
/// The memory is 48 numbers per vertex (384 bytes) with 24 modes. Uniform diffusivities and half widths share their
/// exponentials. Those of each vertex take two exponentials per vertex: rates of ratio 2 follow from each other without loss of
/// digits. The feature `simd` makes those about half as expensive.
///
/// # Slip on a plane
/// No sum of modes has the response of a plane at once. A half width of 1e-5 m with 42 modes is within 1e-4 of slip on a plane
/// (Rice, J. Geophys. Res. 111, B05311, 2006) from slips of a few centimetres on.
///
/// # Example
/// The parameters of TPV105, at two vertices; the outer one drains fast.
///
/// ```
/// use stickslip_fields::{FaultField, PoreFluid, ShearZone, ThermalPressurization, check_fault_field};
///
/// let zone = ShearZone {
///     half_width: 0.02.into(),
///     volumetric_heat_capacity: 2.7e6.into(),
///     thermal_diffusivity: 1e-6.into(),
///     initial_temperature: 483.15.into(),
/// };
/// let fluid = PoreFluid {
///     hydraulic_diffusivity: vec![4e-4, 1.0].into(),
///     pressurization_coefficient: 1e5.into(),
/// };
/// let field = ThermalPressurization::new(2, zone, fluid)?;
/// let (begin, source) = (field.sizes().memory, [30e6 / 2.7e6; 2]);
/// let (mut end, mut pressure) = (begin.clone(), [0.0; 2]);
/// // 30 MPa and 1 m/s for 0.1 s.
/// field.advance(&begin, [&source; 2], 0.1, &mut end)?;
/// field.pressure(&end, &mut pressure);
/// assert_eq!(pressure.map(|p| (p / 1e4).round() / 100.0), [2.12, 0.19]);
/// check_fault_field(&field)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("thermal pressurisation", "TP", "undrained heating"))]
pub struct ThermalPressurization {
    /// Its memory is the first half.
    heating: ShearHeating,
    fluid: PoreFluid,
    /// Its memory is the second half.
    hydraulic: Modes,
    /// The factors of both sums of modes.
    of_heat: Parameter,
    of_fluid: Parameter,
}

impl ThermalPressurization {
    /// The shear zone of a contact of so many vertices, with 24 modes for the temperature and as many for the fluid.
    ///
    /// # Errors
    /// [`ThermalError`] for a parameter out of its range, or with a wrong number of values.
    pub fn new(vertices: usize, zone: ShearZone, fluid: PoreFluid) -> Result<Self, ThermalError> {
        let heating = ShearHeating::new(vertices, zone)?;
        fluid.check(vertices)?;
        Self::of(heating, fluid)
    }

    /// With so many modes of each kind, from 2 to 64.
    ///
    /// # Errors
    /// [`ThermalError::Modes`] for other numbers.
    pub fn with_modes(self, modes: usize) -> Result<Self, ThermalError> {
        Self::of(self.heating.with_modes(modes)?, self.fluid)
    }

    fn of(heating: ShearHeating, fluid: PoreFluid) -> Result<Self, ThermalError> {
        let (zone, vertices) = (heating.zone(), heating.vertices());
        let diffusivities = |k| {
            let [heat, fluid] = [&zone.thermal_diffusivity, &fluid.hydraulic_diffusivity]
                .map(|diffusivity| diffusivity.at(k));
            let is_close = (fluid - heat).abs() <= LEAST_DIFFERENCE * heat;
            let fluid = if is_close {
                heat * (1.0 + LEAST_DIFFERENCE)
            } else {
                fluid
            };
            [heat, fluid]
        };
        let size = (vertices, heating.modes().count());
        let hydraulic = Modes::new(size, zone, |k| diffusivities(k)[1])?;
        // Lambda/(w sqrt(2 pi)) (-alpha_th, alpha_hy)/(alpha_hy - alpha_th).
        let factors = |k| {
            let coefficient = fluid.pressurization_coefficient.at(k) * zone.peak(k);
            let [heat, fluid] = diffusivities(k);
            if heat == fluid {
                // Both 0: without diffusion.
                return [0.0, coefficient];
            }
            [-heat, fluid].map(|diffusivity| coefficient * (diffusivity / (fluid - heat)))
        };
        let (of_heat, _) = parameter(vertices, |k| factors(k)[0]);
        let (of_fluid, _) = parameter(vertices, |k| factors(k)[1]);
        Ok(Self {
            heating,
            fluid,
            hydraulic,
            of_heat,
            of_fluid,
        })
    }

    /// The rows of modes of the pressure, at the end of a step if there is one.
    fn terms<'a>(
        &'a self,
        memory: &'a [f64],
        step: Option<([&'a [f64]; 2], f64)>,
    ) -> [Term<'a>; 2] {
        let (heat, fluid) = memory.split_at(self.heating.len());
        [
            (&self.hydraulic, &self.of_fluid, fluid),
            (self.heating.modes(), &self.of_heat, heat),
        ]
        .map(|(modes, factor, memory)| Term {
            modes,
            factor,
            memory,
            step: step.map(|(source, dt)| Step::new(modes, source, dt)),
        })
    }
}

impl FaultField for ThermalPressurization {
    fn sizes(&self) -> FieldSizes {
        let sizes = self.heating.sizes();
        FieldSizes {
            memory: vec![0.0; 2 * sizes.memory.len()],
            ..sizes
        }
    }

    fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]) {
        self.heating.source(at, memory, source);
    }

    fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        let middle = self.heating.len();
        let (of_heat, of_fluid) = to.split_at_mut(middle);
        self.heating.advance(&from[..middle], source, dt, of_heat)?;
        let fluid = Advance {
            step: Step::new(&self.hydraulic, source, dt),
            from: &from[middle..],
            to: of_fluid,
        };
        run(self.heating.vertices(), fluid);
        Ok(())
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        let add = Add {
            terms: self.terms(memory, None),
            to: pressure,
        };
        run(self.heating.vertices(), add);
    }

    fn pressure_after(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        pressure: &mut [f64],
        _scratch: &mut [f64],
    ) -> Result<(), FieldError> {
        let add = Add {
            terms: self.terms(from, Some((source, dt))),
            to: pressure,
        };
        run(self.heating.vertices(), add);
        Ok(())
    }

    fn readings(&self) -> &[Reading] {
        self.heating.readings()
    }

    fn read(&self, number: usize, memory: &[f64], values: &mut [f64]) {
        self.heating.read(number, memory, values);
    }
}
