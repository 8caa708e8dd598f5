//! The local problems of a stage: by the laws of a contact for all of its vertices at once, or vertex by vertex.

use std::ops::Range;

use nalgebra::Vector1;
use proptest::prelude::*;
use stickslip::bie::{Cells, Fault, Medium};
use stickslip::friction::{
    DieterichRuina, FrictionLaw, FrictionViolation, RegularizedDieterichRuina, SlipRates, Tresca,
};
use stickslip::state::{Dieterich, LogTheta, PerrinRiceZheng, Reads, Ruina, StateLaw};
use stickslip::{BoundaryPart, Contact, RungeKutta, Scene, SceneError, Steps};

use crate::Outcome;

const MEDIUM: Medium = Medium {
    shear_modulus: 32.04e9,
    shear_wave_speed: 3464.0,
};
const CELLS: usize = 128;
const LAW: RegularizedDieterichRuina = RegularizedDieterichRuina {
    a: 0.010,
    b: 0.015,
    reference_friction: 0.6,
    reference_velocity: 1e-6,
    slip_distance: 8e-3,
};

/// Some of the cells of a fault.
fn some(part: &BoundaryPart, at: Range<usize>) -> BoundaryPart {
    BoundaryPart {
        vertices: part.vertices[at.clone()].to_vec(),
        weights: part.weights[at.clone()].to_vec(),
        points: part.points[at.clone()].to_vec(),
        normals: part.normals.get(at).unwrap_or_default().to_vec(),
        ..part.clone()
    }
}

/// Normal stress, cohesion and shear stress of a cell \[Pa\].
type Stresses = [f64; 3];

/// Slip rate and slip of each cell at a time, with one contact of all cells or several: fewer cells than a block are
/// balanced one by one.
fn after<L, S>(
    (contacts, end): (usize, f64),
    stresses: &[Stresses],
    with_laws: impl Fn(BoundaryPart, Vec<f64>) -> Contact<L, S, 1>,
) -> Outcome<Vec<[f64; 2]>>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let fault = Fault::half_space(Cells::new([0.0, 20e3], CELLS)?, MEDIUM)?;
    let (part, size) = (BoundaryPart::from(&fault), CELLS / contacts);
    let mut scene = Scene::new(fault.stiffness()).with_viscosity(fault.radiation_damping());
    for n in 0..contacts {
        let at = n * size..(n + 1) * size;
        let own = &stresses[at.clone()];
        let each = |c: usize| own.iter().map(|own| own[c]).collect::<Vec<_>>();
        let contact = with_laws(some(&part, at), each(0))
            .with_cohesion(each(1))
            .with_shear_stress(
                own.iter()
                    .map(|own| Vector1::new(own[2]))
                    .collect::<Vec<_>>(),
            );
        scene = scene.with_contact(contact);
    }
    let mut motion = RungeKutta::new(scene)?;
    if end > 0.0 {
        motion.run(&Steps::adaptive(1e-8).until(end), |_| ())?;
    }
    let at = motion.snapshot();
    let cells = (0..contacts).flat_map(|n| (0..size).map(move |k| (n, k)));
    Ok(cells
        .map(|(n, k)| [at.contact(n).slip_rate(k), at.contact(n).slip(k)])
        .collect())
}

/// Stresses of all cells: some open, some with cohesion, loads of both signs, some beyond friction.
fn stresses() -> impl Strategy<Value = Vec<Stresses>> {
    let normal = prop_oneof![4 => 1e6..5e7, 1 => Just(0.0), 1 => Just(1e-300)];
    let cohesion = prop_oneof![3 => Just(0.0), 1 => 0.0..5e6];
    let one =
        (normal, cohesion, -0.9..0.9).prop_map(|(normal, cohesion, ratio): (f64, f64, f64)| {
            [
                normal,
                cohesion,
                ratio * normal.max(1e5) + cohesion.copysign(ratio),
            ]
        });
    prop::collection::vec(one, CELLS)
}

