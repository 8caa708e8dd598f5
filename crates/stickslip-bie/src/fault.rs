//! A planar fault in an elastic space.

use std::f64::consts::PI;

use nalgebra::SVector;

use crate::error::positive;
use crate::loading::relieving;
use crate::{Cells, Kernel, KernelError};

/// Homogeneous, isotropic, elastic rock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// `mu` \[Pa\], positive and finite.
    pub shear_modulus: f64,
    /// `c_s` [m/s], positive and finite.
    pub shear_wave_speed: f64,
}

/// The direction of slip.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Mode {
    /// Along the line at which the fault ends: mode III.
    Antiplane,
    /// Across it, in plane strain: mode II. The normal traction stays constant. The stiffness is `1/(1 - nu)` times
    /// that of antiplane slip.
    InPlane {
        /// `nu`, above -1 and below 1/2.
        poisson_ratio: f64,
    },
}

/// The space around the fault.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Space {
    Half,
    Whole,
    Periodic,
}

/// A planar fault in an elastic space by boundary integrals, quasi-dynamic: all parts of a scene of its cells alone.
///
/// The displacement of a cell is the slip `D` across the fault: slip rates, characteristic slip distances and rates of
/// laws are those of published problems. [`one_sided`](Self::one_sided) describes a body that is one of two halves.
///
/// | | slip across the fault | one of two halves |
/// | --- | --- | --- |
/// | displacement | `D` | `D/2` |
/// | stiffness at wavenumber `k` [Pa/m] | `mu abs(k)/2` | `mu abs(k)` |
/// | radiation damping [Pa s/m] | `mu/(2 c_s)` | `mu/c_s = rho c_s` |
/// | reference velocity, slip distance, plate rate | `V0`, `L`, `V_p` | `V0/2`, `L/2`, `V_p/2` |
/// | traction, normal stress, `a`, `b`, `mu0`, `theta` | the same | the same |
///
/// For slip that is constant on cells, the kernel of a space that is not periodic is exact at their centres: slip `D`
/// from `s1` to `s2` causes the shear stress
///
/// ```text
/// tau(z) = (mu D/(2 pi)) (1/(z - s2) - 1/(z - s1))
/// ```
///
/// and a free surface adds the images of the cells (J. Weertman, "Dislocation Based Fracture Mechanics", 1996, Sec. 1).
/// Forces are those on a cell, stress times its length [N/m].
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, Fault, Mode, Medium};
/// use stickslip_solvers::{Matrix, Operator};
///
/// let rock = Medium { shear_modulus: 30e9, shear_wave_speed: 3464.0 };
/// let fault = Fault::whole_space(Cells::new([-1.0, 1.0], 3)?, rock, Mode::Antiplane)?;
/// // The middle cell, 2/3 m long, slips by 1 m: its centre is relieved by (mu/(2 pi)) 2/(1/3) m/m^2.
/// let slip = [Vector1::new(0.0), Vector1::new(1.0), Vector1::new(0.0)];
/// let stress = fault.stiffness().product_at(1, &slip)[0] / fault.cells().length();
/// assert!((stress / (30e9 / std::f64::consts::TAU * 6.0) - 1.0).abs() < 1e-12);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("boundary element", "BEM", "quasi-dynamic"))]
pub struct Fault {
    cells: Cells,
    rock: Medium,
    mode: Mode,
    space: Space,
    /// Displacements per slip: 1, or 2 bodies that share it.
    sides: f64,
}

impl Fault {
    /// A vertical fault in a half space that slips along the surface, antiplane. Positions are depths, and the surface
    /// is free.
    ///
    /// # Errors
    /// [`KernelError`] for rock out of its range, and for cells at negative depths.
    pub fn half_space(cells: Cells, rock: Medium) -> Result<Self, KernelError> {
        let [begin, _] = cells.ends();
        if begin < 0.0 {
            let what = "depth [m] of the fault's upper end";
            return Err(KernelError::new(what, "at least", begin).bound(0.0));
        }
        Self::new(cells, rock, Mode::Antiplane, Space::Half)
    }

    /// A fault in a whole space.
    ///
    /// # Errors
    /// [`KernelError`] for rock or mode out of their ranges.
    pub fn whole_space(cells: Cells, rock: Medium, mode: Mode) -> Result<Self, KernelError> {
        Self::new(cells, rock, mode, Space::Whole)
    }

