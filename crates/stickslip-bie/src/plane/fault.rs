//! A planar fault of rectangular cells.

use std::sync::{Arc, OnceLock};

use super::angles::cos_sin;
use super::dislocation::{dip_cos_sin, require_buried, require_poisson_ratio};
use super::matrix::Matrix;
use super::{Rectangles, RectangularDislocation};
use crate::error::positive;
use crate::{KernelError, Medium, Section};

/// The space around the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Space {
    Whole {
        /// Along strike and down dip.
        periodic: [bool; 2],
    },
    Half {
        /// \[degrees\]
        dip: f64,
        /// Products take transforms down dip.
        transformed: bool,
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
/// In a half space a product takes transforms along strike, and for each of their modes what takes fewer
/// multiplications down dip: a matrix of all pairs of rows; or transforms for the part of a whole space, and for that of
/// the free surface, which is smooth, products of a column and a row (on average 11 to 22 a mode for dips of 90 to 30
/// degrees, at any number of rows). The first holds small numbers in single precision, the second leaves small ones out;
/// either moves an entry by less than 1e-12 of the largest. The second begins at some 80 rows; with 400 x 160 cells it
/// takes 2 ms in one thread for slip along or across strike, 40 to 60 % of what all pairs of rows take, and a third of
/// their memory. While the matrix is made, memory is 8 bytes per pair of rows and column, for each pair of components.
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, Medium, PlaneFault, Rectangles};
/// use stickslip_solvers::{Matrix, Operator};
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
    pub(super) cells: Rectangles,
    pub(super) rock: Medium,
    pub(super) poisson_ratio: f64,
    pub(super) space: Space,
    /// The components of slip, along strike and up dip.
    pub(super) directions: [[f64; 2]; C],
    /// The interaction, shared by clones; computed on first use.
    pub(super) interaction: Arc<OnceLock<Arc<Matrix>>>,
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
        let space = Space::Half {
            dip,
            transformed: false,
        };
        Self::new(cells, rock, poisson_ratio, space)
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

    /// The same vertical fault in a half space, with products by Fourier transforms down dip for the images, too: they take
    /// about the same time for 100 rows and more, the matrix is made in a tenth of it (.1 s in place of 1.9 s for 400 x 160
    /// cells of one component), and memory is proportional to the number of cells. Rounding grows with the square of the
    /// number of rows, to 1e-10 of the largest entry for 160 rows.
    ///
    /// # Errors
    /// [`KernelError`] for a plane that dips less than 90 degrees, and for a whole space, whose products are such.
    pub fn transformed_down_dip(mut self) -> Result<Self, KernelError> {
        match &mut self.space {
            Space::Half { dip, transformed } if *dip == 90.0 => *transformed = true,
            Space::Half { dip, .. } => {
                let what = "dip [degrees] of a plane transformed down dip";
                return Err(KernelError::new(what, "that of a vertical plane,", *dip).bound(90.0));
            }
            Space::Whole { .. } => {
                let what = "number of free surfaces beside a plane transformed down dip";
                return Err(KernelError::new(what, "at least", 0.0).bound(1.0));
            }
        }
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
            Space::Half { dip, .. } => Some(dip),
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
