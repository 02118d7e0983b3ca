//! Stretches: chunks in a row that one thread takes through a step, and which of them have to wait for others.

use std::ops::Range;

use super::motions::Copies;
use super::post::{Outbox, PostOffice};
use crate::contact::table::{ChunkSlots, ContactTable};
use crate::integrator::Motion;
use crate::threads::{CHUNK, Chunked, PIECES, Threads, cut};

/// Particles from which on a load does not stay in the cache, so that it had better pass through it once a step, and that
/// asking ahead pays.
pub const LARGE: usize = 32_768;

/// How the chunks are divided. Nothing in it changes a result.
#[derive(Debug, Clone, Default)]
pub struct Stretches {
    plan: Plan,
    /// By chunk: what earlier stretches read of it.
    copies: Vec<Copies>,
    are_copied: bool,
}

/// Who does what.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// By stretch: the chunk after its last.
    ends: Vec<usize>,
    /// Whether chunks are moved on as soon as they are evaluated, but for those that wait.
    are_swept: bool,
    /// By chunk: whether it has to wait until all are evaluated before it moves on.
    waits: Vec<bool>,
    /// The chunks that wait and those after them; ascending, each once.
    cuts: Vec<usize>,
}

impl Stretches {
    /// Divides the chunks of `count` particles among `threads` threads.
    pub fn divide(&mut self, table: &ContactTable, post: &PostOffice, (count, threads): (usize, usize)) {
        let stretches = match threads {
            1 => 1,
            _ if count >= LARGE => threads * STRETCHES,
            _ => threads * PIECES,
        };
        self.plan.divide(table, stretches.min(table.chunks.len()));
        self.plan.are_swept = threads == 1 || count >= LARGE;
        self.plan.let_wait(post.senders());
        self.list_copies(post.outboxes());
    }

    /// Finds out what stretches read of later ones.
    fn list_copies(&mut self, outboxes: &[Outbox]) {
        self.copies.resize_with(outboxes.len(), Copies::default);
        self.copies.iter_mut().for_each(Copies::clear);
        self.are_copied = false;
        if !self.plan.are_swept {
            return;
        }
        for stretch in self.plan.stretches() {
            let end = stretch.end * CHUNK;
            let read = outboxes[stretch].iter().flat_map(Outbox::abroad).copied();
            for particle in read.filter(|&particle| particle as usize >= end) {
                self.copies[particle as usize / CHUNK].add(particle);
            }
        }
        self.copies.iter_mut().for_each(Copies::sort);
    }

    /// Number of stretches.
    pub fn count(&self) -> usize {
        self.plan.ends.len()
    }

    /// Whether chunks are moved on as soon as they are evaluated, but for those that wait.
    pub fn are_swept(&self) -> bool {
        self.plan.are_swept
    }

    /// Runs `kernel` on each stretch of `work` with a scratch of its own.
    pub fn share<W: Chunked, S: Send>(
        &self,
        work: W,
        scratches: &mut [S],
        threads: &Threads,
        kernel: &(impl Fn(W, &mut S) + Sync),
    ) {
        if let [scratch] = scratches {
            return kernel(work, scratch);
        }
        let count = work.chunks() * CHUNK;
        let pieces = cut(work, self.plan.ends.iter().copied()).zip(scratches);
        threads.for_each(count, pieces, &|(work, scratch): (W, &mut S)| kernel(work, scratch));
    }

    /// Whether a chunk has to wait until all are evaluated before it moves on.
    pub fn waits(&self, chunk: usize) -> bool {
        self.plan.waits[chunk]
    }

    /// By chunk: what earlier stretches read of it.
    pub fn copies(&self) -> &[Copies] {
        &self.copies
    }

    /// Who does what; and by chunk what earlier stretches read of it.
    pub fn parts_mut(&mut self) -> (&Plan, &mut [Copies]) {
        (&self.plan, &mut self.copies)
    }

    /// Copies anew what has not been copied since the last step. Chunks that wait do so themselves as they move on.
    pub fn renew_copies(&mut self, motions: &[Motion]) {
        if self.are_copied || self.count() == 1 {
            return;
        }
        for (chunk, (copies, motions)) in self.copies.iter_mut().zip(motions.chunks(CHUNK)).enumerate() {
            copies.renew(chunk * CHUNK, motions);
        }
        self.are_copied = true;
    }

    /// Takes note that particles will be moved without their copies.
    pub fn forget_copies(&mut self) {
        self.are_copied = false;
    }
}

impl Plan {
    /// Divides the chunks into so many stretches of about as much work.
    fn divide(&mut self, table: &ContactTable, stretches: usize) {
        let work = |slots: &ChunkSlots| CHUNK + CONTACT_WORK * slots.pairs.contacts.len();
        let (chunks, total) = (table.chunks.len(), table.chunks.iter().map(work).sum::<usize>());
        let mut done = 0;
        self.ends.clear();
        for (chunk, slots) in table.chunks.iter().enumerate() {
            done += work(slots);
            let is_needed = chunks - chunk == stretches - self.ends.len();
            if is_needed || done * stretches >= total * (self.ends.len() + 1) {
                self.ends.push(chunk + 1);
            }
        }
    }

    /// The chunks of each stretch.
    fn stretches(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        [0].iter().chain(&self.ends).zip(&self.ends).map(|(&start, &end)| start..end)
    }

    /// Finds out which chunks wait. `senders` are those that may have post for a chunk, ascending.
    fn let_wait(&mut self, senders: &[Vec<u32>]) {
        let of_stretch = |stretch: Range<usize>| {
            let is_earlier = move |&sender: &u32| (sender as usize) < stretch.start;
            senders[stretch.clone()].iter().map(move |senders| senders.first().is_some_and(is_earlier))
        };
        self.waits = if self.are_swept {
            self.stretches().flat_map(of_stretch).collect()
        } else {
            vec![true; senders.len()]
        };
        let waiting = (0..senders.len()).filter(|&chunk| self.waits[chunk]);
        self.cuts = waiting.flat_map(|chunk| [chunk, chunk + 1]).filter(|&cut| cut > 0).collect();
        self.cuts.dedup();
    }

    /// Those of `work` that wait, one by one.
    pub fn waiting<W: Chunked>(&self, work: W) -> impl Iterator<Item = W> {
        let ends = self.cuts.iter().copied().chain([work.chunks()]);
        let starts = [0].into_iter().chain(self.cuts.iter().copied());
        cut(work, ends)
            .zip(starts)
            .filter(|&(_, chunk)| self.waits.get(chunk) == Some(&true))
            .map(|(part, _)| part)
    }
}

/// The work of a contact over that of a particle.
const CONTACT_WORK: usize = 2;

/// Stretches for each thread of a swept load. One would have the fewest chunks wait, two hide that threads are not equally fast.
const STRETCHES: usize = 2;
