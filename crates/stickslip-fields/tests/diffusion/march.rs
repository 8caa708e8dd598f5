//! Steps of a field alone.

use stickslip_fields::{FaultField, Hydraulics};

pub(crate) const DAY: f64 = 86_400.0;

/// Diffusivity .1 m^2/s.
pub(crate) fn zone(permeability: f64) -> Hydraulics {
    Hydraulics {
        permeability: permeability.into(),
        viscosity: 1e-3.into(),
        storage: 1e-9.into(),
        thickness: 1.0.into(),
    }
}

/// A field with its memory.
pub(crate) struct March<'a, F> {
    pub(crate) field: &'a F,
    pub(crate) memory: Vec<f64>,
    next: Vec<f64>,
    source: Vec<f64>,
    pub(crate) steps: usize,
}

impl<'a, F: FaultField> March<'a, F> {
    pub(crate) fn new(field: &'a F) -> Self {
        let sizes = field.sizes();
        Self {
            field,
            next: vec![0.0; sizes.memory.len()],
            source: vec![0.0; sizes.sources],
            memory: sizes.memory,
            steps: 0,
        }
    }

    pub(crate) fn step(&mut self, dt: f64) {
        let source = [&self.source[..], &self.source[..]];
        self.field
            .advance(&self.memory, source, dt, &mut self.next)
            .expect("advances");
        std::mem::swap(&mut self.memory, &mut self.next);
        self.steps += 1;
    }

    /// Steps of an estimated error below `tolerance` \[Pa\], from the first one.
    pub(crate) fn adaptively(&mut self, mut dt: f64, tolerance: f64, span: f64) -> f64 {
        let (mut left, mut free) = (span, dt);
        while left > 0.0 {
            let last = dt >= left;
            let now = if last { left } else { dt };
            let source = [&self.source[..], &self.source[..]];
            self.field
                .advance(&self.memory, source, now, &mut self.next)
                .expect("advances");
            let mut errors = vec![0.0; self.field.sizes().vertices];
            self.field
                .error(&self.memory, source, now, &self.next, &mut errors);
            let error = errors
                .iter()
                .fold(0.0_f64, |most, error| most.max(error.abs()));
            let factor = (0.9 * (tolerance / error.max(1e-30)).cbrt()).clamp(0.2, 3.0);
            if error <= tolerance {
                std::mem::swap(&mut self.memory, &mut self.next);
                self.steps += 1;
                left = if last { 0.0 } else { left - now };
                free = if last {
                    free.max(now * factor)
                } else {
                    now * factor
                };
            } else {
                free = now * factor;
            }
            dt = free;
        }
        free
    }

    pub(crate) fn pressure(&self) -> Vec<f64> {
        let mut pressure = vec![0.0; self.field.sizes().vertices];
        self.field.pressure(&self.memory, &mut pressure);
        pressure
    }

    pub(crate) fn total(&self, name: &str) -> f64 {
        let number = self
            .field
            .totals()
            .iter()
            .position(|total| total.name == name);
        self.field.total(number.expect("total"), &self.memory)
    }

    pub(crate) fn read(&self, name: &str) -> Vec<f64> {
        let number = self
            .field
            .readings()
            .iter()
            .position(|reading| reading.name == name);
        let mut values = vec![0.0; self.field.sizes().vertices];
        self.field
            .read(number.expect("reading"), &self.memory, &mut values);
        values
    }
}
