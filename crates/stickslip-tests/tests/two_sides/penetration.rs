//! A solver whose rates let the sides of a contact penetrate.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use nalgebra::SVector;
use stickslip::fem::{Elastic, P1, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::solvers::{Energy, SolveError, SolveReport, Stopping};
use stickslip::{
    BlockMatrix, Components, Condensed, Contact, GeneralizedAlpha, NonsmoothSolver, NormalStress,
    Scene, Simulation, StepError,
};

use crate::Outcome;

/// Moves one frictional vertex into the surface below, if it has a number.
struct Careless {
    solver: Condensed<2>,
    vertex: Arc<AtomicUsize>,
    speed: f64,
}

const NONE: usize = usize::MAX;

impl NonsmoothSolver<BlockMatrix<2>, 2> for Careless {
    fn prepare(&mut self, energy: &Energy<'_, BlockMatrix<2>, 2>) -> Result<(), SolveError> {
        self.solver.prepare(energy)
    }

    fn minimize(
        &mut self,
        energy: &Energy<'_, BlockMatrix<2>, 2>,
        stopping: &Stopping<'_, BlockMatrix<2>>,
        v: &mut [SVector<f64, 2>],
    ) -> Result<SolveReport, SolveError> {
        let report = self.solver.minimize(energy, stopping, v)?;
        let vertex = self.vertex.load(Ordering::Relaxed);
        if vertex != NONE {
            v[vertex][1] -= self.speed;
        }
        Ok(report)
    }
}

/// The step is refused at that vertex, the last accepted one stays in place, and the run goes on by the same bits.
#[test]
fn rates_into_the_surface_are_refused() -> Outcome {
    let space = P1::<2>::grid([4.0, 1.0], [8, 2])?;
    let base = space.trace(|x| x[1] == 0.0)?;
    let elastic = Elastic {
        young_modulus: 1e7,
        poisson_ratio: 0.25,
    };
    for dynamic in [false, true] {
        let made = |speed: f64| -> Outcome<_> {
            let vertex = Arc::new(AtomicUsize::new(NONE));
            let solver = Careless {
                solver: Condensed::new(),
                vertex: Arc::clone(&vertex),
                speed,
            };
            let law = Tresca { coefficient: 0.0 };
            let contact = Contact::new(&base, law, NormalStress::from_body(1e3)).allow_opening();
            let mut scene = Scene::new(elasticity(&space, &elastic)?)
                .prescribe_velocity(&space.trace(|x| x[1] == 1.0)?, Components::ALL, |_| {
                    [0.0, -1e-4]
                })
                .with_contact(contact);
            if dynamic {
                scene = scene.with_mass(mass(&space, 1e3)?);
            }
            let body = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
            Ok((body, vertex))
        };
        let dt = 1e-3;
        for (&vertex, speed) in base.vertices().iter().zip([1e-9, 1e-6, 1e-3, 1.0, 1e3]) {
            let (mut body, careless) = made(speed)?;
            body.step(dt)?;
            let fields = |body: &Simulation<2>| {
                let at = body.snapshot();
                (at.displacement.to_vec(), at.velocity.to_vec(), at.step)
            };
            let accepted = fields(&body);
            careless.store(vertex, Ordering::Relaxed);
            let refused = body.step(dt).err().map(|failure| failure.cause);
            let Some(StepError::Penetration {
                vertex: at,
                opening,
            }) = refused
            else {
                return Err(format!("{dynamic} {speed}: {refused:?}").into());
            };
            assert!(at == vertex && opening < 0.0 && -opening <= speed * dt);
            assert_eq!(fields(&body), accepted);
            careless.store(NONE, Ordering::Relaxed);
            body.step(dt)?;
            let (mut other, _) = made(speed)?;
            other.step(dt)?;
            other.step(dt)?;
            assert_eq!(fields(&body), fields(&other));
            assert_eq!(body.snapshot().contact(0).opening(0), 0.0);
        }
    }
    Ok(())
}
