//! Values with their standard errors, as text.

/// A value and its standard error, with two digits of the latter.
pub(crate) fn rounded(value: f64, error: f64) -> String {
    if !(error.is_finite() && error > 0.0) {
        return format!("{value:.4e} +- {error}");
    }
    let largest = value.abs().max(error);
    let digits = (largest.log10().floor() - error.log10().floor() + 1.0).clamp(0.0, 12.0) as usize;
    let exponent = largest.log10().floor() as i32;
    let mut scale = 10_f64.powi(exponent);
    let mut suffix = format!("e{exponent}");
    if (-3..4).contains(&exponent) {
        scale = 1.0;
        suffix.clear();
    }
    let digits = if scale == 1.0 {
        (digits as i32 - exponent).max(0) as usize
    } else {
        digits
    };
    format!(
        "({:.digits$} +- {:.digits$}){suffix}",
        value / scale,
        error / scale
    )
}
