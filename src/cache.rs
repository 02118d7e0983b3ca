//! Asks memory early for what is needed soon, so that its latency passes while other work goes on.

/// Bytes that memory hands over at once.
const LINE: usize = 64;

/// Asks for some items in a row, none larger than a line.
#[inline(always)]
pub fn ask_for<T>(items: &[T]) {
    let step = const { if size_of::<T>() < LINE { LINE / size_of::<T>() } else { 1 } };
    // Four lines at a time: asking is so little work that a loop would double it.
    let fours = items.chunks_exact(4 * step);
    fours.remainder().iter().step_by(step).for_each(ask);
    for four in fours {
        (0..4).for_each(|line| ask(&four[line * step]));
    }
}

/// Asks for one item, no larger than a line, as far as the second level of the cache: the first one is too small to keep
/// what is only needed soon. Other CPUs than x86 are not asked.
#[inline(always)]
pub fn ask<T>(item: &T) {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    safe_arch::prefetch_t1(item);
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    let _ = item;
}

/// Shares in which memory is asked for much at a time, so that it keeps up; a power of two, which makes them cheap to tell.
pub const SHARES: usize = 16;

/// Share `share` of some items.
#[inline(always)]
pub fn share_of<T>(items: &[T], share: usize) -> &[T] {
    &items[items.len() * share / SHARES..items.len() * (share + 1) / SHARES]
}
