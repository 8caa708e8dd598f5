//! The energy balance of a body.

use nalgebra::SVector;

use super::body_work::BodyWork;
use super::table::Entry;
use crate::Snapshot;

/// The energy balance of a body since the start of the ledger.
///
/// ```text
/// kinetic + elastic - start = loads + moved - friction - viscosity - left over
/// ```
///
/// Pass every step to [`record`](Self::record). The work of a force is that of its mean over both ends of a step,
///
/// ```text
/// sum over the steps of (u_n - u_o) . (g_n + g_o) / 2
/// ```
///
/// and that of the new force, `(u_n - u_o) . g_n`, where backward Euler takes a step with inertia, also in place of
/// another scheme where contact changes. Here `g` is the frictional force, `C v`, the reaction of driven components, or a
/// time-dependent load; constant loads need the ends alone. With the average acceleration of Newmark's scheme nothing is
/// left over: there `u_n - u_o = dt (v_n + v_o)/2` and `v_n - v_o = dt (a_n + a_o)/2`, so that the change of the energy is
/// the work of `M a + C v + A u`. The remainder contains the energy lost in impacts, the numerical damping of a scheme,
/// the jumps of accelerations and loads at declared stops, the curvature in time of prescribed velocities, and the error
/// of extrapolated or omitted steps.
///
/// Without inertia nothing is left over either, at any tolerance, for a symmetric stiffness matrix: errors of steps are
/// in the terms, not in their sum. Where the matrix is not symmetric, as for stress at the centres of cells in a half
/// space, `elastic` is the energy `u . A u / 2` of its symmetric part, and the remainder contains the work of its skew
/// part, an error of the cells: 6e-6 of the work of friction on a vertical plane of cells of 500 m, 2e-6 of 250 m.
///
/// Friction at a free vertex is the force that balances the body there; it equals that of the law to the solver's
/// tolerance. A step allocates nothing, and visits contacts and driven parts alone, unless the scene has a viscosity or
/// a time-dependent load. Energies are computed on demand.
///
/// ```
/// use stickslip::problems::spring_slider::{AGING, FRICTION, LoadPath, SpringSlider};
/// use stickslip::record::EnergyLedger;
/// use stickslip::{Newmark, Point, Simulation, Steps};
///
/// let load = LoadPath::steady(1e-5);
/// let slider = SpringSlider { stiffness: 1e8, normal_stress: 1e6, mass: 5e3, damping: 0.0, load };
/// let mut block = Simulation::new(slider.steady(FRICTION, AGING, 1e-6)?, Newmark::default(), Point)?;
/// let mut ledger = EnergyLedger::new(&block.snapshot());
/// block.run(&Steps::constant(0.01).until(20.0), |at| ledger.record(&at))?;
/// let balance = ledger.balance(&block.snapshot());
/// assert!(balance.friction > 1.0);
/// assert!(balance.left_over.abs() < 1e-9 * balance.friction);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyLedger<const C: usize> {
    /// The vertices of contacts and driven parts, increasing, and their components.
    vertices: Vec<usize>,
    roles: Vec<Roles<C>>,
    /// Their displacement after the last step \[m\].
    displacement: Vec<SVector<f64, C>>,
    /// The forces in balance with friction and reactions there: after this step, and as its scheme has it \[N\].
    unbalanced: [Vec<SVector<f64, C>>; 2],
    /// The places among them where a tangential component is driven, and the friction in it \[N\].
    dragged: Vec<(usize, SVector<f64, C>)>,
    body: Option<BodyWork<C>>,
    /// Kinetic and elastic energy, and work of the constant loads, at the start \[J\].
    start: [f64; 3],
    friction: f64,
    /// The dissipation of each viscosity.
    viscosities: Vec<f64>,
    viscosity: f64,
    loads: f64,
    moved: f64,
}

/// The components of a vertex as factors 0 and 1.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Roles<const C: usize> {
    /// The free components with friction.
    slides: SVector<f64, C>,
    moved: SVector<f64, C>,
}

/// The terms of an [`EnergyLedger`] [J; J/m in 2D].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Balance {
    /// The time \[s\].
    pub time: f64,
    /// The kinetic energy.
    pub kinetic: f64,
    /// The elastic energy.
    pub elastic: f64,
    /// The growth of both since the start.
    pub stored: f64,
    /// The energy dissipated by friction since the start.
    pub friction: f64,
    /// The energy dissipated by viscosity, also by absorbing boundaries; [`EnergyLedger::viscosities`] separates them.
    pub viscosity: f64,
    /// The work of loads, including normal tractions and the initial shear stress of a contact.
    pub loads: f64,
    /// The work of driven parts.
    pub moved: f64,
    /// The remainder: `loads + moved - friction - viscosity - stored`.
    pub left_over: f64,
}

impl Balance {
    /// The names of [`entries`](Self::entries), for a [`Table`](crate::record::Table).
    pub const COLUMNS: [&str; 9] = [
        "time",
        "kinetic",
        "elastic",
        "stored",
        "friction",
        "viscosity",
        "loads",
        "moved",
        "left_over",
    ];

    /// The values of the balance, in the order of the fields.
    pub fn entries(&self) -> [Entry; 9] {
        [
            self.time,
            self.kinetic,
            self.elastic,
            self.stored,
            self.friction,
            self.viscosity,
            self.loads,
            self.moved,
            self.left_over,
        ]
        .map(Entry::Number)
    }
}

