//! A planar fault of rectangular cells.

use std::sync::{Arc, OnceLock};

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::Operator;

use super::angles::cos_sin;
use super::convolution::Convolution;
use super::dislocation::{Rock, dip_cos_sin, require_buried, require_poisson_ratio};
use super::matrix::Matrix;
use super::whole_space::WholeSpace;
use super::{NormalKernel, PlaneKernel, Rectangles, RectangularDislocation, assembly, periodic};
use crate::error::positive;
use crate::{KernelError, Medium, Section};

/// The space around the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Space {
    Whole {
        /// Along strike and down dip.
        periodic: [bool; 2],
    },
    Half {
        /// \[degrees\]
        dip: f64,
    },
}

/// A planar fault of rectangular cells in an elastic space by boundary integrals, quasi-dynamic: all parts of a scene of
/// its cells alone.
///
/// The displacement of a cell is the slip `D` across the fault, of the hanging wall relative to the footwall. It has two
/// components, along strike (left-lateral) and up dip (thrust), or one along a fixed rake
/// ([`with_rake`](Self::with_rake)). Shear stress is positive if it drives positive slip, normal stress if it is
/// compressive. Forces are stress times the area of a cell \[N\].
///
/// Slip is constant on cells, and stress is that at their centres, in closed form. In a whole space, with wave numbers
/// `k` of smooth slip,
///
/// ```text
/// tau_x = -(mu/2) [ (kx^2/(1 - nu) + ky^2) Dx + (nu/(1 - nu)) kx ky Dy ]/abs(k),    tau_y likewise
/// ```
///
/// and the normal stress does not change. The matrix has this spectrum to second order in the size of cells, the
/// coupling of both components included: its neighbours are corrected. In a half space the free surface adds the
/// stresses of Okada (Bull. Seismol. Soc. Am. 82 (1992) 1018-1040) at any dip, the normal stress among them.
///
/// Memory in a half space: 8 bytes per pair of rows and column, for each pair of components; 82 MB for 400 x 160 cells
/// of one component along or across strike.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, Medium, PlaneFault, Rectangles};
/// use stickslip_solvers::Operator;
///
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Rectangles::new(Cells::new([-5e3, 5e3], 1)?, Cells::new([5e3, 15e3], 1)?);
/// let fault = PlaneFault::half_space(cells, 90.0, rock, 0.25)?.with_rake(0.0)?;
/// let stress = -fault.stiffness().product_at(0, &[Vector1::new(1.0)])[0] / cells.area();
/// assert!((stress / -3.309_041_65e6 - 1.0).abs() < 1e-8);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("boundary element", "BEM", "quasi-dynamic", "Okada", "3D"))]
pub struct PlaneFault<const C: usize = 2> {
    cells: Rectangles,
    rock: Medium,
    poisson_ratio: f64,
    space: Space,
    /// The components of slip, along strike and up dip.
    directions: [[f64; 2]; C],
    /// Of all that ask for it, clones included.
    interaction: Arc<OnceLock<Arc<Matrix>>>,
}

