//! What contacts do to particles: at once to those of the contact's own chunk, by post to those of others.
//!
//! A chunk adds its contacts, in key order, to its own particles and posts the reactions on particles of later chunks.
//! Then every chunk collects its post in the order of the chunks that sent it. Neither order depends on threads or lists.

use crate::cache::ask_for;
use crate::contact::table::ContactTable;
use crate::integrator::Load;
use crate::lanes::Lanes;
use crate::threads::{CHUNK, Chunked, Threads};

/// A reaction on a particle of another chunk: force (x, y) and moment.
#[derive(Debug, Clone, Copy)]
struct Post {
    particle: u32,
    reaction: [f64; 3],
}

/// What one chunk has posted in this step, by the chunk that it goes to.
#[derive(Debug, Clone, Default)]
pub struct Outbox {
    /// The particles of other chunks that the chunk has candidates or contacts with; ascending.
    abroad: Vec<u32>,
    /// Their chunks; ascending.
    targets: Vec<u32>,
    posts: Vec<Vec<Post>>,
}

impl Outbox {
    /// Makes room for post to every chunk that chunk `own` has candidates or contacts with.
    fn address(&mut self, own: usize, table: &ContactTable) {
        let pairs = &table.chunks[own].pairs;
        let contacts = pairs.contacts.iter().map(|entry| entry.contact.other);
        let others = pairs.candidates.iter().map(|candidate| candidate.other).chain(contacts);
        self.abroad.clear();
        self.abroad.extend(others.filter(|&other| other as usize / CHUNK != own));
        self.abroad.sort_unstable();
        self.abroad.dedup();
        self.targets.clear();
        self.targets.extend(self.abroad.iter().map(|&other| other / CHUNK as u32));
        self.targets.dedup();
        self.posts.resize(self.targets.len(), Vec::new());
    }

    /// The particles of other chunks that contacts may be with.
    pub fn abroad(&self) -> &[u32] {
        &self.abroad
    }

    /// Asks memory for lists that are too short for it to foresee that they are needed.
    pub fn ask_for_lists(&self) {
        ask_for(&self.abroad);
        ask_for(&self.targets);
        ask_for(&self.posts);
    }

    /// Asks memory for a share of the room where the last step's post is, which the next one's will take.
    #[inline(always)]
    pub fn ask_for(&self, share: usize) {
        if let Some(posts) = self.posts.get(share) {
            ask_for(posts);
        }
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
    /// Takes a load off one of the chunk's own particles.
    #[inline(always)]
    pub fn take_off(&mut self, particle: u32, load: Lanes) {
        let own = &mut self.loads[particle as usize - self.first];
        own.0 -= load;
    }

    /// Adds a load to any particle.
    #[inline(always)]
    pub fn react(&mut self, particle: u32, load: Lanes) {
        if let Some(own) = self.loads.get_mut(particle as usize - self.first) {
            own.0 += load;
        } else {
            let [x, y, moment, _] = load.to_array();
            self.outbox.send(particle, [x, y], moment);
        }
    }
}

/// Who posts to whom.
#[derive(Debug, Clone)]
pub struct PostOffice {
    outboxes: Vec<Outbox>,
    /// By chunk: the chunks that may have post for it, ascending.
    senders: Vec<Vec<u32>>,
}

impl PostOffice {
    /// For `chunks` chunks.
    pub fn new(chunks: usize) -> Self {
        Self { outboxes: vec![Outbox::default(); chunks], senders: vec![Vec::new(); chunks] }
    }

    /// The outboxes, one a chunk; and by chunk those that may have post for it.
    pub fn parts_mut(&mut self) -> (&mut [Outbox], &[Vec<u32>]) {
        (&mut self.outboxes, &self.senders)
    }

    /// The outboxes, one a chunk.
    pub fn outboxes(&self) -> &[Outbox] {
        &self.outboxes
    }

    /// By chunk: the chunks that may have post for it, ascending.
    pub fn senders(&self) -> &[Vec<u32>] {
        &self.senders
    }

    /// Takes note of new candidates for `count` particles.
    pub fn prepare(&mut self, table: &ContactTable, count: usize, threads: &Threads) {
        let work = Addressing { first: 0, outboxes: &mut self.outboxes };
        threads.for_each_chunk(count, work, &|work: Addressing| {
            if let Some(outbox) = work.outboxes.first_mut() {
                outbox.address(work.first, table);
            }
        });
        self.senders.iter_mut().for_each(Vec::clear);
        for (sender, outbox) in self.outboxes.iter().enumerate() {
            for &target in &outbox.targets {
                self.senders[target as usize].push(sender as u32);
            }
        }
    }
}

/// Adds the post for chunk `chunk` to the loads of its particles, in the order of its senders. `outboxes` begin with that of
/// chunk `first`.
pub fn collect(chunk: usize, senders: &[u32], (first, outboxes): (usize, &[Outbox]), loads: &mut [Load]) {
    for &sender in senders {
        for post in outboxes[sender as usize - first].to(chunk) {
            let [x, y, moment] = post.reaction;
            loads[post.particle as usize - chunk * CHUNK].0 += Lanes::new([x, y, moment, 0.0]);
        }
    }
}

/// Chunks that address their outboxes.
struct Addressing<'a> {
    /// The first of the chunks.
    first: usize,
    outboxes: &'a mut [Outbox],
}

impl Chunked for Addressing<'_> {
    fn chunks(&self) -> usize {
        self.outboxes.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (left, right) = self.outboxes.split_at_mut(chunks);
        (Self { first: self.first, outboxes: left }, Self { first: self.first + chunks, outboxes: right })
    }
}

/// Chunks that collect their post.
pub struct Delivery<'a> {
    /// The first of the chunks.
    pub first: usize,
    /// Loads of whole chunks.
    pub loads: &'a mut [Load],
}

impl Delivery<'_> {
    /// Collects the post of one chunk.
    pub fn run(self, post: &PostOffice) {
        let chunk = self.first;
        collect(chunk, &post.senders[chunk], (0, &post.outboxes), self.loads);
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
