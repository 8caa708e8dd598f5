//! Fluids along planes of a system.

use std::ops::Range;

use stickslip::fields::{Diffusion, FaultField, FaultRates, FieldError, FieldSizes, Reading};

/// A fluid along one plane, the cells of which have these numbers.
pub(super) struct OnPlane {
    pub(super) fluid: Diffusion,
    pub(super) cells: Range<usize>,
}

/// Fluids along planes of one contact.
#[derive(Clone)]
pub(super) struct OnPlanes {
    parts: Vec<Part>,
    /// The number of cells of all planes.
    count: usize,
    readings: Vec<Reading>,
    totals: Vec<Reading>,
}

/// A fluid with its places in the memory and among the sources.
#[derive(Clone)]
struct Part {
    fluid: Diffusion,
    cells: Range<usize>,
    memory: Range<usize>,
    sources: Range<usize>,
}

impl OnPlanes {
    /// Fluids along planes of so many cells.
    pub(super) fn new(fluids: Vec<OnPlane>, count: usize) -> Self {
        let (mut memory, mut sources) = (0, 0);
        let mut own = Self {
            parts: Vec::new(),
            count,
            readings: Vec::new(),
            totals: Vec::new(),
        };
        for OnPlane { fluid, cells } in fluids {
            let sizes = fluid.sizes();
            for (all, further) in [
                (&mut own.readings, fluid.readings()),
                (&mut own.totals, fluid.totals()),
            ] {
                for reading in further {
                    if !all.contains(reading) {
                        all.push(*reading);
                    }
                }
            }
            let (begin, first) = (memory, sources);
            memory += sizes.memory.len();
            sources += sizes.sources;
            own.parts.push(Part {
                fluid,
                cells,
                memory: begin..memory,
                sources: first..sources,
            });
        }
        own
    }
}

impl Part {
    fn sources<'a>(&self, source: [&'a [f64]; 2]) -> [&'a [f64]; 2] {
        // A field without sources is advanced without them.
        source.map(|source| source.get(self.sources.clone()).unwrap_or_default())
    }
}

impl FaultField for OnPlanes {
    fn sizes(&self) -> FieldSizes {
        let sizes = self.parts.iter().map(|part| part.fluid.sizes());
        FieldSizes {
            vertices: self.count,
            memory: sizes.flat_map(|sizes| sizes.memory).collect(),
            sources: self.parts.last().map_or(0, |part| part.sources.end),
        }
    }

    fn source(&self, at: &FaultRates<'_>, memory: &[f64], source: &mut [f64]) {
        for part in &self.parts {
            let cells = part.cells.clone();
            let shown = FaultRates {
                time: at.time,
                slip_rate: &at.slip_rate[cells.clone()],
                friction: &at.friction[cells.clone()],
                state_rate: &at.state_rate[cells.clone()],
                normal_stress: &at.normal_stress[cells],
            };
            let source = &mut source[part.sources.clone()];
            part.fluid
                .source(&shown, &memory[part.memory.clone()], source);
        }
    }

    fn advance(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &mut [f64],
    ) -> Result<(), FieldError> {
        self.parts.iter().try_for_each(|part| {
            let to = &mut to[part.memory.clone()];
            let from = &from[part.memory.clone()];
            part.fluid.advance(from, part.sources(source), dt, to)
        })
    }

    fn pressure(&self, memory: &[f64], pressure: &mut [f64]) {
        for part in &self.parts {
            let pressure = &mut pressure[part.cells.clone()];
            part.fluid.pressure(&memory[part.memory.clone()], pressure);
        }
    }

    fn error(
        &self,
        from: &[f64],
        source: [&[f64]; 2],
        dt: f64,
        to: &[f64],
        pressure_error: &mut [f64],
    ) {
        for part in &self.parts {
            let [from, to] = [from, to].map(|memory| &memory[part.memory.clone()]);
            let error = &mut pressure_error[part.cells.clone()];
            part.fluid.error(from, part.sources(source), dt, to, error);
        }
    }

    fn stops(&self) -> Vec<f64> {
        let stops = self.parts.iter().flat_map(|part| part.fluid.stops());
        stops.collect()
    }

    fn readings(&self) -> &[Reading] {
        &self.readings
    }

    /// Writes a reading on the planes that have it; elsewhere it is not a number.
    fn read(&self, number: usize, memory: &[f64], values: &mut [f64]) {
        values.fill(f64::NAN);
        for part in self.parts.iter().rev() {
            let mut own = part.fluid.readings().iter();
            if let Some(number) = own.position(|own| *own == self.readings[number]) {
                let values = &mut values[part.cells.clone()];
                part.fluid
                    .read(number, &memory[part.memory.clone()], values);
            }
        }
    }

    fn totals(&self) -> &[Reading] {
        &self.totals
    }

    fn total(&self, number: usize, memory: &[f64]) -> f64 {
        let parts = self.parts.iter().filter_map(|part| {
            let mut own = part.fluid.totals().iter();
            let number = own.position(|own| *own == self.totals[number])?;
            Some(part.fluid.total(number, &memory[part.memory.clone()]))
        });
        parts.sum()
    }
}
