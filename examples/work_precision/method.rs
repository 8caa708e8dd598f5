//! The methods that are compared on bodies, and the event by whose time they are judged.

use stickslip::fem::{P1, lumped_mass};
use stickslip::friction::DieterichRuina;
use stickslip::state::Dieterich;
use stickslip::{
    Adaptive, BackwardEuler, BlockMatrix, CentralDifferences, Condensed, Diagonal, Events,
    FixedPoint, GeneralizedAlpha, InterfacePotential, Measurement, Monolithic, Newmark,
    NonsmoothSolver, RateScheme, Scene, SceneError, Sdirk2, Simulation, Snapshot, Staggered,
    StateUpdate, Stepper, Tnnmg, WorkPrecision,
};

use crate::common::cli::Problem;
use crate::study::Effort;

/// A body with its friction, at rest.
pub(crate) type Body<const C: usize> = Scene<BlockMatrix<C>, DieterichRuina, Dieterich, C>;
type AnySolver<const C: usize> =
    Box<dyn NonsmoothSolver<BlockMatrix<C>, InterfacePotential<DieterichRuina, Dieterich>, C>>;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scheme {
    Newmark,
    BackwardEuler,
    Sdirk2,
    /// With a spectral radius of 0.8.
    GeneralizedAlpha,
    /// With a lumped mass, a diagonal solver and the staggered coupling, whatever else is chosen.
    CentralDifferences,
}

/// A way to go through time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Method {
    pub(crate) scheme: Scheme,
    pub(crate) update: StateUpdate,
    pub(crate) monolithic: bool,
    pub(crate) tnnmg: bool,
    /// Adapt the step; the setting then is the tolerance, else the step \[s\].
    pub(crate) adaptive: bool,
}

/// Newmark's scheme with the midpoint state, rate and state at once, condensed.
pub(crate) const PLAIN: Method = Method {
    scheme: Scheme::Newmark,
    update: StateUpdate::Midpoint,
    monolithic: true,
    tnnmg: false,
    adaptive: false,
};
/// The pairing of the paper, rate and state at once, condensed.
pub(crate) const PAPER: Method = Method {
    update: StateUpdate::BackwardEuler,
    ..PLAIN
};
pub(crate) const EXPLICIT: Method = Method {
    scheme: Scheme::CentralDifferences,
    ..PLAIN
};
/// Newmark's scheme with steps that adapt.
pub(crate) const ADAPTIVE: Method = Method {
    adaptive: true,
    ..PLAIN
};

/// The schemes of second order that are compared at constant and at adaptive steps, by name.
pub(crate) const SECOND_ORDER: [(&str, Scheme); 3] = [
    ("Newmark", Scheme::Newmark),
    ("generalised-alpha", Scheme::GeneralizedAlpha),
    ("Sdirk2", Scheme::Sdirk2),
];

/// What is asked of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Wanted {
    /// The time at which the vertex slips for so many times \[s\].
    Slip(usize),
    /// The logarithm of its largest slip rate.
    Peak,
}

/// How an adaptive run went.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Steps {
    /// Accepted until the first slip, and after it.
    pub(crate) before: usize,
    pub(crate) after: usize,
    /// The time that each of these took \[s\].
    pub(crate) span_before: f64,
    pub(crate) span_after: f64,
    /// The largest step after the first slip \[s\].
    pub(crate) largest_after: f64,
    pub(crate) rejected: usize,
}

/// When does this vertex slip, or how fast?
pub(crate) struct Question<'a, const C: usize> {
    pub(crate) space: &'a P1<2>,
    pub(crate) density: f64,
    pub(crate) scene: Box<dyn Fn() -> Result<Body<C>, SceneError> + 'a>,
    pub(crate) vertex: usize,
    pub(crate) wanted: Wanted,
    /// The slip rate that counts as slip [m/s].
    pub(crate) slip: f64,
    /// A kink of the data, at which a step must end \[s\].
    pub(crate) kink: f64,
    /// Steps that adapt begin with this \[s\].
    pub(crate) first_step: f64,
    /// Where adaptive and constant steps give up to wait for slip \[s\].
    pub(crate) until: [f64; 2],
}

