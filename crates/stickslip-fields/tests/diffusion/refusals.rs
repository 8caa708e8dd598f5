//! Wrong inputs, each with its own error.

use stickslip_fields::{
    Boundary, Diffusion, DiffusionError, Dilatancy, Edge, Hydraulics, LeakOff, Line, Network,
    PermeabilityEvolution, Plane, RateHistory, Side,
};

use crate::march::zone;

pub(crate) fn field() -> Diffusion {
    Diffusion::new(Line::uniform([0.0, 40.0], 4).expect("line"), &zone(1e-13)).expect("field")
}

pub(crate) fn plane() -> Diffusion {
    let plane = Plane::new([[0.0, 40.0], [0.0, 30.0]], [4, 3]).expect("plane");
    Diffusion::new(plane, &zone(1e-13)).expect("field")
}

fn edge(cells: [usize; 2], length: f64, distance: f64) -> Result<(), DiffusionError> {
    let distances = [distance; 2];
    Network::new(
        vec![1.0; 2],
        vec![Edge {
            cells,
            length,
            distances,
        }],
    )
    .map(drop)
}

pub(crate) fn made(hydraulics: Hydraulics) -> Result<Diffusion, DiffusionError> {
    Diffusion::new(Line::uniform([0.0, 40.0], 4)?, &hydraulics)
}

fn evolving(change: impl Fn(&mut PermeabilityEvolution)) -> Result<Diffusion, DiffusionError> {
    let mut evolution = PermeabilityEvolution {
        minimum: 1e-15.into(),
        maximum: 1e-12.into(),
        slip_distance: 0.1.into(),
        healing_time: 1e7.into(),
    };
    change(&mut evolution);
    field().with_permeability_evolution(&evolution)
}

fn dilating(change: impl Fn(&mut Dilatancy)) -> Result<Diffusion, DiffusionError> {
    let mut dilatancy = Dilatancy {
        coefficient: 1e-4,
        reference_velocity: 1e-9,
        slip_distance: 1e-2,
        initial_change: 0.0,
    };
    change(&mut dilatancy);
    field().with_dilatancy(dilatancy)
}

pub(crate) fn rate() -> RateHistory {
    RateHistory::constant(1e-6).expect("rate")
}

/// Requires the errors.
pub(crate) fn refused(cases: Vec<(Result<(), DiffusionError>, &str)>) {
    for (result, expected) in cases {
        let error = result.expect_err(expected).to_string();
        assert!(error.contains(expected), "{error:?} without {expected:?}");
    }
}

#[test]
fn cells_and_their_properties() {
    let nan = f64::NAN;
    refused(vec![
        (
            Line::uniform([0.0, 1.0], 0).map(drop),
            "cells of a line: 0 values",
        ),
        (
            Line::uniform([1.0, 1.0], 3).map(drop),
            "edge of a cell [m] of cell 1 must be beyond",
        ),
        (
            Line::between(&[0.0, 2.0, 1.0]).map(drop),
            "edge of a cell [m] of cell 2 must be beyond",
        ),
        (
            Line::trace(&[0.0, nan, 1.0]).map(drop),
            "position of a vertex [m] of cell 1 must be finite",
        ),
        (
            Line::trace(&[0.0, 3.0, 3.0]).map(drop),
            "position of a vertex [m] of cell 2 must be beyond",
        ),
        (
            made(zone(-1.0)).map(drop),
            "permeability [m^2] must be at least 0",
        ),
        (
            made(Hydraulics {
                permeability: vec![1.0, 1.0, nan, 1.0].into(),
                ..zone(1.0)
            })
            .map(drop),
            "permeability [m^2] of cell 2 must be at least 0 and finite, is NaN",
        ),
        (
            made(Hydraulics {
                viscosity: 0.0.into(),
                ..zone(1.0)
            })
            .map(drop),
            "viscosity [Pa s] must be above 0",
        ),
        (
            made(Hydraulics {
                storage: 0.0.into(),
                ..zone(1.0)
            })
            .map(drop),
            "storage beta phi [1/Pa] must be above",
        ),
        (
            made(Hydraulics {
                thickness: (-1.0).into(),
                ..zone(1.0)
            })
            .map(drop),
            "hydraulic thickness [m] must be",
        ),
        (
            made(Hydraulics {
                storage: vec![1.0; 3].into(),
                ..zone(1.0)
            })
            .map(drop),
            "3 values for 4",
        ),
        (
            Plane::new([[0.0, 1.0]; 2], [3, 0]).map(drop),
            "cells of a plane along a side: 0 values",
        ),
        (
            Plane::new([[0.0, 1.0], [1.0, 0.0]], [3, 3]).map(drop),
            "end of a plane [m] must be beyond its begin",
        ),
        (
            Plane::new([[0.0, nan], [1.0, 2.0]], [3, 3]).map(drop),
            "end of a plane [m] must be finite",
        ),
        (
            Network::new(vec![], vec![]).map(drop),
            "cells of a network: 0 values",
        ),
        (
            Network::new(vec![1.0, 0.0], vec![]).map(drop),
            "area [m^2] of cell 1 must be above 0",
        ),
        (
            edge([0, 2], 1.0, 1.0),
            "edge of cell 0 must be between cells that exist, is 2",
        ),
        (
            edge([1, 1], 1.0, 1.0),
            "edge of cell 0 must be between two cells, is 1",
        ),
        (
            edge([0, 1], -1.0, 1.0),
            "length of edge [m] of cell 0 must be at least 0",
        ),
        (
            edge([0, 1], 1.0, 0.0),
            "distance of edge [m] of cell 0 must be above 0",
        ),
        (
            Network::triangles(&[[0.0; 3]; 3], &[[0, 1, 2]]).map(drop),
            "area of triangle [m^2] of cell 0",
        ),
        (
            Network::triangles(&[[0.0; 3]; 3], &[[0, 1, 3]]).map(drop),
            "triangle of cell 0 must be of vertices that exist",
        ),
    ]);
}

