//! Bodies on both sides of a fault beside one body that stands for both.

use clap::Parser;
use stickslip::fem::lumped_mass_by_cell;
use stickslip::nalgebra::Vector2;
use stickslip::{Simulation, Steps};

use super::sides::Sides;
use super::{Arguments, PATCHES, Rock};
use crate::cli::Problem;

/// The command line of coarse cells, with more words.
fn coarse(more: &str) -> Result<Arguments, Problem> {
    let line = "rupture --problem tpv6 --cell 1000 --growth 0.5 --height 12e3 --until 3";
    let words = line.split(' ').chain(more.split_whitespace());
    Ok(Arguments::try_parse_from(words)?)
}

/// The slips of the fault by position, and the normal stresses of friction and of the body.
fn along(simulation: &Simulation<2>) -> Vec<[f64; 4]> {
    let at = simulation.snapshot();
    let fault = at.contact(0);
    let rows = (0..fault.len()).map(|k| {
        let stresses = [fault.normal_stress(k), fault.body_normal_stress(k)];
        [fault.point(k)[0], fault.slip(k), stresses[0], stresses[1]]
    });
    let mut rows: Vec<_> = rows.collect();
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    rows
}

/// Between equal materials slip changes no normal stress, and is that of the half body twice.
#[test]
fn equal_materials_are_two_halves() -> Result<(), Problem> {
    let arguments = coarse("")?;
    let mut runs = Vec::new();
    for below in [None, Some(Rock::HARD)] {
        let sides = Sides {
            arguments: &arguments,
            patches: &PATCHES,
            above: Rock::HARD,
            below,
        };
        let (_, mut rupture) = sides.build()?;
        rupture.run(&Steps::constant(0.02).until(3.0), |_| ())?;
        runs.push(along(&rupture));
    }
    let largest = runs[1].iter().map(|row| row[1]).fold(0.0, f64::max);
    assert!(largest > 2.0, "{largest}");
    for (half, whole) in runs[0].iter().zip(&runs[1]) {
        assert_eq!(half[0], whole[0]);
        assert!(
            (2.0 * half[1] - whole[1]).abs() < 1e-9 * largest,
            "{half:?} {whole:?}"
        );
        assert!((whole[2] / 120e6 - 1.0).abs() < 1e-9, "{whole:?}");
    }
    Ok(())
}

/// Friction with an endless delay keeps the initial normal stress, that without one has the stress of the body; both sides
/// exert opposite forces at any delay, so that their momenta stay opposite until waves leave the body.
#[test]
fn friction_follows_the_stress_of_the_body_with_its_delay() -> Result<(), Problem> {
    for (delay, follows) in [("1e9", false), ("1e-9", true), ("0.1", true)] {
        let arguments = coarse(&format!("--relaxation-distance {delay}"))?;
        let sides = Sides {
            arguments: &arguments,
            patches: &PATCHES,
            above: Rock::SOFT,
            below: Some(Rock::HARD),
        };
        let (space, mut rupture) = sides.build()?;
        rupture.run(&Steps::constant(0.02).until(1.6), |_| ())?;
        let changes = along(&rupture).into_iter().map(|row| {
            let [friction, body] = [row[2] - 120e6, row[3] - 120e6];
            assert!(follows || friction.abs() < 10.0, "{row:?}");
            body.abs()
        });
        let change = changes.fold(0.0, f64::max);
        assert!(change > 5e6, "{change}");
        let density = |x: &Vector2<f64>| if x[1] < 0.0 { Rock::HARD } else { Rock::SOFT }.density;
        let mass = lumped_mass_by_cell::<2, 2>(&space, |x, _| density(x))?;
        let (mut sum, mut moduli) = (Vector2::zeros(), 0.0);
        let at = rupture.snapshot();
        for (k, velocity) in at.velocity.iter().enumerate() {
            let momentum = mass
                .get(k, k)
                .map_or(Vector2::zeros(), |block| block * velocity);
            sum += momentum;
            moduli += momentum.norm();
        }
        assert!(sum.norm() < 1e-6 * moduli, "{delay}: {sum:?} of {moduli}");
    }
    Ok(())
}
