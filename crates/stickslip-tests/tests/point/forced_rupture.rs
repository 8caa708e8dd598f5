//! Friction that weakens by the larger of slip and time, on blocks whose motion is known in closed form.

use nalgebra::SMatrix;
use stickslip::friction::{ForcedRupture, LinearWeakening};
use stickslip::state::{SlipWeakening, Weakening};
use stickslip::{
    BackwardEuler, BoundaryPart, CentralDifferences, Contact, GeneralizedAlpha, Newmark, Point,
    RungeKutta, Scene, SceneError, Simulation, Steps,
};

use crate::Outcome;

type Operator = SMatrix<f64, 1, 1>;

const NORMAL: f64 = 1e6;

/// A block under a constant pull on a spring, with viscosity or mass.
#[derive(Debug, Clone, Copy)]
struct Block {
    law: LinearWeakening,
    slip_distance: f64,
    forced: ForcedRupture,
    /// \[Pa\], and \[Pa/m\].
    pull: f64,
    spring: f64,
    /// \[Pa s/m\]
    viscosity: f64,
}

/// `t*`, at which forced weakening lets the block go, and the rate of its strength from then on [Pa/s].
fn release(block: &Block) -> [f64; 2] {
    let drop = NORMAL * (block.law.static_friction - block.law.dynamic_friction);
    let missing = NORMAL * block.law.static_friction - block.pull;
    let forced = &block.forced;
    [
        forced.rupture_time + forced.duration * missing / drop,
        drop / forced.duration,
    ]
}

impl Block {
    fn contact(&self) -> Contact<LinearWeakening, SlipWeakening, 1> {
        let slip = SlipWeakening {
            slip_distance: self.slip_distance,
        };
        Contact::new(BoundaryPart::point(1.0), self.law, NORMAL)
            .with_state(slip, Weakening(0.0))
            .with_forced_rupture(self.forced)
    }

    fn scene(&self) -> Scene<Operator, 1> {
        let pull = self.pull;
        Scene::new(Operator::new(self.spring))
            .with_viscosity(Operator::new(self.viscosity))
            .with_contact(self.contact())
            .with_load_history(move |_, load| load[0][0] = pull)
    }

    /// The slip of a block without mass, first by `f_2`, by `f_1` from where it is larger, and then at the dynamic
    /// strength: three linear equations.
    fn slip(&self, time: f64) -> f64 {
        let [start, rate] = release(self);
        if time <= start {
            return 0.0;
        }
        let drop = NORMAL * (self.law.static_friction - self.law.dynamic_friction);
        let relax = self.spring / self.viscosity;
        // D' = -relax D + rate s/viscosity.
        let forced = |time: f64| {
            let s = time - start;
            rate / self.viscosity * (relax * s - 1.0 + (-relax * s).exp()) / (relax * relax)
        };
        let ahead = |time: f64| forced(time) / self.slip_distance - self.forced.weakening(time).0;
        let end = self.forced.rupture_time + self.forced.duration;
        // D' = k D + b, to a time.
        let linear = |k: f64, b: f64, (from, slip): (f64, f64), to: f64| {
            let grown = (k * (to - from)).exp();
            slip * grown + b * (grown - 1.0) / k
        };
        let dynamic = (self.pull - NORMAL * self.law.dynamic_friction) / self.viscosity;
        if ahead(end) <= 0.0 {
            // The forced rupture is over before slip has weakened the contact as much.
            if time <= end {
                return forced(time);
            }
            return linear(-relax, dynamic, (end, forced(end)), time);
        }
        let bisect = |mut low: f64, mut high: f64, above: &dyn Fn(f64) -> bool| {
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if above(middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            high
        };
        let overtaken = bisect(start, end, &|time| ahead(time) > 0.0);
        if time <= overtaken {
            return forced(time);
        }
        let grows = drop / (self.slip_distance * self.viscosity) - relax;
        let pulled = (self.pull - NORMAL * self.law.static_friction) / self.viscosity;
        let from = (overtaken, forced(overtaken));
        let weakens = |time: f64| linear(grows, pulled, from, time);
        let weak = bisect(overtaken, end, &|time| weakens(time) > self.slip_distance);
        if time <= weak {
            return weakens(time);
        }
        linear(-relax, dynamic, (weak, weakens(weak)), time)
    }
}

/// Blocks of random parameters, whose forced rupture is caught up by slip in some.
fn blocks() -> impl Iterator<Item = Block> {
    let mut seed = 0x1234_5678_9abc_def1_u64;
    let mut random = move |low: f64, high: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..20).map(move |_| {
        let law = LinearWeakening {
            static_friction: random(0.5, 0.7),
            dynamic_friction: random(0.1, 0.3),
        };
        let drop = NORMAL * (law.static_friction - law.dynamic_friction);
        let slip_distance = random(0.05, 0.4);
        Block {
            law,
            slip_distance,
            forced: ForcedRupture {
                rupture_time: random(0.0, 0.5),
                duration: random(0.3, 0.8),
            },
            pull: NORMAL * law.static_friction - random(0.1, 0.8) * drop,
            spring: random(0.05, 0.5) * drop / slip_distance,
            viscosity: random(0.2, 1.0) * drop,
        }
    })
}