#[test]
fn sides_and_couplings() {
    let nan = f64::NAN;
    refused(vec![
        (
            field().with_side(Side::Top, Boundary::Sealed).map(drop),
            "side at the top, but the cells form a line",
        ),
        (
            field()
                .with_side(Side::End, Boundary::Pressure(nan))
                .map(drop),
            "pressure of a side [Pa] must be finite",
        ),
        (
            field().with_side(Side::End, Boundary::Flux(nan)).map(drop),
            "flux of a side [m/s] must be finite",
        ),
        (
            evolving(|of| of.maximum = 1e-16.into()).map(drop),
            "greatest permeability [m^2] of cell 0 must be at least",
        ),
        (
            evolving(|of| of.minimum = 2e-13.into()).map(drop),
            "initial permeability [m^2] of cell 0 must be from",
        ),
        (
            evolving(|of| of.slip_distance = 0.0.into()).map(drop),
            "slip distance of permeability [m] must be above 0",
        ),
        (
            evolving(|of| of.healing_time = nan.into()).map(drop),
            "healing time of permeability [s] must be above 0",
        ),
        (
            dilating(|of| of.coefficient = -1.0).map(drop),
            "dilatancy coefficient must be at least 0",
        ),
        (
            dilating(|of| of.reference_velocity = 0.0).map(drop),
            "reference velocity of dilatancy [m/s] must be above",
        ),
        (
            dilating(|of| of.slip_distance = 0.0).map(drop),
            "slip distance of dilatancy [m] must be above 0",
        ),
        (
            field()
                .with_leak_off(&LeakOff {
                    drainage_time: 0.0.into(),
                    far_pressure: 0.0.into(),
                })
                .map(drop),
            "drainage time [s] must be above 0",
        ),
        (
            field().with_fourth_order().map(drop),
            "flow at fourth order, but the cells form a line: give a plane",
        ),
        (
            field().with_open_face(1.0, [1.0, 0.0], 0.0).map(drop),
            "distance of an open face [m] must be above 0",
        ),
        (
            field().with_open_face(50.0, [1.0, 1.0], 0.0).map(drop),
            "open face at [50.0] lies outside",
        ),
        (
            field().with_initial_pressure(nan).map(drop),
            "initial pressure [Pa] must be finite",
        ),
        (
            field().starting_at(nan).map(drop),
            "start time [s] must be finite",
        ),
        (
            field().with_vertices(&[0, 4]).map(drop),
            "cell of a vertex of cell 1 must be below",
        ),
        (
            field().with_vertices(&[2, 2]).map(drop),
            "cell of a vertex of cell 1 must be a cell of no other",
        ),
    ]);
}
