//! Work over fixed chunks of particles, serial or on a simulation's own thread pool.
//!
//! A chunk always holds the same particles and is always worked through in the same order by one thread; sums are kept
//! per chunk and added up in chunk order afterwards. That is why the number of threads never shows in a result.

use std::sync::{Arc, Mutex, PoisonError};

use crate::error::Error;

/// Particles per chunk.
pub const CHUNK: usize = 512;

/// Number of chunks that `count` particles make.
pub fn chunk_count(count: usize) -> usize {
    count.div_ceil(CHUNK)
}

/// Slices that cover whole chunks and can be cut between two of them.
pub trait Chunked: Sized + Send {
    /// Number of chunks covered.
    fn chunks(&self) -> usize;
    /// Cuts after the first `chunks` chunks.
    fn split(self, chunks: usize) -> (Self, Self);
}

/// The threads that one simulation may use.
///
/// A forked process has none of them. There the simulation goes on with the one thread that there is, with the same bits.
#[derive(Debug, Clone)]
pub struct Threads {
    pool: Option<Arc<Pool>>,
}

/// A thread pool, and the process that has its threads.
#[derive(Debug)]
struct Pool {
    /// None only while it is dropped.
    threads: Option<rayon::ThreadPool>,
    home: u32,
}

impl Pool {
    fn is_at_home(&self) -> bool {
        std::process::id() == self.home
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        if !self.is_at_home() {
            // Ending threads that are not there could wait for a lock that one of them held.
            std::mem::forget(self.threads.take());
        }
    }
}

impl Threads {
    /// A pool of `count` threads; one thread needs no pool.
    ///
    /// # Errors
    /// `Error::Config` for no threads, `Error::System` where the system refuses them.
    pub fn new(count: usize) -> Result<Self, Error> {
        match count {
            0 => Err(Error::config("threads", 0, "at least 1")),
            1 => Ok(Self { pool: None }),
            _ => rayon::ThreadPoolBuilder::new()
                .num_threads(count)
                .build()
                .map(|pool| Pool { threads: Some(pool), home: std::process::id() })
                .map(|pool| Self { pool: Some(Arc::new(pool)) })
                .map_err(|error| Error::System {
                    action: format!("starting {count} threads"),
                    reason: error.to_string(),
                }),
        }
    }

    /// Number of threads.
    pub fn count(&self) -> usize {
        let threads = self.pool.as_ref().and_then(|pool| pool.threads.as_ref());
        threads.map_or(1, rayon::ThreadPool::current_num_threads)
    }

    /// Whether work on `count` particles is worth handing over to other threads.
    pub fn serve(&self, count: usize) -> bool {
        self.pool_for(count).is_some()
    }

    /// The pool where it is here and pays for `count` particles.
    fn pool_for(&self, count: usize) -> Option<&rayon::ThreadPool> {
        let pool = self.pool.as_ref().filter(|pool| count >= PARALLEL_THRESHOLD && pool.is_at_home());
        pool.and_then(|pool| pool.threads.as_ref())
    }

    /// Runs `work` on one of the pool's threads where that pays for `count` particles: a run of many steps enters the pool
    /// once, since each entrance wakes a thread that has gone to sleep.
    pub fn enter<R: Send>(&self, count: usize, work: impl FnOnce() -> R + Send) -> R {
        match self.pool_for(count) {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }

    /// Runs `kernel` on each chunk of `work`, on several threads where that pays for `count` particles.
    pub fn for_each_chunk<W: Chunked>(&self, count: usize, work: W, kernel: &(impl Fn(W) + Sync)) {
        self.for_each_run(count, work, &|run| in_turn(run).for_each(kernel));
    }

    /// Runs `kernel` on all chunks of `work`, some in a row at a time, on several threads where that pays for `count`
    /// particles.
    pub fn for_each_run<W: Chunked>(&self, count: usize, work: W, kernel: &(impl Fn(W) + Sync)) {
        match self.pool_for(count) {
            Some(pool) => pool.install(|| share(work, kernel, pool.current_num_threads())),
            None => kernel(work),
        }
    }
}

/// Particles below which a second thread loses. Measured on two cores that need 0.2 µs to hear of each other, with a
/// load that has just been packed, whose steps are the shortest: 0.6 times one thread at 2 000 particles, 1.2 at 3 000,
/// 1.5 at 5 000.
const PARALLEL_THRESHOLD: usize = 4096;

/// Gives each thread a stretch of chunks, the same in every pass, so that it finds in its own cache what it left there.
/// Who is done takes what others have not come to: a thread whose CPU is busy with something else holds nobody up.
fn share<W: Chunked>(mut work: W, kernel: &(impl Fn(W) + Sync), threads: usize) {
    let members = threads.min(work.chunks());
    let mut stretches = Vec::with_capacity(members);
    for threads in (2..=members).rev() {
        let chunks = work.chunks();
        let (first, rest) = work.split(chunks / threads);
        stretches.push(Mutex::new(Some(first)));
        work = rest;
    }
    stretches.push(Mutex::new(Some(work)));
    let stretches = &stretches[..];
    let help = move |number: usize| {
        for turn in 0..members {
            let stretch = &stretches[(number + turn) % members];
            while let Some(run) = take(stretch, turn == 0) {
                kernel(run);
            }
        }
    };
    rayon::scope(|scope| {
        (1..members).for_each(|number| scope.spawn(move |_| help(number)));
        help(0);
    });
}

/// Chunks that a thread takes at a time at most: so many that it can look ahead, so few that nobody waits for the last.
const LONGEST_RUN: usize = 8;

/// The first or the last chunks of what is left of a stretch.
fn take<W: Chunked>(stretch: &Mutex<Option<W>>, first: bool) -> Option<W> {
    let mut left = stretch.lock().unwrap_or_else(PoisonError::into_inner);
    let work = left.take()?;
    let chunks = work.chunks();
    let run = (chunks / LONGEST_RUN).clamp(1, LONGEST_RUN);
    if chunks <= run {
        return Some(work);
    }
    if first {
        let (taken, rest) = work.split(run);
        *left = Some(rest);
        Some(taken)
    } else {
        let (rest, taken) = work.split(chunks - run);
        *left = Some(rest);
        Some(taken)
    }
}

/// The chunks of `work`, one by one.
pub fn in_turn<W: Chunked>(work: W) -> impl Iterator<Item = W> {
    let mut left = Some(work);
    std::iter::from_fn(move || {
        let (first, rest) = first_of(left.take()?);
        left = rest;
        Some(first)
    })
}

/// Calls `each` with the chunks of `work`, one by one, and with what comes after each.
pub fn with_later<W: Chunked>(work: W, mut each: impl FnMut(W, Option<&W>)) {
    let mut left = Some(work);
    while let Some(work) = left.take() {
        let (first, rest) = first_of(work);
        each(first, rest.as_ref());
        left = rest;
    }
}

/// The first chunk of `work`, and the rest.
fn first_of<W: Chunked>(work: W) -> (W, Option<W>) {
    if work.chunks() <= 1 {
        return (work, None);
    }
    let (first, rest) = work.split(1);
    (first, Some(rest))
}
