//! A part of a boundary: vertices with their shares of a surface.

use nalgebra::{SMatrix, Vector3};

use crate::SceneError;
use crate::contact::check::require;

/// The vertices of a boundary part, with their geometry.
///
/// It is made from a `Trace` of the finite element crate, from the cells of a planar fault by boundary integrals, or
/// with [`BoundaryPart::point`] for a spring slider. Points and normals have three coordinates; a plane body uses two.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryPart {
    /// Vertex indices, increasing.
    pub vertices: Vec<usize>,
    /// The integral of each vertex's hat function [m^2; m in 2D].
    pub weights: Vec<f64>,
    /// The position of each vertex \[m\]; empty if unknown.
    pub points: Vec<[f64; 3]>,
    /// The outward unit normal at each vertex, zero where it does not exist; empty if unknown, as at a point.
    pub normals: Vec<[f64; 3]>,
    /// The axes of the fixed or driven components at each vertex, orthonormal; empty for coordinate axes.
    pub axes: Vec<[[f64; 3]; 3]>,
    /// The number of coordinates: 1 along a line fault by boundary integrals, 2 in the plane or on a planar fault, 3 in
    /// space or on several planar faults, 0 for a point.
    pub dimension: usize,
    /// The fingerprint of the mesh; `None` if unknown, as at a point. The parts of a scene belong to one mesh.
    pub mesh: Option<u64>,
}

impl BoundaryPart {
    /// Vertex 0 with the area `area` [m^2]; all its components are tangential.
    pub fn point(area: f64) -> Self {
        Self {
            vertices: vec![0],
            weights: vec![area],
            points: Vec::new(),
            normals: Vec::new(),
            axes: Vec::new(),
            dimension: 0,
            mesh: None,
        }
    }

    /// Replaces the unit normals by a function of the position \[m\], such as those of the smooth surface that the mesh
    /// approximates. They are normalised.
    ///
    /// The normals of a `Trace` are the means over the faces at a vertex, weighted by area. A vertex has no normal
    /// where a face deviates from the mean by more than 30 degrees, at an edge or a corner.
    #[must_use]
    pub fn with_normals(mut self, normal: impl Fn(&[f64; 3]) -> [f64; 3]) -> Self {
        self.normals = (self.points.iter())
            .map(|x| {
                let normal = normal(x);
                let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
                normal.map(|n| n / length)
            })
            .collect();
        self
    }

    /// Sets the axes of Dirichlet conditions by a function of the position \[m\]: component `c` of a velocity is along
    /// the axis number `c`. They are orthonormal; in the plane the third is `[0, 0, 1]`.
    #[must_use]
    pub fn with_axes(mut self, axes: impl Fn(&[f64; 3]) -> [[f64; 3]; 3]) -> Self {
        self.axes = self.points.iter().map(axes).collect();
        self
    }

    /// Sets the normal as the first axis and tangential directions as the others: `fix(part.along_normals(),
    /// Components::X)` is a roller condition on a surface of any shape. In the plane the second axis is the normal
    /// rotated to the left by a right angle. In space the others are orthogonal to the normal, and the second of them
    /// also to the coordinate with the smallest component of the normal.
    #[must_use]
    pub fn along_normals(mut self) -> Self {
        let plane = self.dimension == 2;
        self.axes = (self.normals.iter())
            .map(|&n| {
                if plane {
                    return [n, [-n[1], n[0], 0.0], [0.0, 0.0, 1.0]];
                }
                let normal = Vector3::from(n);
                let least = normal.iamin();
                let unit = Vector3::from_fn(|c, _| f64::from(u8::from(c == least)));
                let second = normal.cross(&unit).normalize();
                [n, second.into(), normal.cross(&second).into()]
            })
            .collect();
        self
    }

    /// The axes of the vertex at a position as columns.
    pub(crate) fn axes_at<const C: usize>(&self, position: usize) -> SMatrix<f64, C, C> {
        match self.axes.get(position) {
            None => SMatrix::identity(),
            Some(axes) => SMatrix::from_fn(|row, column| axes[column][row]),
        }
    }

