//! Where planes are.

use nalgebra::Vector3;

use crate::KernelError;
use crate::plane::angles::cos_sin;

/// The place of a plane in a [`FaultSystem`](crate::FaultSystem).
///
/// The plane meets the surface along a line through `origin`, its `x` axis, and dips to the right of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// The direction of strike, in degrees clockwise from north.
    pub strike: f64,
    /// The point of the surface at `x = 0`, east and north \[m\].
    pub origin: [f64; 2],
}

impl Placement {
    /// Refuses numbers that are not finite.
    pub(crate) fn check(&self) -> Result<(), KernelError> {
        let [east, north] = self.origin;
        for (what, value) in [
            ("strike [degrees]", self.strike),
            ("origin [m] to the east", east),
            ("origin [m] to the north", north),
        ] {
            if !value.is_finite() {
                return Err(KernelError::new(what, "finite", value));
            }
        }
        Ok(())
    }

    /// Axes to the east, to the north and up.
    pub(crate) fn axes(&self, dip: f64) -> Axes {
        let [cos, sin] = cos_sin(self.strike);
        Axes::new(self.origin, [sin, cos], dip)
    }

    /// As seen from another plane: along its strike, horizontally to the left of it, and up.
    pub(crate) fn axes_from(&self, other: &Self, dip: f64) -> Axes {
        let [cos, sin] = cos_sin(self.strike - other.strike);
        let [north, east] = cos_sin(other.strike);
        let away = [0, 1].map(|c| self.origin[c] - other.origin[c]);
        let origin = [
            away[0] * east + away[1] * north,
            away[1] * east - away[0] * north,
        ];
        Axes::new(origin, [cos, -sin], dip)
    }
}

/// A plane in space: its origin and unit vectors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axes {
    origin: Vector3<f64>,
    pub(crate) strike: Vector3<f64>,
    pub(crate) up_dip: Vector3<f64>,
    /// Into the hanging wall.
    pub(crate) normal: Vector3<f64>,
}

impl Axes {
    fn new([x, y]: [f64; 2], [along, across]: [f64; 2], dip: f64) -> Self {
        let [cos, sin] = cos_sin(dip);
        Self {
            origin: Vector3::new(x, y, 0.0),
            strike: Vector3::new(along, across, 0.0),
            up_dip: Vector3::new(-across * cos, along * cos, sin),
            normal: Vector3::new(across * sin, -along * sin, cos),
        }
    }

    /// A plane of its own: along its strike, horizontally to the left of it, and up.
    pub(crate) fn own(dip: f64) -> Self {
        Self::new([0.0, 0.0], [1.0, 0.0], dip)
    }

    /// The point at a distance along strike and one from the surface down dip.
    pub(crate) fn point(&self, [x, y]: [f64; 2]) -> Vector3<f64> {
        self.origin + self.strike * x - self.up_dip * y
    }

    /// The distances along strike, from the surface down dip, and from the plane of a point.
    pub(crate) fn coordinates(&self, point: &Vector3<f64>) -> [f64; 3] {
        let from = point - self.origin;
        [
            from.dot(&self.strike),
            -from.dot(&self.up_dip),
            from.dot(&self.normal),
        ]
    }
}
