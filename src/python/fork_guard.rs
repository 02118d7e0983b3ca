//! The guard at the door of every simulation, which a fork closes.
//!
//! A forked child has only the thread that forked: a lock that another thread held would stay locked in it for ever. So
//! Python closes the guard before a fork, which waits until no thread has entered (a slice of a run at most), and opens it
//! afterwards in both processes. Atomics only: the guard itself must not be locked at the moment of a fork.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

static CLOSED: AtomicBool = AtomicBool::new(false);
static ENTERED: AtomicUsize = AtomicUsize::new(0);

/// How long a thread sleeps between two looks; forks are rare.
const PAUSE: Duration = Duration::from_micros(200);

/// Having entered; leaves when dropped.
pub struct Entered;

impl Entered {
    /// Enters, once the guard is open; the caller must not hold the interpreter.
    pub fn enter() -> Self {
        loop {
            ENTERED.fetch_add(1, Ordering::SeqCst);
            if !CLOSED.load(Ordering::SeqCst) {
                return Self;
            }
            ENTERED.fetch_sub(1, Ordering::SeqCst);
            wait_while(|| CLOSED.load(Ordering::SeqCst));
        }
    }
}

impl Drop for Entered {
    fn drop(&mut self) {
        ENTERED.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Closes the guard and waits until all that have entered have left; they never wait for the interpreter.
pub fn close() {
    while CLOSED.swap(true, Ordering::SeqCst) {
        // Another thread forks.
        thread::sleep(PAUSE);
    }
    wait_while(|| ENTERED.load(Ordering::SeqCst) > 0);
}

/// Opens the guard.
pub fn open() {
    CLOSED.store(false, Ordering::SeqCst);
}

/// Opens the guard in a forked child, which no other thread has entered.
pub fn open_in_child() {
    ENTERED.store(0, Ordering::SeqCst);
    open();
}

fn wait_while(condition: impl Fn() -> bool) {
    while condition() {
        thread::sleep(PAUSE);
    }
}
