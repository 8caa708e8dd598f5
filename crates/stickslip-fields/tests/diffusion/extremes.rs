//! Extreme steps and rates.

use proptest::prelude::*;
use stickslip_fields::{
    Boundary, Cells, Diffusion, DiffusionError, Dilatancy, Edge, FaultField, FaultRates, LeakOff,
    Line, Network, PermeabilityEvolution, Place, Plane, RateHistory, Side, Well,
};

use crate::march::zone;

/// 40 cells of a kind, with all that a field may have.
fn full(kind: usize, pressure: f64, leaky: bool) -> Result<Diffusion, DiffusionError> {
    let evolution = PermeabilityEvolution {
        minimum: 0.0.into(),
        maximum: 1e-11.into(),
        slip_distance: 1e-3.into(),
        healing_time: 1e7.into(),
    };
    let dilatancy = Dilatancy {
        coefficient: 1e-4,
        reference_velocity: 1e-6,
        slip_distance: 1e-2,
        initial_change: 1e-4,
    };
    let cells: Cells = match kind {
        0 => Line::uniform([0.0, 1e3], 40)?.into(),
        1 | 2 => Plane::new([[0.0, 80.0], [0.0, 50.0]], [8, 5])?.into(),
        _ => {
            let edge = |cell| Edge {
                cells: [cell, cell + 1],
                length: 3.0,
                distances: [2.0; 2],
            };
            Network::new(vec![12.0; 40], (0..39).map(edge).collect())?.into()
        }
    };
    let well = Well::new(Place::Cell(3), RateHistory::constant(1e-6)?);
    let mut field = Diffusion::new(cells, &zone(1e-13))?
        .with_permeability_evolution(&evolution)?
        .with_dilatancy(dilatancy)?
        .with_well(well.with_bore_of_index(1e-8, 1e-10))?;
    field = match kind {
        3 => field.with_open_face(Place::Cell(39), [1.0, 1.0], pressure)?,
        _ => field.with_side(Side::End, Boundary::Pressure(pressure))?,
    };
    if kind == 2 {
        field = field.with_fourth_order()?;
    }
    if leaky {
        let leak = LeakOff {
            drainage_time: 1e-3.into(),
            far_pressure: 1e5.into(),
        };
        field = field.with_leak_off(&leak)?;
    }
    Ok(field)
}

proptest! {
    /// Slip at a part of the fault.
    #[test]
    fn everything_is_finite(
        speed in -30.0..2.0_f64,
        step in -9.0..15.5_f64,
        pressure in -1e8..1e8_f64,
        leaky in any::<bool>(),
        kind in 0..4_usize,
    ) {
        let (v, dt) = (10.0_f64.powf(speed), 10.0_f64.powf(step));
        let field = full(kind, pressure, leaky).expect("field");
        let sizes = field.sizes();
        let (mut memory, mut to) = (sizes.memory.clone(), sizes.memory);
        let mut source = vec![0.0; sizes.sources];
        let slip_rate: Vec<f64> = (0..40).map(|cell| if cell % 8 < 3 { v } else { 0.0 }).collect();
        let zero = [0.0; 40];
        for _ in 0..3 {
            let at = FaultRates {
                time: 0.0,
                slip_rate: &slip_rate,
                friction: &zero,
                state_rate: &zero,
                normal_stress: &zero,
            };
            // The porosity stays at its start: an explicit step of it would be too long.
            field.source(&at, &field.sizes().memory, &mut source);
            field.advance(&memory, [&source, &source], dt, &mut to).expect("advances");
            prop_assert!(to.iter().all(|value| value.is_finite()));
            let mut error = vec![0.0; 40];
            field.error(&memory, [&source, &source], dt, &to, &mut error);
            prop_assert!(error.iter().all(|value| value.is_finite()));
            std::mem::swap(&mut memory, &mut to);
        }
    }

    /// Without sources the greatest pressure does not grow beyond what the trapezoidal part allows, and a long step ends
    /// at the mean.
    #[test]
    fn long_steps_relax(values in prop::collection::vec(-1e7..1e7_f64, 30), step in 12.0..15.5_f64) {
        let line = Line::uniform([0.0, 300.0], 30).expect("line");
        let field = Diffusion::new(line, &zone(1e-13)).expect("field");
        let field = field.with_initial_pressure(values.clone()).expect("pressure");
        let memory = field.sizes().memory;
        let mut to = memory.clone();
        field.advance(&memory, [&[], &[]], 10.0_f64.powf(step), &mut to).expect("advances");
        let mut pressure = vec![0.0; 30];
        field.pressure(&to, &mut pressure);
        let mean = values.iter().sum::<f64>() / 30.0;
        for pressure in pressure {
            prop_assert!((pressure - mean).abs() < 10.0, "{pressure:e} {mean:e}");
        }
    }
}

#[test]
fn a_step_of_no_time_changes_nothing() {
    let line = Line::uniform([0.0, 300.0], 3).expect("line");
    let field = Diffusion::new(line, &zone(1e-13)).expect("field");
    let field = field
        .with_initial_pressure(vec![1.0, 5.0, 2.0])
        .expect("pressure");
    let memory = field.sizes().memory;
    let (mut to, mut error) = (vec![0.0; memory.len()], vec![0.0; 3]);
    field
        .advance(&memory, [&[], &[]], 0.0, &mut to)
        .expect("advances");
    field.error(&memory, [&[], &[]], 0.0, &to, &mut error);
    assert_eq!((to, error), (memory, vec![0.0; 3]));
}

/// Calls in any number of threads have the same bits.
#[test]
fn threads_share_a_field() {
    let field = full(2, 1e5, true).expect("field");
    let sizes = field.sizes();
    let source: Vec<f64> = (0..sizes.sources).map(|i| 1e-6 * (i % 5) as f64).collect();
    let advanced = || {
        [1.0, 1e3, 1e5, 1e3].map(|dt| {
            let mut to = sizes.memory.clone();
            field
                .advance(&sizes.memory, [&source, &source], dt, &mut to)
                .expect("advances");
            to
        })
    };
    let alone = advanced();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(advanced)).collect();
        for thread in threads {
            assert_eq!(thread.join().expect("thread"), alone);
        }
    });
}
