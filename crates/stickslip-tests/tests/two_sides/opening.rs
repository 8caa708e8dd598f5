//! Faults and contacts that open and close: Signorini's conditions, statics and impact.

use nalgebra::Vector2;
use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity, lumped_mass, mass};
use stickslip::friction::Tresca;
use stickslip::record::EnergyLedger;
use stickslip::{
    BlockMatrix, CentralDifferences, Components, Condensed, Contact, Diagonal, GeneralizedAlpha,
    Newmark, NonsmoothSolver, NormalStress, RateScheme, Scene, Simulation, Steps, Tnnmg,
};

use crate::Outcome;

/// No strain across: stress and strain are those of a bar.
const BAR: Elastic = Elastic {
    young_modulus: 1.0,
    poisson_ratio: 0.0,
};

fn solvers(space: &P1<2>) -> [Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>; 2] {
    [
        Box::new(Condensed::new()),
        Box::new(Tnnmg::new(space.transfers())),
    ]
}

/// A bar of two halves, pulled for a second, then pushed for another: the fault opens when the initial stress is used
/// up, and closes without penetration.
#[test]
fn a_bar_opens_and_closes() -> Outcome {
    let mesh = Mesh::<2>::grid([1.0, 2.0], [2, 4], GridDiagonal::Rising)?
        .with_surface_where("fault", |x| x[1] == 1.0)?
        .split("fault")?;
    let space = P1::new(mesh).refined(1)?;
    for initial in [0.0, 2e-4] {
        for solver in solvers(&space) {
            let fault = Contact::between(
                &space.part("fault+")?,
                &space.part("fault-")?,
                Tresca { coefficient: 0.5 },
                NormalStress::from_body(initial),
            )
            .allow_opening();
            let scene = Scene::new(elasticity(&space, &BAR)?)
                .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
                .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |time| {
                    [0.0, if time <= 1.0 { 1e-3 } else { -2e-3 }]
                })
                .with_contact(fault);
            let mut bar = Simulation::new(scene, GeneralizedAlpha::default(), solver)?;
            let mut ledger = EnergyLedger::new(&bar.snapshot());
            let (mut opened, mut closed) = (0, 0);
            bar.run(&Steps::constant(0.05).until(2.0).stopping_at([1.0]), |at| {
                ledger.record(&at);
                let top = 1e-3 * at.time.min(1.0) - 2e-3 * (at.time - 1.0).max(0.0);
                let fault = at.contact(0);
                for k in 0..fault.len() {
                    let gap = (top - 2.0 * initial).max(0.0);
                    let pressure = (initial - 0.5 * top).max(0.0);
                    let (found, stress) = (fault.opening(k), fault.normal_stress(k));
                    assert!(
                        (found - gap).abs() < 1e-12,
                        "{} {k}: {found:e} {gap:e}",
                        at.time
                    );
                    assert!(
                        (stress - pressure).abs() < 1e-12,
                        "{} {k}: {stress:e}",
                        at.time
                    );
                    assert!(fault.slip(k) < 1e-12);
                    opened += usize::from(found > 0.0);
                    closed += usize::from(found == 0.0);
                }
            })?;
            assert!(opened > 0 && closed > 0);
            let sums = ledger.balance(&bar.snapshot());
            assert!(sums.left_over.abs() < 1e-10 * sums.stored.abs(), "{sums:?}");
        }
    }
    Ok(())
}

const SPEED: f64 = 0.1;

/// A bar flies onto a rigid surface, presses on it by `rho c v` while a wave runs to its end and back, and leaves as
/// fast as it came. Returns the share of its energy that is lost.
fn bounce(
    refinements: usize,
    space: &P1<2>,
    scheme: impl RateScheme + std::fmt::Debug + 'static,
    solver: Box<dyn NonsmoothSolver<BlockMatrix<2>, 2>>,
) -> Outcome<f64> {
    let (size, name) = (space.vertex_count(), format!("{scheme:?}"));
    let foot = space.trace(|x| x[1] == 0.0)?;
    let law = Tresca { coefficient: 0.0 };
    let contact = Contact::new(&foot, law, NormalStress::from_body(0.0)).allow_opening();
    let masses = if scheme.properties().implicit {
        mass(space, 1.0)?
    } else {
        lumped_mass(space, 1.0)?
    };
    let scene = Scene::new(elasticity(space, &BAR)?)
        .with_mass(masses)
        .with_displacement(vec![Vector2::new(0.0, 0.05); size])
        .with_velocity(vec![Vector2::new(0.0, -SPEED); size])
        .with_contact(contact);
    let mut bar = Simulation::new(scene, scheme, solver)?;
    let mut ledger = EnergyLedger::new(&bar.snapshot());
    let start = ledger.balance(&bar.snapshot()).kinetic;
    let (mut end, mut pressed, mut through) = (start, Vec::new(), 0.0_f64);
    let dt = 0.25 * 0.5_f64.powi(refinements as i32 + 2);
    bar.run(&Steps::constant(dt).until(4.0), |at| {
        ledger.record(&at);
        let balance = ledger.balance(&at);
        end = balance.kinetic + balance.elastic;
        assert!(end < start * 1.001, "{name} {} {end}", at.time);
        let foot = at.contact(0);
        for k in 0..foot.len() {
            through = through.min(foot.opening(k));
            if at.time > 1.0 && at.time < 2.0 {
                pressed.push(foot.normal_stress(k));
            }
        }
    })?;
    assert_eq!(through, 0.0, "{name}: penetration");
    let mean = pressed.iter().sum::<f64>() / pressed.len() as f64;
    assert!(
        (mean - SPEED).abs() < 0.02 * SPEED,
        "{name}: pressure {mean}"
    );
    let at = bar.snapshot();
    let mean = at.velocity.iter().map(|v| v[1]).sum::<f64>() / size as f64;
    assert!(
        (mean - SPEED).abs() < 0.1 * SPEED,
        "{name}: leaves at {mean}"
    );
    assert!(at.contact(0).opening(0) > 0.5 * SPEED);
    Ok(1.0 - end / start)
}

/// Energy is lost in the impact of the vertices alone: the less, the finer.
#[test]
fn a_bar_bounces() -> Outcome {
    let mut lost = Vec::new();
    for refinements in [2, 3] {
        let mesh = Mesh::<2>::grid([0.25, 1.0], [1, 4], GridDiagonal::Rising)?;
        let space = P1::new(mesh).refined(refinements)?;
        let [condensed, multigrid] = solvers(&space);
        let scheme = GeneralizedAlpha::default;
        lost.push([
            bounce(refinements, &space, scheme(), condensed)?,
            bounce(refinements, &space, scheme(), multigrid)?,
            bounce(
                refinements,
                &space,
                Newmark::default(),
                Box::new(Condensed::new()),
            )?,
            bounce(
                refinements,
                &space,
                CentralDifferences,
                Box::new(Diagonal::new()),
            )?,
        ]);
    }
    for (coarse, fine) in lost[0].iter().zip(&lost[1]) {
        assert!(*fine < 0.7 * coarse && *coarse < 0.1, "{lost:?}");
    }
    assert!((lost[0][0] - lost[0][1]).abs() < 1e-6, "{lost:?}");
    Ok(())
}
