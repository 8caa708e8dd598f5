//! `stickslip rupture`: coarse cells, and what any of them must show.

use std::fs;

use serde_json::Value;

use crate::{Outcome, folder, program};

/// A rupture by strong rate weakening spreads, and leaves the weakened friction of sliding behind.
#[test]
fn strong_weakening_spreads() -> Outcome {
    let folder = folder("rupture-strong")?;
    let line = "--problem tpv103 --cell 500 --growth 0.3 --height 12e3 --until 4";
    let output = program("rupture")
        .args(line.split(' '))
        .arg("--out")
        .arg(&folder)
        .output()?;
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    let summary: Value = serde_json::from_str(&fs::read_to_string(folder.join("summary.json"))?)?;
    let stations = summary["stations"].as_array().ok_or("no stations")?;
    let arrivals: Vec<_> = stations.iter().map(|at| at["arrival"].as_f64()).collect();
    let [Some(first), Some(second), ..] = arrivals[..] else {
        return Err(format!("{arrivals:?}").into());
    };
    assert!(first < second, "{arrivals:?}");
    let table = fs::read_to_string(folder.join("stations.csv"))?;
    // At the middle, where it slides at 1 m/s or more for a while: below f_ss(0.1 m/s) = 0.5246 by far, near f_w = 0.2.
    let rows = table.lines().skip(1).filter_map(|line| {
        let numbers: Vec<f64> = line.split(',').flat_map(str::parse).collect();
        <[f64; 5]>::try_from(numbers).ok()
    });
    let sliding: Vec<_> = rows
        .filter(|row| row[0] == 0.0 && row[2] > 2.0 && row[3] > 1.0)
        .collect();
    assert!(!sliding.is_empty());
    for [_, time, _, _, stress] in sliding {
        assert!(
            (0.15 * 120e6..0.35 * 120e6).contains(&stress),
            "{time}: {stress}"
        );
    }
    Ok(())
}

/// Heat pressurizes the fluid of a fault that slips, less than to its normal stress; friction without it keeps more.
#[test]
fn thermal_pressurization_weakens_further() -> Outcome {
    let folder = folder("rupture-heat")?;
    let line = "--problem tpv105 --cell 500 --growth 0.3 --height 12e3 --until 3";
    let output = program("rupture")
        .args(line.split(' '))
        .arg("--out")
        .arg(&folder)
        .output()?;
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    let summary: Value = serde_json::from_str(&fs::read_to_string(folder.join("summary.json"))?)?;
    let middle = &summary["stations"][0];
    let [pressure, temperature, slip] = [
        middle["peak_pore_pressure"].as_f64(),
        middle["peak_temperature"].as_f64(),
        middle["slip"]["3"].as_f64(),
    ];
    let (pressure, temperature, slip) = (
        pressure.ok_or("no pressure")?,
        temperature.ok_or("no temperature")?,
        slip.ok_or("no slip")?,
    );
    assert!(pressure > 1e6 && pressure < 45e6, "{pressure}");
    // At most all work of friction, at 0.6 of the normal stress, within the Gaussian.
    let adiabatic = 0.6 * 45e6 * slip / (2.7e6 * 0.02 * std::f64::consts::TAU.sqrt());
    assert!(
        temperature > 500.0 && temperature < 483.15 + adiabatic,
        "{temperature} {slip}"
    );
    Ok(())
}

/// In space: a coarse rupture starts with the prestress, and slides at the middle when that of TPV102 does, .575 s by codes with
/// cells of 100 m, at a stress behind the front near theirs, 65 MPa.
#[test]
fn a_rupture_in_space_starts_in_time() -> Outcome {
    let folder = folder("rupture3d")?;
    let line = "--problem tpv102 --cell 1200 --growth 0.4 --margin 6000 --until 3";
    let output = program("rupture3d")
        .args(line.split(' '))
        .arg("--out")
        .arg(&folder)
        .output()?;
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    assert!(told.contains("do not resolve"), "{told}");
    let station = fs::read_to_string(folder.join("faultst000dp075.txt"))?;
    let rows = station.lines().filter(|line| !line.starts_with(['#', 't']));
    let rows = rows.map(|line| line.split(' ').flat_map(str::parse).collect::<Vec<f64>>());
    let rows: Vec<_> = rows.collect();
    assert_eq!((rows[0][0], rows[0][3], rows[0][7]), (0.0, 75.0, -120.0));
    let arrival = rows.iter().find(|row| row[2] > 1e-3).ok_or("no arrival")?;
    assert!((arrival[0] - 0.575).abs() < 0.07, "{}", arrival[0]);
    let last = rows.last().ok_or("no row")?;
    assert!(last[1] > 2.0 && (60.0..70.0).contains(&last[3]), "{last:?}");
    let moment = fs::read_to_string(folder.join("moment.csv"))?;
    let moments = moment
        .lines()
        .skip(1)
        .flat_map(|line| line.split(',').nth(1));
    let moments: Vec<f64> = moments.flat_map(str::parse).collect();
    assert!(moments.is_sorted() && moments.last() > Some(&1e17));
    Ok(())
}

