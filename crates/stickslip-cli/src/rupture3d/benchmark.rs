//! The benchmarks: what they are called, how large they are, and where they are recorded.

use clap::ValueEnum;

/// Benchmarks by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Benchmark {
    /// Slip weakening below a free surface, with two patches of other stress
    Tpv5,
    /// Rate and state with the aging law in a whole space
    Tpv101,
    /// The same below a free surface
    Tpv102,
    /// Strong rate weakening by flash heating below a free surface
    Tpv104,
    /// The same with thermal pressurization, under a normal stress that grows with depth
    Tpv105,
}

impl Benchmark {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tpv5 => "TPV5",
            Self::Tpv101 => "TPV101",
            Self::Tpv102 => "TPV102",
            Self::Tpv104 => "TPV104",
            Self::Tpv105 => "TPV105-3D",
        }
    }

    /// The place along strike, and the depth in the body, where the rupture starts \[m\].
    pub fn hypocenter(self) -> [f64; 2] {
        match self {
            Self::Tpv101 => [0.0; 2],
            Self::Tpv5 | Self::Tpv102 | Self::Tpv104 => [0.0, 7.5e3],
            Self::Tpv105 => [-4e3, 7.5e3],
        }
    }

    /// The largest distance along strike and the largest depth in the body that slips; the rock is whole beyond \[m\].
    pub fn extent(self) -> [f64; 2] {
        match self {
            Self::Tpv5 => [15e3, 15e3],
            Self::Tpv101 => [18e3, 10.5e3],
            Self::Tpv102 | Self::Tpv104 => [18e3, 18e3],
            Self::Tpv105 => [22e3, 22e3],
        }
    }

    /// Whether the rupture is the same on both sides of its middle along strike, so that one of them is computed.
    pub fn is_even(self) -> bool {
        !matches!(self, Self::Tpv5 | Self::Tpv105)
    }

    /// Whether the body is one of two that are the same above and below its top.
    pub fn is_below_its_image(self) -> bool {
        self == Self::Tpv101
    }

    /// The relaxation time of viscosity over the time in which a pressure wave crosses the longest edge at the fault. With
    /// 0.1 slip rates hardly oscillate behind the front, and it runs as fast as in codes with such a viscosity; the largest
    /// slip rate of TPV5 would be lower by 8 percent in cells of 300 m.
    pub(super) fn damping(self) -> f64 {
        if self == Self::Tpv5 { 0.0 } else { 0.1 }
    }

    /// Whether heat pressurizes the pore fluid.
    pub fn is_heated(self) -> bool {
        self == Self::Tpv105
    }

    /// Stations on the fault: along strike and depth, in TPV101 from the middle \[m\].
    pub fn stations(self) -> Vec<[f64; 2]> {
        let kilometres: &[[f64; 2]] = match self {
            Self::Tpv5 => &[
                [0.0, 7.5],
                [-2.0, 7.5],
                [2.0, 7.5],
                [-2.0, 5.5],
                [2.0, 5.5],
                [0.0, 0.0],
                [0.0, 3.0],
                [0.0, 12.0],
                [-4.5, 7.5],
                [4.5, 7.5],
                [-7.5, 7.5],
                [7.5, 7.5],
                [-12.0, 7.5],
                [12.0, 7.5],
            ],
            Self::Tpv101 => &[
                [0.0, 0.0],
                [0.0, 3.0],
                [0.0, 6.0],
                [4.5, 0.0],
                [9.0, 0.0],
                [12.0, 0.0],
                [15.0, 0.0],
            ],
            Self::Tpv102 | Self::Tpv104 => &[
                [0.0, 0.0],
                [0.0, 3.0],
                [0.0, 7.5],
                [0.0, 12.0],
                [4.5, 0.0],
                [4.5, 7.5],
                [9.0, 0.0],
                [9.0, 7.5],
                [12.0, 0.0],
                [12.0, 3.0],
                [12.0, 7.5],
                [12.0, 12.0],
                [15.0, 0.0],
                [15.0, 7.5],
                [18.0, 0.0],
                [18.0, 7.5],
            ],
            Self::Tpv105 => &[
                [0.0, 3.0],
                [0.0, 7.5],
                [0.0, 12.0],
                [9.0, 7.5],
                [12.0, 3.0],
                [12.0, 12.0],
                [15.0, 7.5],
                [18.0, 7.5],
                [-9.0, 7.5],
                [-12.0, 3.0],
                [-12.0, 12.0],
                [-15.0, 7.5],
                [-18.0, 7.5],
            ],
        };
        let metres = kilometres.iter();
        metres.map(|place| place.map(|x| 1e3 * x)).collect()
    }
}
