//! Earthquake cycles on a plane of cells, the problems BP4, BP5 and BP7: scene and report.

use std::ops::ControlFlow;
use std::time::Instant;

use serde_json::json;
use stickslip::bie::{OffFault, Overstress, PlaneFault, PlaneKernel, Rectangles};
use stickslip::friction::{FrictionLaw, RegularizedDieterichRuina};
use stickslip::nalgebra::SVector;
use stickslip::problems::bp1::{MEDIUM, PLATE_RATE};
use stickslip::record::SeasPoint;
use stickslip::state::{Dieterich, LogTheta};
use stickslip::{Contact, RungeKutta, Scene};

use super::events::Events;
use super::off_fault::{self, Plan, VERTICAL, WHOLE_SPACE, block_name};
use super::plane_record::{EVENT, Record};
use super::seas::{Places, files};
use super::{Arguments, Failed, YEAR};
use crate::progress::Progress;

/// Poisson's ratio.
const POISSON_RATIO: f64 = 0.25;
/// The number of rows from which products by transforms down dip are faster.
const MANY_ROWS: usize = 100;

/// A problem on a plane. Positions are along strike and down dip \[m\].
pub(super) struct Setting {
    /// The ends along strike and down dip \[m\].
    pub(super) ends: [[f64; 2]; 2],
    /// Vertical below a free surface, or in a whole space.
    pub(super) half_space: bool,
    /// Normal stress \[Pa\].
    pub(super) normal: f64,
    pub(super) law: fn([f64; 2]) -> RegularizedDieterichRuina,
    /// The initial state, `ln(theta / 1 s)`.
    pub(super) state: fn([f64; 2]) -> f64,
    /// The initial slip rate along strike [m/s]; the shear stress balances it.
    pub(super) rate: fn([f64; 2]) -> f64,
    /// A shear stress along strike beyond the initial one.
    pub(super) overstress: Option<Nucleation>,
    /// The lines of the pictures: along strike at a distance down dip, and down dip at a distance along strike \[m\].
    pub(super) lines: [f64; 2],
    pub(super) stations: &'static [[f64; 2]],
    /// The stations off the fault: along strike, along the normal and down \[m\].
    pub(super) blocks: &'static [[f64; 3]],
    /// The unit \[m\] and the digits of the names of their files.
    pub(super) names: (f64, usize),
    /// The intervals of slip contours between events and in events \[s\], and their names.
    pub(super) intervals: [f64; 2],
    pub(super) labels: [&'static str; 2],
    /// The slip rate of a rupture [m/s], and times of maps after it is first reached in an event \[s\].
    pub(super) rupture: f64,
    pub(super) shots: &'static [f64],
    /// The unit of length in pictures, and its metres.
    pub(super) unit: (&'static str, f64),
}

/// A smooth overstress.
#[derive(Clone, Copy)]
pub(super) struct Nucleation {
    /// Along strike and down dip \[m\].
    pub(super) centre: [f64; 2],
    /// \[Pa\]
    pub(super) amplitude: f64,
    /// \[m\]
    pub(super) radius: f64,
    /// \[s\]
    pub(super) rise_time: f64,
}

impl Setting {
    /// The initial shear stress along strike \[Pa\].
    pub(super) fn shear(&self, at: [f64; 2]) -> f64 {
        let rate = (self.rate)(at);
        let damping = 0.5 * MEDIUM.shear_modulus / MEDIUM.shear_wave_speed;
        let coefficient = (self.law)(at).coefficient(rate, LogTheta((self.state)(at)));
        self.normal * coefficient + damping * rate
    }

    /// The fault with both components of slip.
    fn fault(&self, arguments: &Arguments) -> Result<PlaneFault, Failed> {
        let [along, down] = self.ends;
        let cells = Rectangles::new(arguments.cells(along)?, arguments.cells(down)?);
        if !self.half_space {
            return Ok(PlaneFault::whole_space(cells, MEDIUM, POISSON_RATIO)?);
        }
        let fault = PlaneFault::half_space(cells, 90.0, MEDIUM, POISSON_RATIO)?;
        Ok(if cells.down_dip().count() >= MANY_ROWS {
            fault.transformed_down_dip()?
        } else {
            fault
        })
    }

    /// The scene of a fault, its first component of slip along strike.
    fn scene<const C: usize>(
        &self,
        fault: &PlaneFault<C>,
    ) -> Result<Scene<PlaneKernel<C>, C>, Failed> {
        let along = |size: f64| SVector::from_fn(|c, _| if c == 0 { size } else { 0.0 });
        let cells = *fault.cells();
        let laws = cells.map(self.law);
        let aging: Vec<_> = laws
            .iter()
            .map(|law| Dieterich {
                slip_distance: law.slip_distance,
            })
            .collect();
        let contact = Contact::per_vertex(fault, laws, self.normal)
            .with_state_per_vertex(aging, cells.map(|at| LogTheta((self.state)(at))))
            .with_shear_stress(cells.map(|at| along(self.shear(at))));
        let scene = Scene::new(fault.stiffness())
            .with_viscosity(fault.radiation_damping())
            .with_contact(contact)
            .with_load_history(fault.plate_loading(along(PLATE_RATE))?)
            .with_velocity(cells.map(|at| along((self.rate)(at))));
        let Some(Nucleation {
            centre,
            amplitude,
            radius,
            rise_time,
        }) = self.overstress
        else {
            return Ok(scene);
        };
        let distances = cells.map(|[x, y]| (x - centre[0]).hypot(y - centre[1]));
        let patch = Overstress::new(amplitude, radius, rise_time)?;
        Ok(scene.with_load_history(patch.load(&distances, along(cells.area()))))
    }

    /// Takes the steps, and writes and prints the results.
    pub(super) fn run(&self, arguments: &Arguments) -> Result<Events, Failed> {
        let fault = self.fault(arguments)?;
        match arguments.components {
            Some(2) => self.follow(arguments, &fault),
            _ => self.follow(arguments, &fault.with_rake(0.0)?),
        }
    }

    /// The places of the files of the benchmark.
    fn places<'a, const C: usize>(&self, fault: &'a PlaneFault<C>) -> Places<'a> {
        let along = fault.cells().along_strike();
        let point = |x| SeasPoint::Plane([x, self.lines[0]]);
        Places {
            stations: self
                .stations
                .iter()
                .map(|&at| SeasPoint::Plane(at))
                .collect(),
            lines: vec![along.map(point)],
            names: self.names,
            normal_stress: false,
            pore_fluid: false,
            shear_modulus: MEDIUM.shear_modulus,
            event: (EVENT, self.intervals),
            directions: fault.directions(),
        }
    }

