//! The matrices of a planar fault.

use std::sync::Arc;

use nalgebra::SMatrix;
use stickslip_core::compiled;

use super::angles::cos_sin;
use super::convolution::Convolution;
use super::dislocation::Rock;
use super::fault::Space;
use super::matrix::Matrix;
use super::mirrored::Mirrored;
use super::whole_space::WholeSpace;
use super::{PlaneFault, PlaneKernel, PlaneNormalKernel, assembly, periodic};
use crate::KernelError;
use crate::error::check_factor;

impl<const C: usize> PlaneFault<C> {
    /// The stiffness matrix \[N/m\]: forces on cells due to slip, positive against it. It is computed on
    /// first use and shared by clones.
    pub fn stiffness(&self) -> PlaneKernel<C> {
        let interaction = self.interaction.get_or_init(|| Arc::new(matrix(self)));
        PlaneKernel::of_interaction(self.cells.count(), Arc::clone(interaction))
            .on(self.cells.identity())
    }

    /// Rock with the plane's axes; those of a vertical plane in a whole space.
    pub(super) fn dipping(&self) -> Rock {
        let axes = cos_sin(self.dip().unwrap_or(90.0));
        Rock::new(self.rock.shear_modulus, self.poisson_ratio, axes)
    }

    /// The change of normal stress per slip [Pa/m], compression positive. It is 0 in a whole space and on a vertical
    /// plane.
    pub fn normal_stiffness(&self) -> PlaneNormalKernel<C> {
        normal_stiffness(self)
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
        check_factor(factor)?;
        Ok(self.damping(factor))
    }

    fn damping(&self, factor: f64) -> PlaneKernel<C> {
        let eta = 0.5 * factor * self.rock.shear_modulus / self.rock.shear_wave_speed;
        let block = SMatrix::from_diagonal_element(eta * self.cells.area());
        PlaneKernel::diagonal(vec![block; self.cells.count()]).on(self.cells.identity())
    }
}

compiled! {
    fn matrix<C>(fault: &PlaneFault<C>) -> Matrix {
        let (cells, directions) = (&fault.cells, &fault.directions);
        let space = WholeSpace::new(cells, fault.rock.shear_modulus, fault.poisson_ratio);
        let counts = [cells.along_strike().count(), cells.down_dip().count()];
        let periodic = match fault.space {
            Space::Half { transformed, .. } => {
                let rock = fault.dipping();
                return if transformed {
                    Matrix::Mirrored(Mirrored::new(cells, &rock, &space, directions))
                } else {
                    Matrix::Layers(assembly::shear(cells, &rock, &space, directions))
                };
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

    fn normal_stiffness<C>(fault: &PlaneFault<C>) -> PlaneNormalKernel<C> {
        match fault.dip() {
            Some(dip) if dip < 90.0 => {
                let (cells, rock) = (&fault.cells, fault.dipping());
                let space = WholeSpace::new(cells, fault.rock.shear_modulus, fault.poisson_ratio);
                PlaneNormalKernel::new(
                    cells,
                    assembly::normal(cells, &rock, &space, &fault.directions),
                )
            }
            _ => PlaneNormalKernel::zero(&fault.cells),
        }
    }
}
