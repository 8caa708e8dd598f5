//! Impact of contacts that can open: momentum by the impulses of contact and friction, and energy that never grows.

use nalgebra::Vector2;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use stickslip::fem::{Elastic, P1, Viscous, body_force, elasticity, lumped_mass, mass, viscosity};
use stickslip::friction::Tresca;
use stickslip::record::EnergyLedger;
use stickslip::{
    BackwardEuler, BlockMatrix, CentralDifferences, Condensed, Contact, Diagonal, GeneralizedAlpha,
    Newmark, NonsmoothSolver, NormalStress, RateScheme, Scene, Sdirk2, Simulation, Steps,
};

use crate::Outcome;

const GRAVITY: f64 = 9.81;
const DENSITY: f64 = 5e3;

/// A block on a slope, its weight switched on at the start.
#[derive(Debug, Clone)]
struct Block {
    size: [f64; 2],
    cells: usize,
    young_modulus: f64,
    friction: f64,
    /// Of the slope, in radians.
    angle: f64,
    /// Its height above the surface over its own.
    height: f64,
    /// Kelvin-Voigt viscosity over stiffness [s].
    damping: f64,
}

/// The mean velocity of its mass along and off the slope, the energy that the ledger gains at most over all that it had to
/// give, and the least opening.
struct Slide {
    velocity: Vector2<f64>,
    gained: f64,
    through: f64,
}

impl Block {
    fn slide(&self, scheme: Box<dyn RateScheme>, dt: f64, until: f64) -> Outcome<Slide> {
        let [width, height] = self.size;
        let columns = ((width / height).round() as usize).max(1) * self.cells;
        let space = P1::grid(self.size, [columns, self.cells])?;
        let law = Tresca {
            coefficient: self.friction,
        };
        let bottom = space.trace(|x| x[1] == 0.0)?;
        let contact = Contact::new(&bottom, law, NormalStress::from_body(0.0)).allow_opening();
        let (sin, cos) = self.angle.sin_cos();
        let weight = Vector2::new(sin, -cos) * GRAVITY * DENSITY;
        let elastic = Elastic {
            young_modulus: self.young_modulus,
            poisson_ratio: 0.3,
        };
        let lumped = lumped_mass(&space, DENSITY)?;
        let shares: Vec<f64> = (0..space.vertex_count())
            .map(|i| lumped.get(i, i).map_or(0.0, |block| block[(0, 0)]))
            .collect();
        let implicit = scheme.properties().implicit;
        let (masses, solver): (_, Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>) = if implicit {
            (mass(&space, DENSITY)?, Box::new(Condensed::new()))
        } else {
            (lumped, Box::new(Diagonal::new()))
        };
        let above = vec![Vector2::new(0.0, self.height * height); shares.len()];
        let scene = Scene::new(elasticity(&space, &elastic)?)
            .with_mass(masses)
            .with_displacement(above)
            .with_load(body_force(&space, |_| weight))
            .with_contact(contact);
        let scene = if self.damping > 0.0 {
            let shear_modulus = elastic.young_modulus / 2.6;
            let viscous = Viscous {
                shear_viscosity: self.damping * shear_modulus,
                bulk_viscosity: self.damping * elastic.young_modulus / 1.2,
            };
            scene.with_viscosity(viscosity(&space, &viscous)?)
        } else {
            scene
        };
        let mut block = Simulation::new(scene, scheme, solver)?;
        let mut ledger = EnergyLedger::new(&block.snapshot());
        let (mut gained, mut through) = (0.0_f64, 0.0_f64);
        block.run(&Steps::constant(dt).until(until), |at| {
            ledger.record(&at);
            let balance = ledger.balance(&at);
            // The elastic energy of a moved block is rounding of large terms.
            let rounding = 1e-11 * self.young_modulus * (self.height * height).powi(2);
            let given = balance.loads.abs() + balance.kinetic + balance.elastic + rounding;
            gained = gained.max(-balance.left_over / given);
            let contact = at.contact(0);
            for k in 0..contact.len() {
                through = through.min(contact.opening(k));
            }
        })?;
        let at = block.snapshot();
        let momentum = at.velocity.iter().zip(&shares);
        let momentum: Vector2<f64> = momentum.map(|(v, share)| v * *share).sum();
        Ok(Slide {
            velocity: momentum / shares.iter().sum::<f64>(),
            gained,
            through,
        })
    }

