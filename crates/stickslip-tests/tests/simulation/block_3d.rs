//! Two slip components: a block in three dimensions, pulled obliquely over its frictional bottom.

use nalgebra::Vector3;
use stickslip::fem::{Assembled, Elastic, P1, Trace, elasticity, mass};
use stickslip::friction::{DieterichRuina, FrictionLaw, Tresca};
use stickslip::problems::pipping_slider::{AGING, FRICTION, NORMAL_STRESS};
use stickslip::state::{LogTheta, Reads, StateLaw, StateVariable};
use stickslip::{Contact, Matrix, Newmark, Scene, Simulation, Tnnmg};

use crate::Outcome;
use crate::common::distance;

const STEP: f64 = 1e-3;
const STEPS: usize = 50;
const TOLERANCE: f64 = 1e-14;
const SLOW_STATE: LogTheta = LogTheta(-5.0);

type Block = Simulation<3>;
type Field = Vec<Vector3<f64>>;

/// A body of 2 m x 1 m x `depth`, and the matrices the tests need beside the simulation.
struct Body {
    space: P1<3>,
    bottom: Trace<3>,
    stiffness: Assembled<3>,
    mass: Assembled<3>,
}

impl Body {
    fn new(depth: usize) -> Outcome<Self> {
        let space = P1::<3>::grid([2.0, 1.0, depth as f64], [2, 1, depth])?.refined(1)?;
        let elastic = Elastic {
            young_modulus: 5e7,
            poisson_ratio: 0.3,
        };
        Ok(Self {
            bottom: space.trace(|x| x[1] == 0.0)?,
            stiffness: elasticity(&space, &elastic)?,
            mass: mass(&space, 5e3)?,
            space,
        })
    }

    /// The block at rest, whose top is pulled with a velocity [m/s].
    fn pulled<L, S>(
        &self,
        pull: [f64; 3],
        (friction, law, initial): (L, S, S::State),
    ) -> Outcome<Block>
    where
        L: FrictionLaw + Clone + 'static,
        S: StateLaw + 'static,
        L::State: Reads<S::State>,
    {
        let top = self.space.trace(|x| x[1] == 1.0)?;
        let contact = Contact::new(&self.bottom, friction, NORMAL_STRESS).with_state(law, initial);
        let scene = Scene::new(self.stiffness.clone())
            .with_mass(self.mass.clone())
            .prescribe_velocity(&top, [true; 3], move |_| pull)
            .with_contact(contact);
        let solver = Tnnmg::new(self.space.transfers());
        Ok(Simulation::new(scene, Newmark::default(), solver)?
            .with_absolute_tolerance(TOLERANCE)?)
    }

    /// `M a + A u` of the last step: what friction and supports do to the body [N].
    fn force(&self, block: &Block) -> Field {
        let at = block.snapshot();
        let mut force = vec![Vector3::zeros(); self.space.vertex_count()];
        self.stiffness
            .multiply_add(1.0, at.displacement, &mut force);
        self.mass.multiply_add(1.0, at.acceleration, &mut force);
        force
    }

