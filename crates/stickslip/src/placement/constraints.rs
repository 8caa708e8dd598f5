//! The Dirichlet components and the parts that prescribe them.

use nalgebra::{SMatrix, SVector};
use stickslip_solvers::{Basis, Frames, Link};

use crate::scene::{Prescribed, components_of, conditions_of};
use crate::{BoundaryCondition, SceneError, StepError};

/// The Dirichlet components of a body.
#[derive(Clone)]
pub(crate) struct Constraints<const C: usize> {
    pub(crate) fixed: Vec<[bool; C]>,
    /// The vertices with a Dirichlet component, increasing.
    pub(crate) held: Vec<usize>,
    /// The parts with prescribed velocities, and behind them those with prescribed slip rates.
    pub(crate) moved: Vec<Prescribed<C>>,
    slip_rates: usize,
    roles: Vec<[Option<BoundaryCondition>; C]>,
    /// The prescribed components of jumps.
    pub(crate) jumps: Vec<Jump<C>>,
}

/// The components of a jump that Dirichlet conditions on both sides prescribe.
#[derive(Clone)]
pub(crate) struct Jump<const C: usize> {
    pub(crate) link: Link,
    pub(crate) components: [bool; C],
    /// The rotations from the axes of each base to those of the vertex, without the free components of the base.
    maps: Vec<SMatrix<f64, C, C>>,
}

impl<const C: usize> Constraints<C> {
    /// The constraints of fixed and driven parts on a body of `size` vertices in this basis.
    pub(crate) fn new(
        prescribed: Vec<Prescribed<C>>,
        basis: &Basis<C>,
        size: usize,
    ) -> Result<Self, SceneError> {
        let mut constraints = Self {
            fixed: vec![[false; C]; size],
            held: Vec::new(),
            moved: Vec::new(),
            slip_rates: 0,
            roles: vec![[None; C]; size],
            jumps: Vec::new(),
        };
        let roles: Vec<_> = conditions_of(&prescribed).collect();
        let (of_jumps, of_sides): (Vec<_>, Vec<_>) =
            (prescribed.into_iter().zip(roles)).partition(|(part, _)| part.minus.is_some());
        for (part, role) in of_sides {
            constraints.add(part, role, &basis.axes)?;
        }
        for link in basis.links.iter() {
            let components = constraints.fixed[link.vertex];
            if components.contains(&true) {
                let jump = constraints.jump(link, components, &basis.axes)?;
                constraints.jumps.push(jump);
            }
        }
        constraints.slip_rates = of_jumps.len();
        for (part, role) in of_jumps {
            constraints.add(part, role, &basis.axes)?;
        }
        Ok(constraints)
    }

    fn add(
        &mut self,
        mut part: Prescribed<C>,
        role: BoundaryCondition,
        axes: &Frames<C>,
    ) -> Result<(), SceneError> {
        part.turn(axes);
        for (position, &vertex) in part.part.vertices.iter().enumerate() {
            let (_, components) = part.at(position, &SVector::zeros());
            for component in (0..C).filter(|&c| components[c]) {
                self.mark(vertex, component, role)?;
            }
        }
        if part.velocity.is_some() {
            self.moved.push(part);
        }
        Ok(())
    }

    /// Whether any component of a jump is prescribed.
    #[cfg(feature = "condensed")]
    pub(crate) fn prescribes_jumps(&self) -> bool {
        self.slip_rates > 0 || !self.jumps.is_empty()
    }

    /// The jump of a vertex with prescribed components: prescribed across the fault, too.
    fn jump(
        &self,
        link: &Link,
        components: [bool; C],
        axes: &Frames<C>,
    ) -> Result<Jump<C>, SceneError> {
        let identity = SMatrix::identity();
        let of = |vertex| axes.of(vertex).unwrap_or(&identity);
        let mut maps = Vec::with_capacity(link.bases.len());
        for &base in &link.bases {
            let mut map = of(link.vertex).tr_mul(of(base));
            for component in (0..C).filter(|&c| components[c]) {
                let along = components_of(&map.row(component).transpose());
                if (0..C).any(|c| along[c] && !self.fixed[base][c]) {
                    return Err(SceneError::HalfHeld {
                        vertex: link.vertex,
                        component,
                    });
                }
            }
            for c in (0..C).filter(|&c| !self.fixed[base][c]) {
                map.column_mut(c).fill(0.0);
            }
            maps.push(map);
        }
        Ok(Jump {
            link: link.clone(),
            components,
            maps,
        })
    }