    /// The time of a wave through the block and back \[s\].
    fn period(&self) -> f64 {
        2.0 * self.size[1] * (DENSITY / self.young_modulus).sqrt()
    }
}

/// Stiff flat blocks on slopes on which they slide and do not tip.
fn blocks() -> impl Strategy<Value = Block> {
    (
        1.5..4.0,
        0.3..2.0,
        1_usize..4,
        10.0..11.0,
        0.05..0.5,
        0.05..0.4,
    )
        .prop_map(|(aspect, height, cells, decades, friction, above)| Block {
            size: [aspect * height, height],
            cells,
            young_modulus: 10_f64.powf(decades),
            friction,
            angle: f64::atan(friction) + above,
            height: 0.0,
            damping: 0.0,
        })
}

fn schemes() -> impl Strategy<Value = usize> {
    0_usize..4
}

fn scheme(number: usize) -> Box<dyn RateScheme> {
    match number {
        0 => Box::new(GeneralizedAlpha::default()),
        1 => Box::new(Newmark::default()),
        2 => Box::new(Sdirk2),
        _ => Box::new(BackwardEuler),
    }
}

/// Steps that do not resolve the waves of the block.
#[test]
fn a_block_slides_as_coulomb_says() -> Outcome {
    let mut runner = TestRunner::new(Config::with_cases(40));
    let inputs = (blocks(), schemes(), 5e-3..2e-2);
    runner.run(&inputs, |(block, number, dt)| {
        let until = 60.0 * dt;
        let slide = block
            .slide(scheme(number), dt, until)
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        let (sin, cos) = block.angle.sin_cos();
        let right = GRAVITY * (sin - block.friction * cos) * until;
        // Vibrations off the slope, which the weight started, are impulses without friction so far.
        let found = slide.velocity[0] + block.friction * slide.velocity[1];
        prop_assert!((found - right).abs() < 3e-3, "{found} for {right}");
        prop_assert!(
            slide.velocity[1].abs() < GRAVITY * block.period(),
            "off the slope {}",
            slide.velocity[1]
        );
        prop_assert!(slide.through >= 0.0, "penetration {:e}", slide.through);
        Ok(())
    })?;
    Ok(())
}

/// Drops at all steps, from those that resolve waves to those far beyond: energy never grows.
#[test]
fn an_impact_never_gains_energy() -> Outcome {
    let mut runner = TestRunner::new(Config::with_cases(40));
    let inputs = (blocks(), schemes(), -2.0..1.5, 0.0..0.05);
    runner.run(&inputs, |(block, number, decades, height)| {
        let block = Block { height, ..block };
        let dt = block.period() * 10_f64.powf(decades);
        let slide = block
            .slide(scheme(number), dt, 150.0 * dt)
            .map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert!(slide.gained < 1e-3, "gained {:e}", slide.gained);
        prop_assert!(slide.through >= 0.0, "penetration {:e}", slide.through);
        Ok(())
    })?;
    Ok(())
}

/// Central differences: below the coefficient at which sliding itself flutters, and with a viscosity that damps it.
#[test]
fn an_explicit_block_slides_as_coulomb_says() -> Outcome {
    for (cells, friction, damping) in [(1, 0.3, 0.0), (2, 0.1, 0.0), (2, 0.6, 5e-4)] {
        let block = Block {
            size: [2.0, 1.0],
            cells,
            young_modulus: 5e9,
            friction,
            angle: f64::atan(friction) + 0.1,
            height: 0.0,
            damping,
        };
        let dt = 4e-5 / cells as f64;
        let slide = block.slide(Box::new(CentralDifferences), dt, 0.3)?;
        let (sin, cos) = block.angle.sin_cos();
        let right = GRAVITY * (sin - friction * cos) * 0.3;
        let found = slide.velocity[0] + friction * slide.velocity[1];
        assert!((found - right).abs() < 3e-3, "{found} for {right}");
        assert!(
            slide.gained < 1e-3 && slide.through >= 0.0,
            "{:e}",
            slide.gained
        );
    }
    Ok(())
}
