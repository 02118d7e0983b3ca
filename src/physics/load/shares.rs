//! Shares: what they are counted by, and whole numbers that obey them.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::physics::sorting::sort_indices;

/// What shares are counted by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Measure {
    /// Mass.
    Mass,
    /// Area of the discs.
    Area,
    /// Number of discs.
    Number,
}

/// By how much shares may miss 1 that are written with two or three digits.
const SLACK: f64 = 0.005;

/// Refuses shares that do not sum to 1.
///
/// # Errors
/// `Error::Config` naming `key`, what a user calls all of them.
pub fn require_whole(key: &str, shares: &[f64]) -> Result<(), Error> {
    let sum: f64 = shares.iter().sum();
    let are_percent = (sum - 100.0).abs() <= 100.0 * SLACK;
    let limit = if are_percent { "1 in all: 20 % is 0.2" } else { "1 in all" };
    require((sum - 1.0).abs() <= SLACK, key, format!("{} in all", (1e6 * sum).round() / 1e6), limit)
}

/// Numbers over their sum.
pub fn normalized(mut numbers: Vec<f64>) -> Vec<f64> {
    let sum: f64 = numbers.iter().sum();
    for number in &mut numbers {
        *number /= sum;
    }
    numbers
}

/// `count` split by shares that sum to 1: each rounded down, what is left goes to those that lost most.
///
/// ```
/// use drumrs::physics::load::shares::largest_remainder;
///
/// assert_eq!(largest_remainder(10, &[0.25, 0.15, 0.6]), [3, 1, 6]);
/// ```
pub fn largest_remainder(count: usize, shares: &[f64]) -> Vec<usize> {
    let exact: Vec<f64> = shares.iter().map(|share| share * count as f64).collect();
    let mut counts: Vec<usize> = exact.iter().map(|&number| number as usize).collect();
    let mut order: Vec<usize> = (0..shares.len()).collect();
    sort_indices(&mut order, &|a, b| exact[b].fract().total_cmp(&exact[a].fract()));
    let left = count.saturating_sub(counts.iter().sum());
    order.iter().cycle().take(left).for_each(|&place| counts[place] += 1);
    counts
}