/// The mean of a force at both ends of a step, with the share of the new one.
pub(super) fn mean<const C: usize>(
    old: SVector<f64, C>,
    new: SVector<f64, C>,
    share: f64,
) -> SVector<f64, C> {
    old * (1.0 - share) + new * share
}

impl<const C: usize> EnergyLedger<C> {
    /// Starts a ledger at a step, and allocates its memory.
    pub fn new(at: &Snapshot<'_, C>) -> Self {
        let source = at.source();
        let size = at.state().displacement.len();
        let mut slides = vec![[false; C]; size];
        for contact in &source.contacts().contacts {
            for (&vertex, own) in contact.part.vertices.iter().zip(&contact.slides) {
                slides[vertex] = *own;
            }
        }
        let (mut vertices, mut roles, mut dragged) = (Vec::new(), Vec::new(), Vec::new());
        let factors =
            |is: &dyn Fn(usize) -> bool| SVector::from_fn(|c, _| f64::from(u8::from(is(c))));
        for vertex in 0..size {
            let fixed = |c: usize| source.is_fixed(vertex, c);
            let moves = |c: usize| source.is_moved(vertex, c);
            let free = |c: usize| slides[vertex][c] && !fixed(c);
            if !(0..C).any(|c| free(c) || moves(c)) {
                continue;
            }
            if (0..C).any(|c| slides[vertex][c] && moves(c)) {
                dragged.push((vertices.len(), SVector::zeros()));
            }
            vertices.push(vertex);
            roles.push(Roles {
                slides: factors(&free),
                moved: factors(&moves),
            });
        }
        let mut unbalanced = [(); 2].map(|()| vec![SVector::zeros(); vertices.len()]);
        source.unbalanced_at(&vertices, &mut unbalanced[0]);
        let [kinetic, elastic] = source.energies();
        let mut ledger = Self {
            displacement: vertices
                .iter()
                .map(|&i| at.state().displacement[i])
                .collect(),
            vertices,
            roles,
            unbalanced,
            dragged,
            body: BodyWork::new(at),
            start: [
                kinetic,
                elastic,
                source.loads().constant_work(&at.state().displacement),
            ],
            friction: 0.0,
            viscosities: Vec::new(),
            viscosity: 0.0,
            loads: 0.0,
            moved: 0.0,
        };
        if let Some(body) = ledger.body.as_mut().filter(|body| body.is_viscous) {
            let several = (0..).take_while(|&n| {
                source
                    .matrices()
                    .add_viscous_force_of(n, &at.state().velocity, &mut body.force)
            });
            ledger.viscosities = vec![0.0; several.count().max(1)];
        }
        for k in 0..ledger.dragged.len() {
            ledger.dragged[k].1 = ledger.drag(at, k);
        }
        ledger
    }

    /// Friction in the driven components, at a place with a driven tangential component \[N\].
    fn drag(&self, at: &Snapshot<'_, C>, k: usize) -> SVector<f64, C> {
        let place = self.dragged[k].0;
        let friction = at.sliding_force(self.vertices[place]);
        friction.component_mul(&self.roles[place].moved)
    }

    /// Records the step shown.
    pub fn record(&mut self, at: &Snapshot<'_, C>) {
        let source = at.source();
        let share = source.work_share();
        for k in 0..self.dragged.len() {
            let (friction, (place, old)) = (self.drag(at, k), self.dragged[k]);
            let moved = at.state().displacement[self.vertices[place]] - self.displacement[place];
            let work = moved.dot(&mean(old, friction, share));
            self.friction += work;
            self.moved += work;
            self.dragged[k].1 = friction;
        }
        let [old, new] = &mut self.unbalanced;
        source.unbalanced_at(&self.vertices, new);
        let (mut friction, mut moved) = (0.0, 0.0);
        for (i, &vertex) in self.vertices.iter().enumerate() {
            let now = at.state().displacement[vertex];
            let work = (now - self.displacement[i]).component_mul(&mean(old[i], new[i], share));
            friction += work.dot(&self.roles[i].slides);
            moved += work.dot(&self.roles[i].moved);
            self.displacement[i] = now;
        }
        self.friction += friction;
        // What holds a part up is the opposite of what it has to balance.
        self.moved -= moved;
        source.unbalanced_behind_impact(&self.vertices, new);
        self.unbalanced.swap(0, 1);
        if let Some(body) = &mut self.body {
            let [viscosity, loads] = body.work(at, share, &mut self.viscosities);
            self.viscosity += viscosity;
            self.loads += loads;
        }
    }

    /// The energy dissipated by each viscosity of the scene since the start [J; J/m in 2D], in the order in which they
    /// were given: absorbing boundaries and the body itself, if they were given one by one.
    pub fn viscosities(&self) -> &[f64] {
        &self.viscosities
    }

    /// The balance at a step, which must be the last one recorded.
    pub fn balance(&self, at: &Snapshot<'_, C>) -> Balance {
        let source = at.source();
        let [kinetic, elastic] = source.energies();
        let [kinetic_start, elastic_start, work_start] = self.start;
        let constant = source.loads().constant_work(&at.state().displacement) - work_start;
        let stored = (kinetic - kinetic_start) + (elastic - elastic_start);
        let loads = self.loads + constant;
        let (friction, viscosity, moved) = (self.friction, self.viscosity, self.moved);
        Balance {
            time: at.time,
            kinetic,
            elastic,
            stored,
            friction,
            viscosity,
            loads,
            moved,
            left_over: loads + moved - friction - viscosity - stored,
        }
    }
}
