//! Links between the copies of a vertex on the sides of faults.

use std::collections::BTreeSet;

use nalgebra::SVector;

/// The copies of vertices whose motion is that of other copies and a jump.
///
/// A surface that cuts a body has two copies of each of its vertices, one a side. Their unknowns are the jump and a mean
/// of both motions. With `x` the vectors of all copies and `y` the unknowns,
///
/// ```text
///   +   x_+ = y_- + (1 - w) y_+     y_+ = x_+ - x_-               the jump
/// ------------------  fault
///   -   x_- = y_- - w y_+           y_- = w x_+ + (1 - w) x_-     the mean
/// ```
///
/// With `w = k_+/(k_+ + k_-)` of the stiffnesses of both copies jump and mean do not couple at the pair: what slides on a
/// stiff side moves the soft one. With `w = 0` the second unknown is the motion of the base, as where a Dirichlet
/// condition prescribes that:
///
/// ```text
/// x_i = s_i y_i + sum of y_j over the bases j of i,      x_i = y_i for a vertex without bases
/// ```
///
/// with `s_i = 1`, or `-1` where the minus side is the copy: its unknown is the jump of the plus side, too. Where two
/// faults cross, `w = 0`, and the copy on the plus side of both has the jumps of both and none of its own: its bases are
/// the three others.
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
    /// The share `w` of the jump by which the base moves back, in \[0, 1). It is 0 with several bases, and where the base
    /// is linked itself or has other links.
    pub share: f64,
}

impl Link {
    /// A vertex whose jump leaves its bases in place.
    pub fn new(vertex: usize, bases: Vec<usize>) -> Self {
        Self {
            vertex,
            bases,
            reversed: false,
            share: 0.0,
        }
    }

    /// The base that moves back, and its motion by the unknown of the vertex.
    pub(crate) fn recoil(&self) -> Option<(usize, f64)> {
        let base = self.bases.first().filter(|_| self.share != 0.0);
        base.map(|&base| (base, -self.share * self.sign()))
    }

    pub(crate) fn sign(&self) -> f64 {
        if self.reversed { -1.0 } else { 1.0 }
    }
}

impl Links {
    /// No links.
    pub fn none() -> Self {
        Self::default()
    }

    /// # Panics
    /// If a vertex is linked twice, a base is linked without its own bases, or a base with other links moves back.
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
        let mut bases: Vec<usize> = (all.links.iter())
            .flat_map(|link| link.bases.iter().copied())
            .collect();
        bases.sort_unstable();
        // A base of one link alone that is not linked itself.
        let single = |base: usize| {
            let first = bases.partition_point(|&other| other < base);
            bases.get(first + 1) != Some(&base) && all.of(base).is_none()
        };
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
            assert!(
                link.share == 0.0 || (link.bases.len() == 1 && single(link.bases[0])),
                "a base with other links moves back: {link:?}"
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

    /// The links of a coarser mesh: those between vertices that both have, numbered by `coarse`.
    #[must_use]
    pub fn on_coarser(&self, coarse: impl Fn(usize) -> Option<usize>) -> Self {
        let links = self.links.iter().filter_map(|link| {
            let bases = link.bases.iter().map(|&base| coarse(base));
            Some(Link {
                vertex: coarse(link.vertex)?,
                bases: bases.collect::<Option<Vec<_>>>()?,
                reversed: link.reversed,
                share: link.share,
            })
        });
        let links: Vec<Link> = links.collect();
        let known: BTreeSet<usize> = links.iter().map(|link| link.vertex).collect();
        // A base that is linked on the finer level alone: its vertex moves by itself here.
        let complete = |link: &Link| {
            let linked = link.bases.iter().filter(|base| known.contains(base));
            link.bases.len() == 1 || linked.count() + 1 == link.bases.len()
        };
        Self::new(links.iter().filter(|link| complete(link)).cloned())
    }

    /// `x = L y`, in place.
    pub fn join<const C: usize>(&self, field: &mut [SVector<f64, C>]) {
        // A link comes behind its bases: the last one is a base of no other.
        for link in self.links.iter().rev() {
            if let Some((base, share)) = link.recoil() {
                field[base] += field[link.vertex] * share;
            }
            let bases: SVector<f64, C> = link.bases.iter().map(|&j| field[j]).sum();
            field[link.vertex] = field[link.vertex] * link.sign() + bases;
        }
    }

    /// `y = L^-1 x`, in place.
    pub fn part<const C: usize>(&self, field: &mut [SVector<f64, C>]) {
        for link in &self.links {
            let bases: SVector<f64, C> = link.bases.iter().map(|&j| field[j]).sum();
            field[link.vertex] = (field[link.vertex] - bases) * link.sign();
            if let Some((base, share)) = link.recoil() {
                field[base] -= field[link.vertex] * share;
            }
        }
    }

    /// The forces on the unknowns, `L^T r`, in place.
    pub fn gather<const C: usize>(&self, forces: &mut [SVector<f64, C>]) {
        self.congruent(|step| match step {
            Elementary::Add { from, to, share } => {
                let force = forces[from] * share;
                forces[to] += force;
            }
            Elementary::Negate(i) => forces[i] = -forces[i],
        });
    }

    /// The forces on the copies of which these are the forces on the unknowns, `L^-T r`, in place.
    pub fn scatter<const C: usize>(&self, forces: &mut [SVector<f64, C>]) {
        for link in self.links.iter().rev() {
            if let Some((base, share)) = link.recoil() {
                let force = forces[base] * share;
                forces[link.vertex] -= force;
            }
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
                let share = 1.0;
                step(Elementary::Add { from, to, share });
            }
            if link.reversed {
                step(Elementary::Negate(from));
            }
            if let Some((base, share)) = link.recoil() {
                let (from, to) = (base, link.vertex);
                step(Elementary::Add { from, to, share });
            }
        }
    }
}

/// A step of `L^T`.
pub(crate) enum Elementary {
    /// Adds a multiple of a row to another one.
    Add { from: usize, to: usize, share: f64 },
    /// Changes the sign of a row.
    Negate(usize),
}
