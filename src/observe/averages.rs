//! Means over a window of samples, and their standard errors. They are computed here only: for the summary, and through
//! `drumrs._core` for the analysis in Python.
//!
//! A column of the series is one of three kinds, each with its own mean. A *cumulative* one is an integral since t = 0 (the
//! work of the drum): its mean rate is a difference over a time, exact however coarse the sampling. A *sampled* one is the
//! state at the sample (the coordination). An *interval mean* has been averaged since the last sample (the torque).
//!
//! Functions take the rows of the window alone. The first row of a cumulative column or one of interval means only begins
//! the first interval.

/// The fewest blocks from which a standard error is taken.
pub const FEWEST_BLOCKS: usize = 8;

/// The standard error of the mean of correlated samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockError {
    /// Standard error of the mean, in the unit of the values.
    pub error: f64,
    /// Integrated correlation time, in the unit of the interval.
    pub correlation_time: f64,
    /// Number of blocks that the error was taken from.
    pub blocks: usize,
}

impl BlockError {
    /// The error from block averages (Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461): blocks are doubled in length
    /// while at least eight remain, and the greatest error found is kept, since short blocks are correlated and tell too
    /// little. None with fewer than eight values.
    pub fn of(values: &[f64], interval: f64) -> Option<Self> {
        let mut blocks = values.to_vec();
        let plain = squared_error(&blocks)?;
        let (mut greatest, mut count) = (plain, blocks.len());
        while blocks.len() / 2 >= FEWEST_BLOCKS {
            blocks = blocks.chunks_exact(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            let squared = squared_error(&blocks)?;
            if squared > greatest {
                (greatest, count) = (squared, blocks.len());
            }
        }
        let inflation = if plain > 0.0 { greatest / plain } else { 1.0 };
        Some(Self { error: greatest.sqrt(), correlation_time: 0.5 * inflation * interval, blocks: count })
    }
}

/// The squared standard error of the mean of independent values.
fn squared_error(values: &[f64]) -> Option<f64> {
    if values.len() < FEWEST_BLOCKS {
        return None;
    }
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0);
    Some(variance / count)
}

/// A mean over a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// Its error; none where the window holds fewer than eight intervals.
    pub spread: Option<BlockError>,
}

/// The rows nearest to the start and the end of a window [s]; none where these are not two rows in this order.
pub fn window(times: &[f64], start: f64, end: f64) -> Option<(usize, usize)> {
    let nearest = |time: f64| {
        let after = times.partition_point(|&sample| sample < time);
        let before = after.checked_sub(1)?;
        let is_nearer = after == times.len() || time - times[before] < times[after] - time;
        Some(if is_nearer { before } else { after })
    };
    let (first, last) = (nearest(start).unwrap_or(0), nearest(end).unwrap_or(0));
    (first < last && !start.is_nan()).then_some((first, last))
}

/// The mean rate of a cumulative column.
pub fn rate(times: &[f64], cumulative: &[f64]) -> f64 {
    change(cumulative) / change(times)
}

/// The mean rate of a cumulative column, with its error.
pub fn mean_rate(times: &[f64], cumulative: &[f64]) -> Mean {
    Mean {
        value: rate(times, cumulative),
        spread: BlockError::of(&rates(times, cumulative), mean_interval(times)),
    }
}

/// The mean of samples at equal intervals, with its error.
pub fn mean_sampled(samples: &[f64], interval: f64) -> Mean {
    Mean {
        value: samples.iter().sum::<f64>() / samples.len() as f64,
        spread: BlockError::of(samples, interval),
    }
}

/// The mean of a column of interval means, each with the length of its interval.
pub fn mean_of_intervals(times: &[f64], means: &[f64]) -> f64 {
    let integral: f64 =
        times.windows(2).zip(&means[1..]).map(|(pair, mean)| mean * (pair[1] - pair[0])).sum();
    integral / change(times)
}

/// The ratio R of the mean rates of two cumulative columns, with its error: that of the mean of a − R b over the mean of b,
/// interval by interval, so that what the rates share cancels (the ratio estimator of sample surveys, to first order).
/// None where the lower one does not change.
pub fn mean_ratio(times: &[f64], numerator: &[f64], denominator: &[f64]) -> Option<Mean> {
    let below = change(denominator);
    if below == 0.0 {
        return None;
    }
    let value = change(numerator) / below;
    let scale = (change(times) / below).abs();
    let (above, below) = (rates(times, numerator), rates(times, denominator));
    let departures: Vec<f64> = above.iter().zip(below).map(|(a, b)| (a - value * b) * scale).collect();
    Some(Mean { value, spread: BlockError::of(&departures, mean_interval(times)) })
}

/// The rates of a cumulative column from row to row.
fn rates(times: &[f64], cumulative: &[f64]) -> Vec<f64> {
    let steps = |column: &[f64]| column.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>();
    steps(cumulative).iter().zip(steps(times)).map(|(change, time)| change / time).collect()
}

fn change(column: &[f64]) -> f64 {
    column[column.len() - 1] - column[0]
}

/// The mean time between rows.
pub fn mean_interval(times: &[f64]) -> f64 {
    change(times) / (times.len() - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uniform in [0, 1), from a multiplicative congruential sequence.
    fn noise(count: usize) -> Vec<f64> {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn independent_values_have_their_textbook_error() {
        let spread = BlockError::of(&noise(8192), 1.0).unwrap();
        let expected = (1.0_f64 / 12.0 / 8192.0).sqrt();
        assert!(
            spread.error > 0.9 * expected && spread.error < 1.9 * expected,
            "{}",
            spread.error / expected
        );
    }

    #[test]
    fn correlated_values_have_a_larger_error() {
        let held: Vec<f64> = noise(256).into_iter().flat_map(|value| [value; 32]).collect();
        let spread = BlockError::of(&held, 0.5).unwrap();
        let expected = (1.0_f64 / 12.0 / 256.0).sqrt();
        assert!(spread.error > 0.8 * expected && spread.error < 2.0 * expected);
        assert!(spread.correlation_time > 4.0 && spread.correlation_time < 32.0);
        assert!(spread.blocks <= 256);
    }

    #[test]
    fn few_values_have_no_error() {
        assert_eq!(BlockError::of(&[1.0; 7], 1.0), None);
    }

    #[test]
    fn intervals_count_by_their_length_and_samples_do_not() {
        let (times, values) = ([0.0, 1.0, 4.0], [9.0, 2.0, 6.0]);
        assert_eq!(mean_of_intervals(&times, &values), (2.0 + 3.0 * 6.0) / 4.0);
        assert_eq!(mean_sampled(&values[1..], 1.0), Mean { value: 4.0, spread: None });
        assert_eq!(mean_rate(&times, &[1.0, 5.0, 3.0]).value, 0.5);
        assert_eq!(mean_ratio(&times, &values, &[1.0, 5.0, 3.0]).unwrap().value, -1.5);
        assert_eq!(mean_ratio(&times, &values, &[1.0, 5.0, 1.0]), None);
    }
}