    /// A fault in a whole space that continues periodically beyond its cells, with smooth slip: as many Fourier modes
    /// as there are cells, each with its stiffness `mu abs(k)/2`.
    ///
    /// Uniform slip causes no stress: a load, or a spring, must drive such a fault.
    ///
    /// # Errors
    /// [`KernelError`] for rock or mode out of their ranges.
    pub fn periodic(cells: Cells, rock: Medium, mode: Mode) -> Result<Self, KernelError> {
        Self::new(cells, rock, mode, Space::Periodic)
    }

    fn new(cells: Cells, rock: Medium, mode: Mode, space: Space) -> Result<Self, KernelError> {
        check_medium(rock)?;
        if let Mode::InPlane { poisson_ratio } = mode {
            check_poisson_ratio(poisson_ratio)?;
        }
        Ok(Self {
            cells,
            rock,
            mode,
            space,
            sides: 1.0,
        })
    }

    /// The same fault as the surface of one of its two halves, whose displacement is half of the slip.
    #[must_use]
    pub fn one_sided(mut self) -> Self {
        self.sides = 2.0;
        self
    }

    /// The ratio of displacement to slip: 1, or 1/2 for [one of two halves](Self::one_sided).
    pub fn share_of_slip(&self) -> f64 {
        self.sides.recip()
    }

    pub(crate) fn rock(&self) -> Medium {
        self.rock
    }

    pub(crate) fn mode(&self) -> Mode {
        self.mode
    }

    pub(crate) fn has_surface(&self) -> bool {
        self.space == Space::Half
    }

    pub(crate) fn is_periodic(&self) -> bool {
        self.space == Space::Periodic
    }

    /// Its cells.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// The stiffness matrix \[Pa\]: forces on cells due to their displacements.
    pub fn stiffness(&self) -> Kernel {
        let (count, length) = (self.cells.count(), self.cells.length());
        let compliance = match self.mode {
            Mode::Antiplane => 1.0,
            Mode::InPlane { poisson_ratio } => 1.0 - poisson_ratio,
        };
        let modulus = self.sides * self.rock.shear_modulus / compliance;
        // Of cells so many lengths apart.
        let influence = |apart: f64| modulus / (2.0 * PI) / (0.25 - apart * apart);
        let kernel = match self.space {
            Space::Whole => Kernel::of_distances(count, |m| influence(m as f64), None),
            Space::Half => {
                let twice_buried = 2.0 * self.cells.ends()[0] / length;
                let image = |n: usize| influence(n as f64 + 1.0 + twice_buried);
                Kernel::of_distances(count, |m| influence(m as f64), Some(&image))
            }
            Space::Periodic => {
                let period = count as f64 * length;
                Kernel::of_modes(count, |n| {
                    let wavenumber = 2.0 * PI * n as f64 / period;
                    0.5 * modulus * wavenumber * length
                })
            }
        };
        kernel.on(self.cells.identity())
    }

    /// The radiation damping as a viscosity matrix, for waves along the fault's normal [Pa s/m times a length]:
    /// `eta = mu/(2 c_s)` on a cell, or `mu/c_s` of one body.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> Kernel {
        let Medium {
            shear_modulus,
            shear_wave_speed,
        } = self.rock;
        let damping = 0.5 * self.sides * shear_modulus / shear_wave_speed;
        let each = vec![damping * self.cells.length(); self.cells.count()];
        Kernel::diagonal(each).on(self.cells.identity())
    }

    /// Plate loading, a load history: beyond the cells the fault creeps at `rate` [m/s], on either side of them,
    /// measured in the displacements of the cells. Cells that creep at this rate are not
    /// stressed.
    pub fn plate_loading(
        &self,
        rate: f64,
    ) -> impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static {
        let moved = vec![SVector::from([rate]); self.cells.count()];
        relieving(&self.stiffness(), &moved)
    }
}

/// Refuses rock out of its range.
pub(crate) fn check_medium(rock: Medium) -> Result<(), KernelError> {
    positive("shear modulus", rock.shear_modulus)?;
    positive("shear wave speed", rock.shear_wave_speed)
}

/// Refuses a ratio of no elastic body.
pub(crate) fn check_poisson_ratio(poisson_ratio: f64) -> Result<(), KernelError> {
    if poisson_ratio > -1.0 && poisson_ratio < 0.5 {
        return Ok(());
    }
    let (what, requirement) = ("Poisson's ratio", "above -1 and below 1/2");
    Err(KernelError::new(what, requirement, poisson_ratio))
}
