//! Friction that weakens and has no state is counted at the vertices of all processes.

use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane, mass};
use stickslip::friction::FrictionLaw;
use stickslip::{Components, Condensed, Contact, Newmark, Scene, Simulation};
use stickslip_petsc::{DistributedSpace, PetscGradients, PetscTnnmg, run};

use super::{alone, in_processes};

const SHEAR_MODULUS: f64 = 3e9;
const DENSITY: f64 = 3e3;
const PRESSURE: f64 = 1e6;
/// More than friction holds: the contact slips from the first step on.
const SHEAR_STRESS: f64 = 0.7e6;
/// So small that the mass makes each step convex.
const STEP: f64 = 1e-6;
const STEPS: usize = 3;

/// `mu = 0.6 - 0.1 V/(V + 1 mm/s)`.
#[derive(Debug, Clone, Copy)]
struct Weakening;

impl FrictionLaw for Weakening {
    type State = ();

    fn coefficient(&self, slip_rate: f64, (): ()) -> f64 {
        0.6 - 0.1 * slip_rate / (slip_rate + 1e-3)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, (): ()) -> f64 {
        -0.1 * 1e-3 / (slip_rate + 1e-3).powi(2)
    }

    fn potential(&self, slip_rate: f64, (): ()) -> f64 {
        0.5 * slip_rate + 0.1 * 1e-3 * (slip_rate / 1e-3).ln_1p()
    }
}

/// The part of this test program that runs in each of several processes.
#[test]
#[ignore = "started by `weakening_is_counted_in_all_processes`"]
fn count_in_this_process() {
    run(|world| -> Result<(), Box<dyn std::error::Error>> {
        let coarse = Mesh::<2>::grid([4.0, 1.0], [4, 1], GridDiagonal::Rising)?;
        let space = DistributedSpace::new(world, coarse, 2)?;
        let local = space.local();
        let contact = Contact::new(&space.part(|x| x[1] == 0.0)?, Weakening, PRESSURE)
            .with_shear_stress(stickslip::nalgebra::Vector1::new(SHEAR_STRESS));
        let scene = Scene::new(space.matrix(&antiplane(local, SHEAR_MODULUS)?)?)
            .with_mass(space.matrix(&mass(local, DENSITY)?)?)
            .with_contact(contact.unchecked())
            .prescribe_velocity(&space.part(|x| x[1] == 1.0)?, Components::ALL, |_| [1e-3])
            .in_equilibrium(PetscGradients::new(&space));
        let mut layer = Simulation::new(scene, Newmark::default(), PetscTnnmg::new(&space))?;
        for _ in 0..STEPS {
            let weakening = layer.step(STEP)?.weakening_nodes;
            println!("count {weakening} of {}", world.size());
        }
        Ok(())
    });
}

#[test]
fn weakening_is_counted_in_all_processes() {
    let coarse = P1::grid([4.0, 1.0], [4, 1]).expect("a grid");
    let space = coarse.refined(2).expect("a mesh");
    let trace = |y: f64| space.trace(|x| x[1] == y).expect("a part");
    let scene = Scene::new(antiplane(&space, SHEAR_MODULUS).expect("a stiffness"))
        .with_mass(mass(&space, DENSITY).expect("a mass"))
        .with_contact(
            Contact::new(&trace(0.0), Weakening, PRESSURE)
                .with_shear_stress(stickslip::nalgebra::Vector1::new(SHEAR_STRESS))
                .unchecked(),
        )
        .prescribe_velocity(&trace(1.0), Components::ALL, |_| [1e-3]);
    let mut layer = Simulation::new(scene, Newmark::default(), Condensed::new()).expect("a layer");
    let mut count = || layer.step(STEP).expect("a step").weakening_nodes;
    let serial: Vec<usize> = (0..STEPS).map(|_| count()).collect();
    assert_eq!(serial, [17; STEPS]);
    for processes in [1, 3] {
        let _alone = alone();
        let program = std::env::current_exe().expect("the test has a path");
        let arguments = [
            "--ignored",
            "--nocapture",
            "--exact",
            "weakening::count_in_this_process",
        ];
        let ended = in_processes(120, &program, processes, &arguments).output();
        let ended = ended.expect("mpirun starts");
        assert!(ended.status.success(), "{ended:?}");
        let said = String::from_utf8_lossy(&ended.stdout);
        let counts = said.matches(&format!("count 17 of {processes}")).count();
        assert_eq!(counts, STEPS * processes, "{said}");
    }
}