    /// Fixes all components of a copy that has no jump of its own.
    pub(crate) fn tie(&mut self, vertex: usize, condition: BoundaryCondition) {
        self.roles[vertex] = self.roles[vertex].map(|role| role.or(Some(condition)));
        self.fixed[vertex] = [true; C];
    }

    fn mark(
        &mut self,
        vertex: usize,
        component: usize,
        second: BoundaryCondition,
    ) -> Result<(), SceneError> {
        let place = &mut self.roles[vertex][component];
        match (*place, second) {
            (None, _) => *place = Some(second),
            (Some(BoundaryCondition::Fixed(_)), BoundaryCondition::Fixed(_)) => {}
            (Some(first), _) => {
                return Err(SceneError::Contradiction {
                    vertex,
                    component,
                    first,
                    second,
                });
            }
        }
        self.fixed[vertex][component] = true;
        Ok(())
    }

    /// Fixes the normal component of contact number `contact`, counted from 0, unless a Dirichlet condition already
    /// prescribes it.
    pub(crate) fn close(&mut self, vertex: usize, component: usize, contact: usize) {
        let role = &mut self.roles[vertex][component];
        *role = role.or(Some(BoundaryCondition::Contact(contact + 1)));
        self.fixed[vertex][component] = true;
    }

    /// Frees a component again that a contact alone has fixed.
    pub(crate) fn release(&mut self, vertex: usize, component: usize) {
        self.roles[vertex][component] = None;
        self.fixed[vertex][component] = false;
    }

    /// The boundary condition that prescribes a component.
    pub(crate) fn role(&self, vertex: usize, component: usize) -> Option<BoundaryCondition> {
        self.roles[vertex][component]
    }

    /// Whether a component has a prescribed velocity or slip rate.
    pub(crate) fn is_moved(&self, vertex: usize, component: usize) -> bool {
        matches!(
            self.roles[vertex][component],
            Some(BoundaryCondition::Prescribed(_) | BoundaryCondition::SlipRate(_))
        )
    }

    /// Completes the constraints after the last part.
    pub(crate) fn finish(&mut self) {
        let fixed = self.fixed.iter().enumerate();
        self.held = fixed
            .filter(|(_, fixed)| fixed.iter().any(|&fixed| fixed))
            .map(|(vertex, _)| vertex)
            .collect();
    }

    /// Marks the prescribed velocities, functions of time at `time` \[s\].
    #[cfg(feature = "checkpoint")]
    pub(crate) fn describe(&self, time: f64, fingerprint: &mut crate::marks::Fingerprint) {
        for (number, part) in self.moved.iter().enumerate() {
            let vertices = part.part.vertices.iter().map(|&vertex| vertex as u64);
            let components = part.components.map(u64::from);
            let name = format!("driven part {}", number + 1);
            fingerprint.words(&name, vertices.chain(components));
            // What is not finite fails the step that meets it.
            let velocity = part.velocity_at(time).unwrap_or(SVector::repeat(f64::NAN));
            fingerprint.function(&format!("the velocity of {name}"), velocity.iter());
        }
    }

    /// Sets the Dirichlet components to the velocities of a time.
    pub(crate) fn prescribe(
        &self,
        time: f64,
        velocity: &mut [SVector<f64, C>],
    ) -> Result<(), StepError> {
        self.set(|part| part.velocity_at(time), velocity)
    }

    /// Sets the Dirichlet components of a field, velocities or their derivatives, by its value on each moved part.
    pub(crate) fn set(
        &self,
        value: impl Fn(&Prescribed<C>) -> Result<SVector<f64, C>, StepError>,
        field: &mut [SVector<f64, C>],
    ) -> Result<(), StepError> {
        for &vertex in &self.held {
            for c in (0..C).filter(|&c| self.fixed[vertex][c]) {
                field[vertex][c] = 0.0;
            }
        }
        let (of_sides, of_jumps) = self.moved.split_at(self.moved.len() - self.slip_rates);
        for moved in of_sides {
            moved.set(&value(moved)?, field);
        }
        // Bases come before the vertices that are linked to them.
        for jump in &self.jumps {
            let vertex = jump.link.vertex;
            let bases = jump.link.bases.iter().zip(&jump.maps);
            let bases: SVector<f64, C> = bases.map(|(&base, map)| map * field[base]).sum();
            let sign = if jump.link.reversed { -1.0 } else { 1.0 };
            for c in (0..C).filter(|&c| jump.components[c]) {
                field[vertex][c] = sign * (field[vertex][c] - bases[c]);
            }
        }
        for moved in of_jumps {
            moved.set(&value(moved)?, field);
        }
        Ok(())
    }
}
