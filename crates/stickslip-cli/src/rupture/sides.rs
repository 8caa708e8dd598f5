//! Bodies and scenes under slip weakening: one body that stands for both halves, or a body on each side of the fault.

use stickslip::fem::{
    FemError, Mesh, P1, dashpot, element_stiffness_by_cell, lumped_mass_by_cell, traction,
};
use stickslip::nalgebra::Vector2;
use stickslip::state::{SlipWeakening, Weakening};
use stickslip::{
    CentralDifferences, Contact, Diagonal, ElementOperator, NormalStress, Scene, Simulation,
};

use super::weakening::{EXTENT, NORMAL, SLIP_DISTANCE, friction, prestress};
use super::{Arguments, Rock};
use crate::cli::Problem;

/// The distance along strike at which the body ends, on both sides \[m\].
const LENGTH: f64 = 36e3;

/// A problem of slip weakening.
pub(super) struct Sides<'a> {
    pub arguments: &'a Arguments,
    /// The patches of other initial shear stress.
    pub patches: &'a [(f64, f64)],
    /// The rock above the fault.
    pub above: Rock,
    /// The rock below it; without one the body above stands for both halves.
    pub below: Option<Rock>,
}

impl Sides<'_> {
    /// The space and the simulation, before the first step.
    ///
    /// # Errors
    /// A mesh or a scene that is refused.
    pub(super) fn build(&self) -> Result<(P1<2>, Simulation<2>), Problem> {
        let height = self.arguments.height;
        let quarter = P1::grid([LENGTH, height], [6, 5])?.graded(|x| {
            let beyond = (x[0] - EXTENT).max(0.0);
            self.arguments.size(beyond.hypot(x[1]))
        })?;
        let half = doubled(quarter.mesh(), 0)?;
        let space = if self.below.is_some() {
            let whole = doubled(&half, 1)?.with_surface_where("fault", |x| x[1] == 0.0)?;
            P1::new(whole.split("fault")?)
        } else {
            P1::new(half)
        };
        let ends = space.trace(|x| x[0].abs() == LENGTH || x[1].abs() == height)?;
        let rocks = [self.above, self.below.unwrap_or(self.above)];
        let elastic = [rocks[0].elastic()?, rocks[1].elastic()?];
        let impedance = [rocks[0].impedance()?, rocks[1].impedance()?];
        let side = |x: &Vector2<f64>| usize::from(x[1] < 0.0);
        let scene = Scene::new(element_stiffness_by_cell(&space, |x, _| elastic[side(x)])?)
            .with_mass(lumped_mass_by_cell::<2, 2>(&space, |x, _| {
                rocks[side(x)].density
            })?)
            .with_viscosity(dashpot(&space, &ends, |x| impedance[side(x)])?);
        let scene = if self.below.is_some() {
            self.between(scene, &space)?
        } else {
            self.on_one(scene, &space)?
        };
        let rupture = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
        Ok((space, rupture))
    }

    /// A body on each side: the normal stress is that of the deformation, and friction follows it with a delay.
    fn between(&self, scene: Whole, space: &P1<2>) -> Result<Whole, Problem> {
        let [plus, minus] = [space.part("fault+")?, space.part("fault-")?];
        let (distance, velocity) = (
            self.arguments.relaxation_distance,
            self.arguments.relaxation_velocity,
        );
        let stress = NormalStress::from_body(NORMAL)
            .with_relaxation_distance(distance)
            .with_relaxation_time(distance / velocity);
        let laws = plus.map(|x| friction(x[0].abs() <= EXTENT));
        let evolution = SlipWeakening {
            slip_distance: SLIP_DISTANCE,
        };
        let contact = Contact::between_per_vertex(&plus, &minus, laws, stress)
            .with_state(evolution, Weakening(0.0))
            .with_shear_stress(self.shear(plus.points(), plus.weights()))
            .allow_opening();
        Ok(scene.with_contact(contact))
    }

    /// One body: half of the slip, and a normal stress that slip does not change.
    fn on_one(&self, scene: Whole, space: &P1<2>) -> Result<Whole, Problem> {
        let fault = space.trace(|x| x[1] == 0.0)?;
        // The normal stress is there from the start and compresses nothing.
        let balance = traction(space, &fault, |_| Vector2::new(0.0, -NORMAL))?;
        let laws = fault.map(|x| friction(x[0].abs() <= EXTENT));
        let evolution = SlipWeakening {
            slip_distance: 0.5 * SLIP_DISTANCE,
        };
        let contact = Contact::per_vertex(&fault, laws, NORMAL)
            .with_state(evolution, Weakening(0.0))
            .with_free_normal()
            .with_shear_stress(self.shear(fault.points(), fault.weights()));
        Ok(scene.with_load(balance).with_contact(contact))
    }

    /// The initial shear stress of the vertices of the fault.
    fn shear(&self, points: &[Vector2<f64>], lengths: &[f64]) -> Vec<Vector2<f64>> {
        let each = points.iter().zip(lengths);
        each.map(|(x, length)| Vector2::new(prestress(self.patches, x[0], *length, 1.0), 0.0))
            .collect()
    }
}

/// A scene without a matrix.
type Whole = Scene<ElementOperator<2>, 2>;

/// A mesh and its mirror image across the line where a coordinate is 0, which both share.
fn doubled(mesh: &Mesh<2>, axis: usize) -> Result<Mesh<2>, FemError> {
    let mut vertices = mesh.vertices().to_vec();
    let mut image = Vec::with_capacity(vertices.len());
    for (k, x) in mesh.vertices().iter().enumerate() {
        if x[axis] == 0.0 {
            image.push(k as u32);
            continue;
        }
        let mut mirrored = *x;
        mirrored[axis] = -x[axis];
        image.push(vertices.len() as u32);
        vertices.push(mirrored);
    }
    let mut cells: Vec<u32> = mesh.cells().flatten().copied().collect();
    for cell in mesh.cells() {
        // In the order of the mirror image.
        cells.extend([cell[0], cell[2], cell[1]].map(|vertex| image[vertex as usize]));
    }
    Mesh::new(vertices, cells)
}
