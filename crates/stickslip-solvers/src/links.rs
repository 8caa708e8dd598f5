//! Links between the copies of a vertex on the sides of faults.

use nalgebra::SVector;

/// The copies of vertices whose motion is that of other copies and a jump.
///
/// A surface that cuts a body has two copies of each of its vertices, one a side. Their unknowns are the jump and the
/// motion of one of them. With `x` the vectors of all copies and `y` the unknowns,
///
/// ```text
/// x_i = s_i y_i + sum of y_j over the bases j of i,      x_i = y_i for a vertex without bases
///
///   +   x = y_+ + y_-     the plus side moves with the minus side, and by the jump y_+
/// ------------------  fault
///   -   x = y_-
/// ```
///
/// `s_i = 1`, or `-1` where the minus side is the copy: its unknown is the jump of the plus side, too. Where two faults
/// cross, the copy on the plus side of both has the jumps of both and none of its own: its bases are the three others.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Links {
    /// Ordered by the numbers of their bases: the bases of a link are linked before it.
    links: Vec<Link>,
    /// The linked vertices, increasing, and their positions.
    places: Vec<(usize, usize)>,
}

/// A vertex that moves with others, and by a jump.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The linked vertex.
    pub vertex: usize,
    /// All its bases: with a base that is linked itself come the bases of that one.
    pub bases: Vec<usize>,
    /// The jump counts from the vertex to its base instead of from the base to the vertex: `s_i = -1`.
    pub reversed: bool,
}

impl Link {
    fn sign(&self) -> f64 {
        if self.reversed { -1.0 } else { 1.0 }
    }
}

impl Links {
    /// No links.
    pub fn none() -> Self {
        Self::default()
    }

    /// # Panics
    /// If a vertex is linked twice, or a base is linked without its own bases.
    pub fn new(links: impl IntoIterator<Item = Link>) -> Self {
        let mut links: Vec<Link> = links.into_iter().collect();
        links.sort_by_key(|link| (link.bases.len(), link.vertex));
        let mut places: Vec<_> = (links.iter().enumerate())
            .map(|(place, link)| (link.vertex, place))
            .collect();
        places.sort_unstable();
        let twice = places.windows(2).find(|pair| pair[0].0 == pair[1].0);
        assert!(twice.is_none(), "a vertex is linked twice: {twice:?}");
        let all = Self { links, places };
        for link in &all.links {
            let complete = |base: &usize| {
                *base != link.vertex
                    && (all.of(*base)).is_none_or(|other| {
                        other.bases.iter().all(|below| link.bases.contains(below))
                    })
            };
            assert!(
                link.bases.iter().all(complete),
                "incomplete bases: {link:?}"
            );
        }
        all
    }

    /// Whether there are no links.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// The links; those with fewer bases come first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Link> {
        self.links.iter()
    }

    /// The link of a vertex, if it is linked.
    pub fn of(&self, vertex: usize) -> Option<&Link> {
        let place = self.places.binary_search_by_key(&vertex, |place| place.0);
        place.ok().map(|place| &self.links[self.places[place].1])
    }

    /// `x = L y`, in place.
    pub fn join<const C: usize>(&self, field: &mut [SVector<f64, C>]) {
        // A link comes behind its bases: the last one is a base of no other.
        for link in self.links.iter().rev() {
            let bases: SVector<f64, C> = link.bases.iter().map(|&j| field[j]).sum();
            field[link.vertex] = field[link.vertex] * link.sign() + bases;
        }
    }

    /// `y = L^-1 x`, in place.
    pub fn part<const C: usize>(&self, field: &mut [SVector<f64, C>]) {
        for link in &self.links {
            let bases: SVector<f64, C> = link.bases.iter().map(|&j| field[j]).sum();
            field[link.vertex] = (field[link.vertex] - bases) * link.sign();
        }
    }

    /// The forces on the unknowns, `L^T r`, in place.
    pub fn gather<const C: usize>(&self, forces: &mut [SVector<f64, C>]) {
        self.congruent(|step| match step {
            Elementary::Add { from, to } => {
                let force = forces[from];
                forces[to] += force;
            }
            Elementary::Negate(i) => forces[i] = -forces[i],
        });
    }

    /// The forces on the copies of which these are the forces on the unknowns, `L^-T r`, in place.
    pub fn scatter<const C: usize>(&self, forces: &mut [SVector<f64, C>]) {
        for link in self.links.iter().rev() {
            let own = forces[link.vertex] * link.sign();
            forces[link.vertex] = own;
            for &base in &link.bases {
                forces[base] -= own;
            }
        }
    }

    /// `L^T` as a product of elementary steps, for rows, and for columns alike.
    pub(crate) fn congruent(&self, mut step: impl FnMut(Elementary)) {
        for link in &self.links {
            let from = link.vertex;
            for &to in &link.bases {
                step(Elementary::Add { from, to });
            }
            if link.reversed {
                step(Elementary::Negate(from));
            }
        }
    }
}

/// A step of `L^T`.
pub(crate) enum Elementary {
    /// Adds a row to another one.
    Add { from: usize, to: usize },
    /// Changes the sign of a row.
    Negate(usize),
}
