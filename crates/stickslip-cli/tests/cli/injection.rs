//! Fluid injection: tables of wells, pressures and fronts.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use stickslip_cli::commands;

use crate::{Outcome, folder};

/// The summary of a command with its folder.
fn summary(line: &str, out: &Path) -> Outcome<Value> {
    let words = line.split_whitespace().map(Into::into);
    let out_words = ["--out".into(), out.into()];
    commands::answer(words.chain(out_words)).map_err(|refusal| refusal.message)?;
    Ok(serde_json::from_slice(&fs::read(
        out.join("summary.json"),
    )?)?)
}

fn number(summary: &Value, key: &str) -> Outcome<f64> {
    Ok(summary[key].as_f64().ok_or(key)?)
}

fn refusal(line: &str) -> Outcome<String> {
    let out = folder("injection-refused")?;
    let words = line.split_whitespace().map(Into::into);
    let out_words = ["--out".into(), out.into()];
    let Err(refusal) = commands::answer(words.chain(out_words)) else {
        return Err(format!("accepted: {line}").into());
    };
    Ok(refusal.message)
}

fn table(name: &str, text: &str) -> Outcome<PathBuf> {
    let path = folder(name)?.join("wells.csv");
    fs::write(&path, text)?;
    Ok(path)
}

/// Two wells, one with a ramp and a jump: their volume is in the fault. By constant rates the ramp is a step.
#[test]
fn rates_of_a_table_are_injected() -> Outcome {
    let text = "x,time,rate\n-100,0,0\n-100,10000,4e-6\n-100,40000,4e-6\n-100,40000,0\n\
                200,20000,1e-6\n200,50000,1e-6\n200,50000,-1e-6\n";
    let path = table("injection-wells", text)?;
    let out = folder("injection-volume")?;
    let line = format!("injection --line --end 80000 --wells {}", path.display());
    let linear = summary(&line, &out)?;
    let expected = 0.5 * 4e-6 * 1e4 + 4e-6 * 3e4 + 1e-6 * 3e4 - 1e-6 * 3e4;
    let found = number(&linear, "injected_volume")?;
    assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
    assert_eq!(
        linear["wells"],
        serde_json::json!([[-100.0, 0.0], [200.0, 0.0]])
    );
    // The pressure of cells, with their storage, is the volume.
    let cells = fs::read_to_string(out.join("cells.csv"))?;
    let mut rows = cells.lines();
    let names: Vec<&str> = rows.next().ok_or("no names")?.split(',').collect();
    let column = names
        .iter()
        .position(|name| *name == "pore_pressure")
        .ok_or("no pressure")?;
    let pressures =
        rows.map(|row| Ok(row.split(',').nth(column).ok_or("short")?.parse::<f64>()?));
    let stored: Outcome<f64> = pressures.sum::<Outcome<f64>>().map(|sum| sum * 10.0 * 1e-9);
    assert!((stored? / expected - 1.0).abs() < 1e-8);
    let constant = summary(&format!("{line} --rates constant"), &out)?;
    let found = number(&constant, "injected_volume")?;
    let expected = 4e-6 * 3e4;
    assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
    for picture in ["fronts", "pressure", "slip", "stations"] {
        for kind in ["png", "svg"] {
            assert!(out.join(format!("{picture}.{kind}")).metadata()?.len() > 1000);
        }
    }
    Ok(())
}

#[test]
fn a_wrong_table_is_one_line() -> Outcome {
    for (text, line, expected) in [
        (
            "time,rate\n0,1e-6\n5,2e-6\n3,0\n",
            "",
            "wells.csv, line 4: time 3 s is before 5 s",
        ),
        ("time,rate\n0,1e-6\n5,fast\n", "", "line 3, cell 2"),
        (
            "time,rate\n0,1e-6\n5,2e-6,1\n6,1e-6\n7,0\n",
            "",
            "line 3, cell 3",
        ),
        ("time,rate\n0,1e-6\n5,\n", "", "empty cell"),
        ("hours,rate\n0,1e-6\n5,1\n", "", "no column `time`"),
        ("x,y,time,rate\n0,0,0,1e-6\n", "--line", "leave out --line"),
        ("x,y,time,rate\n0,9e3,0,1e-6\n", "", "9000"),
    ] {
        let path = table("injection-wrong", text)?;
        let message = refusal(&format!("injection {line} --wells {}", path.display()))?;
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(expected), "{message}");
    }
    Ok(())
}

/// Constant friction on a line: the front of slip at `lambda sqrt(4 alpha t)`, `lambda` for the pressure at the source.
#[test]
fn a_front_under_constant_friction_is_that_of_the_closed_form() -> Outcome {
    let (alpha, end, storage): (f64, f64, f64) = (0.05, 1e5, 1e-9);
    // T = .4 at the end.
    let rate = 8e-6;
    let source = rate / storage * (end / (std::f64::consts::PI * alpha)).sqrt();
    let shear = 0.6 * (25e6 - 0.4 * source);
    let out = folder("injection-front")?;
    let line = format!(
        "injection --line --constant-friction 0.6 --shear-stress {shear} --rate {rate} --end {end} \
         --cell 4 --length 1204 --steps 50 --slip-share 1e-3"
    );
    let found = number(&summary(&line, &out)?, "slip_front")?;
    let exact = 0.786_840_42 * (4.0 * alpha * end).sqrt();
    // To a cell.
    assert!((found - exact).abs() < 4.0, "{found} {exact}");
    Ok(())
}

/// The pressure by diffusion and in closed form drive the same slip.
#[test]
fn bp6_slips_as_much_with_either_pressure() -> Outcome {
    let out = folder("bp6-pressures")?;
    let by = |pressure: &str| {
        let line = "earthquakes --problem bp6 --cell 100 --years 0.3 --pressure";
        summary(&format!("{line} {pressure}"), &out)
    };
    let [solver, exact] = [by("solver")?, by("closed-form")?];
    assert!(number(&exact, "largest_pressure_error")? < 1e-3);
    assert!(number(&solver, "largest_pressure_error")? < 1e-2 * 6.555e6);
    for station in 0..4 {
        for day in ["50", "75", "100"] {
            let [a, b] =
                [&solver, &exact].map(|own| own["stations"][station]["slip"][day].as_f64());
            let (a, b) = (a.ok_or(day)?, b.ok_or(day)?);
            assert!((a / b - 1.0).abs() < 0.02, "{station} {day}: {a} {b}");
        }
    }
    Ok(())
}

/// The pressure of a well passes the normal stress: the run says for how many cells friction keeps a floor, or opens.
#[test]
fn bp8_has_a_floor_for_its_well() -> Outcome {
    let out = folder("bp8-well")?;
    for way in ["--least-normal-stress 1e5", "--allow-opening"] {
        let line = "earthquakes --problem bp8 --cell 32 --source well --components 1";
        let found = summary(&format!("{line} {way}"), &out)?;
        assert_eq!(found["problem"], "BP8-QD-PW");
        assert!(
            number(&found, "most_cells_at_least_normal_stress")? >= 1.0,
            "{way}"
        );
        assert!(number(&found, "peak_pore_pressure")? > 25e6, "{way}");
    }
    Ok(())
}
