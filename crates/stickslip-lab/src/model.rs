//! The residuals of all records and their derivatives.
//!
//! Records share the parameters of friction, and each has its own machine, level, trend and beginning. A fit of one record is
//! the case of one.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::course::Course;
use crate::error::LabError;
use crate::normal::Linearised;
use crate::parameter::Parameter;
use crate::parameters::Parameters;
use crate::part::Part;
use crate::point::Point;

/// A fitted parameter, of one record or of all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Free {
    pub(crate) parameter: Parameter,
    /// The record, from 0 on; none of a parameter that all share.
    pub(crate) part: Option<usize>,
}

/// The records of a fit and the parameters that are fitted to them.
#[derive(Clone)]
pub(crate) struct Model<'a> {
    pub(crate) parts: Vec<Part<'a>>,
    pub(crate) free: Vec<Free>,
}

impl<'a> Model<'a> {
    /// The model of records of which each has the same shared parameters.
    pub(crate) fn new(mut parts: Vec<Part<'a>>) -> Self {
        let mut free = Vec::new();
        let shared = parts.first().map_or(&[][..], |part| &part.free);
        free.extend(
            shared
                .iter()
                .filter(|parameter| parameter.is_shared())
                .map(|&parameter| Free {
                    parameter,
                    part: None,
                }),
        );
        for (number, part) in parts.iter_mut().enumerate() {
            part.places.clear();
            for &parameter in &part.free {
                let of = |part| Free { parameter, part };
                let known = free.iter().position(|free| *free == of(None));
                part.places.push(known.unwrap_or(free.len()));
                if known.is_none() {
                    free.push(of(Some(number)));
                }
            }
        }
        Self { parts, free }
    }

    /// The same model with further parameters of some records, which are 0, behind the others.
    pub(crate) fn with(&self, further: &[Vec<Parameter>]) -> Self {
        let mut model = self.clone();
        for (number, (part, further)) in model.parts.iter_mut().zip(further).enumerate() {
            for &parameter in further {
                part.places.push(model.free.len());
                part.free.push(parameter);
                model.free.push(Free {
                    parameter,
                    part: Some(number),
                });
            }
        }
        model
    }

    /// The values of the fitted parameters of a record.
    pub(crate) fn of_part(&self, part: usize, values: &[f64]) -> Vec<f64> {
        let places = &self.parts[part].places;
        places.iter().map(|&place| values[place]).collect()
    }

    /// The parameters of each record with these values of the fitted ones, logarithms of positive ones.
    pub(crate) fn points(&self, values: &[f64]) -> Vec<Point> {
        let parts = self.parts.iter().enumerate();
        parts
            .map(|(number, part)| part.point(&self.of_part(number, values)))
            .collect()
    }

    /// The values of the fitted parameters, logarithms of positive ones; of shared ones those of the first record.
    pub(crate) fn values(&self, points: &[Point]) -> Vec<f64> {
        let mut values = vec![0.0; self.free.len()];
        for (part, point) in self.parts.iter().zip(points).rev() {
            for (&place, value) in part.places.iter().zip(part.values(point)) {
                values[place] = value;
            }
        }
        values
    }

    /// The values of a guess, the same of each record, and guesses of single parameters before it.
    pub(crate) fn guessed(&self, guess: &Parameters) -> Vec<f64> {
        let parts = self.parts.iter().map(|part| {
            let mut start = Point::new(guess.clone());
            for &(parameter, value) in part.guesses {
                start.set(parameter, value);
            }
            start
        });
        self.values(&parts.collect::<Vec<_>>())
    }

    /// The rows of the residuals of each record.
    pub(crate) fn rows(&self) -> Vec<Range<usize>> {
        let mut from = 0;
        let parts = self.parts.iter().map(|part| {
            let rows = from..from + part.len();
            from = rows.end;
            rows
        });
        parts.collect()
    }

    /// Whether each sample has a weight.
    pub(crate) fn weighted(&self) -> Vec<bool> {
        self.parts.iter().flat_map(Part::weighted).collect()
    }

    /// The number of samples with a weight.
    pub(crate) fn samples(&self) -> usize {
        self.parts.iter().map(|part| part.record.weighted()).sum()
    }

    /// The weighted residuals, model minus data, and their derivatives, record by record.
    pub(crate) fn linearised(
        &self,
        values: &[f64],
        tolerance: f64,
        course: &mut Course<'_>,
    ) -> Result<Linearised, LabError> {
        if let [part] = &self.parts[..] {
            return part.linearised(values, tolerance, course);
        }
        let rows = self.rows();
        let count = rows.last().map_or(0, |rows| rows.end);
        let mut residual = DVector::zeros(count);
        let mut jacobian = DMatrix::zeros(count, self.free.len());
        for (number, (part, rows)) in self.parts.iter().zip(rows).enumerate() {
            let values = self.of_part(number, values);
            let (own, by) = part.linearised(&values, tolerance, course)?;
            residual.rows_mut(rows.start, rows.len()).copy_from(&own);
            for (k, &place) in part.places.iter().enumerate() {
                let mut column = jacobian.column_mut(place);
                column
                    .rows_mut(rows.start, rows.len())
                    .copy_from(&by.column(k));
            }
        }
        Ok((residual, jacobian))
    }
}
