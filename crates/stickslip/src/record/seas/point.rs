//! Positions of stations.

use std::fmt;

/// A position on a fault \[m\].
///
/// A point on a line is a distance along it: the depth on a vertical fault, the distance down dip on a dipping one. On
/// a plane it is `[x2, x3]`, along strike and down dip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SeasPoint {
    /// On a line: faults in two dimensions.
    Line(f64),
    /// On a plane: faults in three dimensions.
    Plane([f64; 2]),
}

impl SeasPoint {
    /// The name of the station file, with the position in multiples of `unit` \[m\], rounded, with at least `digits`
    /// digits.
    ///
    /// | problem | unit, digits | name |
    /// | --- | --- | --- |
    /// | BP1, BP2, BP3 | 100 m, 3 | `fltst_dp075` |
    /// | BP4 | 100 m, 3 | `fltst_strk-225dp+000` |
    /// | BP5 | 1 km, 2 | `fltst_strk-16dp+10` |
    /// | BP7, BP8 | 1 m, 3 | `fltst_strk-050dp+100` |
    ///
    /// ```
    /// use stickslip::record::SeasPoint;
    ///
    /// assert_eq!(SeasPoint::Line(7.5e3).file_name(100.0, 3), "fltst_dp075");
    /// assert_eq!(SeasPoint::Plane([-16e3, 10e3]).file_name(1e3, 2), "fltst_strk-16dp+10");
    /// ```
    pub fn file_name(&self, unit: f64, digits: usize) -> String {
        // Zero has no negative sign.
        let number = |x: f64| (x / unit).round() + 0.0;
        let signed = digits + 1;
        match self {
            Self::Line(x) => format!("fltst_dp{:0digits$}", number(*x)),
            Self::Plane([x, y]) => {
                let [x, y] = [number(*x), number(*y)];
                format!("fltst_strk{x:+0signed$}dp{y:+0signed$}")
            }
        }
    }

    /// The coordinates: one on a line, two on a plane.
    pub(super) fn coordinates(&self) -> &[f64] {
        match self {
            Self::Line(x) => std::slice::from_ref(x),
            Self::Plane(x) => x,
        }
    }
}

impl fmt::Display for SeasPoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(x) => write!(f, "on fault, {} km down dip", x / 1e3),
            Self::Plane([x, y]) => {
                let [x, y] = [x / 1e3, y / 1e3];
                write!(f, "on fault, {x} km along strike, {y} km down dip")
            }
        }
    }
}
