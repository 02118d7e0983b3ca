//! Contacts are worked out four at a time, in key order.

use crate::lanes::{LANES, Lanes, lanes};

/// Up to four slots that are worked out together.
#[derive(Debug, Clone, Copy)]
pub struct Batch {
    /// The slots of all lanes; lanes that are not in use repeat one that is.
    pub slots: [usize; LANES],
    /// Number of lanes in use.
    pub count: usize,
}

impl Batch {
    /// Four slots.
    #[inline(always)]
    pub fn full(slots: &[u32]) -> Self {
        Self { slots: std::array::from_fn(|lane| slots[lane] as usize), count: LANES }
    }

    /// One to four slots.
    pub fn partial(slots: &[u32]) -> Self {
        let last = slots.len() - 1;
        Self { slots: std::array::from_fn(|lane| slots[lane.min(last)] as usize), count: slots.len() }
    }
}

/// All ones in the first `count` lanes.
#[inline(always)]
pub fn in_use(count: usize) -> Lanes {
    let ones = f64::from_bits(u64::MAX);
    if count == LANES {
        return Lanes::splat(ones);
    }
    lanes(|lane| if lane < count { ones } else { 0.0 })
}
