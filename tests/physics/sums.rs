//! Sums and integrals of the ledger.

use drumrs::physics::energy::{Integrals, Sum};

#[test]
fn a_compensated_sum_keeps_what_a_plain_one_loses() {
    let mut sum = Sum::default();
    for value in [1.0, 1e100, 1.0, -1e100] {
        sum.add(value);
    }
    assert_eq!(sum.value(), 2.0);
}

#[test]
fn integrals_are_trapezoids() {
    let mut integrals = Integrals::from([1.0, 0.0, 0.0, 0.0]);
    integrals.advance([3.0, 1.0, 0.0, 0.0], [0.5, 2.0, 1.0, 1.0]);
    assert_eq!(integrals.value(0), 0.0);
    integrals.fold();
    integrals.advance([3.0, 1.0, 0.0, 0.0], [0.5, 2.0, 1.0, 1.0]);
    integrals.fold();
    assert_eq!([0, 1].map(|k| integrals.value(k)), [2.0 + 3.0, 2.0 + 4.0]);
}