    /// Checks a part with the boundary condition `what` in a body of `size` vertices.
    pub(crate) fn check(
        &self,
        what: &'static str,
        size: usize,
        may_be_empty: bool,
    ) -> Result<(), SceneError> {
        if self.vertices.is_empty() && !may_be_empty {
            return Err(SceneError::EmptyBoundary { what });
        }
        let expected = self.vertices.len();
        for (found, optional) in [
            (self.weights.len(), false),
            (self.points.len(), true),
            (self.normals.len(), true),
            (self.axes.len(), true),
        ] {
            if found != expected && !(optional && found == 0) {
                return Err(SceneError::Length {
                    what,
                    expected,
                    found,
                });
            }
        }
        for (position, (&vertex, &weight)) in self.vertices.iter().zip(&self.weights).enumerate() {
            let increasing = position == 0 || self.vertices[position - 1] < vertex;
            let requirement = "a vertex of the mesh, above its predecessor";
            let legal = vertex < size && increasing;
            require(what, requirement, position, vertex as f64, legal)?;
            let requirement = "given weights that are finite and not negative";
            let legal = weight >= 0.0 && weight.is_finite();
            require(what, requirement, position, weight, legal)?;
        }
        for (position, normal) in self.normals.iter().enumerate() {
            let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let legal = length == 0.0 || (length - 1.0).abs() <= 1e-9;
            let requirement = "given normals of unit length";
            require(what, requirement, position, length, legal)?;
        }
        for (position, axes) in self.axes.iter().enumerate() {
            for (i, a) in axes.iter().enumerate() {
                for (j, b) in axes.iter().enumerate() {
                    let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                    let expected = f64::from(u8::from(i == j));
                    let legal = (product - expected).abs() <= 1e-9;
                    let requirement = "given axes that are orthogonal and of length 1";
                    require(what, requirement, position, product, legal)?;
                }
            }
        }
        Ok(())
    }
}

#[cfg(feature = "fem")]
impl<const D: usize> From<&stickslip_fem::Trace<D>> for BoundaryPart {
    fn from(trace: &stickslip_fem::Trace<D>) -> Self {
        let normals = smooth_normals(trace);
        let padded = |x: &nalgebra::SVector<f64, D>| {
            std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))
        };
        Self {
            vertices: trace.vertices().to_vec(),
            weights: trace.weights().to_vec(),
            points: trace.points().iter().map(padded).collect(),
            normals: normals.iter().map(padded).collect(),
            axes: Vec::new(),
            dimension: D,
            mesh: Some(trace.mesh()),
        }
    }
}

/// A point has one coordinate, its position along the fault.
#[cfg(feature = "bie")]
impl From<&stickslip_bie::Section> for BoundaryPart {
    fn from(section: &stickslip_bie::Section) -> Self {
        let cells = section.cells();
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| cells.length()),
            points: section.map(|x| [x, 0.0, 0.0]),
            normals: Vec::new(),
            axes: Vec::new(),
            dimension: 1,
            mesh: Some(cells.fingerprint()),
        }
    }
}

#[cfg(feature = "bie")]
impl From<&stickslip_bie::Fault> for BoundaryPart {
    fn from(fault: &stickslip_bie::Fault) -> Self {
        Self::from(&fault.cells().all())
    }
}

#[cfg(feature = "bie")]
impl From<&stickslip_bie::DippingFault> for BoundaryPart {
    fn from(fault: &stickslip_bie::DippingFault) -> Self {
        Self::from(&fault.cells().all())
    }
}

/// A point has two coordinates, along strike and down dip.
#[cfg(feature = "bie")]
impl From<&stickslip_bie::Section<stickslip_bie::Rectangles>> for BoundaryPart {
    fn from(section: &stickslip_bie::Section<stickslip_bie::Rectangles>) -> Self {
        let cells = section.cells();
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| cells.area()),
            points: section.map(|[x, y]| [x, y, 0.0]),
            normals: Vec::new(),
            axes: Vec::new(),
            dimension: 2,
            mesh: Some(cells.fingerprint()),
        }
    }
}

#[cfg(feature = "bie")]
impl<const C: usize> From<&stickslip_bie::PlaneFault<C>> for BoundaryPart {
    fn from(fault: &stickslip_bie::PlaneFault<C>) -> Self {
        Self::from(&fault.cells().all())
    }
}

