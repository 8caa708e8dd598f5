//! Two layers in antiplane shear, one on the other, with an exact solution by waves.
//!
//! The upper layer, friction and load are those of [`antiplane_layer`](super::antiplane_layer); slip is that of the
//! interface, between two deformable sides.

use nalgebra::SVector;
use stickslip_fem::{GridDiagonal, Mesh, P1, antiplane_by_cell, mass_by_cell};
use stickslip_friction::FrictionLaw;
use stickslip_solvers::BlockMatrix;
use stickslip_state::{Reads, StateLaw, StateVariable};

use super::antiplane_layer::{END, NORMAL_STRESS, load_velocity};
use super::constant_rate::advance_exactly;
use crate::{BoundaryPart, Components, Scene, SceneError, StepError};

/// A layer of one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Thickness \[m\].
    pub thickness: f64,
    /// Density [kg/m^3].
    pub density: f64,
    /// Shear modulus \[Pa\].
    pub shear_modulus: f64,
    /// Cells across the thickness.
    pub cells: usize,
}

impl Layer {
    fn wave_speed(&self) -> f64 {
        (self.shear_modulus / self.density).sqrt()
    }

    fn impedance(&self) -> f64 {
        self.density * self.wave_speed()
    }

    fn transit(&self) -> f64 {
        self.thickness / self.wave_speed()
    }
}

/// Two layers with a driven top, a held bottom and friction between them; nothing depends on the position along them.
///
/// With the impedances `Z_i = rho_i c_i`, the transit times `T_i` and `Z = Z_1 Z_2/(Z_1 + Z_2)`, the waves `f_i'` that
/// arrive at the interface give its slip rate `V` by one scalar equation per time:
///
/// ```text
/// tau + Z V = 2 Z (f_1' - f_2'),   tau = sigma_n mu(V, alpha),   v_1 = 2 f_1' - tau/Z_1,   v_2 = 2 f_2' + tau/Z_2
/// f_i'(t) = V_i(t - T_i) - v_i(t - 2 T_i) + f_i'(t - 2 T_i)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoLayers {
    /// The plus side: the driven layer, above `y = 0`.
    pub upper: Layer,
    /// The minus side: the layer on a held bottom.
    pub lower: Layer,
}

impl Default for TwoLayers {
    /// The lower layer has a thickness of 0.7 m, twice the shear modulus and 1.5 times the density of the upper one.
    fn default() -> Self {
        let upper = Layer {
            thickness: 1.0,
            density: 5e3,
            shear_modulus: 5e7 / 2.6,
            cells: 64,
        };
        let lower = Layer {
            thickness: 0.7,
            density: 1.5 * upper.density,
            shear_modulus: 2.0 * upper.shear_modulus,
            cells: 45,
        };
        Self { upper, lower }
    }
}

/// The exact solution at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactSlip {
    /// Time \[s\].
    pub time: f64,
    /// Slip rate of the interface [m/s].
    pub slip_rate: f64,
    /// Slip of the interface \[m\].
    pub slip: f64,
}

impl TwoLayers {
    /// A strip of cells across both layers, split along the interface.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for no cells, or more than indices can count.
    pub fn space(&self) -> Result<P1<2>, SceneError> {
        let (above, below) = (self.upper.cells, self.lower.cells);
        let rows = above + below;
        let grid = Mesh::<2>::grid([1.0, rows as f64], [1, rows], GridDiagonal::Rising)?;
        let heights = [self.lower.thickness, self.upper.thickness];
        let height = |row: f64| {
            let row = row - below as f64;
            let (height, cells) = if row < 0.0 {
                (heights[0], below)
            } else {
                (heights[1], above)
            };
            row * height / cells as f64
        };
        let width = self.upper.thickness / above.max(1) as f64;
        let points = grid
            .vertices()
            .iter()
            .map(|x| [x[0] * width, height(x[1])].into());
        let cells = grid.cells().flatten().copied().collect();
        let mesh = Mesh::new(points.collect(), cells)?;
        let mesh = mesh.with_surface_where("interface", |x| x[1] == 0.0)?;
        Ok(P1::new(mesh.split("interface")?))
    }

    /// The sides of the interface, above and below.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for a mesh of another body.
    pub fn sides(space: &P1<2>) -> Result<[BoundaryPart; 2], SceneError> {
        let [plus, minus] = ["interface+", "interface-"].map(|side| space.part(side));
        Ok([(&plus?).into(), (&minus?).into()])
    }

