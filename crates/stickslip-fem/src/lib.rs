//! Finite elements for the body: simplicial meshes with uniform refinement, continuous piecewise linear
//! functions, and the operators, loads and boundary parts of elasticity and antiplane shear.
//!
//! A layer of thickness 1 m hangs from its top and sags out of the plane under the force f [N/m^2] by
//! u = f (1 - y^2) / (2 mu), here solved by Gauss-Seidel:
//!
//! ```
//! use nalgebra::Vector1;
//! use stickslip_fem::{Constraints, P1, antiplane, body_force};
//!
//! let space = P1::grid([2.0, 1.0], [2, 1])?.refined(2)?;
//! let (stiffness, load) = (antiplane(&space, 3e10)?, body_force(&space, |_| Vector1::new(1e4)));
//! let mut held = Constraints::none(&space);
//! held.fix(&space.trace(|x| x[1] == 1.0)?, [true])?;
//! let mut u = vec![Vector1::new(0.0); space.vertex_count()];
//! for _ in 0..400 {
//!     for (p, row) in stiffness.outer_iterator().enumerate().filter(|(p, _)| !held.as_slice()[*p][0]) {
//!         let residual = row.iter().fold(load[p], |r, (q, block)| r - block * u[q]);
//!         u[p] += stiffness.get(p, p).map_or(residual, |diagonal| residual / diagonal[0]);
//!     }
//! }
//! let lowest = space.vertex_at([1.0, 0.0]).map(|p| u[p][0]);
//! assert!(lowest.is_some_and(|u| (u / (1e4 / 6e10) - 1.0).abs() < 1e-9));
//! # Ok::<(), stickslip_fem::FemError>(())
//! ```
//!
//! | item | meaning |
//! | --- | --- |
//! | [`Mesh`] | triangles (D = 2) or tetrahedra (D = 3), read from lists or cut from a box |
//! | [`NonconformingNodes`] | duplicate and hanging nodes of a mesh |
//! | [`Hierarchy`] | a mesh, its refinements and the interpolations between them: [uniform](P1::refined), [by a size function](P1::graded), [onto a curved boundary](P1::refined_onto) |
//! | [`P1`] | the function space on the finest mesh: the start of every program |
//! | [`Trace`] | a part of the boundary with its lumped weights: by position, or [by name](P1::part) |
//! | [`Mesh::with_surface`], [`Mesh::split`] | a fault inside the body: the mesh is split along it, and has two sides there |
//! | [`Constraints`] | Dirichlet conditions: the prescribed components of each vertex |
//! | [`elasticity`], [`antiplane`], [`mass`] | operators as [`BlockMatrix`]: sparse rows of C x C blocks, with the [identity of their mesh](Assembled) |
//! | [`viscosity`], [`dashpot`] | damping, in the body and at an absorbing boundary |
//! | [`elasticity_by_cell`], [`mass_by_cell`] | the same by a function of the cell, or [by the name of its material](P1::by_material) |
//! | [`Samples`] | values at points, nearest or linear, for parameters that vary |
//! | [`body_force`], [`traction`] | loads, one vector per vertex |
//! | [`stress`] | the Cauchy stress of each cell |
//! | [`l2_error`], [`h1_error`] | distance from an exact solution |
//!
//! With the feature `gmsh` the module `gmsh` reads files of Gmsh, and names of groups in them; with `csv`
//! `Samples::read` reads tables; with `rayon` operators of large bodies are assembled in the threads of the pool of
//! their caller, with the same bits on any number of them.
//!
//! # Faults inside a body
//!
//! A named surface between cells is a fault with two deformable sides once the mesh is split along it. Each vertex has
//! an [opposite](Trace::opposite) one on the other side, at the same point, with the same weight and the opposite
//! normal; at a tip it is itself. Faults may be bent, end inside, cross and branch: [`Mesh::split`] has the rules, and
//! the side that is called plus.
//!
//! ```
//! use stickslip_fem::{GridDiagonal, Mesh, P1};
//!
//! // A fault of 1 km that dips by 45 degrees in a block of 2 km x 1 km, and ends inside.
//! let mesh = Mesh::<2>::grid([2000.0, 1000.0], [16, 8], GridDiagonal::Rising)?
//!     .with_surface_where("thrust", |x| x[1] == x[0] - 500.0 && x[1] >= 250.0)?
//!     .split("thrust")?;
//! let space = P1::new(mesh).graded(|x| 10.0 + 0.2 * (x[1] - x[0] + 500.0).abs())?;
//! let (hanging, foot) = (space.part("thrust+")?, space.part("thrust-")?);
//! assert!(foot.normals().iter().all(|n| n[0] < 0.0 && n[1] > 0.0));
//! let opposite = hanging.opposite().unwrap_or_default();
//! let tips = hanging.vertices().iter().zip(opposite).filter(|(p, q)| p == q);
//! assert_eq!((tips.count(), opposite.len()), (1, foot.vertices().len()));
//! # Ok::<(), stickslip_fem::FemError>(())
//! ```
//!
//! The mesh has D dimensions and a field C components: plane strain and solids have C = D, antiplane
//! shear has C = 1 on a plane mesh. Vertex index, block index and row of a matrix are one number.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod antiplane;
mod assembled;
mod assembly;
mod auxiliary;
mod bisection;
mod boundary;
mod by_material;
mod check;
mod children;
mod constraints;
mod curve;
mod curves;
mod cut;
mod dashpot;
mod edges;
mod elasticity;
mod elementwise;
mod error;
#[cfg(any(feature = "gmsh", feature = "csv"))]
mod file_place;
mod fingerprint;
mod forest;
#[cfg(feature = "gmsh")]
pub mod gmsh;
mod graded;
mod grading;
mod grid;
mod groups;
mod hierarchy;
mod identity;
mod inner_surfaces;
mod load;
mod marks;
mod mass;
mod mesh;
mod named;
mod nonconforming;
mod norms;
mod numbering;
mod points;
mod quadrature;
#[cfg(any(feature = "gmsh", feature = "csv"))]
mod read_error;
mod refine;
mod restriction;
mod rows;
mod samples;
#[cfg(feature = "csv")]
mod samples_csv;
mod scaled;
mod simplex;
mod space;
mod sparse;
mod sponge;
mod stress;
mod surfaces;
mod trace;
mod twin_edges;
mod viscosity;
mod weights;