fn check_both<L, S>(
    (stresses, end): (&[Stresses], f64),
    with_laws: impl Fn(BoundaryPart, Vec<f64>) -> Contact<L, S, 1>,
) -> Result<(), TestCaseError>
where
    L: FrictionLaw + 'static,
    S: StateLaw + 'static,
    L::State: Reads<S::State>,
{
    let of = |contacts| {
        let found = after((contacts, end), stresses, &with_laws);
        found.map_err(|error| TestCaseError::fail(error.to_string()))
    };
    let (all, each) = (of(1)?, of(4)?);
    let most = each.iter().fold(0.0_f64, |most, own| most.max(own[0]));
    for (k, (all, each)) in all.iter().zip(&each).enumerate() {
        // At the start as accurate as local problems are to be; in a run the errors of both grow with the instability of the
        // fault.
        let close = |a: f64, b: f64| {
            let bound = if end > 0.0 {
                1e-5 * (b + most)
            } else {
                2e-9 * b
            };
            (a - b).abs() <= bound
        };
        prop_assert!(
            close(all[0], each[0]) && close(all[1], each[1]),
            "{k}: {all:?} {each:?}"
        );
    }
    Ok(())
}

/// The end of the runs \[s\].
const END: f64 = 5e-3;

const SLIP_DISTANCE: f64 = LAW.slip_distance;

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    /// With laws that bring passes and laws that bring none, with states in another variable and without a state. The arrest
    /// of a vertex is a kink: what cohesion holds, what is open, and Tresca friction are compared at the start of a run alone.
    #[test]
    fn vertices_slide_together_as_one_by_one(stresses in stresses()) {
        let slip_distance = SLIP_DISTANCE;
        let (slip, aging) = (Ruina { slip_distance }, Dieterich { slip_distance });
        let healing = PerrinRiceZheng { slip_distance };
        let steady = LogTheta((slip_distance / 1e-2).ln());
        let cut_off = DieterichRuina {
            a: LAW.a,
            b: LAW.b,
            reference_friction: LAW.reference_friction,
            reference_velocity: LAW.reference_velocity,
            slip_distance,
        };
        let closed: Vec<Stresses> = stresses
            .iter()
            .map(|[normal, _, shear]| [normal.max(1e6), 0.0, shear.clamp(-0.9 * normal.max(1e6), 0.9 * normal.max(1e6))])
            .collect();
        for at in [(&stresses[..], 0.0), (&closed[..], END)] {
            check_both(at, |part, normal| Contact::new(part, LAW, normal).with_state(slip, steady))?;
            check_both(at, |part, normal| Contact::new(part, LAW, normal).with_state(healing, steady))?;
            check_both(at, |part, normal| Contact::new(part, cut_off, normal).with_state(aging, steady))?;
        }
        let tresca = Tresca { coefficient: 0.6 };
        check_both((&stresses, 0.0), |part, normal| Contact::new(part, tresca, normal))?;
    }
}

/// Rate-strengthening friction whose passes are those of a law with another direct effect.
#[derive(Clone, Copy)]
struct WrongPasses(RegularizedDieterichRuina);

impl FrictionLaw for WrongPasses {
    type State = LogTheta;

    fn coefficient(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.coefficient(slip_rate, state)
    }

    fn coefficient_rate_slope(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.coefficient_rate_slope(slip_rate, state)
    }

    fn potential(&self, slip_rate: f64, state: LogTheta) -> f64 {
        self.0.potential(slip_rate, state)
    }

    fn slip_rates(laws: &[Self]) -> Option<Box<dyn SlipRates<LogTheta>>> {
        let laws: Vec<_> = laws
            .iter()
            .map(|own| RegularizedDieterichRuina {
                a: 1.01 * own.0.a,
                ..own.0
            })
            .collect();
        RegularizedDieterichRuina::slip_rates(&laws)
    }
}

#[test]
fn passes_that_are_not_those_of_the_law_are_refused() -> Outcome {
    let fault = Fault::half_space(Cells::new([0.0, 20e3], CELLS)?, MEDIUM)?;
    let aging = Dieterich {
        slip_distance: SLIP_DISTANCE,
    };
    let contact = Contact::new(&fault, WrongPasses(LAW), 50e6).with_state(aging, LogTheta(5.0));
    let scene = Scene::new(fault.stiffness())
        .with_viscosity(fault.radiation_damping())
        .with_contact(contact);
    let refused = RungeKutta::new(scene).err();
    let is_named = matches!(
        refused,
        Some(SceneError::Friction(
            FrictionViolation::SlipRate { .. } | FrictionViolation::Differs { .. }
        ))
    );
    assert!(is_named, "{refused:?}");
    Ok(())
}