/// By an adaptive method of order 5, and by constant implicit steps, whose error falls with the square of the step.
#[test]
fn a_block_slips_by_the_closed_form() -> Outcome {
    let mut caught_up = 0;
    for block in blocks() {
        let end = block.forced.rupture_time + 1.5 * block.forced.duration;
        let exact = block.slip(end);
        let halfway = block.forced.rupture_time + block.forced.duration;
        caught_up += usize::from(block.slip(halfway) > block.slip_distance);

        let by_tolerance = |tolerance: f64| -> Outcome<f64> {
            let mut explicit = RungeKutta::new(block.scene())?;
            let steps = Steps::adaptive(tolerance).stopping_at([block.forced.rupture_time]);
            explicit.run(&steps.until(end), |at| {
                let own = at.contact(0);
                let weakened = own.slip(0) / block.slip_distance;
                assert!((own.state(0) - weakened).abs() <= 1e-12 * weakened);
            })?;
            Ok((explicit.snapshot().contact(0).slip(0) / exact - 1.0).abs())
        };
        // The sum of the errors of all steps, some hundreds.
        let [coarse, fine] = [by_tolerance(1e-5)?, by_tolerance(1e-8)?];
        assert!(fine < 1e-5 && coarse < 1e-2, "{coarse} {fine} {block:?}");

        let by_steps = |count: usize| -> Outcome<f64> {
            let mut implicit = Simulation::new(block.scene(), GeneralizedAlpha::default(), Point)?;
            implicit.run(&Steps::constant(end / count as f64).count(count), |_| ())?;
            Ok((implicit.snapshot().contact(0).slip(0) / exact - 1.0).abs())
        };
        let [coarse, fine] = [by_steps(200)?, by_steps(1600)?];
        // 64 times at second order; the kinks of the ramp fall anywhere between two steps.
        assert!(
            fine < 1e-4 && (fine < coarse / 16.0 || coarse < 1e-5),
            "{coarse} {fine} {block:?}"
        );
    }
    assert!((3..18).contains(&caught_up), "{caught_up}");
    Ok(())
}

/// `m D'' + k D` is the growing pull: `a/omega^2 (s - sin(omega s)/omega)`, by implicit and by explicit steps.
#[test]
fn a_block_with_mass_accelerates_by_the_closed_form() -> Outcome {
    for block in blocks() {
        let block = Block {
            viscosity: 0.0,
            // Slip weakens it by 1e-8.
            slip_distance: 1e8,
            spring: 2.0 * block.spring,
            ..block
        };
        let mass = 0.3 * block.spring;
        let [start, rate] = release(&block);
        let end = block.forced.rupture_time + block.forced.duration;
        let omega = (block.spring / mass).sqrt();
        let s = end - start;
        let exact = rate / block.spring * (s - (omega * s).sin() / omega);
        let scene = || block.scene().with_mass(Operator::new(mass));
        let steps = Steps::constant(end / 4000.0).count(4000);
        let mut implicit = Simulation::new(scene(), Newmark::default(), Point)?;
        implicit.run(&steps, |_| ())?;
        let mut explicit = Simulation::new(scene(), CentralDifferences, Point)?;
        explicit.run(&steps, |_| ())?;
        for at in [implicit.snapshot(), explicit.snapshot()] {
            let slip = at.contact(0).slip(0);
            assert!(
                (slip / exact - 1.0).abs() < 1e-5,
                "{slip} {exact} {block:?}"
            );
        }
    }
    Ok(())
}

