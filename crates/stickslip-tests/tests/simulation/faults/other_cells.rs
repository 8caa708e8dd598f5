//! Kernels, damping, normal stresses and contacts of other cells, and options of faults.

use nalgebra::{DMatrix, SVector};
use stickslip::bie::{
    Cells, DippingFault, Fault, FaultSystem, Medium, Mode, Placement, PlaneFault, Rectangles,
    SegmentFault, Segments, Sense,
};
use stickslip::friction::Tresca;
use stickslip::{
    BoundaryPart, Contact, Matrix, MeshId, MeshMismatch, NormalStressChange, Operator, RungeKutta,
    Scene, SceneError,
};

use crate::Outcome;

const ROCK: Medium = Medium {
    shear_modulus: 30e9,
    shear_wave_speed: 3464.0,
};

/// All that a scene takes of a fault.
struct Parts<K, N> {
    stiffness: K,
    damping: K,
    normal: N,
    contact: BoundaryPart,
    cells: MeshId,
}

/// Parts of two faults do not mix, whichever is of the other one.
fn do_not_mix<K, N, const C: usize>(make: impl Fn(f64) -> Outcome<Parts<K, N>>) -> Outcome
where
    K: Operator<C> + 'static,
    N: NormalStressChange<C> + 'static,
{
    let names = ["", "viscosity matrix", "normal stress change", "contact 1"];
    for (foreign, name) in names.into_iter().enumerate() {
        let of = |part: usize| make(if part == foreign { 2e3 } else { 1e3 });
        let law = Tresca { coefficient: 0.5 };
        let scene = Scene::new(make(1e3)?.stiffness)
            .with_viscosity(of(1)?.damping)
            .with_normal_stress_change(of(2)?.normal, SVector::zeros())
            .with_contact(Contact::new(of(3)?.contact, law, 20e6));
        let error = RungeKutta::new(scene).err();
        let (own, other) = (make(1e3)?.cells, make(2e3)?.cells);
        assert_ne!(own, other);
        let expected = SceneError::from(MeshMismatch::new(name, own, other));
        assert_eq!(error, (foreign > 0).then_some(expected));
    }
    Ok(())
}

/// As many cells, twice as long.
#[test]
fn parts_of_two_faults_do_not_mix() -> Outcome {
    let line = |length: f64| Cells::new([0.0, length], 12);
    let rectangles = |length: f64| {
        Ok::<_, stickslip::bie::KernelError>(Rectangles::new(
            line(length)?,
            Cells::new([0.0, 1e3], 4)?,
        ))
    };
    do_not_mix(|length| {
        let fault = DippingFault::new(line(length)?, ROCK, 0.25, 60.0, Sense::Thrust)?;
        Ok(Parts {
            stiffness: fault.stiffness(),
            damping: fault.radiation_damping(),
            normal: fault.normal_stiffness(),
            contact: (&fault).into(),
            cells: fault.cells().identity(),
        })
    })?;
    do_not_mix(|length| {
        let mode = Mode::InPlane {
            poisson_ratio: 0.25,
        };
        let bent = Segments::down([(60.0, length), (40.0, length)], length / 6.0)?;
        let fault = SegmentFault::half_space(bent, ROCK, mode)?;
        Ok(Parts {
            stiffness: fault.stiffness(),
            damping: fault.radiation_damping(),
            normal: fault.normal_stiffness(),
            contact: (&fault).into(),
            cells: fault.cells().identity(),
        })
    })?;
    do_not_mix(|length| {
        let fault = PlaneFault::half_space(rectangles(length)?, 60.0, ROCK, 0.25)?;
        Ok(Parts {
            stiffness: fault.stiffness(),
            damping: fault.radiation_damping(),
            normal: fault.normal_stiffness(),
            contact: (&fault).into(),
            cells: fault.cells().identity(),
        })
    })?;
    do_not_mix(|length| {
        let plane = PlaneFault::half_space(rectangles(length)?, 60.0, ROCK, 0.25)?;
        let places = [0.0, 9e3].map(|east| Placement {
            strike: 0.0,
            origin: [east, 0.0],
        });
        let system = FaultSystem::new(places.map(|place| (plane.clone(), place)))?;
        Ok(Parts {
            stiffness: system.stiffness(),
            damping: system.radiation_damping(),
            normal: system.normal_stiffness(),
            contact: (&system).into(),
            cells: system.identity(),
        })
    })
}