pub use nalgebra;
pub use sprs;
pub use stickslip_core::MOST_LEVELS;

/// The cosine of 30 degrees: normals that differ by less are those of one smooth surface.
pub const SMOOTH: f64 = 0.866_025_403_784_438_6;

pub use antiplane::{antiplane, antiplane_by_cell};
pub use assembled::Assembled;
pub use constraints::Constraints;
pub use cut::SplitSurface;
pub use dashpot::{Impedance, antiplane_dashpot, dashpot};
pub use elasticity::{Elastic, elasticity, elasticity_by_cell};
pub use elementwise::{
    BeginPart, ElementStiffness, EndPart, element_stiffness, element_stiffness_by_cell,
};
pub use error::FemError;
#[cfg(any(feature = "gmsh", feature = "csv"))]
pub use file_place::{FileItem, FilePlace};
pub use grid::GridDiagonal;
pub use hierarchy::Hierarchy;
pub use identity::MeshIdentity;
pub use load::{body_force, traction};
pub use mass::{lumped_mass, lumped_mass_by_cell, mass, mass_by_cell};
pub use mesh::Mesh;
pub use nonconforming::{Hanging, NonconformingNodes};
pub use norms::{h1_error, l2_error};
#[cfg(any(feature = "gmsh", feature = "csv"))]
pub use read_error::ReadError;
pub use samples::{Interpolation, Samples};
pub use space::P1;
pub use sparse::{BlockMatrix, Prolongation};
pub use sponge::{Sponge, sponge};
pub use stress::{stress, stress_by_cell};
pub use trace::Trace;
pub use viscosity::{Viscous, viscosity, viscosity_by_cell};
