//! Two materials: how does slip along their interface change its normal stress?
//!
//! A shear stress `tau sin(k x)` on an interface without friction makes it slip. Between equal materials the normal
//! stress stays. Between two materials it changes by Dundurs' parameter, in proportion to the shear stress,
//!
//! ```text
//! slip = tau sin(k x) A (1 - beta^2)/k,    change of the normal stress = -beta tau cos(k x)
//! A = (1 - nu_1)/G_1 + (1 - nu_2)/G_2,     beta = (G_1 (1 - 2 nu_2) - G_2 (1 - 2 nu_1))
//!                                                 /(2 (G_1 (1 - nu_2) + G_2 (1 - nu_1)))
//! ```
//!
//! so that one end of a slipping patch loses strength, and the other one gains it (J. Weertman, J. Geophys. Res. 85
//! (1980)).

use std::error::Error;
use std::f64::consts::PI;
use std::path::Path;

use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity_by_cell};
use stickslip::friction::Tresca;
use stickslip::nalgebra::Vector2;
use stickslip::{BackwardEuler, Components, Condensed, Contact, NormalStress, Scene, Simulation};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, DARK, PALE, Panel, Points};

const NU: f64 = 0.25;
/// Shear moduli above and below \[Pa\].
const G: [f64; 2] = [10e9, 30e9];
const NORMAL_STRESS: f64 = 50e6;
const SHEAR_STRESS: f64 = 10e6;

/// Position, slip and change of the normal stress along an interface of half a period, 1 m, in n cells; above and below
/// are 2 m.
fn interface(n: usize) -> Result<Vec<[f64; 3]>, Box<dyn Error>> {
    let mesh = Mesh::<2>::grid([1.0, 4.0], [n, 4 * n], GridDiagonal::Rising)?
        .with_surface_where("interface", |x| x[1] == 2.0)?;
    let upper = |cell: &[u32]| cell.iter().any(|&p| mesh.vertices()[p as usize][1] > 2.0);
    let above: Vec<bool> = mesh.cells().map(upper).collect();
    let space = P1::new(mesh.split("interface")?);
    let rock = |_: &Vector2<f64>, cell: usize| Elastic {
        young_modulus: 2.0 * (1.0 + NU) * G[usize::from(!above[cell])],
        poisson_ratio: NU,
    };
    let (plus, minus) = (space.part("interface+")?, space.part("interface-")?);
    let shear = plus.map(|x| Vector2::new(SHEAR_STRESS * (PI * x[0]).sin(), 0.0));
    let free = Tresca { coefficient: 0.0 };
    let contact = Contact::between(&plus, &minus, free, NormalStress::from_body(NORMAL_STRESS))
        .with_shear_stress(shear);
    // The solution is odd about both sides in x, so that they are fixed along it.
    let scene = Scene::new(elasticity_by_cell(&space, rock)?)
        .with_contact(contact)
        .fix(&space.trace(|x| x[0] == 0.0 || x[0] == 1.0)?, Components::X)
        .fix(&space.trace(|x| x[1] == 0.0)?, Components::Y);
    let mut blocks = Simulation::new(scene, BackwardEuler, Condensed::new())?;
    blocks.step(1.0)?;
    let at = blocks.snapshot();
    let contact = at.contact(0);
    let mut along: Vec<[f64; 3]> = (0..contact.len())
        .map(|k| {
            let change = contact.normal_stress(k) - NORMAL_STRESS;
            [contact.point(k)[0], contact.slip_vector(k)[0], change]
        })
        .collect();
    along.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Ok(along)
}

fn main() -> Result<(), Box<dyn Error>> {
    let compliance = (1.0 - NU) * (1.0 / G[0] + 1.0 / G[1]);
    let beta = 0.5 * (1.0 - 2.0 * NU) * (G[0] - G[1]) / ((1.0 - NU) * (G[0] + G[1]));
    let slip = SHEAR_STRESS * compliance * (1.0 - beta * beta) / PI;
    // The amplitudes of the sine and the cosine in the solution, over the exact ones.
    let ratios = |along: &[[f64; 3]]| {
        let last = along.len() - 1;
        let weight = |k: usize| if k == 0 || k == last { 1.0 } else { 2.0 } / last as f64;
        let part = |column: usize, of: fn(f64) -> f64| -> f64 {
            let terms = along.iter().enumerate();
            terms
                .map(|(k, row)| weight(k) * row[column] * of(PI * row[0]))
                .sum()
        };
        [
            part(1, f64::sin) / slip,
            part(2, f64::cos) / (-beta * SHEAR_STRESS),
        ]
    };
    let mut errors = Vec::new();
    for n in [16, 32, 64] {
        let [slip, stress] = ratios(&interface(n)?).map(|ratio| ratio - 1.0);
        println!("{n} cells: errors of slip {slip:+.2e}, of the normal stress {stress:+.2e}");
        errors.push(slip.abs().max(stress.abs()));
    }
    // Of second order in the size of cells.
    assert!(errors[2] < 5e-3 && errors[0] / errors[2] > 14.0);

    let along = interface(32)?;
    let curve = |of: &dyn Fn(&[f64; 3]) -> f64| -> Points {
        along.iter().map(|row| (row[0], of(row))).collect()
    };
    let position = "position along the interface [m]";
    let change = |x: &[f64; 3]| -1e-6 * beta * SHEAR_STRESS * (PI * x[0]).cos();
    let panels = [
        Panel::new(position, "slip [mm]")
            .with("exact", PALE, 5, curve(&|x| 1e3 * slip * (PI * x[0]).sin()))
            .with("32 cells", DARK, 2, curve(&|x| 1e3 * x[1])),
        Panel::new(position, "change of the normal stress [MPa]")
            .with("exact", PALE, 5, curve(&change))
            .with("32 cells", DARK, 2, curve(&|x| 1e-6 * x[2])),
    ];
    let output = Output::create(Path::new("out/two_materials"), &[])?;
    plot::draw(&output.path("two-materials.png"), &panels)?;
    println!("two-materials.png in {}", output.folder().display());
    Ok(())
}