/// A line of cells is no contact of a plane of as many, and a sum of kernels belongs to their cells.
#[test]
fn a_line_is_no_plane() -> Outcome {
    let plane = Rectangles::new(Cells::new([0.0, 1e3], 4)?, Cells::new([0.0, 1e3], 3)?);
    let plane = PlaneFault::whole_space(plane, ROCK, 0.25)?.with_rake(0.0)?;
    let line = Fault::whole_space(Cells::new([0.0, 1e3], 12)?, ROCK, Mode::Antiplane)?;
    let contact = Contact::new(&line, Tresca { coefficient: 0.5 }, 20e6);
    let scene = Scene::new(plane.stiffness()).with_viscosity(plane.radiation_damping());
    let [own, other] = [plane.cells().identity(), line.cells().identity()];
    let error = RungeKutta::new(scene.with_contact(contact)).err();
    assert_eq!(
        error,
        Some(MeshMismatch::new("contact 1", own, other).into())
    );
    let (a, b) = (line.stiffness(), line.radiation_damping());
    let sum = Operator::<1>::combination(&[(2.0, &a), (1.0, &b)]);
    assert_eq!(Matrix::<1>::mesh(&sum), Some(other));
    Ok(())
}

/// Each option of a fault is in its matrices.
#[test]
fn every_option_of_a_fault_is_used() -> Outcome {
    let cells = Cells::new([0.0, 1e3], 5)?;
    let fault = Fault::half_space(cells, ROCK)?;
    let stiffness = |fault: &Fault| DMatrix::from(&fault.stiffness());
    assert_eq!(
        stiffness(&fault.clone().one_sided()),
        2.0 * stiffness(&fault)
    );
    let whole = Fault::whole_space(cells, ROCK, Mode::Antiplane)?;
    let periodic = Fault::periodic(cells, ROCK, Mode::Antiplane)?;
    assert!(stiffness(&whole) != stiffness(&fault) && stiffness(&whole) != stiffness(&periodic));
    let in_plane = Mode::InPlane {
        poisson_ratio: 0.25,
    };
    let ratio = stiffness(&Fault::whole_space(cells, ROCK, in_plane)?) / stiffness(&whole)[(0, 0)];
    assert!((ratio[(0, 0)] - 1.0 / 0.75).abs() < 1e-12);
    let normal = |dip, sense| {
        let fault = DippingFault::new(cells, ROCK, 0.25, dip, sense)?;
        Ok::<_, stickslip::bie::KernelError>(DMatrix::from(&fault.normal_stiffness()))
    };
    let thrust = normal(60.0, Sense::Thrust)?;
    assert_eq!(normal(60.0, Sense::Normal)?, -&thrust);
    assert!(normal(50.0, Sense::Thrust)? != thrust);

    let cells = Rectangles::new(Cells::new([0.0, 1e3], 4)?, Cells::new([0.0, 1e3], 3)?);
    let plane = || PlaneFault::whole_space(cells, ROCK, 0.25);
    let dense = |plane: &PlaneFault| DMatrix::from(&plane.stiffness());
    let periodic = [
        plane()?,
        plane()?.periodic_along_strike()?,
        plane()?.periodic_down_dip()?,
        plane()?.periodic_along_strike()?.periodic_down_dip()?,
    ];
    for (k, one) in periodic.iter().enumerate() {
        assert!(periodic[..k].iter().all(|other| dense(other) != dense(one)));
    }
    let rake = |degrees| {
        Ok::<_, Box<dyn std::error::Error>>(DMatrix::from(
            &plane()?.with_rake(degrees)?.stiffness(),
        ))
    };
    let (along, up) = (rake(0.0)?, rake(90.0)?);
    assert!(along != up);
    let half = PlaneFault::half_space(cells, 90.0, ROCK, 0.25)?;
    let transformed = half.clone().transformed_down_dip()?;
    let size = dense(&half).amax();
    assert!((dense(&transformed) - dense(&half)).amax() < 1e-9 * size);
    let twice = DMatrix::from(&half.radiation_damping_times(2.0)?);
    assert_eq!(twice, 2.0 * DMatrix::from(&half.radiation_damping()));
    Ok(())
}
