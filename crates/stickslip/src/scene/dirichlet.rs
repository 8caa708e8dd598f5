//! Dirichlet conditions: fixed and driven parts, and prescribed slip rates between two sides that move freely.

use std::sync::Arc;

use stickslip_solvers::Operator;

use super::sides::Pairs;
use super::{Components, Prescribed, Scene};
use crate::BoundaryPart;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Fixes the marked components of the velocity at zero on `part`.
    #[must_use]
    #[doc(alias("Dirichlet", "clamp"))]
    pub fn fix(
        mut self,
        part: impl Into<BoundaryPart>,
        components: impl Into<Components<C>>,
    ) -> Self {
        self.conditions.prescribed.push(Prescribed {
            part: part.into(),
            minus: None,
            components: components.into().0,
            velocity: None,
            turned: Vec::new(),
        });
        self
    }

    /// Prescribes the marked components of the velocity [m/s] on `part` as a function of time \[s\].
    #[must_use]
    #[doc(alias("Dirichlet", "driven boundary"))]
    pub fn prescribe_velocity(
        mut self,
        part: impl Into<BoundaryPart>,
        components: impl Into<Components<C>>,
        velocity: impl Fn(f64) -> [f64; C] + Send + Sync + 'static,
    ) -> Self {
        self.conditions.prescribed.push(Prescribed {
            part: part.into(),
            minus: None,
            components: components.into().0,
            velocity: Some(Arc::new(velocity)),
            turned: Vec::new(),
        });
        self
    }

    /// Prescribes the marked components of the slip rate [m/s] of a fault inside the body as a function of time \[s\]:
    /// the velocity of the plus side relative to the minus side, in coordinates. Both sides deform freely, under opposite
    /// forces.
    ///
    /// ```text
    /// v+ - v- = V(t)
    /// ```
    ///
    /// Pairs of vertices are those of [`Contact::between`](crate::Contact::between); a tip does not slip. A pair that a
    /// contact with friction shares creeps at the given rate: a group may creep beside one that sticks. Mark
    /// all components to keep the sides together, with a rate of zero along the normal, or add a contact between them.
    ///
    /// ```
    /// use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane};
    /// use stickslip::{Components, Condensed, GeneralizedAlpha, Scene, Simulation, Steps};
    ///
    /// // Two layers of 1 m between fixed plates, 30 GPa: creep at 1 nm/s shears both against its direction.
    /// let mesh = Mesh::<2>::grid([2.0, 2.0], [4, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[1] == 1.0)?
    ///     .split("fault")?;
    /// let space = P1::new(mesh);
    /// let (plus, minus) = (space.part("fault+")?, space.part("fault-")?);
    /// let scene = Scene::new(antiplane(&space, 30e9)?)
    ///     .fix(&space.trace(|x| x[1] == 0.0 || x[1] == 2.0)?, Components::ALL)
    ///     .prescribe_slip_rate(&plus, &minus, Components::ALL, |_| [1e-9]);
    /// let mut layers = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    /// layers.run(&Steps::constant(1e4).count(10), |_| ())?;
    /// let stress = layers.snapshot().reaction(&plus)?[0] / 2.0;
    /// assert!((stress / (30e9 * 1e-9 * 1e5 / 2.0) - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Of the construction of a simulation: [`SceneError::NotPaired`](crate::SceneError::NotPaired) and others of two
    /// sides; [`SceneError::Contradiction`](crate::SceneError::Contradiction) where Dirichlet conditions on both sides
    /// prescribe the slip rate, too; [`SceneError::Vertex`](crate::SceneError::Vertex) where faults cross;
    /// [`SceneError::Unsupported`](crate::SceneError::Unsupported) for reduced bodies.
    #[must_use]
    #[doc(alias("creep", "slip rate", "kinematic fault", "back slip"))]
    pub fn prescribe_slip_rate(
        mut self,
        plus: impl Into<BoundaryPart>,
        minus: impl Into<BoundaryPart>,
        components: impl Into<Components<C>>,
        slip_rate: impl Fn(f64) -> [f64; C] + Send + Sync + 'static,
    ) -> Self {
        match Pairs::new(plus.into(), &minus.into()) {
            Ok((part, pairs)) => self.conditions.prescribed.push(Prescribed {
                part,
                minus: Some(pairs.minus),
                components: components.into().0,
                velocity: Some(Arc::new(slip_rate)),
                turned: Vec::new(),
            }),
            Err(error) => {
                self.conditions.wrong.get_or_insert(error);
            }
        }
        self
    }
}