/// A block on a spring without mass or viscosity is where the spring balances the strength of the very time, whatever
/// the steps: the time is no sum of steps.
#[test]
fn the_time_is_that_of_the_step() -> Outcome {
    let block = Block {
        law: LinearWeakening {
            static_friction: 0.6,
            dynamic_friction: 0.2,
        },
        slip_distance: 1e9,
        forced: ForcedRupture {
            rupture_time: 0.7,
            duration: 0.5,
        },
        pull: 0.6 * NORMAL,
        spring: 1e6,
        viscosity: 0.0,
    };
    let mut at_rest = Simulation::new(block.scene(), BackwardEuler, Point)?;
    for k in 0..100 {
        at_rest.step(0.02 * (1.0 + 0.5 * f64::from(k).sin()))?;
        let at = at_rest.snapshot();
        let fallen = ((at.time - 0.7) / 0.5).clamp(0.0, 1.0);
        let block = at.contact(0);
        assert!((block.slip(0) - 0.4 * fallen).abs() < 1e-9, "{}", at.time);
        assert!((block.coefficient(0) - (0.6 - 0.4 * fallen)).abs() < 1e-9);
    }
    Ok(())
}

/// Adaptive implicit steps find the ramp behind a stop.
#[test]
fn adaptive_steps_resolve_the_ramp() -> Outcome {
    for block in blocks().take(6) {
        let end = block.forced.rupture_time + 1.5 * block.forced.duration;
        let mut implicit = Simulation::new(block.scene(), GeneralizedAlpha::default(), Point)?;
        let steps = Steps::adaptive(1e-5).stopping_at([block.forced.rupture_time]);
        implicit.run(&steps.until(end), |_| ())?;
        let slip = implicit.snapshot().contact(0).slip(0);
        assert!((slip / block.slip(end) - 1.0).abs() < 1e-3, "{block:?}");
    }
    Ok(())
}

/// A run goes on from the middle of the ramp by the same bits, and not with another rupture.
#[test]
fn a_run_goes_on_from_the_ramp() -> Outcome {
    use crate::checkpoint::Place;
    use stickslip::Checkpoint;
    use stickslip::record::FileError;

    let place = Place::new("forced")?;
    let block = blocks().next().ok_or("a block")?;
    let of = |block: Block| Simulation::new(block.scene(), GeneralizedAlpha::default(), Point);
    let dt = block.forced.duration / 32.0;
    let until = block.forced.rupture_time + 0.75 * block.forced.duration;
    let mut whole = of(block)?;
    whole.run(&Steps::constant(dt).until(until), |_| ())?;
    let file = Checkpoint::at(place.file("ramp"));
    file.save(&whole.snapshot(), &())?;
    let mut other = of(block)?;
    file.restore::<(), 1>(&mut other)?;
    for simulation in [&mut whole, &mut other] {
        simulation.run(&Steps::constant(dt).count(40), |_| ())?;
    }
    let slips = [&whole, &other].map(|own| own.snapshot().contact(0).slip(0).to_bits());
    assert!(slips[0] == slips[1] && whole.snapshot().contact(0).slip(0) > 0.0);

    let later = ForcedRupture {
        rupture_time: block.forced.rupture_time + 0.1,
        ..block.forced
    };
    let mut late = of(Block {
        forced: later,
        ..block
    })?;
    let refused = file.restore::<(), 1>(&mut late);
    let named = |error: &FileError| error.to_string().contains("forced rupture of contact 0");
    assert!(refused.as_ref().is_err_and(named), "{refused:?}");
    Ok(())
}

#[test]
fn bad_ruptures_are_refused() -> Outcome {
    let block = blocks().next().ok_or("a block")?;
    let refused = |contact: Contact<LinearWeakening, SlipWeakening, 1>| {
        let scene = Scene::new(Operator::new(1.0)).with_contact(contact);
        Simulation::new(scene, Newmark::default(), Point).err()
    };
    let good = block.forced;
    for (rupture_time, duration) in [
        (f64::NAN, 0.5),
        (1.0, 0.0),
        (1.0, -0.5),
        (1.0, f64::NAN),
        (1.0, f64::INFINITY),
    ] {
        let forced = ForcedRupture {
            rupture_time,
            duration,
        };
        let bad = Block { forced, ..block };
        assert!(matches!(
            refused(bad.contact()),
            Some(SceneError::Friction(_))
        ));
    }
    let twice = refused(block.contact().with_forced_rupture(good));
    assert!(matches!(
        twice,
        Some(SceneError::Repeated {
            what: "forced rupture"
        })
    ));
    let two = Block { ..block };
    let slip = SlipWeakening { slip_distance: 0.1 };
    let of_two = Contact::new(BoundaryPart::point(1.0), two.law, NORMAL)
        .with_state(slip, Weakening(0.0))
        .with_forced_rupture(vec![good, good]);
    assert!(matches!(
        refused(of_two),
        Some(SceneError::Length {
            expected: 1,
            found: 2,
            ..
        })
    ));
    Ok(())
}
