//! Parts of the core by themselves: threads, memory order, memory for records.

use std::sync::atomic::{AtomicUsize, Ordering};

use drumrs::engine::memory_order::hilbert_order;
use drumrs::engine::parallel::Threads;
use drumrs::observe::memory::{prepend, reserve};
use drumrs::physics::vector::Vec2;

/// A load that is shared between threads.
const LOAD: usize = 10_000;

#[test]
fn every_task_is_done_once_however_few_there_are() {
    for threads in [1, 3] {
        let threads = Threads::new(threads).unwrap();
        for tasks in [0, 1, 2, 3, 40] {
            let done: Vec<AtomicUsize> = (0..tasks).map(|_| AtomicUsize::new(0)).collect();
            assert!(threads.count() == 1 || threads.serve(LOAD));
            threads.for_each(LOAD, done.iter(), |task| {
                task.fetch_add(1, Ordering::Relaxed);
            });
            assert!(done.into_iter().all(|task| task.into_inner() == 1), "{tasks} tasks");
        }
    }
}

#[test]
fn every_particle_has_a_place() {
    let positions: Vec<Vec2> =
        (0..500).map(|k| Vec2::new(f64::from(k * 7 % 13), f64::from(k * 5 % 11))).collect();
    let mut order = hilbert_order(&positions);
    // Those at one place keep their order.
    assert!(
        order
            .windows(2)
            .all(|two| { positions[two[0] as usize] != positions[two[1] as usize] || two[0] < two[1] })
    );
    order.sort_unstable();
    assert_eq!(order, (0..500).collect::<Vec<u32>>());
    assert_eq!(hilbert_order(&[Vec2::zeros(); 3]), [0, 1, 2]);
}

#[test]
fn room_that_cannot_be_is_an_error_and_changes_nothing() {
    let mut list = vec![1.0, 2.0];
    let error = reserve(&mut list, usize::MAX / 16, "recording a frame").unwrap_err();
    assert!(error.to_string().starts_with("recording a frame: there is no memory for "), "{error}");
    assert_eq!(list, [1.0, 2.0]);
}

#[test]
fn what_was_earlier_comes_first() {
    let mut list = vec![3, 4];
    prepend(&mut list, &[1, 2, 0], "a test").unwrap();
    assert_eq!(list, [1, 2, 0, 3, 4]);
}