    /// What is off the fault. The normal of the benchmarks points into the hanging wall, the side that slip moves.
    fn off_fault<const C: usize>(&self, fault: &PlaneFault<C>) -> Result<Plan<C>, Failed> {
        let point = |[x, normal, down]: [f64; 3]| {
            if self.half_space {
                [x, -normal, -down]
            } else {
                [x, -down, normal]
            }
        };
        let stations = self.blocks.iter();
        let stations = stations.map(|&at| (block_name(at, self.names), point(at)));
        Ok(Plan {
            sources: fault.sources()?,
            plate: Some(SVector::from_fn(
                |c, _| if c == 0 { PLATE_RATE } else { 0.0 },
            )),
            stations: stations.collect(),
            axes: if self.half_space {
                VERTICAL
            } else {
                WHOLE_SPACE
            },
            event: EVENT,
            extent: self.half_space.then_some([self.ends[0], [0.0; 2]]),
        })
    }

    fn follow<const C: usize>(
        &self,
        arguments: &Arguments,
        fault: &PlaneFault<C>,
    ) -> Result<Events, Failed> {
        const FILES: [&str; 7] = [
            "stations.csv",
            "slip.png",
            "slip_rate.png",
            "slip_rate_map.png",
            "plane.png",
            "rupture.png",
            "summary.json",
        ];
        let output = arguments.files.create("earthquakes", &FILES)?;
        let clock = Instant::now();
        let mut motion = RungeKutta::new(self.scene(fault)?)?;
        let setup = clock.elapsed().as_secs_f64();
        let mut files = files(arguments, self.places(fault), &motion.snapshot())?;
        let (plan, folder) = (self.off_fault(fault)?, output.folder());
        let mut off_fault = off_fault::Record::new(arguments, plan, folder, &motion.snapshot())?;
        let mut record = Record::new(self, arguments.end(), fault.cells(), &motion.snapshot())?;
        record.see(&motion.snapshot());
        let mut steps = arguments.steps();
        if let Some(Nucleation { rise_time, .. }) = self.overstress {
            steps = steps
                .with_first_step(1e-3 * rise_time)
                .stopping_at([rise_time]);
        }
        let (clock, mut progress, end) = (Instant::now(), Progress::default(), arguments.end());
        let report = motion.run(&steps, |at| {
            record.see(&at);
            progress.show(at.time / end, || {
                let (years, rate) = (at.time / YEAR, at.max_slip_rate());
                format!("{years:.2} years, step {}, {rate:.1e} m/s", at.step)
            });
            off_fault.record(&at)?;
            (files.as_mut()).map_or(ControlFlow::Continue(()), |files| files.record(&at))
        })?;
        drop(progress);
        off_fault.finish(&motion.snapshot())?;
        if let Some(files) = files {
            files.finish()?;
        }
        let seconds = clock.elapsed().as_secs_f64();
        record.write(&output, FILES, &motion.snapshot())?;
        let (taken, taken_back) = (report.accepted, report.rejected + report.failed);
        output.json(
            FILES[6],
            &json!({
                "problem": arguments.problem.name(),
                "cell": arguments.cell(),
                "components": C,
                "tolerance": arguments.adaptive,
                "event_times_years": record.events.years(),
                "peak_log10_slip_rate": record.events.each(|event| event.peak),
                "mean_slip": record.events.each(|event| event.mean_slip),
                "event_area": record.events.each(|event| event.cells as f64 * fault.cells().area()),
                "stations": record.stations(),
                "steps": taken,
                "rejected": taken_back,
                "setup_seconds": setup,
                "seconds": seconds,
            }),
        )?;
        say!(
            "{:>12} {:>14} {:>14} {:>12}",
            "event years",
            "mean slip [m]",
            "area [km^2]",
            "log10 V"
        )?;
        for event in record.events.all() {
            let area = event.cells as f64 * fault.cells().area() / 1e6;
            say!(
                "{:>12.3} {:>14.4} {area:>14.5} {:>12.3}",
                event.onset / YEAR,
                event.mean_slip,
                event.peak
            )?;
        }
        say!(
            "{} cells, {taken} steps, {taken_back} taken back, {setup:.1} s before the first, {seconds:.1} s, {:.2} ms per step; {}",
            fault.cells().count(),
            1e3 * seconds / (taken + taken_back).max(1) as f64,
            output.told(&FILES)
        )?;
        Ok(record.events)
    }
}
