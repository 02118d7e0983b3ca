//! Work over fixed chunks of particles, serial or on a simulation's own thread pool.
//!
//! A chunk always holds the same particles and is always worked through in the same order by one thread; sums are kept
//! per chunk and added up in chunk order afterwards. That is why the number of threads never shows in a result.

use std::ops::Range;
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

impl<A: Chunked, B: Chunked> Chunked for (A, B) {
    fn chunks(&self) -> usize {
        self.0.chunks()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let ((left, right), (more_left, more_right)) = (self.0.split(chunks), self.1.split(chunks));
        ((left, more_left), (right, more_right))
    }
}

/// One value of each chunk.
#[derive(Debug)]
pub struct PerChunk<'a, T>(pub &'a mut [T]);

impl<T> PerChunk<'_, T> {
    /// Sets the value of a single chunk.
    pub fn set(self, value: T) {
        if let [own] = self.0 {
            *own = value;
        }
    }
}

impl<T: Send> Chunked for PerChunk<'_, T> {
    fn chunks(&self) -> usize {
        self.0.len()
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (values, more) = self.0.split_at_mut(chunks);
        (Self(values), Self(more))
    }
}

/// Some values of the particles of whole chunks, one each.
#[derive(Debug)]
pub struct Values<'a, T> {
    /// The first of the particles.
    pub first: usize,
    /// Their values.
    pub values: &'a mut [T],
}

impl<'a, T> Values<'a, T> {
    /// Those of all particles.
    pub fn of_all(values: &'a mut [T]) -> Self {
        Self { first: 0, values }
    }
}

impl<T: Send> Chunked for Values<'_, T> {
    fn chunks(&self) -> usize {
        chunk_count(self.values.len())
    }

    fn split(self, chunks: usize) -> (Self, Self) {
        let (values, more) = self.values.split_at_mut(chunks * CHUNK);
        (Self { first: self.first, values }, Self { first: self.first + chunks * CHUNK, values: more })
    }
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
        // To ask for the process takes a call of the system; a thread of the pool needs none.
        let is_one = |threads: &rayon::ThreadPool| threads.current_thread_index().is_some();
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
        if self.serve(count) {
            let chunks = work.chunks();
            let tasks = (self.count() * TASKS).min(chunks);
            let ends = (1..=tasks).map(|task| chunks * task / tasks);
            self.for_each(count, cut(work, ends), &|task| in_turn(task).for_each(kernel));
        } else {
            in_turn(work).for_each(kernel);
        }
    }

    /// Sets each of `values`, one a particle, to what `value` gives for its number.
    pub fn set_each<T: Send>(&self, values: &mut [T], value: &(impl Fn(usize) -> T + Sync)) {
        self.for_each_chunk(values.len(), Values::of_all(values), &|part: Values<T>| {
            for (i, own) in part.values.iter_mut().enumerate() {
                *own = value(part.first + i);
            }
        });
    }

    /// The greatest of each of the numbers that `numbers` gives for `count` particles, −∞ for none; what is not a number does
    /// not count.
    pub fn greatest<const N: usize>(
        &self,
        count: usize,
        numbers: &(impl Fn(usize) -> [f64; N] + Sync),
    ) -> [f64; N] {
        let none = [f64::NEG_INFINITY; N];
        let larger = |most: [f64; N], other: [f64; N]| std::array::from_fn(|k| most[k].max(other[k]));
        let mut most = vec![none; chunk_count(count)];
        let starts = (0..count).step_by(CHUNK);
        self.for_each(count, starts.zip(&mut most), &|(start, most): (usize, &mut [f64; N])| {
            *most = (start..count.min(start + CHUNK)).map(numbers).fold(none, larger);
        });
        most.into_iter().fold(none, larger)
    }

    /// Runs `kernel` on each of `tasks`, on several threads where that pays for `count` particles.
    pub fn for_each<W: Send>(
        &self,
        count: usize,
        tasks: impl Iterator<Item = W> + Send,
        kernel: &(impl Fn(W) + Sync),
    ) {
        match self.pool_for(count) {
            Some(pool) => pool.install(|| share(tasks, kernel, pool.current_num_threads())),
            None => tasks.for_each(kernel),
        }
    }
}

/// Particles below which a second thread loses. Measured on two cores that need 0.2 µs to hear of each other, with a
/// load that has just been packed, whose steps are the shortest: 0.6 times one thread at 2 000 particles, 1.2 at 3 000,
/// 1.5 at 5 000.
const PARALLEL_THRESHOLD: usize = 4096;

/// Tasks for each thread: so many that none waits long for the last.
pub const TASKS: usize = 16;

/// Gives each thread as many tasks in a row, the same in every pass, so that it finds in its own cache what it left there.
/// A thread that is done takes what others have not come to: one whose CPU is busy with something else holds no other up.
fn share<W: Send>(tasks: impl Iterator<Item = W>, kernel: &(impl Fn(W) + Sync), threads: usize) {
    let tasks: Vec<_> = tasks.map(|task| Mutex::new(Some(task))).collect();
    let members = threads.min(tasks.len());
    let own = |number: usize| &tasks[tasks.len() * number / members..tasks.len() * (number + 1) / members];
    let take = |task: &Mutex<Option<W>>| {
        let taken = task.lock().unwrap_or_else(PoisonError::into_inner).take();
        taken.into_iter().for_each(kernel);
    };
    in_company(0..members, &|number| {
        own(number).iter().for_each(take);
        for other in (1..members).map(|turn| (number + turn) % members) {
            own(other).iter().rev().for_each(take);
        }
    });
}

/// Calls `work` with each of `numbers`, each on a thread of its own if there are as many.
fn in_company(numbers: Range<usize>, work: &(impl Fn(usize) + Sync)) {
    match numbers.len() {
        0 => {}
        1 => work(numbers.start),
        len => {
            let middle = numbers.start + len / 2;
            rayon::join(|| in_company(numbers.start..middle, work), || in_company(middle..numbers.end, work));
        }
    }
}

/// Cuts `work` into tasks that end before the chunks `ends`, of which the last is the number of chunks.
pub fn cut<W: Chunked>(work: W, ends: impl IntoIterator<Item = usize>) -> impl Iterator<Item = W> {
    let chunks = work.chunks();
    let (mut left, mut start) = (Some(work), 0);
    ends.into_iter().map_while(move |end| {
        let work = left.take()?;
        if end >= chunks {
            return Some(work);
        }
        let (task, rest) = work.split(end - start);
        (left, start) = (Some(rest), end);
        Some(task)
    })
}

/// The chunks of `work`, one by one.
pub fn in_turn<W: Chunked>(work: W) -> impl Iterator<Item = W> {
    let mut left = Some(work);
    std::iter::from_fn(move || {
        let work = left.take()?;
        if work.chunks() <= 1 {
            return Some(work);
        }
        let (first, rest) = work.split(1);
        left = Some(rest);
        Some(first)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn every_task_is_done_once_however_few_there_are() {
        for threads in [1, 3] {
            let threads = Threads::new(threads).unwrap();
            for tasks in [0, 1, 2, 3, 40] {
                let done: Vec<AtomicUsize> = (0..tasks).map(|_| AtomicUsize::new(0)).collect();
                threads.for_each(PARALLEL_THRESHOLD, done.iter(), &|task: &AtomicUsize| {
                    task.fetch_add(1, Ordering::Relaxed);
                });
                assert!(done.into_iter().all(|task| task.into_inner() == 1), "{tasks} tasks");
            }
        }
    }
}
