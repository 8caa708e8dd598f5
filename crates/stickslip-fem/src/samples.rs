//! Interpolation of values from sample points.

use nalgebra::SVector;

use crate::FemError;
use crate::numbering::bounding_box;
use crate::points::Points;

/// Values at points, from measurements or a table, for parameters of a contact or a material that vary with position.
///
/// [`Samples::nearest`] takes the value of the nearest sample, for any set of points. [`Samples::linear`] interpolates
/// between samples on a grid or a line. With the feature `csv`, `Samples::read` reads them from a file. D is the
/// dimension of the positions, 1 for a profile along depth.
///
/// ```
/// use nalgebra::Vector2;
/// use stickslip_fem::{P1, Samples};
///
/// // a - b along a fault: it weakens in the middle.
/// let points = [0.0, 2.0, 3.0, 5.0].map(|x| Vector2::new(x, 0.0));
/// let samples = Samples::new(&points, &[0.004, -0.004, -0.004, 0.004])?;
/// let space = P1::grid([5.0, 1.0], [5, 1])?;
/// let fault = space.trace(|x| x[1] == 0.0)?;
/// assert_eq!(fault.map(|x| samples.nearest(x)), [0.004, 0.004, -0.004, -0.004, -0.004, 0.004]);
/// let linear = samples.linear()?;
/// assert_eq!(fault.map(|x| linear.at(x)), [0.004, 0.0, -0.004, -0.004, 0.0, 0.004]);
/// # Ok::<(), stickslip_fem::FemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Samples<const D: usize> {
    /// The points, numbered by their positions in `values`.
    points: Points<D>,
    values: Vec<f64>,
}

impl<const D: usize> Samples<D> {
    /// Values at points \[m\].
    ///
    /// # Errors
    ///
    /// [`FemError::Empty`]; [`FemError::Length`] unless there is one value per point and 32 bits number them;
    /// [`FemError::Point`]; [`FemError::Repeated`] if two samples are at one point.
    pub fn new(points: &[SVector<f64, D>], values: &[f64]) -> Result<Self, FemError> {
        if points.is_empty() {
            return Err(FemError::empty("samples"));
        }
        if points.len() != values.len() || u32::try_from(points.len()).is_err() {
            return Err(FemError::Length {
                what: "values of samples",
                expected: points.len(),
                found: values.len(),
            });
        }
        let finite = |k: &usize| values[*k].is_finite() && points[*k].iter().all(|x| x.is_finite());
        if let Some(sample) = (0..points.len()).find(|k| !finite(k)) {
            return Err(FemError::Point {
                what: "sample",
                index: sample,
                requirement: "finite coordinates and a finite value",
            });
        }
        let numbered = Points::new(points.iter().copied().zip(0..).collect());
        for (sample, x) in points.iter().enumerate() {
            let mut first = sample;
            numbered.inside(x, x, &mut |_, k| first = first.min(k as usize));
            if first < sample {
                return Err(FemError::repeated("samples", [first, sample]));
            }
        }
        Ok(Self {
            points: numbered,
            values: values.to_vec(),
        })
    }

    /// The value of the nearest sample to a position \[m\], the first of several.
    pub fn nearest(&self, position: &SVector<f64, D>) -> f64 {
        self.values[self.points.nearest(position) as usize]
    }

    /// The interpolation between samples on a grid or on a line, see [`Interpolation`].
    ///
    /// # Errors
    ///
    /// [`FemError::Scattered`] if they are on neither: take the nearest, or interpolate to a grid beforehand.
    pub fn linear(&self) -> Result<Interpolation<D>, FemError> {
        let near = self.near();
        let axes = std::array::from_fn(|axis| {
            distinct(self.points.iter().map(|(x, _)| x[axis]).collect(), near)
        });
        let shape = match self.on_grid(&axes) {
            Some(values) => Shape::Grid { axes, values },
            None => self.on_line(near).ok_or_else(|| FemError::Scattered {
                samples: self.values.len(),
                along: axes.iter().map(Vec::len).collect(),
            })?,
        };
        Ok(Interpolation { shape })
    }

    /// Distance up to which coordinates count as one.
    fn near(&self) -> f64 {
        let (low, high) = bounding_box(self.points.iter().map(|(x, _)| x));
        NEAR * (high - low).norm()
    }

    /// The values in the order of the grid, if these coordinates form a full one.
    fn on_grid(&self, axes: &[Vec<f64>; D]) -> Option<Vec<f64>> {
        let count = axes
            .iter()
            .try_fold(1_usize, |n, axis| n.checked_mul(axis.len()))?;
        if count != self.values.len() {
            return None;
        }
        let mut values = vec![None; count];
        for (x, k) in self.points.iter() {
            // The last coordinate that is not above the sample's.
            let place = |axis: usize| axes[axis].partition_point(|&c| c <= x[axis]) - 1;
            let index = (0..D).fold(0, |index, axis| index * axes[axis].len() + place(axis));
            values[index] = Some(self.values[k as usize]);
        }
        values.into_iter().collect()
    }

