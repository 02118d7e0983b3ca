//! Work over fixed chunks of particles, serial or on a simulation's own thread pool.
//!
//! A chunk always holds the same particles and is always worked through in the same order by one thread; sums are kept
//! per chunk and added up in chunk order afterwards. That is why the number of threads never shows in a result.

use std::sync::{Arc, Mutex, PoisonError};

use rayon::ThreadPool;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

use crate::error::Error;

/// Particles per chunk.
pub const CHUNK: usize = 512;

/// Number of chunks that `count` particles make.
pub fn chunk_count(count: usize) -> usize {
    count.div_ceil(CHUNK)
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
    threads: Option<ThreadPool>,
    home: u32,
}

impl Pool {
    fn is_at_home(&self) -> bool {
        // To ask for the process takes a call of the system; a thread of the pool needs none.
        let is_one = |threads: &ThreadPool| threads.current_thread_index().is_some();
        self.threads.as_ref().is_some_and(is_one) || std::process::id() == self.home
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
            0 => Err(Error::config("threads", 0_usize, "at least 1")),
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
        threads.map_or(1, ThreadPool::current_num_threads)
    }

    /// Whether work on `count` particles is worth handing over to other threads.
    pub fn serve(&self, count: usize) -> bool {
        self.pool_for(count).is_some()
    }

    /// The pool where it is here and pays for `count` particles.
    fn pool_for(&self, count: usize) -> Option<&ThreadPool> {
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

    /// Sets each of `values`, one a particle, to what `value` gives for its number.
    pub fn set_each<T: Send>(&self, values: &mut [T], value: impl Fn(usize) -> T + Sync) {
        self.for_each(values.len(), values.chunks_mut(CHUNK).enumerate(), |(chunk, values)| {
            for (i, own) in (CHUNK * chunk..).zip(values) {
                *own = value(i);
            }
        });
    }

    /// The greatest of each of the numbers that `numbers` gives for `count` particles, −∞ for none; what is not a number does
    /// not count.
    pub fn greatest<const N: usize>(
        &self,
        count: usize,
        numbers: impl Fn(usize) -> [f64; N] + Sync,
    ) -> [f64; N] {
        let none = [f64::NEG_INFINITY; N];
        let larger = |most: [f64; N], other: [f64; N]| std::array::from_fn(|k| most[k].max(other[k]));
        let mut most = vec![none; chunk_count(count)];
        let starts = (0..count).step_by(CHUNK);
        self.for_each(count, starts.zip(&mut most), |(start, most)| {
            *most = (start..count.min(start + CHUNK)).map(&numbers).fold(none, larger);
        });
        most.into_iter().fold(none, larger)
    }

    /// Runs `kernel` on each of `tasks`, on several threads where that pays for `count` particles.
    pub fn for_each<W: Send>(
        &self,
        count: usize,
        tasks: impl Iterator<Item = W> + Send,
        kernel: impl Fn(W) + Sync,
    ) {
        match self.pool_for(count) {
            Some(pool) => share(pool, tasks, &kernel),
            None => tasks.for_each(kernel),
        }
    }
}

/// Particles below which a second thread loses. Measured on two cores that need 0.2 µs to hear of each other, with a
/// load that has just been packed, whose steps are the shortest: 0.6 times one thread at 2 000 particles, 1.2 at 3 000,
/// 1.5 at 5 000.
const PARALLEL_THRESHOLD: usize = 4096;

/// Gives each thread as many tasks in a row, the same in every pass, so that it finds in its own cache what it left there.
/// A thread that is done takes what others have not come to: one whose CPU is busy with something else holds no other up.
fn share<W: Send>(pool: &ThreadPool, tasks: impl Iterator<Item = W>, kernel: &(dyn Fn(W) + Sync)) {
    let tasks: Vec<_> = tasks.map(|task| Mutex::new(Some(task))).collect();
    let members = pool.current_num_threads().min(tasks.len());
    let own = |number: usize| &tasks[tasks.len() * number / members..tasks.len() * (number + 1) / members];
    let take = |task: &Mutex<Option<W>>| {
        let taken = task.lock().unwrap_or_else(PoisonError::into_inner).take();
        taken.into_iter().for_each(kernel);
    };
    run_members(pool, members, &|number| {
        own(number).iter().for_each(take);
        for other in (1..members).map(|turn| (number + turn) % members) {
            own(other).iter().rev().for_each(take);
        }
    });
}

/// Runs `work` with the number of each member, on a thread of its own if there are as many. Compiled once for all kinds of work:
/// what splits and joins is ten times as large as a kernel's own loop.
fn run_members(pool: &ThreadPool, members: usize, work: &(dyn Fn(usize) + Sync)) {
    pool.install(|| (0..members).into_par_iter().with_max_len(1).for_each(work));
}