    /// Slides the block and checks at every step that friction opposes the slip with the law's
    /// own force; returns the velocity and the state of the end.
    fn slides<L, S>(&self, pull: [f64; 3], laws: (L, S, S::State)) -> Outcome<(Field, Vec<f64>)>
    where
        L: FrictionLaw + Clone + 'static,
        S: StateLaw + 'static,
        L::State: Reads<S::State>,
    {
        let friction = laws.0.clone();
        let mut block = self.pulled(pull, laws)?;
        let mut slipped = vec![0; self.bottom.vertices().len()];
        for _ in 0..STEPS {
            let report = block.step(STEP)?;
            assert!(report.solver_iterations < 40 * report.coupling_iterations);
            let (at, force) = (block.snapshot(), self.force(&block));
            for (k, &p) in self.bottom.vertices().iter().enumerate() {
                let v = at.velocity[p];
                assert_eq!(v[1], 0.0);
                let state = S::State::from_value(at.contact(0).state(k));
                let strength = self.bottom.weights()[k] * NORMAL_STRESS;
                let tangential = Vector3::new(force[p][0], 0.0, force[p][2]);
                // The direction of slip, and so friction, is right to 1e-7 where the rate is resolved to 1e-7.
                let norm = self.stiffness.diagonal_block(p) + self.mass.diagonal_block(p);
                let doubt = TOLERANCE / norm.diagonal().max().sqrt();
                if v.norm() > 1e7 * doubt {
                    let mu = friction.coefficient(v.norm(), L::State::read(state));
                    let error = tangential + v.normalize() * (mu * strength);
                    assert!(error.norm() < 1e-7 * strength, "{k}: {v}, {error}");
                } else {
                    let [low, high] = [v.norm() - doubt, v.norm() + doubt].map(|rate| {
                        strength * friction.coefficient(rate.max(0.0), L::State::read(state))
                    });
                    assert!(tangential.norm() <= high * (1.0 + 1e-7));
                    assert!(v.norm() < doubt || tangential.norm() >= low * (1.0 - 1e-7));
                }
                slipped[k] += usize::from(v[0].abs().min(v[2].abs()) > 1e-3);
            }
            // Nothing acts on what is neither frictional nor moved.
            for (p, x) in self.space.mesh().vertices().iter().enumerate() {
                if x[1] > 0.0 && x[1] < 1.0 {
                    assert!(force[p].norm() < 1e-5, "{}", force[p]);
                }
            }
        }
        assert!(slipped.iter().all(|&steps| steps > 10), "{slipped:?}");
        let at = block.snapshot();
        let states = (0..slipped.len()).map(|k| at.contact(0).state(k)).collect();
        Ok((at.velocity.to_vec(), states))
    }
}

const OBLIQUE: [f64; 3] = [0.2, 0.0, 0.1];

#[test]
fn a_block_slides_under_rate_and_state() -> Outcome {
    Body::new(1)?
        .slides(OBLIQUE, (FRICTION, AGING, SLOW_STATE))
        .map(|_| ())
}

#[test]
fn a_block_slides_under_tresca() -> Outcome {
    let friction = Tresca { coefficient: 0.5 };
    Body::new(1)?
        .slides(OBLIQUE, (friction, (), ()))
        .map(|_| ())
}

/// Exchanging x and z maps Kuhn's tetrahedra of a square block, and their refinement, onto
/// themselves; no mirror does.
#[test]
fn exchanged_axes_give_the_exchanged_result() -> Outcome {
    let body = Body::new(2)?;
    let exchange = |v: &Vector3<f64>| Vector3::new(v[2], v[1], v[0]);
    let partner: Vec<usize> = body
        .space
        .mesh()
        .vertices()
        .iter()
        .map(|x| body.space.vertex_at(exchange(x).into()))
        .collect::<Option<_>>()
        .ok_or("the mesh is not symmetric")?;
    let image = |field: &Field| -> Field { partner.iter().map(|&p| exchange(&field[p])).collect() };
    let at_bottom = |p: usize| body.bottom.vertices().binary_search(&p);

    let laws: (DieterichRuina, _, _) = (FRICTION, AGING, SLOW_STATE);
    let (along, states) = body.slides([0.2, 0.0, 0.1], laws)?;
    let (across, exchanged_states) = body.slides([0.1, 0.0, 0.2], laws)?;
    let largest = along.iter().map(|v| v.norm()).fold(0.0, f64::max);
    assert!(distance(&along, &across) > 0.1 * largest, "not a test");
    let defect = distance(&across, &image(&along)) / largest;
    assert!(defect < 1e-10, "{defect:e}");
    for (k, &p) in body.bottom.vertices().iter().enumerate() {
        let image = at_bottom(partner[p]).map_err(|_| "the bottom is not symmetric")?;
        assert!((exchanged_states[k] - states[image]).abs() < 1e-8);
    }

    let (diagonal, _) = body.slides([0.15, 0.0, 0.15], laws)?;
    let defect = distance(&diagonal, &image(&diagonal)) / largest;
    assert!(defect < 1e-10, "{defect:e}");
    Ok(())
}

/// Friction is odd and elasticity linear: the opposite pull gives the opposite motion.
#[test]
fn the_opposite_pull_gives_the_opposite_motion() -> Outcome {
    let body = Body::new(1)?;
    let laws = (FRICTION, AGING, SLOW_STATE);
    let (there, _) = body.slides(OBLIQUE, laws)?;
    let (back, _) = body.slides(OBLIQUE.map(|v| -v), laws)?;
    let largest = there.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let opposite: Field = back.iter().map(|v| -v).collect();
    assert!(distance(&there, &opposite) < 1e-10 * largest);
    Ok(())
}