    /// The samples along the line through the two that are farthest apart along an axis.
    fn on_line(&self, near: f64) -> Option<Shape<D>> {
        let (low, high) = bounding_box(self.points.iter().map(|(x, _)| x));
        let axis = (high - low).imax();
        let along = |a: &SVector<f64, D>, b: &SVector<f64, D>| a[axis].total_cmp(&b[axis]);
        let origin = *self
            .points
            .iter()
            .map(|(x, _)| x)
            .min_by(|a, b| along(a, b))?;
        let end = self
            .points
            .iter()
            .map(|(x, _)| x)
            .max_by(|a, b| along(a, b))?;
        let direction = (end - origin).normalize();
        let mut samples: Vec<(f64, f64)> = Vec::with_capacity(self.values.len());
        for (x, k) in self.points.iter() {
            let position = (x - origin).dot(&direction);
            if (origin + direction * position - x).norm() > near {
                return None;
            }
            samples.push((position, self.values[k as usize]));
        }
        samples.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let (positions, values): (Vec<f64>, Vec<f64>) = samples.into_iter().unzip();
        let apart = positions.windows(2).all(|pair| pair[0] < pair[1]);
        apart.then_some(Shape::Line {
            origin,
            direction,
            positions,
            values,
        })
    }
}

/// Distance over the extent of the samples up to which coordinates count as one.
const NEAR: f64 = 1e-9;

/// The coordinates in increasing order, the first of each group that lies within `near`.
fn distinct(mut coordinates: Vec<f64>, near: f64) -> Vec<f64> {
    coordinates.sort_unstable_by(f64::total_cmp);
    coordinates.dedup_by(|next, kept| *next - *kept <= near);
    coordinates
}

/// The linear interpolation of [`Samples`], a continuous function with their values.
///
/// - On a grid of lines parallel to the axes, with equal or unequal spacing: linear along each axis in turn
///   (bilinear, trilinear). An axis along which all samples have one coordinate does not matter.
/// - On any line: linear between neighbours, at the foot of the perpendicular from a position.
///
/// Outside the samples it is constant: the value at the nearest point of their border.
#[derive(Clone, Debug)]
pub struct Interpolation<const D: usize> {
    shape: Shape<D>,
}

#[derive(Clone, Debug)]
enum Shape<const D: usize> {
    /// The last axis is fastest.
    Grid {
        axes: [Vec<f64>; D],
        values: Vec<f64>,
    },
    Line {
        origin: SVector<f64, D>,
        direction: SVector<f64, D>,
        positions: Vec<f64>,
        values: Vec<f64>,
    },
}

impl<const D: usize> Interpolation<D> {
    /// The value at a position \[m\].
    pub fn at(&self, position: &SVector<f64, D>) -> f64 {
        match &self.shape {
            Shape::Grid { axes, values } => {
                let places: [(usize, f64); D] =
                    std::array::from_fn(|axis| locate(&axes[axis], position[axis]));
                // Over the corners of the brick around it.
                (0..1_usize << D)
                    .map(|corner| {
                        let far = |axis: usize| corner >> axis & 1;
                        let weight: f64 = (0..D)
                            .map(|axis| {
                                if far(axis) == 1 {
                                    places[axis].1
                                } else {
                                    1.0 - places[axis].1
                                }
                            })
                            .product();
                        if weight == 0.0 {
                            // There may be no such corner.
                            return 0.0;
                        }
                        let index = (0..D).fold(0, |index, axis| {
                            index * axes[axis].len() + places[axis].0 + far(axis)
                        });
                        weight * values[index]
                    })
                    .sum()
            }
            Shape::Line {
                origin,
                direction,
                positions,
                values,
            } => {
                let (k, share) = locate(positions, (position - origin).dot(direction));
                if share == 0.0 {
                    values[k]
                } else {
                    (1.0 - share) * values[k] + share * values[k + 1]
                }
            }
        }
    }
}

/// The position of the preceding coordinate, and the fraction of the way to the next one, zero at the last; clamped.
fn locate(coordinates: &[f64], x: f64) -> (usize, f64) {
    let above = coordinates.partition_point(|&c| c <= x);
    if above == 0 || above == coordinates.len() {
        return (above.saturating_sub(1), 0.0);
    }
    let (low, high) = (coordinates[above - 1], coordinates[above]);
    (above - 1, (x - low) / (high - low))
}
