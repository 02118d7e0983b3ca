//! Asks memory early for what is needed soon, so that its latency passes while other work goes on.

/// Bytes that memory hands over at once.
const LINE: usize = 64;

/// Asks for some items in a row, none larger than a line.
#[inline(always)]
pub fn ask_for<T>(items: &[T]) {
    items.iter().step_by((LINE / size_of::<T>()).max(1)).for_each(ask);
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

/// Part `part` of `parts` equal ones, as a range of `len`.
#[inline(always)]
pub fn part_of(len: usize, part: usize, parts: usize) -> std::ops::Range<usize> {
    len * part / parts..len * (part + 1) / parts
}
