//! Slip that injection drives under constant friction, beside closed forms: a front at `lambda sqrt(4 alpha t)`.
//!
//! The stress parameter is the initial strength less the shear stress, over the coefficient of friction and a pressure of
//! the source: `T = (1 - tau/(f sigma)) sigma/p`.

use nalgebra::{DMatrix, Vector1};
use stickslip::bie::{Cells, Fault, Medium, Mode, PlaneFault, Rectangles};
use stickslip::fields::{Diffusion, Hydraulics, Line, Plane, RateHistory, Well};
use stickslip::friction::Tresca;
use stickslip::{BackwardEuler, Contact, DenseNewton, Scene, Simulation};

use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3000.0,
};
const NORMAL: f64 = 50e6;
const LAW: Tresca = Tresca { coefficient: 0.6 };
/// Diffusivity .01 m^2/s.
const VISCOSITY: f64 = 1e-3;
const PERMEABILITY: f64 = 1e-14;
const STORAGE: f64 = 1e-9;
const DIFFUSIVITY: f64 = PERMEABILITY / (VISCOSITY * STORAGE);
/// The number of steps: slip under constant friction follows from the pressure at the end.
const STEPS: u32 = 40;

fn zone() -> Hydraulics {
    Hydraulics {
        permeability: PERMEABILITY.into(),
        viscosity: VISCOSITY.into(),
        storage: STORAGE.into(),
        thickness: 1.0.into(),
    }
}

/// The slip of each cell at the end, under a shear stress along the first direction.
fn slip(
    operators: [DMatrix<f64>; 2],
    contact: Contact<Tresca, (), 1>,
    (shear, end): (f64, f64),
) -> Outcome<Vec<f64>> {
    let [stiffness, damping] = operators;
    let contact = contact.with_shear_stress(Vector1::new(shear));
    let scene = Scene::new(stiffness)
        .with_viscosity(damping)
        .with_contact(contact);
    let mut motion = Simulation::new(scene, BackwardEuler, DenseNewton::new())?;
    for _ in 0..STEPS {
        motion.step(end / f64::from(STEPS))?;
    }
    let contact = motion.snapshot().contact(0);
    Ok((0..contact.len()).map(|k| contact.slip(k)).collect())
}

/// Injection at a constant rate into a plane, Poisson's ratio 0: the front is a circle. The radius that slip has in so many
/// cells, over that of the closed form, and slip at a quarter of it over that.
fn circle(parameter: f64, lambda: f64, quarter: f64, cells: usize) -> Outcome<[f64; 2]> {
    let scale = NORMAL / 20.0;
    let shear = LAW.coefficient * (NORMAL - parameter * scale);
    // Cells of 1 m, one at the well.
    let radius = cells as f64;
    let end = (radius / lambda).powi(2) / (4.0 * DIFFUSIVITY);
    let half = (1.25 * radius) as usize + 1;
    let count = 2 * half + 1;
    let ends = |count: usize| [-0.5 * count as f64, 0.5 * count as f64];
    let side = Cells::new(ends(count), count)?;
    let fault = PlaneFault::whole_space(Rectangles::new(side, side), ROCK, 0.0)?.with_rake(0.0)?;
    // Fluid has room far beyond the fault.
    let wide = 2 * half.max((3.5 * radius / lambda) as usize) + 1;
    let beside = (wide - count) / 2;
    let vertices: Vec<usize> = (0..count * count)
        .map(|k| (k / count + beside) * wide + k % count + beside)
        .collect();
    let rate = scale * 4.0 * std::f64::consts::PI * PERMEABILITY / VISCOSITY;
    let field = Diffusion::new(Plane::new([ends(wide); 2], [wide; 2])?, &zone())?
        .with_vertices(&vertices)?
        .with_well(Well::new([0.0, 0.0], RateHistory::constant(rate)?))?;
    let contact = Contact::new(&fault, LAW, NORMAL).with_field(field);
    let operators = [
        DMatrix::from(&fault.stiffness()),
        DMatrix::from(&fault.radiation_damping()),
    ];
    let slip = slip(operators, contact, (shear, end))?;
    let centre = slip[count * count / 2];
    let slipped = slip.iter().filter(|&&own| own > 1e-3 * centre).count();
    let found = (slipped as f64 / std::f64::consts::PI).sqrt();
    // The mean over the four directions of the plane, linear between cells.
    let place = 0.25 * radius;
    let at = |stride: isize| {
        let cell = |n: usize| slip[(count * count / 2).wrapping_add_signed(stride * n as isize)];
        let (n, share) = (place as usize, place.fract());
        (1.0 - share) * cell(n) + share * cell(n + 1)
    };
    let row = count as isize;
    let mean = [1, -1, row, -row].map(at).iter().sum::<f64>() / 4.0;
    let exact = quarter * LAW.coefficient * scale * radius / ROCK.shear_modulus;
    Ok([found / radius, mean / exact])
}

