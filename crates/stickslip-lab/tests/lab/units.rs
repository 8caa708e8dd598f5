//! Lengths in a wrong unit.

use stickslip_lab::{Fit, LoadHistory, Record, Warning};

use crate::fits::{AGING, record};
use crate::{Outcome, one_state, times};

/// Lengths in another unit have the same curve, with all lengths in this unit: no data can tell. The velocities of the load
/// point are told, with their unit, and `L` beyond the laboratory's experience is warned of.
#[test]
fn lengths_in_a_wrong_unit_are_warned_of_and_velocities_are_told() -> Outcome {
    let record = record(&one_state(), AGING, 1e-3)?;
    let places = |unit: f64| -> Outcome<Vec<f64>> {
        let load = crate::sequence()?;
        Ok(times()
            .iter()
            .map(|time| unit * load.displacement(*time))
            .collect())
    };
    // Metres, micrometres, millimetres as metres; millimetres as micrometres.
    for (unit, wrong) in [(1.0, false), (1e6, true), (1e3, true), (1e-3, true)] {
        let load = LoadHistory::measured(&times(), &places(unit)?, None, None)?;
        let found = Fit::new(AGING).run(&record, &load)?;
        let warning = found.warnings.iter().find_map(|warning| match *warning {
            Warning::Unit {
                slip_distance,
                velocity,
                ..
            } => Some((slip_distance, velocity)),
            _ => None,
        });
        assert_eq!(warning.is_some(), wrong, "{unit}: {found}");
        if let Some((slip_distance, velocity)) = warning {
            assert_eq!(slip_distance, found.parameters.states[0].slip_distance);
            assert!((velocity / (3e-5 * unit) - 1.0).abs() < 1e-3);
        }
        // Four slides and two holds, and their times.
        let velocities = [1e-6, 1e-5, 3e-6, 3e-5, 0.0, 1e-5, 0.0, 1e-5];
        let starts = [0.0, 50.0, 90.0, 220.0, 235.0, 265.0, 305.0, 605.0];
        assert_eq!(found.load.len(), velocities.len(), "{:?}", found.load);
        for ((time, v), (start, exact)) in found.load.iter().zip(starts.iter().zip(velocities)) {
            assert!((v - unit * exact).abs() <= 1e-3 * unit * exact);
            assert!((time - start).abs() < 1.0);
        }
        let line = found.to_string();
        let line = line.lines().nth(1).unwrap_or_default();
        assert!(
            line.starts_with("load point     ") && line.contains("hold from 235 s"),
            "{line}"
        );
    }
    Ok(())
}

/// A history of many pieces is told in one short line.
#[test]
fn a_long_history_is_told_by_its_range() -> Outcome {
    let changes: Vec<(f64, f64)> = (1..40)
        .map(|n| {
            (
                15.0 * f64::from(n),
                if n % 3 == 0 {
                    0.0
                } else {
                    1e-5 / f64::from(n % 2 + 1)
                },
            )
        })
        .collect();
    let load = LoadHistory::new(1e-6, &changes)?;
    let mu = one_state().curve(AGING, &load, &times())?;
    let found = Fit::new(AGING).run(&Record::new(times(), mu)?, &load)?;
    let text = found.to_string();
    assert!(
        text.contains("slides at 1.000e-6 to 1.000e-5 m/s, 13 holds"),
        "{text}"
    );
    Ok(())
}
