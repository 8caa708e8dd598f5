//! The marks of fields in the fingerprint of a scene.

use super::{Field, Fields};
use crate::fields::FaultRates;
use crate::marks::{Fingerprint, shares};

/// The slip rate \[m/s\], frictional strength \[Pa\], state rate [1/s], normal stress \[Pa\] and time \[s\] at which fields
/// are sampled, each times weights.
const SAMPLE: [f64; 5] = [1e-6, 1e6, 1e-3, 1e6, 1.0];

impl Fields {
    /// Marks each field by its initial memory, and by its source, advance and pressure where they are sampled.
    pub(in crate::contact) fn describe(
        &self,
        time: f64,
        of: &dyn Fn(&str) -> String,
        fingerprint: &mut Fingerprint,
    ) {
        fingerprint.count(&of("number of fields"), self.fields.len());
        for (index, field) in self.fields.iter().enumerate() {
            field.describe(
                time,
                &|what| of(&format!("{what} of field {index}")),
                fingerprint,
            );
        }
    }
}

impl Field {
    fn describe(&self, time: f64, of: &dyn Fn(&str) -> String, fingerprint: &mut Fingerprint) {
        let sizes = self.law.sizes();
        fingerprint.count(&of("number of sources"), sizes.sources);
        fingerprint.count(&of("length of the memory"), sizes.memory.len());
        fingerprint.bits(&of("initial memory"), &sizes.memory);

        let weighted = |scale: f64, count: usize| -> Vec<f64> {
            shares().take(count).map(|share| scale * share).collect()
        };
        let [slip_rate, friction, state_rate, normal_stress, dt] = SAMPLE;
        let mut source = vec![0.0; sizes.sources];
        self.law.source(
            &FaultRates {
                time,
                slip_rate: &weighted(slip_rate, sizes.vertices),
                friction: &weighted(friction, sizes.vertices),
                state_rate: &weighted(state_rate, sizes.vertices),
                normal_stress: &weighted(normal_stress, sizes.vertices),
            },
            &sizes.memory,
            &mut source,
        );
        fingerprint.function(&of("source"), &source);

        let from = weighted(1.0, sizes.memory.len());
        let mut pressure = vec![0.0; sizes.vertices];
        self.law.pressure(&from, &mut pressure);
        fingerprint.function(&of("pressure"), &pressure);

        let [begin, end] = [1.0, 2.0].map(|scale| weighted(scale, sizes.sources));
        let mut to = vec![0.0; from.len()];
        // A field that cannot advance the sample is known by the rest of its marks.
        if (self.law.advance(&from, [&begin, &end], dt, &mut to)).is_ok() {
            fingerprint.function(&of("advance"), &to);
        }
    }
}
