//! Contacts between the two sides of a fault inside a body, paired vertex by vertex.

use std::collections::HashMap;

use stickslip_friction::{FrictionLaw, Nodal};

use super::contact::Contact;
use super::normal_stress::NormalStress;
use crate::laws::Places;
use crate::{BoundaryPart, MeshMismatch, OppositeSide, SceneError};

impl<L: FrictionLaw, const C: usize> Contact<L, (), C> {
    /// Friction between the two sides of a fault inside a body, by one law under a normal stress \[Pa\] (uniform or per
    /// vertex of the plus side), positive in compression.
    ///
    /// ```text
    ///            plus side, x+                          slip = x+ - x-,  along the fault
    ///   ========================  fault       ^ n       traction: that on the minus side
    ///            minus side, x-                         normal n: from the minus side to the plus side
    /// ```
    ///
    /// Slip, slip rate and traction are those of the jump: of the plus side relative to the minus side, as those of a
    /// body on a rigid surface, and the traction on the minus side. The sides are the parts `name+` and `name-` of a mesh
    /// that is cut along an inner surface, or two parts with vertices at equal positions. At a tip, where both sides
    /// are one vertex, nothing slips. Materials may differ on both sides. Laws, states, cohesion, opening and the other
    /// options are those of any contact, with values per vertex in the order of the plus side, tips included.
    ///
    /// Where faults meet, those that pass through keep their jump, and one that ends there does not slip at its end. The
    /// index of a vertex in views is that of the plus side, or that of the minus side where a Dirichlet condition
    /// prescribes the plus side alone. Steps need a format of matrices with a change of basis, as a `BlockMatrix` has.
    ///
    /// ```
    /// use stickslip::fem::{GridDiagonal, Mesh, P1, antiplane};
    /// use stickslip::friction::Tresca;
    /// use stickslip::{Components, Condensed, Contact, GeneralizedAlpha, Scene, Simulation, Steps};
    ///
    /// // Two layers of 1 m, one on the other, sheared by 0.1 mm; they slide at 0.3 MPa.
    /// let mesh = Mesh::<2>::grid([2.0, 2.0], [4, 4], GridDiagonal::Rising)?
    ///     .with_surface_where("fault", |x| x[1] == 1.0)?
    ///     .split("fault")?;
    /// let space = P1::new(mesh).refined(1)?;
    /// let law = Tresca { coefficient: 0.3 };
    /// let fault = Contact::between(&space.part("fault+")?, &space.part("fault-")?, law, 1e6);
    /// let scene = Scene::new(antiplane(&space, 30e9)?)
    ///     .fix(&space.trace(|x| x[1] == 0.0)?, Components::ALL)
    ///     .prescribe_velocity(&space.trace(|x| x[1] == 2.0)?, Components::ALL, |_| [1e-5])
    ///     .with_contact(fault);
    /// let mut layers = Simulation::new(scene, GeneralizedAlpha::default(), Condensed::new())?;
    /// layers.run(&Steps::constant(1.0).count(10), |_| ())?;
    /// let at = layers.snapshot();
    /// let fault = at.contact(0);
    /// assert!((0..fault.len()).all(|k| (fault.slip(k) - (1e-4 - 2.0 * 0.3e6 / 30e9)).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn between(
        plus: impl Into<BoundaryPart>,
        minus: impl Into<BoundaryPart>,
        law: L,
        normal_stress: impl Into<NormalStress>,
    ) -> Self {
        let sides = (plus.into(), minus.into());
        Self::paired(sides, Nodal::Uniform(law), normal_stress.into())
    }

    /// Friction [between](Contact::between) two sides with one law per vertex, in the order of the plus side's vertices.
    pub fn between_per_vertex(
        plus: impl Into<BoundaryPart>,
        minus: impl Into<BoundaryPart>,
        laws: impl IntoIterator<Item = L>,
        normal_stress: impl Into<NormalStress>,
    ) -> Self {
        let laws = Nodal::PerVertex(laws.into_iter().collect());
        Self::paired((plus.into(), minus.into()), laws, normal_stress.into())
    }

    fn paired(
        (plus, minus): (BoundaryPart, BoundaryPart),
        friction: Nodal<L>,
        normal_stress: NormalStress,
    ) -> Self {
        let (part, pairs) = match Pairs::new(plus.clone(), &minus) {
            Ok((part, pairs)) => (part, Ok(pairs)),
            Err(error) => (plus, Err(error)),
        };
        Self {
            pairs: Some(pairs),
            ..Self::with_laws(part, friction, normal_stress)
        }
    }
}