/// The summary of a rupture in the plane, the rows of `stations.csv`, and what it said of its cells.
fn rupture(name: &str, line: &str) -> Outcome<(Value, Vec<Vec<f64>>, String)> {
    let folder = folder(name)?;
    let output = program("rupture")
        .args(line.split(' '))
        .arg("--out")
        .arg(&folder)
        .output()?;
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    let summary = serde_json::from_str(&fs::read_to_string(folder.join("summary.json"))?)?;
    let table = fs::read_to_string(folder.join("stations.csv"))?;
    let rows = table.lines().skip(1);
    let rows = rows.map(|line| line.split(',').flat_map(str::parse).collect());
    Ok((summary, rows.collect(), told))
}

/// Slip weakening in the plane: stations begin with the initial stress, the front is as fast to both sides until it meets the
/// patches, earlier in that of more stress. No stress exceeds the static strength, and fast slip beyond D_c is at dynamic friction.
#[test]
fn patches_of_stress_time_a_front() -> Outcome {
    let line = "--problem tpv205 --cell 500 --growth 0.3 --height 12e3 --until 5";
    let (summary, rows, told) = rupture("rupture-tpv205", line)?;
    assert!(told.contains("cohesive zone of 828 m"), "{told}");
    let first = |x: f64| rows.iter().find(|row| row[0] == x).map(|row| row[4]);
    let stresses = [(-7.5e3, 78e6), (-4.5e3, 70e6), (0.0, 81.6e6), (7.5e3, 62e6)];
    for (x, stress) in stresses {
        assert_eq!(first(x), Some(stress), "{x}");
    }
    let stations = summary["stations"].as_array().ok_or("no stations")?;
    let arrival = |x: f64| {
        let station = stations.iter().find(|station| station["x"] == x);
        station.and_then(|station| station["arrival"].as_f64())
    };
    let [left, right] = [arrival(-4.5e3), arrival(4.5e3)].map(|time| time.unwrap_or(f64::NAN));
    assert!((left / right - 1.0).abs() < 1e-9, "{left}, {right}");
    let [left, right] = [arrival(-7.5e3), arrival(7.5e3)].map(|time| time.unwrap_or(f64::NAN));
    assert!(left < right, "{left}, {right}");
    let mut weakened = 0;
    for row in rows.iter().filter(|row| row[1] > 0.0) {
        let [.., slip, rate, stress] = row[..] else {
            return Err(format!("{row:?}").into());
        };
        assert!(stress < 0.677 * 120e6 * (1.0 + 1e-9), "{row:?}");
        if slip > 0.41 && rate > 0.1 {
            weakened += 1;
            assert!((stress / (0.525 * 120e6) - 1.0).abs() < 1e-6, "{row:?}");
        }
    }
    assert!(weakened > 100);
    Ok(())
}

/// Between two materials slip lowers the normal stress behind the front on the side to which the softer material slips, and
/// raises it on the other (J. Weertman, J. Geophys. Res. 85 (1980)). Friction is that of the stress with a delay.
#[test]
fn two_materials_change_the_normal_stress() -> Outcome {
    let line = "--problem tpv6 --cell 500 --growth 0.3 --height 12e3 --until 4";
    let (summary, rows, _) = rupture("rupture-tpv6", line)?;
    let response = summary["response"].as_str().ok_or("no response")?;
    assert!(
        response.contains("L* = 0.01 m and V* = 1 m/s"),
        "{response}"
    );
    // Columns: position, time, slip, slip rate, shear stress, normal stress, that of the body, opening.
    let behind = |x: f64| {
        let weakened = rows.iter().filter(|row| row[0] == x && row[2] > 0.4);
        let stresses: Vec<f64> = weakened.map(|row| row[6]).collect();
        stresses.iter().sum::<f64>() / stresses.len() as f64
    };
    let [towards, away] = [behind(4.5e3), behind(-4.5e3)];
    assert!(towards < 119e6 && away > 120e6, "{towards}, {away}");
    let mut sliding = 0;
    for row in rows.iter().filter(|row| row[1] > 0.0) {
        assert!(
            row[7] == 0.0 && row[4] < 0.677 * row[5] * (1.0 + 1e-9),
            "{row:?}"
        );
        if row[2] > 0.41 && row[3] > 0.1 {
            sliding += 1;
            assert!((row[4] / (0.525 * row[5]) - 1.0).abs() < 1e-6, "{row:?}");
        }
    }
    assert!(sliding > 100);
    Ok(())
}
