//! Faults in elastic half and whole spaces without a mesh: the stress on the fault by the kernel of its slip, the waves
//! that leave it by radiation damping (J. Rice, J. Geophys. Res. 98 (1993)).
//!
//! ```
//! use nalgebra::Vector1;
//! use stickslip_bie::{Cells, Fault, Medium};
//! use stickslip_solvers::Operator;
//!
//! // A fault that creeps below 40 km, and is locked above: how fast is it stressed at the surface?
//! let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
//! let fault = Fault::half_space(Cells::new([0.0, 40e3], 400)?, rock)?;
//! let mut load = vec![Vector1::new(0.0); 400];
//! fault.plate_loading(1e-9)(1.0, &mut load);
//! // (mu V_p/pi) W/(W^2 - z^2)
//! let exact = 32.04e9 * 1e-9 / std::f64::consts::PI * 40e3 / (40e3_f64.powi(2) - 50f64.powi(2));
//! assert!((load[0][0] / fault.cells().length() / exact - 1.0).abs() < 1e-10);
//! # Ok::<(), stickslip_bie::KernelError>(())
//! ```
//!
//! | item | meaning |
//! | --- | --- |
//! | [`Cells`], [`Section`] | even cells along a line, and some of them: contacts of their own |
//! | [`Fault`] | cells in [`Medium`]: half space, whole space, periodic; its stiffness, radiation damping, and the plate beyond |
//! | [`Mode`] | antiplane, or in plane strain |
//! | [`DippingFault`], [`Sense`] | cells of a thrust or normal fault below a free surface, in plane strain, of any dip |
//! | [`DippingKernel`], [`DippingNormalKernel`] | its operators: shear stress and normal stress of slip |
//! | [`Kernel`] | the operator: products by Fourier transforms, or a dense matrix |
//! | [`Rectangles`], [`PlaneFault`] | a plane of rectangular cells with one or two components of slip: half space at any dip, whole space, periodic |
//! | [`PlaneKernel`], [`PlaneNormalKernel`] | its operators: forces and normal stress due to slip |
//! | [`FaultSystem`], [`Placement`], [`SystemSection`] | several planes in one half space, each with a strike, a dip and a place |
//! | [`SystemKernel`], [`SystemNormalKernel`] | its operators: forces and normal stress due to slip on all planes |
//! | [`Segments`], [`DipProfile`], [`SegmentFault`] | faults along polylines, bent, listric, branched or several, in plane strain or antiplane; stress and displacement off the fault |
//! | [`SurfaceFault`], [`SurfaceSection`] | a fault that is a surface of triangles of any shape, in a half or whole space |
//! | [`CellKernel`], [`CellNormalKernel`] | the operators of both: forces and normal stress due to slip |
//! | [`FaultGeometry`] | a fault as a scene sees it: of one's own, too |
//! | [`Overstress`] | a smooth load that nucleates a rupture at a given place and time |
//! | [`HMatrix`] | a matrix of smooth interactions in clusters, with blocks of low rank between those far from each other ([`hmatrix`]) |
//! | [`Receivers`] | points off a fault: their displacement and stress due to slip, creep beyond the cells |
//! | [`OffFault`], [`Sources`] | faults whose cells move what is beside them: of one's own, too |
//! | [`ReceiverError`] | why there is no displacement at a point |
//! | [`RectangularDislocation`] | the stress and the displacement of a rectangle that slips in a half space, at any point (Okada) |
//! | [`Triangles`], [`CellAxes`], [`SurfaceQuality`] | a surface of triangles: sheets, axes and neighbours of its cells; STL files |
//! | [`SurfaceError`] | why triangles are no surface |
//! | [`TriangularDislocation`] | the stress and the displacement of a triangle that slips, at any point |

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod cells;
mod convolution;
mod error;
mod fault;
mod geometry;
pub mod hmatrix;
mod interaction;
mod kernel;
mod line;
mod line_loads;
mod loading;
mod off_fault;
mod overstress;
mod pivots;
mod plane;
mod segments;
mod surface;

pub use cells::{Cells, Section};
pub use error::KernelError;
pub use fault::{Fault, Medium, Mode};
pub use geometry::{FaultCells, FaultGeometry, LoadHistory};
pub use hmatrix::HMatrix;
pub use interaction::{CellKernel, CellNormalKernel};
pub use kernel::Kernel;
pub use line::{DippingFault, DippingKernel, DippingNormalKernel, Sense};
pub use off_fault::{OffFault, ReceiverError, Receivers, Sources};
pub use overstress::Overstress;
pub use plane::{
    FaultSystem, Placement, PlaneFault, PlaneKernel, PlaneNormalKernel, Rectangles,
    RectangularDislocation, SystemKernel, SystemNormalKernel, SystemSection,
};
pub use segments::{DipProfile, SegmentFault, Segments, SegmentsError, SegmentsQuality};
pub use surface::{
    CellAxes, ResolvedStress, SurfaceError, SurfaceFault, SurfaceQuality, SurfaceSection,
    Triangles, TriangularDislocation,
};
