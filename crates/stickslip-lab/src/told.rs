//! Slides and holds of a load history, as text.

/// A number to six digits.
fn six_digits(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let unit = 10_f64.powi(5 - value.abs().log10().floor().clamp(-200.0, 200.0) as i32);
    (value * unit).round() / unit
}

/// The number of slides and holds that are told one by one.
const TOLD: usize = 12;

/// Slides and holds in one line, with their units: the unit of lengths is nothing that data can check.
pub(crate) fn told(load: &[(f64, f64)]) -> String {
    let velocity = |v: f64| {
        if v == 0.0 {
            "hold".into()
        } else {
            format!("{v:.3e} m/s")
        }
    };
    if load.len() <= TOLD {
        let each = load.iter().enumerate().map(|(number, &(time, v))| {
            if number == 0 {
                velocity(v)
            } else {
                format!("{} from {} s", velocity(v), six_digits(time))
            }
        });
        return each.collect::<Vec<_>>().join(", ");
    }
    let slides = || load.iter().map(|slide| slide.1).filter(|v| *v != 0.0);
    let least = slides().fold(f64::INFINITY, f64::min);
    let most = slides().fold(f64::NEG_INFINITY, f64::max);
    let count = slides().count();
    format!(
        "{count} slides at {least:.3e} to {most:.3e} m/s, {} holds",
        load.len() - count
    )
}