/// A point has three coordinates: east, north, and up from the surface.
///
/// ```
/// use stickslip::bie::{Cells, FaultSystem, Medium, Placement, PlaneFault, Rectangles};
/// use stickslip::friction::RegularizedDieterichRuina;
/// use stickslip::nalgebra::Vector1;
/// use stickslip::state::{Dieterich, LogTheta};
/// use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, Steps};
///
/// // Two parallel strike-slip faults, each with a contact of its own.
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let cells = Rectangles::new(Cells::new([-2e3, 2e3], 4)?, Cells::new([0.0, 2e3], 2)?);
/// let plane = PlaneFault::half_space(cells, 90.0, rock, 0.25)?.with_rake(0.0)?;
/// let system = FaultSystem::new([
///     (plane.clone(), Placement { strike: 0.0, origin: [0.0, 0.0] }),
///     (plane, Placement { strike: 0.0, origin: [3e3, 0.0] }),
/// ])?;
/// let rate = Vector1::new(1e-9);
/// let mut scene = Scene::new(system.stiffness())
///     .with_viscosity(system.radiation_damping())
///     .with_load_history(system.plate_loading(&[rate, rate])?)
///     .with_normal_stress_change(system.normal_stiffness(), rate);
/// let law = RegularizedDieterichRuina {
///     a: 0.015,
///     b: 0.010,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.1,
/// };
/// for number in 0..2 {
///     let section = system.section(number, |_| true)?;
///     assert_eq!(BoundaryPart::from(&section).points[0], system.center(8 * number));
///     let contact = Contact::new(&section, law, 50e6)
///         .with_state(Dieterich { slip_distance: 0.1 }, LogTheta(1e8_f64.ln()))
///         .with_shear_stress(Vector1::new(28.27e6));
///     scene = scene.with_contact(contact);
/// }
/// let mut motion = RungeKutta::new(scene)?;
/// motion.run(&Steps::adaptive(1e-6).until(1e8), |_| ())?;
/// // Both creep with the plates, in step.
/// let slip = motion.snapshot().displacement;
/// assert!((slip[0][0] - 0.1).abs() < 0.02 && (slip[0][0] - slip[8][0]).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "bie")]
impl From<&stickslip_bie::SystemSection> for BoundaryPart {
    fn from(section: &stickslip_bie::SystemSection) -> Self {
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| section.cells().area()),
            points: section.points().to_vec(),
            normals: Vec::new(),
            axes: Vec::new(),
            dimension: 3,
            mesh: Some(section.fingerprint()),
        }
    }
}

/// The cells of all planes. A point has three coordinates: east, north, and up from the surface.
#[cfg(feature = "bie")]
impl<const C: usize> From<&stickslip_bie::FaultSystem<C>> for BoundaryPart {
    fn from(system: &stickslip_bie::FaultSystem<C>) -> Self {
        let vertices = || 0..system.vertex_count();
        Self {
            vertices: vertices().collect(),
            weights: vertices().map(|vertex| system.area(vertex)).collect(),
            points: vertices().map(|vertex| system.center(vertex)).collect(),
            normals: Vec::new(),
            axes: Vec::new(),
            dimension: 3,
            mesh: Some(system.fingerprint()),
        }
    }
}

impl From<&BoundaryPart> for BoundaryPart {
    fn from(part: &BoundaryPart) -> Self {
        part.clone()
    }
}

/// The normals of a trace, zero where a face deviates from the mean of its vertex by more than 30 degrees.
#[cfg(feature = "fem")]
fn smooth_normals<const D: usize>(
    trace: &stickslip_fem::Trace<D>,
) -> Vec<nalgebra::SVector<f64, D>> {
    const SMOOTH: f64 = 0.866_025_403_784_438_6;
    let mut normals = trace.normals().to_vec();
    let face_normals = trace.face_normals();
    for (face, normal) in trace.faces().iter().zip(&face_normals) {
        for &k in face {
            if trace.normals()[k].dot(normal) < SMOOTH {
                normals[k] = nalgebra::SVector::zeros();
            }
        }
    }
    normals
}
