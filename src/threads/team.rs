//! Threads that wait for work awake: a step hands work over several times within some hundred microseconds, and waking a
//! sleeping thread may take as long as a pass.
//!
//! The only module with unsafe code. Threads that outlive a task cannot borrow what it works on as far as the compiler
//! can see; `Team::work` makes it true by not returning before every thread has left the task.

#![allow(unsafe_code)]

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};

/// What the threads of a team do together, each told its number. The caller, number 0, always comes, and leaves when
/// nothing is left to do; a helper whose CPU is busy with something else may come late, or not at all.
type Task<'a> = &'a (dyn Fn(usize) + Sync + 'a);

/// Looks at a flag in between which a thread only pauses, and looks after which it lets others run; then it sleeps.
/// Together some milliseconds on an idle machine.
const PAUSES: usize = 2_000;
const YIELDS: usize = 4_000;

/// A caller and its helpers.
#[derive(Debug)]
pub(super) struct Team {
    shared: Arc<Shared>,
    helpers: Vec<JoinHandle<()>>,
    /// Held while a task is under way: a team has one caller at a time.
    caller: Mutex<()>,
    /// The process that has the helpers. In a forked one nobody comes, and the caller does all the work, with the same bits.
    home: u32,
}

#[derive(Default)]
struct Shared {
    /// Number of the task, whether it is open, and how many helpers are at it: see `ROUND`, `OPEN`.
    state: AtomicUsize,
    task: Mutex<Option<Task<'static>>>,
    failed: AtomicBool,
    closed: AtomicBool,
}

/// Helpers may join the task.
const OPEN: usize = 1 << 15;
/// One more task. Below `OPEN` is the number of helpers.
const ROUND: usize = 1 << 16;

impl std::fmt::Debug for Shared {
    fn fmt(&self, formatter: &mut std::fmt::Formatter) -> std::fmt::Result {
        formatter.debug_struct("Shared").field("state", &self.state).finish_non_exhaustive()
    }
}

impl Team {
    /// A team of `count` threads, the caller among them.
    pub(super) fn new(count: usize) -> std::io::Result<Self> {
        let mut team = Self {
            shared: Arc::default(),
            helpers: Vec::new(),
            caller: Mutex::default(),
            home: std::process::id(),
        };
        for number in 1..count {
            let shared = team.shared.clone();
            let name = format!("drumrs-{number}");
            team.helpers.push(thread::Builder::new().name(name).spawn(move || shared.help(number))?);
        }
        Ok(team)
    }

    /// Number of threads.
    pub(super) fn count(&self) -> usize {
        self.helpers.len() + 1
    }

    /// Does `task` as number 0, with those helpers that come; returns when all have left it.
    pub(super) fn work(&self, task: Task) {
        let _turn = lock(&self.caller);
        // SAFETY: a helper calls the task only while it is counted in the state, and it enters only while the task is
        // open. `close` shuts it and waits for the count to be zero, on every path, while the caller still lends it.
        let lent = unsafe { std::mem::transmute::<Task<'_>, Task<'static>>(task) };
        *lock(&self.shared.task) = Some(lent);
        let round = self.shared.state.load(Ordering::Relaxed) / ROUND;
        self.shared.state.store(round.wrapping_add(1) * ROUND + OPEN, Ordering::Release);
        self.helpers.iter().for_each(|helper| helper.thread().unpark());
        let own = catch_unwind(AssertUnwindSafe(|| task(0)));
        self.close();
        if let Err(panic) = own {
            resume_unwind(panic);
        }
        assert!(!self.shared.failed.swap(false, Ordering::Relaxed), "a thread of the simulation panicked");
    }

    /// Lets no helper join the task any more, and waits for those who are at it.
    fn close(&self) {
        self.shared.state.fetch_and(!OPEN, Ordering::Relaxed);
        let mut looks = 0;
        while !self.shared.state.load(Ordering::Acquire).is_multiple_of(ROUND) {
            pause(looks);
            looks += 1;
        }
        *lock(&self.shared.task) = None;
    }
}

impl Drop for Team {
    fn drop(&mut self) {
        if std::process::id() != self.home {
            // Threads that are not there could be waited for for ever.
            std::mem::forget(std::mem::take(&mut self.helpers));
            return;
        }
        self.shared.closed.store(true, Ordering::Release);
        for helper in self.helpers.drain(..) {
            helper.thread().unpark();
            // A helper catches every panic of a task.
            let _ = helper.join();
        }
    }
}

impl Shared {
    /// What helper `number` does all its life.
    fn help(&self, number: usize) {
        let mut last = 0;
        while let Some(round) = self.join_after(last) {
            last = round;
            let task = *lock(&self.task);
            if let Some(task) = task
                && catch_unwind(AssertUnwindSafe(|| task(number))).is_err()
            {
                self.failed.store(true, Ordering::Relaxed);
            }
            self.state.fetch_sub(1, Ordering::Release);
        }
    }

    /// Joins a task after number `last`, whose number it returns; none when the team is dissolved.
    fn join_after(&self, last: usize) -> Option<usize> {
        let mut looks = 0;
        while !self.closed.load(Ordering::Acquire) {
            let state = self.state.load(Ordering::Relaxed);
            if state & OPEN != 0 && state / ROUND != last {
                let joined =
                    self.state.compare_exchange_weak(state, state + 1, Ordering::Acquire, Ordering::Relaxed);
                if joined.is_ok() {
                    return Some(state / ROUND);
                }
            } else if looks < PAUSES + YIELDS {
                pause(looks);
                looks += 1;
            } else {
                // Until the caller says that there is a task; a token left over from an earlier one costs a look.
                thread::park();
            }
        }
        None
    }
}

/// What to do after so many looks in vain.
fn pause(looks: usize) {
    if looks < PAUSES {
        std::hint::spin_loop();
    } else {
        thread::yield_now();
    }
}

/// Nothing that these locks guard can be left half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tasks of which each is done by exactly one thread, whoever comes.
    fn done(team: &Team, tasks: usize) -> usize {
        let next = AtomicUsize::new(0);
        let sum = AtomicUsize::new(0);
        team.work(&|_| {
            while next.fetch_add(1, Ordering::Relaxed) < tasks {
                sum.fetch_add(1, Ordering::Relaxed);
            }
        });
        sum.into_inner()
    }

    #[test]
    fn nothing_is_left_when_the_caller_returns() {
        let team = Team::new(3).unwrap();
        assert!((0..5000).all(|tasks| done(&team, tasks % 50) == tasks % 50));
    }

    #[test]
    fn a_sleeping_helper_wakes_up() {
        let team = Team::new(2).unwrap();
        for _ in 0..3 {
            thread::sleep(std::time::Duration::from_millis(60));
            let came = AtomicBool::new(false);
            team.work(&|number| {
                came.fetch_or(number == 1, Ordering::Relaxed);
                while !came.load(Ordering::Relaxed) {
                    thread::yield_now();
                }
            });
        }
    }

    #[test]
    fn a_panic_reaches_the_caller_and_the_team_goes_on() {
        let team = Team::new(2).unwrap();
        for culprit in 0..2 {
            let came = AtomicBool::new(false);
            let task = |number: usize| {
                came.fetch_or(number == 1, Ordering::Relaxed);
                while !came.load(Ordering::Relaxed) {
                    thread::yield_now();
                }
                assert_ne!(number, culprit);
            };
            assert!(catch_unwind(AssertUnwindSafe(|| team.work(&task))).is_err());
        }
        assert_eq!(done(&team, 7), 7);
    }
}
