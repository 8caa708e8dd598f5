//! Adaptive steps over a fault that opens, slides freely and closes again.

use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::{RegularizedDieterichRuina, Tresca};
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{
    BackwardEuler, BlockMatrix, Components, Condensed, Contact, ErrorControl, GeneralizedAlpha,
    NormalStress, RateScheme, Scene, Simulation, Steps,
};

use crate::Outcome;
use crate::random_block::Random;

/// Two layers of height 1 without ends, sheared at a constant rate, pulled from 1 s to 2.5 s and then pressed: all
/// fields are uniform.
struct Layers {
    elastic: Elastic,
    coefficient: f64,
    pressure: f64,
    /// The velocities of the top along the fault and across [m/s].
    speeds: [f64; 2],
}

const END: f64 = 4.0;

impl Layers {
    fn new(random: &mut Random) -> Self {
        Self {
            elastic: Elastic {
                young_modulus: 5e7,
                poisson_ratio: random.between(0.0, 0.4),
            },
            coefficient: random.between(0.1, 0.8),
            pressure: random.between(1e3, 2e4),
            speeds: [random.between(3e-4, 3e-3), random.between(1e-3, 3e-3)],
        }
    }

    /// The moduli of shear and of uniaxial strain, over the height of both layers [Pa/m].
    fn stiffness(&self) -> [f64; 2] {
        let Elastic {
            young_modulus,
            poisson_ratio: nu,
        } = self.elastic;
        let shear = young_modulus / (2.0 * (1.0 + nu));
        [shear / 2.0, shear * (1.0 - nu) / (1.0 - 2.0 * nu)]
    }

    fn contact(&self, space: &P1<2>) -> Outcome<Contact<Tresca, (), 2>> {
        let law = Tresca {
            coefficient: self.coefficient,
        };
        let pressure = NormalStress::from_body(self.pressure);
        Ok(Contact::between(
            &space.part("fault+")?,
            &space.part("fault-")?,
            law,
            pressure,
        ))
    }

    fn rate_and_state(
        &self,
        space: &P1<2>,
    ) -> Outcome<Contact<RegularizedDieterichRuina, Dieterich, 2>> {
        let law = RegularizedDieterichRuina {
            a: 0.012,
            b: 0.010,
            reference_friction: self.coefficient,
            reference_velocity: 1e-6,
            slip_distance: 1e-5,
        };
        let pressure = NormalStress::from_body(self.pressure);
        Ok(Contact::between(
            &space.part("fault+")?,
            &space.part("fault-")?,
            law,
            pressure,
        )
        .with_state(
            Dieterich {
                slip_distance: 1e-5,
            },
            LogTheta(1.0),
        ))
    }

    fn simulation(
        &self,
        with_contact: impl Fn(Scene<BlockMatrix<2>, 2>, &P1<2>) -> Outcome<Scene<BlockMatrix<2>, 2>>,
        scheme: impl RateScheme + 'static,
    ) -> Outcome<Simulation<2>> {
        let mesh = Mesh::<2>::grid([1.0, 2.0], [2, 2], GridDiagonal::Rising)?
            .with_surface_where("fault", |x| x[1] == 1.0)?
            .split("fault")?;
        let space = P1::new(mesh);
        let edge = |axis: usize, at: f64| space.trace(move |x| x[axis] == at);
        let [along, across] = self.speeds;
        let scene = Scene::new(elasticity(&space, &self.elastic)?)
            .with_periodic(&edge(0, 0.0)?, &edge(0, 1.0)?)
            .fix(&edge(1, 0.0)?, Components::ALL)
            .prescribe_velocity(&edge(1, 2.0)?, Components::ALL, move |time| {
                let sign = match time {
                    t if t < 1.0 => 0.0,
                    t if t < 2.5 => 1.0,
                    _ => -1.0,
                };
                [along, sign * across]
            });
        Ok(Simulation::new(
            with_contact(scene, &space)?,
            scheme,
            Condensed::new(),
        )?)
    }

