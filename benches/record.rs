//! The cost of recorders beside the step they record: the paper's slider at four refinements, by condensation.
//!
//! Points write two vertices every tenth step, traces every hundredth; the ledger is balanced by none.

mod common;

use std::hint::black_box;
use std::io;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use stickslip::Snapshot;
use stickslip::integrate::Stepper;
use stickslip::record::{
    EnergyLedger, EventCatalogue, PointHistories, Quantity, TraceMemory, TraceWriter, Tracing,
};

use common::slider::{METHODS, Sliding, sticking};
use common::{Begun, LEVELS, TIME_STEP, Window};

/// All of them.
struct Recorders {
    points: PointHistories<io::Sink>,
    writer: TraceWriter<io::Sink>,
    memory: TraceMemory,
    catalogue: EventCatalogue<2>,
    ledger: EnergyLedger<2>,
}

impl Recorders {
    fn new(at: &Snapshot<'_, 2>) -> Result<Self, stickslip::record::FileError> {
        let tracing = Tracing::of(
            0,
            &[
                Quantity::Slip,
                Quantity::SlipRate,
                Quantity::State,
                Quantity::Traction,
            ],
        );
        Ok(Self {
            points: PointHistories::new(at, &[0, 1], 10, io::sink())?,
            writer: TraceWriter::new(at, tracing.clone().every(100), io::sink())?,
            memory: TraceMemory::new(at, tracing.every(100), 256)?,
            catalogue: EventCatalogue::new(at, 0, [1e-3, 5e-4], 2e7, 16)?,
            ledger: EnergyLedger::new(at),
        })
    }
}

/// One motion: its step, each recorder on its own, and all of them.
fn compare(criterion: &mut Criterion, name: &str, begin: &dyn Fn() -> Begun<2>) {
    let mut group = criterion.benchmark_group(format!("record, {name}"));
    let window = Window {
        dt: TIME_STEP,
        steps: 40,
        repeats: 1,
    };
    window.measure(&mut group, BenchmarkId::from_parameter("step"), begin);
    let motion: Box<dyn Stepper<2>> = begin().expect("the motion begins");
    let at = motion.snapshot();
    let mut all = Recorders::new(&at).expect("the recorders fit");
    group.bench_function("points", |b| b.iter(|| all.points.record(black_box(&at))));
    group.bench_function("trace, written", |b| {
        b.iter(|| all.writer.record(black_box(&at)))
    });
    group.bench_function("trace, in memory", |b| {
        b.iter(|| all.memory.record(black_box(&at)))
    });
    group.bench_function("catalogue", |b| {
        b.iter(|| all.catalogue.record(black_box(&at)))
    });
    group.bench_function("ledger", |b| b.iter(|| all.ledger.record(black_box(&at))));
    group.bench_function("all", |b| {
        b.iter(|| {
            let at = black_box(&at);
            let _ = all.points.record(at);
            let _ = all.writer.record(at);
            all.memory.record(at);
            all.catalogue.record(at);
            all.ledger.record(at);
        })
    });
    group.finish();
}

fn recorders(criterion: &mut Criterion) {
    let condensed = METHODS[3];
    compare(criterion, "stick", &|| sticking(&condensed, LEVELS[0]));
    let sliding = Sliding::new(LEVELS[0]).expect("the slider comes to slide");
    compare(criterion, "slip", &|| sliding.go_on(&condensed));
}

criterion_group! {
    name = benches;
    config = common::config(1.0);
    targets = recorders
}
criterion_main!(benches);