impl PlaneFault {
    /// A plane in a whole space, with two components of slip. Poisson's ratio is above -1 and below 1/2.
    ///
    /// # Errors
    /// [`KernelError`] for rock or Poisson's ratio out of their ranges.
    pub fn whole_space(
        cells: Rectangles,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, KernelError> {
        let space = Space::Whole {
            periodic: [false; 2],
        };
        Self::new(cells, rock, poisson_ratio, space)
    }

    /// A plane that dips to the right of strike in a half space with a free surface, with two components of slip. The
    /// dip is in degrees, above 0 and at most 90; positions down dip are distances from the surface along the plane.
    ///
    /// # Errors
    /// [`KernelError`] for rock, Poisson's ratio or dip out of their ranges, and for cells above the surface.
    pub fn half_space(
        cells: Rectangles,
        dip: f64,
        rock: Medium,
        poisson_ratio: f64,
    ) -> Result<Self, KernelError> {
        require_buried(cells.down_dip().ends()[0])?;
        dip_cos_sin(dip)?;
        Self::new(cells, rock, poisson_ratio, Space::Half { dip })
    }

    fn new(
        cells: Rectangles,
        rock: Medium,
        poisson_ratio: f64,
        space: Space,
    ) -> Result<Self, KernelError> {
        positive("shear modulus", rock.shear_modulus)?;
        positive("shear wave speed", rock.shear_wave_speed)?;
        require_poisson_ratio(poisson_ratio)?;
        Ok(Self {
            cells,
            rock,
            poisson_ratio,
            space,
            directions: [[1.0, 0.0], [0.0, 1.0]],
            interaction: Arc::default(),
        })
    }

    /// The same fault with slip along a fixed rake \[degrees\]: 0 along strike (left-lateral), 90 up dip (thrust), -90
    /// down dip (normal), 180 right-lateral.
    ///
    /// # Errors
    /// [`KernelError`] for a rake that is not finite.
    pub fn with_rake(self, rake: f64) -> Result<PlaneFault<1>, KernelError> {
        if !rake.is_finite() {
            return Err(KernelError::new("rake [degrees]", "finite", rake));
        }
        Ok(PlaneFault {
            cells: self.cells,
            rock: self.rock,
            poisson_ratio: self.poisson_ratio,
            space: self.space,
            directions: [cos_sin(rake)],
            interaction: Arc::default(),
        })
    }
}

impl<const C: usize> PlaneFault<C> {
    /// The same fault, repeated along strike after the length of its cells.
    ///
    /// A plane that is periodic in both directions has smooth slip: as many Fourier modes as there are cells, each with
    /// its stiffness, and uniform slip causes no stress. A plane that is periodic in one direction has constant slip on
    /// cells, and the forces of all images by a sum over them, to 1e-9 of a cell's own force.
    ///
    /// # Errors
    /// [`KernelError`] for a plane in a half space.
    pub fn periodic_along_strike(self) -> Result<Self, KernelError> {
        self.periodic(0)
    }

    /// The same fault, repeated down dip after the length of its cells, see
    /// [`periodic_along_strike`](Self::periodic_along_strike).
    ///
    /// # Errors
    /// [`KernelError`] for a plane in a half space.
    pub fn periodic_down_dip(self) -> Result<Self, KernelError> {
        self.periodic(1)
    }

    fn periodic(mut self, axis: usize) -> Result<Self, KernelError> {
        let Space::Whole { periodic } = &mut self.space else {
            let what = "number of free surfaces beside a periodic plane";
            return Err(KernelError::new(what, "at most", 1.0).bound(0.0));
        };
        periodic[axis] = true;
        self.interaction = Arc::default();
        Ok(self)
    }

    /// Its cells.
    pub fn cells(&self) -> &Rectangles {
        &self.cells
    }

    /// The dip in degrees; none in a whole space.
    pub fn dip(&self) -> Option<f64> {
        match self.space {
            Space::Whole { .. } => None,
            Space::Half { dip } => Some(dip),
        }
    }

    /// The directions of the components of slip: their parts along strike and up dip.
    pub fn directions(&self) -> &[[f64; 2]; C] {
        &self.directions
    }

    /// A cell as a rectangle in a half space, for stresses off the plane; none in a whole space.
    pub fn dislocation(&self, cell: usize) -> Option<RectangularDislocation> {
        let (dip, [x, y]) = (self.dip()?, self.cells.center(cell));
        let (along, down) = (self.cells.along_strike(), self.cells.down_dip());
        let half = [0.5 * along.length(), 0.5 * down.length()];
        RectangularDislocation::new(
            [x - half[0], x + half[0]],
            // Rounding must not lift the first row above the surface.
            [(y - half[1]).max(0.0), y + half[1]],
            dip,
            self.rock.shear_modulus,
            self.poisson_ratio,
        )
        .ok()
    }

    /// The stiffness matrix \[N/m\]: forces on cells due to slip, positive against it. It is made when it is first asked
    /// for, and shared by all.
    pub fn stiffness(&self) -> PlaneKernel<C> {
        let interaction = self.interaction.get_or_init(|| Arc::new(self.matrix()));
        PlaneKernel::of_interaction(self.cells.count(), Arc::clone(interaction))
    }

    fn matrix(&self) -> Matrix {
        let (cells, directions) = (&self.cells, &self.directions);
        let space = WholeSpace::new(cells, self.rock.shear_modulus, self.poisson_ratio);
        let counts = [cells.along_strike().count(), cells.down_dip().count()];
        let periodic = match self.space {
            Space::Half { .. } => {
                return Matrix::Layers(assembly::shear(cells, &self.dipping(), &space, directions));
            }
            Space::Whole { periodic } => periodic,
        };
        Matrix::Convolution(match periodic {
            [true, true] => Convolution::of_modes(counts, directions, |waves| {
                periodic::mode_stiffness(&space, counts, waves)
            }),
            [false, false] => Convolution::of_differences(
                counts,
                periodic,
                directions,
                |apart| space.cells_apart(apart),
                space.cross_correction(),
            ),
            [along_strike, _] => {
                let axis = usize::from(!along_strike);
                Convolution::of_differences(
                    counts,
                    periodic,
                    directions,
                    |apart| periodic::lattice_sum(&space, apart, axis, counts[axis]),
                    space.cross_correction(),
                )
            }
        })
    }