    /// The slip of constant friction at the end: what exceeds it slides until the gap closes, and behind that if shear
    /// stress grows faster than friction.
    fn slip(&self) -> f64 {
        let ([shear, normal], [along, across]) = (self.stiffness(), self.speeds);
        let closes = 4.0 - self.pressure / (normal * across);
        let strength = self.coefficient * normal * across * (END - closes).max(0.0);
        let sliding = along * END - strength / shear;
        sliding.max(along * closes)
    }
}

fn run(body: &mut Simulation<2>, steps: Steps) -> Outcome<(f64, usize)> {
    let mut opened = false;
    let report = body.run(&steps.stopping_at([1.0, 2.5]).until(END), |at| {
        let fault = at.contact(0);
        for k in 0..fault.len() {
            assert!(fault.opening(k) >= 0.0, "{} {k}", at.time);
            opened |= fault.opening(k) > 0.0;
        }
    })?;
    assert!(opened);
    let at = body.snapshot();
    let fault = at.contact(0);
    for k in 1..fault.len() {
        assert!((fault.slip(k) / fault.slip(0) - 1.0).abs() < 1e-9);
    }
    Ok((fault.slip(0), report.accepted))
}

/// The slip of Coulomb friction follows the tolerance, whether it sticks or slides behind the landing.
#[test]
fn slip_over_an_opening_follows_the_tolerance() -> Outcome {
    let (mut sticks, mut slides) = (0, 0);
    for seed in 0..30 {
        let layers = Layers::new(&mut Random(5000 + seed));
        let exact = layers.slip();
        let ([shear, normal], [along, across]) = (layers.stiffness(), layers.speeds);
        let stuck = shear * along < layers.coefficient * normal * across;
        (sticks, slides) = (sticks + usize::from(stuck), slides + usize::from(!stuck));
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let controls = [
                (ErrorControl::default(), false),
                (ErrorControl::extrapolated(3), true),
            ];
            for (control, backward) in controls {
                let contact = |scene: Scene<_, 2>, space: &P1<2>| {
                    Ok(scene.with_contact(layers.contact(space)?.allow_opening()))
                };
                let mut body = match backward {
                    true => layers.simulation(contact, BackwardEuler)?,
                    false => layers.simulation(contact, GeneralizedAlpha::default())?,
                };
                let (slip, steps) = run(
                    &mut body,
                    Steps::adaptive(tolerance).with_error_control(control),
                )?;
                let error = (slip - exact).abs();
                assert!(
                    error < 3.0 * tolerance * exact,
                    "{seed} {tolerance}: {slip} {exact}"
                );
                assert!(steps < 100, "{seed} {tolerance}: {steps}");
            }
        }
    }
    assert!(sticks > 5 && slides > 5, "{sticks} {slides}");
    Ok(())
}

/// Friction of rate and state lands likewise: its slip is that of small constant steps.
#[test]
fn rate_and_state_pass_an_opening() -> Outcome {
    for seed in 0..2 {
        let layers = Layers::new(&mut Random(6000 + seed));
        let contact = |scene: Scene<_, 2>, space: &P1<2>| {
            Ok(scene.with_contact(layers.rate_and_state(space)?.allow_opening()))
        };
        let run = |steps: Steps| {
            run(
                &mut layers.simulation(contact, GeneralizedAlpha::default())?,
                steps,
            )
        };
        let (slip, _) = run(Steps::constant(1e-3))?;
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let (found, steps) = run(Steps::adaptive(tolerance))?;
            let error = (found / slip - 1.0).abs();
            // That of constant steps is 5e-5, by the change from steps of twice the size.
            assert!(
                error < 2e-4 + tolerance,
                "{seed} {tolerance}: {found} {slip}"
            );
            assert!(steps < 500, "{seed} {tolerance}: {steps}");
        }
    }
    Ok(())
}
