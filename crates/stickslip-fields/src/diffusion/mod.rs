//! Pore pressure that diffuses along a fault.

mod cells;
mod conjugate_gradients;
mod couplings;
mod dilatancy;
mod error;
mod estimate;
mod exchange;
mod faces;
mod field;
mod fourth_order;
mod gaussian;
mod hydraulics;
mod injection;
mod leak_off;
mod line;
mod line_solver;
mod memory;
mod multigrid;
mod network;
mod network_solver;
mod permeability;
mod plane;
mod plane_solver;
mod pool;
mod rate_history;
#[cfg(feature = "csv")]
mod rate_table;
mod readings;
mod side;
mod sides;
mod step;
mod system;
mod tr_bdf2;
mod transform;
mod well;
mod work;

pub use cells::{Cells, Place};
pub use dilatancy::Dilatancy;
pub use error::DiffusionError;
pub use gaussian::GaussianSource;
pub use hydraulics::Hydraulics;
pub use leak_off::LeakOff;
pub use line::Line;
pub use network::{Edge, Network};
pub use permeability::PermeabilityEvolution;
pub use plane::Plane;
pub use rate_history::RateHistory;
pub use side::{Boundary, Side};
pub use well::Well;

use hydraulics::Properties;
use leak_off::Leak;
use memory::Places;
use permeability::Evolution;
use pool::Pool;
use side::{Inflow, Outlet};
use system::Conductances;
use well::Injection;

use crate::{PerVertex, Reading};

/// Pore pressure that diffuses along a fault zone, with wells.
///
/// ```text
/// beta phi w_h p' = div( w_h (k/eta_f) grad p ) + Q delta + q - w_h phi' - beta phi w_h (p - p_inf)/t_d
/// ```
///
/// `p` is the change of pore pressure \[Pa\]. Cells are finite volumes: faces conduct as the harmonic mean of both
/// cells, so that volume is conserved. Steps are TR-BDF2: L-stable, of second order, with an estimated error that error
/// control sees as a pressure. Sides are sealed unless said otherwise.
///
/// # What the contact sees
/// Vertex `k` has the pressure of cell `k`, those of a trace of the cell at its position;
/// [`with_vertices`](Self::with_vertices) chooses others. Slip feeds it only through permeability
/// ([`with_permeability_evolution`](Self::with_permeability_evolution)) and dilatancy
/// ([`with_dilatancy`](Self::with_dilatancy)). The times at which the rates of wells jump or bend are stops.
///
/// # Cost
/// Per cell and step on one core: on a line some 13 ns, with permeability that changes 40; its estimated error 7 more. On
/// a plane whose properties change down dip alone 31 ns: a cosine or sine transform along strike and elimination down
/// dip. On others conjugate gradients with multigrid take 8 to 20 iterations of 36 ns in both stages where properties of
/// any contrast change smoothly, some 35 where they change by a factor of 1000 from cell to cell. On a network conjugate
/// gradients take a number of iterations that grows as the distance over which fluid diffuses in a step, in cells.
///
/// ```
/// use stickslip_fields::{Diffusion, FaultField, Hydraulics, Line, RateHistory, Well};
///
/// // Injection at the middle of a fault for 100 days; diffusivity .1 m^2/s.
/// let day = 86_400.0;
/// let line = Line::uniform([-20e3, 20e3], 4001)?;
/// let zone = Hydraulics {
///     permeability: 1e-13.into(),
///     viscosity: 1e-3.into(),
///     storage: 1e-9.into(),
///     thickness: 1.0.into(),
/// };
/// let rates = RateHistory::constant_between(&[(0.0, 1.25e-6), (100.0 * day, 0.0)])?;
/// let diffusion = Diffusion::new(line, &zone)?.with_well(Well::new(0.0, rates))?;
/// assert_eq!(diffusion.stops(), [100.0 * day]);
/// # Ok::<(), stickslip_fields::DiffusionError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("fluid injection", "pore pressure", "Darcy flow", "finite volumes"))]
pub struct Diffusion {
    cells: Cells,
    properties: Properties,
    /// The lengths or areas of cells.
    sizes: Vec<f64>,
    /// `beta phi w_h` times the size of each cell: the volume per pressure.
    capacity: Vec<f64>,
    /// The conductances, constant unless permeability evolves.
    conductances: Conductances,
    sides: [Boundary; 4],
    outlets: Vec<Outlet>,
    inflows: Vec<Inflow>,
    injections: Vec<Injection>,
    evolution: Option<Evolution>,
    dilatancy: Option<Dilatancy>,
    leak: Option<Leak>,
    /// Whether flow is of fourth order in the size of cells.
    fourth_order: bool,
    begin: f64,
    /// The initial pressures of cells.
    initial: Vec<f64>,
    stored_at_start: f64,
    /// The cell of each vertex of the contact, and the vertex of each cell.
    cell_of: Vec<usize>,
    vertex_of: Vec<Option<usize>>,
    places: Places,
    readings: Vec<Reading>,
    totals: Vec<Reading>,
    pool: Pool,
}

