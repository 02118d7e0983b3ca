//! The gate through which every thread goes into a simulation, and which a fork closes.
//!
//! A forked child has only the thread that forked: a lock that another thread held would stay locked in it for ever. So
//! Python closes the gate before a fork, which waits until nobody is inside (a slice of a run at most), and opens it
//! afterwards in both processes. Atomics only: the gate itself must not be locked at the moment of a fork.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

static CLOSED: AtomicBool = AtomicBool::new(false);
static INSIDE: AtomicUsize = AtomicUsize::new(0);

/// How long a thread sleeps between two looks; forks are rare.
const PAUSE: Duration = Duration::from_micros(200);

/// Being inside.
pub struct Inside;

impl Inside {
    /// Goes in, once the gate is open; the caller must not hold the interpreter.
    pub fn enter() -> Self {
        loop {
            INSIDE.fetch_add(1, Ordering::SeqCst);
            if !CLOSED.load(Ordering::SeqCst) {
                return Self;
            }
            INSIDE.fetch_sub(1, Ordering::SeqCst);
            wait_while(|| CLOSED.load(Ordering::SeqCst));
        }
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        INSIDE.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Closes the gate and waits until nobody is inside, who never waits for the interpreter.
pub fn close() {
    while CLOSED.swap(true, Ordering::SeqCst) {
        // Another thread forks.
        thread::sleep(PAUSE);
    }
    wait_while(|| INSIDE.load(Ordering::SeqCst) > 0);
}

/// Opens the gate.
pub fn open() {
    CLOSED.store(false, Ordering::SeqCst);
}

/// Opens the gate in a forked child, where nobody else is.
pub fn open_alone() {
    INSIDE.store(0, Ordering::SeqCst);
    open();
}

fn wait_while(condition: impl Fn() -> bool) {
    while condition() {
        thread::sleep(PAUSE);
    }
}
