//! What contacts do to particles: at once to those of the contact's own chunk, by post to those of others.
//!
//! A chunk adds its contacts, in key order, to its own particles and posts the reactions on particles of later chunks.
//! Then every chunk collects its post in the order of the chunks that sent it. Neither order depends on threads or lists.

use crate::contact::table::ContactTable;
use crate::integrator::Load;
use crate::lanes::Lanes;
use crate::threads::{CHUNK, Chunked};

/// A reaction on a particle of another chunk: what is to be taken off its force (x, y) and moment.
#[derive(Debug, Clone, Copy)]
struct Post {
    particle: u32,
    reaction: [f64; 3],
}

/// What one chunk has posted in this step, by the chunk that it goes to.
#[derive(Debug, Clone, Default)]
pub struct Outbox {
    /// Ascending.
    targets: Vec<u32>,
    posts: Vec<Vec<Post>>,
}

impl Outbox {
    /// Makes room for post to every chunk that chunk `own` has candidates or contacts with.
    pub fn address(&mut self, own: usize, table: &ContactTable) {
        let pairs = &table.chunks[own].pairs;
        let contacts = pairs.contacts.iter().map(|entry| entry.contact.other);
        let others = pairs.candidates.others().iter().copied().chain(contacts);
        self.targets.clear();
        self.targets.extend(others.map(|other| other / CHUNK as u32).filter(|&chunk| chunk as usize != own));
        self.targets.sort_unstable();
        self.targets.dedup();
        self.posts.resize(self.targets.len(), Vec::new());
    }

    /// Throws the last step's post away.
    pub fn clear(&mut self) {
        self.posts.iter_mut().for_each(Vec::clear);
    }

    #[cold]
    #[inline(never)]
    fn send(&mut self, particle: u32, force: [f64; 2], moment: f64) {
        let target = particle / CHUNK as u32;
        if let Ok(index) = self.targets.binary_search(&target) {
            self.posts[index].push(Post { particle, reaction: [force[0], force[1], moment] });
        }
    }

    fn to(&self, chunk: usize) -> &[Post] {
        self.targets.binary_search(&(chunk as u32)).map_or(&[], |index| &self.posts[index])
    }
}

/// Where the loads of one chunk's contacts go.
pub struct Sink<'a> {
    /// The chunk's first particle.
    pub first: usize,
    /// Loads of the chunk's particles.
    pub loads: &'a mut [Load],
    /// Post for later chunks.
    pub outbox: &'a mut Outbox,
}

impl Sink<'_> {
    /// Adds a load to one of the chunk's own particles.
    #[inline(always)]
    pub fn add(&mut self, particle: u32, load: Lanes) {
        let own = &mut self.loads[particle as usize - self.first];
        own.0 += load;
    }

    /// Takes a load off any particle.
    #[inline(always)]
    pub fn take_off(&mut self, particle: u32, load: Lanes) {
        if let Some(own) = self.loads.get_mut(particle as usize - self.first) {
            own.0 -= load;
        } else {
            let [x, y, moment, _] = load.to_array();
            self.outbox.send(particle, [x, y], moment);
        }
    }
}

/// Loads whose chunks collect their post.
pub struct Delivery<'a> {
    /// The first of the chunks.
    pub first: usize,
    /// Loads of whole chunks.
    pub loads: &'a mut [Load],
}

impl Delivery<'_> {
    /// Adds the post of every earlier chunk to this one's particles.
    pub fn collect(self, outboxes: &[Outbox]) {
        let first_particle = self.first * CHUNK;
        for outbox in &outboxes[..self.first] {
            for post in outbox.to(self.first) {
                let [x, y, moment] = post.reaction;
                self.loads[post.particle as usize - first_particle].0 -= Lanes::new([x, y, moment, 0.0]);
            }
        }
    }
}

impl Chunked for Delivery<'_> {
    fn chunks(&self) -> usize {
        self.loads.len().div_ceil(CHUNK)
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (left, right) = self.loads.split_at_mut(chunks * CHUNK);
        (Self { first: self.first, loads: left }, Self { first: self.first + chunks, loads: right })
    }
}
