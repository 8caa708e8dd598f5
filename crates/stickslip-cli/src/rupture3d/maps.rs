//! Fields of the fault as a table and as a picture: rupture times, largest slip rates and slip.

use std::path::Path;

use stickslip::fem::Trace;

use super::rock::Rock;
use crate::cli::Problem;
use crate::plot::{self, Colors, PatchSheet, Patches, Points, contours, interval};

/// A field of the fault.
pub(super) struct Field<'a> {
    /// Its name, with the unit.
    pub name: &'a str,
    /// Its values at the vertices.
    pub values: &'a [f64],
}

/// The faces of a fault, in kilometres.
pub(super) struct Part {
    triangles: Vec<[[f64; 2]; 3]>,
    faces: Vec<[usize; 3]>,
}

impl Part {
    /// Those of a fault.
    pub(super) fn new(fault: &Trace<3>, rock: &Rock) -> Self {
        let corner = |k: usize| rock.place(fault.points()[k].as_slice()).map(|x| x / 1e3);
        let faces = fault.faces().to_vec();
        let triangles = faces.iter().map(|face| {
            face.map(|k| {
                let [x, depth] = corner(k);
                [x, -depth]
            })
        });
        Self {
            triangles: triangles.collect(),
            faces,
        }
    }

    /// The rectangle about all faces.
    fn outline(&self) -> Points {
        let corners = || self.triangles.iter().flatten();
        let low = |c: usize| corners().map(|x| x[c]).fold(f64::INFINITY, f64::min);
        let high = |c: usize| corners().map(|x| x[c]).fold(f64::NEG_INFINITY, f64::max);
        let ([left, right], [bottom, top]) = ([low(0), high(0)], [low(1), high(1)]);
        vec![
            (left, bottom),
            (right, bottom),
            (right, top),
            (left, top),
            (left, bottom),
        ]
    }

    /// Draws a field in colours with contours; those of `contoured` if given.
    pub(super) fn draw(
        &self,
        path: &Path,
        field: &Field<'_>,
        contoured: Option<&Field<'_>>,
    ) -> Result<(), Problem> {
        let means = self.faces.iter().map(|face| {
            let sum: f64 = face.iter().map(|&k| field.values[k]).sum();
            sum / 3.0
        });
        let values: Vec<f64> = means.collect();
        let lined = contoured.unwrap_or(field);
        let corners: Vec<_> = self
            .faces
            .iter()
            .map(|face| face.map(|k| lined.values[k]))
            .collect();
        let finite = corners.iter().flatten().filter(|value| value.is_finite());
        let step = interval(finite.copied().fold(0.0, f64::max));
        let lines = if step > 0.0 {
            contours(&self.triangles, &corners, step)
        } else {
            Vec::new()
        };
        let largest = values
            .iter()
            .copied()
            .filter(|value| value.is_finite())
            .fold(0.0, f64::max);
        // What did not rupture has no time.
        let drawn = self.triangles.iter().copied().zip(values);
        let (triangles, values): (Vec<_>, Vec<f64>) =
            drawn.filter(|(_, value)| value.is_finite()).unzip();
        let of = contoured.map_or_else(String::new, |other| format!(" of {}", other.name));
        let title = format!(
            "{}, contours{of} at {}",
            field.name,
            (step * 1e6).round() / 1e6
        );
        let sheet = PatchSheet {
            name: field.name,
            colors: Colors {
                range: (0.0, if largest > 0.0 { largest } else { 1.0 }),
                logarithmic: false,
            },
            rows: vec![[
                Some(Patches {
                    title,
                    triangles: &triangles,
                    values,
                    behind: vec![(1, self.outline())],
                    above: lines.into_iter().map(|line| (2, line)).collect(),
                    texts: Vec::new(),
                    names: Some(["along strike [km]", "depth [km]"]),
                }),
                None,
            ]],
        };
        plot::draw(path, &sheet)
    }
}
