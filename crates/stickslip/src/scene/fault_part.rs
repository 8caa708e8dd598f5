//! Boundary parts of faults by boundary integrals.

use nalgebra::SVector;
use stickslip_bie::{FaultCells, FaultGeometry, KernelError};
use stickslip_solvers::Operator;

use super::{BoundaryPart, Scene};

/// A point has one coordinate, its position along the fault.
impl From<&stickslip_bie::Section> for BoundaryPart {
    fn from(section: &stickslip_bie::Section) -> Self {
        let cells = section.cells();
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| cells.length()),
            points: section.map(|x| [x, 0.0, 0.0]),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 1,
            mesh: Some(cells.identity()),
        }
    }
}

/// All cells of a fault.
impl From<FaultCells> for BoundaryPart {
    fn from(cells: FaultCells) -> Self {
        Self {
            vertices: (0..cells.areas.len()).collect(),
            weights: cells.areas,
            points: cells.centers,
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: cells.dimension,
            mesh: cells.identity,
        }
    }
}

impl From<&stickslip_bie::Fault> for BoundaryPart {
    fn from(fault: &stickslip_bie::Fault) -> Self {
        FaultGeometry::cells(fault).into()
    }
}

impl From<&stickslip_bie::DippingFault> for BoundaryPart {
    fn from(fault: &stickslip_bie::DippingFault) -> Self {
        FaultGeometry::cells(fault).into()
    }
}

/// A point has two coordinates, `x` and `z`.
impl From<&stickslip_bie::Section<stickslip_bie::Segments>> for BoundaryPart {
    fn from(section: &stickslip_bie::Section<stickslip_bie::Segments>) -> Self {
        let cells = section.cells();
        let vertices = section.vertices().to_vec();
        Self {
            weights: vertices.iter().map(|&cell| cells.length(cell)).collect(),
            points: section.map(|[x, z]| [x, z, 0.0]),
            vertices,
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 2,
            mesh: Some(cells.identity()),
        }
    }
}

impl From<&stickslip_bie::SegmentFault> for BoundaryPart {
    fn from(fault: &stickslip_bie::SegmentFault) -> Self {
        FaultGeometry::cells(fault).into()
    }
}

/// A point has two coordinates, along strike and down dip.
impl From<&stickslip_bie::Section<stickslip_bie::Rectangles>> for BoundaryPart {
    fn from(section: &stickslip_bie::Section<stickslip_bie::Rectangles>) -> Self {
        let cells = section.cells();
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| cells.area()),
            points: section.map(|[x, y]| [x, y, 0.0]),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 2,
            mesh: Some(cells.identity()),
        }
    }
}

