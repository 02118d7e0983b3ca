//! One sort for lists whose sorting takes no time to speak of: the standard library's is compiled anew for each kind of thing and
//! each way of comparing, 7 kB each.

use std::cmp::Ordering;

/// Sorts a list; what is equal keeps its order.
///
/// ```
/// use drumrs::physics::sorting::sort;
///
/// let mut list = [(2.0_f64, 'a'), (1.0, 'b'), (2.0, 'c')];
/// sort(&mut list, &|one, other| one.0.total_cmp(&other.0));
/// assert_eq!(list.map(|(_, name)| name), ['b', 'a', 'c']);
/// ```
pub fn sort<T: Copy>(list: &mut [T], compare: &dyn Fn(&T, &T) -> Ordering) {
    let mut indices: Vec<usize> = (0..list.len()).collect();
    sort_indices(&mut indices, &|one, other| compare(&list[one], &list[other]));
    let sorted: Vec<T> = indices.into_iter().map(|index| list[index]).collect();
    list.copy_from_slice(&sorted);
}

/// Sorts indices of a list by what is there; what is equal keeps its order.
pub fn sort_indices(indices: &mut [usize], compare: &dyn Fn(usize, usize) -> Ordering) {
    indices.sort_by(|&one, &other| compare(one, other));
}
