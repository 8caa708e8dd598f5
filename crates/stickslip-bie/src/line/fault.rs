//! A dipping fault below a free surface.

use std::f64::consts::PI;

use nalgebra::SVector;

use super::dislocation::{Plane, Traction};
use super::images::Images;
use super::low_rank::LowRank;
use super::{DippingKernel, DippingNormalKernel};
use crate::fault::{check_medium, check_poisson_ratio};
use crate::loading::relieving;
use crate::{Cells, Kernel, KernelError, Medium};

/// The sense of positive slip on a dipping fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sense {
    /// The hanging wall moves up dip: a thrust or reverse fault.
    #[doc(alias = "reverse")]
    Thrust,
    /// The hanging wall moves down dip: a normal fault.
    Normal,
}

/// A planar fault of any dip in a half space in plane strain, quasi-dynamic: slip along the dip changes shear **and**
/// normal stress. Positions are distances down dip from the trace of the fault on the free surface.
///
/// ```text
/// tau = tau0 - (K D)/h,   sigma = sigma0 + N D          h the length of a cell
/// ```
///
/// with the slip `D` across the fault, `tau` positive in the direction of slip, `sigma` positive in compression, `K` the
/// [`stiffness`](Self::stiffness) and `N` the [`normal_stiffness`](Self::normal_stiffness). Forces are those on a cell,
/// stress times its length [N/m]. For slip that is constant on cells, both are exact at their centres, up to 1e-10 of
/// the stiffness of a cell.
///
/// | | thrust | normal fault |
/// | --- | --- | --- |
/// | positive slip | hanging wall up dip | hanging wall down dip |
/// | `K` | `K` | `K` |
/// | `N` | `N` | `-N` |
/// | slip of the shallowest cell | unclamps it | clamps it |
///
/// ```
/// use nalgebra::Vector1;
/// use stickslip_bie::{Cells, DippingFault, Medium, Sense};
///
/// // BP3: 40 km down dip at 60 degrees.
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Cells::new([0.0, 40e3], 400)?;
/// let fault = DippingFault::new(cells, rock, 0.25, 60.0, Sense::Thrust)?;
/// // The shallowest cell slips by 1 m, and unclamps itself.
/// let mut slip = vec![Vector1::new(0.0); 400];
/// slip[0][0] = 1.0;
/// let mut stress = vec![0.0; 400];
/// fault.normal_stiffness().multiply_add(1.0, &slip, &mut stress);
/// assert!((stress[0] * cells.length() / rock.shear_modulus + 0.01286).abs() < 1e-5);
/// # Ok::<(), stickslip_bie::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias(
    "BP3",
    "dip",
    "reverse fault",
    "thrust fault",
    "normal fault",
    "plane strain",
    "quasi-dynamic"
))]
pub struct DippingFault {
    cells: Cells,
    rock: Medium,
    poisson_ratio: f64,
    /// In degrees.
    dip: f64,
    sense: Sense,
}

impl DippingFault {
    /// `cells` down dip, `poisson_ratio` above -1 and below 1/2, `dip` in degrees from the horizontal, above 0 and at
    /// most 90.
    ///
    /// # Errors
    /// [`KernelError`] for rock, Poisson's ratio or dip out of their ranges, and for cells that begin above the surface.
    pub fn new(
        cells: Cells,
        rock: Medium,
        poisson_ratio: f64,
        dip: f64,
        sense: Sense,
    ) -> Result<Self, KernelError> {
        check_medium(rock)?;
        check_poisson_ratio(poisson_ratio)?;
        if !(dip > 0.0 && dip <= 90.0) {
            let requirement = "above 0 and at most";
            return Err(KernelError::new("dip [degrees]", requirement, dip).bound(90.0));
        }
        let [begin, _] = cells.ends();
        if begin < 0.0 {
            let what = "distance [m] down dip of the fault's upper end";
            return Err(KernelError::new(what, "at least", begin).bound(0.0));
        }
        Ok(Self {
            cells,
            rock,
            poisson_ratio,
            dip,
            sense,
        })
    }

    /// Its cells.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// The dip in degrees from the horizontal.
    pub fn dip(&self) -> f64 {
        self.dip
    }

    /// The rock, and Poisson's ratio.
    pub(crate) fn rock(&self) -> (Medium, f64) {
        (self.rock, self.poisson_ratio)
    }

    /// The sense of positive slip.
    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// The stiffness matrix `K` \[Pa\]: forces on cells that resist their slip. It is not symmetric, see
    /// [`DippingKernel`].
    pub fn stiffness(&self) -> DippingKernel {
        let modulus = self.modulus();
        let influence = |apart: f64| modulus / (2.0 * PI) / (0.25 - apart * apart);
        let whole = Kernel::of_distances(self.cells.count(), |m| influence(m as f64), None);
        let images = self.images(|Traction { shear, .. }| -shear);
        DippingKernel::new(whole.on(self.cells.identity()), Some(LowRank::of(&images)))
    }

    /// The change of normal stress per slip [Pa/m], compression positive; zero for a vertical fault.
    pub fn normal_stiffness(&self) -> DippingNormalKernel {
        let sign = match self.sense {
            Sense::Thrust => 1.0,
            Sense::Normal => -1.0,
        };
        let images = self.images(move |Traction { normal, .. }| sign * normal);
        DippingNormalKernel::new(LowRank::of(&images), &self.cells)
    }

    /// The radiation damping as a viscosity matrix, for shear waves along the fault's normal [Pa s/m times a length]:
    /// `eta = mu/(2 c_s)` on a cell.
    #[doc(alias = "quasi-dynamic")]
    pub fn radiation_damping(&self) -> DippingKernel {
        let damping = 0.5 * self.rock.shear_modulus / self.rock.shear_wave_speed;
        let each = vec![damping * self.cells.length(); self.cells.count()];
        DippingKernel::new(Kernel::diagonal(each).on(self.cells.identity()), None)
    }

    /// Plate loading, a load history of the shear stress: the fault creeps at `rate` [m/s] below the cells, and above
    /// them if they begin below the surface. Cells that creep at this rate are not stressed: the stress rate is
    /// `-K (V - V_p)`.
    ///
    /// Normal stress is loaded likewise, at the rate `N (V - V_p)`.
    pub fn plate_loading(
        &self,
        rate: f64,
    ) -> impl Fn(f64, &mut [SVector<f64, 1>]) + Send + Sync + 'static {
        let moved = vec![SVector::from([rate]); self.cells.count()];
        relieving(&self.stiffness(), &moved)
    }

    /// `mu/(1 - nu)`.
    fn modulus(&self) -> f64 {
        self.rock.shear_modulus / (1.0 - self.poisson_ratio)
    }

    /// The forces of the images, by one component of the traction.
    fn images<F: Fn(Traction) -> f64>(&self, component: F) -> Images<F> {
        let dip = self.dip.to_radians();
        Images {
            plane: Plane::new(self.rock.shear_modulus, self.poisson_ratio, dip),
            count: self.cells.count(),
            begin: self.cells.ends()[0] / self.cells.length(),
            scale: self.modulus(),
            dip,
            component,
        }
    }
}