    /// Rock with the plane's axes; those of a vertical plane in a whole space.
    fn dipping(&self) -> Rock {
        let axes = cos_sin(self.dip().unwrap_or(90.0));
        Rock::new(self.rock.shear_modulus, self.poisson_ratio, axes)
    }

    /// The change of normal stress per slip [Pa/m], compression positive. It is 0 in a whole space and on a vertical
    /// plane.
    pub fn normal_stiffness(&self) -> NormalKernel<C> {
        match self.dip() {
            Some(dip) if dip < 90.0 => {
                let (cells, rock) = (&self.cells, self.dipping());
                let space = WholeSpace::new(cells, self.rock.shear_modulus, self.poisson_ratio);
                NormalKernel::new(assembly::normal(cells, &rock, &space, &self.directions))
            }
            _ => NormalKernel::zero(),
        }
    }

    /// The radiation damping as a viscosity matrix, for shear waves along the fault's normal \[N s/m\]:
    /// `eta = mu/(2 c_s)` times the area of a cell.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> PlaneKernel<C> {
        self.damping(1.0)
    }

    /// [`radiation_damping`](Self::radiation_damping) times a factor, finite and not negative.
    ///
    /// # Errors
    /// [`KernelError`] for a factor out of its range.
    pub fn radiation_damping_times(&self, factor: f64) -> Result<PlaneKernel<C>, KernelError> {
        if !(factor >= 0.0 && factor.is_finite()) {
            let what = "factor of radiation damping";
            return Err(KernelError::new(what, "finite, and at least", factor).bound(0.0));
        }
        Ok(self.damping(factor))
    }

    fn damping(&self, factor: f64) -> PlaneKernel<C> {
        let eta = 0.5 * factor * self.rock.shear_modulus / self.rock.shear_wave_speed;
        let block = SMatrix::from_diagonal_element(eta * self.cells.area());
        PlaneKernel::diagonal(vec![block; self.cells.count()])
    }

    /// Plate loading, a load history: beyond its cells, on all sides up to the surface, the fault creeps at `rate`
    /// [m/s]. Cells that creep at this rate are not stressed.
    ///
    /// # Errors
    /// [`KernelError`] for a rate that is not finite.
    pub fn plate_loading(
        &self,
        rate: SVector<f64, C>,
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        self.back_slip(&vec![rate; self.cells.count()])
    }

    /// Plate loading by back slip, a load history: the force that relieves cells that slip at their `rates` [m/s].
    ///
    /// # Errors
    /// [`KernelError`] for another number of rates than cells, and for a rate that is not finite.
    #[doc(alias = "backslip")]
    pub fn back_slip(
        &self,
        rates: &[SVector<f64, C>],
    ) -> Result<impl Fn(f64, &mut [SVector<f64, C>]) + Send + Sync + 'static + use<C>, KernelError>
    {
        let count = self.cells.count();
        if rates.len() != count {
            let (what, requirement) = ("number of plate rates", "that of the cells,");
            let wrong = KernelError::new(what, requirement, rates.len() as f64);
            return Err(wrong.bound(count as f64));
        }
        for (cell, rate) in rates.iter().enumerate() {
            if let Some(&value) = rate.iter().find(|rate| !rate.is_finite()) {
                return Err(KernelError {
                    cell: Some(cell),
                    ..KernelError::new("plate rate [m/s] of cell", "finite", value)
                });
            }
        }
        let mut loading = vec![SVector::zeros(); count];
        self.stiffness().multiply_add(1.0, rates, &mut loading);
        Ok(move |time: f64, load: &mut [SVector<f64, C>]| {
            for (load, loading) in load.iter_mut().zip(&loading) {
                *load += loading * time;
            }
        })
    }

    /// The cells whose centres \[m\] are inside, see [`Rectangles::section`].
    ///
    /// # Errors
    /// [`KernelError`] if no centre is inside.
    pub fn section(
        &self,
        inside: impl FnMut([f64; 2]) -> bool,
    ) -> Result<Section<Rectangles>, KernelError> {
        self.cells.section(inside)
    }
}
