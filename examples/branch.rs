//! A fault with a splay: how much of the slip does the branch take?
//!
//! A block under uniaxial compression has a fault that ends inside, and a splay of 30 degrees that ends on it. The normal
//! stress of both comes from the deformation. The work of the load is that in the intact block, and that of the stress
//! of the intact block on the slip of each fault (Betti's theorem),
//!
//! ```text
//! load . u = area P^2 (1 - nu^2)/E + sum over faults of the integral of tau_0 slip
//! ```

use std::error::Error;
use std::path::Path;

use stickslip::fem::{Elastic, GridDiagonal, Mesh, P1, elasticity};
use stickslip::friction::Tresca;
use stickslip::nalgebra::{Matrix2, Vector2};
use stickslip::{
    BackwardEuler, BoundaryPart, Components, Condensed, Contact, NormalStress, Scene, Simulation,
};
use stickslip_cli::output::Output;
use stickslip_cli::plot::{self, COLORS, DARK, PALE, Panel, Points};

const ROCK: Elastic = Elastic {
    young_modulus: 50e9,
    poisson_ratio: 0.25,
};
const COMPRESSION: f64 = 50e6;
/// The dips of the main fault and of the splay, and where they end along x \[km\].
const FAULTS: [(f64, [f64; 2]); 2] = [(0.0, [5.0, 11.0]), (30.0, [8.0, 10.0])];
/// The angle from the fault to the compression.
const ANGLE: f64 = -25.0;

/// Position along x \[km\] and slip \[m\] on each fault, the work of the load \[J/m\] on each fault, and what is left of it
/// beside that in the intact block.
type Outcome = (Vec<Points>, Vec<f64>, f64);

fn compress(names: &[&str]) -> Result<Outcome, Box<dyn Error>> {
    // The diagonals of the cells dip by 30 degrees.
    let size = Vector2::new(16e3, 16e3 / 3f64.sqrt());
    let height = move |x: &Vector2<f64>| x[1] - 0.5 * size[1];
    let above = move |x: &Vector2<f64>, slope: f64| (height(x) - slope * (x[0] - 8e3)).abs() < 1e-3;
    let mesh = Mesh::<2>::grid(size.into(), [16, 16], GridDiagonal::Rising)?
        .with_surface_where("main", |x| above(x, 0.0) && (5e3..=11e3).contains(&x[0]))?
        .with_surface_where("splay", |x| {
            above(x, 1.0 / 3f64.sqrt()) && (8e3..=10e3).contains(&x[0])
        })?;
    let space = P1::new(mesh.split_all(names)?).graded(|x| {
        let beside = Vector2::new((x[0] - 8e3).abs() - 3e3, (height(x) - 6e2).abs() - 6e2);
        80.0 + 0.2 * beside.map(|x| x.max(0.0)).norm()
    })?;

    let axis = Vector2::new(ANGLE.to_radians().cos(), ANGLE.to_radians().sin());
    let stress: Matrix2<f64> = axis * axis.transpose() * -COMPRESSION;
    let mut load = vec![Vector2::zeros(); space.vertex_count()];
    for (axis, end) in [(0, 0.0), (0, size[0]), (1, 0.0), (1, size[1])] {
        let edge = space.trace(|x| x[axis] == end)?;
        for (&p, weight) in edge.vertices().iter().zip(edge.weights()) {
            load[p] += stress.column(axis) * (if end > 0.0 { *weight } else { -weight });
        }
    }
    // Three components hold the block, without a force: the load balances itself.
    let corner = |x: f64| BoundaryPart {
        vertices: space.vertex_at([x, 0.0]).into_iter().collect(),
        ..BoundaryPart::point(1.0)
    };
    let mut scene = Scene::new(elasticity(&space, &ROCK)?)
        .with_load(load.clone())
        .fix(corner(0.0), Components::ALL)
        .fix(corner(size[0]), Components::Y);
    for name in names {
        let [plus, minus] = ["+", "-"].map(|side| space.part(&format!("{name}{side}")));
        let (law, stress) = (Tresca { coefficient: 0.3 }, NormalStress::from_body(0.0));
        // Beside the end of the splay some vertices are in tension, and open.
        scene = scene.with_contact(Contact::between(&plus?, &minus?, law, stress).allow_opening());
    }
    let mut block = Simulation::new(scene, BackwardEuler, Condensed::new())?;
    block.step(1.0)?;

    let at = block.snapshot();
    let (mut slip, mut on_faults) = (Vec::new(), Vec::new());
    for (index, (dip, tips)) in FAULTS.into_iter().enumerate().take(names.len()) {
        let (contact, dip) = (at.contact(index), dip.to_radians());
        let row = |k: usize| (1e-3 * contact.point(k)[0], contact.slip(k));
        let mut rows: Points = (0..contact.len()).map(row).collect();
        rows.extend(tips.map(|x| (x, 0.0)));
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        slip.push(rows);
        // The stress of the intact block on the minus side, times the jump.
        let normal = Vector2::new(-dip.sin(), dip.cos());
        let traction = stress * normal;
        let jump = |k: usize| contact.slip_vector(k) + normal * contact.opening(k);
        let work = |k: usize| contact.weight(k) * traction.dot(&jump(k));
        on_faults.push((0..contact.len()).map(work).sum());
    }
    let products = load.iter().zip(at.displacement);
    let work: f64 = products.map(|(load, u)| load.dot(u)).sum();
    let compliance = (1.0 - ROCK.poisson_ratio.powi(2)) / ROCK.young_modulus;
    let left = work - size[0] * size[1] * COMPRESSION.powi(2) * compliance;
    Ok((slip, on_faults, left))
}

fn main() -> Result<(), Box<dyn Error>> {
    let (alone, both) = (compress(&["main"])?, compress(&["main", "splay"])?);
    for (_, on_faults, left) in [&alone, &both] {
        println!("work on the faults {on_faults:.0?} J/m, of the load {left:.0} J/m");
        assert!((on_faults.iter().sum::<f64>() / left - 1.0).abs() < 1e-8);
    }
    println!("the splay takes {:.1} % of it", 100.0 * both.1[1] / both.2);
    let panel = Panel::new("position along x [km]", "slip [m]")
        .with("main fault alone", PALE, 2, alone.0[0].clone())
        .with("main fault", DARK, 3, both.0[0].clone())
        .with("splay", COLORS[2], 3, both.0[1].clone());
    let output = Output::create(Path::new("out/branch"), &[])?;
    plot::draw(&output.path("branch.png"), &[panel])?;
    println!("branch.png in {}", output.folder().display());
    Ok(())
}