/// Sáez et al., J. Mech. Phys. Solids 160 (2022): `T = int_0^1 E1(lambda^2 x^2) x/sqrt(1 - x^2) dx`.
#[test]
fn a_circle_grows_with_injection_at_a_constant_rate() -> Outcome {
    for (parameter, lambda, quarter) in [
        (0.1, 2.304_540_65, 0.536_813),
        (1.0, 0.723_288_09, 1.389_429),
    ] {
        let [radius, slip] = circle(parameter, lambda, quarter, 12)?;
        assert!((radius - 1.0).abs() < 0.04, "{parameter}: radius {radius}");
        assert!((slip - 1.0).abs() < 0.05, "{parameter}: slip {slip}");
    }
    Ok(())
}

/// The front of slip on a line, over that of the closed form, when that is so many cells from the source. Constant friction
/// leaves no singularity at the front: slip grows with the distance from it to the power of 3/2, and the front is the place at
/// which slip to the power of 2/3, linear between the last cells, vanishes.
fn line(parameter: f64, lambda: f64, cells: usize) -> Outcome<f64> {
    let front = cells as f64;
    let end = (front / lambda).powi(2) / (4.0 * DIFFUSIVITY);
    // The pressure at the source in the end.
    let pressure = NORMAL / 4.0;
    let rate = pressure * STORAGE * (std::f64::consts::PI * DIFFUSIVITY / end).sqrt();
    let shear = LAW.coefficient * (NORMAL - parameter * pressure);
    let half = (1.3 * front) as usize + 2;
    let count = 2 * half + 1;
    let ends = |count: usize| [-0.5 * count as f64, 0.5 * count as f64];
    let fault = Fault::whole_space(Cells::new(ends(count), count)?, ROCK, Mode::Antiplane)?;
    let wide = 2 * half.max((5.0 * front / lambda) as usize) + 1;
    let beside = (wide - count) / 2;
    let vertices: Vec<usize> = (0..count).map(|k| k + beside).collect();
    let field = Diffusion::new(Line::uniform(ends(wide), wide)?, &zone())?
        .with_vertices(&vertices)?
        .with_well(Well::new(0.0, RateHistory::constant(rate)?))?;
    let contact = Contact::new(&fault, LAW, NORMAL).with_field(field);
    let operators = [
        DMatrix::from(&fault.stiffness()),
        DMatrix::from(&fault.radiation_damping()),
    ];
    let slip = slip(operators, contact, (shear, end))?;
    let last = slip.iter().rposition(|&own| own > 0.0).ok_or("no slip")?;
    // The last cell slips by the part of it that is behind the front.
    let [near, far] = [last - 1, last - 4].map(|k| slip[k].powf(2.0 / 3.0));
    let beyond = 3.0 * near / (far - near);
    Ok(((last - 1 - half) as f64 + beyond) / front)
}

/// Injection at a constant rate, at the moment at which the pressure at the source has this stress parameter.
#[test]
fn slip_on_a_line_grows_with_injection_at_a_constant_rate() -> Outcome {
    for (parameter, lambda) in [
        (0.1, 2.868_863_37),
        (0.2, 1.520_713_62),
        (0.4, 0.786_840_42),
        (0.7, 0.307_199_81),
    ] {
        let front = line(parameter, lambda, 25)?;
        assert!((front - 1.0).abs() < 0.01, "{parameter}: {front}");
    }
    Ok(())
}
