//! A column in space that is sheared is the layer that waves solve exactly.

use nalgebra::Vector3;
use stickslip::fem::{Elastic, P1, elasticity, mass};
use stickslip::friction::DieterichRuina;
use stickslip::problems::antiplane_layer::{
    AGING, AntiplaneLayer, FRICTION, NORMAL_STRESS, load_velocity,
};
use stickslip::state::LogTheta;
use stickslip::{Components, Condensed, Contact, Newmark, Scene, Simulation, Steps};

use crate::Outcome;

/// It strengthens, so that errors do not grow by themselves, and yields after about 3 s.
const LAW: DieterichRuina = DieterichRuina {
    a: 0.015,
    b: 0.010,
    reference_friction: 0.05,
    ..FRICTION
};
const INITIAL: LogTheta = LogTheta(2.0);
/// Transits of a wave from top to base until the end, 3.7 s: the velocity of the top has a kink at 3.75 s, which is not
/// the end of a step.
const TRANSITS: usize = 230;
/// The angle of the motion off the first axis.
const ANGLE: f64 = 0.4;

/// The displacement of the base in the exact solution \[m\], one a transit.
fn exact(layer: &AntiplaneLayer) -> Outcome<Vec<f64>> {
    const TRANSIT_STEPS: usize = 400;
    let (mut n, mut displacements) = (0, Vec::new());
    layer.exact(&LAW, &AGING, INITIAL, TRANSIT_STEPS, |at| {
        n += 1;
        if n % TRANSIT_STEPS == 0 && displacements.len() < TRANSITS {
            displacements.push(at.displacement);
        }
    })?;
    Ok(displacements)
}

/// The largest distance of a vertex of the base from `exact` \[m\], over all transits.
fn error(layer: &AntiplaneLayer, exact: &[f64]) -> Outcome<f64> {
    let cells = layer.cells;
    let width = 1.0 / cells as f64;
    let space = P1::<3>::grid([width, width, 1.0], [1, 1, cells])?;
    let (base, top) = (space.trace(|x| x[2] == 0.0)?, space.trace(|x| x[2] == 1.0)?);
    let sides = space.trace(|x| {
        [0.0, width]
            .iter()
            .any(|&side| x[0] == side || x[1] == side)
    })?;
    let contact = Contact::new(&base, LAW, NORMAL_STRESS).with_state(AGING, INITIAL);
    let direction = Vector3::new(ANGLE.cos(), ANGLE.sin(), 0.0);
    let elastic = Elastic {
        young_modulus: 2.6 * layer.shear_modulus,
        poisson_ratio: 0.3,
    };
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(mass(&space, layer.density)?)
        .with_contact(contact)
        .fix(&sides, Components::Z)
        .prescribe_velocity(&top, Components::X | Components::Y, move |time| {
            (direction * load_velocity(time)).into()
        });
    let mut column = Simulation::new(scene, Newmark::default(), Condensed::new())?;
    let transit = (layer.density / layer.shear_modulus).sqrt();
    let plan = Steps::constant(transit / cells as f64).count(cells);
    let mut largest = 0.0_f64;
    for displacement in exact {
        column.run(&plan, |_| ())?;
        let at = column.snapshot();
        for &vertex in base.vertices() {
            let off = at.displacement[vertex] - direction * *displacement;
            largest = largest.max(off.norm());
        }
    }
    Ok(largest)
}

/// A shear wave has no traction but the vertical one on vertical planes, whichever way it moves: a side that holds the
/// vertical component and leaves the others free does not know it is a side.
///
/// Cells and steps are halved together, at a step a cell. Where motion is smooth the error is of second order. The top
/// begins with a jump of its acceleration, though, and the kink of the velocity (smoothness `s = 3/2`) that runs to and
/// fro from then on converges with order `2 s/3 = 1` by a scheme of second order. Source: P. Brenner, V. Thomee,
/// L. Wahlbin, "Besov Spaces and Applications to Difference Methods", Springer (1975). The error falls by 2 to 4.
#[test]
fn a_sheared_column_is_the_layer() -> Outcome {
    let layer = |cells| AntiplaneLayer {
        cells,
        ..AntiplaneLayer::default()
    };
    let exact = exact(&layer(1))?;
    let slipped = exact[TRANSITS - 1];
    let mut errors = Vec::new();
    for cells in [8, 16, 32] {
        errors.push(error(&layer(cells), &exact)?);
    }
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((2.0..4.2).contains(&ratio), "{ratio}: {errors:?}");
    }
    assert!(slipped > 1e-4, "{slipped:e}");
    // A cell in 32, squared, is 1e-3.
    assert!(errors[2] < 1e-3 * slipped, "{slipped:e} {errors:?}");
    Ok(())
}