impl<const C: usize> From<&stickslip_bie::PlaneFault<C>> for BoundaryPart {
    fn from(fault: &stickslip_bie::PlaneFault<C>) -> Self {
        FaultGeometry::cells(fault).into()
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
impl From<&stickslip_bie::SystemSection> for BoundaryPart {
    fn from(section: &stickslip_bie::SystemSection) -> Self {
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.map(|_| section.cells().area()),
            points: section.points().to_vec(),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 3,
            mesh: Some(section.identity()),
        }
    }
}

/// The cells of all planes. A point has three coordinates: east, north, and up from the surface.
impl<const C: usize> From<&stickslip_bie::FaultSystem<C>> for BoundaryPart {
    fn from(system: &stickslip_bie::FaultSystem<C>) -> Self {
        FaultGeometry::cells(system).into()
    }
}

/// A point has three coordinates: those of the triangles.
impl From<&stickslip_bie::SurfaceSection> for BoundaryPart {
    fn from(section: &stickslip_bie::SurfaceSection) -> Self {
        Self {
            vertices: section.vertices().to_vec(),
            weights: section.areas().to_vec(),
            points: section.points().to_vec(),
            normals: Vec::new(),
            axes: Vec::new(),
            opposite: None,
            dimension: 3,
            mesh: Some(section.identity()),
        }
    }
}

/// All triangles of a surface.
///
/// ```
/// use stickslip::bie::{Medium, SurfaceFault, Triangles};
/// use stickslip::friction::RegularizedDieterichRuina;
/// use stickslip::nalgebra::Vector1;
/// use stickslip::state::{Dieterich, LogTheta};
/// use stickslip::{Contact, RungeKutta, Scene, Steps};
///
/// // A fault that bends: two quadrangles of 1 km, of two triangles each.
/// let points = [
///     [0.0, 0.0, 0.0], [1e3, 0.0, 0.0], [2e3, 400.0, 0.0],
///     [0.0, 0.0, -1e3], [1e3, 0.0, -1e3], [2e3, 400.0, -1e3],
/// ];
/// let cells = Triangles::new(&points, &[[0, 3, 1], [1, 3, 4], [1, 4, 2], [2, 4, 5]])?;
/// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
/// let fault = SurfaceFault::half_space(cells, rock, 0.25)?;
/// // Right-lateral slip along x: one plate vector, tangential on each cell.
/// let plate = [1e-9, 0.0, 0.0];
/// let rakes = fault.rakes_along(plate);
/// let fault = fault.with_rakes(&rakes)?;
/// let rates = fault.along(plate);
/// let law = RegularizedDieterichRuina {
///     a: 0.015,
///     b: 0.010,
///     reference_friction: 0.6,
///     reference_velocity: 1e-6,
///     slip_distance: 0.1,
/// };
/// let contact = Contact::new(&fault, law, 50e6)
///     .with_state(Dieterich { slip_distance: 0.1 }, LogTheta(1e8_f64.ln()))
///     .with_shear_stress(Vector1::new(28.27e6));
/// let scene = Scene::new(fault.stiffness())
///     .with_viscosity(fault.radiation_damping())
///     .with_load_history(fault.back_slip(&rates)?)
///     .with_normal_stress_change(fault.normal_stiffness(), rates)
///     .with_contact(contact);
/// let mut motion = RungeKutta::new(scene)?;
/// motion.run(&Steps::adaptive(1e-6).until(1e8), |_| ())?;
/// // It creeps with the plates.
/// assert!((motion.snapshot().displacement[0][0] - 0.1).abs() < 0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<const C: usize> From<&stickslip_bie::SurfaceFault<C>> for BoundaryPart {
    fn from(fault: &stickslip_bie::SurfaceFault<C>) -> Self {
        FaultGeometry::cells(fault).into()
    }
}

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// The scene of a fault by boundary integrals, of one's own, too: its stiffness, radiation damping, plate loading at a
    /// plate velocity [m/s], and normal stress that follows its slip. Contacts on its cells complete it.
    ///
    /// ```
    /// use stickslip::bie::{Cells, DippingFault, Medium, Sense};
    /// use stickslip::friction::RegularizedDieterichRuina;
    /// use stickslip::nalgebra::Vector1;
    /// use stickslip::state::{Dieterich, LogTheta};
    /// use stickslip::{Contact, RungeKutta, Scene, Steps};
    ///
    /// let rock = Medium { shear_modulus: 32.04e9, shear_wave_speed: 3464.0 };
    /// let fault = DippingFault::new(Cells::new([0.0, 4e3], 8)?, rock, 0.25, 30.0, Sense::Thrust)?;
    /// let law = RegularizedDieterichRuina {
    ///     a: 0.015,
    ///     b: 0.010,
    ///     reference_friction: 0.6,
    ///     reference_velocity: 1e-6,
    ///     slip_distance: 0.1,
    /// };
    /// let contact = Contact::new(&fault, law, 50e6)
    ///     .with_state(Dieterich { slip_distance: 0.1 }, LogTheta(1e8_f64.ln()))
    ///     .with_shear_stress(Vector1::new(28.27e6));
    /// let scene = Scene::of_fault(&fault, Vector1::new(1e-9))?.with_contact(contact);
    /// let mut motion = RungeKutta::new(scene)?;
    /// motion.run(&Steps::adaptive(1e-6).until(1e8), |_| ())?;
    /// // It creeps with the plate.
    /// assert!((motion.snapshot().displacement[0][0] - 0.1).abs() < 0.02);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`KernelError`] for a velocity that is not finite.
    pub fn of_fault(
        fault: &impl FaultGeometry<C, Kernel = Op>,
        plate_velocity: SVector<f64, C>,
    ) -> Result<Self, KernelError> {
        let scene = Self::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_load_history(fault.plate_loading(plate_velocity)?);
        Ok(match fault.normal_stress_change() {
            Some(change) => scene.with_normal_stress_change(change, plate_velocity),
            None => scene,
        })
    }
}
