//! Wrong wells, sources and rates, each with its own error.

use stickslip_fields::{GaussianSource, Place, RateHistory, Well};

use crate::march::zone;
use crate::refusals::{field, made, plane, rate, refused};

#[test]
fn wells_and_rates() {
    let nan = f64::NAN;
    refused(vec![
        (
            field().with_well(Well::new(41.0, rate())).map(drop),
            "well at [41.0] lies outside of the cells",
        ),
        (
            field().with_well(Well::new(nan, rate())).map(drop),
            "well at [NaN] lies outside",
        ),
        (
            field()
                .with_well(Well::new(Place::Cell(4), rate()))
                .map(drop),
            "well at [4.0] lies outside",
        ),
        (
            field().with_well(Well::new([0.0, 1.0], rate())).map(drop),
            "well at a position on a plane, but the cells",
        ),
        (
            field()
                .with_well(Well::new(1.0, rate()).with_bore(1e-9, 0.1))
                .map(drop),
            "well at a bore of a radius, but the cells form a line",
        ),
        (
            field()
                .with_well(Well::new(1.0, rate()).with_bore_of_index(0.0, 0.1))
                .map(drop),
            "storage of a wellbore",
        ),
        (
            made(zone(0.0))
                .and_then(|field| field.with_well(Well::new(25.0, rate())))
                .map(drop),
            "well in cell 2, which is sealed",
        ),
        (
            field().with_source(&[1.0; 3], rate()).map(drop),
            "share of a source: 3 values for 4",
        ),
        (
            field()
                .with_source(&[1.0, -1.0, 0.0, 0.0], rate())
                .map(drop),
            "share of a source of cell 1",
        ),
        (
            plane().with_well(Well::new([1.0, 31.0], rate())).map(drop),
            "well at [1.0, 31.0] lies outside",
        ),
        (
            plane().with_well(Well::new(1.0, rate())).map(drop),
            "well at a position along a line, but the cells form a plane",
        ),
        (
            plane()
                .with_well(Well::new([1.0, 1.0], rate()).with_bore(1e-9, 2.0))
                .map(drop),
            "radius 2e0 m of the wellbore must be below the equivalent radius of its cell, 1.985",
        ),
        (
            plane()
                .with_well(Well::new([1.0, 1.0], rate()).with_bore(1e-9, 0.0))
                .map(drop),
            "radius of a wellbore [m] must be above 0",
        ),
        (
            plane()
                .with_gaussian_source(GaussianSource::new([1.0, 1.0], 0.0, rate()))
                .map(drop),
            "standard deviation of a Gaussian source [m] must be above 0",
        ),
        (
            plane()
                .with_gaussian_source(GaussianSource::new([-1.0, 1.0], 5.0, rate()))
                .map(drop),
            "Gaussian source at [-1.0, 1.0] lies outside",
        ),
        (RateHistory::constant(nan).map(drop), "rate must be finite"),
        (
            RateHistory::constant_between(&[]).map(drop),
            "rows of rates: 0 values",
        ),
        (
            RateHistory::constant_between(&[(1.0, 0.0), (0.5, 1.0)]).map(drop),
            "row 1 of the rates: time 5e-1 s",
        ),
        (
            RateHistory::linear_between(&[(1.0, 0.0), (2.0, nan)]).map(drop),
            "row 1 of the rates: time 2e0 s and rate NaN",
        ),
    ]);
}
