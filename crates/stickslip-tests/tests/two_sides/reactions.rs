//! Normal stresses that come from the deformation, in a body that is reduced to its contacts: those of the whole one.

use nalgebra::{SVector, Vector2};
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, body_force, elasticity, mass};
use stickslip::friction::Tresca;
use stickslip::reduced::{Reduced, ReducedBody};
use stickslip::{
    BlockMatrix, Cholesky, Components, Condensed, Contact, DenseNewton, GeneralizedAlpha,
    NormalStress, Scene, SceneError, Simulation,
};

use crate::random_block::{Block, Random};
use crate::{Outcome, largest};

/// The largest distances of normal stresses, slips and displacements of a whole body and of its reduction, as shares of the
/// largest, over so many steps; the number of those that both take, and the largest slip.
fn compare<const C: usize>(
    scene: &dyn Fn() -> Outcome<Scene<BlockMatrix<C>, C>>,
    load: Option<&[SVector<f64, C>]>,
    (dt, steps): (f64, usize),
) -> Outcome<(f64, usize, f64)> {
    let body = Reduced::new(&scene()?).up_to_frequency(f64::INFINITY)?;
    let scheme = GeneralizedAlpha::default;
    let mut whole = Simulation::new(scene()?, scheme(), Condensed::new())?.with_tolerance(1e-13)?;
    let reduced = body.reduce(scene()?)?;
    let mut small =
        Simulation::new(reduced, scheme(), DenseNewton::new())?.with_tolerance(1e-13)?;
    let (mut apart, mut farthest) = (0.0_f64, 0.0_f64);
    for taken in 0..steps {
        match (whole.step(dt), small.step(dt)) {
            (Ok(_), Ok(_)) => {}
            (Err(_), Err(_)) => return Ok((apart, taken, farthest)),
            (one, other) => return Err(format!("{taken}: {one:?}, {other:?}").into()),
        }
        let (one, other) = (whole.snapshot(), small.snapshot());
        let recovered = match load {
            None => body.displacement(&other)?,
            Some(load) => body.displacement_under(load, &other)?,
        };
        let size = largest(one.displacement.iter().copied());
        let between = one.displacement.iter().zip(&recovered).map(|(a, b)| a - b);
        apart = apart.max(largest(between) / size);
        let all = || one.contacts().zip(other.contacts());
        let pressures = all().flat_map(|(a, _)| (0..a.len()).map(move |k| a.normal_stress(k)));
        let pressure = pressures.fold(0.0, f64::max);
        for (a, b) in all() {
            for k in 0..a.len() {
                let stress = (a.normal_stress(k) - b.normal_stress(k)).abs();
                let slip = (a.slip(k) - b.slip(k)).abs();
                let opening = (a.opening(k) - b.opening(k)).abs();
                farthest = farthest.max(a.slip(k));
                apart = apart.max((slip + opening) / size);
                if pressure > 0.0 {
                    apart = apart.max(stress / pressure);
                }
            }
        }
    }
    Ok((apart, steps, farthest))
}

/// Blocks of random contacts and rollers, sheared under pressure; those that may open are pulled off, too.
fn blocks_agree<const D: usize>(cases: u64) -> Outcome {
    let (mut compared, mut slid) = (0, 0);
    for seed in 0..cases {
        let random = &mut Random(3000 + seed);
        let mut block = Block::<D>::new(random, |random| random.below(3) == 0)?;
        let pressure = 1e-3 * block.modulus();
        for (_, stress) in &mut block.feet {
            *stress = random.between(0.0, 2.0) * pressure;
        }
        let (press, shear) = (1e-3 * block.height, random.between(-1e-3, 1e-3));
        let inertia = random.below(2) == 0;
        let opens = !inertia && random.below(2) == 0;
        // Whole periods of the lowest vibrations, some, fit into it.
        let density = block.modulus() * 1e-2;
        let scene = || {
            let velocity = move |time: f64| {
                let press = if opens && time > 0.5 {
                    -3.0 * press
                } else {
                    press
                };
                std::array::from_fn(|c| if c + 1 == D { -press } else { shear })
            };
            let scene = block.scene(|_| opens, velocity)?;
            Ok(if inertia {
                scene.with_mass(mass(&block.space, density)?)
            } else {
                scene
            })
        };
        let (apart, taken, farthest) = compare(&scene, None, (random.between(0.03, 0.1), 12))
            .map_err(|error| format!("{D} {seed} {opens} {inertia}: {error}"))?;
        assert!(apart < 1e-9, "{D} {seed} {opens} {inertia}: {apart:e}");
        compared += taken;
        slid += usize::from(farthest > 0.0);
    }
    assert!(compared > 6 * cases as usize, "{compared} steps");
    assert!(2 * slid > cases as usize, "{slid} blocks slide");
    Ok(())
}

#[test]
fn blocks_under_pressure_agree_with_their_reductions() -> Outcome {
    blocks_agree::<2>(40)?;
    blocks_agree::<3>(6)
}

/// A fault in a block under its weight, with a tip or without, and pre-stress that holds at the start or adds to that of the
/// deformation.
struct Weighed {
    elastic: Elastic,
    coefficient: f64,
    weight: f64,
    stress: f64,
    pull: f64,
    at_start: bool,
    has_tip: bool,
    inertia: bool,
}

