//! Which vertices are whose.

use std::sync::{Mutex, PoisonError};

use nalgebra::SVector;
use stickslip::solvers::Ranks;

use crate::ffi::Exchange;
use crate::world::or_abort;
use crate::{Error, World};

/// The vertices of this process: those it owns, then the ghosts, which others own.
#[derive(Debug)]
pub(crate) struct Layout {
    pub(crate) world: World,
    /// The same to the operators.
    pub(crate) ranks: Ranks,
    pub(crate) owned: usize,
    /// The global number of the first owned vertex.
    pub(crate) first: u64,
    /// The global numbers of ghosts, increasing, so those of one owner together.
    pub(crate) ghosts: Vec<u64>,
    /// The owned vertices that are sent, neighbour after neighbour.
    sent: Vec<u32>,
    /// Rank, and how many vertices are sent and received.
    neighbours: Vec<(usize, usize, usize)>,
    room: Mutex<Vec<Room>>,
}

/// Room for an exchange with so many components a vertex.
#[derive(Debug)]
struct Room {
    components: usize,
    exchange: Exchange,
    send: Vec<f64>,
    receive: Vec<f64>,
}

impl Layout {
    /// A layout of no vertex in one process.
    pub(crate) fn empty() -> Self {
        Self {
            world: World::alone(),
            ranks: Ranks::several(World::alone()),
            owned: 0,
            first: 0,
            ghosts: Vec::new(),
            sent: Vec::new(),
            neighbours: Vec::new(),
            room: Mutex::new(Vec::new()),
        }
    }

    /// For `owned` vertices from number `first` on, and the ghosts; `firsts` are those of all processes.
    pub(crate) fn new(
        world: World,
        owned: usize,
        firsts: &[u64],
        ghosts: Vec<u64>,
    ) -> Result<Self, Error> {
        let first = firsts[world.rank()];
        let mut asked = vec![Vec::new(); world.size()];
        for &ghost in &ghosts {
            let owner = firsts.partition_point(|&first| first <= ghost) - 1;
            asked[owner].push(ghost);
        }
        let wanted = world.all_to_all(&asked)?;
        let mut sent = Vec::new();
        let mut neighbours = Vec::new();
        for (rank, (wanted, asked)) in wanted.iter().zip(&asked).enumerate() {
            if !(wanted.is_empty() && asked.is_empty()) {
                neighbours.push((rank, wanted.len(), asked.len()));
            }
            sent.extend(wanted.iter().map(|&number| (number - first) as u32));
        }
        Ok(Self {
            world,
            ranks: Ranks::several(world),
            owned,
            first,
            ghosts,
            sent,
            neighbours,
            room: Mutex::new(Vec::new()),
        })
    }

    /// The global number of an owned vertex or ghost.
    pub(crate) fn global(&self, vertex: u32) -> u64 {
        match (vertex as usize).checked_sub(self.owned) {
            None => self.first + u64::from(vertex),
            Some(ghost) => self.ghosts[ghost],
        }
    }

    /// The owned vertex or ghost with a global number.
    pub(crate) fn local(&self, number: u64) -> Option<u32> {
        match number.checked_sub(self.first) {
            Some(own) if own < self.owned as u64 => Some(own as u32),
            _ => {
                let ghost = self.ghosts.binary_search(&number).ok()?;
                Some((self.owned + ghost) as u32)
            }
        }
    }

    /// This layout with more ghosts. Owned vertices among them stay owned.
    pub(crate) fn with_ghosts(&self, more: impl Iterator<Item = u64>) -> Result<Self, Error> {
        let own = self.first..self.first + self.owned as u64;
        let more = more.filter(|number| !own.contains(number));
        let mut ghosts: Vec<u64> = self.ghosts.iter().copied().chain(more).collect();
        ghosts.sort_unstable();
        ghosts.dedup();
        let firsts = self.world.gather(self.first)?;
        Self::new(self.world, self.owned, &firsts, ghosts)
    }

    /// Fills the ghosts of a field of owned vertices and ghosts.
    pub(crate) fn update<const C: usize>(&self, field: &mut [SVector<f64, C>]) {
        if self.world.size() == 1 {
            return;
        }
        let mut rooms = self.room.lock().unwrap_or_else(PoisonError::into_inner);
        if !rooms.iter().any(|room| room.components == C) {
            let neighbours = self.neighbours.iter();
            let scaled = neighbours.map(|&(rank, send, receive)| (rank, C * send, C * receive));
            let exchange = or_abort(Exchange::new(&scaled.collect::<Vec<_>>()));
            rooms.extend(exchange.map(|exchange| Room {
                components: C,
                exchange,
                send: vec![0.0; C * self.sent.len()],
                receive: vec![0.0; C * self.ghosts.len()],
            }));
        }
        if let Some(room) = rooms.iter_mut().find(|room| room.components == C) {
            for (to, &vertex) in room.send.chunks_exact_mut(C).zip(&self.sent) {
                to.copy_from_slice(field[vertex as usize].as_slice());
            }
            or_abort(room.exchange.run(&room.send, &mut room.receive));
            let received = room.receive.chunks_exact(C);
            for (ghost, from) in field[self.owned..].iter_mut().zip(received) {
                ghost.copy_from_slice(from);
            }
        }
    }
}
