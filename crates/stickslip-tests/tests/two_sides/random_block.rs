//! Blocks of random size, cells, material, contacts and rollers.

use stickslip::fem::{Elastic, P1, Trace, elasticity};
use stickslip::friction::Tresca;
use stickslip::{
    BlockMatrix, Condensed, Contact, GeneralizedAlpha, NormalStress, Scene, Simulation,
};

use crate::Outcome;

/// Random numbers of a linear congruential generator.
pub(super) struct Random(pub(super) u64);

impl Random {
    /// A number in `[low, high)`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number from 0 on.
    pub(super) fn below(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }
}

/// A block on a plane, of random size, cells and material, whose foot is one to three contacts, with rollers on some of
/// its sides.
pub(super) struct Block<const D: usize> {
    pub(super) space: P1<D>,
    pub(super) height: f64,
    pub(super) elastic: Elastic,
    /// The contacts, with their pre-stress \[Pa\].
    pub(super) feet: Vec<(Trace<D>, f64)>,
    pub(super) rollers: Vec<(Trace<D>, usize)>,
    pub(super) coefficient: f64,
}

impl<const D: usize> Block<D> {
    pub(super) fn new(
        random: &mut Random,
        on_rollers: impl Fn(&mut Random) -> bool,
    ) -> Outcome<Self> {
        let size: [f64; D] = std::array::from_fn(|_| random.between(0.5, 2.0));
        let cells: [usize; D] = std::array::from_fn(|_| 1 + random.below(2));
        let cells = std::array::from_fn(|c| if c == 0 { 3 } else { cells[c] });
        let space = P1::<D>::grid(size, cells)?.refined(1)?;
        let mut columns: Vec<f64> = space.mesh().vertices().iter().map(|x| x[0]).collect();
        columns.sort_by(f64::total_cmp);
        columns.dedup();
        let inner = &columns[1..columns.len() - 1];
        let mut cuts: Vec<f64> = (0..random.below(3))
            .map(|_| inner[random.below(inner.len())])
            .collect();
        cuts.extend([0.0, size[0]]);
        cuts.sort_by(f64::total_cmp);
        cuts.dedup();
        let feet = cuts.windows(2).map(|ends| {
            let foot = space.trace(|x| x[D - 1] == 0.0 && (ends[0]..=ends[1]).contains(&x[0]))?;
            Ok((foot, 0.0))
        });
        let feet = feet.collect::<Outcome<Vec<_>>>()?;
        let mut rollers = Vec::new();
        for axis in 0..D - 1 {
            for at in [0.0, size[axis]] {
                if on_rollers(random) {
                    rollers.push((space.trace(|x| x[axis] == at)?, axis));
                }
            }
        }
        Ok(Self {
            space,
            height: size[D - 1],
            elastic: Elastic {
                young_modulus: 10_f64.powf(random.between(6.0, 10.0)),
                poisson_ratio: random.between(0.0, 0.4),
            },
            feet,
            rollers,
            coefficient: random.between(0.0, 0.4),
        })
    }

    /// The stress of a uniaxial strain of 1 \[Pa\].
    pub(super) fn modulus(&self) -> f64 {
        let Elastic {
            young_modulus,
            poisson_ratio: nu,
        } = self.elastic;
        young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// The block with a top of this velocity, along the axes without rollers.
    pub(super) fn simulation(
        &self,
        opens: impl Fn(usize) -> bool,
        velocity: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) -> Outcome<Simulation<D>> {
        Ok(Simulation::new(
            self.scene(opens, velocity)?,
            GeneralizedAlpha::default(),
            Condensed::new(),
        )?)
    }

    /// The scene of that simulation.
    pub(super) fn scene(
        &self,
        opens: impl Fn(usize) -> bool,
        velocity: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) -> Outcome<Scene<BlockMatrix<D>, D>> {
        let top = self.space.trace(|x| x[D - 1] == self.height)?;
        let along: [bool; D] =
            std::array::from_fn(|c| self.rollers.iter().all(|&(_, axis)| axis != c));
        let mut scene = Scene::new(elasticity(&self.space, &self.elastic)?)
            .prescribe_velocity(&top, along, velocity);
        for (side, axis) in &self.rollers {
            let along: [bool; D] = std::array::from_fn(|c| c == *axis);
            scene = scene.fix(side, along);
        }
        for (index, (foot, stress)) in self.feet.iter().enumerate() {
            let law = Tresca {
                coefficient: self.coefficient,
            };
            let contact = Contact::new(foot, law, NormalStress::from_body(*stress));
            scene = scene.with_contact(match opens(index) {
                true => contact.allow_opening(),
                false => contact,
            });
        }
        Ok(scene)
    }
}
