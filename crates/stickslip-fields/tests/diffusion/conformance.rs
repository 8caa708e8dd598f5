//! The contract of fields.

use stickslip_fields::{
    Boundary, Diffusion, Dilatancy, GaussianSource, Hydraulics, LeakOff, Line, Network,
    PermeabilityEvolution, Plane, RateHistory, Side, Well, check_fault_field,
};

use crate::march::zone;

fn evolution() -> PermeabilityEvolution {
    PermeabilityEvolution {
        minimum: 1e-15.into(),
        maximum: 1e-12.into(),
        slip_distance: 0.1.into(),
        healing_time: 1e7.into(),
    }
}

const DILATANCY: Dilatancy = Dilatancy {
    coefficient: 1e-4,
    reference_velocity: 1e-9,
    slip_distance: 1e-2,
    initial_change: 0.0,
};

fn rates() -> RateHistory {
    RateHistory::linear_between(&[(0.0, 1e-7), (1e6, 2e-7), (1e6, 0.0)]).expect("rates")
}

fn line() -> Diffusion {
    Diffusion::new(Line::uniform([0.0, 100.0], 10).expect("line"), &zone(1e-13)).expect("field")
}

fn plane() -> Diffusion {
    let plane = Plane::new([[0.0, 50.0], [0.0, 30.0]], [5, 3]).expect("plane");
    Diffusion::new(plane, &zone(1e-13)).expect("field")
}

fn check(name: &str, field: Diffusion) {
    if let Err(violation) = check_fault_field(&field) {
        panic!("{name}: {violation}");
    }
}

#[test]
fn wells_alone() {
    check("nothing", line());
    check(
        "line",
        line().with_well(Well::new(20.0, rates())).expect("well"),
    );
    let bore = Well::new(20.0, rates()).with_bore_of_index(1e-8, 1e-10);
    check("bore", line().with_well(bore).expect("well"));
    let source = GaussianSource::new([12.0, 12.0], 8.0, rates());
    let field = plane().with_gaussian_source(source).expect("source");
    check("plane", field.clone());
    check("fourth order", field.with_fourth_order().expect("plane"));
    let points = [
        [0.0; 3],
        [10.0, 0.0, 0.0],
        [10.0, 10.0, 5.0],
        [0.0, 10.0, 0.0],
    ];
    let network = Network::triangles(&points, &[[0, 1, 2], [0, 2, 3]]).expect("network");
    check(
        "network",
        Diffusion::new(network, &zone(1e-13)).expect("field"),
    );
}

#[test]
fn sides_and_sealed_cells() {
    let field = line()
        .with_side(Side::Begin, Boundary::Pressure(1e5))
        .expect("side");
    check(
        "sides",
        field
            .with_side(Side::End, Boundary::Flux(1e-9))
            .expect("side"),
    );
    let sealed = Hydraulics {
        permeability: vec![1e-13, 0.0, 1e-13].into(),
        ..zone(0.0)
    };
    check(
        "sealed",
        Diffusion::new(Line::uniform([0.0, 30.0], 3).expect("line"), &sealed).expect("field"),
    );
}

#[test]
fn dilatancy_and_leak_off() {
    let leak = LeakOff {
        drainage_time: 1e4.into(),
        far_pressure: 0.0.into(),
    };
    for (name, field) in [("line", line()), ("plane", plane())] {
        let field = field.with_dilatancy(DILATANCY).expect("dilatancy");
        check(name, field.clone());
        check(name, field.with_leak_off(&leak).expect("leak-off"));
    }
}

#[test]
fn evolving_permeability() {
    for (name, field) in [("line", line()), ("plane", plane())] {
        // At uniform pressure no flow has an error.
        let side = Boundary::Pressure(1e5);
        let field = field.with_side(Side::Begin, side).expect("side");
        let field = field
            .with_permeability_evolution(&evolution())
            .expect("evolution");
        check(name, field.clone());
        let field = field.with_dilatancy(DILATANCY).expect("dilatancy");
        check(name, field);
    }
}
