//! The run of a rupture in space.

use std::ops::ControlFlow;
use std::time::Instant;

use stickslip::fem::{
    Elastic, Impedance, Trace, dashpot, element_stiffness, lumped_mass, traction,
};
use stickslip::nalgebra::Vector3;
use stickslip::record::VtkSeries;
use stickslip::{
    BoundaryPart, CentralDifferences, Components, Diagonal, ElementOperator, Scene, Simulation,
    Snapshot, Steps,
};

use super::Arguments;
use super::problem::{Prestress, ROCK};
use super::record::Record;
use super::report::{Outcome, report};
use super::rock::{Rock, longest_edge};
use crate::cli::Problem;
use crate::progress::Progress;
use crate::rupture::growth;

/// The edges of cells in the length over which friction weakens that resolve it (S. Day et al., J. Geophys. Res. 110 (2005)).
const RESOLVED: f64 = 3.0;

/// A dynamic rupture in space.
///
/// # Errors
/// In one line: a wrong setting, a failed step, a file that cannot be read or written.
pub fn run(arguments: &Arguments) -> Result<(), Problem> {
    let problem = arguments.problem;
    let rock = Rock::new(arguments)?;
    let fault = rock.fault(problem)?;
    let (edge, length) = (longest_edge(&fault), problem.weakening_length());
    if edge > length / RESOLVED {
        note!(
            "warning: edges of {edge:.0} m do not resolve the {length:.0} m over which friction weakens at the front: take cells of {:.0} m or less",
            length / RESOLVED
        );
    }
    let place = |x: &Vector3<f64>| rock.place(x.as_slice());
    let prestress = Prestress::new(problem, (&rock.space, &fault), place)?;
    let scene = scene(arguments, &rock, (&fault, edge), &prestress)?;
    let mut rupture = Simulation::new(scene, CentralDifferences, Diagonal::new())?;
    // A step that is too large tells the limit, and leaves everything as it is.
    let _ = rupture.step(f64::MAX);
    let limit = rupture
        .step_limit()
        .ok_or("central differences have no step limit")?;
    let dt = arguments.until / (arguments.until / (0.9 * limit)).ceil();
    let tags = arguments.tags();
    let mut record = match arguments.checkpoints.restarted(&tags) {
        Some(file) => file.restore::<Record, 3>(&mut rupture)?,
        None => Record::new(arguments, &rock, &prestress, &rupture.snapshot())?,
    };
    let mut series = match arguments.vtu_every {
        0 => None,
        every => {
            let folder = arguments.files.folder("rupture3d");
            std::fs::create_dir_all(&folder)?;
            let start = rupture.snapshot();
            let series = VtkSeries::new(&start, &rock.space, folder.join("rupture3d"))?;
            Some(series.with_contact(&start, 0, &fault)?.every(every)?)
        }
    };
    let whole = Steps::constant(dt).until(arguments.until);
    take(arguments, &mut rupture, &whole, &mut record, |at| {
        series
            .as_mut()
            .map_or(ControlFlow::Continue(()), |series| series.record(at))
    })?;
    if let Some(series) = series {
        series.finish()?;
    }
    let outcome = Outcome {
        record,
        fault: &fault,
        rock: &rock,
        edge,
        dt,
    };
    report(arguments, &outcome)
}

/// Takes the steps of a plan, or what is left of them, and keeps checkpoints.
fn take(
    arguments: &Arguments,
    rupture: &mut Simulation<3>,
    whole: &Steps,
    record: &mut Record,
    mut observe: impl FnMut(&Snapshot<'_, 3>) -> ControlFlow<()>,
) -> Result<(), Problem> {
    let (mut progress, clock) = (Progress::default(), Instant::now());
    let kept = arguments.checkpoints.kept(&arguments.tags());
    let (every, earlier) = (arguments.checkpoints.every(), record.seconds);
    let mut saved = Ok(());
    rupture.run(whole, |at| {
        record.see(&at);
        record.seconds = earlier + clock.elapsed().as_secs_f64();
        progress.at(at.time, arguments.until, at.max_slip_rate());
        if let (Some(file), true) = (&kept, record.steps().is_multiple_of(every)) {
            saved = file.save(&at, record);
            if saved.is_err() {
                return ControlFlow::Break(());
            }
        }
        observe(&at)
    })?;
    saved?;
    if let Some(file) = &kept {
        file.save(&rupture.snapshot(), record)?;
    }
    Ok(())
}

fn scene(
    arguments: &Arguments,
    rock: &Rock,
    (fault, edge): (&Trace<3>, f64),
    prestress: &Prestress,
) -> Result<Scene<ElementOperator<3>, 3>, Problem> {
    let (problem, space) = (arguments.problem, &rock.space);
    let place = |x: &Vector3<f64>| rock.place(x.as_slice());
    let [density, c_p, c_s] = ROCK;
    let elastic = Elastic::of_waves(density, c_p, c_s)?;
    let impedance = Impedance::of(&elastic, density)?;
    let pull = traction(space, fault, |x| {
        Vector3::new(problem.nucleation(place(x)), 0.0, 0.0)
    })?;
    let mass = lumped_mass::<3, 3>(space, density)?;
    let mut stiffness = element_stiffness(space, &elastic)?;
    if arguments.levels > 1 {
        let levels = usize::from(arguments.levels);
        stiffness = stiffness.with_local_steps(space, &mass, fault.vertices(), levels)?;
        note!(
            "cells that act every 1, 2, 4, .. steps: {:?}",
            stiffness.cells_of_levels()
        );
    }
    let viscosity = &stiffness * (arguments.damping() * edge / c_p);
    let mut scene = Scene::new(stiffness)
        .with_mass(mass)
        .with_viscosity(dashpot(space, &rock.absorbing()?, |_| impedance)?)
        .with_load(prestress.balance.clone())
        .with_scaled_load(pull, growth)
        .with_velocity(vec![
            Vector3::new(problem.initial_rate(), 0.0, 0.0);
            space.vertex_count()
        ]);
    if arguments.damping() > 0.0 {
        scene = scene.with_viscosity(viscosity);
    }
    if rock.is_larger_than(problem) {
        // Beyond the fault the rock is whole: what both halves move by is equal, and opposite.
        let whole = BoundaryPart::vertices_where(space, |x| x[1] == 0.0 && !rock.slips(problem, x));
        scene = scene.fix(whole, Components::X | Components::Z);
    }
    if rock.even {
        // The body on the other side moves as this one turned about the normal of the fault.
        scene = scene.fix(
            &space.trace(|x| x[0] == 0.0)?,
            Components::Y | Components::Z,
        );
    }
    if problem.is_below_its_image() {
        scene = scene.fix(&space.trace(|x| x[2] == 0.0)?, Components::Z);
    }
    Ok(problem.on(scene, fault, place, prestress)?)
}
