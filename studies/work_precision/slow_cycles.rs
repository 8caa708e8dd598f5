//! Event after event of the slowly loaded slider: when, and at what cost?

use std::fmt::{Error, Write};
use std::time::Instant;

use stickslip::fem::P1;
use stickslip::problems::{END, Slider};
use stickslip::{
    Condensed, ErrorControl, Events, GeneralizedAlpha, Newmark, RateScheme, Sdirk2, Simulation,
    Steps,
};
use stickslip_studies::Table;
use support::cli::Problem;
use support::output::{Output, digits};

use crate::slow_slider::{RELAXATION, SLIP, SLOWER, body};

/// The name of the table.
pub(crate) const NAME: &str = "slow-cycles";
/// That of the reference among the schemes.
const REFERENCE: &str = "reference";
/// The weights of the error of the motion.
const WEIGHTS: [f64; 2] = [1.0, 0.1];
/// A run gives up after so many steps.
const MAX_STEPS: usize = 500_000;

/// A body, and how it is run.
struct Setting {
    name: &'static str,
    /// Viscosity over elasticity \[s\].
    relaxation: f64,
    /// The end of the run \[s\].
    until: f64,
    /// The tolerance of the reference, and those of the others.
    reference: f64,
    tolerances: &'static [f64],
}

/// The viscous body slides steadily after its last event; the waves of the elastic one have to be
/// followed to its end.
const SETTINGS: [Setting; 2] = [
    Setting {
        name: "viscous",
        relaxation: RELAXATION,
        until: 1.3e4,
        reference: 1e-5,
        tolerances: &[1e-1, 1e-2, 1e-3, 1e-4],
    },
    Setting {
        name: "elastic",
        relaxation: 0.0,
        until: 1.2e4,
        reference: 1e-3,
        tolerances: &[1e-1, 1e-2],
    },
];

