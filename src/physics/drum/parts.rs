//! What users call the parts of a drum.

use std::collections::BTreeMap;

/// A name for each member of some sets, given as a name and a number of members: "baffle 1", "baffle 2", … Members of sets
/// of the same name are counted on.
pub(super) fn part_names<'a>(sets: impl Iterator<Item = (&'a str, usize)>) -> Vec<String> {
    let mut counts = BTreeMap::new();
    let members = sets.flat_map(|(name, count)| std::iter::repeat_n(name, count));
    members
        .map(|name| {
            let number: &mut usize = counts.entry(name).or_default();
            *number += 1;
            format!("{name} {number}")
        })
        .collect()
}
