//! Periodic boundaries: pairs of vertices that move together.

use stickslip_solvers::Operator;

use super::Scene;
use crate::BoundaryPart;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Makes the body periodic: each vertex of `second` moves as the vertex of `first` from which a translation `t`
    /// leads to it, the same for all vertices. Call it once for each direction.
    ///
    /// ```text
    /// v(x + t) = v(x),    forces on x and x + t add
    /// ```
    ///
    /// Loads and masses at both vertices add, a Dirichlet condition at one of them is one for both (of a part with both
    /// that at `first`), and a contact that extends from end to end has one vertex there, in `first`, with the area of both. Values per vertex
    /// are still those of all vertices of the part. A difference of the initial displacements stays: a mean strain.
    ///
    /// Where a fault with two sides reaches the boundary, its jump is that at the other end. Which of the coinciding
    /// vertices belong together follows from the contacts between them: a fault reaches both ends, or none. Steps need a
    /// format of matrices with a change of basis, as a `BlockMatrix` has, and central differences `Condensed`, since
    /// `Diagonal` refuses a mass at two places. A `VtkSeries` takes the body, not the contact, whose trace has one vertex
    /// more.
    ///
    /// ```
    /// use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
    /// use stickslip::friction::Tresca;
    /// use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation};
    ///
    /// // Two layers of 1 m, one on the other and without ends, sheared by 0.1 mm; they slide at 0.3 MPa.
    /// let mesh = Mesh::<2>::grid([4.0, 2.0], [4, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[1] == 1.0)?
    ///     .split("fault")?;
    /// let space = P1::new(mesh).refined(1)?;
    /// let (left, right) = (space.trace(|x| x[0] == 0.0)?, space.trace(|x| x[0] == 4.0)?);
    /// let law = Tresca { coefficient: 0.3 };
    /// let fault = Contact::between(&space.part("fault+")?, &space.part("fault-")?, law, 1e6);
    /// let rock = Elastic { young_modulus: 75e9, poisson_ratio: 0.25 };
    /// let scene = Scene::new(elasticity(&space, &rock)?)
    ///     .with_periodic(&left, &right)
    ///     .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
    ///     .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |_| [1e-4, 0.0])
    ///     .with_contact(fault);
    /// let mut layers = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    /// layers.step(1.0)?;
    /// let at = layers.snapshot();
    /// let fault = at.contact(0);
    /// assert_eq!(fault.len(), 8);
    /// let slip = 1e-4 - 2.0 * 0.3e6 / 30e9;
    /// assert!((0..8).all(|k| (fault.slip(k) - slip).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Of the construction of a simulation: [`SceneError::NotPeriodic`] if the vertices do not match,
    /// [`SceneError::Length`] if their numbers differ, [`SceneError::Contradiction`] for different Dirichlet conditions at
    /// both vertices, [`SceneError::Vertex`] where the plus side of a fault alone is prescribed at its end,
    /// [`SceneError::Unsupported`] for several processes and `RungeKutta`.
    ///
    /// [`SceneError::NotPeriodic`]: crate::SceneError::NotPeriodic
    /// [`SceneError::Length`]: crate::SceneError::Length
    /// [`SceneError::Contradiction`]: crate::SceneError::Contradiction
    /// [`SceneError::Vertex`]: crate::SceneError::Vertex
    /// [`SceneError::Unsupported`]: crate::SceneError::Unsupported
    #[must_use]
    #[doc(alias("periodic boundary conditions", "PBC", "multi-point constraint", "tie"))]
    pub fn with_periodic(
        mut self,
        first: impl Into<BoundaryPart>,
        second: impl Into<BoundaryPart>,
    ) -> Self {
        self.conditions.periodic.push([first.into(), second.into()]);
        self
    }
}