impl Weighed {
    fn new(random: &mut Random, kind: u64) -> Self {
        Self {
            elastic: Elastic {
                young_modulus: 10_f64.powf(random.between(7.0, 8.0)),
                poisson_ratio: random.between(0.1, 0.4),
            },
            coefficient: random.between(0.05, 0.2),
            weight: random.between(5e4, 2e5),
            stress: random.between(0.0, 2e4),
            pull: random.between(1e-4, 4e-4),
            at_start: kind & 1 != 0,
            has_tip: kind & 2 != 0,
            inertia: kind & 4 != 0,
        }
    }

    fn space(&self) -> Outcome<P1<2>> {
        let last = if self.has_tip { 1.4 } else { 2.0 };
        let mesh = Mesh::<2>::grid([2.0, 1.0], [6, 4], GridDiagonal::Rising)?
            .with_surface_where("fault", |x| x[1] == 0.5 && x[0] <= last)?
            .split("fault")?;
        Ok(P1::new(mesh))
    }

    fn load(&self, space: &P1<2>) -> Vec<Vector2<f64>> {
        let weight = self.weight;
        body_force(space, |_| Vector2::new(0.3 * weight, -weight))
    }

    /// The normal stress that comes from the body.
    fn normal_stress(&self) -> NormalStress {
        if self.at_start {
            NormalStress::from_body(self.stress + self.weight).at_start()
        } else {
            NormalStress::from_body(self.stress)
        }
    }

    fn scene(&self, stress: impl Into<NormalStress>) -> Outcome<Scene<BlockMatrix<2>, 2>> {
        let (space, pull) = (self.space()?, self.pull);
        let law = Tresca {
            coefficient: self.coefficient,
        };
        let sides = (space.part("fault+")?, space.part("fault-")?);
        let scene = Scene::new(elasticity(&space, &self.elastic)?)
            .with_load(self.load(&space))
            .in_equilibrium(Cholesky::new())
            .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
            .prescribe_velocity(
                &space.trace(|x| x[0] == 2.0 && x[1] > 0.6)?,
                Components::X,
                move |time| [pull * time, 0.0],
            )
            .with_contact(Contact::between(&sides.0, &sides.1, law, stress));
        Ok(if self.inertia {
            scene.with_mass(mass(&space, 2e3)?)
        } else {
            scene
        })
    }
}

#[test]
fn faults_under_weight_agree_with_their_reductions() -> Outcome {
    let mut slid = 0;
    for seed in 0..32 {
        let random = &mut Random(seed);
        let fault = Weighed::new(random, seed);
        let load = fault.load(&fault.space()?);
        let scene = || fault.scene(fault.normal_stress());
        let (apart, taken, farthest) = compare(&scene, Some(&load), (0.1, 20))?;
        assert_eq!(taken, 20, "{seed}");
        assert!(apart < 1e-9, "{seed}: {apart:e}");
        slid += usize::from(farthest > 0.0);
    }
    assert!(slid > 8, "{slid} faults slide");
    Ok(())
}

/// A body with the reactions of its contacts serves prescribed normal stresses, too; one without them refuses scenes that
/// ask for them.
#[test]
fn a_body_serves_the_normal_stresses_that_it_knows() -> Outcome {
    let fault = Weighed::new(&mut Random(7), 0);
    let given = || fault.scene(1e4);
    let from_body = || fault.scene(fault.normal_stress());
    let body_of = |scene: &Scene<BlockMatrix<2>, 2>| -> Outcome<ReducedBody<2>> {
        Ok(Reduced::new(scene).up_to_frequency(f64::INFINITY)?)
    };
    let (with, without) = (body_of(&from_body()?)?, body_of(&given()?)?);
    let mut slips = Vec::new();
    for body in [&with, &without] {
        let scene = body.reduce(given()?)?;
        let mut motion = Simulation::new(scene, GeneralizedAlpha::default(), DenseNewton::new())?;
        (0..20).try_for_each(|_| motion.step(0.1).map(drop))?;
        let at = motion.snapshot();
        let contact = at.contact(0);
        let all = (0..contact.len()).map(|k| contact.slip(k));
        slips.push(all.fold(0.0, f64::max));
    }
    assert!(
        slips[0] > 0.0 && (slips[0] / slips[1] - 1.0).abs() < 1e-9,
        "{slips:?}"
    );
    let refused = without.reduce(from_body()?).err();
    assert!(
        matches!(refused, Some(SceneError::Unsupported { .. })),
        "{refused:?}"
    );
    // Impacts are none of a reduced body.
    let block = Block::<2>::new(&mut Random(1), |_| true)?;
    let scene = block.scene(|_| true, |_| [0.0; 2])?;
    let scene = scene.with_mass(mass(&block.space, 2e3)?);
    let refused = Reduced::new(&scene).up_to_frequency(f64::INFINITY).err();
    assert!(
        matches!(refused, Some(SceneError::Unsupported { .. })),
        "{refused:?}"
    );
    Ok(())
}