impl Diffusion {
    /// Diffusion on cells with these hydraulic properties, from no change of pressure at time 0.
    ///
    /// # Errors
    /// [`DiffusionError`] for properties out of their ranges, with their cell, and for another number of them.
    pub fn new(cells: impl Into<Cells>, hydraulics: &Hydraulics) -> Result<Self, DiffusionError> {
        let cells = cells.into();
        let (vertices, sizes) = (cells.vertices(), cells.sizes());
        let properties = hydraulics.properties(&vertices)?;
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect();
        let mut conductances = Conductances {
            mobility: product(&properties.permeability, &properties.per_permeability),
            faces: vec![0.0; cells.faces()],
            connected: false,
        };
        conductances.update(&cells);
        let count = cells.count();
        let mut cell_of = vec![0; count];
        for (cell, &vertex) in vertices.iter().enumerate() {
            cell_of[vertex] = cell;
        }
        let mut diffusion = Self {
            capacity: product(&properties.storage, &sizes),
            sizes,
            properties,
            conductances,
            sides: [Boundary::Sealed; 4],
            outlets: Vec::new(),
            inflows: Vec::new(),
            injections: Vec::new(),
            evolution: None,
            dilatancy: None,
            leak: None,
            fourth_order: false,
            begin: 0.0,
            initial: vec![0.0; count],
            stored_at_start: 0.0,
            cell_of,
            vertex_of: vertices.into_iter().map(Some).collect(),
            places: Places::new(0, 0, false, false),
            readings: Vec::new(),
            totals: Vec::new(),
            pool: Pool::default(),
            cells,
        };
        diffusion.changed();
        Ok(diffusion)
    }

    /// Sets the time at which the scene starts \[s\], 0 by default.
    ///
    /// # Errors
    /// [`DiffusionError`] for a time that is not finite.
    pub fn starting_at(mut self, time: f64) -> Result<Self, DiffusionError> {
        error::finite("start time [s]", None, time)?;
        self.begin = time;
        Ok(self)
    }

    /// Sets the initial change of pore pressure \[Pa\], 0 by default.
    ///
    /// # Errors
    /// [`DiffusionError`] for pressures that are not finite, and another number of them.
    pub fn with_initial_pressure(
        mut self,
        pressure: impl Into<PerVertex>,
    ) -> Result<Self, DiffusionError> {
        let what = "initial pressure [Pa]";
        let values = pressure
            .into()
            .values(what, self.cells.count(), error::finite)?;
        self.initial = self
            .cells
            .vertices()
            .into_iter()
            .map(|vertex| values[vertex])
            .collect();
        self.changed();
        Ok(self)
    }

    /// Sets the cell of each vertex of the contact, for a contact that covers a part of the cells.
    ///
    /// # Errors
    /// [`DiffusionError`] for cells that do not exist, and for two vertices in one cell.
    pub fn with_vertices(mut self, cells: &[usize]) -> Result<Self, DiffusionError> {
        let what = "cell of a vertex";
        let count = self.cells.count();
        self.vertex_of = vec![None; count];
        for (vertex, &cell) in cells.iter().enumerate() {
            let refuse = |requirement| DiffusionError::Value {
                what,
                cell: Some(vertex),
                requirement,
                value: cell as f64,
            };
            let Some(of) = self.vertex_of.get_mut(cell) else {
                return Err(refuse("below the number of cells"));
            };
            if of.replace(vertex).is_some() {
                return Err(refuse("a cell of no other vertex"));
            }
        }
        self.cell_of = cells.to_vec();
        self.changed();
        Ok(self)
    }

    /// The cells.
    pub fn cells(&self) -> &Cells {
        &self.cells
    }

    /// Lays out what follows from the parts.
    fn changed(&mut self) {
        let (evolving, dilatant) = (self.evolution.is_some(), self.dilatancy.is_some());
        self.places = Places::new(self.cells.count(), self.bores().count(), evolving, dilatant);
        let bores: f64 = self
            .bores()
            .map(|bore| bore.storage * self.initial[bore.cell])
            .sum();
        let cells = self.capacity.iter().zip(&self.initial).map(|(c, p)| c * p);
        self.stored_at_start = cells.sum::<f64>() + bores;
        self.readings = self
            .quantities()
            .into_iter()
            .map(|(_, reading)| reading)
            .collect();
        self.totals = self.volumes();
        self.pool.clear();
    }
}
