//! A dynamic rupture in plane strain (mode II): SCEC's TPV101 in two dimensions, on a coarse mesh.
//!
//! One body stands for two halves: it moves opposite to the other, so that slip, slip rate, V0 and D_c are half of those
//! across the fault. The rupture is symmetric about its middle, too. The top absorbs the waves. `stickslip rupture` has
//! finer meshes, and more numbers beside those of a spectral code.
//! Parameters: R. Harris et al., Seismol. Res. Lett. 89 (2018), and the 2D setting of the code uguca.

use std::error::Error;
use std::path::Path;

use stickslip::fem::{Elastic, Impedance, P1, dashpot, elasticity, lumped_mass, traction};
use stickslip::friction::RegularizedDieterichRuina;
use stickslip::nalgebra::Vector2;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{CentralDifferences, Components, Contact, Diagonal, Scene, Simulation, Steps};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, Panel, Points};

const NORMAL: f64 = 120e6;
const SHEAR: f64 = 75e6;
const INITIAL_RATE: f64 = 0.5e-12;
const AGING: Dieterich = Dieterich {
    slip_distance: 0.01,
};

/// Velocity weakening up to 15 km, strengthening beyond 18 km.
fn law(x: f64) -> RegularizedDieterichRuina {
    let distance = ((x - 15e3) / 3e3).clamp(1e-9, 1.0 - 1e-9);
    let taper = 0.5 * (1.0 + (1.0 / (distance - 1.0) + 1.0 / distance).tanh());
    RegularizedDieterichRuina {
        a: 0.008 + 0.008 * (1.0 - taper),
        b: 0.012,
        reference_friction: 0.6,
        reference_velocity: 0.5e-6,
        slip_distance: AGING.slip_distance,
    }
}

/// The state at which friction bears the initial stress at the initial slip rate: f = a asinh(V/(2 V0) e^psi).
fn initial(x: f64) -> LogTheta {
    let law = law(x);
    let y = SHEAR / NORMAL / law.a;
    let log_sinh = y + (-(-2.0 * y).exp()).ln_1p() - std::f64::consts::LN_2;
    let friction = law.a * (log_sinh + (2.0 * law.reference_velocity / INITIAL_RATE).ln());
    LogTheta(
        (friction - law.reference_friction) / law.b
            + (law.slip_distance / law.reference_velocity).ln(),
    )
}

/// Overstress within 3 km that starts the rupture \[Pa\].
fn overstress(x: f64) -> f64 {
    let r = (x / 3e3).powi(2).min(1.0 - 1e-9);
    25e6 * (r / (r - 1.0)).exp()
}

/// Its growth within 1 s.
fn growth(time: f64) -> f64 {
    let t = time.clamp(1e-9, 1.0);
    ((t - 1.0).powi(2) / (t * (t - 2.0))).exp()
}

fn main() -> Result<(), Box<dyn Error>> {
    let [length, height] = [36e3, 30e3];
    let space = P1::grid([length, height], [6, 5])?.graded(|x| 200.0 + 0.15 * x[1])?;
    let fault = space.trace(|x| x[1] == 0.0)?;
    let top = space.trace(|x| x[1] == height)?;
    let ends = space.trace(|x| x[0] == 0.0 || x[0] == length)?;
    // c_s = 3464 m/s and c_p = 6000 m/s.
    let (density, elastic) = (2670.0, Elastic::of_waves(2670.0, 6000.0, 3464.0)?);
    let contact = Contact::per_vertex(&fault, fault.map(|x| law(x[0])), NORMAL)
        .with_state(AGING, fault.map(|x| initial(x[0])))
        .with_free_normal()
        .with_shear_stress(Vector2::new(SHEAR, 0.0));
    // The normal stress is there from the start and compresses nothing.
    let balance = traction(&space, &fault, |_| Vector2::new(0.0, -NORMAL))?;
    let nucleation = traction(&space, &fault, |x| Vector2::new(overstress(x[0]), 0.0))?;
    let impedance = Impedance::of(&elastic, density)?;
    let scene = Scene::new(elasticity(&space, &elastic)?)
        .with_mass(lumped_mass(&space, density)?)
        .with_viscosity(dashpot(&space, &top, |_| impedance)?)
        .with_contact(contact)
        .fix(&ends, Components::Y)
        .with_load(balance)
        .with_load_history(move |time, load| {
            load.iter_mut()
                .zip(&nucleation)
                .for_each(|(load, whole)| *load = whole * growth(time));
        })
        .with_velocity(vec![Vector2::new(INITIAL_RATE, 0.0); space.vertex_count()]);
    let mut rupture = Simulation::new(scene, CentralDifferences, Diagonal::new())?;

    let stations = [0.0, 3e3, 6e3];
    let nodes: Vec<usize> = (stations.iter())
        .filter_map(|&x| fault.points().iter().position(|p| (p[0] - x).abs() < 1.0))
        .collect();
    let mut rates = vec![Points::new(); stations.len()];
    // The stability limit is known once a step has been taken.
    rupture.step(1e-6)?;
    let dt = 0.9 * rupture.step_limit().ok_or("the scheme is implicit")?;
    rupture.run(&Steps::constant(dt).until(4.0), |at| {
        for (history, &k) in rates.iter_mut().zip(&nodes) {
            history.push((at.time, 2.0 * at.contact(0).slip_rate(k)));
        }
    })?;
    // Arrivals of the spectral code uguca with cells of 25 m; these are of 200 m.
    for ((history, x), expected) in rates.iter().zip(stations).zip([0.573, 1.786, 2.979]) {
        let arrival = history.iter().find(|(_, rate)| *rate > 1e-3);
        let arrival = arrival.map_or(f64::NAN, |&(time, _)| time);
        println!("at {x:4} m after {arrival:.2} s, by a spectral code {expected:.2} s");
        assert!((arrival - expected).abs() < 0.15);
    }
    let mut panel = Panel::new("time [s]", "slip rate across the fault [m/s]");
    for ((history, label), color) in rates.into_iter().zip(["0 km", "3 km", "6 km"]).zip(COLORS) {
        panel = panel.with(label, color, 2, history);
    }
    let output = Output::create(Path::new("out/rupture"), &[])?;
    plot::draw(&output.path("rupture.png"), &[panel])?;
    Ok(())
}
