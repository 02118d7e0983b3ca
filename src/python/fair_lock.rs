//! A lock that a loop which takes it again and again does not keep from others.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// A mutex behind another: a thread that waits for the value holds the outer one, so that the thread that has just given
/// the value back cannot take it again before the one that waits.
#[derive(Debug)]
pub struct FairLock<T> {
    value: Mutex<T>,
    next: Mutex<()>,
}

impl<T> FairLock<T> {
    /// A lock around a value.
    pub fn new(value: T) -> Self {
        Self { value: Mutex::new(value), next: Mutex::new(()) }
    }

    /// Waits for the value. A panic of an earlier owner is not passed on.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        let _next = self.next.lock().unwrap_or_else(PoisonError::into_inner);
        self.value.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
