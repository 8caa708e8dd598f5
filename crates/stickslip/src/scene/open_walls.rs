//! Walls of a split mesh without a contact between them.

use stickslip_solvers::Operator;

use super::Scene;

impl<Op: Operator<C>, const C: usize> Scene<Op, C> {
    /// Allows the two walls of an open mesh to move independently of one another, also through one another. Otherwise
    /// the walls of a split surface without a contact between them are refused
    /// ([`SceneError::OpenWalls`](crate::SceneError::OpenWalls)), and so are two coincident vertices of contacts, each with
    /// a rigid surface of its own ([`SceneError::Coincident`](crate::SceneError::Coincident)).
    #[must_use]
    pub fn with_open_walls(mut self) -> Self {
        self.conditions.open_walls = true;
        self
    }
}