    /// The layers with a driven top and a held bottom, without the contact between them.
    ///
    /// # Errors
    /// [`SceneError::Fem`] for material data out of range.
    pub fn scene(&self, space: &P1<2>) -> Result<Scene<BlockMatrix<1>, 1>, SceneError> {
        let side = |x: &SVector<f64, 2>| if x[1] > 0.0 { self.upper } else { self.lower };
        let on = |y: f64| space.trace(move |x| x[1] == y);
        Ok(
            Scene::new(antiplane_by_cell(space, |x, _| side(x).shear_modulus)?)
                .on(space)
                .with_mass(mass_by_cell(space, |x, _| side(x).density)?)
                .fix(&on(-self.lower.thickness)?, Components::ALL)
                .prescribe_velocity(&on(self.upper.thickness)?, Components::ALL, |time| {
                    [load_velocity(time)]
                }),
        )
    }

    /// The exact solution with `transit_steps` time steps in the transit time of the upper layer, each shown to
    /// `observe`.
    ///
    /// The state is advanced exactly at the midpoint rate, and waves of the lower layer, whose transit is no number of
    /// steps, are interpolated by cubics: the error falls with the square of the step.
    ///
    /// # Errors
    /// [`StepError::NotCoupled`] if rate and state do not agree in a step that is too large, and [`StepError::State`]
    /// where the state law has no solution.
    pub fn exact<L, S>(
        &self,
        friction: &L,
        law: &S,
        initial: S::State,
        transit_steps: usize,
        mut observe: impl FnMut(ExactSlip),
    ) -> Result<(), StepError>
    where
        L: FrictionLaw,
        S: StateLaw,
        L::State: Reads<S::State>,
    {
        let layers = [self.upper, self.lower];
        let transits = layers.map(|layer| layer.transit());
        let [upper, lower] = layers.map(|layer| layer.impedance());
        let dt = transits[0] / transit_steps as f64;
        let both = upper * lower / (upper + lower);
        let viscosity = both / NORMAL_STRESS;
        // f_i' - v_i of all times from 0 on.
        let mut waves = [vec![0.0], vec![0.0]];
        let (mut state, mut rate, mut slip) = (initial, 0.0, 0.0);
        for n in 1..=(END / dt).ceil() as usize {
            let time = n as f64 * dt;
            let driven = load_velocity((time - transits[0]).max(0.0));
            let back = [0, 1].map(|i| at(&waves[i], n as f64 - 2.0 * transits[i] / dt));
            let incoming = [driven + back[0], back[1]];
            let drive = 2.0 * viscosity * (incoming[0] - incoming[1]);
            let (mut next, mut advanced) = (rate, state);
            let mut change = f64::INFINITY;
            for _ in 0..MAX_ITERATIONS {
                let middle = 0.5 * (next + rate);
                advanced =
                    advance_exactly(law, state, middle, dt).map_err(|source| StepError::State {
                        vertex: 0,
                        slip_rate: middle,
                        source,
                    })?;
                let again = drive.signum()
                    * friction.slip_rate(viscosity, drive.abs(), L::State::read(advanced));
                change = (again - next).abs();
                next = again;
                if change <= 1e-13 * next.abs() {
                    break;
                }
            }
            let tolerance = 1e-9 * next.abs();
            if change.is_nan() || change > tolerance || !advanced.value().is_finite() {
                return Err(StepError::NotCoupled {
                    iterations: MAX_ITERATIONS,
                    change,
                    tolerance,
                });
            }
            let traction = 2.0 * both * (incoming[0] - incoming[1]) - both * next;
            waves[0].push(traction / upper - incoming[0]);
            waves[1].push(-traction / lower - incoming[1]);
            slip += 0.5 * dt * (rate + next);
            (rate, state) = (next, advanced);
            observe(ExactSlip {
                time,
                slip_rate: rate.abs(),
                slip,
            });
        }
        Ok(())
    }
}

const MAX_ITERATIONS: usize = 100;

/// A value between those of whole numbers, by the cubic through four of them; zero before the first.
fn at(values: &[f64], place: f64) -> f64 {
    if place <= 0.0 {
        return 0.0;
    }
    let first = (place.floor() as usize)
        .saturating_sub(1)
        .min(values.len().saturating_sub(4));
    let four = values[first..].iter().take(4).enumerate();
    let points = (values.len() - first).min(4);
    let x = place - first as f64;
    four.map(|(i, value)| {
        let others = (0..points).filter(|&j| j != i);
        let weight = |j: usize| (x - j as f64) / (i as f64 - j as f64);
        value * others.map(weight).product::<f64>()
    })
    .sum()
}