type Named = (&'static str, fn() -> Box<dyn RateScheme>);

const SCHEMES: [Named; 3] = [
    ("Sdirk2", || Box::new(Sdirk2)),
    ("GeneralizedAlpha(0.5)", || {
        Box::new(GeneralizedAlpha {
            spectral_radius: 0.5,
        })
    }),
    ("Newmark", || Box::new(Newmark::default())),
];

/// One run.
#[derive(Debug, Clone)]
pub(crate) struct Cycles {
    body: &'static str,
    scheme: &'static str,
    weight: f64,
    tolerance: f64,
    /// The times at which `x0` begins to slip \[s\].
    events: Vec<f64>,
    steps: usize,
    seconds: f64,
    failure: Option<String>,
}

/// Runs both bodies by each scheme at all settings, and by Sdirk2 for a reference.
pub(crate) fn measure(quick: bool) -> Result<Vec<Cycles>, Problem> {
    let slider = Slider {
        refinements: 1,
        ..Slider::default()
    };
    let space = slider.space()?;
    let mut all = Vec::new();
    for setting in SETTINGS {
        if quick && setting.relaxation == 0.0 {
            continue;
        }
        let mut run = |scheme: Named, weight, tolerance| -> Result<(), Problem> {
            let cycles = Cycles {
                body: setting.name,
                scheme: scheme.0,
                weight,
                tolerance,
                events: Vec::new(),
                steps: 0,
                seconds: 0.0,
                failure: None,
            };
            let (relaxation, until) = (setting.relaxation, setting.until);
            let cycles = cycles.run((&slider, &space, relaxation), (scheme.1)(), until)?;
            cycles.print();
            all.push(cycles);
            Ok(())
        };
        let reference = if quick { 1e-3 } else { setting.reference };
        run((REFERENCE, SCHEMES[0].1), 1.0, reference)?;
        let tolerances = &setting.tolerances[..if quick { 2 } else { setting.tolerances.len() }];
        for scheme in SCHEMES {
            for weight in WEIGHTS {
                for &tolerance in tolerances {
                    run(scheme, weight, tolerance)?;
                }
            }
        }
    }
    Ok(all)
}

impl Cycles {
    fn run(
        mut self,
        (slider, space, relaxation): (&Slider, &P1<2>, f64),
        scheme: Box<dyn RateScheme>,
        until: f64,
    ) -> Result<Self, Problem> {
        let begin = Instant::now();
        let centre = Slider::centre(space).ok_or("the mesh has no vertex at x0")?;
        let scene = body(slider, space, relaxation)?;
        let mut simulation = Simulation::new(scene, scheme, Condensed::new())?;
        let steps = Steps::adaptive(self.tolerance)
            .with_error_control(ErrorControl {
                motion: self.weight,
                ..ErrorControl::default()
            })
            .with_first_step(SLOWER * END / 1e4)
            .quantised()
            .stopping_at([SLOWER * END / 4.0])
            .with_max_steps(MAX_STEPS)
            .until(until);
        let mut slips = Events::new(SLIP, SLIP);
        let mut count = 0;
        let result = simulation.run(&steps, |at| {
            slips.record(at.time, at.velocity[centre].norm());
            count += 1;
        });
        self.failure = result.err().map(|failure| failure.to_string());
        self.events = slips.times().to_vec();
        self.steps = count;
        self.seconds = begin.elapsed().as_secs_f64();
        Ok(self)
    }

    /// The mean time between events \[s\].
    fn recurrence(&self) -> f64 {
        match self.events[..] {
            [first, .., last] => (last - first) / (self.events.len() - 1) as f64,
            _ => f64::NAN,
        }
    }

    fn print(&self) {
        println!(
            "  {:<8} {:<22} motion {:<4} {:>6.0e}: {} events, {:.4?} s, every {:.4} s; {} steps, {:.2} s \
             {}",
            self.body,
            self.scheme,
            self.weight,
            self.tolerance,
            self.events.len(),
            self.events,
            self.recurrence(),
            self.steps,
            self.seconds,
            self.failure.as_deref().unwrap_or("")
        );
    }
}

pub(crate) fn write(all: &[Cycles], output: &Output) -> Result<(), Problem> {
    let columns = "body,scheme,motion,tolerance,events,first,last,recurrence,steps,seconds,failure";
    let rows = all.iter().map(|run| {
        let time = |time: Option<&f64>| digits(time.copied().unwrap_or(f64::NAN));
        [
            run.body.into(),
            run.scheme.into(),
            digits(run.weight),
            digits(run.tolerance),
            run.events.len().to_string(),
            time(run.events.first()),
            time(run.events.last()),
            digits(run.recurrence()),
            run.steps.to_string(),
            digits(run.seconds),
            run.failure.clone().unwrap_or_default(),
        ]
    });
    output.table("slow-cycles.csv", columns, rows)
}

/// The table of the report: errors against the reference of the same body.
pub(crate) fn table(all: &[Cycles]) -> Result<Table, Error> {
    let mut text = String::from(
        "| body | scheme | motion | tolerance | events | first \\[s\\] | last \\[s\\] | recurrence \
         \\[s\\] | steps | time \\[s\\] |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    let mut reference: &[f64] = &[];
    let mut recurrence = f64::NAN;
    for run in all {
        write!(
            text,
            "| {} | {} | {} | {:.0e} | {} |",
            run.body,
            run.scheme,
            run.weight,
            run.tolerance,
            run.events.len()
        )?;
        let (first, last) = (run.events.first(), run.events.last());
        if run.scheme == REFERENCE {
            (reference, recurrence) = (&run.events, run.recurrence());
            let at = |time: Option<&f64>| time.map_or("-".into(), |time| format!("{time:.3}"));
            write!(text, " {} | {} | {recurrence:.3} |", at(first), at(last))?;
        } else {
            let error = |time: Option<&f64>, known: Option<&f64>| match (time, known) {
                (Some(time), Some(known)) => format!("{:.1e}", (time - known).abs()),
                _ => "-".into(),
            };
            let same = run.events.len() == reference.len() && run.failure.is_none();
            let last = last.filter(|_| same);
            let every = Some(run.recurrence()).filter(|every| same && every.is_finite());
            write!(
                text,
                " {} | {} | {} |",
                error(first, reference.first()),
                error(last, reference.last()),
                error(every.as_ref(), Some(&recurrence))
            )?;
        }
        let gave_up = if run.failure.is_some() {
            ", gave up"
        } else {
            ""
        };
        writeln!(text, " {}{gave_up} | {:.2} |", run.steps, run.seconds)?;
    }
    let name = NAME.into();
    Ok(Table { name, text })
}