impl<const C: usize> Question<'_, C> {
    /// What is wanted, by a method at a step size or tolerance.
    pub(crate) fn answer(&self, method: Method, setting: f64) -> Result<f64, Problem> {
        let mut body = self.stepper(method)?;
        let mut slips = Events::new(self.slip, self.slip);
        let mut peak: f64 = 0.0;
        let mut observe = |at: Snapshot<'_, C>| {
            let rate = at.velocity[self.vertex].norm();
            slips.record(at.time, rate);
            peak = peak.max(rate);
            self.wanted == Wanted::Slip(slips.times().len())
        };
        if method.adaptive {
            self.adaptive(setting)
                .run(&mut *body, self.until[0], &mut |at| {
                    observe(at);
                })?;
        } else {
            for _ in 0..(self.until[1] / setting).ceil() as usize {
                body.step(setting)?;
                if observe(body.snapshot()) {
                    break;
                }
            }
        }
        match self.wanted {
            Wanted::Peak => Ok(peak.ln()),
            Wanted::Slip(count) => {
                let time = slips.times().get(count.wrapping_sub(1)).copied();
                time.ok_or_else(|| {
                    let (found, until) = (slips.times().len(), body.snapshot().time);
                    format!("slip number {found} is the last until {until} s").into()
                })
            }
        }
    }

    /// Each scheme of second order at tolerances and at constant steps.
    pub(crate) fn adaptive_and_constant(
        &self,
        reference: f64,
        effort: Effort,
        tolerances: &[f64],
        steps: &[f64],
    ) -> Vec<Measurement> {
        let mut table = WorkPrecision::against(reference).with_runs(effort.runs);
        for (name, scheme) in SECOND_ORDER {
            for (way, method, settings) in [
                ("adaptive", ADAPTIVE, tolerances),
                ("constant steps", PLAIN, steps),
            ] {
                let method = Method { scheme, ..method };
                let settings = effort.settings(settings);
                table = table.method(&format!("{name}, {way}"), settings, |setting| {
                    self.answer(method, setting)
                });
            }
        }
        table.finish()
    }

    /// The steps of an adaptive run until the vertex first slips, and from there to the end.
    pub(crate) fn steps(
        &self,
        method: Method,
        tolerance: f64,
        until: f64,
    ) -> Result<Steps, Problem> {
        let mut body = self.stepper(method)?;
        let mut slips = Events::new(self.slip, self.slip);
        let mut steps = Steps::default();
        let mut last = 0.0;
        let report = self.adaptive(tolerance).run(&mut *body, until, &mut |at| {
            slips.record(at.time, at.velocity[self.vertex].norm());
            let dt = at.time - last;
            last = at.time;
            if slips.times().is_empty() {
                steps.before += 1;
                steps.span_before = at.time;
            } else {
                steps.after += 1;
                steps.span_after = at.time - steps.span_before;
                steps.largest_after = steps.largest_after.max(dt);
            }
        })?;
        steps.rejected = report.rejected;
        Ok(steps)
    }

    fn adaptive(&self, tolerance: f64) -> Adaptive {
        Adaptive::new(tolerance)
            .with_first_step(self.first_step)
            .with_quantised_steps()
            .with_stops([self.kink])
            .with_max_steps(1_000_000)
    }

    fn stepper(&self, method: Method) -> Result<Box<dyn Stepper<C>>, Problem> {
        let scene = (self.scene)()?;
        let tnnmg = || Box::new(Tnnmg::new(self.space.hierarchy().prolongations()));
        let solver: AnySolver<C> = if method.tnnmg {
            tnnmg()
        } else {
            Box::new(Condensed::new())
        };
        Ok(match method.scheme {
            Scheme::Newmark => in_time(method, scene, Newmark::default(), solver)?,
            Scheme::BackwardEuler => in_time(method, scene, BackwardEuler, solver)?,
            Scheme::Sdirk2 => in_time(method, scene, Sdirk2, solver)?,
            Scheme::GeneralizedAlpha => {
                let scheme = GeneralizedAlpha {
                    spectral_radius: 0.8,
                };
                in_time(method, scene, scheme, solver)?
            }
            Scheme::CentralDifferences => {
                let scene = scene
                    .with_mass(lumped_mass(self.space, self.density)?)
                    .balanced_by(&mut *tnnmg())?;
                in_time(method, scene, CentralDifferences, Box::new(Diagonal::new()))?
            }
        })
    }
}

fn in_time<R: RateScheme + 'static, const C: usize>(
    method: Method,
    scene: Body<C>,
    scheme: R,
    solver: AnySolver<C>,
) -> Result<Box<dyn Stepper<C>>, SceneError> {
    let simulation = Simulation::new(scene, scheme, solver)?.with_state_update(method.update);
    Ok(match (method.scheme, method.monolithic) {
        (Scheme::CentralDifferences, _) => Box::new(simulation.with_coupling(Staggered::default())),
        (_, true) => Box::new(simulation.with_coupling(Monolithic::default())),
        (_, false) => Box::new(simulation.with_coupling(FixedPoint::paper())),
    })
}