/// The opposite side of a contact.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sides {
    /// A rigid surface.
    Rigid,
    /// The minus side of the body, a vertex for each of the part's.
    Two(Vec<usize>),
}

impl Sides {
    pub(crate) fn is_two(&self) -> bool {
        matches!(self, Self::Two(_))
    }
}

/// The pairs of a plus and a minus side.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pairs {
    /// The minus side.
    pub(crate) minus: Vec<usize>,
    /// The pairs among the vertices of the plus side: without tips, whose two sides are one vertex.
    pub(crate) places: Places,
}

impl Pairs {
    /// Pairs the vertices of two sides: by the cut that made them, or by their positions. Returns the part of the plus
    /// side without tips.
    pub(crate) fn new(
        plus: BoundaryPart,
        minus: &BoundaryPart,
    ) -> Result<(BoundaryPart, Self), SceneError> {
        MeshMismatch::check("minus side of a contact", plus.mesh, minus.mesh)?;
        let count = plus.vertices.len();
        let (opposite, beside_tip) = match &plus.opposite {
            None => (by_position(&plus, minus)?, vec![false; count]),
            Some(side) => (by_cut(&plus, side, minus)?, side.beside_tip.clone()),
        };
        let places: Vec<usize> = (0..count)
            .filter(|&k| opposite[k] != plus.vertices[k])
            .collect();
        let opposite = Some(OppositeSide {
            vertices: opposite,
            beside_tip,
        });
        let part = BoundaryPart { opposite, ..plus }.select(&places);
        let minus = part.opposite.iter().flat_map(|side| side.vertices.clone());
        let pairs = Self {
            minus: minus.collect(),
            places: Places { count, places },
        };
        Ok((part, pairs))
    }
}

/// The opposite vertices of a side of a cut, if the other part is the other side.
fn by_cut(
    plus: &BoundaryPart,
    side: &OppositeSide,
    minus: &BoundaryPart,
) -> Result<Vec<usize>, SceneError> {
    if side.vertices.len() != plus.vertices.len() || side.beside_tip.len() != plus.vertices.len() {
        return Err(SceneError::Length {
            what: "opposite vertices of a side",
            expected: plus.vertices.len(),
            found: side.vertices.len(),
        });
    }
    for (&vertex, &opposite) in plus.vertices.iter().zip(&side.vertices) {
        if minus.vertices.binary_search(&opposite).is_err() {
            return Err(SceneError::NotPaired {
                vertex,
                at: position(plus, vertex),
            });
        }
    }
    Ok(side.vertices.clone())
}

/// The vertices of another part at the same positions, bit for bit.
fn by_position(plus: &BoundaryPart, minus: &BoundaryPart) -> Result<Vec<usize>, SceneError> {
    // No negative zeros.
    let key = |point: &[f64; 3]| point.map(|x| (x + 0.0).to_bits());
    let points = minus.points.iter().map(key).zip(minus.vertices.iter());
    let mut at: HashMap<[u64; 3], Vec<usize>> = HashMap::new();
    for (point, &vertex) in points {
        at.entry(point).or_default().push(vertex);
    }
    let opposite = plus.vertices.iter().zip(&plus.points);
    let opposite: Vec<usize> = opposite
        .map(
            |(&vertex, point)| match at.get(&key(point)).map(Vec::as_slice) {
                Some(&[only]) => Ok(only),
                _ => Err(SceneError::NotPaired { vertex, at: *point }),
            },
        )
        .collect::<Result<_, _>>()?;
    if opposite.len() != plus.vertices.len() || opposite.len() != minus.vertices.len() {
        return Err(SceneError::Length {
            what: "vertices with positions on the minus side of a contact",
            expected: plus.vertices.len(),
            found: minus.points.len(),
        });
    }
    Ok(opposite)
}

fn position(part: &BoundaryPart, vertex: usize) -> [f64; 3] {
    let place = part.vertices.binary_search(&vertex);
    let point = place.ok().and_then(|place| part.points.get(place));
    point.copied().unwrap_or([f64::NAN; 3])
}
