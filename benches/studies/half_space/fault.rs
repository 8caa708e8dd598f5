//! The fault of BP1-QD, in a finite body and in a half space.

use nalgebra::Vector1;
use stickslip::bie::{self, Cells};
use stickslip::fem::{P1, antiplane, antiplane_dashpot};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::integrate::Stepper;
use stickslip::problems::bp1::{self, DEPTH};
use stickslip::reduced::Reduced;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{BoundaryPart, Components, Contact, RungeKutta, Scene};
use stickslip_cli::cli::Problem;

/// The depth at which events are detected \[m\].
const HYPOCENTRE: f64 = 7.5e3;
/// The coarsest cells of a body \[m\].
const COARSE: f64 = 8e3;
/// By how much cells grow with the distance from the fault.
const GROWTH: f64 = 0.1;
/// Slip across the fault over the displacement of one of its sides.
pub(crate) const SIDES: f64 = 2.0;
/// The rate of the plate and of the fault at the start, of one side [m/s].
const RATE: f64 = bp1::PLATE_RATE / SIDES;

/// A fault at its start.
pub(crate) struct Fault {
    pub(crate) motion: Box<dyn Stepper<1>>,
    /// Those of the mesh, if there is one.
    pub(crate) vertices: Option<usize>,
    /// The place on the contact where events are looked for.
    pub(crate) station: usize,
}

type Friction = Contact<RegularizedDieterichRuina, Dieterich, 1>;

/// The friction of the fault at these depths as a function of the displacement of one side.
fn friction(part: impl Into<BoundaryPart>, depths: &[f64]) -> Friction {
    let laws = depths.iter().map(|&z| {
        let law = bp1::friction(z);
        RegularizedDieterichRuina {
            reference_velocity: law.reference_velocity / SIDES,
            slip_distance: law.slip_distance / SIDES,
            ..law
        }
    });
    let aging = Dieterich {
        slip_distance: bp1::AGING.slip_distance / SIDES,
    };
    let states: Vec<_> = depths
        .iter()
        .map(|&z| LogTheta(bp1::initial_log_theta(z)))
        .collect();
    Contact::per_vertex(part, laws, bp1::NORMAL_STRESS)
        .with_state(aging, states)
        .with_shear_stress(Vector1::new(bp1::shear_stress()))
}

/// One side of the fault: a square of `size` \[km\], moved at half the plate rate below the fault and at its far side,
/// free elsewhere, with waves that leave the fault for good. Static responses of its surface stand for it exactly.
pub(crate) fn elements(size: usize, cell: f64) -> Result<Fault, Problem> {
    let length = 1e3 * size as f64;
    let count = (length / COARSE).round() as usize;
    // The longest edge of a cell is a diagonal.
    let finest = 1.01 * 2_f64.sqrt() * cell;
    let space = P1::grid([length, length], [count, count])?.graded(|x| {
        let beyond = (x[1] - DEPTH).max(0.0);
        finest + GROWTH * x[0].hypot(beyond)
    })?;
    let on_fault = space.trace(|x| x[0] == 0.0 && x[1] <= DEPTH)?;
    let below = space.trace(|x| x[0] == 0.0 && x[1] >= DEPTH)?;
    let far = space.trace(|x| x[0] == length)?;
    let depths: Vec<_> = on_fault.points().iter().map(|x| x[1]).collect();
    let rock = bp1::MEDIUM;
    let impedance = rock.shear_modulus / rock.shear_wave_speed;
    let scene = Scene::new(antiplane(&space, rock.shear_modulus)?)
        .with_viscosity(antiplane_dashpot(&space, &on_fault, |_| impedance)?)
        .with_contact(friction(&on_fault, &depths))
        .prescribe_velocity(&below, Components::ALL, |_| [RATE])
        .prescribe_velocity(&far, Components::ALL, |_| [RATE])
        .with_velocity(vec![Vector1::new(RATE); space.vertex_count()]);
    let body = Reduced::new(&scene).up_to_frequency(f64::INFINITY)?;
    Ok(Fault {
        motion: Box::new(RungeKutta::new(body.reduce(scene)?)?),
        vertices: Some(space.vertex_count()),
        station: nearest(&depths),
    })
}

/// The half space.
pub(crate) fn kernel(cell: f64) -> Result<Fault, Problem> {
    let cells = Cells::new([0.0, DEPTH], (DEPTH / cell).round() as usize)?;
    let fault = bie::Fault::half_space(cells, bp1::MEDIUM)?.one_sided();
    let depths = cells.map(|z| z);
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(friction(&fault, &depths))
        .with_load_history(fault.plate_loading(RATE))
        .with_velocity(cells.map(|_| Vector1::new(RATE)));
    Ok(Fault {
        motion: Box::new(RungeKutta::new(scene)?),
        vertices: None,
        station: nearest(&depths),
    })
}

/// The place of the depth where events are looked for.
fn nearest(depths: &[f64]) -> usize {
    let distances = depths.iter().map(|z| (z - HYPOCENTRE).abs());
    let nearest = distances
        .enumerate()
        .min_by(|(_, a), (_, b)| a.total_cmp(b));
    nearest.map_or(0, |(place, _)| place)
}
